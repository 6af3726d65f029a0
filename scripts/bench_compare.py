"""Two revisions against each other: both are built, run the same cases in turn on this machine, and the ratios of their CPU seconds are printed.
Used by scripts/bench.py --compare.

The older one is built in the cache (titin/compare/COMMIT: delete it at will), against the MFEM of this tree's build folder; what two of them have alike is
compiled once, where ccache is. Both run the scenes of this tree.
Each repetition runs one after the other, so that both have the same company on the machine; what counts is the ratio within a repetition.
"""
import json
import math
import os
import pathlib
import re
import statistics
import subprocess
from dataclasses import dataclass

import environment
from batch import ROOT, Problem

CACHE = pathlib.Path(os.environ.get("XDG_CACHE_HOME", pathlib.Path.home() / ".cache")) / "titin" / "compare"
# Programs of Google Benchmark, and what of them is run: sizes that take seconds.
MICRO = {"material_speed": "^P", "tangent_speed": "/6$|^cell_.*/three_field/", "flow_speed": "/(64|11)$"}


@dataclass
class Revision:
    name: str
    source: pathlib.Path
    build: pathlib.Path

    def program(self, name):
        return self.build / "bin" / name

    def has(self, name):
        return (self.source / "miniapps" / f"{name}.cpp").exists()


def quietly(command, log, settings=None):
    with open(log, "a") as out:
        if subprocess.run(command, stdout=out, stderr=out, env=os.environ | (settings or {})).returncode:
            raise Problem(f"{' '.join(map(str, command[:2]))} failed; see {log}")


def git(*words):
    found = subprocess.run(["git", *map(str, words)], capture_output=True, text=True)
    if found.returncode:
        raise Problem(f"git {' '.join(map(str, words))}: {found.stderr.strip()}")
    return found.stdout.strip()


def older(name, build):
    """Its sources and build folder, configured as `build` is."""
    commit = git("-C", ROOT, "rev-parse", "--short", f"{name}^{{commit}}")
    folder = CACHE / commit
    revision = Revision(commit, folder / "source", folder / "build")
    if not (revision.source / "CMakeLists.txt").exists():
        folder.mkdir(parents=True, exist_ok=True)
        git("clone", "-q", "--shared", "--no-checkout", ROOT, revision.source)
        git("-C", revision.source, "checkout", "-q", "--detach", commit)
    if not (revision.build / "build.ninja").exists():
        kept = re.findall(r"^((?:TITIN_MFEM_PREFIX|TITIN_ARCH|CMAKE_CXX_COMPILER_LAUNCHER|CMAKE_BUILD_TYPE):\w+=.*)$",
                          (build / "CMakeCache.txt").read_text(), re.M)  # fmt: skip
        # ccache takes objects that were made with a precompiled header only when GCC reads it so.
        readable = ["-DCMAKE_CXX_FLAGS=-fpch-preprocess"] if any("ccache" in line for line in kept) else []
        quietly(["cmake", "-S", revision.source, "-B", revision.build, "-G", "Ninja", *(f"-D{line}" for line in kept), *readable], folder / "configure.log")
    return revision


def build_both(name, build, programs):
    if not (build / "CMakeCache.txt").exists():
        raise Problem(f"{build} is no build folder; scripts/setup makes one")
    pair = older(name, build), Revision("this tree", ROOT, build)
    for revision in pair:
        print(f"[compare] building {revision.name} (minutes the first time)", flush=True)
        log = revision.build / "compare.log"
        shared = {"CCACHE_BASEDIR": str(revision.source.parent), "CCACHE_SLOPPINESS": "pch_defines,time_macros"} if revision is pair[0] else {}
        quietly(["cmake", "--build", revision.build, "--target", *filter(revision.has, programs)], log, shared)
    return pair


# ---- what is measured


def ratio_of(pairs):
    """Median over the repetitions of new over old, and its range."""
    ratios = [new / old for old, new in pairs]
    return f"{statistics.median(ratios):.2f} | {min(ratios):.2f} to {max(ratios):.2f}"


@dataclass
class Run:
    label: str
    arguments: list  # of `titin run`
    folder: pathlib.Path


