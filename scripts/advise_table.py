#!/usr/bin/env python3
"""How honest `titin advise` is: its estimates against over-refined runs, for docs/verification/advise.md.

    scripts/advise_table.py [NAME...] [--titin build/bin/titin] [--work advise]

Each scene is run as it is, as proposed, and with `truth` over it; the error is the largest difference of the quantity from the truth in
time, over its largest value. Costs are CPU seconds; those of the probes are in a column of their own.
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

M, L = "configs/muscle", "configs/lagrange"
# scene: quantity, tolerance, overrides of the truth
CASES = {
    f"{M}/block.toml": ("reaction_x+_x", "5%", ["mesh.cells=[10, 10, 10]", "time.step=4 ms"]),
    f"{M}/twisting_column.toml": ("marker_tip_uz", "5%", ["mesh.cells=[4, 4, 24]", "time.step=0.25 ms"]),
    f"{M}/beryllium_plate.toml": ("marker_centre_uy", "5%", ["mesh.cells=[48, 8]", "time.step=0.05 us"]),
    f"{M}/cook.toml": ("marker_tip_uy", "2%", ["mesh.refine=5"]),
    f"{M}/stiff_base.toml": ("reaction_x+_x", "1%", ["mesh.cells=[6, 4, 4]", "time.step=10 ms"]),
    f"{M}/swinging_plate.toml": ("energy_kinetic", "1%", ["mesh.cells=[24, 24]", "time.step=0.05 ms"]),
    f"{M}/gravity.toml": ("marker_tip_uz", "2%", ["mesh.cells=[30, 3, 3]"]),
    f"{M}/two_materials.toml": ("reaction_proximal_end_x", "3%", ["mesh.refine=2", "time.step=10 ms"]),
    f"{L}/swinging_plate.toml": ("energy_kinetic", "10%", ["mesh.cells=[192, 192]"]),
    f"{L}/beryllium_plate.toml": ("marker_centre_uy", "10%", ["mesh.cells=[288, 48]"]),
}


def history(folder, quantity):
    with open(folder / "history.csv", newline="") as file:
        rows = csv.reader(file)
        names = next(rows)
        column = next(i for i, name in enumerate(names) if name.rsplit(" [", 1)[0] == quantity)
        return [(float(row[0]), float(row[column])) for row in rows]


def at(points, time_):
    for (t0, v0), (t1, v1) in zip(points, points[1:]):
        if time_ <= t1:
            return v0 + (v1 - v0) * (time_ - t0) / (t1 - t0)
    return points[-1][1]


def error(points, truth):
    """As titin's own: at the times of the coarser."""
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
        return found.stdout, end.children_user + end.children_system - start.children_user - start.children_system

    def run(self, scene, folder, overrides, quantity):
        path = self.work / folder
        self.call(["run", str(scene), *overrides, "output.fields=false", "-q", "--overwrite", "-o", str(path)])
        return history(path, quantity), json.loads((path / "run.json").read_text())["cpu_seconds"]

    def row(self, scene):
        quantity, tolerance, truth = CASES[scene]
        name = scene.removeprefix("configs/").removesuffix(".toml").replace("/", "_")
        proposed = self.work / f"{name}.toml"
        asked = ["--quantity", quantity] if quantity else []
        text, probes = self.call(["advise", scene, *asked, "--tolerance", tolerance, "--apply", str(proposed)])
        quantity = re.search(r'"(.+)" within', text)[1]
        estimate = re.search(r"within about (.+) of the answer", text)[1]
        proposal = re.search(r"proposal: (.*)", text)[1].replace("'", "`")
        exact, _ = self.run(scene, f"{name}_truth", truth, quantity)
        own, own_cost = self.run(scene, f"{name}_own", [], quantity)
        cheap, cheap_cost = self.run(proposed, f"{name}_proposed", [], quantity)
        return (f"| `{name}`, {quantity} | {tolerance} | {proposal} | {estimate} | {100 * error(cheap, exact):.2g} % | "
                f"{100 * error(own, exact):.2g} % | {probes:.1f} s | {own_cost:.2f} s -> {cheap_cost:.2f} s |")  # fmt: skip


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
