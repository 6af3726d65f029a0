#!/usr/bin/env python3
"""Speed and accuracy on the default problem of Flexodeal Lite, against that code. Tables for docs/verification/speed.md.

    scripts/compare_speed.py equal [--titin PROGRAM] [--reference-run COMMAND...]
    scripts/compare_speed.py accuracy [--titin PROGRAM] [--work FOLDER]

`equal`: same mesh (8x8x8), step, order and at least the same tolerance; with as many Gauss points as that code (5) and with
those that suffice (3). A reference run given as a command (in the folder of its input) is timed beside it; otherwise its
cost is the one measured for this page.

`accuracy`: relative error of the reaction at the moved end over the whole history, in the l2 norm over the 20 times that the
reference code prints, against an over-refined solution R*. R* is built from parts that can be afforded: solutions of order 2
on three meshes, each of cells half as long as the last, with the long step, extrapolated to cells of no length by the rate
at which they approach each other (stresses are singular where the ends are held, so the rate is low whatever the order);
plus what short steps change on a coarse mesh, extrapolated to step zero (backward Euler: 2 R(dt/2) - R(dt)). How far the
parts are off, and what the extrapolations change, is printed. `--exact FILE` takes R* from a file that an earlier run wrote
(over_refined.csv in its folder). The same error is given for the reference code's printed force
and for its consistent reaction.

CPU seconds are those of the process, which company on the machine changes little; run alone all the same.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import resource
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENE = ROOT / "configs/muscle/reference/default_dynamic_r3.toml"
PRINTED = ROOT / "tests/data/muscle/default_dynamic_r3_printed_force.csv"
REFERENCE_CPU, REFERENCE_BYTES = 812.0, 634e6  # one thread, idle machine of the kind that the page names
COLUMN = "reaction_x+_x [N]"
RATE = "muscle.fibre_rate=stretch_difference"

# The parts of R*, and the settings that compete: overrides of the scene.
MESHES = ["[4, 3, 3]", "[8, 6, 6]", "[16, 12, 12]"]
FINE = ["muscle.quadrature=3", "solver.tolerance=1e-6"]
OTHER = ["muscle.order=3", "muscle.quadrature=4", "solver.tolerance=1e-6", "mesh.cells=[6, 4, 4]"]  # must come near R*
COARSE = ["mesh.cells=[4, 3, 3]", "muscle.quadrature=3", "solver.tolerance=1e-7"]
STEPS_MS = [25, 1.5625, 0.78125]
WHOLE = ['averages.slab.lower="0, 0, 0 mm"', 'averages.slab.upper="30, 10, 10 mm"']  # coarse meshes have no cell in less
CHEAP = [
    ["mesh.cells=[2, 2, 2]", "time.step=25 ms"],
    ["mesh.cells=[3, 2, 2]", "time.step=25 ms"],
    ["mesh.cells=[4, 2, 2]", "time.step=25 ms"],
    ["mesh.cells=[4, 2, 2]", "time.step=12.5 ms"],
    ["mesh.cells=[4, 3, 3]", "time.step=25 ms"],
    ["mesh.cells=[4, 3, 3]", "time.step=12.5 ms"],
    ["mesh.cells=[4, 4, 4]", "time.step=25 ms"],
    ["mesh.cells=[4, 4, 4]", "time.step=12.5 ms"],
    ["mesh.cells=[8, 8, 8]", "time.step=25 ms"],
]


def run(titin, folder, settings):
    """One run: its history (time, reaction), CPU seconds and largest memory [bytes]."""
    command = [titin, "run", str(SCENE), *settings, "-o", str(folder), "--overwrite", "-q", "output.fields=false"]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    report = json.loads((folder / "run.json").read_text())
    with open(folder / "history.csv") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    history = [(float(row["time [s]"]), float(row[COLUMN])) for row in rows]
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return history, cpu, report["peak_rss_bytes"], report["newton"]["total"]


def reaction(history, times):
    """Linear between the times of a history."""
    found = []
    for t in times:
        (t0, r0), (t1, r1) = next((a, b) for a, b in zip(history, history[1:]) if t <= b[0] * (1 + 1e-12))
        found.append(r0 + (r1 - r0) * (t - t0) / (t1 - t0))
    return found


def relative_error(R, exact):
    return math.dist(R, exact) / math.hypot(*exact)


def equal(options):
    print("| code | Gauss points a direction | CPU | memory | Newton iterations |\n|---|---|---|---|---|")
    cpu, memory = REFERENCE_CPU, REFERENCE_BYTES
    if options.reference_run:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(options.reference_run, check=True, stdout=subprocess.DEVNULL)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        cpu, memory = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, after.ru_maxrss * 1024
    print(f"| Flexodeal Lite v1.5.4 | 5 | {cpu:.0f} s | {memory / 1e6:.0f} MB | 94 |")
    for points in (5, 3):
        settings = [f"muscle.quadrature={points}", "solver.tolerance=1e-6", RATE]
        _, mine, bytes_, newton = run(options.titin, options.work / f"equal_{points}", settings)
        print(f"| Titin | {points} | {mine:.1f} s, {cpu / mine:.0f} times less | {bytes_ / 1e6:.0f} MB, {memory / bytes_:.1f} times less | {newton} |")


def extrapolate_mesh(R):
    """To cells of no length, from three meshes whose cells are halved: the rate is that of their differences' sizes."""
    before, last = math.dist(R[0], R[1]), math.dist(R[1], R[2])
    rate = math.log2(before / last)
    limit = [c + (c - b) / (2**rate - 1) for b, c in zip(R[1], R[2])]
    print(f"space: rate {rate:.2f}; meshes {', '.join(MESHES)} are {', '.join(f'{relative_error(r, limit):.2e}' for r in R)} off the limit")
    return limit


