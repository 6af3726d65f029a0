#!/usr/bin/env python3
"""Errors are coloured where a person reads them, on a terminal that shows colours, and nowhere else.

    run_colour.py TITIN
"""
import os
import pathlib
import pty
import subprocess
import sys
import tempfile

BLOCK = pathlib.Path(__file__).resolve().parent / "block.toml"
RED_ERROR = b"\x1b[1;31merror:\x1b[0m "
YELLOW_WARNING = b"\x1b[1;33mwarning:\x1b[0m "


def said(command, environment, terminal):
    """What a command writes to its stderr, a terminal or a pipe; its line breaks as a program writes them."""
    environment = {name: value for name, value in os.environ.items() if name not in ("NO_COLOR", "TERM")} | environment
    if not terminal:
        return subprocess.run(command, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE).stderr
    ours, its = pty.openpty()
    process = subprocess.Popen(command, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=its)
    os.close(its)
    text = b""
    try:
        while piece := os.read(ours, 4096):
            text += piece
    except OSError:  # the other end is closed
        pass
    process.wait()
    os.close(ours)
    return text.replace(b"\r\n", b"\n")


def main():
    titin, wrong = str(pathlib.Path(sys.argv[1]).resolve()), []
    with tempfile.TemporaryDirectory() as folder:
        bad = [titin, "check", str(BLOCK), "mesh.cells=[0, 1, 1]"]
        plain = said(bad, {"TERM": "xterm"}, terminal=False)
        coloured = said(bad, {"TERM": "xterm"}, terminal=True)
        if not plain.startswith(b"error: ") or b"\x1b" in plain:
            wrong.append(f"a pipe gets {plain!r}")
        if not coloured.startswith(RED_ERROR) or coloured.replace(RED_ERROR, b"error: ") != plain:
            wrong.append(f"a terminal gets {coloured!r} where a pipe gets {plain!r}")
        for environment in {"TERM": "xterm", "NO_COLOR": "1"}, {"TERM": "dumb"}, {}:
            text = said(bad, environment, terminal=True)
            if text != plain:
                wrong.append(f"a terminal with {environment} gets {text!r}")
        run = pathlib.Path(folder) / "run"
        warned = said([titin, "run", str(BLOCK), 'petsc.no_such_option="1"', "time.end=25 ms", "output.fields=false", "-o", str(run)],
                      {"TERM": "xterm"}, terminal=True)  # fmt: skip
        log = (run / "run.log").read_bytes()
        if YELLOW_WARNING not in warned or b"warning: " not in log or b"\x1b" in log:
            wrong.append(f"a warning looks like {warned!r} on a terminal; in run.log: {log!r}")
    print("\n".join(wrong) or "colours are where they belong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
