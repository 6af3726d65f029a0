#!/usr/bin/env python3
"""Iterations, CPU time and memory of one linear solve over the regimes of docs/verification/solvers.md, as a table in Markdown.

    scripts/solver_table.py [--program build/bin/linear_solver] [--cells 7 12 20 27] [--shapes cube] [--fibres none] [--ratios 1e4] [--steps 0 1e-3]

7, 12, 20 and 27 cells along an edge are 10 to 499 thousand unknowns. Without other options every regime is run, one process
each; those name some of them. CPU seconds are those of the process, of the last step: compare them on an idle machine only.
"""
import argparse
import itertools
import json
import subprocess

FIBRES = {"none": [], "20 mu": ["--fibre", "20", "--strain", "0.1"]}
SHAPES = {"cube": [], "bent cells": ["--distort", "0.04"], "5:1": ["--aspect", "5"]}
RATIOS = ["1e2", "1e3", "1e4"]
STEPS = ["0", "1e-2", "1e-3", "1e-4"]
STEP_NAMES = {"0": "static", "1e-2": "10 ms", "1e-3": "1 ms", "1e-4": "0.1 ms"}


def solve(program, options):
    result = subprocess.run([program, *options], capture_output=True, text=True)
    if result.returncode:
        raise SystemExit(f"{program} {' '.join(options)}:\n{result.stderr}")
    return json.loads(result.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/bin/linear_solver")
    parser.add_argument("--cells", nargs="+", default=["7"])
    parser.add_argument("--shapes", nargs="+", choices=SHAPES, default=list(SHAPES))
    parser.add_argument("--fibres", nargs="+", choices=FIBRES, default=list(FIBRES))
    parser.add_argument("--ratios", nargs="+", default=RATIOS)
    parser.add_argument("--steps", nargs="+", choices=STEPS, default=STEPS)
    parser.add_argument("--tolerance", default="1e-6")
    parser.add_argument("--method", default="block")
    asked = parser.parse_args()
    names = " | ".join(STEP_NAMES[step] for step in asked.steps)
    print(f"| unknowns | cells | fibres | bulk/shear | iterations: {names} | set-up + solve, the last | memory an unknown |")
    print("|---" * (6 + len(asked.steps)) + "|", flush=True)
    for cells, shape, fibre, ratio in itertools.product(asked.cells, asked.shapes, asked.fibres, asked.ratios):
        options = ["--cells", cells, "--ratio", ratio, "--tolerance", asked.tolerance, "--method", asked.method]
        rows = [solve(asked.program, options + SHAPES[shape] + FIBRES[fibre] + ["--dt", dt]) for dt in asked.steps]
        iterations = " | ".join(str(r["iterations"]) + ("" if not r["failure"] else " (failed)") for r in rows)
        timed = rows[-1]
        print(
            f"| {timed['unknowns']:,} | {shape} | {fibre} | {ratio} | {iterations} "
            f"| {timed['setup_cpu_seconds']:.2f} + {timed['solve_cpu_seconds']:.2f} s | {timed['solver_bytes_per_unknown'] / 1e3:.2f} kB |",
            flush=True,
        )


if __name__ == "__main__":
    main()
