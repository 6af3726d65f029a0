#!/usr/bin/env python3
"""Holds the JSON schema of a scene against a validator that is not ours: every scene is accepted, and these mistakes are not.

    run_schema.py

Skipped (exit 77) where the Python environment of the drawing scripts is not installed.
"""
import copy
import json
import pathlib
import sys
import tomllib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from python_environment_there import skip_without_environment  # noqa: E402

skip_without_environment(enter=True)
import jsonschema  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
# What is changed in a scene, and the key that the validator must then speak of. DROP: the key goes.
DROP = object()
WRONG = {
    "misspelt key": ("muscle/block", {"time.stpe": "25 ms"}, "time"),
    "misspelt table": ("muscle/block", {"tiem": {}}, ""),
    "missing unit": ("muscle/block", {"time.step": 25}, "time.step"),
    "missing unit in text": ("muscle/block", {"time.step": "25"}, "time.step"),
    "negative time": ("muscle/block", {"time.step": "-25 ms"}, "time.step"),
    "two numbers for one": ("muscle/block", {"time.end": "0, 1 s"}, "time.end"),
    "no end": ("muscle/block", {"time.end": DROP}, "time"),
    "no step, implicit": ("muscle/block", {"time.step": DROP}, "time"),
    "no model": ("muscle/block", {"model": DROP}, ""),
    "unknown model": ("muscle/block", {"model": "muscel"}, "model"),
    "unknown law": ("muscle/block", {"materials.muscle.terms.base.law": "yeho"}, "materials.muscle.terms.base.law"),
    "key of another law": ("muscle/block", {"materials.muscle.terms.base.mu": "1 kPa"}, "materials.muscle.terms.base"),
    "key missing to a law": ("muscle/block", {"materials.muscle.terms.base.c1": DROP}, "materials.muscle.terms.base"),
    "key missing to a default law": ("muscle/block", {"materials.muscle.volumetric": {}}, "materials.muscle.volumetric"),
    "neither activation nor excitation": ("muscle/block", {"materials.muscle.terms.active.activation": DROP}, "materials.muscle.terms.active"),
    "no density of a solid": ("muscle/block", {"materials.muscle.density": DROP}, "materials.muscle"),
    "curve of times alone": ("muscle/block", {"boundary.x+.displacement.x": {"time": "0, 1 s"}}, "boundary.x+.displacement.x"),
    "not a choice": ("muscle/block", {"muscle.inertia": "static"}, "muscle.inertia"),
    "text for a switch": ("muscle/block", {"muscle.ellipticity": "true"}, "muscle.ellipticity"),
    "order out of range": ("muscle/block", {"muscle.order": 7}, "muscle.order"),
    "half a cell": ("muscle/block", {"mesh.cells": [8, 8, 0.5]}, "mesh.cells.2"),
    "four coordinates": ("muscle/block", {"markers.top": "1, 2, 3, 4 mm"}, "markers.top"),
    "fluid without a law": ("lagrange/sod", {"materials.gas.fluid.law": DROP}, "materials.gas.fluid"),
    "damage of a law without its scale": (
        "muscle/block", {"materials.muscle.terms.base.damage": {"law": "simo_ju"}}, "materials.muscle.terms.base.damage"),
}  # fmt: skip
RIGHT = {
    "no step, explicit": ("lagrange/sod", {"time.step": DROP}),
    "a number that varies in time": ("muscle/block", {"materials.muscle.terms.base.c1": {"time": "0, 1 s", "value": "1, 2 kPa"}}),
    "a number that varies in space": ("muscle/block", {"materials.muscle.terms.base.c1": {"field": "a.csv", "column": "c1"}}),
    "fibres that vary in space": ("muscle/block", {"materials.muscle.fibre": {"field": "a.csv", "columns": ["x", "y", "z"]}}),
    "an excitation": ("muscle/block", {"materials.muscle.terms.active.activation": DROP,
                                       "materials.muscle.terms.active.excitation": {"file": "e.sto", "column": "soleus"}}),
    "units after each number": ("muscle/block", {"mesh.box": ["30 mm", "1 cm", "1e-2 m"], "time.step": "2.5e-2 s"}),
    "per second": ("muscle/block", {"materials.muscle.terms.active.max_strain_rate": "5 1/s"}),
    "percent": ("muscle/block", {"solver.linear_tolerance": "0.01 %"}),
    "damage of a law with its scale": (
        "muscle/block", {"materials.muscle.terms.base.damage": {"law": "simo_ju", "scale": "1 kJ/m^3"}}),
}  # fmt: skip


def read(name):
    return tomllib.loads((ROOT / "configs" / f"{name}.toml").read_text())


def changed(scene, changes):
    scene = copy.deepcopy(scene)
    for path, value in changes.items():
        *tables, name = path.split(".")
        at = scene
        for table in tables:
            at = at.setdefault(table, {})
        if value is DROP:
            at.pop(name, None)
        else:
            at[name] = value
    return scene


def places(validator, scene):
    return {".".join(str(p) for p in error.absolute_path) for error in validator.iter_errors(scene)}


def main():
    schema = json.loads((ROOT / "docs" / "reference" / "scene.schema.json").read_text())
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    wrong = []
    scenes = sorted(p for p in (ROOT / "configs").rglob("*.toml") if p.parent.name != "point")  # those are of another program
    scenes = [path for path in scenes if "model" in tomllib.loads(path.read_text())]
    for path in scenes:
        for error in validator.iter_errors(tomllib.loads(path.read_text())):
            wrong.append(f"{path.name}: refused at {'.'.join(map(str, error.absolute_path))}: {error.message[:200]}")
    for name, (scene, changes) in RIGHT.items():
        if found := places(validator, changed(read(scene), changes)):
            wrong.append(f"{name}: refused at {found}")
    for name, (scene, changes, place) in WRONG.items():
        found = places(validator, changed(read(scene), changes))
        if place not in found:
            wrong.append(f"{name}: not refused at '{place}', but at {found or 'nothing'}")
    print("\n".join(wrong) or f"{len(scenes)} scenes and {len(RIGHT)} variants accepted, {len(WRONG)} mistakes refused")
    return 1 if wrong or len(scenes) < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
