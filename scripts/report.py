#!/usr/bin/env python3
"""Writes one HTML file on a run: how it ended, the body, curves, what was conserved, where the time went, warnings, the scene.

    scripts/report.py results/block                writes results/block/report.html
    scripts/report.py results/block -o block.html --field pressure
    scripts/report.py --gallery                    docs/verification/gallery.md again: all that is verified, on one page
    scripts/report.py --gallery --check            is that page up to date? exit code 1 if not
    scripts/report.py --gallery --measure          first runs the small version of every scene again (minutes) and keeps its numbers

The file of a run stands alone: pictures are inside, and a browser asks nobody for anything to show it.
The first call puts PyVista and others (from PyPI) into a virtual environment in the cache; it takes about a minute.
"""
import argparse
import base64
import html
import io
import json
import pathlib
import re
import sys

import environment
import gallery

if "--gallery" in sys.argv[1:]:
    gallery.main()  # draws nothing, and does not come back
environment.enter()
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from plot_run import SMALL, draw_body, energies, per_metre, reactions, read_history, title_of  # noqa: E402
from plot_style import COLOURS, STYLE, draw_curves  # noqa: E402

STYLE_SHEET = (pathlib.Path(__file__).parent / "report.css").read_text()
POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"  # the browser itself refuses to ask anybody
WELL = {"finished": "good", "running": "open", "stopped": "open"}


def text(value):
    return html.escape(str(value))


def number(value):
    return f"{value:,}" if isinstance(value, int) else f"{value:.4g}" if isinstance(value, float) else text(value)


def section(title, *parts):
    return f"<section><h2>{text(title)}</h2>{''.join(parts)}</section>" if any(parts) else ""


def table(head, rows):
    """Rows of cells that are HTML already; the first column names the row."""
    heads = "".join(f"<th>{text(cell)}</th>" for cell in head)
    body = "".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows)
    return f"<div class=wide><table><thead><tr>{heads}</tr></thead><tbody>{body}</tbody></table></div>" if rows else ""


# ---- pictures --------------------------------------------------------------------------------------------------------


def png(figure):
    data = io.BytesIO()
    figure.savefig(data, format="png", dpi=130, facecolor="white")
    plt.close(figure)
    return base64.b64encode(data.getvalue()).decode()


def svg(figure, name):
    data = io.StringIO()
    with plt.rc_context({"svg.hashsalt": name, "svg.fonttype": "none"}):  # the same file for the same run
        figure.savefig(data, format="svg", metadata={key: None for key in ("Date", "Creator", "Format", "Type")}, transparent=True)
    plt.close(figure)
    return data.getvalue()[data.getvalue().index("<svg") :]


def body_figure(folder, options):
    figure = plt.figure(figsize=(7.4, 5.2), layout="constrained")
    draw_body(figure, figure.subplots(), folder, options)
    return f'<figure><img alt="The body, coloured by a field" src="data:image/png;base64,{png(figure)}"></figure>'


def curve_figure(time, curves, quantity, unit):
    figure = plt.figure(figsize=(6.4, 2.9), layout="constrained")
    axes = figure.subplots()
    draw_curves(axes, time, curves, quantity, unit)
    axes.set_xlabel("time [s]")
    return f"<figure>{svg(figure, quantity)}</figure>"


def newton_figure(counts):
    figure = plt.figure(figsize=(6.4, 2.2), layout="constrained")
    axes = figure.subplots()
    axes.bar(np.arange(1, len(counts) + 1), counts, color=COLOURS[0], width=0.8)
    axes.set_title("Newton iterations of each step")
    axes.set_xlabel("step")
    return f"<figure>{svg(figure, 'newton')}</figure>"


def curves_of(history):
    time = history["time [s]"]
    markers = {n[7:-4].replace("_", " "): v for n, v in history.items() if re.fullmatch(r"marker_.+ \[m\]", n)}
    largest = max((np.max(np.abs(v)) for v in markers.values()), default=0)
    markers = {name: v for name, v in markers.items() if np.max(np.abs(v)) > SMALL * largest}
    panels = [(reactions(history), "Force of the held boundaries", "N" + per_metre(history)),
              (energies(history), "Energy and work", "J" + per_metre(history)),
              (dict(list(markers.items())[:6]), "Displacement of the markers", "m")]  # fmt: skip
    return "".join(curve_figure(time, curves, quantity, unit) for curves, quantity, unit in panels if curves and len(time) > 1)


# ---- words -----------------------------------------------------------------------------------------------------------


