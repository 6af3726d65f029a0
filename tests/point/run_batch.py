#!/usr/bin/env python3
"""Holds `material_point --batch` against independent numbers, and its answers to bad entries to their words.

    run_batch.py MATERIAL_POINT

The numbers are tests/data/materials/hyperelastic.json; MODELS says each model in the language of scenes.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

DATA = pathlib.Path(__file__).resolve().parent.parent / "data" / "materials" / "hyperelastic.json"
STRESS, ENERGY, TANGENT = 1e-10, 1e-10, 1e-8  # relative to the norm
EPSILON = 2.0**-52


def law(name, **keys):
    """A term: each key of the law, and the parameter of the entry that is its value."""
    return lambda p: {"law": name, **{key: p[given] for key, given in keys.items() if given in p}}


def yeoh(scale):
    return lambda p: {"law": "yeoh", **{c: p[scale] * p[c] for c in ("c1", "c2", "c3")}}


def goh(**more):
    return lambda p: {"law": "goh", **more, **{k: p[k] for k in ("k1", "k2", "kappa", "switch")}}


def cann(p):
    weights = {"1": p["wI1"], "2": p["wI2"]}
    moduli = {f"moduli_{k}": [w[0], w[1], w[3], w[4]] for k, w in weights.items()}
    return {"law": "cann", **moduli, **{f"exponents_{k}": [w[2], w[5]] for k, w in weights.items()}}


def growth(p):
    axis = {"area": "normal", "fibre": "direction"}
    more = {axis[p["kind"]]: p["dir"]} if p["kind"] in axis else {}
    return {"law": {"iso": "isotropic"}.get(p["kind"], p["kind"]), "stretch": p["theta"], "per": p["per"], **more}


HILL = law("hill_active", peak_stress="sigma0", activation="act")
SHEAR = law("blemker_shear", g1="G1", g2="G2")
MODELS = {
    "svk": [law("st_venant_kirchhoff", mu="mu", **{"lambda": "lambda"})],
    "neo_hookean_iso": [law("neo_hookean", mu="mu")],
    "neo_hookean_compressible": [law("compressible_neo_hookean", mu="mu", **{"lambda": "lambda"})],
    "mooney_rivlin": [law("mooney_rivlin", c1="C1", c2="C2")],
    "yeoh": [yeoh("s")],
    "veronda_westmann": [law("veronda_westmann", c1="c1", c2="c2")],
    "ogden": [law("ogden", mu="mu", alpha="alpha")],
    "goh2": [lambda p: {"law": "neo_hookean", "mu": 2 * p["C10"]}, goh(), goh(family="second")],
    "holzapfel_ogden": [law("holzapfel_ogden", **{k: k for k in ("a", "b", "af", "bf", "as", "bs", "afs", "bfs")})],
    "guccione": [law("guccione", c="C", bf="bf", bt="bt", bfs="bfs")],
    "weiss_ti": [law("mooney_rivlin", c1="C1", c2="C2"), law("weiss_fibre", c3="C3", c4="C4", c5="C5", lambda_straight="lam_m")],
    "blemker_muscle": [
        SHEAR,
        law("blemker_passive", peak_stress="smax", optimal_stretch="Lofl", p1="P1", p2="P2", lambda_straight="lam_star"),
        law("blemker_active", peak_stress="smax", optimal_stretch="Lofl", activation="act"),
    ],
    "blemker_tendon": [SHEAR, law("weiss_fibre", c3="L1", c4="L2", lambda_straight="lam_star")],
    "holmes_mow": [law("holmes_mow", mu="mu", beta="beta", **{"lambda": "lambda"})],
    "transiso_neo": [law("neo_hookean", mu="mu"), law("linear_fibre", stiffness="kf")],
    "flexodeal_muscle": [
        yeoh("sigma0b"), law("hill_passive", peak_stress="sigma0"), lambda p: {**HILL(p), "max_strain_rate": p.get("e0", 5.0)},
    ],
    "cann": [cann, lambda p: {"law": "cann_fibre", **dict(zip(("w1", "w2", "b"), p["wI4"]))}],
    "icnn": [lambda p: {"law": "icnn", "amplitude": p["a"], "bias": p["b"], "weight_1": [w[0] for w in p["W"]], "weight_2": [w[1] for w in p["W"]]}],
    "growth": [law("neo_hookean", mu="mu")],
    "active": [lambda p: {"law": "active_stress", "activation": 1, "peak_stress": p["ta"], "measure": p["mode"]}],
    "flexodeal_tendon": [yeoh("sigma0b"), law("collagen_table", stress_scale="sigma0")],
}  # fmt: skip


def question(entry):
    model = max((m for m in MODELS if entry["model"].startswith(m)), key=len, default=None)
    if model is None:
        return None
    p = entry["params"]
    asked = {"name": f"{entry['model']} at {entry['F_name']}", "units": entry["units"], "F": entry["F"]}
    asked["terms"] = {f"t{k}": term(p) for k, term in enumerate(MODELS[model])}
    if "K" in p:
        asked["volumetric"] = {"law": p.get("vol", "simo"), "bulk_modulus": p["K"]}
    for key, names in {"fibre": ("a0", "f0"), "second_fibre": ("s0",)}.items():
        asked |= {key: p[name] for name in names if name in p}
    if "fibres" in p:
        asked["fibre"], asked["second_fibre"] = p["fibres"]
    if "theta" in p:
        asked["growth"] = growth(p)
    if p.get("aniso") == "full":
        asked["fibre_invariants"] = "full"
    if "Fn" in p:
        asked |= {"F_old": p["Fn"], "dt": p["dt"], "fibre_rate": "velocity_gradient"}
    return asked


def flat(x):
    return [v for row in x for v in row]


def distance(x, y):
    return math.dist(flat(x), flat(y))


def size(x):
    return math.hypot(*flat(x))


def faults(entry, answer):
    """What is further from the reference than allowed; stress not below what the last digit of F changes."""
    round_off = 4 * EPSILON * size(entry["dPdF"])
    for name, tolerance in {"P": STRESS, "sigma": STRESS}.items():
        if name in entry and distance(answer[name], entry[name]) > tolerance * size(entry[name]) + round_off:
            yield name
    if not entry.get("tangent_at_kink") and distance(answer["dPdF"], entry["dPdF"]) > TANGENT * size(entry["dPdF"]):
        yield "dPdF"
    expected = entry["energy"]
    if expected is not None and abs(answer["energy"] - expected) > ENERGY * abs(expected) + round_off * 1e-6:
        yield "energy"
    if abs(answer["J"] - entry["J"]) > 4 * EPSILON:
        yield "J"


def run(program, batch, folder):
    (folder / "in.json").write_text(json.dumps(batch))
    out = folder / "out.json"
    out.unlink(missing_ok=True)
    command = [program, "--batch", "in.json", "-o", "out.json"]
    result = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=300)
    return result, json.loads(out.read_text())["entries"] if out.exists() else None


def check_numbers(program, folder):
    entries = [e for e in json.loads(DATA.read_text())["entries"] if question(e)]
    result, answers = run(program, [question(e) for e in entries], folder)
    if result.returncode or len(answers) != len(entries):
        return [f"exit {result.returncode}: {result.stderr}"]
    wrong = [f"{a['name']}: {f} differs" for e, a in zip(entries, answers) for f in faults(e, a)]
    print(f"{len(entries)} entries, {len(wrong)} wrong")
    return wrong


GOOD = {"law": "neo_hookean", "parameters": {"mu": 1e4}, "volumetric": {"bulk_modulus": "1 MPa"}, "F": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}
BAD = {  # what is changed, and a part of the answer
    "is not known here; did you mean \"neo_hookean\"": {"law": "neo_hokean"},
    "material.terms.law.mu: \"-1 Pa\" is out of range": {"parameters": {"mu": -1}},
    "mu: null is no value": {"parameters": {"mu": None}},
    "material.terms.law.nu: unknown key": {"parameters": {"mu": 1, "nu": 1}},
    "F: its determinant -1 is not positive": {"F": [[-1, 0, 0], [0, 1, 0], [0, 0, 1]]},
    "F: not 3 rows of 3 numbers": {"F": [[1, 0, 0]]},
    "dt: a rate needs a step above zero": {"F_old": GOOD["F"]},
    "activation: no term has one": {"activation": 1},
    "fibre_rate: \"fast\" is not known here": {"fibre_rate": "fast"},
    "\"furlong\"": {"units": "furlong"},
}  # fmt: skip


def check_refusals(program, folder):
    """Each bad entry is named, and nothing is written."""
    for words, change in BAD.items():
        result, answers = run(program, [GOOD, {**GOOD, **change, "name": "odd one"}], folder)
        if result.returncode != 1 or answers is not None or f"in.json: entry 2 \"odd one\": " not in result.stderr or words not in result.stderr:
            yield f"{change}: exit {result.returncode}, {result.stderr}"


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        wrong = [*check_numbers(program, folder), *check_refusals(program, folder)]
    for line in wrong:
        print(line)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
