#!/usr/bin/env python3
"""Histories that scenes are held against, from formulas and not from this code.

    exact.py            writes the CSV files beside it
    exact.py --check    fails if they are not what it would write (a test runs this)

Each is a homogeneous or one-dimensional problem of elasticity, solved to round-off. Units: SI.
"""
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent


def root(f, low, high):
    """Bisection; f must change its sign once."""
    positive = f(high) > 0
    for _ in range(60):  # halvings: to round-off
        middle = (low + high) / 2
        low, high = (low, middle) if (f(middle) > 0) == positive else (middle, high)
    return (low + high) / 2


def text(x):
    return x if isinstance(x, str) else "0" if abs(x) < 1e-15 else f"{x:.10g}"


def write(name, header, rows):
    lines = "".join(",".join(text(x) for x in row) + "\n" for row in [header, *rows])
    if "--check" not in sys.argv:
        (HERE / name).write_text(lines)
    elif (HERE / name).read_text() != lines:
        sys.exit(f"{name} is not what {__file__} writes")


# --- configs/muscle/fat.toml: a block of muscle and fat, pulled along its fibres, then activated.
# F = diag(l, m, m). Kirchhoff stress: dev(sum of tau_bar) + J U'(J) I, and none sideways.

SINES = [  # active force-length curve: sum A sin(B x + C)
    (0.642587074375392, 1.290128342448810, 0.629168420414746),
    (0.325979591577056, 5.308969899884336, -4.520101562237307),
    (0.328204247867325, 6.744187042136006, 1.689155892259429),
    (0.015388902741327, 19.823676877725276, -7.386155292116579),
    (0.139240359517525, 8.038287396059996, 2.543022326676525),
    (0.001801867529599, 32.237736486095052, -6.454098315528945),
    (0.012560837549867, 23.117614057963024, -2.643346778503341),
]
PEAK, C1, C2, C_FAT = 200e3, 39.81119150206686e3, 73.24669652938298e3, 130e3
FAT, BULK = 0.2, 0.8 * 10e6 + 0.2 * 1e6


def stresses(l, m, activation):
    """Kirchhoff stress along and across the fibres."""
    J = l * m * m
    x, y = l * J ** (-1 / 3), m * J ** (-1 / 3)
    active = activation * sum(a * math.sin(b * x + c) for a, b, c in SINES)
    passive = 2.353844827629192 * (x - 1) ** 2 if x > 1 else 0  # up to 1.25
    matrix = 2 * (C1 + 2 * C2 * (x * x + 2 * y * y - 3))
    softened = (1 - FAT) * matrix + FAT * 2 * C_FAT
    along, across = (1 - FAT) * PEAK * (active + passive) + softened * x * x, softened * y * y
    pressure = BULK / 2 * (J * J - 1)  # J U'
    return 2 / 3 * (along - across) + pressure, -1 / 3 * (along - across) + pressure


def fat():
    rows = []
    for n in range(21):
        time = n * 0.01
        l, activation = 1 + 0.1 * min(time / 0.1, 1), max(0, time / 0.1 - 1)
        m = root(lambda m: stresses(l, m, activation)[1], 0.5, 1.5)
        rows.append([f"{time:.2f}", stresses(l, m, activation)[0] / l * 1e-4, l * m * m * 3e-6, (m - 1) * 0.01])
    write("fat.csv", ["time [s]", "reaction_x+_x [N]", "volume [m^3]", "marker_corner_uy [m]"], rows)


# --- configs/muscle/pressure.toml: a thick tube of neo-Hookean gel, inflated under plane strain.
# r(R): dP_r/dR + (P_r - P_t)/R = 0, P_r = -p r/R inside, 0 outside; l = r', t = r/R, J = l t.

MU, KAPPA, INSIDE, OUTSIDE, MOST = 50e3, 50e6, 5e-3, 10e-3, 20e3


def piola(l, t):
    J = l * t
    k, I1, dU = MU * J ** (-2 / 3), l * l + t * t + 1, KAPPA / 2 * (J - 1 / J)
    return k * (l - I1 / (3 * l)) + dU * t, k * (t - I1 / (3 * t)) + dU * l


def slope(R, r, P):
    t, l = r / R, R / r  # starts without change of volume
    for _ in range(6):  # Newton's method
        step = 1e-6 * l
        l -= (piola(l, t)[0] - P) * 2 * step / (piola(l + step, t)[0] - piola(l - step, t)[0])
    return l, -(P - piola(l, t)[1]) / R


def outer_stress(inner, pressure, steps=200):
    """P_r outside, and the outer radius, by the classical Runge-Kutta method."""
    h, R, r, P = (OUTSIDE - INSIDE) / steps, INSIDE, inner, -pressure * inner / INSIDE
    for n in range(steps):
        R = INSIDE + n * h
        a = slope(R, r, P)
        b = slope(R + h / 2, r + h / 2 * a[0], P + h / 2 * a[1])
        c = slope(R + h / 2, r + h / 2 * b[0], P + h / 2 * b[1])
        d = slope(R + h, r + h * c[0], P + h * c[1])
        r, P = (v + h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]) for i, v in enumerate((r, P)))
    return P, r


def pressure():
    rows = []
    for n in range(6):
        p = MOST * n / 5
        inner = root(lambda inner: outer_stress(inner, p)[0], INSIDE * 0.99, INSIDE * 1.6)
        rows.append([f"{n / 5:.1f}", inner - INSIDE, outer_stress(inner, p)[1] - OUTSIDE])
    write("pressure.csv", ["time [s]", "marker_inside_ux [m]", "marker_outside_ux [m]"], rows)


# --- configs/muscle/rod_wave.toml and configs/lagrange/rod_wave.toml: a pulse of traction runs along a bar between slippery
# walls, is turned round at its held end and comes back. d'Alembert: u = sum over the echoes of +-G(t - way / c), where
# G is the integral of traction / (density c).

LENGTH, DENSITY, MODULUS, PUSH, PULSE = 1.0, 1100.0, 56.6666666667e6 + 4 / 3 * 5.86206896552e6, 100.0, 2e-3
PULSE_ROWS = 20  # of the scene's table, which is linear between them


def pushed(t):
    """Integral of the traction's table up to t, exactly."""
    step, total = PULSE / PULSE_ROWS, 0
    for n in range(PULSE_ROWS):
        a, b = (round(math.sin(math.pi * k / PULSE_ROWS) ** 2, 6) for k in (n, n + 1))
        s = min(max(t - n * step, 0), step)
        total += PUSH * (a * s + (b - a) * s * s / (2 * step))
    return total


def rod_wave():
    c = math.sqrt(MODULUS / DENSITY)

    def displacement(x, t):
        echoes = range(int(t * c / (2 * LENGTH)) + 1)
        ways = [((-1) ** n, 2 * n * LENGTH + LENGTH - x, 2 * n * LENGTH + LENGTH + x) for n in echoes]
        return sum(sign * (pushed(t - there / c) - pushed(t - back / c)) for sign, there, back in ways) / (DENSITY * c)

    rows = [[f"{n * 2e-4:.4f}", displacement(0.5, n * 2e-4), displacement(1.0, n * 2e-4)] for n in range(41)]
    write("rod_wave.csv", ["time [s]", "marker_middle_ux [m]", "marker_end_ux [m]"], rows)


if __name__ == "__main__":
    fat()
    pressure()
    rod_wave()
