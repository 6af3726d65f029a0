#!/usr/bin/env python3
"""Keeps what runs of solids gave, and draws docs/pictures/solids.png from it.

    scripts/plot_solids.py keep FOLDER NAME      results of a run -> docs/verification/lagrange/NAME.csv
    scripts/plot_solids.py draw                  docs/verification/lagrange/*.csv and references -> the picture

A kept history has some 200 rows and the columns of KEPT; of Blake's cavity the cells' pressure and radial deviator at the end
are kept instead. The first line says which commit made it, with how many cells, steps and CPU-seconds. Needs the Python
libraries of python_requirements.txt.
"""
import argparse
import csv
import json
import math
import pathlib
import re

import matplotlib.pyplot as plt
import numpy as np
from plot_style import COLOURS, FAINT, INK, STYLE

ROOT = pathlib.Path(__file__).resolve().parent.parent
KEPT_AT = ROOT / "docs" / "verification" / "lagrange"
REFERENCES = ROOT / "tests" / "data" / "lagrange"
ROWS = 200
KEPT = {
    "plate": ["marker_centre_uy", "marker_tip_uy", "energy_total", "energy_heat", "cells_limited", "cells_constant"],
    "column": ["marker_tip_uz", "energy_total", "energy_kinetic", "energy_heat", "cells_limited", "cells_constant"],
    "bar": ["marker_top_uz", "marker_bottom_uz", "z_min", "momentum_z", "energy_total", "energy_heat", "force_z-_z", "cells_constant"],
    "block": ["angular_momentum_x", "angular_momentum_y", "angular_momentum_z", "energy_total", "energy_kinetic", "energy_heat", "marker_foot_ux", "marker_foot_uy", "marker_foot_uz"],
    "droplet": ["x_max", "y_max", "energy_total", "energy_heat", "cells_limited", "cells_constant"],
}  # fmt: skip


def table(path):
    """Columns of a CSV by name, without units; lines that begin with # are left out."""
    with open(path, newline="") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    names = [re.sub(r" \[.*", "", name.strip()) for name in rows[0]]
    values = np.array(rows[1:], dtype=float)
    return {name: values[:, k] for k, name in enumerate(names)}, [name.strip() for name in rows[0]]


def keep_history(folder, kind):
    columns, titles = table(folder / "history.csv")
    every = max(1, math.ceil(len(columns["time"]) / ROWS))
    rows = sorted({*range(0, len(columns["time"]), every), len(columns["time"]) - 1})
    wanted = ["time"] + KEPT[kind]
    head = [title for name in wanted for title in titles if re.sub(r" \[.*", "", title) == name]
    return head, [[columns[name][row] for name in wanted] for row in rows]


def keep_profile(folder):
    """Distance, pressure and radial deviator of every cell at the end."""
    import pyvista as pv

    reader = pv.get_reader(str(folder / "fields" / "fields.pvd"))
    reader.set_active_time_value(reader.time_values[-1])
    rows = []
    for block in reader.read():
        block = block.point_data_to_cell_data() if "pressure" in block.point_data else block
        centre = block.cell_centers().points
        r = np.linalg.norm(centre, axis=1)
        n = centre / r[:, None]
        T = np.asarray(block["cauchy_stress"])  # xx, yy, zz, xy, yz, xz
        along = (T[:, :3] * n**2).sum(axis=1) + 2 * (T[:, 3] * n[:, 0] * n[:, 1] + T[:, 4] * n[:, 1] * n[:, 2] + T[:, 5] * n[:, 0] * n[:, 2])
        p = np.asarray(block["pressure"])
        rows += [list(row) for row in zip(r, p, along + p)]
    return ["radius [m]", "pressure [Pa]", "radial_deviator [Pa]"], sorted(rows)


def keep(folder, name):
    report = json.loads((folder / "run.json").read_text())
    kind = name.split("_")[0]
    head, rows = keep_profile(folder) if kind == "blake" else keep_history(folder, kind)
    KEPT_AT.mkdir(parents=True, exist_ok=True)
    with open(KEPT_AT / f"{name}.csv", "w") as file:
        file.write(
            f"# {report['title']}: commit {report['commit']}, {report['cells']} cells, {report['steps']} steps, "
            f"{report['ranks']} rank(s), {report['cpu_seconds']:.0f} CPU-seconds, energy kept to {report['conservation']['energy_error']:.0e}\n"
        )
        file.write(", ".join(head) + "\n")
        for row in rows:
            file.write(", ".join(f"{x:.6g}" for x in row) + "\n")


def kept(pattern):
    for path in sorted(KEPT_AT.glob(pattern), key=lambda p: [int(x) if x.isdigit() else x for x in re.split(r"(\d+)", p.stem)]):
        yield path.stem.split("_", 1)[1].replace("_", " "), table(path)[0]


