"""What scripts run in: enter() starts the one that imports this again in the Python environment of scripts/python_environment, unless it
runs there already; mpi() is the environment of programs."""
import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent


def mpi():
    """What scripts/mpi_environment exports, and one thread a rank."""
    lines = (HERE / "mpi_environment").read_text().splitlines()
    words = [word for line in lines if line.startswith("export ") for word in line.split("#")[0].split()[1:]]
    return {**os.environ, "OPENBLAS_NUM_THREADS": "1", **dict(word.split("=", 1) for word in words)}


def enter():
    asked = ["bash", "-c", f'. "{HERE}/python_environment" && echo "$python"']
    python = subprocess.run(asked, stdout=subprocess.PIPE, text=True)
    if python.returncode:
        sys.exit("error: the Python environment of the drawing scripts could not be installed")
    python = python.stdout.strip()
    if pathlib.Path(sys.prefix).resolve() != pathlib.Path(python).parent.parent.resolve():
        os.execv(python, [python, *sys.argv])
