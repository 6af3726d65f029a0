"""One task on every rung from one dimension to three: force per undeformed area against time, and error against cost. Started by scripts/pictures.

Runs configs/rod/ladder.toml (one dimension) and configs/muscle/ladder.toml (a block) in three tasks. The error is the largest difference of force
from that of the finest slender block with inertia, over the largest force there; the cost is CPU seconds of the whole run.
"""
import argparse
import csv
import json
import pathlib
import subprocess
import tempfile

import matplotlib.pyplot as plt
import numpy as np
from plot_style import COLOURS, INK, STYLE

TOP = pathlib.Path(__file__).resolve().parent.parent
ACTIVATION = "materials.muscle.terms.active.activation="
NO_EQUILIBRIUM = 2  # exit code
TIME = np.arange(0, 401, 4)  # [ms]


def text(values):
    return ", ".join(f"{x:.7g}" for x in values)


def end(values):
    """The displacement of x+ [mm] at TIME."""
    return f'{{ time = "{text(TIME)} ms", value = "{text(values)} mm" }}'


def active(values):
    return f'{ACTIVATION}{{ time = "{text(TIME)} ms", value = [{text(values)}] }}'


PHASE = 2 * np.pi * TIME / 200
# What x+ does, and what the nerve does; the scenes themselves are a ramp, a hold and a burst.
TASKS = {
    "isometric burst": ('"0 mm"', [active(np.where(TIME < 300, (1 - np.cos(2 * np.pi * TIME / 300)) / 2, 0))]),
    "cycles, active while shortening": (end(2.5 * np.sin(PHASE)), [active((1 - np.cos(PHASE)) / 2)]),
    "ramp, hold and burst": ('{ time = "0, 80, 160, 240, 320 ms", value = "0, 0, 5, 5, 0 mm" }', []),
}
CLAMPED = ['boundary.x-={clamp = true}', 'boundary.x+.displacement.y="0 mm"', 'boundary.x+.displacement.z="0 mm"']
STOCKY = ['mesh.box="100, 25, 25 mm"', "mesh.cells=[8, 2, 2]"]
STILL = ["muscle.inertia=quasi-static", "time.max_cuts=3"]
# Name: scene, area [mm^2] that is computed, overrides. Blocks are quarters: 1 to 20, and 1 to 2.
REFERENCE = ("muscle", 6.25, ["mesh.cells=[40, 1, 1]"])
RUNGS = {
    "no mass": ("rod", 25, ['rod.kind=massless']),
    "chain of 16 masses": ("rod", 25, ['rod.kind=chain']),
    "rod": ("rod", 25, []),
    "slender block": ("muscle", 6.25, []),
    "slender, bulk modulus 10 MPa": ("muscle", 6.25, ["materials.muscle.volumetric.bulk_modulus=10 MPa"]),
    "slender, no inertia nor rate": ("muscle", 6.25, STILL),
    "rod, no inertia nor rate": ("rod", 25, ["rod.inertia=quasi-static"]),
    "slender, clamped": ("muscle", 6.25, CLAMPED),
    "stocky, ends free to thin": ("muscle", 625, STOCKY),
    "stocky, clamped": ("muscle", 625, [*STOCKY, *CLAMPED]),
    "stocky, clamped, no inertia nor rate": ("muscle", 625, [*STOCKY, *CLAMPED, *STILL]),
}
LINES = {"rod": "--", "muscle": "-"}
MARKS = {"rod": "o", "muscle": "s"}


def run(titin, folder, rung, task):
    """Time, force per area [kPa], CPU seconds. A run that finds no equilibrium ends early."""
    scene, area, overrides = rung
    displacement, others = TASKS[task]
    command = [titin, "run", TOP / f"configs/{scene}/ladder.toml", f"boundary.x+.displacement.x={displacement}", *others, *overrides,
               "output.fields=false", "-o", folder, "--overwrite", "-q"]  # fmt: skip
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if done.returncode not in (0, NO_EQUILIBRIUM):
        raise SystemExit(done.stderr)
    with open(folder / "history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    summary = json.loads((folder / "run.json").read_text())
    column = lambda name: np.array([float(row[name]) for row in rows])  # noqa: E731
    return column("time [s]"), 1e-3 * column("reaction_x+_x [N]") / (area * 1e-6), summary["cpu_seconds"]


def climb(titin, folder, task):
    time, exact, _ = run(titin, folder, REFERENCE, task)
    found = {}
    for name, rung in RUNGS.items():
        t, force, cost = run(titin, folder, rung, task)
        there = time <= t[-1] * (1 + 1e-9)
        error = np.max(np.abs(np.interp(time, t, force) - exact)[there]) / np.max(np.abs(exact))
        found[name] = (t, force, cost, error)
        stopped = "" if np.all(there) else f", stopped at {1e3 * t[-1]:.0f} ms without an equilibrium"
        print(f"{task}; {name}: force off by {100 * error:.3g} %, {cost:.2f} CPU seconds{stopped}", flush=True)
    return found


def draw(results, out):
    plt.rcParams.update(STYLE)
    figure, axes = plt.subplots(2, len(results), figsize=(4.3 * len(results), 7.2))
    colours = dict(zip(RUNGS, [*COLOURS, "#b04a7a", "#3a9b9b", "#7d5a3c", "#9a9a3a", "#000000"]))
    for (task, found), (forces, costs) in zip(results.items(), axes.T):
        for name, (t, force, cost, error) in found.items():
            mark = MARKS[RUNGS[name][0]]
            forces.plot(1e3 * t, force, color=colours[name], linewidth=1.3, linestyle=LINES[RUNGS[name][0]])
            costs.plot(cost, 100 * max(error, 1e-6), mark, color=colours[name], markersize=6, label=name)
        forces.set_title(task)
        forces.set_xlabel("time [ms]")
        costs.set(xscale="log", yscale="log", xlabel="CPU seconds of the run", xlim=(0.05, 40), ylim=(1e-4, 300))
        costs.axhline(1, color=INK, linewidth=0.7)
    axes[0][0].set_ylabel("force per area [kPa]")
    axes[1][0].set_ylabel("difference from the slender block [%]")
    figure.tight_layout(rect=(0, 0.09, 1, 1))
    figure.legend(*axes[1][0].get_legend_handles_labels(), loc="lower center", ncols=4, fontsize=8)
    figure.savefig(out, dpi=110)


def main():
    parser = argparse.ArgumentParser(description="Draws one task on every rung from one dimension to three.")
    parser.add_argument("--titin", default=TOP / "build" / "bin" / "titin")
    parser.add_argument("--out", type=pathlib.Path, default=TOP / "docs" / "pictures" / "rod_ladder.png")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        results = {task: climb(arguments.titin, pathlib.Path(scratch) / "run", task) for task in TASKS}
    draw(results, arguments.out)


if __name__ == "__main__":
    main()
