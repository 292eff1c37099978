#!/usr/bin/env python3
"""Consolidation of a cylinder and a sphere along the radius: the exact values checked another way.

    python3 benchmarks/saturated/radial.py [--elements N]

The series of prm/drained_cylinder.prm and prm/drained_sphere.prm come from a Laplace transform.
This program knows neither: it solves Biot's equations themselves,
    d sigma_r/dr + k (sigma_r - sigma_t)/r = dp/dr,  sigma = 2 G strain + lambda tr(strain),
    d/dt (du/dr + k u/r) = kappa/(rho g) (p'' + k p'/r),   k = 1 (cylinder), 2 (sphere),
by finite elements in r, cubic displacements and quadratic pressures, under the load q at r = a,
where p = 0. In time it is exact: what the displacement owes the pressure is eliminated, and
S dp/dt = -H p is a sum of modes, whose first state is the undrained one. The table compares the
greatest pressure at the centre and its time with the series; the exit code is 1 if they differ by
more than 2e-6 (the digits of the series are good to 5e-7).
"""
import argparse
import sys

import with_numpy  # noqa: F401 pylint: disable=unused-import
import numpy as np

# from the headers of the scenes: greatest p(0)/q and its time c t/a^2, Poisson's ratio 0
SERIES = {"cylinder": (1, 1.271739, 0.064093), "sphere": (2, 1.575425, 0.062705)}
TOLERANCE = 2e-6


def lagrange(degree, s):
    """Values and slopes at s of the polynomials of equidistant nodes on (0, 1)."""
    nodes = np.linspace(0., 1., degree + 1)
    polynomials = [np.poly1d(np.poly(np.delete(nodes, i)) / np.prod(x - np.delete(nodes, i)))
                   for i, x in enumerate(nodes)]
    return (np.array([f(s) for f in polynomials]), np.array([f.deriv()(s) for f in polynomials]))


def matrices(k, n, poisson):
    """Stiffness, coupling, flow and the load's vector; M, c, a, q = 1."""
    lame = poisson / (1 - poisson)  # over M
    shear = 0.5 * (1 - 2 * poisson) / (1 - poisson)
    size = 1. / n
    stiffness = np.zeros((3 * n + 1, 3 * n + 1))
    coupling = np.zeros((3 * n + 1, 2 * n + 1))
    flow = np.zeros((2 * n + 1, 2 * n + 1))
    places, weights = np.polynomial.legendre.leggauss(6)
    for s, w in zip(0.5 * (places + 1), 0.5 * weights * size):
        shape, slope = lagrange(3, s)
        value, gradient = lagrange(2, s)
        for e in range(n):
            of_u, of_p = slice(3 * e, 3 * e + 4), slice(2 * e, 2 * e + 3)
            r = (e + s) * size
            volume = w * r**k
            radial, hoop = slope / size, shape / r
            trace = radial + k * hoop
            stiffness[of_u, of_u] += volume * (2 * shear * (np.outer(radial, radial)
                                                            + k * np.outer(hoop, hoop))
                                               + lame * np.outer(trace, trace))
            coupling[of_u, of_p] += volume * np.outer(trace, value)
            flow[of_p, of_p] += volume * np.outer(gradient, gradient) / size**2
    load = np.zeros(3 * n + 1)
    load[-1] = -1.
    # u(0) = 0; p(a) = 0
    return stiffness[1:, 1:], coupling[1:, :-1], flow[:-1, :-1], load[1:]


def centre_pressure(k, n, poisson=0.):
    """The function of time p(0)/q."""
    stiffness, coupling, flow, load = matrices(k, n, poisson)
    # K u - Q p = f, Q^T du/dt + H p = 0: S dp/dt = -H p with S = Q^T K^-1 Q
    solved = np.linalg.solve(stiffness, np.column_stack([coupling, load]))
    storage = coupling.T @ solved[:, :-1]
    start = -coupling.T @ solved[:, -1]  # Q^T u = 0 at first: S p = -Q^T K^-1 f
    lower = np.linalg.cholesky(flow)
    inverse = np.linalg.inv(lower)
    times, vectors = np.linalg.eigh(inverse @ storage @ inverse.T)
    modes = inverse.T @ vectors  # of S v = tau H v, v^T H v = 1
    amplitudes = modes[0] * (modes.T @ start) / times

    def pressure(time):
        return float(amplitudes @ np.exp(-time / times))
    return pressure


def greatest(function, low=0.02, high=0.2):
    """Value and place of the maximum: golden sections."""
    ratio = 0.5 * (np.sqrt(5) - 1)
    while high - low > 1e-9:
        a, b = high - ratio * (high - low), low + ratio * (high - low)
        if function(a) > function(b):
            high = b
        else:
            low = a
    return function(0.5 * (low + high)), 0.5 * (low + high)


def main():
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--elements", type=int, default=80)
    arg = parser.parse_args()
    good = True
    print("            elements  greatest p(0)/q   at c t/a^2   series             off by")
    for name, (k, value, time) in SERIES.items():
        for n in (arg.elements // 4, arg.elements // 2, arg.elements):
            found, at = greatest(centre_pressure(k, n))
            off = abs(found - value)
            print(f"{name:10s} {n:9d} {found:16.8f} {at:12.6f}   {value} at {time} {off:10.1e}")
        good = good and off < TOLERANCE and abs(at - time) < TOLERANCE
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
