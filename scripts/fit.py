"""Fits numbers of a material to measured curves by bounded least squares (scipy.optimize.least_squares). Started by
scripts/fit or by material_point --fit.

The words for material_point hold {NAME} where a number is free. A data file is a CSV with one column that drives (stretch,
shear or stress), one or more that were measured (P_xx, sigma_xx, F_yy, ...), units in brackets, and time if rates matter;
lines "# key=value" in it go to material_point for this file alone. docs/howto/material_point.md tells the rest.
"""
import argparse
import csv
import io
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import scipy.optimize
import scipy.stats

DRIVES = ("stretch", "shear", "stress")
PREFIXES = {"": 1.0, "k": 1e3, "M": 1e6, "G": 1e9, "m": 1e-3, "u": 1e-6}
CONFIDENCE = 0.95
NO_CURVE = 10.0  # residual, in units of the largest measured value, where material_point finds no equilibrium


class Refusal(Exception):
    pass


def scale_of(unit):
    """Factor to SI of Pa, s, 1/s, J/m^3 and their multiples."""
    for base in ("", "Pa", "s", "1/s", "J/m^3"):
        if unit.endswith(base) and unit[: len(unit) - len(base)] in PREFIXES:
            return PREFIXES[unit[: len(unit) - len(base)]]
    raise Refusal(f"unit [{unit}] is not known here; write Pa, kPa, MPa, s or ms")


class Measured:
    """One data file: what drives, and what was measured at each row, in SI."""

    def __init__(self, path):
        self.name = path.stem.replace("_", " ")
        if not path.is_file():
            raise Refusal(f"{path}: the file is not there")
        lines = [line.strip() for line in path.read_text().splitlines() if line.strip()]
        self.words = [line[1:].strip() for line in lines if line.startswith("#") and "=" in line]
        rows = list(csv.reader(line for line in lines if not line.startswith("#")))
        heads = [head.strip() for head in rows[0]] if rows else []
        try:
            numbers = np.array(rows[1:], dtype=float)
        except ValueError:
            raise Refusal(f"{path}: rows of {len(heads)} numbers are wanted below the heads") from None
        if numbers.ndim != 2 or len(numbers) < 2 or numbers.shape[1] != len(heads) or not np.all(np.isfinite(numbers)):
            raise Refusal(f"{path}: at least two rows of {len(heads)} numbers are wanted below the heads")
        columns = {}
        for k, head in enumerate(heads):
            name, _, unit = head.partition(" [")
            columns[name] = numbers[:, k] * scale_of(unit.rstrip("]"))
        drive = [name for name in columns if name in DRIVES]
        if len(drive) != 1:
            raise Refusal(f"{path}: one column must be called {', '.join(DRIVES[:-1])} or {DRIVES[-1]}")
        self.drive, self.driven = drive[0], columns.pop(drive[0])
        self.in_time = "time" in columns
        self.time = columns.pop("time", np.arange(len(self.driven), dtype=float))
        if np.any(np.diff(self.time) <= 0):
            raise Refusal(f"{path}: its times do not increase")
        if not columns:
            raise Refusal(f"{path}: nothing was measured; add a column such as P_xx [kPa]")
        self.columns = columns
        self.scale = {name: np.max(np.abs(v)) or 1.0 for name, v in columns.items()}

    def course(self, folder, number):
        """Words that make material_point pass through the rows, each in one step."""
        file = folder / f"course{number}.csv"
        # material_point names the SI unit of a drive itself: a stress is in Pa.
        file.write_text("\n".join(f"{t:.17g} {x:.17g}" for t, x in zip(self.time, self.driven)))
        words = [f'point.{self.drive}={{ file = "{file}" }}', "point.steps=1"]
        return words + ([] if self.in_time else ["point.fibre_rate=none"])


class Model:
    """material_point with free numbers in its words."""

    def __init__(self, options, data, folder):
        self.program, self.data, self.names = options.program, data, [p.name for p in options.free]
        self.laws = [word for law in options.law for word in ("--law", law)]
        self.words = options.words
        self.courses = [m.course(folder, k) for k, m in enumerate(data)]
        self.runs = 0
        used = " ".join(self.words)
        for name in self.names:
            if f"{{{name}}}" not in used:
                raise Refusal(f"--free {name}: nothing says {{{name}}}; write it where the number belongs, such as mu='{{{name}}} kPa'")

    def words_with(self, values):
        words = list(self.words)
        for name, value in zip(self.names, values):
            words = [word.replace(f"{{{name}}}", f"{value:.17g}") for word in words]
        return words

    def curve(self, k, values):
        """Columns at the rows of data file k; None where there is no equilibrium."""
        measured = self.data[k]
        command = [self.program, *self.laws, *self.words_with(values), *measured.words, *self.courses[k]]
        result = subprocess.run(command, capture_output=True, text=True)
        self.runs += 1
        if result.returncode == 2:
            return None
        if result.returncode:
            raise Refusal(f"material_point refuses {measured.name}:\n{result.stderr.strip()}")
        rows = list(csv.reader(io.StringIO(result.stdout)))
        heads = [head.split(" [")[0] for head in rows[0]]
        table = np.array(rows[1:], dtype=float)
        for name in measured.columns:
            if name not in heads:
                raise Refusal(f"{measured.name}: material_point writes no column {name}; it writes {', '.join(heads)}")
        times = table[:, heads.index("time")]
        at = np.searchsorted(times, measured.time - 1e-9 * (1 + np.abs(measured.time)))
        return {name: table[np.minimum(at, len(times) - 1), heads.index(name)] for name in measured.columns}

    def residuals(self, values):
        parts = []
        for k, measured in enumerate(self.data):
            curve = self.curve(k, values)
            for name, y in measured.columns.items():
                difference = (curve[name] - y) / measured.scale[name] if curve else np.full(len(y), NO_CURVE)
                parts.append(difference)
        return np.concatenate(parts)


