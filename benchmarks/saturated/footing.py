#!/usr/bin/env python3
"""The harmonic footing under a thousandth of its load: is the negative pressure physics?

    python3 benchmarks/saturated/footing.py [--kedge PROGRAM] [--output DIR] [--cells N ...]
        [--full]

At the scene's conductivity hardly a third of a millimetre drains in 0.4 s: the soil is
undrained, an incompressible elastic block on rollers. Under a small load that problem has a
solution apart from any grid: cosines in x and, in y, vertical motions V of class C1
(cubic Hermite elements here) with
    kinetic energy rho/2 (V^2 + V'^2/k^2), strain energy G (2 V'^2 + (V''/k + k V)^2/2),
    pressure p(H) = q + 2 G V'(H), p' = G (V'' - k^2 V) - rho V_tt;
without inertia p = sum q_k cosh(k y)/(cosh kH + kH/sinh kH) cos(k x). The table has
the smallest pressure of a point in the upper two metres and those of the probes, over the
largest load, beside kedge's. --full adds kedge's runs under the whole load.
"""
import argparse
import csv
import os
import subprocess
import sys
from pathlib import Path

import with_numpy  # noqa: F401 pylint: disable=unused-import
import numpy as np

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(ROOT / "source" / "plot"))
import vtu_reader  # noqa: E402

H = L = 10.
G, RHO, B, OMEGA, T = 5.6e6, 0.67 * 2500 + 0.33 * 1000, 1., 100., 0.4
N_WAVES, N_ELEMENTS = 60, 60
PROBES = {"A": 0.5417, "B": 5.0417, "C": 9.9583}
SCHEMES = {"quasi-static": "quasi-static", "trapezoidal": "trapezoidal", "newmark": "newmark"}


def hermite(s, size):
    """Values of the four cubics on an element, and their first three derivatives."""
    h = size
    return np.array([
        [1 - 3 * s**2 + 2 * s**3, h * (s - 2 * s**2 + s**3), 3 * s**2 - 2 * s**3,
         h * (s**3 - s**2)],
        [(6 * s**2 - 6 * s) / h, 1 - 4 * s + 3 * s**2, (6 * s - 6 * s**2) / h, 3 * s**2 - 2 * s],
        [(12 * s - 6) / h**2, (6 * s - 4) / h, (6 - 12 * s) / h**2, (6 * s - 2) / h]])


def matrices(k):
    """Mass and stiffness of the wave number k; the first unknown, V(0), is dropped."""
    n, size = 2 * (N_ELEMENTS + 1), H / N_ELEMENTS
    mass, stiffness = np.zeros((n, n)), np.zeros((n, n))
    places, weights = np.polynomial.legendre.leggauss(4)
    for e in range(N_ELEMENTS):
        dofs = slice(2 * e, 2 * e + 4)
        for s, w in zip((places + 1) / 2, weights * size / 2):
            v, d, dd = hermite(s, size)
            shear = dd / k + k * v
            mass[dofs, dofs] += w * RHO * (np.outer(v, v) + np.outer(d, d) / k**2)
            stiffness[dofs, dofs] += w * G * (4 * np.outer(d, d) + np.outer(shear, shear))
    return mass[1:, 1:], stiffness[1:, 1:]


def wave_motion(k, times):
    """V and V_tt of all unknowns under the load cos(kx) (1 - cos(omega t))/2 [per Pa]."""
    mass, stiffness = matrices(k)
    lower = np.linalg.cholesky(mass)
    inverse = np.linalg.inv(lower)
    squares, vectors = np.linalg.eigh(inverse @ stiffness @ inverse.T)
    shapes = inverse.T @ vectors
    load = -shapes[-2]  # V(H) is the last but one
    omega = np.sqrt(squares)[:, None]
    t = times[None, :]
    # x'' + omega^2 x = (1 - cos(OMEGA t))/2 from rest
    forced = 0.5 / (omega**2 - OMEGA**2)
    x = 0.5 / omega**2 * (1 - np.cos(omega * t)) - forced * (np.cos(OMEGA * t) - np.cos(omega * t))
    accelerations = 0.5 * (1 - np.cos(OMEGA * t)) - omega**2 * x
    zero = np.zeros((1, times.size))
    return (np.vstack([zero, shapes @ (load[:, None] * x)]),
            np.vstack([zero, shapes @ (load[:, None] * accelerations)]))


