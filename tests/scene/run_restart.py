#!/usr/bin/env python3
"""Restarts titin on other numbers of ranks, and after kill -9 at any moment.

    run_restart.py TITIN [--kills N] [--only ranks|kills|twice]

Each scene runs whole with checkpoints on one rank and on two. A copy of each goes on from a checkpoint of the middle on
the other number of ranks: its history must be that of the run which never stopped, to round-off; so must its ParaView
index. Then a run that writes a checkpoint after every step is killed N times (default 6), each time after another while,
and restarted: it always finds a whole checkpoint, and in the end its history is that of a run never killed, byte by byte.
At last a second run is started into the folder of one that runs.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

TOP = pathlib.Path(__file__).resolve().parent.parent.parent
MPI_ENVIRONMENT = dict(re.findall(r"\b(OMPI_\w+)=(\S+)", (TOP / "scripts" / "mpi_environment").read_text()))

# scene, overrides, step of the checkpoint, tolerance over the largest number of a column with that unit. The muscle's
# steps are solved to 1e-12, so that ranks differ by round-off; its solver still adds sums in another order.
SCENES = {
    "muscle": ("tests/messages/block.toml",
               ["time.step=5 ms", "solver.tolerance=1e-12", "solver.linear_tolerance=1e-10", "output.checkpoint_every=6"],
               12, 1e-9),
    "sod": ("configs/lagrange/sod.toml", ["mesh.cells=[30, 3]", "output.history_every=1", "output.checkpoint_every=20"],
            40, 1e-10),
    # Every rank computes the whole rod: nothing may differ.
    "rod": ("configs/rod/lifted_load.toml", ["time.end=0.08 s", "output.checkpoint_every=20"], 40, 0),
    "chain": ("configs/rod/chain.toml", ["time.end=0.04 s", "output.checkpoint_every=20"], 40, 0),
}  # fmt: skip


def command(titin, ranks, arguments):
    launcher = ["mpirun", "--quiet", "-np", str(ranks)] if ranks > 1 else []
    return [*launcher, str(titin), "run", *map(str, arguments), "-q"]


def call(titin, ranks, arguments):
    result = subprocess.run(command(titin, ranks, arguments), env=os.environ | MPI_ENVIRONMENT, capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, arguments))}: exit code {result.returncode}\n{result.stderr}")


def table(folder):
    with open(folder / "history.csv") as file:
        rows = list(csv.reader(file))
    return rows[0], [[float(x) for x in row] for row in rows[1:]]


def unit(name):
    return name.rpartition("[")[2]


def difference(one, two):
    """Largest difference in any column over the largest number of its unit; infinite if the tables have other shapes."""
    (head, rows), (other_head, other_rows) = table(one), table(two)
    if head != other_head or len(rows) != len(other_rows):
        return float("inf")
    largest = {}
    for row in rows:
        for name, x in zip(head, row):
            largest[unit(name)] = max(largest.get(unit(name), 0), abs(x))
    return max(abs(x - y) / largest[unit(name)] if largest[unit(name)] else abs(x - y)
               for row, other in zip(rows, other_rows) for name, x, y in zip(head, row, other))  # fmt: skip


def times(folder):
    return [float(t) for t in re.findall(r'timestep="([^"]*)"', (folder / "fields/fields.pvd").read_text())]


def same_times(one, two):
    return len(one) == len(two) and all(math.isclose(a, b, rel_tol=1e-12) for a, b in zip(one, two))


def other_ranks(titin, folder):
    """What is wrong with restarts on other numbers of ranks."""
    for name, (scene, overrides, step, tolerance) in SCENES.items():
        whole = {}
        for ranks in 1, 2:
            whole[ranks] = folder / f"{name}_{ranks}"
            call(titin, ranks, [TOP / scene, *overrides, "output.checkpoint_keep=1000", "-o", whole[ranks]])
        for before, after in (1, 2), (2, 1):
            again = folder / f"{name}_{before}_{after}"
            shutil.copytree(whole[before], again)
            call(titin, after, ["--restart", again / f"checkpoints/step_{step:010}.h5"])
            off = difference(again, whole[before])
            print(f"{name}: {before} -> {after} ranks: histories differ by {off:.1e}", flush=True)
            if not off <= tolerance:
                yield f"{name}: {before} -> {after} ranks: histories differ by {off:.3g}, more than {tolerance:g}"
            if not same_times(times(again), times(whole[before])):
                yield f"{name}: {before} -> {after} ranks: another index of fields"


KILLED = ("tests/messages/block.toml", ["time.step=0.2 ms", "time.end=60 ms", "output.fields=false", "output.checkpoint_every=1"])


def checkpoints(folder):
    return sorted((folder / "checkpoints").glob("step_*.h5"))


def is_writing(folder):
    return bool(list((folder / "checkpoints").glob("*.part")))


def start_and_kill(titin, arguments, folder, while_writing):
    """Kills a run some time after its next checkpoint, or as soon as it then writes one; false if it was done before."""
    before = checkpoints(folder)
    process = subprocess.Popen(command(titin, 1, arguments), env=os.environ | MPI_ENVIRONMENT, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True)  # fmt: skip
    while process.poll() is None and checkpoints(folder) == before:
        time.sleep(0.001)
    if while_writing:
        while process.poll() is None and not is_writing(folder):
            pass
    else:
        time.sleep(random.uniform(0, 0.03))
    process.send_signal(signal.SIGKILL)
    _, said = process.communicate()
    if process.returncode not in (0, -signal.SIGKILL):
        sys.exit(f"a killed run could not go on: {said}")
    return process.returncode != 0


def killed(titin, folder, kills):
    """What is wrong after kills."""
    scene, overrides = KILLED
    never, often = folder / "never_killed", folder / "killed"
    call(titin, 1, [TOP / scene, *overrides, "-o", never])
    random.seed(1)
    arguments = [TOP / scene, *overrides, "-o", often]
    done = while_writing = 0
    for kill in range(kills):
        if not start_and_kill(titin, arguments, often, kill % 2 == 0):
            break
        done += 1
        while_writing += is_writing(often)
        arguments = ["--restart", often]
    call(titin, 1, ["--restart", often])
    last = json.loads((often / "run.json").read_text())
    print(f"killed {done} times, {while_writing} of them while a checkpoint was written; {last['steps']} steps", flush=True)
    if while_writing == 0:
        yield "no kill came while a checkpoint was written"
    if done < kills:
        yield f"the run was over after {done} of {kills} kills: make it longer"
    if (never / "history.csv").read_bytes() != (often / "history.csv").read_bytes():
        yield f"the killed run has another history: it differs by {difference(never, often):.3g}"


def twice(titin, folder):
    """What is wrong with two runs in one folder; the first is stopped so that it holds the folder as long as needed."""
    scene, overrides = KILLED
    run = folder / "twice"
    first = subprocess.Popen(command(titin, 1, [TOP / scene, *overrides, "-o", run]), env=os.environ | MPI_ENVIRONMENT)
    while first.poll() is None and not checkpoints(run):
        time.sleep(0.001)
    first.send_signal(signal.SIGSTOP)
    history = (run / "history.csv").read_bytes()
    for words in ["--restart", run], [TOP / scene, *overrides, "-o", run], [TOP / scene, *overrides, "-o", run, "--overwrite"]:
        second = subprocess.run(command(titin, 1, words), env=os.environ | MPI_ENVIRONMENT, capture_output=True, text=True)
        sentence = f"another run is writing to it (process {first.pid} on "
        if second.returncode != 1 or sentence not in second.stderr:
            yield f"a second run into the folder of one that runs: exit code {second.returncode}, {second.stderr}"
    if (run / "history.csv").read_bytes() != history:
        yield "the second run touched the history of the first"
    first.kill()
    first.wait()
    call(titin, 1, ["--restart", run, "time.end=0.06 s"])
    print("two runs in one folder: the second is refused, until the first is killed", flush=True)


def main():
    parser = argparse.ArgumentParser(description="Restarts titin on other numbers of ranks and after kill -9.")
    parser.add_argument("titin", type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=6)
    parser.add_argument("--only", choices=["ranks", "kills", "twice"])
    arguments = parser.parse_args()
    titin = arguments.titin.resolve()
    wrong = []
    with tempfile.TemporaryDirectory(prefix="titin_restart_") as folder:
        parts = {
            "ranks": lambda: other_ranks(titin, pathlib.Path(folder)),
            "kills": lambda: killed(titin, pathlib.Path(folder), arguments.kills),
            "twice": lambda: twice(titin, pathlib.Path(folder)),
        }
        for name in [arguments.only] if arguments.only else parts:
            wrong += parts[name]()
    for text in wrong:
        print(f"WRONG  {text}")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
