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
from body import limits, render
from plot_style import COLOUR_MAP, FAINT, STYLE, draw_curves, prefixed_unit
from saved_fields import SavedFields, choose_field, show, title_and_unit

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
        match = re.fullmatch(r"(?:reaction|force)_(.+)_([xyz]) \[N(?:/m)?\]", column)
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


def per_metre(history):
    """"/m" for a plane body, whose forces and energies are those of a thickness of 1 m."""
    return "/m" if any(re.search(r" \[[NJ]/m\]$", column) for column in history) else ""


def energies(history):
    found = {}
    for column, values in history.items():
        match = re.fullmatch(r"(energy|work)_(.+) \[J(?:/m)?\]", column)
        if match:
            kind, name = match.group(1), match.group(2).replace("_", " ")
            found[name if kind == "energy" else f"work of {name}"] = values
    largest = max((np.max(np.abs(v)) for v in found.values()), default=0)
    return {name: v for name, v in found.items() if np.max(np.abs(v)) > SMALL * largest}


# ---- the body ----------------------------------------------------------------------------------------------------------


def draw_body(figure, axes, folder, options):
    axes.axis("off")
    saved = SavedFields(folder)
    if not len(saved.times):
        axes.text(0.5, 0.5, "no fields were saved", ha="center", color=FAINT)
        return
    at = saved.nearest(options.time)
    grid = saved.read(at)
    array = choose_field(grid, options.field)
    if array is None:
        fail(f"there is no field '{options.field}'; there are {', '.join(sorted({*grid.point_data, *grid.cell_data}))}")
    title, unit = title_and_unit(array)
    factor, unit = prefixed_unit([show(grid, array)], unit)
    values = show(grid, array, factor=factor)
    low, high = limits(float(np.min(values)), float(np.max(values)))
    axes.imshow(render(grid, (low, high), options.warp))
    times = f", displacements times {options.warp:g}" if options.warp != 1 else ""
    axes.set_title(f"t = {saved.times[at]:.4g} s{times}", pad=10)
    colours = plt.cm.ScalarMappable(plt.Normalize(low, high), COLOUR_MAP)
    bar = figure.colorbar(colours, ax=axes, orientation="horizontal", fraction=0.035, pad=0.05, aspect=32, shrink=0.72)
    bar.set_label(title + (f" [{unit}]" if unit else ""))
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
        (reactions(history), "Force of the held boundaries", "N" + per_metre(history)),
        (energies(history), "Energy and work", "J" + per_metre(history)),
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
