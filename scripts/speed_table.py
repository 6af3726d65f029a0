#!/usr/bin/env python3
"""Prints the table of speeds in docs/verification/materials.md from build/bin/material_speed (Google Benchmark).

    scripts/speed_table.py [--program build/bin/material_speed] [--repetitions 5]

The shortest of the repetitions counts: others had company on their core. Ratios are what to compare between machines.
"""
import argparse
import json
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent


def measure(program, repetitions):
    """Shortest time a point [ns] by what was measured and law."""
    command = [program, f"--benchmark_repetitions={repetitions}", "--benchmark_min_time=0.05"]
    command += ["--benchmark_enable_random_interleaving=true", "--benchmark_format=json"]  # all meet the same neighbours
    answer = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    times = {}
    for run in answer["benchmarks"]:
        if run["run_type"] != "iteration" or "per_point" not in run:
            continue
        what, law = run["run_name"].split("/")[:2]
        times.setdefault(law, {}).setdefault(what, []).append(1e9 * run["per_point"])
    return {law: {what: min(all_of_them) for what, all_of_them in kinds.items()} for law, kinds in times.items()}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", default=str(ROOT / "build/bin/material_speed"))
    parser.add_argument("--repetitions", type=int, default=5)
    options = parser.parse_args()
    times = measure(options.program, options.repetitions)
    unit = times["neo_hookean"]["hand"]
    print(f"One point of P and dP/dF by the loop written by hand: {unit:.0f} ns.\n")
    print("| law | P | P and dP/dF | by differentiation over closed form |")
    print("|---|---|---|---|")
    for law, t in sorted(times.items(), key=lambda item: item[1]["P+A"]):
        ratio = f"{t['AD'] / t['P+A']:.1f}" if "AD" in t else ""
        print(f"| `{law}` | {t['P'] / unit:.2f} | {t['P+A'] / unit:.2f} | {ratio} |")


if __name__ == "__main__":
    main()