def runs_of(bench):
    """The cases of --quick; of a bench that has none, the first of each curve."""
    quick = any(line.quick for line in bench.lines)
    for line in bench.lines:
        for case in line.cases(quick)[: line.quick if quick else 1]:
            values = " ".join(str(value) for value in case.values.values())
            yield Run(f"{bench.path.stem}: {line.name}, {values}", line.arguments(case), bench.work / "compare")


def run_of(scene, work):
    """At its own size."""
    return Run(pathlib.Path(scene).stem, [scene, "output.fields=false"], work / "compare")


def run_once(revision, run):
    """What run.json says; of a scene that it refuses or that ends without it, nothing but the reason."""
    folder = run.folder / revision.name.replace(" ", "_")
    command = [revision.program("titin"), "run", *run.arguments, "-o", str(folder), "--overwrite", "-q"]
    found = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL, env=environment.mpi())
    if found.returncode == 1 or not (folder / "run.json").exists():
        return {"refused": (found.stderr.strip().splitlines() or [f"exit code {found.returncode}"])[-1]}
    return json.loads((folder / "run.json").read_text())


def answers(old, new):
    """Are steps, iterations and errors of two runs the same?"""
    differ = []
    for key in ("status", "steps", "newton", "krylov"):
        a, b = (run.get(key, {}).get("total") if isinstance(run.get(key), dict) else run.get(key) for run in (old, new))
        if a != b:
            differ.append(f"{key} {a} and {b}")
    a, b = old.get("errors", {}), new.get("errors", {})
    largest = max((abs(a[k] - b[k]) / max(abs(a[k]), 1e-300) for k in a.keys() & b.keys() if math.isfinite(a[k])), default=0)
    if largest:
        differ.append(f"errors by {largest:.0e}")
    return ", ".join(differ) or "the same"


def compare_runs(runs, pair, repetitions):
    print(f"\n| run | {pair[0].name} | {pair[1].name} | ratio | range of {repetitions} | answers |\n|---|---|---|---|---|---|")
    for run in runs:
        times = []
        for _ in range(repetitions):
            gave = [run_once(revision, run) for revision in pair]
            if any("refused" in one for one in gave):
                break
            times.append([one["cpu_seconds"] for one in gave])
        if times:
            least = [min(t[k] for t in times) for k in (0, 1)]
            print(f"| {run.label} | {least[0]:.3g} s | {least[1]:.3g} s | {ratio_of(times)} | {answers(*gave)} |", flush=True)
        else:
            print(f"| {run.label} | {' | '.join(one.get('refused', 'runs') for one in gave)} | | | |", flush=True)


def micro_times(revision, program):
    command = [revision.program(program), f"--benchmark_filter={MICRO[program]}", "--benchmark_min_time=0.02", "--benchmark_format=json"]
    found = subprocess.run(command, capture_output=True, text=True, env=environment.mpi())
    if found.returncode:
        raise Problem(f"{command[0]}: {found.stderr.strip()}")
    unit = {"ns": 1e-3, "us": 1, "ms": 1e3, "s": 1e6}
    return {run["name"]: run["cpu_time"] * unit[run["time_unit"]] for run in json.loads(found.stdout)["benchmarks"]}


def compare_micro(programs, pair, repetitions):
    print(f"\n| micro-benchmark | {pair[0].name} | {pair[1].name} | ratio | range of {repetitions} |\n|---|---|---|---|---|")
    for program in programs:
        if not all(revision.has(program) for revision in pair):
            print(f"| {program} | {' | '.join('' if revision.has(program) else 'is not there' for revision in pair)} | | |")
            continue
        rounds = [[micro_times(revision, program) for revision in pair] for _ in range(repetitions)]
        for name in [n for n in rounds[0][1] if n in rounds[0][0]]:
            times = [(old[name], new[name]) for old, new in rounds]
            least = [min(t[k] for t in times) for k in (0, 1)]
            print(f"| {program} {name} | {least[0]:.3g} us | {least[1]:.3g} us | {ratio_of(times)} |", flush=True)


def compare(name, runs, programs, options):
    """`programs`: of MICRO."""
    pair = build_both(name, pathlib.Path(options.titin).resolve().parent.parent, ["titin", *programs] if runs else programs)
    if runs:
        compare_runs(runs, pair, options.repetitions)
    if programs:
        compare_micro(programs, pair, options.repetitions)
