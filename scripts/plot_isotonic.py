"""After-loaded isotonic contractions at several loads, against Hill's force-velocity curve. Started by scripts/pictures.

Runs configs/muscle/isotonic.toml once for each load. For every step in which the fully active muscle shortens it takes its
velocity, and the active force that the load leaves: F l / A less what the passive tissue carries at that stretch l, over the
isometric force at that stretch. Prints by how much these points miss the curve.
"""
import argparse
import csv
import math
import pathlib
import subprocess

import matplotlib.pyplot as plt
from plot_style import COLOURS, STYLE

TOP = pathlib.Path(__file__).resolve().parent.parent
LOADS = (1, 2, 4, 8, 12, 16)  # [N]
LENGTH, AREA, PEAK, RATE = 0.03, 1e-4, 200e3, 5.0  # [m], [m^2], [Pa], [1/s]
C1, C2 = 39811.19150206686, 73246.69652938298  # of the base [Pa]
ACTIVE_FROM = 0.1  # [s]: activation is 1
# The curves of the law, src/materials/hill_curves.hpp.
SINES = [
    (0.642587074375392, 1.290128342448810, 0.629168420414746),
    (0.325979591577056, 5.308969899884336, -4.520101562237307),
    (0.328204247867325, 6.744187042136006, 1.689155892259429),
    (0.015388902741327, 19.823676877725276, -7.386155292116579),
    (0.139240359517525, 8.038287396059996, 2.543022326676525),
    (0.001801867529599, 32.237736486095052, -6.454098315528945),
    (0.012560837549867, 23.117614057963024, -2.643346778503341),
]


def force_length(stretch):
    return sum(a * math.sin(b * stretch + c) for a, b, c in SINES)


def force_velocity(rate):
    """Shortening only: rate over the largest, negative."""
    if rate < -1.2:
        return 0.0
    if rate < -0.25:
        return (0.25792669408341773 * (rate + 1.2) + 0.14317485143460784) * (rate + 1.2) ** 2
    s = rate + 0.25
    return ((29.825565394304522 * s - 0.9435495605479662) * s + 0.9703687419567255) * s + 0.3503552027590582


def run(titin, scratch, load):
    folder = scratch / f"load_{load}"
    scene = TOP / "configs" / "muscle" / "isotonic.toml"
    command = [titin, "run", scene, f'boundary."x+".rail.force="{load} N"', "-o", folder, "--overwrite", "-q", "output.fields=false"]
    subprocess.run(list(map(str, command)), check=True)
    with open(folder / "history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return [float(row["time [s]"]) for row in rows], [float(row["travel_x+ [m]"]) for row in rows]


def points(load, times, travel):
    """(velocity over the largest, active force over the isometric one) of the steps that shorten at full activation."""
    found = []
    for t_old, t, u_old, u in zip(times, times[1:], travel, travel[1:]):
        stretch, rate = 1 + u / LENGTH, (u - u_old) / LENGTH / (t - t_old) / RATE
        if t_old < ACTIVE_FROM * (1 - 1e-9) or rate > -1e-3:
            continue
        base = 2 * (C1 + 2 * C2 * (stretch**2 + 2 / stretch - 3)) * (stretch**2 - 1 / stretch)
        found.append((rate, (load * stretch / AREA - base) / PEAK / force_length(stretch)))
    return found


def draw(runs, out):
    plt.rcParams.update(STYLE)
    figure, (motion, curve) = plt.subplots(1, 2, figsize=(7.6, 3.2))
    rates = [-1.2 + 1.2 * i / 200 for i in range(201)]
    curve.plot([-r for r in rates], [force_velocity(r) for r in rates], color="0.6", linewidth=3, label="the law")
    for (load, (times, travel)), colour in zip(runs.items(), COLOURS):
        motion.plot([1e3 * t for t in times], [1e3 * u for u in travel], color=colour, label=f"{load} N", linewidth=1.1)
        found = points(load, times, travel)
        curve.plot([-r for r, _ in found], [f for _, f in found], ".", color=colour, markersize=4, label=f"{load} N")
    motion.set_xlabel("time [ms]")
    motion.set_ylabel("travel of the load [mm]")
    motion.legend(fontsize=7)
    curve.set_xlabel("velocity of shortening over the largest")
    curve.set_ylabel("active over isometric force")
    figure.tight_layout()
    figure.savefig(out, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--titin", required=True)
    parser.add_argument("--scratch", type=pathlib.Path, required=True)
    parser.add_argument("-o", "--out", required=True)
    options = parser.parse_args()
    runs = {load: run(options.titin, options.scratch, load) for load in LOADS}
    for load, (times, travel) in runs.items():
        found = points(load, times, travel)
        off = max((abs(force - force_velocity(rate)) for rate, force in found), default=math.nan)
        fastest = max((-rate for rate, _ in found), default=math.nan)
        print(f"{load} N: shortens at up to {fastest:.3f} of the largest rate, ends at {1e3 * travel[-1]:.2f} mm; off the curve by {off:.4f}")
    draw(runs, options.out)


if __name__ == "__main__":
    main()