def wave_pressure(k, times, levels):
    """Pressure at the levels y under that load [per Pa]."""
    motion, acceleration = wave_motion(k, times)
    size, fine = H / N_ELEMENTS, 8
    slopes, y = [], []
    for e in reversed(range(N_ELEMENTS)):
        for s in (np.arange(fine, 0, -1) - 0.5) / fine:
            v, _, dd = hermite(s, size)
            dofs = slice(2 * e, 2 * e + 4)
            slopes.append(G * (dd - k**2 * v) @ motion[dofs] - RHO * v @ acceleration[dofs])
            y.append((e + s) * size)
    top = 0.5 * (1 - np.cos(OMEGA * times)) + 2 * G * motion[-1]
    step = size / fine
    # from the top down: p at the lower ends of the intervals whose middles are y
    ends = np.vstack([top, top - step * np.cumsum(slopes, axis=0)])
    places = np.concatenate([[H], np.array(y) - step / 2])
    return np.array([[np.interp(level, places[::-1], column[::-1]) for column in ends.T]
                     for level in levels])


def reference(times, levels, inertia):
    """p over the largest load, [level][x][time], and the places x."""
    x = np.linspace(0, L, 241)
    swing = 0.5 * (1 - np.cos(OMEGA * times))
    result = np.ones((len(levels), x.size, 1)) * swing * B / L
    for m in range(1, N_WAVES + 1):
        k = m * np.pi / L
        share = 2 / (m * np.pi) * np.sin(k * B)
        if inertia:
            wave = wave_pressure(k, times, levels)
        else:
            y = np.array(levels)
            wave = ((np.exp(k * (y - H)) + np.exp(-k * (y + H))) /
                    (1 + np.exp(-2 * k * H) + 4 * k * H * np.exp(-2 * k * H) /
                     (1 - np.exp(-2 * k * H))))[:, None] * swing
        result += share * np.cos(k * x)[None, :, None] * wave[:, None, :]
    return x, result


def kedge_run(arg, cells, scheme, load):
    """(smallest pressure with x, y, t; probes: (smallest, largest)) over the largest load."""
    folder = arg.output / f"{scheme}_{cells}_{load:g}"
    line = [arg.kedge, str(ROOT / "prm" / "footing_harmonic.prm"), "-o", str(folder)]
    for setting in (f"Constants/n = {cells}", "Constants/points = 2", f"Time/Scheme = {scheme}",
                    f"Tractions/footing/Traction = 0; -{load / 2}*(1 - cos(100*t))",
                    "Output/Points interval = 0.004", "Pore fluid/Bulk modulus = 2.2e11"):
        line += ["-s", setting]
    done = subprocess.run(line, check=False, stdout=subprocess.DEVNULL,
                          env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
    if done.returncode not in (0, 2):  # 2: stopped with a cause, as the undamped scheme does
        sys.exit(f"kedge ended with exit code {done.returncode}")
    worst = (0., 0., 0., 0.)
    for time, name in vtu_reader.read_pvd(folder / "points.pvd"):
        points = vtu_reader.read_points(name)
        pressures = points.values("pore_pressure") / load
        k = pressures.argmin()
        if pressures[k] < worst[0]:
            worst = (pressures[k], *points.position[k][:2], time)
    with open(folder / "probes.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    probes = {}
    for name in PROBES:
        values = [float(row[f"{name}.pore_pressure"]) / load for row in rows]
        probes[name] = (min(values), max(values))
    return worst, probes


def line_of(name, worst, probes):
    """A row of the table."""
    place = f"{worst[0]:.3f} at ({worst[1]:.2f}, {worst[2]:.2f}), {worst[3]:.3f} s"
    return "| " + " | ".join([name, place] + [f"{a:.3f}, {b:.3f}" for a, b in probes.values()]) + " |"


def main():
    """Writes the table."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kedge", default=str(ROOT / "build" / "kedge"))
    parser.add_argument("--output", type=Path, default=ROOT / "output" / "footing")
    parser.add_argument("--cells", type=int, nargs="*", default=[15, 30])
    parser.add_argument("--full", action="store_true")
    arg = parser.parse_args()
    print("| run | smallest p/w | A | B | C |\n|---|---|---|---|---|")
    times = np.arange(0, T + 1e-9, 0.004)
    for inertia in (False, True):
        for cells in arg.cells:
            # the first rows of kedge's points, then the probes
            rows = [H - (i + 0.5) * H / (2 * cells) for i in range(2)]
            x, p = reference(times, rows + [H - z for z in PROBES.values()], inertia)
            i, j, k = np.unravel_index(p[:2].argmin(), p[:2].shape)
            probes = {name: (p[2 + n, 0].min(), p[2 + n, 0].max()) for n, name in enumerate(PROBES)}
            print(line_of(f"exact, {'inertia' if inertia else 'no inertia'}, rows of n = {cells}",
                          (p[i, j, k], x[j], rows[i], times[k]), probes), flush=True)
    for scheme in SCHEMES:
        for cells in arg.cells:
            for load in (6e3, 6e6) if arg.full else (6e3,):
                name = f"{scheme}, n = {cells}, w = {load:g} Pa"
                print(line_of(name, *kedge_run(arg, cells, scheme, load)), flush=True)


if __name__ == "__main__":
    main()
