#!/usr/bin/env python3
"""Runs Cook's membrane and a compressed block over Poisson's ratio with several elements and draws how far they give way.

Prints the tables of docs/verification/muscle.md and writes docs/pictures/locking.png. Some minutes.
"""
import argparse
import csv
import dataclasses
import json
import pathlib
import subprocess
import sys
import tempfile

import matplotlib.pyplot as plt
from plot_style import COLOURS, INK, STYLE

ROOT = pathlib.Path(__file__).resolve().parent.parent
SHEAR_MODULUS = 80.1938e6  # Pa, as in the scenes
RATIOS = (0.3, 0.4, 0.45, 0.49, 0.499, 0.4999, 0.49999)


@dataclasses.dataclass
class Problem:
    scene: str
    title: str
    marker: str
    sign: int
    converged: tuple  # mesh, refinements (two cells along an edge at first), element, order
    load: list  # that of the picture: small, so that linear theory holds and few iterations are enough
    elements: dict


QUADS, TRIANGLES = "cook_quadrilaterals.msh", "cook_triangles.msh"
HEXAHEDRA, TETRAHEDRA = "compressed_block_hexahedra.msh", "compressed_block_tetrahedra.msh"
PROBLEMS = [
    Problem(
        "cook", "Cook's membrane: deflection of the tip", "marker_tip_uy [m]", 1, (QUADS, 4, "three_field", 2), ["time.step=1 s", "boundary.right.traction=0, 0.625 MPa"], {
        "Q2/P1, 8 x 8": (QUADS, 2, "three_field", 2),
        "P2+/P1, 2 x 16 x 16": (TRIANGLES, 3, "three_field", 2),
        "Q1/P0, 32 x 32": (QUADS, 4, "three_field", 1),
        "Q2 alone, 8 x 8": (QUADS, 2, "displacement", 2),
        "Q1 alone, 16 x 16": (QUADS, 3, "displacement", 1),
        "P1 alone, 2 x 16 x 16": (TRIANGLES, 3, "displacement", 1),
    }),
    Problem("compressed_block", "Compressed block: how far its top sinks", "marker_centre_uz [m]", -1, (HEXAHEDRA, 2, "three_field", 2), ["time.step=1 s", "boundary.loaded.traction=0, 0, -1.6 MPa"], {
        "Q2/P1, 4 x 4 x 4": (HEXAHEDRA, 1, "three_field", 2),
        "P2+/P1, 6 x 4 x 4 x 4": (TETRAHEDRA, 1, "three_field", 2),
        "Q1/P0, 8 x 8 x 8": (HEXAHEDRA, 2, "three_field", 1),
        "Q2 alone, 4 x 4 x 4": (HEXAHEDRA, 1, "displacement", 2),
        "Q1 alone, 8 x 8 x 8": (HEXAHEDRA, 2, "displacement", 1),
        "P1 alone, 6 x 8 x 8 x 8": (TETRAHEDRA, 2, "displacement", 1),
    }),
]  # fmt: skip


def deflection(titin, problem, ratio, mesh, refine, element, order):
    bulk = SHEAR_MODULUS * 2 * (1 + ratio) / (3 * (1 - 2 * ratio))
    with tempfile.TemporaryDirectory() as folder:
        command = [
            titin, "run", str(ROOT / f"configs/muscle/{problem.scene}.toml"), "-o", folder + "/run", "-q",
            f'mesh.file="{ROOT}/meshes/{mesh}"', f"mesh.refine={refine}", f"muscle.element={element}",
            f"muscle.order={order}", "output.fields=false", f'materials.rubber.volumetric.bulk_modulus="{bulk} Pa"',
            *problem.load,
        ]  # fmt: skip
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        if json.loads(pathlib.Path(folder, "run/run.json").read_text())["status"] != "finished":
            sys.exit("plot_locking: a run did not finish: " + " ".join(command))
        with open(folder + "/run/history.csv", newline="") as file:
            return 1e3 * problem.sign * float(list(csv.DictReader(file))[-1][problem.marker])


def table(problem, converged, curves):
    print(f"| {problem.title} | " + " | ".join(str(r) for r in RATIOS) + " |\n|---" + "|---" * len(RATIOS) + "|")
    print("| converged | " + " | ".join(f"{c:.4g} mm" for c in converged) + " |")
    for name, values in curves.items():
        print(f"| {name} | " + " | ".join(f"{100 * (v / c - 1):+.1f} %" for v, c in zip(values, converged)) + " |")
    print(flush=True)


def draw(axes, problem, converged, curves):
    x = [0.5 - r for r in RATIOS]
    axes.fill_between(x, [0.99 * c for c in converged], [1.01 * c for c in converged], color=INK, alpha=0.18, linewidth=0, label="converged, 1 % either side")
    for (name, values), colour, style in zip(curves.items(), COLOURS, ["-", "-", "-", "--", "--", "--"]):
        axes.plot(x, values, style, marker="o", markersize=3.5, color=colour, label=name)
    axes.set(xscale="log", xlabel="0.5 - Poisson's ratio", title=f"{problem.title} [mm]", ylim=(0, None))
    axes.invert_xaxis()
    axes.legend(frameon=False, fontsize=7.5, loc="lower left")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--titin", default=str(ROOT / "build/bin/titin"), help="the program")
    parser.add_argument("-o", default=ROOT / "docs/pictures/locking.png", help="the picture")
    args = parser.parse_args()
    plt.rcParams.update(STYLE)
    figure, panels = plt.subplots(1, len(PROBLEMS), figsize=(10, 4.2))
    for problem, axes in zip(PROBLEMS, panels):
        converged = [deflection(args.titin, problem, r, *problem.converged) for r in RATIOS]
        curves = {name: [deflection(args.titin, problem, r, *e) for r in RATIOS] for name, e in problem.elements.items()}
        table(problem, converged, curves)
        draw(axes, problem, converged, curves)
    figure.tight_layout()
    figure.savefig(args.o, dpi=130)


if __name__ == "__main__":
    main()
