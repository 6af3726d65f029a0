"""The cases of a sweep: what each of them sets, how far it is, and the index of all. Used by scripts/sweep.

All state is in the folders of the runs: whoever comes later, or works at the same time, reads the same.
"""
import csv
import fcntl
import io
import itertools
import json
import pathlib
from dataclasses import dataclass

from batch import Problem, read_toml

DONE = "finished"
TRIED = ("not_converged", "failed")
KEYS = {"scene", "set", "collect", "vary", "case"}
MOST_CASES = 10000


def toml_value(value):
    """As the right side of key=value on the command line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(k)} = {toml_value(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(toml_value(v) for v in value) + "]"
    return json.dumps(value, ensure_ascii=False) if isinstance(value, (str, bool)) else repr(value)


@dataclass
class Case:
    number: int
    values: dict

    @property
    def name(self):
        return f"{self.number:04d}"


class Sweep:
    def __init__(self, path, folder, table=None):
        """Of a file, or of a table in one (scripts/bench.py)."""
        self.path, self.folder = path, folder
        table = table or read_toml(path, "sweep")
        self.read(table)
        self.cases = self.combine(table.get("vary", {}), table.get("case", [{}]))
        self.keys = list(dict.fromkeys(key for case in self.cases for key in case.values))

    def read(self, table):
        unknown = sorted(table.keys() - KEYS)
        if unknown:
            raise Problem(f"{self.path}: unknown key {unknown[0]}; there are {', '.join(sorted(KEYS))}")
        if not isinstance(table.get("scene"), str):
            raise Problem(f"{self.path}: missing scene; add for example scene = \"block.toml\"")
        self.scene = (self.path.parent / table["scene"]).absolute()
        self.set, self.collect = table.get("set", []), table.get("collect", [])
        for name, words in (("set", self.set), ("collect", self.collect)):
            if not isinstance(words, list) or not all(isinstance(w, str) and "\n" not in w for w in words):
                raise Problem(f"{self.path}: {name} is no list of text")
        if not isinstance(table.get("vary", {}), dict) or not isinstance(table.get("case", []), list):
            raise Problem(f"{self.path}: write [vary], and [[case]] for each case")
        for key, values in table.get("vary", {}).items():
            if not isinstance(values, list) or not values:
                raise Problem(f"{self.path}: vary.{key} is no list of values; a key with dots needs quotation marks: \"{key}\" = [1, 2]")

    def combine(self, vary, listed):
        number = len(listed)
        for values in vary.values():
            number *= len(values)
        if not number or not (vary or listed != [{}]):
            raise Problem(f"{self.path}: there are no cases; add a table [vary]")
        if number > MOST_CASES:
            raise Problem(f"{self.path}: {number:,} cases are too many; at most {MOST_CASES:,}")
        combinations = itertools.product(listed, *vary.values())
        return [Case(n, {**case, **dict(zip(vary, values))}) for n, (case, *values) in enumerate(combinations)]

    # ---- a case

    def file(self, case, what):
        return self.folder / f"{case.name}.{what}"

    def overrides(self, case):
        return [*self.set, *(f"{key}={toml_value(value)}" for key, value in case.values.items())]

    def arguments(self, case):
        return [str(self.scene), *self.overrides(case)]

    def summary(self, case):
        try:
            run = json.loads((self.folder / case.name / "run.json").read_text())
            return run if isinstance(run, dict) else {}
        except (OSError, ValueError):
            return {}

    def status(self, case):
        return self.summary(case).get("status", "not started")

    def how_to_start(self, case):
        """Anew, or from the last checkpoint of what was there before."""
        folder = self.folder / case.name
        if self.status(case) not in TRIED and any((folder / "checkpoints").glob("*.h5")):
            return ["--restart", str(folder)]
        return ["-o", str(folder), *(["--overwrite"] if folder.exists() and any(folder.iterdir()) else [])]

    def line(self, case):
        values = " ".join(f"{key}={toml_value(value)}" for key, value in case.values.items())
        return f"{case.name}  {self.status(case):<13}  {values}"

    # ---- all of them

    def begin(self):
        """Keeps what the cases are; a folder of other cases is refused."""
        kept = self.folder / "cases.json"
        cases = json.loads(json.dumps([self.arguments(case) for case in self.cases]))
        if kept.exists() and json.loads(kept.read_text()) != cases:
            raise Problem(f"{self.folder} holds other cases than {self.path} now says; name another folder with -o")
        self.folder.mkdir(parents=True, exist_ok=True)
        kept.write_text(json.dumps(cases, indent=1))

    def collected(self, case, run):
        """Of each wanted name: a key of run.json such as newton.total, or the last row's value in this column of history.csv."""
        history = self.last_row(case)
        for name in self.collect:
            value = run
            for part in name.split("."):
                value = value.get(part) if isinstance(value, dict) else None
            yield history.get(name, "") if value is None else value

    def last_row(self, case):
        try:
            with open(self.folder / case.name / "history.csv", newline="") as file:
                rows = csv.DictReader(file)
                last = {}
                for last in rows:
                    pass
                return last
        except (OSError, csv.Error):
            return {}

    def write_index(self):
        """Whole, and at once: many runs may end together."""
        text = io.StringIO()
        rows = csv.writer(text, lineterminator="\n")
        rows.writerow(["case", "status", *self.keys, "steps", "time [s]", "cpu_seconds", *self.collect])
        with open(self.folder / "index.lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            for case in self.cases:
                run = self.summary(case)
                values = [toml_value(case.values[key]).strip('"') if key in case.values else "" for key in self.keys]
                rows.writerow([case.name, self.status(case), *values, run.get("steps", ""), run.get("time", ""),
                               run.get("cpu_seconds", ""), *self.collected(case, run)])  # fmt: skip
            part = self.folder / "index.csv.part"
            part.write_text(text.getvalue())
            part.replace(self.folder / "index.csv")
