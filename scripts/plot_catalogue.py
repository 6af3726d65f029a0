"""Draws every law of the registry in one picture: stress against stretch from the point driver. Started by
scripts/pictures.

Parameters are the first published set of a law, else those of configs/point/examples.toml, which are made up
and said to be so.
"""
import argparse
import csv
import io
import json
import pathlib
import subprocess
import sys
import tempfile
import tomllib

import matplotlib.pyplot as plt
import numpy as np
from plot_style import COLOURS, FAINT, INK, STYLE, name_ends, prefixed

ROOT = pathlib.Path(__file__).resolve().parent.parent
EXAMPLES = tomllib.loads((ROOT / "configs/point/examples.toml").read_text())["examples"]
KINDS = ["matrix", "fibre", "active"]  # volumetric functions share one panel; fluids have no stretch
COLUMNS = 5
STEPS = 60
STEEPEST = 14  # a curve ends where it is this many times its value half-way,
SLACK = 300  # unless it is so much more that a fibre has become taut in between
HIGHEST = 2.5  # times the curve along one axis (or along the fibres): others are cut off there
SHEARS = {"blemker_shear"}  # laws that an extension along the fibres does not see


class Point:
    def __init__(self, program, folder):
        self.program, self.folder = program, pathlib.Path(folder)

    def columns(self, scene, *words):
        """Columns by name; those before a step that found no equilibrium."""
        path = self.folder / "scene.toml"
        path.write_text(scene)
        result = subprocess.run([self.program, str(path), *words], capture_output=True, text=True)
        if result.returncode not in (0, 2):
            sys.exit(f"plot: {result.stderr}{scene}")
        rows = list(csv.reader(io.StringIO(result.stdout)))
        values = np.array(rows[1:], dtype=float)
        return {head.split(" [")[0]: values[:, k] for k, head in enumerate(rows[0])}


def scene_of(law, parameters, fibre="[1, 0, 0]", second="[0, 1, 0]", volumetric="simo"):
    """The law with a matrix as soft as can be, so that fibres alone have sides that resist."""
    return f"""[materials.m]
density = "1000 kg/m^3"
fibre = {fibre}
second_fibre = {second}
volumetric = {{ law = "{volumetric}", bulk_modulus = "1 MPa" }}
[materials.m.terms]
softest = {{ law = "neo_hookean", mu = "0.1 Pa" }}
law = {{ law = "{law}", {parameters} }}
[point]
fibre_rate = "none"
volume = "incompressible"
steps = {STEPS}
"""


def both_ways(point, scene, low, high, loading):
    """Stress against stretch in tension and in compression, each as far as it is worth showing."""
    parts = []
    for end in (low, high):
        if end == 1:
            continue
        found = point.columns(scene, f"point.loading={loading}", f"point.stretch={end}")
        stretch, stress = found["F_xx"], found["P_xx"]
        middle = np.interp(0.5 * (stretch - 1) + 1, *(a if end > 1 else a[::-1] for a in (stretch, stress)))
        times = np.abs(stress) / np.maximum(np.abs(middle), 1e-300)
        steep = np.flatnonzero((times > STEEPEST) & (times < SLACK) & (np.abs(stretch - 1) > 0.02))
        keep = steep[0] if len(steep) else len(stretch)
        parts.append((stretch[:keep], stress[:keep]))
    if len(parts) == 2:
        (x0, y0), (x1, y1) = parts
        return np.concatenate([x0[::-1], x1[1:]]), np.concatenate([y0[::-1], y1[1:]])
    return parts[0]


def curves_of(point, law, parameters):
    if law["kind"] == "matrix":
        scene = scene_of(law["name"], parameters)
        loadings = {"uniaxial": "one axis", "planar": "plane", "equibiaxial": "two axes"}
        return {name: both_ways(point, scene, 0.75, 1.6, loading) for loading, name in loadings.items()}
    if law["kind"] == "active":
        return {"along": both_ways(point, scene_of(law["name"], parameters), 0.45, 1.75, "uniaxial")}
    along, across = (scene_of(law["name"], parameters, *d) for d in (("[1, 0, 0]", "[0, 1, 0]"), ("[0, 1, 0]", "[1, 0, 0]")))
    if law["name"] in SHEARS:
        return {"along": sheared(point, along, "xy"), "across": sheared(point, along, "yz")}
    high = 1.9 if law["name"] == "blemker_passive" else 1.6  # its optimal length is 1.4
    return {"along": both_ways(point, along, 0.85, high, "uniaxial"), "across": both_ways(point, across, 0.85, high, "uniaxial")}


def sheared(point, scene, plane):
    found = point.columns(scene, "point.loading=simple_shear", f"point.plane={plane}", "point.shear=0.6")
    return found[f"F_{plane}"], found[f"P_{plane}"]


def common_range(curves):
    """Stretches at which the steepest curve of a panel still fits."""
    return max(x[0] for x, _ in curves.values()), min(x[-1] for x, _ in curves.values())


