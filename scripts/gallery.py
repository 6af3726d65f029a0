"""One page of all that is verified: docs/verification/gallery.md, made from what is committed, without running anything.
Used by `scripts/report.py --gallery`, whose help says how.

Numbers of scenes come from docs/verification/scenes.csv, which `--measure` writes by running the [test] of every scene; what they must be from the
scenes themselves; curves from the tables of the benches; pictures from docs/pictures, with the command that a bench, scripts/pictures or COMMANDS has.
"""
import argparse
import csv
import math
import os
import pathlib
import re
import subprocess
import sys
import tomllib

from batch import ROOT, Problem, guarded
from bench_results import Bench, fitted_order, pareto_front

DOCS = ROOT / "docs"
PAGE, FOUND = DOCS / "verification" / "gallery.md", DOCS / "verification" / "scenes.csv"
RUNNER = ROOT / "tests" / "scenes" / "run_scene.py"
COMMANDS = {  # of pictures that neither a bench nor scripts/pictures makes
    "block": "scripts/run configs/muscle/block.toml; scripts/plot results/block", "gases": "scripts/plot_gases.py", "paraview": "scripts/paraview_picture",
    "sedov": "scripts/plot_lagrange.py", "solids": "scripts/plot_solids.py",
}  # fmt: skip
GOOD = 0.1  # an error above this is on no front
KEEPING_HOUSE = re.compile(r"status|steps|newton|krylov|warnings|conservation\.|cells_constant|errors\.volume")
FLEXODEAL, SHOWN = "tests/data/muscle", 2
HEAD = """# What is verified, on one page

Made by `scripts/report.py --gallery` from the scenes, tables and pictures of this tree; a test fails when it is old. What to take for which problem:
[choose a method](../howto/choose.md); what the charts say: [charts](charts.md). Longer, by part: [muscle](muscle.md), [the Lagrangian formulation](lagrange.md),
[rods](rod.md), [materials](materials.md), [linear solvers](solvers.md), [output and restarts](output.md), [speed](speed.md).
"""


def cell(text):
    return str(text).replace("|", "\\|")


def table(head, rows):
    lines = [f"| {' | '.join(head)} |", "|" + "---|" * len(head), *(f"| {' | '.join(map(cell, row))} |" for row in rows)]
    return "\n".join(lines) + "\n"


def number(value, digits=3):
    """Few digits, and no more zeros than needed."""
    text = f"{value:.0f}" if 100 <= abs(value) < 1e5 and digits < 4 else f"{value:.{digits}g}"
    return re.sub(r"e([-+])0?(\d+)$", lambda e: "e" + e[1].strip("+") + e[2], text)


def small(path, words, width=300):
    """A picture that leads to itself, from the page's folder."""
    name = f"../pictures/{path.name}"
    return f'[<img src="{name}" width="{width}" alt="{words}">]({name})'


# ---- scenes ----------------------------------------------------------------------------------------------------------


