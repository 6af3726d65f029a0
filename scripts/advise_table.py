#!/usr/bin/env python3
"""How honest `titin advise` is: its estimates against over-refined runs, for docs/verification/charts.md.

    scripts/advise_table.py [NAME...] [--titin build/bin/titin] [--work advise]

Each scene is run as it is, as proposed, and with `truth` over it, unless that is exact; the error is the largest difference of the quantity from the truth in
time, over its largest value. Costs are CPU seconds; those of the probes are in a column of their own. A truth that the folder of work has is
not run again, a proposal that would take too long not at all.
"""
import argparse
import csv
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import environment  # noqa: E402

M, L, R = "configs/muscle", "configs/lagrange", "configs/rod"
LONGEST = 100  # CPU seconds: proposals that would take longer are not run
EXACT_WAVE = "tests/data/exact/rod_wave.csv"
REFERENCE = "docs/verification/bench/reference"
# scene: quantity, tolerance, overrides of the truth, or a file that has it; cheap ones first
CASES = {
    f"{R}/cyclic.toml": ("reaction_x+_x", "2%", ["rod.cells=80", "time.step=0.5 ms"]),
    f"{R}/lifted_load.toml": ("reaction_x-_x", "2%", ["rod.cells=64", "time.step=0.1 ms"]),
    f"{R}/stretched.toml": ("reaction_x+_x", "2%", ["rod.cells=320", "time.step=0.01 ms"]),
    f"{M}/gravity.toml": ("marker_tip_uz", "2%", ["mesh.cells=[30, 3, 3]"]),
    f"{L}/rod_wave.toml": ("marker_middle_ux", "5%", EXACT_WAVE),
    f"{M}/rod_wave.toml": ("marker_middle_ux", "5%", EXACT_WAVE),
    f"{L}/swinging_plate.toml": ("energy_kinetic", "10%", ["mesh.cells=[96, 96]"]),
    f"{M}/stiff_base.toml": ("reaction_x+_x", "1%", ["mesh.cells=[6, 4, 4]", "time.step=10 ms"]),
    f"{M}/cook.toml": ("marker_tip_uy", "2%", ["mesh.refine=5"]),
    f"{M}/block.toml": ("reaction_x+_x", "5%", f"{REFERENCE}/muscle_block.csv"),
    f"{M}/beryllium_plate.toml": ("marker_centre_uy", "5%", ["mesh.cells=[48, 8]", "time.step=0.0625 us"]),
    f"{L}/beryllium_plate.toml": ("marker_centre_uy", "10%", "tests/data/lagrange/beryllium_plate.csv"),
    f"{M}/twisting_column.toml": ("marker_tip_uz", "10%", "tests/data/lagrange/twisting_column.csv"),
}


def history(path, quantity):
    with open(path, newline="") as file:
        rows = csv.reader(line for line in file if not line.startswith("#"))
        names = next(rows)
        column = next(i for i, name in enumerate(names) if name.strip().rsplit(" [", 1)[0] == quantity)
        return [(float(row[0]), float(row[column])) for row in rows]


def at(points, time_):
    for (t0, v0), (t1, v1) in zip(points, points[1:]):
        if time_ <= t1:
            return v0 + (v1 - v0) * (time_ - t0) / (t1 - t0)
    return points[-1][1]


def error(points, truth):
    """As titin's own: at the times of the coarser, as long as both go on."""
    end = min(points[-1][0], truth[-1][0]) * (1 + 1e-9)
    points, truth = ([row for row in rows if row[0] <= end] for rows in (points, truth))
    coarse, fine = sorted((points, truth), key=len)
    return max(abs(at(fine, t) - v) for t, v in coarse) / max(abs(v) for _, v in truth)


class Study:
    def __init__(self, options):
        self.titin, self.work = options.titin, options.work

    def call(self, words):
        start = os.times()
        found = subprocess.run([self.titin, *words], capture_output=True, text=True, env=environment.mpi(), cwd=ROOT)
        end = os.times()
        if found.returncode:
            sys.exit(f"{' '.join(words)}: {found.stderr}")
        return found.stdout + found.stderr, end.children_user + end.children_system - start.children_user - start.children_system

    def run(self, scene, folder, overrides, quantity, keep=False):
        path = self.work / folder
        if not (keep and self.has_finished(path)):
            self.call(["run", str(scene), *overrides, "output.fields=false", "-q", "--overwrite", "-o", str(path)])
        return history(path / "history.csv", quantity), json.loads((path / "run.json").read_text())["cpu_seconds"]

    @staticmethod
    def has_finished(path):
        report = path / "run.json"
        return report.exists() and json.loads(report.read_text())["status"] == "finished"

    def row(self, scene):
        quantity, tolerance, truth = CASES[scene]
        name = scene.removeprefix("configs/").removesuffix(".toml").replace("/", "_")
        proposed = self.work / f"{name}.toml"
        asked = ["--quantity", quantity] if quantity else []
        proposed.unlink(missing_ok=True)
        text, probes = self.call(["advise", scene, *asked, "--tolerance", tolerance, "--apply", str(proposed)])
        (self.work / f"{name}.txt").write_text(text)
        quantity = re.search(r'"(.+)" within', text)[1]
        estimate = re.search(r"within about (.+) of the answer", text)[1]
        if "is not reached" in text:
            estimate += ", not reached"
        proposal = re.search(r"proposal: (.*)", text)[1].replace("'", "`")
        if isinstance(truth, str):
            exact = history(ROOT / truth, quantity)
        else:
            exact, _ = self.run(scene, f"{name}_truth", truth, quantity, keep=True)
        own, own_cost = self.run(scene, f"{name}_own", [], quantity)
        head = f"| `{name}`, {quantity} | {tolerance} | {proposal} | {estimate} |"
        costs = float(re.search(r"about (\S+) CPU s \(", text)[1])
        if costs > LONGEST:
            return f"{head} - | {100 * error(own, exact):.2g} % | {probes:.1f} s | {own_cost:.2f} s -> about {costs:.0f} s |"
        cheap, cheap_cost = self.run(proposed, f"{name}_proposed", [], quantity)
        return (f"{head} {100 * error(cheap, exact):.2g} % | {100 * error(own, exact):.2g} % | {probes:.1f} s | "
                f"{own_cost:.2f} s -> {cheap_cost:.2f} s |")  # fmt: skip


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help="parts of the scenes' paths (default: all)")
    parser.add_argument("--titin", default=str(ROOT / "build/bin/titin"))
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("advise"))
    options = parser.parse_args()
    options.work = options.work.absolute()
    options.work.mkdir(parents=True, exist_ok=True)
    print("| scene, quantity | asked | proposal | estimated | true | of the scene as it is | probes | costs |\n|---|---|---|---|---|---|---|---|")
    for scene in CASES:
        if not options.names or any(name in scene for name in options.names):
            print(Study(options).row(scene), flush=True)


if __name__ == "__main__":
    main()
