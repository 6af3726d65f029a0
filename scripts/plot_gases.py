#!/usr/bin/env python3
"""Keeps what runs of gases gave, says where their shocks are, and draws docs/pictures/gases.png.

    scripts/plot_gases.py keep FOLDER NAME       history of a run -> docs/verification/lagrange/NAME.csv
    scripts/plot_gases.py shock FOLDER LEVEL     place of the shock about the origin at the end, by direction
    scripts/plot_gases.py sedov FOLDER ENERGY NAME   errors of a blast against time -> docs/verification/lagrange/NAME.csv
    scripts/plot_gases.py draw                   docs/verification/lagrange/*.csv -> the picture

The shock is where the pressure falls through LEVEL, seen from outside, in the mean over rings as thick as cells: in the plane in
eight sectors of a quarter, in space in four classes of directions from the axes (first) to the diagonal of the octant (last).
ENERGY of a blast is all of it, around the origin, in J (plane J/m); errors are integrals of |difference| over those of the exact
density and pressure of the moved gas. The exact solution here is integrated outward-in by SciPy from the similarity equations and
shares nothing with the one of src/fv/sedov.hpp. Needs the Python libraries of python_requirements.txt.
"""
import argparse
import json
import pathlib

import matplotlib.pyplot as plt
import numpy as np
import plot_solids
from plot_solids import KEPT_AT, ROOT, kept
from plot_style import COLOURS, STYLE
from scipy.integrate import solve_ivp

plot_solids.KEPT |= dict.fromkeys(
    ["sod", "noh", "saltzman", "sedov", "piston", "explosion"],
    ["energy_total", "energy_kinetic", "work_boundary", "density_max", "cells_limited", "cells_constant"],
)
SECTORS = 8
CLASSES = np.array([0.577, 0.68, 0.79, 0.90, 1.0001])  # of the largest component of a direction


class Cells:
    """Centres, volumes, densities and pressures of a run's cells, and its times."""

    def __init__(self, folder):
        import pyvista as pv

        self.reader = pv.get_reader(str(folder / "fields" / "fields.pvd"))
        self.times = self.reader.time_values

    def at(self, time):
        self.reader.set_active_time_value(time)
        parts = []
        for block in self.reader.read():
            block = block.point_data_to_cell_data() if "pressure" in block.point_data else block
            sizes = block.compute_cell_sizes(length=False)
            volume = np.asarray(sizes["Volume"]) + np.asarray(sizes["Area"])  # the one that it has
            parts.append((block.cell_centers().points, volume, np.asarray(block["density"]), np.asarray(block["pressure"])))
        return [np.concatenate(list(kind)) for kind in zip(*parts)]


def directions(centre):
    r = np.linalg.norm(centre, axis=1)
    if np.ptp(centre[:, 2]) == 0:
        return np.minimum((np.arctan2(centre[:, 1], centre[:, 0]) / (np.pi / 2) * SECTORS).astype(int), SECTORS - 1)
    return len(CLASSES) - 1 - np.digitize(np.abs(centre).max(axis=1) / r, CLASSES)


def fall(r, volume, pressure, level, thickness):
    """Largest radius at which the mean over rings falls through the level, linear between rings."""
    ring = (r / thickness).astype(int)
    weight = np.bincount(ring, volume)
    filled = np.flatnonzero(weight)
    mean = np.bincount(ring, volume * pressure)[filled] / weight[filled]
    middle = np.bincount(ring, volume * r)[filled] / weight[filled]
    last = np.flatnonzero(mean > level)[-1]
    return middle[last] + (mean[last] - level) / (mean[last] - mean[last + 1]) * (middle[last + 1] - middle[last])


def shock(folder, level):
    cells = Cells(folder)
    centre, volume, _, pressure = cells.at(cells.times[-1])
    sector, r = directions(centre), np.linalg.norm(centre, axis=1)
    plane = np.ptp(centre[:, 2]) == 0
    size = np.median(volume) ** (1 / (2 if plane else 3)) * (2**0.5 if plane else 6 ** (1 / 3))
    places = np.array([fall(r[sector == k], volume[sector == k], pressure[sector == k], level, size) for k in range(sector.max() + 1)])
    mean = fall(r, volume, pressure, level, 0.5 * size)
    print(f"{folder.name}: shock at {mean:.4f} m, by direction {', '.join(f'{x:.4f}' for x in places)}; spread {np.ptp(places):.4f} m")