class Scene:
    def __init__(self, path, found):
        text = path.read_text()
        self.path, self.table = path, tomllib.loads(text)
        self.test, self.name = self.table["test"], path.relative_to(ROOT / "configs").as_posix()
        self.found = {what: row for (scene, what), row in found.items() if scene == self.name}
        self.remarks = dict(re.findall(r'^"?([^"\n]*?)"? = .*?\s# (.*)$', text[text.index("\n[test]") :], re.M))

    @property
    def link(self):
        return f"[{self.table.get('title', self.path.stem)}](../../configs/{self.name})"

    @property
    def against(self):
        """What the scene says, or what it compares itself with."""
        if "against" in self.test:
            return self.test["against"]
        if "reference" in self.test:
            return "Flexodeal Lite" if self.test["reference"]["file"].startswith(FLEXODEAL) else self.test["reference"]["file"]
        history = self.table.get("reference", {}).get("history", "")
        if history:
            return "exact" if "/exact/" in history else "finite elements on a fine mesh"
        exact = self.table.get("exact", self.table.get("exact_motion", {}))
        return f"exact (`{exact['solution']}`)" if "solution" in exact else ""

    def number_of(self, key):
        """As it was found, bold when it is outside what it must be; nothing when the scene has other bounds since."""
        row = self.found.get(key)
        wanted = self.wanted(key)
        if not row or row["expected"] != wanted[0]:
            return "not run"
        value = float(row["value"])
        outside = value > wanted[1] if wanted[0].startswith("<") else value < wanted[1] if wanted[0].startswith(">") else float(row["difference"]) > wanted[1]
        return f"**{number(value)}**" if outside else number(value, 3 if row["expected"][0] in "<>" else 7)

    def is_outside(self):
        """Of anything that it must be, shown here or not."""
        keys = [key for key, wanted in flat(self.test.get("expect", {})) if isinstance(wanted, (dict, list))]
        beyond = [row for row in self.found.values() if row["tolerance"] and not float(row["difference"]) <= float(row["tolerance"])]
        return bool(beyond) or any("**" in self.number_of(key) for key in keys)

    def wanted(self, key):
        """As scenes.csv has it, and the bound or the tolerance."""
        wanted = dict(flat(self.test.get("expect", {})))[key]
        if isinstance(wanted, dict):
            bound, limit = next(iter(wanted.items()))
            return f"{'<=' if bound == 'max' else '>='} {limit:g}", limit
        return f"{float(wanted[0]):.9g}", float(wanted[1])

    def rows(self):
        keys = [k for k, wanted in flat(self.test.get("expect", {})) if isinstance(wanted, (dict, list)) and not KEEPING_HOUSE.match(k)]
        errors = [k for k in keys if k.startswith("errors.")]
        for key in (errors or keys)[:SHOWN]:
            shown, limit = self.wanted(key)
            words = {"<": "at most", ">": "at least"}
            must = f"{words[shown[0]]} {number(limit)}" if shown[0] in words else f"{number(float(shown), 7)} ± {number(limit)}"
            yield [f"`{key.removeprefix('errors.')}`", self.number_of(key), must, self.remarks.get(key, "")]
        if "slope" in self.test and not errors:
            slope, row = self.test["slope"], self.found.get("slope")
            what = "slope of " + ", ".join(f"`{name}`" for name in slope["columns"])
            yield [what, number(float(row["value"]), 5) if row else "not run", f"{slope['value']:g} ± {100 * slope['relative']:g} %", self.remarks.get("value", "")]
        if "reference" in self.test:
            of = [row for what, row in self.found.items() if what.startswith("reference: ") and float(row["tolerance"]) > 0]
            worst = max(of, key=lambda row: float(row["difference"]) / float(row["tolerance"]), default=None)
            if worst:
                yield [f"`{worst['what'].removeprefix('reference: ')}`, whole history", f"differs by {number(float(worst['difference']))}",
                       f"at most {number(float(worst['tolerance']))}", f"the worst of {len(of)} columns"]  # fmt: skip
        if "reason" in self.test:
            yield ["its reason", self.found.get("reason", {}).get("value", "not run"), f"exit code {self.test['exit']}, with time, place and cause", ""]


def flat(expected, path=""):
    for key, value in expected.items():
        if isinstance(value, dict) and not set(value) <= {"max", "min"}:
            yield from flat(value, f"{path}{key}.")
        else:
            yield path + key, value


def scenes():
    with open(FOUND, newline="") as file:
        found = {(row["scene"], row["what"]): row for row in csv.DictReader(file)}
    paths = sorted((ROOT / "configs").rglob("*.toml"))
    return [Scene(path, found) for path in paths if "\n[test]" in path.read_text()]


def scene_section(title, of):
    rows = []
    for scene in of:
        for n, row in enumerate(scene.rows()):
            rows.append([*(("", "") if n else (scene.link, scene.against)), *row])
    return f"### {title}\n\n" + table(["scene", "against", "what", "found", "must be", "remark"], rows)