def lines(axes, pattern, column, scale, x_scale, reference=None, reference_column=None):
    for colour, (name, run) in zip(COLOURS, kept(pattern)):
        axes.plot(run["time"] * x_scale, run[column] * scale, color=colour, linewidth=1.3, label=name)
    if reference:
        other = table(REFERENCES / reference)[0]
        axes.plot(other["time"] * x_scale, other[reference_column or column] * scale, color=INK, linewidth=0.9, linestyle=(0, (4, 2)), label="finite elements")
    axes.legend(fontsize=7, frameon=False)


def blake_exact(r, t=1.6e-4, p0=1e6, r0=0.1, nu=0.25, E=62.5e9, rho=3000):
    """Pressure and radial deviator; formulas in src/mesh/exact_motion.hpp, strains by differences."""
    mu, lam = E / (2 * (1 + nu)), E * nu / ((1 + nu) * (1 - 2 * nu))
    c = math.sqrt((lam + 2 * mu) / rho)
    n, b = (1 - 2 * nu) / (1 - nu) * c / r0, math.sqrt(1 - 2 * nu) / (1 - nu) * c / r0
    q = n * n + b * b

    def u(r):
        s = t - (r - r0) / c
        value = r0 * p0 / (rho * q * r**2) * (1 - np.exp(-n * s) * (np.cos(b * s) - (q * r / c - n) / b * np.sin(b * s)))
        return np.where(s > 0, value, 0)

    h = 1e-6
    e_rr, e_tt = (u(r + h) - u(r - h)) / (2 * h), u(r) / r
    return -(lam + 2 * mu / 3) * (e_rr + 2 * e_tt), 4 / 3 * mu * (e_rr - e_tt)


def draw_blake(pressure, deviator):
    r = np.linspace(0.1, 1, 1500)
    exact = blake_exact(r)
    for axes, column, values, title in ((pressure, "pressure", exact[0], "Blake: pressure"), (deviator, "radial_deviator", exact[1], "Blake: radial deviator")):
        for colour, (name, run) in zip(COLOURS, kept("blake_*.csv")):
            axes.plot(run["radius"], run[column] / 1e3, ".", markersize=1.8, color=colour, label=f"{name} cells")
        axes.plot(r, values / 1e3, color=INK, linewidth=0.8, label="exact")
        axes.set(title=f"{title} [kPa]", xlabel="radius [m]")
        axes.legend(fontsize=7, frameon=False, markerscale=4)
    pressure.set_ylim(-40, 70)
    deviator.set_ylim(-100, 20)


def draw_block(axes):
    for colour, (name, run) in zip(COLOURS, kept("block_*.csv")):
        L = np.stack([run[f"angular_momentum_{a}"] for a in "xyz"], axis=1)
        free = np.argmax(run["time"] >= 5)
        drift = np.linalg.norm(L - L[free], axis=1) / np.linalg.norm(L[free])
        axes.plot(run["time"][free:], 100 * drift[free:], color=colour, label=f"{name}")
    axes.set(title="L-shaped block: angular momentum lost [%]", xlabel="time [s]")
    axes.legend(fontsize=7, frameon=False)


def draw():
    plt.rcParams.update(STYLE)
    figure, axes = plt.subplots(4, 2, figsize=(9, 12.5), layout="constrained")
    lines(axes[0][0], "plate_*.csv", "marker_centre_uy", 1e3, 1e6, "beryllium_plate.csv")
    axes[0][0].set(title="Beryllium plate: centre [mm]", xlabel="time [µs]", xlim=(0, 31))
    lines(axes[0][1], "column_*.csv", "marker_tip_uz", 1, 1, "twisting_column.csv")
    axes[0][1].set(title="Twisting column: tip [m]", xlabel="time [s]")
    lines(axes[1][0], "bar_*.csv", "marker_top_uz", 1e3, 1e6, "hollow_bar.csv")
    axes[1][0].set(title="Hollow bar: upper end [mm]", xlabel="time [µs]")
    lines(axes[1][1], "bar_*.csv", "marker_bottom_uz", 1e3, 1e6, "hollow_bar.csv")
    axes[1][1].set(title="Hollow bar: lower end [mm]", xlabel="time [µs]")
    draw_blake(axes[2][0], axes[2][1])
    draw_block(axes[3][0])
    for colour, (name, run) in zip(COLOURS, kept("droplet_*.csv")):
        axes[3][1].plot(run["time"] * 1e3, run["x_max"] / 6.1e-3, color=colour, label=name)
    axes[3][1].axhline(1, color=FAINT, linewidth=0.8)
    axes[3][1].set(title="Jelly droplet: width over the first one", xlabel="time [ms]")
    axes[3][1].legend(fontsize=7, frameon=False)
    figure.savefig(ROOT / "docs" / "pictures" / "solids.png", dpi=110)


def main():
    parser = argparse.ArgumentParser(description="Keeps and draws runs of solids.")
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("keep")
    one.add_argument("folder", type=pathlib.Path)
    one.add_argument("name")
    commands.add_parser("draw")
    arguments = parser.parse_args()
    if arguments.command == "keep":
        keep(arguments.folder, arguments.name)
    else:
        draw()


if __name__ == "__main__":
    main()
