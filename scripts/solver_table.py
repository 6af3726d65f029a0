#!/usr/bin/env python3
"""Iterations, CPU time and memory of one linear solve over the regimes of docs/verification/solvers.md, as a table in Markdown.

    scripts/solver_table.py --program BUILD/bin/linear_solver [--cells 7 12] [--tolerance 1e-4]

CPU seconds are those of the process; run it on a machine that is idle otherwise. Each row is one process.
"""
import argparse
import itertools
import json
import subprocess

FIBRES = {"none": [], "20 mu": ["--fibre", "20", "--strain", "0.1"]}
SHAPES = {"cube": [], "bent cells": ["--distort", "0.04"], "5:1": ["--aspect", "5"]}
RATIOS = ["1e2", "1e3", "1e4"]
STEPS = ["0", "1e-2", "1e-3", "1e-4"]


def solve(program, options):
    result = subprocess.run([program, *options], capture_output=True, text=True)
    if result.returncode:
        raise SystemExit(f"{program} {' '.join(options)}:\n{result.stderr}")
    return json.loads(result.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--cells", nargs="+", default=["7"])
    parser.add_argument("--tolerance", default="1e-4")
    parser.add_argument("--method", default="block")
    asked = parser.parse_args()
    print("| unknowns | shape | fibres | bulk/shear | iterations: static | 10 ms | 1 ms | 0.1 ms | CPU s: set-up + solve, 1 ms | B/unknown |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for cells, shape, fibre, ratio in itertools.product(asked.cells, SHAPES, FIBRES, RATIOS):
        options = ["--cells", cells, "--ratio", ratio, "--tolerance", asked.tolerance, "--method", asked.method]
        rows = [solve(asked.program, options + SHAPES[shape] + FIBRES[fibre] + ["--dt", dt]) for dt in STEPS]
        iterations = " | ".join(str(r["iterations"]) + ("" if not r["failure"] else " (failed)") for r in rows)
        timed = rows[2]
        print(
            f"| {timed['unknowns']} | {shape} | {fibre} | {ratio} | {iterations} "
            f"| {timed['setup_cpu_seconds']:.2f} + {timed['solve_cpu_seconds']:.2f} | {timed['solver_bytes_per_unknown']:.0f} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
