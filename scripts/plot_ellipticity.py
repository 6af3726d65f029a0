"""Draws maps of ellipticity that material_point --map wrote, side by side. Started by scripts/plot.

Red is where a band of shear grows by itself; strokes show how such a band lies to the fibre, which is drawn along x.
"""
import argparse
import csv
import pathlib
import sys

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LinearSegmentedColormap
from plot_style import INK, STYLE

VALUE = "legendre_hadamard [Pa]"
# Stable is pale and cool, unstable warm and dark: lightness runs one way on each side of zero.
COLOURS = LinearSegmentedColormap.from_list(
    "ellipticity", ["#5c1126", "#a8292f", "#dd6a4a", "#f6c3a1", "#fcf7f2", "#dfe9f0", "#bcd1e1", "#98b8d1", "#7aa0c0"]
)
STROKES = (14, 10)  # along stretch and activation


class Map:
    def __init__(self, path):
        with open(path, newline="") as file:
            rows = list(csv.DictReader(file))
        if not rows or VALUE not in rows[0]:
            sys.exit(f"plot: {path} was not written by material_point --map")
        column = {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}
        self.stretch, self.activation = np.unique(column["stretch"]), np.unique(column["activation"])
        shape = (len(self.activation), len(self.stretch))
        self.value = column[VALUE].reshape(shape)
        self.angle = column["angle [degree]"].reshape(shape) if "angle [degree]" in column else None


def draw_strokes(axes, m):
    """The band at a place, perpendicular to its normal; its length is the same on paper everywhere."""
    box = axes.get_window_extent()
    wide, high = np.ptp(axes.get_xlim()) / box.width, np.ptp(axes.get_ylim()) / box.height
    half = 0.32 * min(box.width / STROKES[0], box.height / STROKES[1])
    for x in np.linspace(*axes.get_xlim(), STROKES[0] + 1)[:-1] + np.ptp(axes.get_xlim()) / STROKES[0] / 2:
        for y in np.linspace(*axes.get_ylim(), STROKES[1] + 1)[:-1] + np.ptp(axes.get_ylim()) / STROKES[1] / 2:
            i, j = np.argmin(np.abs(m.activation - y)), np.argmin(np.abs(m.stretch - x))
            if m.value[i, j] >= 0:
                continue
            band = np.deg2rad(90 - m.angle[i, j])
            dx, dy = half * wide * np.cos(band), half * high * np.sin(band)
            axes.plot([x - dx, x + dx], [y + dy, y - dy], color="white", linewidth=1.1, solid_capstyle="round")


def draw(axes, m, limit):
    x, y = m.stretch, m.activation
    image = axes.pcolormesh(x, y, m.value / 1e3, cmap=COLOURS, vmin=-limit, vmax=limit, shading="gouraud", rasterized=True)
    if len(y) > 1 and np.min(m.value) < 0 < np.max(m.value):
        axes.contour(x, y, m.value, levels=[0], colors=INK, linewidths=1.6)
    where = np.unravel_index(np.argmin(m.value), m.value.shape)
    axes.plot(x[where[1]], y[where[0]], "o", color=INK, markersize=4.5, clip_on=False)
    axes.annotate(f"{m.value[where] / 1e3:.3g} kPa", (x[where[1]], y[where[0]]), xytext=(0, 6), textcoords="offset points",
                  ha="center", fontsize=8.5, color=INK, annotation_clip=False)  # fmt: skip
    axes.grid(False)
    axes.set_xlabel("stretch")
    axes.tick_params(length=3)
    return image


def main():
    parser = argparse.ArgumentParser(prog="scripts/plot", description="Draws maps of ellipticity side by side.")
    parser.add_argument("files", type=pathlib.Path, nargs="+", metavar="MAP.csv")
    parser.add_argument("--titles", nargs="+", help="one for each map (default: names of the files)")
    parser.add_argument("--title", default="Smallest Legendre-Hadamard value", help="heads the picture")
    parser.add_argument("--limit", type=float, help="value at the ends of the colours [kPa] (default: the lowest found)")
    parser.add_argument("--mark", nargs=2, metavar=("STRETCH", "TEXT"), help="a line at a stretch, and what it says")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="picture to write (default: beside the first file)")
    options = parser.parse_args()
    maps = [Map(path) for path in options.files]
    if any(len(m.activation) < 2 for m in maps):
        sys.exit("plot: a map of a passive material is one row; draw its columns stretch and legendre_hadamard yourself")
    lowest = min(np.min(m.value) for m in maps) / 1e3
    limit = options.limit or (-lowest if lowest < 0 else np.median(np.abs(maps[0].value)) / 1e3)
    titles = options.titles or [path.stem.replace("_", " ") for path in options.files]
    plt.rcParams.update(STYLE)
    figure, axes = plt.subplots(1, len(maps), figsize=(1.6 + 2.75 * len(maps), 3.7), layout="constrained", sharey=True, squeeze=False)
    figure.get_layout_engine().set(w_pad=0.06, h_pad=0.08)
    for one, m, title in zip(axes[0], maps, titles):
        image = draw(one, m, limit)
        one.set_title(title, pad=18)
        if options.mark:
            one.axvline(float(options.mark[0]), color=INK, linewidth=0.9, linestyle=(0, (4, 3)))
    axes[0][0].set_ylabel("activation")
    if options.mark:
        axes[0][0].annotate(options.mark[1], (float(options.mark[0]), 0.04), xytext=(-5, 0), textcoords="offset points",
                            ha="right", fontsize=8.5)  # fmt: skip
    bar = figure.colorbar(image, ax=axes[0].tolist(), aspect=24, pad=0.015, extend="both")
    bar.set_label("min  a$_i$ n$_J$ A$_{iJkL}$ a$_k$ n$_L$  [kPa]")
    bar.outline.set_visible(False)
    bar.ax.tick_params(length=0)
    bar.ax.axhline(0, color=INK, linewidth=1.6)
    figure.suptitle(options.title, x=0.012, ha="left", fontsize=13, fontweight="bold")
    figure.canvas.draw()  # places are known only now
    for one, m in zip(axes[0], maps):
        one.set_autoscale_on(False)
        if m.angle is not None:
            draw_strokes(one, m)
    output = options.output or options.files[0].with_suffix(".png")
    figure.savefig(output, dpi=160, facecolor="white")
    print(f"[plot] wrote {output}")


if __name__ == "__main__":
    main()
