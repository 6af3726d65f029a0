"""Starts the script that imports this again in the Python environment of scripts/python_environment, unless it runs there already."""
import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent


def enter():
    asked = ["bash", "-c", f'. "{HERE}/python_environment" && echo "$python"']
    python = subprocess.run(asked, stdout=subprocess.PIPE, text=True)
    if python.returncode:
        sys.exit("error: the Python environment of the drawing scripts could not be installed")
    python = python.stdout.strip()
    if pathlib.Path(sys.prefix).resolve() != pathlib.Path(python).parent.parent.resolve():
        os.execv(python, [python, *sys.argv])
