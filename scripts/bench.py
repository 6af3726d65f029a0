#!/usr/bin/env python3
"""Runs the product over a table of settings and charts error against resolution, CPU time and memory.

    scripts/bench.py                      lists the benches
    scripts/bench.py swinging_plate       runs what is not in its table yet, then draws
    scripts/bench.py swinging_plate --draw        only draws
    scripts/bench.py swinging_plate --again "P1"  runs the sweeps whose name begins so again
    scripts/bench.py muscle_block --truth         makes its over-refined histories again (its [[truth]], scripts/bench_truth.py)
    scripts/bench.py --quick NAME...      the small cases, into a folder of work; asserts orders and the place of our defaults
    scripts/bench.py --compare REV        speed of this tree over that of a revision: the small cases and the micro-benchmarks, in turn
    scripts/bench.py --compare REV swinging_plate tangent_speed configs/lagrange/sedov.toml      of these benches, programs and scenes alone

A bench is a file of configs/bench/:

    title = "The swinging plate"
    reference = "exact for small amplitudes"     # what the error is against; named on the chart
    error = "velocity_L2"                        # of errors in run.json, "PATH of run.json" (newton.total), or "COLUMN of history, largest"
                                                 # (smallest, last, variation, range: largest minus smallest; momentum_*: of all axes together)
    label = "error of the velocity in L2"        # of the axis
    exact = 0.0                                  # what is taken from it, where it is a value and no error yet
    scale = 1.0                                  # what that is divided by
    dimension = 2                                # of the cells: h = cells^(-1/dimension)
    history = "muscle_block.csv"                 # optional: of bench/reference, for errors "COLUMN_l2" or "COLUMN_max" against it
    limit = 600                                  # [s] CPU time after which a run has failed
    against = "h"                                # or "dt": the first chart's axis

    [[sweep]]                                    # a curve: what scripts/sweep reads, and
    name = "Q2/P1, Newmark"
    default = true                               # optional: what a scene gets that says nothing
    front = false                                # optional; --quick asserts where it is true, as it is for a default that says nothing, that the
                                                 # last small case is on the front of error against work, among those of the formulation
    as_default = 1e-3                            # optional: asserted by --quick, that errors are the default's, to this part of them
    exact = 0.5                                  # optional, as error and scale: its own, instead of the bench's
    order = 1.8                                  # optional: asserted by --quick, at least
    quick = 2                                    # optional: its first cases are part of --quick
    scene = "../muscle/swinging_plate.toml"
    set = ["time.scheme=newmark"]
    vary."mesh.cells" = [[4, 4], [8, 8]]

    [map]                                        # optional: a map of where methods work instead of curves
    x = "fv.cfl"                                 # keys that the sweeps vary
    y = "fv.predictor"                           # (or "sweep": one row for each)
    x_ticks = ["0.3", "0.49"]                    # optional: what is written for the values of x (y_ticks; x_label, y_label: for the keys)
    degrades = 10                                # an error of this many times the best one of its row
    or_above = 0.01                              # and, instead, whatever the best: an error above this
    fails_above = 0.5                            # optional: an error above this is no answer

Runs go one after the other (their CPU seconds are compared) into results/bench/NAME; rows into docs/verification/bench/NAME.csv, which is only
appended to; the chart is docs/pictures/bench_NAME.png. Needs the Python libraries of python_requirements.txt.
"""
import argparse
import pathlib
import resource
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import bench_compare  # noqa: E402
import bench_truth  # noqa: E402
import environment  # noqa: E402
from batch import ROOT, Problem, check_scene, guarded  # noqa: E402
from bench_results import Bench, fitted_order, pareto_front, revision  # noqa: E402

BENCHES = ROOT / "configs" / "bench"


def parse_arguments():
    parser = argparse.ArgumentParser(prog="scripts/bench.py", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help="benches: files of configs/bench/ without .toml")
    parser.add_argument("--draw", action="store_true", help="only draw what the tables have")
    parser.add_argument("--truth", action="store_true", help="make the over-refined histories again, nothing else")
    parser.add_argument("--again", metavar="SWEEP", help="run the sweeps whose name begins so again ('' for all)")
    parser.add_argument("--quick", action="store_true", help="only small cases; asserts what must hold, writes nothing into docs")
    parser.add_argument("--compare", metavar="REV", help="build a revision as well and print ratios of CPU seconds; writes nothing into docs")
    parser.add_argument("--repetitions", type=int, default=5, help="of each case of --compare")
    parser.add_argument("--titin", default=str(ROOT / "build" / "bin" / "titin"), help="the program")
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("results") / "bench", help="folder of the runs")
    return parser.parse_args()


def open_bench(name, options):
    path = BENCHES / f"{name}.toml"
    if not path.exists():
        there = ", ".join(sorted(p.stem for p in BENCHES.glob("*.toml")))
        raise Problem(f"there is no bench {name}; there are {there}")
    return Bench(path, options.work.absolute() / name)


