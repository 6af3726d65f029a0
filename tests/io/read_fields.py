#!/usr/bin/env python3
"""Reads every file of fields that titin writes with VTK itself, and holds it against history.csv.

    read_fields.py TITIN

Skipped (exit 77) where the Python environment of scripts/plot is not installed: the first call of scripts/plot does that.
For each format, on one rank and two: times, shapes of cells (VTK's own map of a straight cell must be affine, which it is
only if its nodes come in VTK's order), points that cells share, displacements at a marker, mass from densities of cells.
"""
import csv
import os
import pathlib
import re
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[2]
MPI_ENVIRONMENT = dict(re.findall(r"\b(OMPI_\w+)=(\S+)", (TOP / "scripts" / "mpi_environment").read_text()))
SKIPPED = 77
FORMATS = ["vtu", "vtkhdf", "vtkhdf_transient"]
ROUND_OFF = 1e-12

BLOCK = """
model = "muscle"
[mesh]
box = "30, 10, 10 mm"
cells = [2, 1, 2]
[time]
end = "0.3 s"
step = "0.1 s"
[muscle]
inertia = "quasi-static"
[materials.gel]
density = "1000 kg/m^3"
volumetric = {law = "simo", bulk_modulus = "1 MPa"}
terms.matrix = {law = "neo_hookean", mu = "100 kPa"}
[boundary."x-"]
clamp = true
[boundary."x+"]
displacement = {x = {time = "0, 0.3 s", value = "0, 3 mm"}, y = {time = "0, 0.3 s", value = "0, 1 mm"}}
[markers]
tip = "30, 10, 10 mm"
"""

# Overrides of the block, its VTK cell type, its cells, and the points that its cells share (of tetrahedra: corners, edges of boxes, diagonals of their faces).
SHAPES = {
    "hexahedra": ([], 72, 4, 5 * 3 * 5),
    "cubic hexahedra": (["muscle.order=3"], 72, 4, 7 * 4 * 7),
    "hexahedra of first order": (["muscle.order=1", "muscle.element=displacement"], 12, 4, 3 * 2 * 3),
    "tetrahedra": (["mesh.kind=simplices"], 71, 20, 18 + 33 + 20),
    "wedges": (["mesh.kind=wedges"], 73, 8, 5 * 3 * 5),
    "quadrilaterals": (['mesh.box="30, 10 mm"', "mesh.cells=[2, 2]", 'markers.tip="30, 10 mm"'], 70, 4, 5 * 5),
    "triangles": (['mesh.box="30, 10 mm"', "mesh.cells=[2, 2]", "mesh.kind=simplices", 'markers.tip="30, 10 mm"'], 69, 8, 5 * 5),
}  # fmt: skip


def environment():
    """The interpreter of scripts/python_environment, or None before it is installed."""
    naming = (TOP / "scripts/python_environment").read_text().split("if [")[0] + '\necho "$environment"'
    naming = naming.replace('$(dirname "${BASH_SOURCE[0]}")', str(TOP / "scripts"))
    name = subprocess.run(["bash", "-c", naming], capture_output=True, text=True).stdout.strip()
    return pathlib.Path(name, "bin/python") if name and pathlib.Path(name).is_dir() else None


def run(titin, ranks, arguments):
    launcher = ["mpirun", "--quiet", "-np", str(ranks)] if ranks > 1 else []
    result = subprocess.run([*launcher, titin, "run", *map(str, arguments), "-q"], env=os.environ | MPI_ENVIRONMENT,
                            capture_output=True, text=True)  # fmt: skip
    if result.returncode != 0:
        sys.exit(f"{arguments}: {result.stderr}")


def history(folder):
    with open(folder / "history.csv") as file:
        rows = list(csv.reader(file))
    return {head.split(" [")[0]: [float(row[k]) for row in rows[1:]] for k, head in enumerate(rows[0])}


