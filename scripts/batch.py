"""Runs as jobs of Slurm: what scripts/submit and scripts/sweep share. A site is a file of scripts/jobs/, the job a copy of job.sh."""
import math
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
JOBS = ROOT / "scripts" / "jobs"
# Unknowns of a rank: a good load, and the fewest with which ranks do not mostly wait for each other (docs/howto/run.md).
GOOD_LOAD, LEAST_LOAD = 8000, 1000
TIME = re.compile(r"(\d+-)?\d+(:\d+){0,2}")
SITE = {"launcher": str, "cores_per_node": int, "time": str, "signal_seconds": int, "requeues": int, "options": list, "setup": list}


class Problem(Exception):
    """What is wrong, in a sentence."""


def read_toml(path, what):
    try:
        return tomllib.loads(path.read_text())
    except OSError:
        raise Problem(f"{what} {path} is not there, or cannot be read")
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise Problem(f"{what} {path} is no TOML: {error}")


def read_site(name):
    """The keys of the generic site, and those of the named one over them."""
    path = pathlib.Path(name) if name.endswith(".toml") else JOBS / f"{name}.toml"
    if not path.exists():
        there = ", ".join(sorted(p.stem for p in JOBS.glob("*.toml")))
        raise Problem(f"there is no site {name}; there are {there}, or give the path of a .toml file")
    site = read_toml(JOBS / "generic.toml", "site") | read_toml(path, "site")
    for key, value in site.items():
        if key not in SITE:
            raise Problem(f"{path}: {key} is no key of a site; there are {', '.join(SITE)}")
        if not isinstance(value, SITE[key]) or (SITE[key] is list and not all(isinstance(v, str) for v in value)):
            raise Problem(f"{path}: {key} = {value!r} is no {'list of text' if SITE[key] is list else SITE[key].__name__}")
    check_time(site["time"])
    return site


def check_time(text):
    if not TIME.fullmatch(text):
        raise Problem(f"{text} is no time limit; write MINUTES, H:MM:SS or DAYS-HH:MM:SS")


def check_scene(titin, arguments):
    """What `titin check` says of a scene: {"model": ..., "cells": ..., "unknowns": ...}; its errors are raised."""
    if not shutil.which(str(titin)):
        raise Problem(f"{titin} is not there; build it with scripts/setup, or name it with --titin")
    found = subprocess.run([titin, "check", *arguments], capture_output=True, text=True)
    if found.returncode:
        raise Problem((found.stderr or found.stdout).strip().removeprefix("error: "))
    facts = dict(re.findall(r"^  (\w+) +(.+)$", found.stdout, re.M))
    return {**facts, "cells": int(facts["cells"]), "unknowns": int(facts["unknowns"])}


def advised_ranks(facts, cores_per_node):
    ranks = max(1, min(facts["cells"], round(facts["unknowns"] / GOOD_LOAD)))
    if cores_per_node and ranks > cores_per_node:  # whole nodes
        ranks = math.ceil(ranks / cores_per_node) * cores_per_node
    return ranks


def advice(facts, ranks, advised):
    """One line on the number of ranks, and whether it is a warning."""
    size = f"{facts['cells']:,} cells, {facts['unknowns']:,} unknowns"
    load = facts["unknowns"] / ranks
    line = f"{size}: {ranks} rank{'s' * (ranks > 1)}, {load:,.0f} unknowns each"
    if ranks > facts["cells"]:
        raise Problem(f"{size}: {ranks} ranks are more than cells; take {advised}")
    if load < LEAST_LOAD and ranks > 1:
        return f"{line}: they will mostly wait for each other; {advised} would do"
    return line + (f" ({advised} would do)" if ranks > 2 * advised else "")


def job_name(folder):
    return re.sub(r"[^\w.+-]", "_", folder.name)


def quoted_pattern(path):
    """A path where sbatch takes a pattern: %j would be the number of the job."""
    return shlex.quote(path.replace("%", "%%"))


def job_script(values, site, ranks):
    """job.sh with its @WORDS@ replaced; every word must be known."""
    nodes = [f"--nodes={math.ceil(ranks / site['cores_per_node'])}"] if site["cores_per_node"] else []
    def filled(line):
        return line.replace("{root}", shlex.quote(str(ROOT))).replace("{ranks}", str(ranks))

    values = {
        "RANKS": ranks, "TIME": site["time"], "SECONDS": site["signal_seconds"], "REQUEUES": site["requeues"],
        "OPTIONS": "\n".join(f"#SBATCH {filled(option)}" for option in [*nodes, *site["options"], *values.pop("options", [])]),
        "SETUP": "\n".join(filled(line) for line in site["setup"]), "LAUNCHER": filled(site["launcher"]), "AFTER": "", "EARLIER": "",
        **values,
    }  # fmt: skip
    text = re.sub(r"@([A-Z]+)@", lambda found: str(values[found[1]]), (JOBS / "job.sh").read_text())
    return re.sub(r"\n{3,}", "\n\n", text)


def sbatch(script):
    """Hands the script to Slurm and returns the number of the job."""
    if not shutil.which("sbatch"):
        raise Problem(f"there is no sbatch here, so nothing was submitted; the job is written: {script}")
    found = subprocess.run(["sbatch", "--parsable", str(script)], capture_output=True, text=True)
    if found.returncode:
        raise Problem(f"sbatch refused {script}: {found.stderr.strip()}")
    return found.stdout.strip().split(";")[0]


def guarded(program, main):
    """Runs main; a Problem becomes one sentence and exit code 1."""
    try:
        sys.exit(main())
    except Problem as problem:
        sys.exit(f"{program}: {problem}")
