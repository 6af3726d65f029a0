#!/usr/bin/env python3
"""Holds a slender block of muscle (1 to 20, a quarter of it meshed) against the rod that stands for it: one task, both scenes of the ladder.

    run_ladder.py TITIN

The force of the block differs by less than 1 % of its largest from that of the rod, in every step; so does that of a chain and of one
element, as this task is slow for its size. With a bulk modulus ten times lower the block differs by more: it does not keep its volume.
"""
import csv
import os
import pathlib
import re
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parent.parent.parent
MPI_ENVIRONMENT = dict(re.findall(r"\b(OMPI_\w+)=(\S+)", (TOP / "scripts" / "mpi_environment").read_text()))
CLOSE = 0.01
# Scene, part of the area that it computes, overrides.
ROD = ("configs/rod/ladder.toml", 1, [])
CLOSE_TO_ROD = {
    "block": ("configs/muscle/ladder.toml", 0.25, []),
    "chain": ("configs/rod/ladder.toml", 1, ["rod.kind=chain"]),
    "one element": ("configs/rod/ladder.toml", 1, ["rod.kind=massless"]),
}
FAR = {"soft block": ("configs/muscle/ladder.toml", 0.25, ["materials.muscle.volumetric.bulk_modulus=10 MPa"])}


def forces(titin, folder, rung):
    scene, part, overrides = rung
    command = [titin, "run", TOP / scene, *overrides, "output.fields=false", "-o", folder, "--overwrite", "-q"]
    result = subprocess.run(list(map(str, command)), env=os.environ | MPI_ENVIRONMENT, capture_output=True, text=True)
    if result.returncode:
        sys.exit(f"{scene}: {result.stderr}")
    with open(folder / "history.csv", newline="") as file:
        return {float(row["time [s]"]): float(row["reaction_x+_x [N]"]) / part for row in csv.DictReader(file)}


def main():
    titin, wrong = pathlib.Path(sys.argv[1]).resolve(), []
    with tempfile.TemporaryDirectory(prefix="titin_ladder_") as scratch:
        folder = pathlib.Path(scratch) / "run"
        rod = forces(titin, folder, ROD)
        for name, rung in {**CLOSE_TO_ROD, **FAR}.items():
            other = forces(titin, folder, rung)
            common = sorted(rod.keys() & other.keys())
            off = max(abs(other[t] - rod[t]) for t in common) / max(map(abs, rod.values()))
            print(f"{name}: {len(common)} common times, force differs by at most {100 * off:.3f} %")
            if len(common) < 100:
                wrong.append(f"{name}: only {len(common)} common times")
            if (off < CLOSE) != (name in CLOSE_TO_ROD):
                wrong.append(f"{name}: {100 * off:.3f} %")
    for text in wrong:
        print(f"WRONG  {text}")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
