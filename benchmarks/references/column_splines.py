#!/usr/bin/env python3
"""The column of prm/column_quasi_static.prm in one dimension by averaged quadratic B-splines.

    python3 benchmarks/references/column_splines.py

Nothing of kedge's is used: the means over the points' domains come from the integral of the B-spline,
the equations are dense. Prints the stress errors that the tests of `Basis = spline` expect.
"""
import numpy as np

HEIGHT, DENSITY, GRAVITY = 50., 80., 10.


def integral(s):
    """Of the B-spline about 0 from -3/2 to s, in cells."""
    s = np.clip(s, -1.5, 1.5)
    return np.where(s < -.5, (s + 1.5) ** 3 / 6,
                    np.where(s < .5, .5 + .75 * s - s ** 3 / 3, 1 - (1.5 - s) ** 3 / 6))


def spline(s):
    """The B-spline about 0."""
    a = abs(s)
    return np.where(a < .5, .75 - s * s, np.where(a < 1.5, .5 * (1.5 - a) ** 2, 0))


def functions(h, n, low, high):
    """Means over [low, high] and mean slopes; the node below the base goes to the first two."""
    nodes = np.arange(-1, n + 3)
    begin, end = low[:, None] / h - nodes, high[:, None] / h - nodes
    length = (high - low)[:, None] / h
    value = (integral(end) - integral(begin)) / length
    slope = (spline(end) - spline(begin)) / length / h
    for f in (value, slope):
        f[:, 1] += 2 * f[:, 0]
        f[:, 2] -= f[:, 0]
    return value[:, 1:], slope[:, 1:]


def stress_error(n, modulus, steps):
    """Mean of |sigma - exact| over rho g H, 2 points per cell."""
    h = HEIGHT / n
    start = (np.arange(2 * n) + .5) * h / 2
    x, stretch = start.copy(), np.ones(2 * n)
    for step in range(1, steps + 1):
        low = np.maximum(x - h / 4 * stretch, 0)
        value, slope = functions(h, n, low, x + h / 4 * stretch)
        used = np.nonzero(value.sum(0) > 1e-12)[0]
        used = used[used > 0]  # the base is held
        value, slope = value[:, used], slope[:, used]
        weight = -(DENSITY * h / 2 * GRAVITY * step / steps) * value.sum(0)
        u, volume = np.zeros(len(used)), h / 2 * stretch
        for _ in range(30):
            new = stretch * (1 + slope @ u)
            stress = modulus * np.log(new) / new
            defect = weight - (volume * stress) @ slope
            tangent = (slope * (volume * modulus * (1 - np.log(new)) / new ** 2
                                * stretch)[:, None]).T @ slope
            scale = np.sqrt(abs(tangent.diagonal()) + 1e-300)
            if np.linalg.norm(defect / scale) < 1e-9 * np.linalg.norm(weight / scale):
                break
            scaled = tangent / np.outer(scale, scale) + 1e-12 * np.eye(len(scale))
            u += np.linalg.solve(scaled, defect / scale) / scale
        stretch, x = stretch * (1 + slope @ u), x + value @ u
    stress = modulus * np.log(stretch) / stretch
    exact = -DENSITY * GRAVITY * (HEIGHT - start)
    return abs(stress - exact).mean() / (DENSITY * GRAVITY * HEIGHT)


for youngs_modulus, load_steps in ((1e4, 40), (1e6, 20)):
    for cells in (16, 32, 64, 128, 256):
        print(f"E = {youngs_modulus:g}, {cells} cells: "
              f"{stress_error(cells, youngs_modulus, load_steps):.3e}", flush=True)