class Free:
    """NAME=LOWER,UPPER or NAME=LOWER,START,UPPER. One that spans a positive range is searched in its logarithm."""

    def __init__(self, text):
        self.name, _, numbers = text.partition("=")
        try:
            values = [float(x) for x in numbers.split(",")]
            self.lower, self.upper = values[0], values[-1]
        except ValueError:
            values = []
        if not self.name or len(values) not in (2, 3) or not self.lower < self.upper:
            raise argparse.ArgumentTypeError(f"{text!r}: write NAME=LOWER,UPPER or NAME=LOWER,START,UPPER, in this order")
        self.log = self.lower > 0
        middle = np.sqrt(self.lower * self.upper) if self.log else 0.5 * (self.lower + self.upper)
        self.start = values[1] if len(values) == 3 else middle
        if not self.lower <= self.start <= self.upper:
            raise argparse.ArgumentTypeError(f"{text!r}: the start is not within the bounds")

    def inward(self, x):
        return np.log(x) if self.log else x

    def outward(self, z):
        return min(max(float(np.exp(z)) if self.log else float(z), self.lower), self.upper)


def search(model, free, starts):
    """The best of several searches; the first from the given starts, the others from random places within the bounds."""
    lower, upper = (np.array([p.inward(x) for p, x in zip(free, ends)]) for ends in zip(*((p.lower, p.upper) for p in free)))

    def residuals(z):
        return model.residuals([p.outward(x) for p, x in zip(free, z)])

    random = np.random.default_rng(1)
    best = None
    for k in range(starts):
        z = np.array([p.inward(p.start) for p in free]) if k == 0 else random.uniform(lower, upper)
        found = scipy.optimize.least_squares(
            residuals, z, bounds=(lower, upper), jac="3-point", x_scale=upper - lower, ftol=1e-12, xtol=1e-10, gtol=1e-12
        )
        if best is None or found.cost < best.cost:
            best = found
    return best


def judge(found, free, data):
    """Values, and how sure they are: the covariance is that of the linear problem at the solution."""
    n, m = len(found.fun), len(free)
    values = [p.outward(z) for p, z in zip(free, found.x)]
    slope = np.array([v if p.log else 1.0 for p, v in zip(free, values)])  # d value / d searched
    J = found.jac / slope
    variance = 2 * found.cost / max(n - m, 1)
    u, s, vt = np.linalg.svd(J / (np.linalg.norm(J, axis=0) + 1e-300), full_matrices=False)
    size = np.linalg.norm(J, axis=0) + 1e-300
    known = s > 1e-10 * s[0]
    covariance = variance * (vt.T * np.where(known, 1 / np.where(known, s, 1), 0) ** 2) @ vt / np.outer(size, size)
    half = scipy.stats.t.ppf(0.5 + CONFIDENCE / 2, max(n - m, 1)) * np.sqrt(np.diag(covariance))
    deviation = np.sqrt(np.diag(covariance)) + 1e-300
    rows = np.cumsum([0] + [len(y) for d in data for y in d.columns.values()])
    curves = [(d, name) for d in data for name in d.columns]
    return {
        "parameters": {
            p.name: {"value": v, "lower": v - h, "upper": v + h, "at_bound": bool(min(abs(z - p.inward(p.lower)), abs(z - p.inward(p.upper))) < 1e-6)}
            for p, v, h, z in zip(free, values, half, found.x)
        },
        "confidence": CONFIDENCE,
        "correlation": (covariance / np.outer(deviation, deviation)).tolist(),
        "determined": bool(np.all(known)),
        "rms": float(np.sqrt(np.mean(found.fun**2))),
        "curves": {
            f"{d.name}, {name}": {
                "rms": float(np.sqrt(np.mean((r := found.fun[a:b]) ** 2)) * d.scale[name]),
                "r2": float(1 - np.sum((r * d.scale[name]) ** 2) / max(np.sum((d.columns[name] - np.mean(d.columns[name])) ** 2), 1e-300)),
            }
            for (d, name), a, b in zip(curves, rows, rows[1:])
        },
    }  # fmt: skip