def blast(j, gamma=1.4):
    """Density and pressure over x = r / R, for R = rho_0 = 1 and a shock of speed 1; and alpha.

    R ~ t^(2 / (j + 2)) has R R'' = a R'^2; with u = R' v(x), rho = d(x), p = R'^2 p(x) the equations of the gas are ordinary ones in x."""
    a = 1 - (j + 2) / 2

    def slopes(x, y):
        v, d, p = y
        w = v - x
        # a v + w v' + p'/d = 0;  w d' + d v' = -(j-1) d v / x;  2 a p + w p' + gamma p (v' + (j-1) v / x) = 0
        matrix = [[w, 0, 1 / d], [d, w, 0], [gamma * p, 0, w]]
        right = [-a * v, -(j - 1) * d * v / x, -2 * a * p - gamma * p * (j - 1) * v / x]
        return np.linalg.solve(matrix, right)

    behind = [2 / (gamma + 1), (gamma + 1) / (gamma - 1), 2 / (gamma + 1)]
    inward = solve_ivp(slopes, (1, 0.02), behind, rtol=1e-10, atol=1e-13, dense_output=True, method="LSODA")
    x = np.linspace(0.02, 1, 4001)
    v, d, p = inward.sol(x)
    around = {2: 2 * np.pi, 3: 4 * np.pi}[j]
    core = p[0] / (gamma - 1) * x[0] ** j / j  # of almost uniform pressure, at rest
    alpha = (2 / (j + 2)) ** 2 * around * (core + np.trapezoid((d * v * v / 2 + p / (gamma - 1)) * x ** (j - 1), x))
    return x, d, p, alpha


def sedov(folder, energy, name):
    cells = Cells(folder)
    report = json.loads((folder / "run.json").read_text())
    rows = []
    for time in cells.times[1:]:
        centre, volume, density, pressure = cells.at(time)
        j = 2 if np.ptp(centre[:, 2]) == 0 else 3
        x, d, p, alpha = blast(j)
        R = (energy * time**2 / alpha) ** (1 / (j + 2))
        r, D = np.linalg.norm(centre, axis=1) / R, 2 * R / ((j + 2) * time)
        exact_d, exact_p = np.where(r < 1, np.interp(r, x, d), 1), np.where(r < 1, np.interp(r, x, p), 0) * D * D
        moved = r < 1
        rows.append([time, (volume * abs(density - exact_d)).sum() / (volume * exact_d)[moved].sum(), (volume * abs(pressure - exact_p)).sum() / (volume * exact_p)[moved].sum()])
    with open(KEPT_AT / f"{name}.csv", "w") as file:
        file.write(f"# {report['title']}, errors against time: commit {report['commit']}, {report['cells']} cells, {report['steps']} steps, alpha {alpha:.6f}\n")
        file.write("time [s], density_error, pressure_error\n")
        file.writelines(", ".join(f"{value:.6g}" for value in row) + "\n" for row in rows)
    print(open(KEPT_AT / f"{name}.csv").read())


def draw():
    plt.rcParams.update(STYLE)
    figure, axes = plt.subplots(3, 2, figsize=(9, 9), layout="constrained")
    for place, (kind, title) in zip(axes.flat, [("sod", "Sod's tube"), ("noh", "Noh"), ("saltzman", "Saltzman"), ("sedov", "Sedov"), ("piston", "Piston and echoes")]):
        for k, (name, run) in enumerate(kept(f"{kind}_*.csv")):
            if "cells_limited" not in run:
                continue
            run = {column: values[1:] for column, values in run.items()}  # the start knows no orders yet
            place.plot(run["time"], run["cells_limited"], color=COLOURS[k % len(COLOURS)], linewidth=1, linestyle=(0, (3, 1)), label=f"{name}: limited")
            place.plot(run["time"], run["cells_constant"], color=COLOURS[k % len(COLOURS)], linewidth=1.2, label=f"{name}: constant")
        place.set(title=f"{title}: % of cells that lost an order", xlabel="time [s]", ylim=(0, None))
        place.legend(fontsize=6, frameon=False)
    last = axes.flat[5]
    for colour, (name, run) in zip(COLOURS, kept("blast_*.csv")):
        last.plot(run["time"], 100 * run["density_error"], color=colour, label=f"{name}: density")
        last.plot(run["time"], 100 * run["pressure_error"], color=colour, linestyle=(0, (3, 1)), label=f"{name}: pressure")
    last.set(title="Sedov, Laghos's set-ups: error [%]", xlabel="time [s]", ylim=(0, None))
    last.legend(fontsize=6, frameon=False)
    figure.savefig(ROOT / "docs" / "pictures" / "gases.png", dpi=110)


def main():
    parser = argparse.ArgumentParser(description="Keeps and draws runs of gases.")
    commands = parser.add_subparsers(dest="command", required=True)
    for word, more in (("keep", ["name"]), ("shock", ["level"]), ("sedov", ["energy", "name"]), ("draw", [])):
        one = commands.add_parser(word)
        if more:
            one.add_argument("folder", type=pathlib.Path)
        for argument in more:
            one.add_argument(argument, type=str if argument == "name" else float)
    a = parser.parse_args()
    if a.command == "keep":
        plot_solids.keep(a.folder, a.name)
    elif a.command == "shock":
        shock(a.folder, a.level)
    elif a.command == "sedov":
        sedov(a.folder, a.energy, a.name)
    else:
        draw()


if __name__ == "__main__":
    main()