def over_refined(options, times):
    fine = [reaction(run(options.titin, options.work / f"fine_{i}", [*FINE, RATE, *WHOLE, f"mesh.cells={mesh}"])[0], times) for i, mesh in enumerate(MESHES)]
    coarse = [
        reaction(run(options.titin, options.work / f"coarse_{step}", [*COARSE, RATE, f"time.step={step} ms"])[0], times)
        for step in STEPS_MS
    ]
    extrapolated = [2 * b - a for a, b in zip(coarse[1], coarse[2])]
    errors = [f"{relative_error(R, extrapolated):.2e}" for R in coarse]
    other = reaction(run(options.titin, options.work / "other", [*OTHER, RATE, *WHOLE])[0], times)
    limit = extrapolate_mesh(fine)
    print(f"space: order 3 on 6x4x4 cells is {relative_error(other, limit):.2e} off the limit")
    print(f"time: steps {STEPS_MS} ms on the coarse mesh are {', '.join(errors)} off their limit")
    return [f + e - c for f, e, c in zip(limit, extrapolated, coarse[0])]


def read_exact(file, times):
    with open(file) as lines:
        rows = list(csv.reader(line for line in lines if not line.startswith("#")))[1:]
    return reaction([(0.0, 0.0), *((float(t), float(R)) for t, R in rows)], times)


def accuracy(options):
    with open(PRINTED) as file:
        rows = list(csv.reader(file))[2:]  # of head and start
    times, printed = [float(row[0]) for row in rows], [float(row[1]) for row in rows]
    exact = read_exact(options.exact, times) if options.exact else over_refined(options, times)
    lines = [f"{t:g},{R:.8g}" for t, R in zip(times, exact)]
    (options.work / "over_refined.csv").write_text("\n".join(["time [s]," + COLUMN, *lines, ""]))
    print("| code and setting | error of the force | CPU | times cheaper |\n|---|---|---|---|")
    print(f"| Flexodeal Lite, force as printed | {relative_error(printed, exact):.2%} | {REFERENCE_CPU:.0f} s | |")
    same, *_ = run(options.titin, options.work / "consistent", ["solver.tolerance=1e-6"])  # equal to it to solver tolerance
    print(f"| Flexodeal Lite, consistent reaction | {relative_error(reaction(same, times), exact):.2%} | {REFERENCE_CPU:.0f} s | |")
    for i, settings in enumerate(CHEAP + options.setting):
        history, cpu, *_ = run(options.titin, options.work / f"cheap_{i}", ["muscle.quadrature=3", "solver.tolerance=1e-4", RATE, *WHOLE, *settings])
        print(f"| Titin, {', '.join(settings)} | {relative_error(reaction(history, times), exact):.2%} | {cpu:.2f} s | {REFERENCE_CPU / cpu:.0f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["equal", "accuracy"])
    parser.add_argument("--titin", default=str(ROOT / "build/bin/titin"))
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("compare_speed"))
    parser.add_argument("--exact", type=pathlib.Path, help="accuracy: R* from this file")
    parser.add_argument("--setting", nargs="+", action="append", default=[], help="one more competitor: overrides of the scene")
    parser.add_argument("--reference-run", nargs=argparse.REMAINDER, help="command that runs the reference code; last option")
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    {"equal": equal, "accuracy": accuracy}[options.what](options)


if __name__ == "__main__":
    main()
