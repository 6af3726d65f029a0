#!/usr/bin/env python3
"""Fits curves that are known: without noise the numbers must come back, with noise within intervals of the right width.

    run_fit.py MATERIAL_POINT

Skipped (exit 77) where the Python environment of scripts/fit is not installed: the first call of scripts/fit does that.
"""
import csv
import io
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
SKIPPED = 77
MU = 7.5  # kPa


def environment_is_there():
    """scripts/python_environment names the environment before it installs it: run the first part alone."""
    naming = (SCRIPTS / "python_environment").read_text().split("if [")[0] + '\necho "$environment"'
    naming = naming.replace('$(dirname "${BASH_SOURCE[0]}")', str(SCRIPTS))
    name = subprocess.run(["bash", "-c", naming], capture_output=True, text=True)
    return name.returncode == 0 and pathlib.Path(name.stdout.strip()).is_dir()


def columns(program, *words):
    result = subprocess.run([program, *words], capture_output=True, text=True, check=True)
    rows = list(csv.reader(io.StringIO(result.stdout)))
    return {head.split(" [")[0]: [float(row[k]) for row in rows[1:]] for k, head in enumerate(rows[0])}


def write(path, heads, values, words=()):
    lines = [f"# {word}" for word in words] + [",".join(heads)] + [",".join(f"{x:.17g}" for x in row) for row in zip(*values)]
    path.write_text("\n".join(lines) + "\n")


def fit(program, folder, *words):
    out = folder / "fit.json"
    out.unlink(missing_ok=True)
    command = [program, *words, "-o", str(out)]
    result = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "TITIN_SCRIPTS": str(SCRIPTS)})
    return result, json.loads(out.read_text()) if out.exists() else None


def check(wrong, is_right, what):
    if not is_right:
        wrong.append(what)


def value(found, name):
    return found["parameters"][name]["value"]


def without_noise(program, folder, wrong):
    """Two laws, two loadings at once."""
    files = []
    for loading in ("uniaxial", "equibiaxial"):
        curve = columns(program, "--law", "ogden", "mu=4, -1 kPa", "alpha=[3, -2]", f"loading={loading}", "stretch=1.6", "steps=8")
        files.append(folder / f"{loading}.csv")
        write(files[-1], ["stretch", "P_xx [Pa]"], [curve["F_xx"], curve["P_xx"]], [f"loading={loading}"])
    result, found = fit(
        program, folder, "--law", "ogden", "mu={a}, {b} kPa", "alpha=[{p}, {q}]", *(w for f in files for w in ("--fit", str(f))),
        "--free", "a=0.1,20", "--free", "b=-10,-0.5,-0.01", "--free", "p=1,8", "--free", "q=-6,-3,-1",
    )  # fmt: skip
    if not found:
        return wrong.append(f"ogden: {result.stderr}")
    for name, exact in {"a": 4, "b": -1, "p": 3, "q": -2}.items():
        check(wrong, abs(value(found, name) - exact) < 1e-6 * abs(exact), f"ogden: {name} = {value(found, name)}, not {exact}")


def with_noise(program, folder, wrong):
    """P = mu x with x = l - 1/l^2 is linear in mu: the interval has a closed form."""
    random.seed(11)
    curve = columns(program, "--law", "neo_hookean", f"mu={MU} kPa", "stretch=1.5", "steps=30")
    l, noise = curve["F_xx"], 0.02 * max(curve["P_xx"])
    measured = [P + random.gauss(0, noise) for P in curve["P_xx"]]
    write(folder / "noisy.csv", ["stretch", "P_xx [kPa]"], [l, [P / 1e3 for P in measured]])
    result, found = fit(program, folder, "--law", "neo_hookean", "mu={mu} kPa", "--fit", str(folder / "noisy.csv"), "--free", "mu=0.1,100")
    if not found:
        return wrong.append(f"noisy: {result.stderr}")
    x = [s - 1 / (s * s) for s in l]
    mu = sum(a * P for a, P in zip(x, measured)) / sum(a * a for a in x)
    variance = sum((P - mu * a) ** 2 for a, P in zip(x, measured)) / (len(x) - 1) / sum(a * a for a in x)
    half = 2.04227 * math.sqrt(variance)  # Student's t for 95 % and 30 degrees of freedom
    p = found["parameters"]["mu"]
    check(wrong, abs(1e3 * p["value"] - mu) < 1e-6 * mu, f"noisy: mu = {p['value']} kPa, not {mu / 1e3}")
    check(wrong, abs(500 * (p["upper"] - p["lower"]) - half) < 1e-4 * half, f"noisy: interval +- {500 * (p['upper'] - p['lower'])}, not {half} Pa")
    check(wrong, p["lower"] < MU < p["upper"], f"noisy: {MU} kPa is not in the interval")


def relaxation(program, folder, wrong):
    """A test in time: modulus, strength and time of a branch."""
    term = 'prony={{ strength = [{0}], time = "{1} s" }}'
    curve = columns(program, "--law", "neo_hookean", f"mu={MU} kPa", term.format(0.4, 2), "stretch=1.2", "program=hold", "rise=1 s", "end=10 s", "steps=10")
    write(folder / "held.csv", ["time [s]", "stretch", "P_xx [Pa]"], [curve["time"], curve["F_xx"], curve["P_xx"]])
    result, found = fit(
        program, folder, "--law", "neo_hookean", "mu={mu} kPa", term.format("{g}", "{tau}"), "--fit", str(folder / "held.csv"),
        "--free", "mu=1,100", "--free", "g=0.01,2", "--free", "tau=0.1,50",
    )  # fmt: skip
    if not found:
        return wrong.append(f"relaxation: {result.stderr}")
    for name, exact in {"mu": MU, "g": 0.4, "tau": 2}.items():
        check(wrong, abs(value(found, name) - exact) < 1e-6 * exact, f"relaxation: {name} = {value(found, name)}, not {exact}")


def refusals(program, folder, wrong):
    data = folder / "uniaxial.csv"
    for words, answer in {
        ("mu={mu} kPa", "--free", "m=1,2"): "nothing says {m}",
        ("mu={mu} kPa", "--free", "mu=2,1"): "write NAME=LOWER,UPPER",
        ("mu={mu} mm", "--free", "mu=1,2"): "is not a pressure or stress",
    }.items():
        result, found = fit(program, folder, "--law", "neo_hookean", *words, "--fit", str(data))
        check(wrong, result.returncode != 0 and not found and answer in result.stderr, f"{words}: {result.returncode} {result.stderr}")


def main():
    if not environment_is_there():
        print("skipped: scripts/fit --help installs what is needed")
        return SKIPPED
    program = str(pathlib.Path(sys.argv[1]).resolve())
    wrong = []
    with tempfile.TemporaryDirectory() as name:
        for case in (without_noise, with_noise, relaxation, refusals):
            case(program, pathlib.Path(name), wrong)
    for line in wrong:
        print(line)
    print(f"{len(wrong)} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
