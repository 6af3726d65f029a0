#!/usr/bin/env python3
"""Sizes and times of a run's files: VTU against VTKHDF, rules for fields that jump, checkpoints.

    scripts/bench_output.py [--titin build/bin/titin] [--cells 16] [--ranks 1]

A muscle block of CELLS^3 hexahedra and a gas of as many cubes of six tetrahedra make two steps, and write their fields
three times and a checkpoint after each step. Prints a table: bytes for each time, and CPU seconds (all ranks) for each,
from the timers of run.json.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parent.parent
MPI_ENVIRONMENT = dict(re.findall(r"\b(OMPI_\w+)=(\S+)", (TOP / "scripts" / "mpi_environment").read_text()))

MUSCLE = """
model = "muscle"
[mesh]
box = "30, 10, 10 mm"
cells = [{n}, {n}, {n}]
[time]
end = "20 ms"
step = "10 ms"
[muscle]
inertia = "quasi-static"
[materials.gel]
density = "1000 kg/m^3"
volumetric = {{law = "simo", bulk_modulus = "100 kPa"}}
terms.matrix = {{law = "neo_hookean", mu = "100 kPa"}}
[boundary."x-"]
clamp = true
[boundary."x+"]
displacement.x = {{time = "0, 20 ms", value = "0, 1 mm"}}
[solver]
linear = "block"
"""
GAS = """
model = "lagrange"
exact.solution = "riemann"
[mesh]
box = "1, 1, 1 m"
cells = [{n}, {n}, {n}]
kind = "simplices"
[time]
end = "1e-4 s"
step = "5e-5 s"
[fv]
first_step = 1
[materials.gas.fluid]
law = "perfect_gas"
gamma = 1.4
[boundary.sides]
on = ["x-", "x+", "y-", "y+", "z-", "z+"]
wall = true
"""
CHOICES = [(scene, format, jumps, precision)
           for scene, rules in (("muscle", ("kept", "nodes", "means")), ("gas", ("nodes",)))
           for jumps in rules for format in ("vtu", "vtkhdf", "vtkhdf_transient") for precision in ("double", "single")
           if precision == "double" or jumps == "nodes"]  # fmt: skip


def size(folder, pattern):
    return sum(p.stat().st_size for p in folder.rglob(pattern) if p.is_file())


def run(titin, ranks, scene, out, settings):
    launcher = ["mpirun", "--quiet", "-np", str(ranks)] if ranks > 1 else []
    result = subprocess.run([*launcher, titin, "run", scene, *settings, "-o", out, "-q"], env=os.environ | MPI_ENVIRONMENT,
                            capture_output=True, text=True)  # fmt: skip
    if result.returncode != 0:
        sys.exit(result.stderr)
    return json.loads((out / "run.json").read_text())


def main():
    parser = argparse.ArgumentParser(description="Sizes and times of a run's files.")
    parser.add_argument("--titin", default=TOP / "build/bin/titin")
    parser.add_argument("--cells", type=int, default=16)
    parser.add_argument("--ranks", type=int, default=1)
    arguments = parser.parse_args()
    print("| scene | format | jumps | precision | MB a time | CPU s a time | checkpoint MB | CPU s |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory(prefix="titin_bench_") as folder:
        folder = pathlib.Path(folder)
        for scene, text in ("muscle", MUSCLE), ("gas", GAS):
            (folder / f"{scene}.toml").write_text(text.format(n=arguments.cells))
        for number, (scene, format, jumps, precision) in enumerate(CHOICES):
            out = folder / str(number)
            settings = [f"output.format={format}", f"output.jumps={jumps}", f"output.precision={precision}", "output.checkpoint_every=1"]
            report = run(arguments.titin, arguments.ranks, folder / f"{scene}.toml", out, settings)
            times, saves = report["steps"] + 1, report["steps"]
            timers = report["timers"]
            print(f"| {scene} | {format} | {jumps} | {precision} | {size(out / 'fields', '*') / times / 1e6:.2f} | "
                  f"{timers['output']['cpu'] / times:.3f} | {size(out / 'checkpoints', '*') / saves / 1e6:.2f} | "
                  f"{timers['checkpoint']['cpu'] / saves:.3f} |", flush=True)  # fmt: skip


if __name__ == "__main__":
    main()
