"""A bench: the sweeps of a file of configs/bench/, and what they gave, row by row in a CSV. Used by scripts/bench.py.

The CSV is only appended to. A case that is in it is done; of several rows of a case the last one counts.
"""
import csv
import datetime
import json
import math
import pathlib
import platform
import subprocess
from dataclasses import dataclass, field

from batch import Problem, read_toml
from sweep_cases import Sweep

ROOT = pathlib.Path(__file__).resolve().parent.parent
TRUTHS = ROOT / "docs" / "verification" / "bench" / "reference"
CHART_KEYS = {"title", "reference", "error", "label", "scale", "exact", "dimension", "limit", "against", "sweep", "map", "truth", "history"}
SWEEP_KEYS = {"name", "default", "order", "quick", "history", "front", "as_default", "error", "exact", "scale"}
COLUMNS = ["sweep", "case", "status", "model", "error", "cells", "unknowns", "steps", "newton", "krylov", "cpu_seconds",
           "wall_seconds", "peak_rss_bytes", "ranks", "errors", "commit", "machine", "date"]  # fmt: skip


@dataclass
class Row:
    sweep: str
    case: str
    status: str
    error: float
    values: dict = field(default_factory=dict)

    def number(self, column):
        return float(self.values[column] or "nan")

    @property
    def counted_work(self):
        """Unknowns times solves: what a run costs, without a clock. Compares runs of one formulation."""
        return self.number("unknowns") * max(self.number("newton"), self.number("steps"))


class Line:
    """A sweep of a bench: runs that differ in one thing, a curve of its chart."""

    def __init__(self, bench, table):
        extra = {key: table.pop(key) for key in SWEEP_KEYS & table.keys()}
        if not isinstance(extra.get("name"), str):
            raise Problem(f"{bench.path}: a [[sweep]] has no name")
        self.name = extra["name"]
        self.is_default = extra.get("default", False)
        self.order, self.quick = extra.get("order"), extra.get("quick", 0)
        self.on_front, self.as_default = extra.get("front", self.is_default), extra.get("as_default")
        self.history = extra.get("history", bench.history)
        self.error, self.exact, self.scale = (extra.get(key, getattr(bench, key)) for key in ("error", "exact", "scale"))
        self.sweep = Sweep(bench.path, bench.work / self.name.replace("/", "_").replace(" ", "_"), table)

    def cases(self, quick):
        return self.sweep.cases[: self.quick] if quick else self.sweep.cases

    def arguments(self, case):
        """Of `titin run`; the history that it is compared with is no part of what a row is known by."""
        against = [f"reference.history={json.dumps(str(TRUTHS / self.history))}"] if self.history else []
        return [*self.sweep.arguments(case), *against]

    def key(self, case):
        return " ".join(self.sweep.overrides(case))