def datasets(folder, format):
    """[(time, grid)] of a run, by VTK's readers."""
    import json

    import vtk

    def read(reader, path):
        reader.SetFileName(str(path))
        reader.Update()
        return reader.GetOutputDataObject(0)

    fields = folder / "fields"
    if format == "vtu":
        entries = re.findall(r'timestep="([^"]*)".*file="([^"]*)"', (fields / "fields.pvd").read_text())
        return [(float(t), read(vtk.vtkXMLPUnstructuredGridReader(), fields / name)) for t, name in entries]
    if format == "vtkhdf":
        files = json.loads((fields / "fields.vtkhdf.series").read_text())["files"]
        return [(f["time"], merged(read(vtk.vtkHDFReader(), fields / f["name"]))) for f in files]
    reader = vtk.vtkHDFReader()
    reader.SetFileName(str(fields / "fields.vtkhdf"))
    reader.UpdateInformation()
    steps = reader.GetOutputInformation(0).Get(vtk.vtkStreamingDemandDrivenPipeline.TIME_STEPS())
    result = []
    for time in steps:
        reader.UpdateTimeStep(time)
        copy = vtk.vtkUnstructuredGrid()
        copy.DeepCopy(merged(reader.GetOutputDataObject(0)))
        result.append((time, copy))
    return result


def merged(data):
    import vtk

    if data.IsA("vtkUnstructuredGrid"):
        return data
    append = vtk.vtkAppendFilter()
    for k in range(data.GetNumberOfPartitions()):
        append.AddInputData(data.GetPartition(k))
    append.Update()
    return append.GetOutput()


def numbers(array):
    from vtk.util.numpy_support import vtk_to_numpy

    return vtk_to_numpy(array)


def is_affine(grid):
    """Does VTK map every cell to space by a linear function?"""
    import numpy as np
    import vtk

    cell = vtk.vtkGenericCell()
    random = np.random.default_rng(1)
    for c in range(grid.GetNumberOfCells()):
        grid.GetCell(c, cell)
        flat = cell.GetCellDimension() == 2
        at = random.uniform(0, 1 / 3, (12, 3))
        at[:, 2] *= not flat
        places = []
        for p in at:
            x, sub, weights = [0.0] * 3, vtk.reference(0), [0.0] * cell.GetNumberOfPoints()
            cell.EvaluateLocation(sub, list(p), x, weights)
            places.append(x)
        unknowns = np.hstack([np.ones((len(at), 1)), at[:, : 2 if flat else 3]])
        left = np.linalg.lstsq(unknowns, np.array(places), rcond=None)[0]
        if np.abs(unknowns @ left - places).max() > 1e-9:  # [m] of a body of centimetres
            return False
    return True


def wrong_block(folder, format, ranks, shape):
    import numpy as np

    _, cell_type, cells, points = SHAPES[shape]
    told, read = history(folder), datasets(folder, format)
    if [t for t, _ in read] != told["time"]:
        yield f"times {[t for t, _ in read]}, not {told['time']}"
    for k, (_, grid) in enumerate(read):
        kinds = {grid.GetCellType(c) for c in range(grid.GetNumberOfCells())}
        if kinds != {cell_type} or grid.GetNumberOfCells() != cells:
            yield f"{grid.GetNumberOfCells()} cells of types {kinds}, not {cells} of {cell_type}"
        if ranks == 1 and grid.GetNumberOfPoints() != points:
            yield f"{grid.GetNumberOfPoints()} points, not {points}"
        x = numbers(grid.GetPoints().GetData())
        tip = np.argmax(x.sum(axis=1))
        u = numbers(grid.GetPointData().GetArray("displacement"))[tip]
        wanted = [told[f"marker_tip_u{i}"][k] for i in "xyz" if f"marker_tip_u{i}" in told]
        if np.abs(u[: len(wanted)] - wanted).max() > ROUND_OFF:
            yield f"displacement {u} at the tip, not {wanted}"
        region, owner = (numbers(grid.GetCellData().GetArray(name)) for name in ("region", "rank"))
        if set(region) != {1} or set(owner) != set(range(ranks)):
            yield f"regions {set(region)}, ranks {set(owner)}"
        of_jumps = grid.GetCellData() if cell_type == 12 else grid.GetPointData()  # constant in cells of first order
        stress = of_jumps.GetArray("cauchy_stress")
        if of_jumps.GetArray("pressure") is None or stress is None or stress.GetNumberOfComponents() != 6:
            yield "no pressure, or a stress without 6 components"
    if not is_affine(read[0][1]):
        yield "VTK sees bent cells where they are straight: their nodes are in another order"


