"""Draws a bench (scripts/bench.py): error against resolution, CPU time and memory; or a map of where methods work."""
import math
import re
import sys
import textwrap

import matplotlib.pyplot as plt
import numpy as np
from bench_results import ROOT, fitted_order, pareto_front, resolution
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
from plot_style import COLOURS, FAINT, INK, STYLE

MARKERS = "os^Dv<>phX"
WORKS, DEGRADES, FAILS = "#4f9a68", "#e9c46a", "#b5423a"


def draw(bench, rows):
    plt.rcParams.update(STYLE)
    figure = draw_map(bench, rows) if bench.map else draw_curves(bench, rows)
    picture = ROOT / "docs" / "pictures" / f"bench_{bench.path.stem}.png"
    figure.savefig(picture, dpi=110)
    plt.close(figure)
    return picture.relative_to(ROOT)


# ---- curves


def draw_curves(bench, rows):
    figure, axes = plt.subplots(1, 3, figsize=(13, 4.6), layout="constrained", sharey=True)
    costs = [lambda r: resolution(bench, r), lambda r: r.number("cpu_seconds"), lambda r: r.number("peak_rss_bytes") / 1e6]
    labels = ["step over the run" if bench.against == "dt" else "size of a cell over that of the body", "CPU seconds", "memory [MB]"]
    names = []
    for n, line in enumerate(bench.lines):
        good = [r for r in bench.of(line, rows) if r.status == "finished" and r.error > 0]
        if not good:
            names.append((n, f"{line.name}: {'did not finish' if bench.of(line, rows) else 'not run yet'}"))
            continue
        style = look(n) | {"linewidth": 2.6 if line.is_default else 1.3}
        for axis, cost in zip(axes, costs):
            axis.loglog([cost(r) for r in good], [r.error for r in good], **style)
        names.append((n, f"{line.name}{' (default)' if line.is_default else ''}: {slopes(bench, good)}"))
    every = [r for line in bench.lines for r in bench.of(line, rows)]
    for axis, cost in zip(axes[1:], costs[1:]):
        front = pareto_front(every, cost)
        axis.loglog([cost(r) for r in front], [r.error for r in front], "o", markersize=10, markerfacecolor="none", markeredgecolor=INK, markeredgewidth=0.8)
    for axis, label in zip(axes, labels):
        axis.set_xlabel(label)
        readable(axis.xaxis, *axis.get_xlim())
    readable(axes[0].yaxis, *axes[0].get_ylim())
    axes[0].set_ylabel(textwrap.fill(bench.label, 40))
    axes[1].set_title("rings: no run is both better and cheaper")
    handles = [plt.Line2D([], [], **look(n)) for n, _ in names]
    figure.legend(handles, [name for _, name in names], loc="outside lower center", ncols=2, frameon=False, fontsize=8.5)
    figure.suptitle(f"{bench.title}. Error against: {bench.reference}", fontsize=10.5, fontweight="bold", x=0.01, ha="left")
    return figure


def readable(axis, low, high):
    """Numbers at 1, 2, 5 where the axis has few decades, none over another."""
    few = high / low < 60
    axis.set_major_locator(LogLocator(subs=(1, 1.5, 2, 3, 4, 5, 6, 8) if high / low < 5 else (1, 2, 5) if few else (1,)))
    axis.set_minor_formatter(NullFormatter())
    if few:
        axis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:.3g}"))


def look(n):
    """Of the nth curve: the second round of the colours is dashed and hollow."""
    colour, again = COLOURS[n % len(COLOURS)], n >= len(COLOURS)
    return {"color": colour, "marker": MARKERS[n % len(MARKERS)], "markersize": 4.5, "linestyle": "--" if again else "-",
            "markerfacecolor": "white" if again else colour}  # fmt: skip


def slopes(bench, rows):
    """Fitted order, and the slopes of the first and the last two."""
    if len(rows) < 2:
        return "one run"
    rows = list({resolution(bench, row): row for row in rows}.values())  # of one size with several steps the shortest
    if len(rows) < 2:
        return "one mesh, shorter steps"
    ends = [fitted_order(bench, pair) for pair in (rows[:2], rows[-2:])]
    return f"order {fitted_order(bench, rows):.2f}" + (f" ({ends[0]:.2f} first, {ends[1]:.2f} last)" if len(rows) > 2 else "")


# ---- maps


def classify(bench, row, best):
    if row.status != "finished" or not row.error <= bench.map.get("fails_above", sys.float_info.max):
        return FAILS
    limit = bench.map.get("or_above", math.inf)
    return DEGRADES if row.error > bench.map.get("degrades", 10) * best or row.error > limit else WORKS


def draw_map(bench, rows):
    x_key, y_key = bench.map["x"], bench.map["y"]
    points = [(value(case, x_key, line), value(case, y_key, line), rows.get((line.name, line.key(case))))
              for line in bench.lines for case in line.sweep.cases]  # fmt: skip
    xs, ys = (list(dict.fromkeys(p[i] for p in points)) for i in (0, 1))
    figure, axis = plt.subplots(figsize=(2.6 + 0.62 * len(xs), 1.9 + 0.42 * len(ys)), layout="constrained")
    for y in ys:
        of_row = [p[2].error for p in points if p[1] == y and p[2] and p[2].status == "finished" and p[2].error > 0]
        best = min(of_row, default=math.nan)
        for px, py, row in points:
            if py == y and row:
                colour = classify(bench, row, best)
                place = (xs.index(px), ys.index(py))
                axis.add_patch(plt.Rectangle((place[0] - 0.47, place[1] - 0.45), 0.94, 0.9, color=colour, linewidth=0))
                text = "fails" if row.status != "finished" or not math.isfinite(row.error) else number(row.error)
                axis.text(*place, text, ha="center", va="center", fontsize=7, color="white" if colour != DEGRADES else INK)
    axis.set(xlim=(-0.5, len(xs) - 0.5), ylim=(-0.5, len(ys) - 0.5), xticks=range(len(xs)), yticks=range(len(ys)))
    axis.set_xticklabels(bench.map.get("x_ticks", [str(x) for x in xs]), fontsize=8)
    axis.set_yticklabels(bench.map.get("y_ticks", [str(y) for y in ys]), fontsize=8)
    axis.grid(False)
    axis.tick_params(length=0)
    axis.set_xlabel(bench.map.get("x_label", x_key))
    axis.set_ylabel(bench.map.get("y_label", "" if y_key == "sweep" else y_key))
    wide = int(12 * figure.get_figwidth())
    text = "\n".join([bench.title, *textwrap.wrap(f"{bench.label}; against: {bench.reference}", wide)])
    figure.suptitle(text, fontsize=9, fontweight="bold", x=0.01, ha="left")
    handles = [plt.Rectangle((0, 0), 1, 1, color=c) for c in (WORKS, DEGRADES, FAILS)]
    figure.legend(handles, ["works", "degrades", "fails"], loc="outside lower center", ncols=3, frameon=False, fontsize=8)
    return figure


def number(x):
    """Of a cell; counts as they are."""
    return f"{x:.0f}" if x == round(x) and x < 1e4 else f"{x:.1e}".replace("e-0", "e-").replace("e+00", "")


def value(case, key, line):
    if key == "sweep":
        return line.name
    found = case.values.get(key, "")
    text = ", ".join(str(v) for v in found) if isinstance(found, list) else str(found)
    return re.sub(r"\d+\.\d{3,}", lambda number: f"{float(number[0]):.3g}", text)