class Bench:
    def __init__(self, path, work):
        table = read_toml(path, "bench")
        unknown = sorted(table.keys() - CHART_KEYS)
        if unknown:
            raise Problem(f"{path}: unknown key {unknown[0]}; there are {', '.join(sorted(CHART_KEYS))}")
        for key in ("title", "reference", "error"):
            if not isinstance(table.get(key), str):
                raise Problem(f"{path}: missing {key}, a text")
        self.path, self.work = path, work
        self.title, self.reference, self.error = table["title"], table["reference"], table["error"]
        self.label, self.scale = table.get("label", self.error), table.get("scale", 1)
        self.exact = table.get("exact", 0)
        self.limit = table.get("limit", 600)
        self.dimension, self.against = table.get("dimension", 3), table.get("against", "h")
        self.map, self.truths, self.history = table.get("map"), table.get("truth", []), table.get("history")
        self.lines = [Line(self, dict(sweep)) for sweep in table.get("sweep", [])]
        if not self.lines:
            raise Problem(f"{path}: there are no runs; add a [[sweep]] with name, scene and vary")

    @property
    def file(self):
        return ROOT / "docs" / "verification" / "bench" / f"{self.path.stem}.csv"

    # ---- what a run gave

    def error_of(self, line, case, run):
        """A key of errors in run.json; "PATH of run.json"; or "COLUMN of history, largest | smallest | last | variation | range"."""
        path, _, rest = line.error.partition(" of run.json")
        if path != line.error and not rest:
            for key in path.split("."):
                run = run.get(key, {})
            return run if isinstance(run, (int, float)) else math.nan
        column, _, how = line.error.partition(" of history, ")
        if not how:
            return run.get("errors", {}).get(line.error, math.nan)
        ways = {"largest": max, "smallest": min, "last": lambda v: v[-1], "range": lambda v: max(v) - min(v),
                "variation": lambda v: sum(abs(b - a) for a, b in zip(v, v[1:]))}  # fmt: skip
        if how not in ways:
            raise Problem(f"{self.path}: error: {how} is none of {', '.join(ways)}")
        columns = [column.replace("*", axis) for axis in "xyz"] if "*" in column else [column]
        try:
            with open(line.sweep.folder / case.name / "history.csv", newline="") as file:
                rows = list(csv.DictReader(file))
            values = [ways[how]([float(row[name]) for row in rows]) for name in columns]
        except (OSError, KeyError, ValueError):
            return math.nan
        return values[0] if len(values) == 1 else math.hypot(*values)

    def row(self, line, case):
        run = line.sweep.summary(case)
        error = abs(self.error_of(line, case, run) - line.exact) / line.scale
        values = {
            "model": run.get("model", ""), "cells": run.get("cells", ""), "unknowns": run.get("unknowns", ""),
            "steps": run.get("steps", ""), "newton": run.get("newton", {}).get("total", ""),
            "krylov": run.get("krylov", {}).get("total", ""), "cpu_seconds": run.get("cpu_seconds", ""),
            "wall_seconds": run.get("wall_seconds", ""), "peak_rss_bytes": run.get("peak_rss_bytes", ""),
            "ranks": run.get("ranks", ""), "errors": json.dumps(run.get("errors", {})), "commit": run.get("commit", ""),
            "machine": f"{platform.machine()}, {processor()}", "date": datetime.date.today().isoformat(),
        }  # fmt: skip
        return Row(line.name, line.key(case), run.get("status", "failed"), error, values)

    # ---- the table

    def append(self, row, file):
        file.parent.mkdir(parents=True, exist_ok=True)
        new = not file.exists()
        with open(file, "a", newline="") as out:
            rows = csv.writer(out, lineterminator="\n")
            if new:
                rows.writerow(COLUMNS)
            known = {"sweep": row.sweep, "case": row.case, "status": row.status, "error": f"{row.error:.6g}"}
            rows.writerow([known.get(column, row.values.get(column, "")) for column in COLUMNS])

    def rows(self, file):
        """By (sweep, case); only of cases that the bench still has, in its order."""
        found = {}
        if file.exists():
            with open(file, newline="") as text:
                for r in csv.DictReader(text):
                    found[r["sweep"], r["case"]] = Row(r["sweep"], r["case"], r["status"], float(r["error"]), r)
        return found

    def of(self, line, rows, quick=False):
        keys = [(line.name, line.key(case)) for case in line.cases(quick)]
        return [rows[key] for key in keys if key in rows]


def processor():
    try:
        names = [line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")]
        return names[0] if names else "unknown"
    except OSError:
        return "unknown"


def resolution(bench, row):
    """What the error is drawn against: the mean size of a cell over that of the body, or the step over the run."""
    return 1 / row.number("steps") if bench.against == "dt" else row.number("cells") ** (-1 / bench.dimension)


def fitted_order(bench, rows):
    """Slope of error over resolution by least squares; nan for less than two good rows. Of rows that share a resolution the last counts."""
    good = {resolution(bench, row): row.error for row in rows if row.status == "finished" and row.error > 0}
    points = [(math.log(size), math.log(error)) for size, error in good.items()]
    if len(points) < 2:
        return math.nan
    x, y = (sum(p[i] for p in points) / len(points) for i in (0, 1))
    spread = sum((a - x) ** 2 for a, _ in points)
    return sum((a - x) * (b - y) for a, b in points) / spread if spread > 0 else math.nan


def pareto_front(rows, cost):
    """Rows that none other beats in both error and cost, the cheapest first."""
    front = []
    for row in sorted((r for r in rows if r.status == "finished" and math.isfinite(r.error)), key=lambda r: (cost(r), r.error)):
        if not front or row.error < front[-1].error:
            front.append(row)
    return front


def revision():
    found = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short", "HEAD"], capture_output=True, text=True)
    return found.stdout.strip() or "unknown"
