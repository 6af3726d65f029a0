#!/usr/bin/env python3
"""Runs one scene small, as its [test] table says, and holds the numbers it gives against those it must give.

    run_scene.py SCENE --titin build/bin/titin [--ranks 2] [--scratch DIR]
    run_scene.py SCENE --record FILE  also appends what was found to a CSV, from which scripts/report.py --gallery makes its page
    run_scene.py --list FOLDER        every scene below that has a [test], with its numbers of ranks

    [test]
    set = ["mesh.cells=[2, 2, 2]"]   # overrides that make it small
    against = "closed form"          # what the numbers are held against, for the page of all that is verified; optional
    exit = 2                         # exit code, 0 when not said
    reason = "(?P<x>...) at .* s"    # regular expression that `reason` of run.json must match, of a run that fails
    ranks = [1, 2]                   # the first writes the history that the others must repeat
    rank_tolerance = 1e-6            # how closely (see "scale" below)
    rank_skip = ["force_x [N]"]      # columns that vanish, by symmetry say, and hold round-off alone

    [test.expect]                    # columns of history.csv: the last row; else a path into run.json
    "volume [m^3]" = [3.0e-6, 1e-9]  # value, tolerance
    newton.max_per_step = { max = 8 }
    status = "finished"

    [test.slope]                     # of the line through a sum of columns between two times
    columns = { "marker_a_ux [m]" = 0.5, "marker_b_ux [m]" = -0.5 }   # with these factors
    from = 0.9                       # [s]
    to = 1.5
    value = 1.4e-2                   # in SI units
    relative = 0.1

    [test.reference]                 # every row of another code's history up to the end of this run
    file = "tests/data/..."          # from the top folder; columns as in history.csv
    relative = 1e-6                  # times the scale
    absolute = { m = 1e-8 }          # instead, for columns in this unit

The scale of a column is the largest value of all columns in its unit, so that components that vanish are compared too.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import time
import tomllib

from vtu_numbers import saved_numbers

TOP = pathlib.Path(__file__).resolve().parent.parent.parent
MPI_ENVIRONMENT = dict(re.findall(r"\b(OMPI_\w+)=(\S+)", (TOP / "scripts" / "mpi_environment").read_text()))
DEFAULT_RANK_TOLERANCE = 1e-6
SAME_TIME = 1e-9  # [s], well below any step
RECORDED = ["scene", "what", "value", "expected", "difference", "tolerance"]


def test_of(scene):
    with open(scene, "rb") as file:
        return tomllib.load(file).get("test")


def list_scenes(folder):
    for scene in sorted(pathlib.Path(folder).rglob("*.toml")):
        test = test_of(scene)
        if test is not None:
            print(scene.relative_to(folder).as_posix(), *test.get("ranks", [1]))


class Checks:
    """Rows of (what, value, wanted, difference, tolerance, passed), printed as one table."""

    def __init__(self):
        self.rows = []

    def add(self, what, value, wanted, difference, tolerance, passed):
        self.rows.append((what, value, wanted, difference, tolerance, passed))

    def near(self, what, value, wanted, tolerance):
        difference = abs(value - wanted)
        self.add(what, value, wanted, difference, tolerance, difference <= tolerance)  # a nan fails

    def passed(self):
        return bool(self.rows) and all(row[-1] for row in self.rows)

    def record(self, file, scene):
        """Appends the rows that hold numbers, and what became of the reason."""
        new = not file.exists()
        with open(file, "a", newline="") as out:
            rows = csv.writer(out, lineterminator="\n")
            if new:
                rows.writerow(RECORDED)
            for what, *numbers, _ in self.rows:
                if what == "reason" or what != "exit code" and isinstance(numbers[0], (int, float)):
                    rows.writerow([scene, what, *(f"{x:.9g}" if isinstance(x, float) else "" if x is None else x for x in numbers)])

    def print(self):
        def text(x):
            return "" if x is None else f"{x:.8g}" if isinstance(x, float) else str(x)

        table = [("", "value", "expected", "difference", "tolerance", "")]
        table += [(*map(text, row[:-1]), "ok" if row[-1] else "WRONG") for row in self.rows]
        widths = [max(map(len, column)) for column in zip(*table)]
        for row in table:
            print("  ".join([row[0].ljust(widths[0])] + [x.rjust(w) for x, w in zip(row[1:], widths[1:])]))


class History:
    """A CSV of numbers with a header of "name [unit]"."""

    def __init__(self, path):
        with open(path, newline="") as file:
            rows = list(csv.reader(file))
        self.header = [name.strip() for name in rows[0]]
        self.columns = {name: [float(row[k]) for row in rows[1:]] for k, name in enumerate(self.header)}
        self.time = self.columns["time [s]"]

    @staticmethod
    def unit(column):
        found = re.search(r"\[(.*)\]$", column)
        return found.group(1) if found else column  # a pure number is its own kind

    def scale(self, column, rows=None):
        values = [abs(x) for name in self.header if self.unit(name) == self.unit(column) for x in self.columns[name][:rows]]
        return max((x for x in values if math.isfinite(x)), default=0.0)

    def row_at(self, t):
        return next((k for k, mine in enumerate(self.time) if abs(mine - t) <= SAME_TIME), None)


def run(arguments, test, folder):
    """Runs titin and returns its exit code; the last lines it printed are shown when it failed."""
    command = [str(arguments.titin), "run", str(arguments.scene), *test.get("set", []), "-o", str(folder), "--overwrite"]
    if arguments.ranks > 1:
        command = [arguments.mpirun, "-np", str(arguments.ranks)] + command
    environment = os.environ | MPI_ENVIRONMENT
    print("$", " ".join(command), flush=True)
    begin = time.monotonic()
    result = subprocess.run(command, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    print(f"exit code {result.returncode} after {time.monotonic() - begin:.1f} s")
    if result.returncode != test.get("exit", 0):
        print("\n".join(result.stdout.splitlines()[-30:]))
    return result.returncode


def flat(table, path=""):
    """{"newton.max_per_step": {...}} from nested tables; a table of only max and min is a value."""
    for key, value in table.items():
        if isinstance(value, dict) and not set(value) <= {"max", "min"}:
            yield from flat(value, f"{path}{key}.")
        else:
            yield path + key, value


def look_up(key, history, report):
    if key in history.columns:
        return history.columns[key][-1]
    value = report
    for part in key.split("."):
        value = value.get(part) if isinstance(value, dict) else None
    return value


def check_expected(checks, expected, history, report):
    for key, wanted in flat(expected):
        value = look_up(key, history, report)
        if value is None:
            checks.add(key, "missing", "", None, None, False)
        elif isinstance(wanted, dict):
            for bound, limit in wanted.items():
                passed = value <= limit if bound == "max" else value >= limit
                checks.add(key, value, f"{'<=' if bound == 'max' else '>='} {limit:g}", None, None, passed)
        elif isinstance(wanted, list):
            checks.near(key, float(value), float(wanted[0]), float(wanted[1]))
        else:
            checks.add(key, value, wanted, None, None, value == wanted)


def compare(checks, label, mine, other, columns, tolerance_of):
    """The worst row of each column, rows matched by time; `other` may go on for longer than `mine`."""
    pairs = [(mine.row_at(t), k) for k, t in enumerate(other.time) if t <= mine.time[-1] + SAME_TIME]
    missing = [other.time[k] for row, k in pairs if row is None]
    if missing or len(pairs) < 2:
        checks.add(f"{label}: times", f"{len(missing)} missing" if missing else f"{len(pairs)} rows", "", None, None, False)
        return
    for column in columns:
        if column not in mine.columns:
            checks.add(f"{label}: {column}", "missing", "", None, None, False)
            continue
        values = [(mine.columns[column][row], other.columns[column][k]) for row, k in pairs]
        worst = max(values, key=lambda pair: math.inf if math.isnan(pair[0] - pair[1]) else abs(pair[0] - pair[1]))
        checks.near(f"{label}: {column}", *worst, tolerance_of(column))


def check_reason(checks, pattern, report):
    reason = report.get("reason", "")
    passed = re.search(pattern, reason) is not None
    checks.add("reason", "matches" if passed else reason, pattern[:20] + "...", None, None, passed)


def check_numbers(checks, history, folder):
    """Nothing that is no number is written, however a run ends; fields are looked through when it fails."""
    wrong = [name for name, column in history.columns.items() if not all(map(math.isfinite, column))]
    checks.add("history: columns with no numbers", ", ".join(wrong) or "none", "none", None, None, not wrong)
    if folder:
        saved, bad = saved_numbers(folder)
        checks.add("fields: values that are no numbers", bad, f"0 of {saved}", None, None, saved > 0 and bad == 0)


def check_slope(checks, slope, history):
    """Least squares; the error of the slope is relative."""
    rows = [k for k, t in enumerate(history.time) if slope["from"] <= t <= slope["to"]]
    if len(rows) < 3:
        return checks.add("slope: rows", len(rows), ">= 3", None, None, False)
    t = [history.time[k] for k in rows]
    y = [sum(factor * history.columns[name][k] for name, factor in slope["columns"].items()) for k in rows]
    t_mean, y_mean = sum(t) / len(t), sum(y) / len(y)
    value = sum((a - t_mean) * (b - y_mean) for a, b in zip(t, y)) / sum((a - t_mean) ** 2 for a in t)
    checks.near("slope", value, slope["value"], slope["relative"] * abs(slope["value"]))


def check_reference(checks, reference, history):
    other = History(TOP / reference["file"])
    rows = sum(t <= history.time[-1] + SAME_TIME for t in other.time)

    def tolerance_of(column):
        absolute = reference.get("absolute", {}).get(History.unit(column))
        return absolute if absolute is not None else reference["relative"] * other.scale(column, rows)

    columns = [c for c in other.header if c != "time [s]" and c not in reference.get("skip", [])]
    compare(checks, "reference", history, other, columns, tolerance_of)


def check_ranks(checks, test, history, first_folder, ranks):
    if not (first_folder / "history.csv").exists():
        checks.add(f"history of {test['ranks'][0]} ranks", "missing", "", None, None, False)
        return
    first = History(first_folder / "history.csv")
    tolerance = test.get("rank_tolerance", DEFAULT_RANK_TOLERANCE)
    columns = [c for c in first.header if c not in test.get("rank_skip", [])]
    compare(checks, f"np {ranks}", history, first, columns, lambda column: tolerance * first.scale(column))


def main():
    parser = argparse.ArgumentParser(description="Runs one scene's [test].")
    parser.add_argument("scene", nargs="?", type=pathlib.Path)
    parser.add_argument("--list", metavar="FOLDER")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--titin", type=pathlib.Path, default=TOP / "build" / "bin" / "titin")
    parser.add_argument("--mpirun", default="mpirun")
    parser.add_argument("--scratch", type=pathlib.Path)
    parser.add_argument("--record", type=pathlib.Path, metavar="FILE")
    arguments = parser.parse_args()
    if arguments.list:
        return list_scenes(arguments.list)

    test = test_of(arguments.scene)
    if test is None:
        parser.error(f"{arguments.scene} has no [test] table")
    scratch = arguments.scratch or TOP / "build" / "tests" / "scenes" / arguments.scene.stem
    folder = scratch / f"np{arguments.ranks}"
    folder.parent.mkdir(parents=True, exist_ok=True)
    code = run(arguments, test, folder)

    checks = Checks()
    checks.add("exit code", code, test.get("exit", 0), None, None, code == test.get("exit", 0))
    if checks.passed():
        history = History(folder / "history.csv")
        report = json.loads((folder / "run.json").read_text())
        check_expected(checks, test.get("expect", {}), history, report)
        check_numbers(checks, history, folder / "fields" if code else None)
        if "reason" in test:
            check_reason(checks, test["reason"], report)
        if "slope" in test:
            check_slope(checks, test["slope"], history)
        if "reference" in test:
            check_reference(checks, test["reference"], history)
        first = test.get("ranks", [1])[0]
        if arguments.ranks != first:
            check_ranks(checks, test, history, scratch / f"np{first}", arguments.ranks)
    checks.print()
    if arguments.record:
        checks.record(arguments.record, arguments.scene.resolve().relative_to(TOP / "configs").as_posix())
    return 0 if checks.passed() else 1


if __name__ == "__main__":
    sys.exit(main())
