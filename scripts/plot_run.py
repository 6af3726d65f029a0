"""Draws a run folder as one picture: forces and energies against time, and the deformed body. Started by scripts/plot.

Reads history.csv, run.json, resolved.toml and the ParaView collection of the run.
"""
import argparse
import csv
import json
import pathlib
import re
import sys
import tomllib

import matplotlib.pyplot as plt
import numpy as np
import pyvista as pv
from plot_style import COLOUR_MAP, FAINT, INK, STYLE, draw_curves, prefixed

# Fields worth a picture, best first; what each is called in it.
FIELDS = {
    "fibre_stretch": "fibre stretch",
    "pressure": "pressure",
    "displacement": "displacement",
    "velocity": "speed",
}
SMALL = 0.01  # curves below this part of the largest one are left out


def fail(message):
    sys.exit(f"plot: {message}")


# ---- the run ---------------------------------------------------------------------------------------------------------


def read_history(folder):
    path = folder / "history.csv"
    if not path.exists():
        fail(f"{path} is not there; is {folder} the folder of a run?")
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    values = np.array(rows[1:], dtype=float)
    return {name.strip(): values[:, k] for k, name in enumerate(rows[0])}


def title_of(folder):
    resolved = folder / "resolved.toml"
    title = tomllib.loads(resolved.read_text()).get("title") if resolved.exists() else None
    return title or folder.resolve().name


def facts_of(folder):
    """One line of numbers on the run."""
    path = folder / "run.json"
    run = json.loads(path.read_text()) if path.exists() else {}
    facts = []
    if "unknowns" in run:
        facts.append(f"{run['unknowns']:,} unknowns")
    if "steps" in run:
        facts.append(f"{run['steps']} steps")
    if run.get("steps") and "newton" in run:
        facts.append(f"{run['newton']['total'] / run['steps']:.1f} Newton iterations a step")
    if "wall_seconds" in run:
        facts.append(f"{run['wall_seconds']:.3g} s on {run.get('ranks', 1)} rank{'s' * (run.get('ranks', 1) > 1)}")
    return "    ".join(facts)


# ---- curves ----------------------------------------------------------------------------------------------------------


def reactions(history):
    """The force that each held boundary puts on the body; a component that mirrors one before it is left out."""
    found = {}
    for column, values in history.items():
        match = re.fullmatch(r"reaction_(.+)_([xyz]) \[N\]", column)
        if match:
            found[f"{match.group(1)}, {match.group(2)}"] = values
    largest = max((np.max(np.abs(v)) for v in found.values()), default=0)
    kept = {}
    for name in sorted(found, key=lambda n: -np.max(found[n])):
        values = found[name]
        mirrored = any(min(np.max(np.abs(values - o)), np.max(np.abs(values + o))) < 0.05 * largest for o in kept.values())
        if np.max(np.abs(values)) > SMALL * largest and not mirrored:
            kept[name] = values
    return kept


def energies(history):
    found = {}
    for column, values in history.items():
        match = re.fullmatch(r"(energy|work)_(.+) \[J\]", column)
        if match:
            kind, name = match.group(1), match.group(2).replace("_", " ")
            found[name if kind == "energy" else f"work of {name}"] = values
    largest = max((np.max(np.abs(v)) for v in found.values()), default=0)
    return {name: v for name, v in found.items() if np.max(np.abs(v)) > SMALL * largest}


# ---- the body --------------------------------------------------------------------------------------------------------


def read_body(folder, time):
    """The mesh with its fields at the saved time nearest to `time` (None: the last), and that time."""
    found = sorted(folder.rglob("*.pvd"))
    if not found:
        return None, None
    reader = pv.PVDReader(str(found[0]))
    saved = np.array(reader.time_values)
    at = saved[-1] if time is None else saved[np.argmin(np.abs(saved - time))]
    reader.set_active_time_value(at)
    # Each cell is written with nodes of its own: merge them, so that faces inside the body are known to be inside.
    return reader.read().combine().clean(tolerance=1e-9), at


def field_of(grid, wanted):
    """Adds the array "shown" and returns what it is called; a vector becomes its length."""
    name = wanted or next((f for f in FIELDS if f in grid.point_data), None) or next(iter(grid.point_data), None)
    if name not in grid.point_data:
        fail(f"there is no field '{name}'; there are {', '.join(sorted(grid.point_data))}")
    values = np.asarray(grid.point_data[name])
    grid.point_data["shown"] = values if values.ndim == 1 else np.linalg.norm(values, axis=1)
    return name


def edges_of_cells(surface):
    """Lines on a tessellated surface where two cells, or two faces of one, meet."""
    triangles = surface.regular_faces
    owner = np.asarray(surface.cell_data["vtkOriginalCellIds"])
    normals = np.asarray(surface.compute_normals(cell_normals=True, point_normals=False, auto_orient_normals=False,
                                                 consistent_normals=False, split_vertices=False).cell_data["Normals"])  # fmt: skip
    sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    triangle = np.tile(np.arange(len(triangles)), 3)
    order = np.lexsort((sides[:, 1], sides[:, 0]))
    sides, triangle = sides[order], triangle[order]
    twins = np.flatnonzero(np.all(sides[:-1] == sides[1:], axis=1))
    a, b = triangle[twins], triangle[twins + 1]
    seen = (owner[a] != owner[b]) | (np.einsum("ij,ij->i", normals[a], normals[b]) < 0.7)
    lines = sides[twins[seen]]
    return pv.PolyData(surface.points, lines=np.hstack([np.full((len(lines), 1), 2), lines]).ravel())


