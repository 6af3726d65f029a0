#!/usr/bin/env python3
"""Submits, sweeps, meets the wall-time and goes on, with a real Slurm of one node that the test starts itself. Opt-in: some minutes.

    TITIN_TEST_SLURM=1 run_slurm.py TITIN [LOG]      LOG: what a user sees, for docs/howto/cluster.md

Skipped (exit 77) without TITIN_TEST_SLURM=1, without root, or where Debian's slurm-wlm and munge are not installed.
"""
import csv
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from one_node_slurm import OneNodeSlurm, missing  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
SKIPPED = 77
BLOCK = str(ROOT / "configs" / "muscle" / "block.toml")
# One minute is Slurm's shortest limit: the run is asked to stop 30 s before it.
SITE = """launcher = "mpirun --quiet -np {{ranks}}"
setup = [". {root}/scripts/mpi_environment"]
signal_seconds = 30
time = "1"
"""
SMALL = ["mesh.cells=[1, 1, 1]", 'averages.slab.lower="0, 0, 0 mm"', "output.fields=false"]
# Steps that take about two minutes, so that the limit of one is met, and met again.
LONG_SECONDS = 100
# A run that goes on factorises anew, so that it is the same to what Newton's method leaves (tolerance 1e-6 in force).
SAME = 1e-5
SWEEP = """scene = "{block}"
set = ["mesh.cells=[1, 1, 1]", 'averages.slab.lower="0, 0, 0 mm"', "output.fields=false", "time.end=0.2 s"]
collect = ["reaction_x+_x [N]"]
[vary]
"materials.muscle.terms.base.c1" = ["20 kPa", "40 kPa", "80 kPa"]
"""


class Session:
    """A user before a terminal: what he types and what he sees goes into the log."""

    def __init__(self, titin, folder, slurm):
        self.titin, self.folder, self.slurm = titin, folder, slurm
        self.log, self.wrong, self.checks = [], [], 0
        (folder / "here.toml").write_text(SITE.format(root=ROOT))

    def types(self, *words):
        """Scripts of ours find the program and the site; the log shows what a user would type."""
        command = [str(ROOT / words[0]) if words[0].startswith("scripts/") else words[0], *words[1:]]
        extra = ["--site", "here.toml", "--titin", self.titin] if words[0].startswith("scripts/") else []
        found = self.slurm.run(*command, *extra, cwd=self.folder)
        self.log.append("$ " + " ".join(w if re.fullmatch(r"[\w./=+-]+", w) else f"'{w}'" for w in words))
        self.log += (found.stderr + found.stdout).rstrip().splitlines()
        return found

    def check(self, is_right, what, shown=""):
        self.checks += 1
        print(f"{'ok ' if is_right else 'BAD'} {what}", flush=True)
        if not is_right:
            self.wrong.append(f"{what}: {shown}")

    def run_json(self, name):
        return json.loads((self.folder / "results" / name / "run.json").read_text())


def history(folder):
    with open(folder / "history.csv", newline="") as file:
        heads, *rows = csv.reader(file)
    return heads, [[float(x) for x in row] for row in rows]


def difference(whole, parts):
    """The largest, relative to the largest value in the same unit; some columns vanish by symmetry."""
    heads, rows = whole
    units = [re.sub(r".*\[|\]$", "", head) if "[" in head else head for head in heads]
    largest = {}
    for unit, column in zip(units, zip(*rows)):
        largest[unit] = max(largest.get(unit, 0), *map(abs, column))
    return max(abs(a - b) / (largest[unit] or 1) for row, other in zip(rows, parts[1]) for unit, a, b in zip(units, row, other))


def a_short_job(session):
    found = session.types("scripts/submit", BLOCK, *SMALL, "-o", "results/short")
    number = re.search(r"job (\d+);", found.stdout)
    session.check(found.returncode == 0 and number is not None, "submit hands in a job", found.stdout + found.stderr)
    session.slurm.wait_for_job(number[1], 120)
    session.check(session.run_json("short")["status"] == "finished", "which runs and finishes")