def scene_sections():
    every = scenes()
    known = [scene for scene in every if scene.against and list(scene.rows())]
    kept = [scene for scene in every if scene not in known]
    outside = [scene.link for scene in every if scene.is_outside()]
    parts = [("Finite elements", "muscle/"), ("Finite volumes", "lagrange/"), ("Rods", "rod/")]
    text = ["## Scenes against answers\n\nSmall versions, as CI runs them: `scripts/test -L scenes`, on one and two ranks, which must agree to 1e-6. The scenes' own sizes"
            " are in the pages above. Where it makes sense, mass, momentum, energy and the number of Newton steps are asserted, too. \n\n"
            f"{len(every)} scenes, {len(known)} of them against answers; outside of what they must be (bold): {', '.join(outside) or 'none'}.\n"]  # fmt: skip
    for title, folder in parts:
        text.append(scene_section(title, [s for s in known if s.name.startswith(folder) and "/reference/" not in s.name]))
    text.append(scene_section("Another code, step by step", [s for s in known if "/reference/" in s.name]))
    text.append(f"Held to what they keep and to their own numbers alone, so that changes are seen: {', '.join(scene.link for scene in kept)}.\n")
    return text


# ---- benches ---------------------------------------------------------------------------------------------------------


def benches():
    """Those with a table and a picture. One whose cases have changed since is a mistake: its picture would lack them."""
    of = [Bench(path, pathlib.Path("results")) for path in sorted((ROOT / "configs" / "bench").glob("*.toml"))]
    of = [bench for bench in of if bench.file.exists() and picture_of(bench).exists()]
    for bench in of:
        rows = bench.rows(bench.file)
        missing = sum((line.name, line.key(case)) not in rows for line in bench.lines for case in line.cases(False))
        if missing:
            raise Problem(f"{missing} cases of configs/bench/{bench.path.name} have no row; scripts/bench.py {bench.path.stem} runs them")
    return of


def picture_of(bench):
    return DOCS / "pictures" / f"bench_{bench.path.stem}.png"


def chart(bench):
    """Picture, command, and a row for each curve; whoever is on the front of error against CPU seconds has a star."""
    rows = bench.rows(bench.file)
    good_ones = [row for line in bench.lines for row in bench.of(line, rows) if row.error < GOOD]
    front = pareto_front(good_ones, lambda row: row.number("cpu_seconds"))
    lines = []
    for line in bench.lines:
        of_line = [row for row in bench.of(line, rows)]
        good = [row for row in of_line if row.status == "finished" and math.isfinite(row.error)]
        if good:
            best = min(good, key=lambda row: row.error)
            order = fitted_order(bench, of_line)
            asserted = f" (asserted: above {line.order} over the first {line.quick})" if line.order else ""
            stars = "\\*" if any(row in front for row in good) else ""
            lines.append([line.name + (", our default" if line.is_default else "") + stars, len(of_line), f"{order:.1f}{asserted}" if math.isfinite(order) else "",
                          number(best.error, 2), f"{number(best.number('cpu_seconds'), 2)} s"])  # fmt: skip
    about = f"\\*: on the front of error below {100 * GOOD:g} % against CPU seconds. "
    return (f"### {bench.title}\n\n[![{bench.title}](../pictures/{picture_of(bench).name})](../pictures/{picture_of(bench).name})\n\n"
            f"`scripts/bench.py {bench.path.stem}`; {bench.label}. Against: {bench.reference}. {about}[All rows](bench/{bench.file.name}).\n\n"
            + table(["curve", "runs", f"order in {bench.against}", "least error", "at a cost of"], lines))  # fmt: skip


def map_row(bench):
    rows = bench.rows(bench.file)
    of = [row for line in bench.lines for row in bench.of(line, rows)]
    ended = sum(row.status == "finished" for row in of)
    about = f"**{bench.title}**: {bench.label}; against: {bench.reference}. {len(of)} runs, of which {ended} finished. [Rows](bench/{bench.file.name})"
    return [small(picture_of(bench), bench.title), about, f"`scripts/bench.py {bench.path.stem}`"]


def bench_sections():
    every = benches()
    curves, maps = [bench for bench in every if not bench.map], [bench for bench in every if bench.map]
    return ["## Error against cost, and orders\n\nOrders are slopes over all runs of a curve, and end where the error of the other part (of the step, of the reference) begins. What"
            " `scripts/test` asserts of orders for every element, scheme and formulation is in [muscle](muscle.md#orders-in-space), [Lagrangian"
            " formulation](lagrange.md#orders-test_ordercpp), [rods](rod.md).\n",
            *map(chart, curves), "## Where methods fail\n\n" + table(["", "", "made by"], map(map_row, maps))]  # fmt: skip