def facts(run):
    newton = run.get("newton", {})
    rows = {
        "scene": run.get("scene"), "model": run.get("model"), "Titin": f"{run.get('version')} ({run.get('commit')})",
        "ranks": run.get("ranks"), "cells": run.get("cells"), "unknowns": run.get("unknowns"), "steps": run.get("steps"),
        "time reached": f"{run.get('time', 0):.6g} s", "CPU seconds": run.get("cpu_seconds"), "wall seconds": run.get("wall_seconds"),
        "memory of all ranks": f"{run.get('peak_rss_bytes', 0) / 1e6:,.0f} MB", "Newton iterations": newton.get("total"),
        "steps halved": newton.get("cuts"), "linear iterations": run.get("krylov", {}).get("total"), "warnings": run.get("warnings"),
    }  # fmt: skip
    return "<dl>" + "".join(f"<div><dt>{text(k)}</dt><dd>{number(v)}</dd></div>" for k, v in rows.items() if v is not None) + "</dl>"


def head(run, title):
    status = run.get("status", "unknown")
    reason = f"<p class=reason>{text(run['reason'])}</p>" if run.get("reason") else ""
    return f"<header><h1>{text(title)}</h1><p class='status {WELL.get(status, 'bad')}'>{text(status.replace('_', ' '))}</p>{reason}</header>"


def timers(run):
    """Phases by their wall time; a bar shows each one's part."""
    phases = sorted(run.get("timers", {}).items(), key=lambda item: -item[1]["wall"])
    whole = sum(timer["wall"] for _, timer in phases) or 1
    rows = []
    for name, timer in phases:
        bar = f"<span class=bar style='width:{100 * timer['wall'] / whole:.1f}%'></span>"
        rows.append([text(name), f"{timer['wall']:.3f}", f"{timer['cpu']:.3f}", number(timer["calls"]), bar])
    return table(["phase", "wall [s]", "CPU [s]", "calls", "part of the wall time"], rows)


def warnings(folder, run):
    path = folder / "run.log"
    lines = path.read_text(errors="replace").splitlines() if path.exists() else []
    found = [line.partition("warning: ")[2] for line in lines if "warning: " in line]
    found += [f"no solver asked for the option {option}" for option in run.get("unused_options", []) if not any(option in f for f in found)]
    return "<ul class=warnings>" + "".join(f"<li>{text(line)}</li>" for line in found) + "</ul>" if found else "<p>None.</p>"


def norms(run):
    rows = [[text(kind), text(name), f"{value:.3e}" if isinstance(value, float) else number(value)]
            for kind in ("conservation", "errors") for name, value in run.get(kind, {}).items()]  # fmt: skip
    return table(["", "name", "value"], rows)


def columns(history):
    rows = [[text(name), *(f"{x:.5g}" for x in (v[0], v[-1], np.min(v), np.max(v)))] for name, v in history.items() if len(v)]
    return table(["column", "first", "last", "least", "largest"], rows)


def page(folder, options):
    run = json.loads((folder / "run.json").read_text())
    history = read_history(folder)
    title = title_of(folder)
    counts = run.get("newton", {}).get("per_step", [])
    scene = (folder / "resolved.toml").read_text() if (folder / "resolved.toml").exists() else ""
    parts = [
        head(run, title),
        section("What it was", facts(run)),
        section("The body", body_figure(folder, options)),
        section("Curves", f"<div class=figures>{curves_of(history)}{newton_figure(counts) if counts else ''}</div>"),
        section("Conserved, and against a reference", norms(run)),
        section("Warnings", warnings(folder, run)),
        section("Where the time went", timers(run)),
        section("History", columns(history)),
        section("The scene as it was understood", f"<pre>{text(scene)}</pre>" if scene else ""),
        section("Libraries", table(["library", "version"], [[text(k), text(v)] for k, v in run.get("libraries", {}).items()])),
    ]
    return (f'<!doctype html><html lang=en><head><meta charset=utf-8><meta http-equiv=Content-Security-Policy content="{POLICY}">'
            f"<meta name=viewport content='width=device-width'><title>{text(title)}</title><style>{STYLE_SHEET}</style></head>"
            f"<body><main>{''.join(parts)}</main></body></html>\n")  # fmt: skip


def main():
    parser = argparse.ArgumentParser(prog="scripts/report.py", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, help="folder of a run, such as results/block")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="file to write (default: report.html in that folder)")
    parser.add_argument("--field", help="field that colours the body (default: the one most worth a picture)")
    parser.add_argument("--time", type=float, help="time of the shape in s (default: the last one saved)")
    parser.add_argument("--warp", type=float, default=1.0, help="displacements are drawn times this (default: 1)")
    options = parser.parse_args()
    if not (options.folder / "run.json").is_file():
        sys.exit(f"report: {options.folder} holds no run.json; is it the folder of a run?")
    plt.rcParams.update(STYLE)
    output = options.output or options.folder / "report.html"
    output.parent.mkdir(parents=True, exist_ok=True)
    output.write_text(page(options.folder, options))
    print(f"[report] wrote {output}")


if __name__ == "__main__":
    main()
