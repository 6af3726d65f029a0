"""Where a chain of active fibres is unstable: growth rates over stretch from eigenvalues and from steps in time, the border over activation
and base stiffness, and beside it where the same law loses ellipticity in space. Started by scripts/pictures.

Runs configs/rod/stability.toml for each base and activation, drawn through all stretches; and held at some of them, out of place by a
wave of the shortest kind, of which growth is measured. Prints how far the two are apart.
"""
import argparse
import csv
import pathlib
import subprocess
import tempfile

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D
from plot_style import COLOURS, INK, STYLE

TOP = pathlib.Path(__file__).resolve().parent.parent
BASE = {"c1": 39.81119150206686, "c2": 73.24669652938298}  # [kPa] of the scene
PARTS = [100, 50, 25, 10]  # % of it
ACTIVATIONS = [0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]
STRETCH = np.linspace(0.5, 1.5, 201)
HELD = [0.9, 1.0, 1.06, 1.12, 1.18, 1.24, 1.3, 1.36, 1.42]  # stretches of the runs in time
LENGTH, FIRST = 100, 6.25  # [mm] of the chain, place of its first mass
FROM, TO = 0.2, 0.5  # [s] growth is measured between
ACTIVE = "materials.muscle.terms.active"


def base_of(part):
    return [f"materials.muscle.terms.base.{key}={value * part / 100} kPa" for key, value in BASE.items()]


def run(titin, folder, overrides):
    command = [titin, "run", TOP / "configs/rod/stability.toml", *overrides, "-o", folder, "--overwrite", "-q"]
    subprocess.run(list(map(str, command)), check=True, stderr=subprocess.DEVNULL)  # of soft bases: a warning on the bulk modulus
    with open(folder / "history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def drawn(titin, folder, part, activation):
    """Stretch, and growth rate at it."""
    history = run(titin, folder, [*base_of(part), f"{ACTIVE}.activation={activation}"])
    return STRETCH, np.interp(STRETCH, history["mean_stretch_muscle"], history["growth_rate [1/s]"])


def held(titin, folder, part, stretch):
    """Growth seen, and that of the eigenvalue, fully active."""
    history = run(titin, folder, [*base_of(part), "rod.scale=1", f"rod.start.stretch={stretch}", "rod.start.mode=8", f"time.end={TO} s",
                                  'rod.start.displacement="10 nm"', f'boundary.x+.displacement.x="{LENGTH * (stretch - 1)} mm"'])  # fmt: skip
    u = np.abs(history["marker_first_ux [m]"] - (stretch - 1) * FIRST * 1e-3)
    first, last = (np.argmin(np.abs(history["time [s]"] - t)) for t in (FROM, TO))
    return np.log(u[last] / u[first]) / (TO - FROM), history["growth_rate [1/s]"][0]


def ellipticity(program, folder, part):
    file = folder / f"map_{part}.csv"
    subprocess.run([program, TOP / "configs/point/isotonic.toml", "--map", "-o", file, f"{ACTIVE}.curve=flexodeal_smooth", *base_of(part),
                    "point.map.stretch=[0.5, 1.5]", "point.map.stretch_points=101", "point.map.activation_points=31"], check=True)  # fmt: skip
    with open(file, newline="") as text:
        rows = list(csv.DictReader(text))
    stretch, activation = (np.unique([float(row[name]) for row in rows]) for name in ("stretch", "activation"))
    return stretch, activation, np.array([float(row["legendre_hadamard [Pa]"]) for row in rows]).reshape(len(activation), len(stretch))


def draw_growth(axes, growth, seen):
    for part, colour in zip(PARTS, COLOURS):
        stretch, rate = growth[part][-1]
        axes.plot(stretch, rate, color=colour, linewidth=1.5, label=f"base {part} %")
        axes.plot(HELD, [s for s, _ in seen[part]], "o", color=colour, markersize=4)
    axes.axhline(0, color=INK, linewidth=0.8)
    axes.set_xlim(0.8, 1.5), axes.set_ylim(-4, 3)
    axes.set_title("growth rate [1/s], fully active")
    handles, labels = axes.get_legend_handles_labels()
    handles.append(Line2D([], [], color=INK, marker="o", linestyle="", markersize=4))
    axes.legend(handles, [*labels, "seen in time"], fontsize=8, loc="lower left")


def draw_border(axes, maps, title):
    for part, colour in zip(PARTS, COLOURS):
        stretch, activation, value = maps[part]
        if value.min() < 0:
            axes.contour(stretch, activation, value, levels=[0], colors=colour, linewidths=1.5)
            axes.contourf(stretch, activation, value, levels=[-np.inf, 0], colors=[colour], alpha=0.09)
    axes.set_xlim(0.8, 1.5), axes.set_ylim(0, 1)
    axes.set_title(title)
    axes.set_ylabel("activation")


def main():
    parser = argparse.ArgumentParser(description="Draws where chains of active fibres are unstable.")
    parser.add_argument("--titin", default=TOP / "build" / "bin" / "titin")
    parser.add_argument("--program", default=TOP / "build" / "bin" / "material_point")
    parser.add_argument("--out", type=pathlib.Path, default=TOP / "docs" / "pictures" / "rod_stability.png")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        growth = {part: [drawn(arguments.titin, folder / "run", part, a) for a in ACTIVATIONS] for part in PARTS}
        seen = {part: [held(arguments.titin, folder / "run", part, stretch) for stretch in HELD] for part in PARTS}
        space = {part: ellipticity(arguments.program, folder, part) for part in PARTS}
    line = {part: (STRETCH, np.array(ACTIVATIONS), -np.array([rate for _, rate in growth[part]])) for part in PARTS}
    everything = [pair for part in PARTS for pair in seen[part]]
    growing = [(s, e) for s, e in everything if e > 0.1]
    print(f"{len(growing)} held chains grow: seen over eigenvalue differs from 1 by at most {max(abs(s / e - 1) for s, e in growing):.1e}; "
          f"{sum((s > 0) == (e > 0) for s, e in everything)} of {len(everything)} grow or decay as the eigenvalue says")  # fmt: skip
    for part in PARTS:
        stretch, rate = growth[part][-1]
        unstable = stretch[rate > 0]
        elliptic = space[part][0][space[part][2][-1] < 0]
        print(f"base {part} %, fully active: rod unstable "
              + (f"from {unstable.min():.2f} to {unstable.max():.2f}, at most {rate.max():.2f} 1/s" if unstable.size else "nowhere")
              + "; in space not elliptic " + (f"from {elliptic.min():.2f} to {elliptic.max():.2f}" if elliptic.size else "nowhere"))  # fmt: skip
    plt.rcParams.update(STYLE)
    figure, axes = plt.subplots(1, 3, figsize=(12.4, 3.9))
    draw_growth(axes[0], growth, seen)
    draw_border(axes[1], line, "the rod is unstable inside")
    draw_border(axes[2], space, "the law in space is not elliptic inside")
    for one in axes:
        one.set_xlabel("stretch")
    figure.tight_layout()
    figure.savefig(arguments.out, dpi=110)


if __name__ == "__main__":
    main()