def tell(result, runs):
    width = max(len(name) for name in result["parameters"])
    for name, p in result["parameters"].items():
        half = 0.5 * (p["upper"] - p["lower"])
        note = "   at its bound: the interval means little" if p["at_bound"] else ""
        print(f"{name:<{width}} = {p['value']:.6g} +- {half:.2g}   ({100 * CONFIDENCE:.0f} %){note}")
    for name, curve in result["curves"].items():
        print(f"{name}: root mean square {curve['rms']:.3g} (SI), R^2 = {curve['r2']:.6f}")
    if not result["determined"]:
        print("warning: the data do not determine all of them: some change together without a trace; free fewer", file=sys.stderr)
    print(f"{runs} runs of material_point")


def draw(path, model, result, title):
    import matplotlib.pyplot as plt
    from plot_style import COLOURS, FAINT, STYLE, prefixed

    plt.rcParams.update(STYLE)
    panels = [(k, name) for k, d in enumerate(model.data) for name in d.columns]
    figure, all_axes = plt.subplots(1, len(panels), figsize=(0.8 + 4.6 * len(panels), 4.0), layout="constrained", squeeze=False)
    figure.get_layout_engine().set(w_pad=0.1, h_pad=0.08)
    values = [p["value"] for p in result["parameters"].values()]
    for axes, (k, name) in zip(all_axes[0], panels):
        d = model.data[k]
        x = d.time if d.in_time else d.driven
        factor, prefix = prefixed([d.columns[name]]) if name[0] in "Ps" else (1, "")
        axes.axhline(0, color=FAINT, linewidth=0.8)
        axes.plot(x, factor * d.columns[name], "o", color=COLOURS[0], markersize=4, markerfacecolor="white", label="measured")
        axes.plot(x, factor * model.curve(k, values)[name], color=COLOURS[1], linewidth=1.8, label="fitted")
        letter, _, component = name.partition("_")
        axes.set_title(f"{letter}$_{{{component}}}${f' [{prefix}Pa]' if name[0] in 'Ps' else ''}, {d.name}")
        axes.set_xlabel("time [s]" if d.in_time else d.drive)
    all_axes[0][0].legend(frameon=False)
    facts = "   ".join(f"{n} = {p['value']:.4g} ± {0.5 * (p['upper'] - p['lower']):.2g}" for n, p in result["parameters"].items())
    figure.suptitle(title, x=0.012, ha="left", fontsize=13, fontweight="bold")
    figure.text(0.988, 0.965, facts, ha="right", va="center", color="#5b6472", fontsize=8.5)
    figure.savefig(path, dpi=160, facecolor="white")
    print(f"[plot] wrote {path}")


def arguments():
    parser = argparse.ArgumentParser(prog="scripts/fit", description="Fits numbers of a material to measured curves.")
    parser.add_argument("words", nargs="*", help="scene and key=value for material_point, with {NAME} for each free number")
    parser.add_argument("--law", action="append", default=[], help="a law, as for material_point")
    parser.add_argument("--data", action="append", required=True, type=pathlib.Path, help="a measured curve (CSV)")
    parser.add_argument("--free", action="append", required=True, type=Free, help="NAME=LOWER,UPPER or NAME=LOWER,START,UPPER")
    parser.add_argument("--starts", type=int, default=1, help="searches: one from the start, the others from random places")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="JSON file for values, intervals and correlations")
    parser.add_argument("--plot", action="store_true", help="draw the curves, beside the JSON or the first data file")
    default = pathlib.Path(__file__).resolve().parent.parent / "build" / "bin" / "material_point"
    parser.add_argument("--program", default=str(default), help="the point driver (default: build/bin/material_point)")
    return parser.parse_args()


def main():
    options = arguments()
    try:
        data = [Measured(path) for path in options.data]
        if sum(len(y) for d in data for y in d.columns.values()) <= len(options.free):
            raise Refusal("fewer measured values than free numbers")
        with tempfile.TemporaryDirectory() as folder:
            model = Model(options, data, pathlib.Path(folder))
            found = search(model, options.free, options.starts)
            result = judge(found, options.free, data)
            tell(result, model.runs)
            if options.output:
                part = options.output.with_name(options.output.name + ".part")
                part.write_text(json.dumps(result, indent=1) + "\n")
                os.replace(part, options.output)
            if options.plot:
                what = " + ".join(options.law) or pathlib.Path(options.words[0]).stem
                draw((options.output or options.data[0]).with_suffix(".png"), model, result, f"Fit of {what.replace('_', ' ')}")
    except Refusal as refusal:
        print(f"error: {refusal}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
