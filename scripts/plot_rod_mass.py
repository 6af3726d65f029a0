"""When a muscle's mass matters: force and work of the model without mass against the continuum, over size, frequency and amplitude of cyclic
stretch, and of bursts against a tendon; and against the one number that says it all. Started by scripts/pictures.

Runs configs/rod/cyclic.toml as kind = "massless" and "continuum". The force is that at the end that moves, in the second cycle:
error = largest difference over the largest force without mass; of the work since the cycle began: largest difference over the range of the work
without mass. The number is

    Gamma = rho L^2 w^2 e / P,   e the amplitude of strain (half of the range), w = 2 pi f, P the largest force over the area.

A force at the end that moves should be off by Gamma / 3 (docs/theory/rod.md). Hollow: the fibres became uneven although Gamma is small, as they
were unstable while they were lengthened. Bursts: activation rises and falls once as (1 - cos) / 2 within 1 / f while the far end of a tendon is held; e is half of the muscle's largest strain.
"""
import argparse
import csv
import itertools
import json
import pathlib
import subprocess
import tempfile

import matplotlib.pyplot as plt
import numpy as np
from plot_style import COLOURS, INK, STYLE

TOP = pathlib.Path(__file__).resolve().parent.parent
SCALES = [0.1, 0.32, 1, 3.2, 10, 32, 100]
FREQUENCIES = [1, 3, 10]  # [Hz]
RANGES = [0.02, 0.05, 0.1]  # of strain
LENGTH, AREA, DENSITY = 0.03, 30e-6, 1060  # [m], [m^2], [kg/m^3] of the scene, scale 1
STEPS = 200  # of a cycle
CHAIN = ["rod.kind=chain", "rod.masses=16"]
NAMED = {"mouse, slow": (0.5, 1, 0.05), "human, slow": (10, 1, 0.05), "human, fast": (10, 10, 0.1), "10 times human, fast": (100, 10, 0.1)}
TENDON = ["rod.tendon={length = \"30 mm\", area = \"1 mm^2\"}", "materials.muscle.regions=muscle", "materials.tendon.regions=tendon",
          "materials.tendon.density=1100 kg/m^3", "materials.tendon.fibre=[1, 0, 0]",
          "materials.tendon.volumetric={law = \"simo\", bulk_modulus = \"1 GPa\"}",
          "materials.tendon.terms.fibres={law = \"neo_hookean\", mu = \"40 MPa\"}"]  # fmt: skip


def cosine(cycles, period, peak, unit):
    """peak (1 - cos) / 2 in time as a curve."""
    t = np.arange(cycles * STEPS + 1) / STEPS
    times, values = (", ".join(f"{x:.8g}" for x in column) for column in (t * period, peak * (1 - np.cos(2 * np.pi * t)) / 2))
    return f'{{ time = "{times} s", value = "{values} {unit}" }}' if unit else f'{{ time = "{times} s", value = [{values}] }}'


