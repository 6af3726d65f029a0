"""Draws what material_point wrote: stresses and energies, term by term, against stretch or against time. Started by
scripts/plot.
"""
import argparse
import csv
import pathlib
import re
import sys

import matplotlib.pyplot as plt
import numpy as np
from plot_style import COLOURS, FAINT, INK, STYLE, draw_curves, name_ends, prefixed

SHEARS = ["xy", "xz", "yx", "yz", "zx", "zy"]
SMALL = 0.005  # curves below this part of the largest one are left out


def fail(message):
    sys.exit(f"plot: {message}")


class Experiment:
    """Columns by name without unit, and the component of stress that was driven."""

    def __init__(self, path):
        with open(path, newline="") as file:
            rows = list(csv.reader(file))
        if len(rows) < 2 or "F_xx" not in rows[0]:
            fail(f"{path} was not written by material_point")
        values = np.array(rows[1:], dtype=float)
        self.columns = {head.split(" [")[0]: values[:, k] for k, head in enumerate(rows[0])}
        self.name = pathlib.Path(path).stem.replace("_", " ")
        driven = [m.group(1) for head in rows[0] if (m := re.fullmatch(r"P_([xyz]{2}|shear)_\w+ \[Pa\]", head))]
        self.driven = driven[0] if driven else "xx"

    def __getitem__(self, name):
        return self.columns[name]

    def strain(self):
        return self[f"F_{self.driven}"]

    def strain_name(self):
        kind = "stretch" if self.driven[0] == self.driven[1] else "amount of shear"
        return f"{kind} F$_{{{self.driven}}}$"

    def is_ramp(self):
        """Goes one way, and nothing is held."""
        steps = np.diff(self.strain())
        return len(steps) > 0 and (np.all(steps > 0) or np.all(steps < 0))

    def stresses(self):
        found = {"whole": self[f"P_{self.driven}"]}
        head = f"P_{self.driven}_"
        parts = {name[len(head) :].replace("_", " "): v for name, v in self.columns.items() if name.startswith(head)}
        if len(parts) > 1:
            found |= parts
            found["of the pressure"] = found["whole"] - sum(parts.values())
        return kept(found)

    def energies(self):
        found = {"stored": self["energy"]}
        for name, values in self.columns.items():
            match = re.fullmatch(r"(energy|work|dissipation)_(.+)", name)
            if match:
                kind, term = match.group(1), match.group(2).replace("_", " ")
                found[{"energy": term, "work": f"work of {term}", "dissipation": f"dissipated, {term}"}[kind]] = values
        found["work"] = self["work"]
        alike = 0.01 * np.max(np.abs(found["stored"]))
        for name in [n for n in found if n != "stored" and np.allclose(found[n], found["stored"], rtol=0, atol=alike)]:
            found.pop(name)
        return kept(found)


def kept(curves):
    largest = max(np.max(np.abs(v)) for v in curves.values())
    return {name: v for name, v in curves.items() if np.max(np.abs(v)) > SMALL * largest} or curves


def draw_ramp(one, figure):
    left, right = figure.subplots(1, 2)
    draw_curves(left, one.strain(), one.stresses(), f"First Piola stress P$_{{{one.driven}}}$", "Pa")
    draw_curves(right, one.strain(), one.energies(), "Energy per reference volume", "J/m$^3$")
    for axes in (left, right):
        axes.set_xlabel(one.strain_name())


