"""Whether the Python environment of the drawing scripts is installed: tests that need it are skipped elsewhere (exit 77)."""
import os
import pathlib
import subprocess
import sys

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
SKIPPED = 77


def skip_without_environment(enter=False):
    """scripts/python_environment names the environment before it installs it: its first part is run alone. `enter`: go on inside."""
    naming = (SCRIPTS / "python_environment").read_text().split("if [")[0] + '\necho "$python"'
    naming = naming.replace('$(dirname "${BASH_SOURCE[0]}")', str(SCRIPTS))
    name = subprocess.run(["bash", "-c", naming], capture_output=True, text=True)
    python = pathlib.Path(name.stdout.strip() or "/nowhere")
    if name.returncode or not python.exists():
        print("skipped: the Python environment is not installed; the first call of scripts/plot does that")
        sys.exit(SKIPPED)
    if enter and pathlib.Path(sys.prefix).resolve() != python.parent.parent.resolve():
        os.execv(python, [python, *sys.argv])