def run(titin, folder, scale, frequency, overrides):
    period = 1 / frequency
    command = [titin, "run", TOP / "configs/rod/cyclic.toml", f"rod.scale={scale}", f"time.step={period / STEPS} s", *overrides,
               "-o", folder, "--overwrite", "-q"]  # fmt: skip
    subprocess.run(list(map(str, command)), check=True)
    with open(folder / "history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    history = {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}
    history["seconds"] = json.loads((folder / "run.json").read_text())["timers"]["rod"]["cpu"]
    return history


class Task:
    """One way to use the muscle; its force and work without mass are those of scale 1 times scale^2 and scale^3."""

    def __init__(self, titin, folder, frequency, overrides, cycle):
        self.titin, self.folder, self.frequency, self.overrides = titin, folder, frequency, overrides
        self.begin, self.end = (c / frequency for c in cycle)  # [s] errors are taken between
        self.overrides = [*overrides, f"time.end={self.end} s"]
        self.grid = np.linspace(self.begin, self.end, STEPS + 1)
        self.without = run(titin, folder, 1, frequency, [*self.overrides, "rod.kind=massless"])
        self.force0, self.work0 = self.of(self.without, 1)

    def of(self, history, scale):
        """Force at the end that moves, and work at the ends or, in bursts, of the fibres, as if of scale 1."""
        at = lambda name: np.interp(self.grid, history["time [s]"], history[name])  # noqa: E731
        work = at("work_boundary [J]") if "mean_stretch_tendon" not in history else at("work_muscle_active [J]")
        return at("reaction_x+_x [N]") / scale**2, (work - work[0]) / scale**3

    def errors(self, scale, more=()):
        """Of force and work; how uneven the fibres became; CPU seconds of the solver."""
        history = run(self.titin, self.folder, scale, self.frequency, [*self.overrides, *more])
        force, work = self.of(history, scale)
        return (np.max(np.abs(force - self.force0)) / np.max(np.abs(self.force0)), np.max(np.abs(work - self.work0)) / np.ptp(self.work0),
                np.max(history["stretch_max"] - history["stretch_min"]), history["seconds"])  # fmt: skip

    def number(self, scale, strain):
        w = 2 * np.pi * self.frequency
        return DENSITY * (LENGTH * scale) ** 2 * w**2 * strain / (np.max(np.abs(self.force0)) / AREA)


def cyclic(titin, folder, frequency, range_):
    curve = cosine(2, 1 / frequency, 1e3 * LENGTH * range_, "mm")
    return Task(titin, folder, frequency, [f'boundary.x+.displacement.x={curve}'], (1, 2))


def burst(titin, folder, frequency):
    curve = cosine(1, 1 / frequency, 1, "")
    task = Task(titin, folder, frequency, [*TENDON, 'boundary.x+.displacement.x="0 mm"', f"materials.muscle.terms.active.activation={curve}"], (0, 1))
    return task, 0.5 * np.max(1 - task.without["mean_stretch_muscle"])


def measure(titin, folder):
    """Rows: task, scale, frequency, range of strain, number, errors of force and work, unevenness, CPU seconds."""
    rows = []
    for frequency, range_ in itertools.product(FREQUENCIES, RANGES):
        task = cyclic(titin, folder, frequency, range_)
        for scale in SCALES:
            rows.append(("cyclic", scale, frequency, range_, task.number(scale, range_ / 2), *task.errors(scale)))
    for frequency in FREQUENCIES:
        task, strain = burst(titin, folder, frequency)
        for scale in SCALES:
            rows.append(("burst", scale, frequency, 2 * strain, task.number(scale, strain), *task.errors(scale)))
    return rows


def uneven(row):
    """Waves make fibres uneven by a part of their strain that is near Gamma; instability by more than the strain."""
    return row[4] < 0.1 and row[7] > row[3]


def report(titin, folder, rows):
    for name, (scale, frequency, range_) in NAMED.items():
        task = cyclic(titin, folder, frequency, range_)
        force, work, _, seconds = task.errors(scale)
        chain = task.errors(scale, CHAIN)
        print(f"{name}: scale {scale}, {1e3 * LENGTH * scale:g} mm, {frequency} Hz, {100 * range_:g} %: Gamma {task.number(scale, range_ / 2):.2e}, "
              f"force off by {100 * force:.3g} % (chain: {100 * chain[0]:.3g} %), work by {100 * work:.3g} % (chain: {100 * chain[1]:.3g} %); "
              f"{seconds:.3f} CPU seconds")  # fmt: skip
    for kind in ("cyclic", "burst"):
        stable = [row for row in rows if row[0] == kind and not uneven(row)]
        number, force, work = (np.array([row[k] for row in stable]) for k in (4, 5, 6))
        small = number < 0.3
        ratio, work_ratio = force[small] / number[small], work[small] / number[small]
        print(f"{kind}: {sum(row[0] == kind for row in rows) - len(stable)} runs uneven; of the others {np.sum(small)} with Gamma below 0.3: error over "
              f"Gamma from {ratio.min():.2f} to {ratio.max():.2f} (force), {work_ratio.min():.3f} to {work_ratio.max():.2f} (work); force off by less "
              f"than 1 % up to Gamma {number[force < 0.01].max():.2g}, by more from {number[force > 0.01].min():.2g}; by more than 10 % from "
              f"{number[force > 0.1].min():.2g}")  # fmt: skip


def draw(rows, out):
    plt.rcParams.update(STYLE)
    figure, axes = plt.subplots(1, 3, figsize=(12.6, 4.0))
    chosen = [row for row in rows if row[0] == "cyclic" and row[3] == 0.05]
    value = np.array([row[5] for row in chosen]).reshape(len(FREQUENCIES), len(SCALES))
    image = axes[0].contourf(SCALES, FREQUENCIES, np.log10(100 * value), levels=np.arange(-2, 2.51, 0.25), cmap="YlOrBr", extend="both")
    lines = axes[0].contour(SCALES, FREQUENCIES, np.log10(100 * value), levels=[0, 1], colors=INK, linewidths=1.2)
    axes[0].clabel(lines, fmt=lambda level: f"{10**level:g} %", fontsize=8.5)
    axes[0].set(xscale="log", yscale="log", xlabel="scale (1: 30 mm)", ylabel="frequency [Hz]")
    axes[0].set_title("force without mass: error [%], strain of 5 %")
    axes[0].grid(False)
    bar = figure.colorbar(image, ax=axes[0], ticks=[-2, -1, 0, 1, 2])
    bar.ax.set_yticklabels(["0.01", "0.1", "1", "10", "100"])
    for one, column, what in ((axes[1], 5, "force"), (axes[2], 6, "work of a cycle")):
        for frequency, colour in zip(FREQUENCIES, COLOURS):
            for kind, mark in (("cyclic", "o"), ("burst", "^")):
                some = [row for row in rows if row[0] == kind and row[2] == frequency]
                for hollow, face in ((False, colour), (True, "none")):
                    points = [(row[4], 100 * row[column]) for row in some if uneven(row) == hollow] or [(np.nan, np.nan)]
                    one.plot(*zip(*points), mark, color=colour, markersize=4.5, alpha=0.8, markerfacecolor=face, markeredgewidth=hollow,
                             label=None if hollow else f"{kind}, {frequency} Hz")  # fmt: skip
        one.plot([1e-8, 1e4], [100e-8 / 3, 100e4 / 3], color=INK, linewidth=0.9, label=r"$\Gamma/3$")
        one.set(xscale="log", yscale="log", xlim=(1e-7, 1e3), ylim=(1e-5, 1e3), xlabel=r"$\Gamma = \rho L^2 \omega^2 \varepsilon / P$")
        one.set_title(f"{what}: error [%]")
    axes[1].legend(fontsize=7.5)
    figure.tight_layout()
    figure.savefig(out, dpi=110)


def main():
    parser = argparse.ArgumentParser(description="Draws when a muscle's mass matters.")
    parser.add_argument("--titin", default=TOP / "build" / "bin" / "titin")
    parser.add_argument("--out", type=pathlib.Path, default=TOP / "docs" / "pictures" / "rod_mass.png")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch) / "run"
        rows = measure(arguments.titin, folder)
        report(arguments.titin, folder, rows)
    draw(rows, arguments.out)


if __name__ == "__main__":
    main()
