#!/usr/bin/env python3
"""Draws docs/pictures/sedov.png from folders of runs of configs/lagrange/sedov.toml, one row for each.

    titin run configs/lagrange/sedov.toml -o results/sedov
    titin run configs/lagrange/sedov.toml fv.order=1 -o results/sedov_first
    scripts/plot_lagrange.py results/sedov results/sedov_first [-o PICTURE]

Left the density of all cells at the end, where they are; right the same against the distance from the origin, with the
place of the shock and the density behind it of Sedov's similarity solution. Needs the Python libraries of
python_requirements.txt.
"""
import argparse
import json
import pathlib

import matplotlib.pyplot as plt
import numpy as np
import pyvista as pv
from plot_style import COLOUR_MAP, COLOURS, FAINT, STYLE

ROOT = pathlib.Path(__file__).resolve().parent.parent
SHOCK_RADIUS = 0.99878  # [m] at 1 s: (E t^2 / (alpha rho))^(1/4), E = 0.979264 J/m, alpha = 0.98407402 (Kamm & Timmes 2007)
DENSITY_BEHIND = 6  # [kg/m^3] (gamma + 1) / (gamma - 1)


def last_fields(folder):
    """Corners [cells, 3, 2] and densities of all cells at the last time."""
    reader = pv.get_reader(str(folder / "fields" / "fields.pvd"))
    reader.set_active_time_value(reader.time_values[-1])
    blocks = reader.read()
    corners, density = [], []
    for block in blocks:
        places = block.cells.reshape(-1, 4)[:, 1:]
        corners.append(np.asarray(block.points)[places][:, :, :2])
        values = np.asarray(block["density"])
        density.append(values[places].mean(axis=1) if len(values) == block.n_points else values)
    return np.concatenate(corners), np.concatenate(density)


def draw(left, right, folder):
    corners, density = last_fields(folder)
    report = json.loads((folder / "run.json").read_text())
    cells = plt.matplotlib.collections.PolyCollection(
        corners, array=np.clip(density, 0, DENSITY_BEHIND), cmap=COLOUR_MAP.reversed(), edgecolors="none", linewidths=0
    )
    left.add_collection(cells)
    left.set(aspect="equal", xlim=(0, 1.2), ylim=(0, 1.2), title=f"{folder.name}: density [kg/m³]", xlabel="x [m]")
    left.figure.colorbar(cells, ax=left, shrink=0.8)
    radius = np.linalg.norm(corners.mean(axis=1), axis=1)
    right.plot(radius, density, ".", markersize=1.5, color=COLOURS[0])
    right.axvline(SHOCK_RADIUS, color=COLOURS[1], linewidth=1)
    right.axhline(DENSITY_BEHIND, color=FAINT, linewidth=1)
    right.set(title=f"{report['steps']} steps; exact shock in red", ylim=(0, 8))
    right.set_xlabel("distance from the origin [m]")


def main():
    parser = argparse.ArgumentParser(description="Draws runs of Sedov's blast.")
    parser.add_argument("folders", type=pathlib.Path, nargs="+")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=ROOT / "docs" / "pictures" / "sedov.png")
    arguments = parser.parse_args()
    plt.rcParams.update(STYLE)
    n = len(arguments.folders)
    figure, axes = plt.subplots(n, 2, figsize=(8.5, 3.6 * n), layout="constrained", squeeze=False)
    for (left, right), folder in zip(axes, arguments.folders):
        draw(left, right, folder)
    figure.savefig(arguments.output, dpi=110)


if __name__ == "__main__":
    main()