def render(grid, clim, warp, size=(1500, 1150)):
    """The deformed body as an RGBA array, with the outline of the body at rest."""
    at_rest = grid.extract_surface(nonlinear_subdivision=2, algorithm="dataset_surface").triangulate()
    deformed = grid.warp_by_vector("displacement", factor=warp) if "displacement" in grid.point_data else grid
    surface = deformed.extract_surface(nonlinear_subdivision=3, algorithm="dataset_surface").triangulate().clean(tolerance=1e-8)
    plotter = pv.Plotter(off_screen=True, window_size=size)
    plotter.set_background("white")
    plotter.enable_anti_aliasing("ssaa")
    plotter.add_mesh(at_rest.extract_feature_edges(40, boundary_edges=False), color="#8a93a3", line_width=2)
    plotter.add_mesh(surface, scalars="shown", cmap=COLOUR_MAP, clim=clim, show_scalar_bar=False, smooth_shading=True,
                     split_sharp_edges=True, ambient=0.55, diffuse=0.52, specular=0.06, specular_power=12)  # fmt: skip
    plotter.add_mesh(edges_of_cells(surface), color=INK, line_width=1.8, opacity=0.5)
    plotter.enable_parallel_projection()
    plotter.view_vector((-0.5, -1.0, 0.5), (0, 0, 1))
    plotter.reset_camera()
    plotter.camera.zoom(1.25)
    image = plotter.screenshot(return_img=True, transparent_background=True)
    plotter.close()
    rows, columns = np.nonzero(image[:, :, 3])
    return image[rows.min() : rows.max() + 1, columns.min() : columns.max() + 1]


def unit_of_field(name):
    return {"pressure": "Pa", "displacement": "m", "velocity": "m/s", "fibre_rate": "1/s", "cauchy_stress": "Pa"}.get(name, "")


def draw_body(figure, axes, folder, options):
    axes.axis("off")
    grid, time = read_body(folder, options.time)
    if grid is None:
        axes.text(0.5, 0.5, "no fields were saved", ha="center", color=FAINT)
        return
    name = field_of(grid, options.field)
    factor, prefix = prefixed([grid.point_data["shown"]]) if unit_of_field(name) else (1, "")
    grid.point_data["shown"] = grid.point_data["shown"] * factor
    low, high = float(np.min(grid.point_data["shown"])), float(np.max(grid.point_data["shown"]))
    if high - low < 1e-9 * max(abs(low), abs(high), 1e-30):
        low, high = low - 0.5, high + 0.5
    axes.imshow(render(grid, (low, high), options.warp))
    times = f", displacements times {options.warp:g}" if options.warp != 1 else ""
    axes.set_title(f"t = {time:.4g} s{times}", pad=10)
    unit = f" [{prefix}{unit_of_field(name)}]" if unit_of_field(name) else ""
    colours = plt.cm.ScalarMappable(plt.Normalize(low, high), COLOUR_MAP)
    bar = figure.colorbar(colours, ax=axes, orientation="horizontal", fraction=0.035, pad=0.05, aspect=32, shrink=0.72)
    bar.set_label(FIELDS.get(name, name.replace("_", " ")) + unit)
    bar.outline.set_visible(False)
    bar.ax.tick_params(length=0)


# ---- the picture -----------------------------------------------------------------------------------------------------


def parse_arguments():
    parser = argparse.ArgumentParser(prog="scripts/plot", description="Draws a run folder as one picture.")
    parser.add_argument("folder", type=pathlib.Path, help="folder of a run, such as results/block")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="picture to write (default: plot.png in that folder)")
    parser.add_argument("--field", help="field that colours the body (default: fibre_stretch, or what there is)")
    parser.add_argument("--time", type=float, help="time of the shape in s (default: the last one saved)")
    parser.add_argument("--warp", type=float, default=1.0, help="displacements are drawn times this (default: 1)")
    parser.add_argument("--dpi", type=int, default=160)
    return parser.parse_args()


def main():
    options = parse_arguments()
    history = read_history(options.folder)
    time = history["time [s]"]
    plt.rcParams.update(STYLE)
    figure = plt.figure(figsize=(11.5, 5.0), layout="constrained")
    figure.get_layout_engine().set(w_pad=0.12, h_pad=0.08)
    left, right = figure.subfigures(1, 2, width_ratios=[1.0, 1.15])
    panels = [
        (reactions(history), "Force of the held boundaries", "N"),
        (energies(history), "Energy and work", "J"),
    ]
    panels = [panel for panel in panels if panel[0]]
    if panels:
        rows = left.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
        for axes, panel in zip(rows, panels):
            draw_curves(axes, time, *panel)
        rows[-1].set_xlabel("time [s]")
    draw_body(right, right.subplots(), options.folder, options)
    figure.suptitle(title_of(options.folder), x=0.012, ha="left", fontsize=13, fontweight="bold")
    facts = facts_of(options.folder)
    if facts:
        figure.text(0.988, 0.965, facts, ha="right", va="center", color="#5b6472", fontsize=8.5)
    output = options.output or options.folder / "plot.png"
    output.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(output, dpi=options.dpi, facecolor="white")
    print(f"[plot] wrote {output}")


if __name__ == "__main__":
    main()