def wanted(bench, options, rows):
    """What is not in the table, or is asked for again."""
    for line in bench.lines:
        again = options.again is not None and line.name.startswith(options.again)
        for case in line.cases(options.quick):
            if again or options.quick or (line.name, line.key(case)) not in rows:
                yield line, case


def run(bench, line, case, options):
    line.sweep.folder.mkdir(parents=True, exist_ok=True)
    folder = line.sweep.folder / case.name
    command = [options.titin, "run", *line.arguments(case), "-o", str(folder), "--overwrite", "-q"]
    def limited():
        resource.setrlimit(resource.RLIMIT_CPU, (bench.limit, bench.limit))

    with open(line.sweep.file(case, "log"), "w") as log:
        subprocess.run(command, stdout=log, stderr=log, stdin=subprocess.DEVNULL, env=environment.mpi(), preexec_fn=limited)


def run_all(bench, options, file):
    rows = bench.rows(file)
    todo = list(wanted(bench, options, rows))
    problems = []
    for line, case in todo:  # all mistakes before anything runs
        try:
            check_scene(options.titin, line.arguments(case))
        except Problem as problem:
            problems.append(f"{line.name}, {line.key(case)}: {problem}")
    if problems:
        raise Problem("\n".join(problems))
    for n, (line, case) in enumerate(todo, 1):
        run(bench, line, case, options)
        row = bench.row(line, case)
        bench.append(row, file)
        print(f"[bench] {n}/{len(todo)} {line.name}: {row.status}, error {row.error:.3g}, {row.values['cpu_seconds']} CPU s", flush=True)


def check_quick(bench, rows):
    """What must hold of the small cases."""
    for line in bench.lines:
        if line.quick:
            of_line = bench.of(line, rows, quick=True)
            ended = all(row.status == "finished" for row in of_line)
            yield from (f"{bench.path.stem}, {line.name}: {what}" for what in (wrong_with(bench, line, of_line, rows) if ended else ["a run did not finish"]))


def wrong_with(bench, line, of_line, rows):
    """Its order, its place among the others, and whether its errors are those of the default."""
    order = fitted_order(bench, of_line)
    if line.order is not None and not order >= line.order:
        yield f"order {order:.2f}, and not {line.order} or more"
    others = [other for other in bench.lines if other is not line and other.history == line.history]
    if line.on_front:
        rivals = [row for other in others for row in bench.of(other, rows, quick=True) if row.values["model"] == of_line[-1].values["model"]]
        if not rivals:
            yield "has no small cases of others to stand against"
        elif of_line[-1] not in pareto_front(of_line + rivals, lambda row: row.counted_work):
            yield f"its last small case, of error {of_line[-1].error:.3g}, is not on the front of error against work"
    if line.as_default is not None:
        default = bench.of(next(other for other in others if other.is_default), rows, quick=True)
        for row, wanted in zip(of_line, default, strict=True):
            if not abs(row.error - wanted.error) <= line.as_default * wanted.error:
                yield f"error {row.error:.6g}, and not the default's {wanted.error:.6g}"


def compare(options):
    """Of names: benches, scenes, and programs of micro-benchmarks; without any all benches that have small cases, and all programs."""
    names = options.names or sorted(path.stem for path in BENCHES.glob("*.toml"))
    programs = [name for name in bench_compare.MICRO if name in names or not options.names]
    benches = [open_bench(name, options) for name in names if name not in programs and not name.endswith(".toml")]
    runs = [run for bench in benches if options.names or any(line.quick for line in bench.lines) for run in bench_compare.runs_of(bench)]
    runs += [bench_compare.run_of(name, options.work.absolute()) for name in names if name.endswith(".toml")]
    bench_compare.compare(options.compare, runs, programs, options)
    return 0


def main():
    options = parse_arguments()
    if options.compare:
        return compare(options)
    if not options.names:
        for path in sorted(BENCHES.glob("*.toml")):
            print(f"{path.stem:24} {Bench(path, options.work).title}")
        return 0
    if not options.quick:
        environment.enter()
    wrong = []
    for name in options.names:
        bench = open_bench(name, options)
        if options.truth:
            bench_truth.make(bench, options.titin)
            continue
        file = bench.work / "quick.csv" if options.quick else bench.file
        if options.quick:
            file.unlink(missing_ok=True)
        if not options.draw:
            run_all(bench, options, file)
        if options.quick:
            wrong += check_quick(bench, bench.rows(file))
        else:
            from bench_charts import draw

            print(f"[bench] {draw(bench, bench.rows(file))} at {revision()}")
    for line in wrong:
        print(f"[bench] {line}", file=sys.stderr)
    return 1 if wrong else 0


guarded("bench", main)