def draw_law(axes, point, law, colours):
    published = law["published"][0] if law["published"] else None
    parameters = published["parameters"] if published else EXAMPLES.get(law["name"])
    if not parameters:
        sys.exit(f"plot: {law['name']} has no published parameters: add some to configs/point/examples.toml")
    curves = curves_of(point, law, parameters)
    low, high = common_range(curves)
    shown = {name: (x[(x >= low) & (x <= high)], y[(x >= low) & (x <= high)]) for name, (x, y) in curves.items()}
    factor, prefix = prefixed([y for _, y in shown.values()])
    first = next(iter(shown.values()))[1]
    for name, (x, y) in shown.items():
        axes.plot(x, factor * y, color=colours[name], linewidth=1.6, solid_capstyle="round")
    if law["name"] not in SHEARS:
        bottom, top = axes.get_ylim()
        axes.set_ylim(max(bottom, HIGHEST * factor * min(np.min(first), -0.1 * np.max(first))), min(top, HIGHEST * factor * np.max(first)))
    note = published["tissue"] if published else "example values"
    note = f"simple shear, {note}" if law["name"] in SHEARS else note
    dress(axes, law["name"], note, f"{prefix}Pa", italic=not published, rest=0 if law["name"] in SHEARS else 1)


def draw_volumetric(axes, point, names):
    ends = {}
    for name, colour in zip(names, COLOURS):
        scene = scene_of("neo_hookean", 'mu = "0.1 Pa"', volumetric=name).replace("incompressible", "compressible")
        side = 'F = {{ {} }}'.format(", ".join(f'{c} = {{ time = "0, 1 s", value = [0.75, 1.3] }}' for c in ("xx", "yy", "zz")))
        found = point.columns(scene + 'loading = "components"\n' + side)
        axes.plot(found["J"], -found["pressure"] / 1e6, color=colour, linewidth=1.6)
        ends[name] = -found["pressure"][-1] / 1e6
    dress(axes, "volumetric", "mean stress over bulk modulus against J", "")
    name_ends(axes, found["J"][-1], ends, COLOURS, gap=0.1)


def dress(axes, name, note, unit, italic=False, rest=1):
    axes.axhline(0, color=FAINT, linewidth=0.7)
    axes.axvline(rest, color=FAINT, linewidth=0.7)
    axes.set_title(name, fontsize=9, pad=14)
    axes.text(0, 1.03, note if len(note) < 40 else note[:38] + "…", transform=axes.transAxes, fontsize=7, color="#5b6472",
              style="italic" if italic else "normal", va="bottom")  # fmt: skip
    if unit:
        axes.text(0.03, 0.94, unit, transform=axes.transAxes, fontsize=7.5, color=INK, va="top")
    axes.tick_params(length=2, labelsize=7, pad=2)
    axes.locator_params(nbins=4)
    axes.margins(x=0.02)


def main():
    parser = argparse.ArgumentParser(prog="plot_catalogue.py")
    parser.add_argument("--program", default=str(ROOT / "build/bin/material_point"))
    parser.add_argument("--titin", default=str(ROOT / "build/bin/titin"), help="lists the laws")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    options = parser.parse_args()
    listed = subprocess.run([options.titin, "materials", "--json"], capture_output=True, text=True, check=True)
    laws = json.loads(listed.stdout)
    solids = sorted((law for law in laws if law["kind"] in KINDS), key=lambda law: (KINDS.index(law["kind"]), law["name"]))
    volumetric = [law["name"] for law in laws if law["kind"] == "volumetric"]
    plt.rcParams.update(STYLE | {"axes.linewidth": 0.6})
    rows = -(-(len(solids) + 1) // COLUMNS)
    figure, grid = plt.subplots(rows, COLUMNS, figsize=(2.45 * COLUMNS, 1.95 * rows + 0.6), layout="constrained")
    figure.get_layout_engine().set(w_pad=0.05, h_pad=0.05, hspace=0.04, wspace=0.03)
    colours = dict(zip(("one axis", "two axes", "plane", "along", "across"), (*COLOURS[:3], COLOURS[0], COLOURS[1])))
    with tempfile.TemporaryDirectory() as folder:
        point = Point(options.program, folder)
        for axes, law in zip(grid.flat, solids):
            draw_law(axes, point, law, colours)
        draw_volumetric(grid.flat[len(solids)], point, volumetric)
    for axes in grid.flat[len(solids) + 1 :]:
        axes.axis("off")
    figure.suptitle(" \n ", fontsize=14)  # room
    figure.text(0.008, 0.994, "The catalogue of laws", fontsize=14, fontweight="bold", va="top")
    figure.text(0.008, 0.974, "First Piola stress against stretch of an incompressible point", fontsize=9.5, color="#5b6472", va="top")
    keys = [("one axis, or along the fibres", 0), ("two axes, or across the fibres", 1), ("one axis, the other held", 2)]
    handles = [plt.Line2D([], [], color=COLOURS[k], linewidth=2, label=text) for text, k in keys]
    figure.legend(handles=handles, loc="upper right", ncols=3, frameon=False, fontsize=8.5, bbox_to_anchor=(0.995, 0.985))
    figure.savefig(options.output, dpi=115, facecolor="white")
    print(f"[plot] wrote {options.output}")


if __name__ == "__main__":
    main()
