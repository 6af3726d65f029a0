"""Draws several runs into one picture: a panel for each column of history.csv that they share and that differs or moves most.
Started by scripts/plot with more than one run folder.
"""
import argparse
import pathlib
import re
import sys

import matplotlib.pyplot as plt
import numpy as np
from plot_run import fail, read_history, title_of
from plot_style import COLOURS, FAINT, STYLE, prefixed_unit

# Columns worth a panel without being asked for, best first, and how many of each kind.
USUAL = [(r"reaction_.+|force_.+", 2), (r"marker_.+", 1), (r"energy_(total|stored|elastic|kinetic)", 1), (r"mean_stretch.*", 1), (r"volume", 1)]
PANELS = 6


def split_unit(column):
    found = re.fullmatch(r"(.*?)(?: \[(.*)\])?", column)
    return found[1], found[2] or ""


def span(runs, column):
    values = np.concatenate([history[column] for history in runs.values()])
    return np.max(values) - np.min(values)


def usual_columns(runs, shared):
    """Of each kind those that move most, in the unit that they share."""
    chosen = []
    for pattern, number in USUAL:
        of_kind = [column for column in shared if re.fullmatch(pattern, split_unit(column)[0]) and span(runs, column) > 0]
        chosen += sorted(of_kind, key=lambda column: -span(runs, column))[:number]
    return (chosen or [column for column in shared if span(runs, column) > 0])[:PANELS]


def wanted_columns(names, shared):
    chosen = []
    for name in names:
        found = [column for column in shared if name in (column, split_unit(column)[0])]
        if not found:
            fail(f"not all of these runs have a column {name}; they share {', '.join(shared)}")
        chosen += found
    return chosen


def labels_of(folders):
    """Titles where they differ, else the names of the folders."""
    titles = [title_of(folder) for folder in folders]
    names = [str(folder) for folder in folders]
    short = [folder.resolve().name for folder in folders]
    return titles if len(set(titles)) == len(titles) else short if len(set(short)) == len(short) else names


def draw(axes, runs, column):
    name, unit = split_unit(column)
    factor, unit = prefixed_unit([history[column] for history in runs.values()], unit)
    axes.set_title(name.replace("_", " ") + (f" [{unit}]" if unit else ""))
    for number, (label, history) in enumerate(runs.items()):
        colour, dashes = COLOURS[number % len(COLOURS)], (None, None) if number < len(COLOURS) else (4, 2)
        axes.plot(history["time [s]"], history[column] * factor, color=colour, dashes=dashes, linewidth=1.6, label=label)
    axes.margins(x=0.0, y=0.08)
    axes.tick_params(length=3)
    low, high = axes.get_ylim()
    if low < 0 < high:
        axes.axhline(0, color=FAINT, linewidth=0.8, zorder=0)


def print_differences(runs, columns):
    """How far each run is from the first: the largest difference over the largest value of the first."""
    first_name, first = next(iter(runs.items()))
    for label, history in list(runs.items())[1:]:
        for column in columns:
            there = np.interp(first["time [s]"], history["time [s]"], history[column])
            common = first["time [s]"] <= history["time [s]"][-1]
            scale = np.max(np.abs(first[column])) or 1
            largest = np.max(np.abs(there - first[column])[common]) / scale
            print(f"[plot] {column}: {label} differs from {first_name} by {largest:.2e} of its largest value")


def parse_arguments():
    parser = argparse.ArgumentParser(prog="scripts/plot", description="Draws the histories of several runs into one picture.")
    parser.add_argument("folders", nargs="+", type=pathlib.Path, help="folders of runs")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="picture to write (default: compared.png in the first folder)")
    parser.add_argument("--columns", nargs="+", default=[], help="columns of history.csv, with or without their units (default: the usual)")
    parser.add_argument("--labels", nargs="+", help="a name for each run (default: its title, or folder)")
    parser.add_argument("--title", help="of the picture")
    parser.add_argument("--dpi", type=int, default=160)
    options = parser.parse_args()
    if options.labels and len(options.labels) != len(options.folders):
        parser.error(f"{len(options.labels)} labels for {len(options.folders)} runs")
    return options


def main():
    options = parse_arguments()
    labels = options.labels or labels_of(options.folders)
    runs = dict(zip(labels, (read_history(folder) for folder in options.folders)))
    if len(runs) < len(options.folders):
        fail("two runs have the same label; is a folder named twice?")
    first = next(iter(runs.values()))
    shared = [c for c in first if c != "time [s]" and all(c in history for history in runs.values())]
    columns = wanted_columns(options.columns, shared) if options.columns else usual_columns(runs, shared)
    if not columns:
        fail("these runs share no column that changes")
    plt.rcParams.update(STYLE)
    across = min(3, len(columns))
    down = -(-len(columns) // across)
    figure, axes = plt.subplots(down, across, figsize=(4.2 * across, 2.9 * down + 0.7), sharex=True, squeeze=False, layout="constrained")
    for panel, column in zip(axes.flat, columns):
        draw(panel, runs, column)
    for panel in axes.flat[len(columns):]:
        panel.axis("off")
    for panel in axes[-1]:
        panel.set_xlabel("time [s]")
    figure.legend(*axes.flat[0].get_legend_handles_labels(), loc="outside lower center", ncols=min(4, len(runs)), frameon=False)
    if options.title:
        figure.suptitle(options.title, x=0.012, ha="left", fontsize=13, fontweight="bold")
    output = options.output or options.folders[0] / "compared.png"
    output.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(output, dpi=options.dpi, facecolor="white")
    print_differences(runs, columns)
    print(f"[plot] wrote {output}")


if __name__ == "__main__":
    sys.exit(main())