def seconds_a_step(session):
    """Measured on this machine, now: the long job must meet its limit whatever its speed."""
    start = time.monotonic()
    words = [session.titin, "run", BLOCK, *SMALL, "time.step=1 ms", "-o", "results/speed"]
    subprocess.run(words, cwd=session.folder, capture_output=True, check=True)
    return (time.monotonic() - start) / 500


def a_job_that_meets_its_limit(session):
    steps = max(2000, int(LONG_SECONDS / seconds_a_step(session)))
    words = [BLOCK, *SMALL, f"time.step={0.5 / steps:.3g} s", "-o", "results/long", "--ranks", "1"]
    found = session.types("scripts/submit", *words)
    number = re.search(r"job (\d+);", found.stdout)[1]
    log = session.folder / "results" / "long.job.log"
    session.slurm.wait_for(lambda: log.exists() and "requeued to go on" in log.read_text(), "the requeue", 180)
    session.types("squeue", "-o", "%i %j %T %r")
    stopped = session.run_json("long")
    session.check(stopped["status"] == "stopped" and 0 < stopped["time"] < 0.5, "the run stops near its limit", stopped["status"])
    session.slurm.wait_for_job(number, 1200)
    session.types("cat", "results/long.job.log")
    text = log.read_text()
    starts = re.findall(r"start (\d+): titin run .*? (--restart|-o) ", text)
    session.check(len(starts) >= 2 and starts[0][1] == "-o" and all(how == "--restart" for _, how in starts[1:]), "it goes on from its checkpoint", starts)
    session.check(session.run_json("long")["status"] == "finished", "and finishes", session.run_json("long")["status"])
    reference = [session.titin, "run", *[w for w in words if not w.startswith(("-", "results", "1"))], "-o", "results/whole"]
    subprocess.run(reference, cwd=session.folder, capture_output=True, check=True)
    whole, parts = (history(session.folder / "results" / name) for name in ("whole", "long"))
    same = [row[0] for row in whole[1]] == [row[0] for row in parts[1]]
    session.check(same, f"with the same times as a run that was never stopped: {len(whole[1])} rows")
    off = difference(whole, parts)
    session.check(off < SAME, f"and the same history: {off:.1e} of the largest value in the same unit", off)


def a_sweep(session):
    (session.folder / "stiffness.toml").write_text(SWEEP.format(block=BLOCK))
    session.types("cat", "stiffness.toml")
    found = session.types("scripts/sweep", "stiffness.toml", "--slurm", "--ranks", "1")
    number = re.search(r"job (\d+):", found.stdout)
    session.check(number is not None, "a sweep hands in an array", found.stdout + found.stderr)
    session.slurm.wait_for_job(number[1], 240)
    index = session.types("cat", "results/stiffness/index.csv").stdout
    rows = list(csv.DictReader(index.splitlines()))
    force = [float(row["reaction_x+_x [N]"]) for row in rows]
    session.check([row["status"] for row in rows] == ["finished"] * 3 and force == sorted(force), "three cases, one index", index)
    again = session.types("scripts/sweep", "stiffness.toml", "--slurm", "--ranks", "1")
    session.check("0 to do" in again.stdout, "which is not done twice", again.stdout)


def main():
    if os.environ.get("TITIN_TEST_SLURM") != "1" or missing():
        print(f"skipped: set TITIN_TEST_SLURM=1{'; missing: ' + ', '.join(missing()) if missing() else ''}")
        return SKIPPED
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # the daemons are ended then, too
    titin = str(pathlib.Path(sys.argv[1]).absolute())
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        (folder / "slurm").mkdir(mode=0o755)
        with OneNodeSlurm(folder / "slurm") as slurm:
            session = Session(titin, folder, slurm)
            try:
                for part in (a_short_job, a_sweep, a_job_that_meets_its_limit):
                    part(session)
            finally:
                text = "\n".join(session.log).replace(str(ROOT), "titin").replace(scratch, "/scratch") + "\n"
                print(text)
                if len(sys.argv) > 2:
                    pathlib.Path(sys.argv[2]).write_text(text)
    print("\n".join(session.wrong) or f"{session.checks} checks passed")
    return 1 if session.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