# ---- pictures --------------------------------------------------------------------------------------------------------


def captions():
    """By picture: the words beside it and the page that shows it, of the first page that does."""
    of = {}
    for page in [ROOT / "README.md", *sorted(DOCS.rglob("*.md"))]:
        for words, name in re.findall(r"!\[([^\]]*)\]\([\w./]*pictures/(\w+)\.png\)", page.read_text()):
            if page != PAGE and (name not in of or page.parent.name == "verification"):
                of[name] = (words, page)
    return of


def command_of(name):
    if name in COMMANDS:
        return COMMANDS[name]
    if re.search(rf"^{name}\(\)", (ROOT / "scripts" / "pictures").read_text(), re.M):
        return f"scripts/pictures {name}"
    raise Problem(f"docs/pictures/{name}.png: no command makes it; name one in scripts/pictures or in COMMANDS of scripts/gallery.py")


def picture_section():
    words, rows = captions(), []
    for path in sorted((DOCS / "pictures").glob("*.png")):
        if path.stem.startswith("bench_"):
            continue
        if path.stem not in words:
            raise Problem(f"docs/pictures/{path.name}: no page shows it")
        caption, page = words[path.stem]
        title = page.read_text().splitlines()[0].lstrip("# ")
        rows.append([small(path, caption), f"{caption}. In: [{title}]({os.path.relpath(page, PAGE.parent)})", f"`{command_of(path.stem)}`"])
    return "## Pictures\n\n" + table(["", "", "made by"], rows)


def recorded_section():
    """Of the comments at the heads of docs/verification/lagrange/*.csv."""
    rows = []
    for path in sorted((DOCS / "verification" / "lagrange").glob("*.csv")):
        found = re.match(r"# (.*?): commit (\w+), (.*)", path.read_text().splitlines()[0])
        rows.append([f"[{path.stem}](lagrange/{path.name})", *(found.groups() if found else ("", "", ""))])
    return "## Histories that are kept\n\nOf the scenes' own sizes, for the pictures and [tables](lagrange.md#scenes-configslagrange) above.\n\n" + table(
        ["history", "run", "commit", "what it took"], [[a, b, f"`{c}`", d] for a, b, c, d in rows])  # fmt: skip


def page():
    return "\n".join([HEAD, *scene_sections(), *bench_sections(), picture_section(), recorded_section()])


def measure(titin):
    """Runs every scene's [test] on one rank, one after the other, and keeps what it gave."""
    FOUND.unlink(missing_ok=True)
    for path in [scene for scene in sorted((ROOT / "configs").rglob("*.toml")) if "\n[test]" in scene.read_text()]:
        name = path.relative_to(ROOT / "configs").with_suffix("")
        command = [sys.executable, RUNNER, path, "--titin", titin, "--scratch", pathlib.Path("results") / "gallery" / name, "--record", FOUND]
        code = subprocess.run(command, stdout=subprocess.DEVNULL).returncode
        print(f"[gallery] {name}: {'as it must be' if code == 0 else 'WRONG'}", flush=True)


def make():
    parser = argparse.ArgumentParser(prog="scripts/report.py --gallery", description="docs/verification/gallery.md: all that is verified, on one page.")
    parser.add_argument("--gallery", action="store_true", required=True)
    parser.add_argument("--check", action="store_true", help="is the page up to date? writes nothing")
    parser.add_argument("--measure", action="store_true", help="run the small version of every scene again, and keep its numbers")
    parser.add_argument("--titin", default=str(ROOT / "build" / "bin" / "titin"), help="the program for that")
    options = parser.parse_args()
    if options.measure:
        measure(options.titin)
    text = page()
    if options.check:
        if PAGE.exists() and PAGE.read_text() == text:
            return 0
        raise Problem(f"{PAGE.relative_to(ROOT)} is old; call scripts/report.py --gallery")
    PAGE.write_text(text)
    print(f"[report] wrote {PAGE.relative_to(ROOT)}")
    return 0


def main():
    guarded("report", make)
