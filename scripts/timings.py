#!/usr/bin/env python3
"""All timings of docs/verification/solvers.md and speed.md in one go, on an idle machine of two cores.

    scripts/timings.py [growth] [efficiency] [equal] [accuracy] [--build build] [--work timings]

growth: one linear solve at 47, 207 and 499 thousand unknowns. efficiency: one step of the muscle block with 100 thousand
unknowns on one rank and on two. equal, accuracy: scripts/compare_speed.py; the over-refined solution takes some minutes, unless an
earlier run left it in the folder of work (over_refined.csv).
CPU seconds are those of the processes. Efficiencies are given twice: by wall time, which company on the machine spoils, and
by CPU time summed over the ranks, in which ranks that wait for each other count as far as they spin.
"""
import argparse
import json
import pathlib
import subprocess
import sys

import environment

ROOT = pathlib.Path(__file__).resolve().parent.parent
CELLS = (12, 20, 27)
BLOCK = "[16, 16, 15]"  # of Q2: 101 277 unknowns
ASSEMBLY = ("tangent", "residual")


def growth(options):
    print("| unknowns | iterations | set-up | solve | in all, an unknown | memory an unknown |\n|---|---|---|---|---|---|")
    for cells in CELLS:
        command = [options.build / "bin/linear_solver", "--cells", str(cells), "--dt", "1e-3", "--ratio", "1e3"]
        row = json.loads(subprocess.run(command, check=True, capture_output=True, text=True, env=environment.mpi()).stdout)
        setup, solve, n = row["setup_cpu_seconds"], row["solve_cpu_seconds"], row["unknowns"]
        cost, memory = 1e6 * (setup + solve) / n, row["solver_bytes_per_unknown"] / 1e3
        print(f"| {n:,} | {row['iterations']} | {setup:.2f} s | {solve:.2f} s | {cost:.0f} us | {memory:.2f} kB |", flush=True)


def run_block(options, ranks):
    folder = options.work / f"block_{ranks}"
    command = ["mpirun", "-np", str(ranks), options.build / "bin/titin", "run", ROOT / "configs/muscle/block.toml", f"mesh.cells={BLOCK}"]
    command += ["time.end=25 ms", "output.fields=false", "solver.linear=block", "-o", folder, "--overwrite", "-q"]
    subprocess.run(command, check=True, env=environment.mpi())
    return json.loads((folder / "run.json").read_text())


def efficiency(options):
    one, two = run_block(options, 1), run_block(options, 2)
    rows = {
        "assembly": lambda r, what: sum(r["timers"][phase][what] for phase in ASSEMBLY if phase in r["timers"]),
        "linear solves": lambda r, what: sum(
            t[what] for name, t in r["timers"].items() if name not in ASSEMBLY and name in options.solve_phases
        ),
        "all": lambda r, what: r[what + "_seconds"],
    }
    print(f"{one['unknowns']} unknowns, {one['newton']['total']} and {two['newton']['total']} Newton iterations\n")
    print("| phase | one rank: wall, CPU | two ranks: wall, CPU | efficiency by wall, by CPU |\n|---|---|---|---|")
    for name, of in rows.items():
        wall, cpu, wall_two, cpu_two = of(one, "wall"), of(one, "cpu"), of(two, "wall"), of(two, "cpu")
        print(f"| {name} | {wall:.2f} s, {cpu:.2f} s | {wall_two:.2f} s, {cpu_two:.2f} s | {wall / wall_two / 2:.2f}, {cpu / cpu_two:.2f} |")


def compare(what):
    def run(options):
        command = [sys.executable, ROOT / "scripts/compare_speed.py", what, "--titin", options.build / "bin/titin", "--work", options.work]
        known = options.work / "over_refined.csv"
        if what == "accuracy" and known.exists():
            command += ["--exact", known]
        subprocess.run(command, check=True, env=environment.mpi())

    return run


def main():
    parts = {"growth": growth, "efficiency": efficiency, "equal": compare("equal"), "accuracy": compare("accuracy")}
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", nargs="*", choices=[*parts, []])
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build")
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("timings"))
    options = parser.parse_args()
    options.solve_phases = {"linear solve", "preconditioner", "patches", "coarse level", "smoother", "Schur complement"}
    options.work.mkdir(parents=True, exist_ok=True)
    for part in options.parts or parts:
        print(f"\n{part}\n", flush=True)
        parts[part](options)


if __name__ == "__main__":
    main()
