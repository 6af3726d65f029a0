"""Draws what memory does to a law: relaxation, loops at several rates, and damage, from the point driver. Started by
scripts/pictures.
"""
import argparse
import csv
import io
import pathlib
import subprocess
import sys

import matplotlib.pyplot as plt
import numpy as np
from plot_style import COLOURS, FAINT, STYLE, name_ends

GEL = ["--law", "neo_hookean", "mu=10 kPa"]
STRETCH = 1.3
RELAXING = {
    "two branches": 'prony={ strength = [0.4, 0.3], time = "0.05, 2 s", reference = "instantaneous" }',
    "spectrum": 'spectrum={ c = 0.2, shortest = "0.01 s", longest = "10 s" }',
    "fractional": 'fractional={ order = 0.2, modulus = 0.8, window = "100 s" }',
}
DAMAGE = {
    "undamaged": None,
    "exponential": 'damage={ law = "exponential", scale = "3 kJ/m^3" }',
    "residual 40 %": 'damage={ law = "simo_ju", residual = 0.4, scale = "3 kJ/m^3" }',
}


class Driver:
    def __init__(self, program):
        self.program = program

    def columns(self, *words):
        result = subprocess.run([self.program, *words], capture_output=True, text=True)
        if result.returncode:
            sys.exit(f"plot: {' '.join(words)}: {result.stderr}")
        rows = list(csv.reader(io.StringIO(result.stdout)))
        values = np.array(rows[1:], dtype=float)
        return {head.split(" [")[0]: values[:, k] for k, head in enumerate(rows[0])}


def draw_relaxation(axes, point):
    ends = {}
    for (name, wrapper), colour in zip(RELAXING.items(), COLOURS):
        found = point.columns(*GEL, wrapper, f"stretch={STRETCH}", "program=hold", "rise=1 ms", "end=100 s", "steps=100", "spacing=logarithmic")
        after = found["time"] > 0.005
        share = found["P_xx"][after] / found["P_xx"][after][0]
        axes.semilogx(found["time"][after], share, color=colour, linewidth=1.8)
        ends[name] = share[-1]
    axes.set_ylim(0, 1.03)
    axes.set_xlim(0.01, 100)
    axes.set_title("Relaxation: stress over its first value")
    axes.set_xlabel("time [s]")
    name_ends(axes, 100, ends, COLOURS)


def draw_loops(axes, point):
    for rise, colour in zip((0.02, 0.2, 20), COLOURS):
        found = point.columns(*GEL, RELAXING["two branches"], f"stretch={STRETCH}", "program=cycle", f"rise={rise} s", "cycles=4", "steps=60")
        last = slice(-121, None)
        axes.plot(found["F_xx"][last], found["P_xx"][last] / 1e3, color=colour, linewidth=1.8, label=f"{2 * rise:g} s a cycle")
    axes.axhline(0, color=FAINT, linewidth=0.8)
    axes.set_title("Fourth cycle at three rates [kPa]")
    axes.set_xlabel("stretch")
    axes.legend(frameon=False)


def draw_damage(axes, point):
    course = 'stretch={ time = "0, 1, 2, 3, 4, 5, 6 s", value = [1, 1.3, 1, 1.6, 1, 1.9, 1] }'
    ends = {}
    for (name, wrapper), colour in zip(DAMAGE.items(), (COLOURS[5], *COLOURS[:2])):
        found = point.columns(*GEL, *([wrapper] if wrapper else []), course, "steps=40")
        axes.plot(found["F_xx"], found["P_xx"] / 1e3, color=colour, linewidth=1.6)
        peak = np.argmax(found["F_xx"])
        ends[name] = found["P_xx"][peak] / 1e3
    axes.margins(x=0)
    axes.axhline(0, color=FAINT, linewidth=0.8)
    axes.set_title("Damage in growing cycles [kPa]")
    axes.set_xlabel("stretch")
    name_ends(axes, 1.9, ends, (COLOURS[5], *COLOURS[:2]))


def main():
    parser = argparse.ArgumentParser(prog="plot_memory.py")
    parser.add_argument("--program", required=True, help="the point driver")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    options = parser.parse_args()
    plt.rcParams.update(STYLE)
    figure, axes = plt.subplots(1, 3, figsize=(12.5, 3.9), layout="constrained")
    figure.get_layout_engine().set(w_pad=0.1, h_pad=0.08)
    point = Driver(options.program)
    for draw, one in zip((draw_relaxation, draw_loops, draw_damage), axes):
        draw(one, point)
    figure.suptitle("Memory around a neo-Hookean gel", x=0.008, ha="left", fontsize=13, fontweight="bold")
    figure.savefig(options.output, dpi=130, facecolor="white")
    print(f"[plot] wrote {options.output}")


if __name__ == "__main__":
    main()
