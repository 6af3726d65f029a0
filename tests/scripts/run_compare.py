#!/usr/bin/env python3
"""What scripts/bench.py --compare prints of two programs, here scripts that pretend to run: ratios, and whether the answers are the same.

    run_compare.py
"""
import contextlib
import io
import pathlib
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(TOP / "scripts"))
import bench_compare  # noqa: E402

PROGRAM = """#!/bin/sh
[ "$2" = refused.toml ] && {{ echo "error: no such key" >&2; exit 1; }}
folder=; while [ $# -gt 0 ]; do [ "$1" = -o ] && folder=$2; shift; done
mkdir -p "$folder"
echo '{{"status": "finished", "steps": {steps}, "newton": {{"total": 4}}, "cpu_seconds": {seconds}, "errors": {{"e": {error}}}}}' >"$folder/run.json"
"""
WANTED = {  # by name of the second program: what its row says
    "alike": ("| 2 s | 1 s | 0.50 | 0.50 to 0.50 | the same |", {"steps": 10, "seconds": 1, "error": 0.25}),
    "other": ("| 2 s | 3 s | 1.50 | 1.50 to 1.50 | steps 10 and 11, errors by 1e-01 |", {"steps": 11, "seconds": 3, "error": 0.275}),
}


def revision(folder, name, **values):
    program = folder / name / "bin" / "titin"
    program.parent.mkdir(parents=True)
    program.write_text(PROGRAM.format(**values))
    program.chmod(0o755)
    return bench_compare.Revision(name, TOP, folder / name)


def main():
    wrong = []
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work)
        old = revision(folder, "old", steps=10, seconds=2, error=0.25)
        for name, (row, values) in WANTED.items():
            out = io.StringIO()
            with contextlib.redirect_stdout(out):
                runs = [bench_compare.run_of(f"{scene}.toml", folder / "runs") for scene in ("fine", "refused")]
                bench_compare.compare_runs(runs, (old, revision(folder, name, **values)), 3)
            rows = out.getvalue().splitlines()[-2:]
            wrong += [f"{got!r}, not {wanted!r}" for got, wanted in zip(rows, (f"| fine {row}", "| refused | error: no such key | error: no such key | | | |")) if got != wanted]
    print("\n".join(wrong) or "as it must be")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
