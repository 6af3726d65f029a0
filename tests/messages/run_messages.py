#!/usr/bin/env python3
"""Gives titin bad input and holds its answers to the exact words, exit code and files of cases.toml.

    run_messages.py TITIN [--only PART-OF-A-NAME] [--print]     --print shows every message, to be read aloud

Each case runs in a folder of its own that holds block.toml, as

    titin ARGUMENTS     (default: run block.toml SET...)

    [[case]]
    name = "..."
    set = ["key=value"]            # overrides
    edit = [["old", "new"]]        # replacements in block.toml
    files = { "name" = "text" }    # more files; "<tests/...>" is the text of a file of this repository, "<N x TEXT>" N times TEXT
    sparse = { "name" = 1000000 }  # files of so many bytes, all zero, that take no space
    before = ["run", "block.toml"] # a run that comes first, and must succeed
    changes = true                 # files of before may change
    cut = { "name" = 100 }         # files that are then cut off after so many bytes
    arguments = ["keys", "tme"]    # instead of run block.toml
    ranks = 2                      # under mpirun
    signal = "TERM"                # sent when the history has grown
    largest_file = 4000            # bytes: from when the history has grown, the disk is full for larger files
    exit = 1                       # the default
    errors = ["..."]               # all of stderr; "<any>" stands for any text, "<here>" for the case's folder
    output = "..."                 # a part of stdout
    writes = ["results/..."]       # files that must be there after; none but these may be new ("results/...*": any)
    report = { status = "..." }    # in results/block/run.json

No case may take more memory than MOST_MEMORY, whatever a file says of itself.
"""
import argparse
import fnmatch
import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parent.parent
MPI_ENVIRONMENT = dict(re.findall(r"\b(OMPI_\w+)=(\S+)", (TOP / "scripts" / "mpi_environment").read_text()))
LONGEST = 60  # [s] for one case; most take a fraction of a second
MOST_MEMORY = 400e6  # [bytes] of a rank; a small run takes a quarter of it


def prepare(case, folder):
    scene = (HERE / "block.toml").read_text()
    for old, new in case.get("edit", []):
        if old not in scene:
            sys.exit(f"{case['name']}: block.toml has no {old!r}")
        scene = scene.replace(old, new)
    (folder / "block.toml").write_text(scene)
    for name, text in case.get("files", {}).items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if text.startswith("<tests/"):
            text = (TOP / text.strip("<>")).read_text()
        elif repeated := re.fullmatch(r"<(\d+) x (.*)>", text, re.DOTALL):
            text = int(repeated[1]) * repeated[2]
        path.write_bytes(text.encode("latin-1"))  # so that cases can hold bytes that are not UTF-8
    for name, size in case.get("sparse", {}).items():
        with open(folder / name, "wb") as file:
            file.truncate(size)


def contents(folder):
    """Of all files; of very large ones the size."""
    return {p.relative_to(folder).as_posix(): p.read_bytes() if p.stat().st_size < 1e8 else b"%d" % p.stat().st_size
            for p in folder.rglob("*") if p.is_file()}  # fmt: skip


def wait_for_steps(folder, process):
    """Until the history holds a step, or the run has ended."""
    history = folder / "results/block/history.csv"
    while process.poll() is None and not (history.exists() and history.read_text().count("\n") > 2):
        time.sleep(0.01)


def finish(process):
    """Waits for the process, at most LONGEST: its exit code and its largest memory [bytes]."""
    end = time.monotonic() + LONGEST
    while True:
        pid, status, usage = os.wait4(process.pid, os.WNOHANG)
        if pid:
            break
        if time.monotonic() > end:
            process.kill()
        time.sleep(0.005)
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, usage.ru_maxrss * 1024


def run(case, titin, folder):
    command = [str(titin), *case.get("arguments", ["run", "block.toml"]), *case.get("set", [])]
    if case.get("ranks", 1) > 1:
        command = ["mpirun", "--quiet", "-np", str(case["ranks"]), *command]
    out, err = tempfile.TemporaryFile("w+", errors="replace"), tempfile.TemporaryFile("w+", errors="replace")
    process = subprocess.Popen(command, cwd=folder, env=os.environ | MPI_ENVIRONMENT, stdin=subprocess.DEVNULL,
                               stdout=out, stderr=err, restore_signals="largest_file" not in case)  # fmt: skip
    if "largest_file" in case:  # the signal that goes with it stays ignored, as it is in Python: the write fails
        wait_for_steps(folder, process)
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (case["largest_file"], resource.RLIM_INFINITY))
    if "signal" in case:
        wait_for_steps(folder, process)
        process.send_signal(signal.Signals["SIG" + case["signal"]])
    code, memory = finish(process)
    out.seek(0), err.seek(0)
    return code, out.read(), err.read().rstrip("\n").replace(str(folder), "<here>"), memory


def same(text, wanted):
    pattern = ".*".join(re.escape(part) for part in wanted.split("<any>"))
    return re.fullmatch(pattern, text) is not None


def wrong_files(case, before, after):
    allowed = case.get("writes", [])
    for name, bytes_before in before.items():
        if after.get(name) != bytes_before and not case.get("changes"):
            yield f"touched {name}"
    for name in after.keys() - before.keys():
        if not any(fnmatch.fnmatchcase(name, pattern) for pattern in allowed):
            yield f"wrote {name}"
    for pattern in allowed:
        if not fnmatch.filter(after, pattern):
            yield f"did not write {pattern}"


def complaints(case, titin, folder):
    """What is wrong with titin's answer."""
    prepare(case, folder)
    if "before" in case:
        first = subprocess.run([titin, *case["before"]], cwd=folder, env=os.environ | MPI_ENVIRONMENT, capture_output=True)
        if first.returncode != 0:
            yield f"the run before ended with {first.returncode}: {first.stderr.decode()}"
    for name, size in case.get("cut", {}).items():
        os.truncate(folder / name, size)
    before = contents(folder)
    code, out, err, memory = run(case, titin, folder)
    if memory > MOST_MEMORY:
        yield f"took {memory / 1e6:.0f} MB"
    if "--print" in sys.argv:
        print(f"\n{case['name']}\n{err}")
    after = contents(folder)
    if code != case.get("exit", 1):
        yield f"exit code {code}, not {case.get('exit', 1)}"
    wanted = "\n".join(case.get("errors", []))
    if not same(err, wanted):
        yield f"said:\n{err}\nnot:\n{wanted}"
    if case.get("output", "") not in out:
        yield f"printed:\n{out}\nwithout:\n{case['output']}"
    yield from wrong_files(case, before, after)
    if "report" in case:
        report = json.loads(after.get("results/block/run.json", b"{}"))
        yield from (f"run.json: {k} is {report.get(k)!r}" for k, v in case["report"].items() if report.get(k) != v)


def main():
    parser = argparse.ArgumentParser(description="Holds titin's messages to cases.toml.")
    parser.add_argument("titin", type=pathlib.Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--print", action="store_true")
    arguments = parser.parse_args()
    cases = [c for c in tomllib.loads((HERE / "cases.toml").read_text())["case"] if arguments.only in c["name"]]
    failed = 0
    for case in cases:
        with tempfile.TemporaryDirectory(prefix="titin_messages_") as folder:
            wrong = list(complaints(case, arguments.titin.resolve(), pathlib.Path(folder)))
        failed += bool(wrong)
        for text in wrong:
            print(f"WRONG  {case['name']}: {text}", flush=True)
    print(f"{len(cases) - failed} of {len(cases)} messages are right")
    sys.exit(0 if cases and not failed else 1)


if __name__ == "__main__":
    main()
