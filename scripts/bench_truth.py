"""Over-refined histories that a bench is compared with (its [[truth]] tables), made by `scripts/bench.py NAME --truth`.

    [[truth]]
    file = "muscle_block.csv"                       # in docs/verification/bench/reference
    scene = "../muscle/block.toml"
    set = ["muscle.fibre_rate=stretch_difference"]  # of all its runs
    column = "reaction_x+_x [N]"
    step = "25 ms"                                  # rows of the file, and the step on all meshes
    meshes = [[4, 3, 3], [8, 6, 6], [16, 12, 12]]   # optional: each of cells half as long as the last
    coarse = [4, 3, 3]                              # the mesh of the short steps
    short = ["1 ms", "0.5 ms"]                      # each half of the last, by
    scheme = "bdf2"                                 # this scheme,
    order = 2                                       # of this order

The parts are added: solutions on three meshes, extrapolated to cells of no length by the rate at which they approach each other
(stresses are singular where ends are held, so the rate is low whatever the element); plus what short steps change on the coarse
mesh, extrapolated to steps of no length. How far each part is from its limit is written into the head of the file.
"""
import csv
import math
import os
import subprocess

from batch import Problem
from bench_results import TRUTHS
from sweep_cases import toml_value

KEYS = {"file", "scene", "set", "column", "step", "meshes", "coarse", "short", "scheme", "order"}


def make(bench, titin):
    for table in bench.truths:
        unknown = sorted(table.keys() - KEYS)
        if unknown:
            raise Problem(f"{bench.path}: truth: unknown key {unknown[0]}; there are {', '.join(sorted(KEYS))}")
        Truth(bench, table, titin).write()


def interpolated(history, times):
    found = []
    for t in times:
        (t0, r0), (t1, r1) = next((a, b) for a, b in zip(history, history[1:]) if t <= b[0] * (1 + 1e-9))
        found.append(r0 + (r1 - r0) * (t - t0) / (t1 - t0))
    return found


def off(values, limit):
    return math.dist(values, limit) / math.hypot(*limit)


class Truth:
    def __init__(self, bench, table, titin):
        self.table, self.titin = table, titin
        self.scene = (bench.path.parent / table["scene"]).resolve()
        self.work = bench.work / "truth" / table["file"].removesuffix(".csv")
        self.file = TRUTHS / table["file"]
        self.notes = []

    def history(self, name, settings):
        folder = self.work / name
        command = [self.titin, "run", str(self.scene), *self.table.get("set", []), *settings, "output.fields=false", "-o", str(folder), "--overwrite", "-q"]
        subprocess.run(command, check=True, env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
        with open(folder / "history.csv", newline="") as file:
            return [(float(row["time [s]"]), float(row[self.table["column"]])) for row in csv.DictReader(file)]

    def on_mesh(self, cells):
        return self.history(f"mesh_{'x'.join(map(str, cells))}", [f"mesh.cells={toml_value(cells)}", f"time.step={self.table['step']}"])

    def by_short_steps(self, step):
        return self.history(f"step_{step.replace(' ', '_')}", [f"mesh.cells={toml_value(self.table['coarse'])}", f"time.step={step}", f"time.scheme={self.table['scheme']}"])

    def limit_of_meshes(self, times):
        R = [interpolated(self.on_mesh(cells), times) for cells in self.table["meshes"]]
        rate = math.log2(math.dist(R[0], R[1]) / math.dist(R[1], R[2]))
        limit = [c + (c - b) / (2**rate - 1) for b, c in zip(R[1], R[2])]
        self.notes.append(f"meshes {self.table['meshes']}: {', '.join(f'{off(r, limit):.2e}' for r in R)} from their limit, approached with rate {rate:.2f}")
        return limit

    def limit_of_steps(self, times):
        longer, shorter = (interpolated(self.by_short_steps(step), times) for step in self.table["short"])
        factor = 2 ** self.table["order"]
        limit = [(factor * b - a) / (factor - 1) for a, b in zip(longer, shorter)]
        self.notes.append(f"steps {self.table['short']} of {self.table['scheme']} on {self.table['coarse']}: {off(longer, limit):.2e}, {off(shorter, limit):.2e} from their limit")
        return limit

    def write(self):
        start = self.on_mesh(self.table["coarse"])
        times = [t for t, _ in start[1:]]
        limit = self.limit_of_steps(times)
        if "meshes" in self.table:
            coarse = interpolated(start, times)
            limit = [m + s - c for m, s, c in zip(self.limit_of_meshes(times), limit, coarse)]
        rows = [(0.0, start[0][1]), *zip(times, limit)]
        TRUTHS.mkdir(parents=True, exist_ok=True)
        lines = [*(f"# {note}" for note in self.notes), f"time [s],{self.table['column']}", *(f"{t:.10g},{R:.8g}" for t, R in rows)]
        self.file.write_text("\n".join(lines) + "\n")
        print("\n".join([f"[bench] {self.file.name}", *(f"[bench]   {note}" for note in self.notes)]), flush=True)