def wrong_gas(folder, format):
    import vtk

    told, read = history(folder), datasets(folder, format)
    if [t for t, _ in read] != told["time"]:
        yield f"times {[t for t, _ in read]}, not {told['time']}"
    for k, (_, grid) in enumerate(read):
        if grid.GetPointData().GetArray("density") or not grid.GetCellData().GetArray("density"):
            yield "density is not of the cells"
        size = vtk.vtkCellSizeFilter()
        size.SetInputData(grid)
        size.Update()
        area = numbers(size.GetOutput().GetCellData().GetArray("Area"))
        mass = (area * numbers(grid.GetCellData().GetArray("density"))).sum()
        if abs(mass / told["mass"][k] - 1) > ROUND_OFF:
            yield f"a mass of {mass}, not {told['mass'][k]}"


def unit_of(piece, name):
    """VTK's reader of a whole collection leaves units out; that of a piece has them."""
    import vtk

    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(piece))
    reader.Update()
    grid = reader.GetOutput()
    array = grid.GetPointData().GetArray(name) or grid.GetCellData().GetArray(name)
    return array.GetInformation().Get(array.UNITS_LABEL())


def wrong_rules(titin, folder, scene):
    """What of the rules for fields that jump is wrong: the same mean pressure, at other places."""
    mean = {}
    for rule in "nodes", "means", "kept":
        run(titin, 1, [scene, f"output.jumps={rule}", "output.precision=single", "-o", folder / rule])
        grid = datasets(folder / rule, "vtu")[-1][1]
        of_cells = grid.GetCellData().GetArray("pressure")
        array = of_cells or grid.GetPointData().GetArray("pressure")
        if (of_cells is not None) != (rule == "means") or array.GetDataType() != 10:  # VTK_FLOAT
            yield f"{rule}: pressure at the wrong place, or not in single precision"
        if rule == "kept" and grid.GetNumberOfPoints() != 4 * 27:
            yield f"kept: {grid.GetNumberOfPoints()} points, not 27 for each of 4 cells"
        unit = unit_of(folder / rule / "fields/Cycle000003/proc000000.vtu", "pressure")
        if unit != "Pa":
            yield f"{rule}: a pressure in {unit}"
        mean[rule] = numbers(array).mean()
    if max(mean.values()) - min(mean.values()) > 0.2 * abs(mean["means"]):
        yield f"mean pressures {mean}"


def everything(titin, folder):
    scene = folder / "block.toml"
    scene.write_text(BLOCK)
    for shape, (overrides, *_) in SHAPES.items():
        for format in FORMATS if shape == "hexahedra" else FORMATS[:2]:
            for ranks in (1, 2) if shape in ("hexahedra", "tetrahedra") else (1,):
                out = folder / f"{shape}_{format}_{ranks}"
                run(titin, ranks, [scene, *overrides, f"output.format={format}", "-o", out])
                for text in wrong_block(out, format, ranks, shape):
                    yield f"{shape}, {format}, {ranks} ranks: {text}"
    for format in FORMATS:
        for ranks in 1, 2:
            out = folder / f"sod_{format}_{ranks}"
            run(titin, ranks, [TOP / "configs/lagrange/sod.toml", "mesh.cells=[20, 2]", "output.every=10", "output.history_every=10",
                               f"output.format={format}", "-o", out])  # fmt: skip
            for text in wrong_gas(out, format):
                yield f"gas, {format}, {ranks} ranks: {text}"
    for text in wrong_rules(titin, folder, scene):
        yield f"rule {text}"


def main():
    titin = str(pathlib.Path(sys.argv[1]).resolve())
    python = environment()
    if python is None:
        print("skipped: scripts/plot has not yet installed VTK")
        sys.exit(SKIPPED)
    if pathlib.Path(sys.prefix) != python.parent.parent:
        os.execv(python, [str(python), __file__, titin])
    with tempfile.TemporaryDirectory(prefix="titin_fields_") as folder:
        wrong = list(everything(titin, pathlib.Path(folder)))
    for text in wrong:
        print(f"WRONG  {text}")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
