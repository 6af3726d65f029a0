"""Strain and strain rate at three points of a rod that is stretched and held, by time scheme and form of the velocity. Started by
scripts/pictures.

Runs configs/muscle/rod.toml, or with --line configs/rod/stretched.toml (the same in one dimension), once for each scheme and form.
Prints the total variation of the strain rate in the middle after the ramp, over the rate of the whole rod in it.
"""
import argparse
import csv
import pathlib
import subprocess
import tempfile

import matplotlib.pyplot as plt
from plot_style import COLOURS, STYLE

TOP = pathlib.Path(__file__).resolve().parent.parent
SCHEMES = {"backward_euler": "backward Euler", "newmark": "Newmark", "hht_alpha": "HHT"}
VELOCITIES = {"rothe": "Rothe", "lines": "method of lines"}
POINTS = {"near": "near the fixed end", "middle": "middle", "far": "near the moving end"}
RAMP = 0.02  # [s]
RATE = 0.1 / RAMP  # [1/s]
# Scene, and the columns of stretch and rate at a point.
BODIES = {"space": ("muscle/rod.toml", "mean_stretch_{}", "mean_fibre_rate_{}"),
          "line": ("rod/stretched.toml", "marker_{}_stretch", "marker_{}_rate")}  # fmt: skip


def run(titin, scratch, body, scheme, velocity):
    """What happens at each point: time, stretch and rate."""
    folder = scratch / f"{scheme}_{velocity}"
    scene, stretch, rate = BODIES[body]
    command = [titin, "run", TOP / "configs" / scene, f"time.scheme={scheme}", f"time.velocity={velocity}", "-o", folder, "--overwrite", "-q"]
    subprocess.run(list(map(str, command)), check=True)
    with open(folder / "history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    history = {name: [float(row[name]) for row in rows] for name in rows[0]}
    points = {point: (column(history, stretch.format(point)), column(history, rate.format(point))) for point in POINTS}
    return {"time": history["time [s]"], **points}


def column(history, start):
    return next(values for name, values in history.items() if name == start or name.startswith(start + " "))


def variation(history):
    """Total variation of the strain rate in the middle, from the last moment of the ramp on."""
    rate = [r for t, r in zip(history["time"], history["middle"][1]) if t >= RAMP * (1 - 1e-9)]
    return sum(abs(b - a) for a, b in zip(rate, rate[1:])) / RATE


def draw(histories, out):
    plt.rcParams.update(STYLE)
    figure, axes = plt.subplots(2, len(histories), figsize=(2.6 * len(histories), 4.6), sharex=True, sharey="row")
    for (label, history), (strain, rate) in zip(histories.items(), axes.T):
        time = [1e3 * t for t in history["time"]]
        for (point, name), colour in zip(POINTS.items(), COLOURS):
            strain.plot(time, [s - 1 for s in history[point][0]], label=name, color=colour, linewidth=1.1)
            rate.plot(time, history[point][1], color=colour, linewidth=1.1)
        strain.set_title(label, fontsize=9)
        rate.set_xlabel("time [ms]")
    axes[0][0].set_ylabel("strain")
    axes[1][0].set_ylabel("strain rate [1/s]")
    axes[0][0].legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(out, dpi=110)


def main():
    parser = argparse.ArgumentParser(description="Draws the rod.")
    parser.add_argument("--line", action="store_true", help="in one dimension")
    parser.add_argument("--titin", default=TOP / "build" / "bin" / "titin")
    parser.add_argument("--out", type=pathlib.Path, default=TOP / "docs" / "pictures" / "rod.png")
    parser.add_argument("--scratch", type=pathlib.Path, default=pathlib.Path(tempfile.gettempdir()) / "titin_rod")
    arguments = parser.parse_args()
    body, histories = "line" if arguments.line else "space", {}
    for scheme, name in SCHEMES.items():
        for velocity, form in VELOCITIES.items():
            history = run(arguments.titin, arguments.scratch, body, scheme, velocity)
            histories[f"{name},\n{form}"] = history
            print(f"{name}, {form}: total variation of the strain rate {variation(history):.2f} of the ramp's rate")
    draw(histories, arguments.out)


if __name__ == "__main__":
    main()
