"""How our pictures look: colours, type, and curves with their names at their ends."""
import re

import matplotlib

matplotlib.use("Agg")
import numpy as np

INK, FAINT = "#22262e", "#9aa1ad"
COLOURS = ["#2f6f9f", "#d1603d", "#4f9a68", "#8d6cab", "#c79a2d", "#5b6472"]
# Contracted is dark, stretched is pale: lightness runs one way, so it also reads in grey.
COLOUR_MAP = matplotlib.colors.LinearSegmentedColormap.from_list(
    "muscle", ["#4a1029", "#8f1d2f", "#c8452f", "#e98a4c", "#f6c887", "#fdf3d8"]
)
STYLE = {
    "font.family": "sans-serif", "font.size": 9.5, "text.color": INK, "axes.labelcolor": INK, "axes.edgecolor": FAINT,
    "axes.linewidth": 0.8, "axes.spines.top": False, "axes.spines.right": False, "xtick.color": INK, "ytick.color": INK,
    "xtick.direction": "out", "axes.grid": True, "grid.color": "#e9ebef", "grid.linewidth": 0.8, "axes.axisbelow": True,
    "axes.titlesize": 10, "axes.titleweight": "bold", "axes.titlelocation": "left",
}  # fmt: skip


def prefixed(values):
    """A factor and an SI prefix that bring the largest of these numbers between 1 and 1000."""
    largest = max((np.nanmax(np.abs(v)) for v in values), default=0)
    for factor, prefix in ((1e-9, "G"), (1e-6, "M"), (1e-3, "k"), (1, ""), (1e3, "m"), (1e6, "µ"), (1e9, "n")):
        if largest * factor >= 1:
            return factor, prefix
    return 1, ""


def prefixed_unit(values, unit):
    """The same with the unit: only where it begins with one that takes a prefix alone, so neither "m^3" nor "kg/m^3"."""
    factor, prefix = prefixed(values) if re.match(r"(N|J|W|Pa|m|s)(?![\w^])", unit) else (1, "")
    return factor, prefix + unit


def spread(wanted, gap):
    """Heights near the wanted ones, at least `gap` apart."""
    order = np.argsort(wanted)
    heights = np.array(wanted, dtype=float)
    for _ in range(200):
        for low, high in zip(order, order[1:]):
            short = gap - (heights[high] - heights[low])
            if short > 1e-9:
                heights[low] -= short / 2
                heights[high] += short / 2
    return heights


def name_ends(axes, x, ends, colours, gap=0.075):
    """Names at the height of their curves' ends, right of x, none over another."""
    low, high = axes.get_ylim()
    heights = spread(list(ends.values()), gap * (high - low))
    for colour, name, height in zip(colours, ends, heights):
        axes.annotate(name, (x, height), xytext=(6, 0), textcoords="offset points", color=colour, va="center",
                      fontsize=8.5, annotation_clip=False)  # fmt: skip


def draw_curves(axes, x, curves, quantity, unit, gap=0.075):
    """Lines with their names at their right ends."""
    factor, prefix = prefixed(curves.values())
    axes.set_title(f"{quantity} [{prefix}{unit}]")
    axes.axhline(0, color=FAINT, linewidth=0.8)
    colours = COLOURS * 3
    for colour, values in zip(colours, curves.values()):
        axes.plot(x, values * factor, color=colour, linewidth=1.8, solid_capstyle="round")
    axes.margins(x=0.0, y=0.08)
    right = np.argmax(x)
    name_ends(axes, x[right], {name: values[right] * factor for name, values in curves.items()}, colours, gap)
    axes.tick_params(length=3)