def draw_course(one, figure):
    """In time, and as a loop."""
    left, right = figure.subfigures(1, 2, width_ratios=[1.25, 1])
    rows = left.subplots(3, 1, sharex=True)
    draw_curves(rows[0], one["time"], {"": one.strain()}, one.strain_name()[0].upper() + one.strain_name()[1:], "")
    rows[0].set_title(rows[0].get_title(loc="left").replace(" []", ""))
    rows[0].lines[0].remove()  # zero is far from a stretch
    rows[0].relim(), rows[0].autoscale_view()
    draw_curves(rows[1], one["time"], one.stresses(), f"First Piola stress P$_{{{one.driven}}}$", "Pa", gap=0.13)
    draw_curves(rows[2], one["time"], one.energies(), "Energy per reference volume", "J/m$^3$", gap=0.13)
    rows[2].set_xlabel("time [s]")
    axes = right.subplots()
    factor, prefix = prefixed([one[f"P_{one.driven}"]])
    axes.set_title(f"P$_{{{one.driven}}}$ [{prefix}Pa] against {one.strain_name()}")
    axes.plot(one.strain(), factor * one[f"P_{one.driven}"], color=COLOURS[0], linewidth=1.8)
    axes.plot(one.strain()[0], factor * one[f"P_{one.driven}"][0], "o", color=COLOURS[0], markersize=4)
    axes.set_xlabel(one.strain_name())


def draw_planes(one, figure):
    axes = figure.subplots()
    factor, prefix = prefixed([one["P_" + s] for s in SHEARS])
    ends = {}
    for k, shear in enumerate(SHEARS):
        rows = one["plane"] == k + 1
        stress = factor * one["P_" + shear][rows]
        axes.plot(one["F_" + shear][rows], stress, color=COLOURS[k], linewidth=1.8)
        ends[shear] = stress[-1]
    axes.margins(x=0)
    name_ends(axes, axes.get_xlim()[1], ends, COLOURS, gap=0.05)
    axes.set_title(f"First Piola stress of six shears [{prefix}Pa]")
    axes.set_xlabel("amount of shear")


def draw_several(all_of_them, figure):
    axes = figure.subplots()
    in_time = not all(one.is_ramp() for one in all_of_them)
    factor, prefix = prefixed([one[f"P_{one.driven}"] for one in all_of_them])
    for colour, one in zip(COLOURS * 3, all_of_them):
        x = one["time"] if in_time else one.strain()
        axes.plot(x, factor * one[f"P_{one.driven}"], color=colour, linewidth=1.8, label=one.name)
    axes.axhline(0, color=FAINT, linewidth=0.8)
    axes.set_title(f"First Piola stress P$_{{{all_of_them[0].driven}}}$ [{prefix}Pa]")
    axes.set_xlabel("time [s]" if in_time else all_of_them[0].strain_name())
    axes.legend(frameon=False, labelcolor=INK)


def main():
    parser = argparse.ArgumentParser(prog="scripts/plot", description="Draws what material_point wrote.")
    parser.add_argument("files", type=pathlib.Path, nargs="+", metavar="FILE.csv")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="picture to write (default: beside the first file)")
    parser.add_argument("--title", help="heads the picture (default: the name of the file)")
    parser.add_argument("--dpi", type=int, default=160)
    options = parser.parse_args()
    experiments = [Experiment(path) for path in options.files]
    first = experiments[0]
    plt.rcParams.update(STYLE)
    alone = len(experiments) == 1
    course = alone and "plane" not in first.columns and not first.is_ramp()
    size = (11.5, 5.6) if course else (9.5, 3.9) if alone and "plane" not in first.columns else (6.2, 4.2)
    figure = plt.figure(figsize=size, layout="constrained")
    figure.get_layout_engine().set(w_pad=0.1, h_pad=0.08)
    if not alone:
        draw_several(experiments, figure)
    elif "plane" in first.columns:
        draw_planes(first, figure)
    elif course:
        draw_course(first, figure)
    else:
        draw_ramp(first, figure)
    figure.suptitle(options.title or first.name.capitalize(), x=0.012, ha="left", fontsize=13, fontweight="bold")
    output = options.output or options.files[0].with_suffix(".png")
    figure.savefig(output, dpi=options.dpi, facecolor="white")
    print(f"[plot] wrote {output}")


if __name__ == "__main__":
    main()
