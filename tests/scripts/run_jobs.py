#!/usr/bin/env python3
"""Submits and sweeps without a cluster: sbatch and scontrol are stand-ins that only write down how they were called; the job
script, the runs in it and the signals are real. Against a real Slurm: run_slurm.py.

    run_jobs.py TITIN
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

ROOT = pathlib.Path(__file__).resolve().parents[2]
BLOCK = str(ROOT / "configs" / "muscle" / "block.toml")
SMALL = ["mesh.cells=[1, 1, 1]", "averages.slab.lower=\"0, 0, 0 mm\"", "output.fields=false"]
SITE = 'launcher = ""\nsetup = ["export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"]\noptions = ["--partition=short"]\n'
SWEEP = """
scene = "{block}"
set = ["mesh.cells=[1, 1, 1]", 'averages.slab.lower="0, 0, 0 mm"', "output.fields=false", "time.end=50 ms"]
collect = ["newton.total", "reaction_x+_x [N]"]
[vary]
"materials.muscle.terms.base.c1" = ["30 kPa", "60 kPa"]
"solver.tolerance" = [1e-6, 1e-8]
"""


class Desk:
    """A folder to work in, with stand-ins for Slurm's programs."""

    def __init__(self, titin, folder):
        self.titin, self.folder, self.wrong, self.checks = titin, pathlib.Path(folder), [], 0
        for program in ("sbatch", "scontrol"):
            path = self.folder / "bin" / program
            path.parent.mkdir(exist_ok=True)
            path.write_text(f'#!/bin/sh\necho "{program} $*" >>"{self.folder}/called"\necho 42\n')
            path.chmod(0o755)
        (self.folder / "site.toml").write_text(SITE)
        self.environment = {**os.environ, "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}", "SLURM_JOB_NODELIST": "here"}

    def script(self, name, *words):
        command = [ROOT / "scripts" / name, *words, "--titin", self.titin]
        return subprocess.run(command, capture_output=True, text=True, cwd=self.folder, env=self.environment)

    def called(self):
        path = self.folder / "called"
        lines = path.read_text().splitlines() if path.exists() else []
        path.unlink(missing_ok=True)
        return lines

    def job(self, script, **variables):
        environment = {**self.environment, "SLURM_JOB_ID": "42", **variables}
        return subprocess.Popen(["bash", script], env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def check(self, is_right, what, shown=""):
        self.checks += 1
        if not is_right:
            self.wrong.append(f"{what}: {shown}")

    def status(self, folder):
        path = self.folder / folder / "run.json"
        return json.loads(path.read_text())["status"] if path.exists() else None


def refusals(desk):
    """One sentence, exit code 1, nothing written."""
    (desk.folder / "full").mkdir()
    (desk.folder / "full" / "notes").touch()
    (desk.folder / "bad.toml").write_text("cores = 3\n")
    (desk.folder / "empty.toml").write_text('scene = "x.toml"\n')
    (desk.folder / "novary.toml").write_text('scene = "x.toml"\n[vary]\ntime.step = 3\n')
    cases = [
        ("submit", ["nothing.toml"], "submit: nothing.toml: the scene file is not there; give the path of a TOML scene"),
        ("submit", [BLOCK, "time.stpe=1 ms"], 'submit: command line: time.stpe: unknown key; did you mean "step"?'),
        ("submit", [BLOCK, "--time", "soon"], "submit: soon is no time limit; write MINUTES, H:MM:SS or DAYS-HH:MM:SS"),
        ("submit", [BLOCK, "--ranks", "0"], "submit: --ranks 0: at least 1"),
        ("submit", [BLOCK, "--ranks", "600"], "submit: 512 cells, 14,739 unknowns: 600 ranks are more than cells; take 2"),
        ("submit", [BLOCK, "--site", "mars"], "submit: there is no site mars; there are generic, one_node, or give the path of a .toml file"),
        ("submit", [BLOCK, "--site", "bad.toml"], "submit: bad.toml: cores is no key of a site; there are launcher, cores_per_node, time, signal_seconds, requeues, options, setup"),
        ("submit", [BLOCK, "-o", "full"], "submit: full is not empty; go on with --restart, replace it with --overwrite, or name another folder with -o"),
        ("submit", [BLOCK, "-o", "full", "--restart"], "submit: full holds no checkpoints to go on from"),
        ("sweep", ["nothing.toml"], "sweep: sweep nothing.toml is not there, or cannot be read"),
        ("sweep", ["bad.toml"], "sweep: bad.toml: unknown key cores; there are case, collect, scene, set, vary"),
        ("sweep", ["empty.toml"], "sweep: empty.toml: there are no cases; add a table [vary]"),
        ("sweep", ["novary.toml"], 'sweep: novary.toml: vary.time is no list of values; a key with dots needs quotation marks: "time" = [1, 2]'),
    ]  # fmt: skip
    before = sorted(desk.folder.rglob("*"))
    for name, words, answer in cases:
        found = desk.script(name, *words)
        desk.check(found.returncode == 1 and found.stderr.strip().splitlines()[-1] == answer, f"{name} {' '.join(words)}", found.stderr)
    desk.check(sorted(desk.folder.rglob("*")) == before, "refusals write nothing")


def submitted(desk):
    """The job that is handed to Slurm, and what it does when it runs, is stopped and is requeued."""
    found = desk.script("submit", BLOCK, "--dry-run", "--site", "site.toml")
    for line in ("#SBATCH --ntasks=2", "#SBATCH --signal=B:USR1@600", "#SBATCH --requeue", "#SBATCH --partition=short", "#SBATCH --time=1-00:00:00"):
        desk.check(line in found.stdout.splitlines(), f"the job has {line}", found.stdout + found.stderr)
    desk.check("512 cells, 14,739 unknowns: 2 ranks, 7,370 unknowns each" in found.stderr, "advice", found.stderr)
    crowded = desk.script("submit", BLOCK, "--dry-run", "--ranks", "32").stderr
    desk.check("they will mostly wait for each other; 2 would do" in crowded, "advice against 32 ranks", crowded)
    words = [BLOCK, *SMALL, "time.step=0.1 ms", "-o", "a b/long", "--site", "site.toml", "--ranks", "1", "--time", "10"]
    found = desk.script("submit", *words)
    script = desk.folder / "a b" / "long.job.sh"
    desk.check(desk.called() == [f"sbatch --parsable {script}"], "sbatch is called with the job", found.stdout + found.stderr)
    check = subprocess.run(["bash", "-n", script], capture_output=True, text=True)
    desk.check(check.returncode == 0, "the job is a shell script", check.stderr)
    first = stopped(desk, script)
    desk.check("the time limit is near" in first and "requeued to go on" in first, "the job stops near its limit", first)
    desk.check(desk.called() == ["scontrol requeue 42"], "and requeues itself", first)
    desk.check(desk.status("a b/long") == "stopped", "the run has stopped cleanly", first)
    last = stopped(desk, script, SLURM_RESTART_COUNT="20")
    desk.check("not requeued: that was done 20 times" in last and desk.called() == [], "it is not requeued for ever", last)
    cancelled = stopped(desk, script, number=signal.SIGTERM, SLURM_RESTART_COUNT="1")
    desk.check("exit code 3" in cancelled and desk.called() == [], "a job that is cancelled stops and stays away", cancelled)


def stopped(desk, script, number=signal.SIGUSR1, **variables):
    """Starts the job, sends it the signal when the run has begun to step, and returns what it said."""
    history = desk.folder / "a b" / "long" / "history.csv"
    before = history.stat().st_mtime_ns if history.exists() else 0
    job = desk.job(script, **variables)
    end = time.monotonic() + 60
    while not (history.exists() and history.stat().st_mtime_ns > before and history.read_text().count("\n") > 3):
        if job.poll() is not None or time.monotonic() > end:
            break
        time.sleep(0.02)
    job.send_signal(number)
    return job.communicate(timeout=60)[0]


def swept(desk):
    (desk.folder / "sweep.toml").write_text(SWEEP.format(block=BLOCK))
    listed = desk.script("sweep", "sweep.toml", "--dry-run").stdout
    desk.check(listed.count("not started") == 4 and not (desk.folder / "results").exists(), "a dry run lists four cases", listed)
    found = desk.script("sweep", "sweep.toml", "--at-once", "2")
    desk.check(found.returncode == 0 and "4 of 4 cases finished" in found.stdout, "four cases run", found.stdout + found.stderr)
    index = desk.folder / "results" / "sweep" / "index.csv"
    rows = list(csv.DictReader(index.open()))
    desk.check([row["status"] for row in rows] == ["finished"] * 4, "the index says so", str(rows))
    desk.check([row["solver.tolerance"] for row in rows] == ["1e-06", "1e-08"] * 2, "every combination, in order", str(rows))
    force = [float(row["reaction_x+_x [N]"]) for row in rows]
    desk.check(abs(force[0] - force[1]) < 1e-4 * force[0] and force[2] > 1.2 * force[0] > 0, "a stiffer base pulls more", str(force))
    desk.check(all(int(row["newton.total"]) >= 4 for row in rows), "keys of run.json are collected", str(rows))
    again = desk.script("sweep", "sweep.toml")
    desk.check("4 cases, 0 to do" in again.stdout and again.returncode == 0, "a second call does nothing", again.stdout)
    (desk.folder / "sweep.toml").write_text(SWEEP.format(block=BLOCK).replace("60 kPa", "70 kPa"))
    other = desk.script("sweep", "sweep.toml")
    desk.check(other.returncode == 1 and "holds other cases" in other.stderr, "other cases want another folder", other.stderr)
    (desk.folder / "sweep.toml").write_text(SWEEP.format(block=BLOCK).replace("60 kPa", "-1 kPa").replace("1e-8", "1"))
    bad = desk.script("sweep", "sweep.toml", "-o", "bad")
    desk.check(bad.returncode == 1 and "case 0001" in bad.stderr and "case 0002" in bad.stderr and not (desk.folder / "bad").exists(),
               "all cases are read before any runs", bad.stderr)  # fmt: skip


def swept_on_slurm(desk):
    """An array job: each task runs the case of its number."""
    (desk.folder / "array.toml").write_text(SWEEP.format(block=BLOCK))
    found = desk.script("sweep", "array.toml", "--slurm", "--site", "site.toml", "--ranks", "1")
    script = desk.folder / "results" / "array" / "job.sh"
    desk.check("#SBATCH --array=0-3" in script.read_text(), "four tasks", found.stdout + found.stderr)
    job = desk.job(script, SLURM_ARRAY_TASK_ID="2")
    said = job.communicate(timeout=60)[0]
    rows = list(csv.DictReader((desk.folder / "results" / "array" / "index.csv").open()))
    desk.check([row["status"] == "finished" for row in rows] == [False, False, True, False], "the third case ran", said)
    desk.called()
    desk.script("sweep", "array.toml", "--slurm", "--site", "site.toml", "--ranks", "1")
    desk.check("#SBATCH --array=0-1,3" in script.read_text(), "what is finished is not submitted again")


def interrupted(desk):
    """Ctrl-C stops the runs cleanly and starts no other; the next call goes on."""
    long = SWEEP.format(block=BLOCK).replace('"time.end=50 ms"', '"time.step=0.1 ms"')
    (desk.folder / "long.toml").write_text(long)
    sweep = subprocess.Popen([ROOT / "scripts" / "sweep", "long.toml", "--titin", desk.titin], cwd=desk.folder, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, text=True, env=desk.environment)  # fmt: skip
    end = time.monotonic() + 60
    while desk.status("results/long/0000") != "running" and time.monotonic() < end:
        time.sleep(0.02)
    time.sleep(0.3)
    sweep.send_signal(signal.SIGINT)
    said = sweep.communicate(timeout=60)[0]
    desk.check(sweep.returncode == 3 and "0000  stopped" in said, "Ctrl-C stops the first run", said)
    desk.check(desk.status("results/long/0001") is None, "and no other starts", said)
    listed = desk.script("sweep", "long.toml", "--dry-run").stdout
    desk.check(bool(re.search(r"^0000  stopped", listed)), "which the next call sees", listed)


def main():
    titin = str(pathlib.Path(sys.argv[1]).absolute())
    with tempfile.TemporaryDirectory() as folder:
        desk = Desk(titin, folder)
        for part in (refusals, submitted, swept, swept_on_slurm, interrupted):
            part(desk)
    print("\n".join(desk.wrong) or f"{desk.checks} checks passed")
    return 1 if desk.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
