#!/usr/bin/env python3
"""The reaction of configs/muscle/relaxing.toml at its end, by quadrature and by integration of one ordinary equation.

    tests/data/exact/relaxing.py        prints "exact" of the sweeps of configs/bench/relaxation.toml

F = diag(1 + t / 2, 1, 1), J = 1 + t / 2, so everything is known but what the branch remembers:
Prony: S = S_e + strength int exp(-(1 - s) / tau) dS_e; Maxwell: with b_e coaxial to F, its first elastic strain e (the others -e / 2) has
de/dt = 2/3 d ln lambda / dt - dev(tau)_1 / (2 eta), neo-Hookean dev(tau)_1 = mu (2/3) (exp(2 e) - exp(-e)). Needs SciPy.
"""
import math

from scipy.integrate import quad, solve_ivp

KAPPA, MU, STRENGTH, AREA = 100e3, 10e3, 3.0, 1e-4


def stretch(t):
    return 1 + 0.5 * t


def elastic(t):
    """S_xx of an isochoric neo-Hookean law."""
    a = stretch(t)
    return MU * a ** (-2 / 3) * (1 - (a * a + 2) / 3 / a**2)


def rate(t):
    a = stretch(t)
    return MU * 0.5 * (-2 / 3 * a ** (-5 / 3) * (2 / 3 - 2 / 3 / a**2) + a ** (-2 / 3) * 4 / 3 / a**3)


def volumetric():
    """P_xx of Simo's energy kappa / 4 (J^2 - 1 - 2 ln J)."""
    J = stretch(1)
    return KAPPA / 2 * (J - 1 / J)


def prony(tau):
    points = [p for p in (1 - 30 * tau, 1 - 3 * tau) if 0 < p < 1]
    part, _ = quad(lambda s: math.exp(-(1 - s) / tau) * rate(s), max(0, 1 - 60 * tau), 1, points=points or None, epsabs=1e-12, epsrel=1e-12, limit=400)
    return AREA * (volumetric() + stretch(1) * (elastic(1) + STRENGTH * part))


def maxwell(tau):
    mu, eta = STRENGTH * MU, STRENGTH * MU * tau

    def dev(e):
        return mu * 2 / 3 * (math.exp(2 * e) - math.exp(-e))

    found = solve_ivp(lambda t, e: [2 / 3 * 0.5 / stretch(t) - dev(e[0]) / (2 * eta)], (0, 1), [0.0], method="Radau", rtol=1e-11, atol=1e-14)
    return AREA * (volumetric() + stretch(1) * elastic(1) + dev(found.y[0, -1]) / stretch(1))


for tau in (1e-4, 1e-2, 0.1, 1, 1e4):
    print(f"tau = {tau:g} s: Prony {prony(tau):.9f} N, Maxwell {maxwell(tau):.9f} N")
