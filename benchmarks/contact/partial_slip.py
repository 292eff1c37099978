#!/usr/bin/env python3
"""How far a cylinder moves under a tangential force in partial slip, and within what width it sticks.

    /usr/bin/python3 benchmarks/contact/partial_slip.py [--kedge PROGRAM] [--output DIR] [--cells 24 32 48] [--steps 4]
        [--force 0.9] [--half-width 0.18] [--within 0.03] [--fine 0.005]

Runs prm/cattaneo_mindlin.prm and compares it at each step of the tangential load with finite elements of
the same two bodies, an independent computation: small strains, quadrilaterals with incompatible modes graded
to the size --fine in the contact, eliminated row by row down to the compliance of the nodes that may
touch (the base and the pressed face are rigid, their displacements unknowns); there the nodal forces obey Signorini's and
Coulomb's laws, found by active sets in twenty increments.

In two dimensions the displacement of a half plane under a force has no value of its own: it grows with the logarithm of
the distance to where it is held. That of the finite bodies has. What slip adds to it is u(q) - 2 u(q/2), q = Q/(mu P), for
contact without slip moves in proportion to the force; on a half plane (Cattaneo 1938, Mindlin 1949) that is

    D(q) - 2 D(q/2),   D(q) = (mu a^2/(4 R)) [q + (1 - q) ln(1 - q)],

and on blocks 1 m high 4 to 8 % less with a = 0.18 m: they are no half planes.

The exit code is 1 if a displacement is off by more than --within, what slip adds at the largest force likewise, or the half
width that sticks there by more than the spacing of the surface's points, h/5, and the finite elements' size.
"""
import argparse
import csv
import math
import os
import subprocess
import sys
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # more of them stall each other on a busy machine
import numpy as np  # noqa: E402

ROOT = Path(__file__).resolve().parent.parent.parent
FRICTION, RADIUS, YOUNG, POISSON = 0.5, 10.0, 1e7, 0.3  # of the scene
REACH = 1.0  # half the width of the bodies, and their height [m]
GAUSS = 1 / math.sqrt(3)


def graded(fine, even):
    """Places from 0 to REACH: steps of `fine` up to `even`, each then 1.12 times the last."""
    places = [0.0]
    while places[-1] < REACH:
        step = fine if places[-1] < even - 1e-12 else 1.12 * (places[-1] - places[-2])
        places.append(places[-1] + step)
    first = round(even / fine)
    places = np.array(places)
    places[first:] = places[first] + (places[first:] - places[first]) * (
        (REACH - places[first]) / (places[-1] - places[first]))
    return places


def slopes(xi, eta):
    """Of the four corners' functions in the reference square."""
    return np.array([[-(1 - eta), 1 - eta, 1 + eta, -(1 + eta)],
                     [-(1 - xi), -(1 + xi), 1 + xi, 1 - xi]]) / 4


def strain_matrix(gradients):
    """From displacements (x, y of each function) to strains xx, yy, 2 xy."""
    n = gradients.shape[2]
    matrix = np.zeros((len(gradients), 3, 2 * n))
    matrix[:, 0, 0::2] = matrix[:, 2, 1::2] = gradients[:, 0]
    matrix[:, 1, 1::2] = matrix[:, 2, 0::2] = gradients[:, 1]
    return matrix


def element_stiffness(corners):
    """Of quadrilaterals with the incompatible modes of Taylor, Beresford and Wilson (1976), plane strain."""
    shear = YOUNG / 2 / (1 + POISSON)
    lame = YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON)
    law = np.array([[lame + 2 * shear, lame, 0], [lame, lame + 2 * shear, 0], [0, 0, shear]])
    middle = np.einsum("ia,eaj->eij", slopes(0, 0), corners)
    inverse, size = np.linalg.inv(middle), np.linalg.det(middle)
    sums = {name: 0.0 for name in ("uu", "ua", "aa")}
    for xi in (-GAUSS, GAUSS):
        for eta in (-GAUSS, GAUSS):
            jacobian = np.einsum("ia,eaj->eij", slopes(xi, eta), corners)
            weight = np.linalg.det(jacobian)
            of_u = strain_matrix(np.einsum("eji,ia->eja", np.linalg.inv(jacobian), slopes(xi, eta)))
            modes = np.array([[-2 * xi, 0], [0, -2 * eta]])
            of_a = strain_matrix(np.einsum("eij,jm->eim", inverse, modes)
                                 * (size / weight)[:, None, None])
            for name, left, right in (("uu", of_u, of_u), ("ua", of_u, of_a), ("aa", of_a, of_a)):
                sums[name] = sums[name] + np.einsum("eki,kl,elj,e->eij", left, law, right, weight)
    return sums["uu"] - sums["ua"] @ np.linalg.solve(sums["aa"], sums["ua"].transpose(0, 2, 1))


def compliance(fine, even, curved):
    """Places of the nodes that may touch, and their displacements (all x, then all y, into the body) by forces."""
    half, depth = graded(fine, even), graded(fine, 3 * fine)
    x = np.concatenate([-half[:0:-1], half])
    n = len(x)
    face = x**2 / (2 * RADIUS) if curved else 0 * x
    y = face + depth[:, None] * (1 - face)
    place = np.stack([np.broadcast_to(x, y.shape), y], -1)
    below = None  # stiffness that the rows further from the contact give to a row
    for j in range(len(depth) - 2, -1, -1):  # the last row is held
        corners = np.stack([place[j, :-1], place[j, 1:], place[j + 1, 1:], place[j + 1, :-1]], 1)
        stiffness = np.zeros((4 * n, 4 * n))  # of rows j and j + 1
        for i, element in enumerate(element_stiffness(corners)):
            nodes = np.array([i, i + 1, n + i + 1, n + i])
            dofs = np.stack([2 * nodes, 2 * nodes + 1], -1).ravel()
            stiffness[np.ix_(dofs, dofs)] += element
        near, far = slice(0, 2 * n), slice(2 * n, 4 * n)
        if below is None:
            below = stiffness[near, near]
        else:
            coupling = stiffness[near, far]
            below = stiffness[near, near] - coupling @ np.linalg.solve(
                stiffness[far, far] + below, coupling.T)
    touching = np.where(np.abs(x) <= even + 1e-9)[0]
    dofs = np.concatenate([2 * touching, 2 * touching + 1])
    forces = np.zeros((2 * n, len(dofs)))
    forces[dofs, np.arange(len(dofs))] = 1
    return x[touching], np.linalg.solve(below, forces)[dofs]


class Blocks:
    """Both bodies, by the nodal forces between them: t and n on the upper one, along and away from the lower."""

    def __init__(self, fine, half_width):
        even = fine * round(1.45 * half_width / fine)
        self.x, lower = compliance(fine, even, False)
        _, upper = compliance(fine, even, True)
        m = len(self.x)
        self.fine = fine
        self.half_width = half_width
        self.along = lower[:m, :m] + upper[:m, :m]  # of t
        self.away = lower[m:, m:] + upper[m:, m:]  # of n
        self.along_by_n = upper[:m, m:] - lower[:m, m:]
        self.away_by_t = upper[m:, :m] - lower[m:, :m]
        self.load = math.pi * half_width**2 * YOUNG / (8 * RADIUS * (1 - POISSON**2))

    def pressed(self, opening):
        """The normal forces, if tangential ones open the gap by so much."""
        start = self.x**2 / (2 * RADIUS) + opening
        touching = np.abs(self.x) < self.half_width
        while True:
            k = np.count_nonzero(touching)
            matrix = np.ones((k + 1, k + 1))
            matrix[:k, :k], matrix[:k, k], matrix[k, k] = self.away[np.ix_(touching, touching)], -1, 0
            solution = np.linalg.solve(matrix, np.append(-start[touching], self.load))
            n = np.zeros_like(self.x)
            n[touching] = solution[:k]
            found = np.where(touching, n > 0, start + self.away @ n < solution[k])
            if np.array_equal(found, touching):
                return n
            touching = found

    def pushed(self, n, force, start):
        """Tangential forces, slips since the start, displacement of the upper body, nodes that stick."""
        slides = np.zeros(len(self.x), int)  # -1, 1: to which side
        while True:
            sticks = (slides == 0) & (n > 0)
            k = np.count_nonzero(sticks)
            t = np.where(n > 0, -slides * FRICTION * n, 0.0)
            matrix = np.ones((k + 1, k + 1))
            matrix[:k, :k], matrix[k, k] = self.along[np.ix_(sticks, sticks)], 0
            rest = start - self.along_by_n @ n - self.along @ t
            solution = np.linalg.solve(matrix, np.append(rest[sticks], -force - t.sum()))
            t[sticks] = solution[:k]
            slip = solution[k] + self.along @ t + self.along_by_n @ n
            found = slides.copy()
            over = sticks & (np.abs(t) > FRICTION * n * (1 + 1e-12))
            found[over] = -np.sign(t[over]).astype(int)
            found[(slides != 0) & ((slip - start) * slides < -1e-16)] = 0
            if np.array_equal(found, slides):
                return t, slip, solution[k], sticks
            slides = found

    def history(self, forces):
        """{q: (displacement, half width that sticks)} for growing tangential forces q mu P."""
        t = np.zeros_like(self.x)
        slip = self.along_by_n @ self.pressed(0 * t)
        result = {0.0: (0.0, self.half_width)}
        for q in sorted({*np.linspace(0, max(forces), 21)[1:], *forces}):
            for _ in range(4):  # what the bodies' unlike height couples is small
                n = self.pressed(self.away_by_t @ t)
                t, found, way, sticks = self.pushed(n, q * FRICTION * self.load, slip)
            slip = found
            result[q] = (way, self.fine * np.count_nonzero(sticks) / 2)
        return result


def half_plane(q, half_width):
    """What slip adds there [m]."""
    def beyond(part):
        return part + (1 - part) * math.log(1 - part)
    return FRICTION * half_width**2 / (4 * RADIUS) * (beyond(q) - 2 * beyond(q / 2))


def measured(arg, cells, steps):
    """{q: displacement of the top}, and the half width that sticks at the end, of a run."""
    folder = arg.output / f"partial_slip_{cells}_{steps}"
    line = [arg.kedge, str(ROOT / "prm" / "cattaneo_mindlin.prm"), "-o", str(folder)]
    for setting in (f"Constants/n = {cells}", f"Constants/q = {arg.force}",
                    f"Constants/a = {arg.half_width}", f"Time/Step = {1 / steps}",
                    "Output/Points interval = 0"):
        line += ["-s", setting]
    process = subprocess.run(line, stdout=subprocess.DEVNULL, check=False,
                             env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
    if process.returncode not in (0, 2):  # 2: a check of the scene failed, on a coarse grid
        sys.exit(f"{' '.join(line)} ended with {process.returncode}")
    with open(folder / "probes.csv", encoding="utf-8") as file:
        ways = {float(row["time"]): float(row["top.displacement_x"]) for row in csv.DictReader(file)}
    with open(folder / "history.csv", encoding="utf-8") as file:
        sticks = float(list(csv.DictReader(file))[-1]["contact_stick_area_line"]) / 2
    start = ways[min(ways, key=lambda t: abs(t - 1))]
    return {round((t - 1) * steps): way - start for t, way in ways.items() if t > 1 + 1e-9}, sticks


def main():
    """Prints a row for each grid, number of steps and force."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kedge", default=str(ROOT / "build" / "kedge"))
    parser.add_argument("--output", type=Path, default=ROOT / "output" / "contact")
    parser.add_argument("--cells", type=int, nargs="+", default=[24, 32, 48])
    parser.add_argument("--steps", type=int, nargs="+", default=[4], help="even")
    parser.add_argument("--force", type=float, default=0.9, help="Q over mu P")
    parser.add_argument("--half-width", type=float, default=0.18, help="of the contact [m]")
    parser.add_argument("--fine", type=float, default=0.005, help="size of the finite elements [m]")
    parser.add_argument("--within", type=float, default=math.inf)
    arg = parser.parse_args()
    arg.output.mkdir(parents=True, exist_ok=True)
    blocks, bad = Blocks(arg.fine, arg.half_width), False
    for steps in arg.steps:
        forces = {k: arg.force * k / steps for k in range(steps + 1)}
        exact = blocks.history(list(forces.values()) + [q / 2 for q in forces.values()])
        for cells in arg.cells:
            ways, sticks = measured(arg, cells, steps)
            print(f"{cells} cells/m, {steps} steps")
            for k, way in ways.items():
                error = way / exact[forces[k]][0] - 1
                line = f"  q = {forces[k]:.4g}: u {way:.5e} m, {error:+.2%}"
                bad |= abs(error) > arg.within
                if k % 2 == 0:
                    added = exact[forces[k]][0] - 2 * exact[forces[k] / 2][0]
                    error = (way - 2 * ways[k // 2]) / added - 1
                    bad |= k == steps and abs(error) > arg.within
                    line += (f"; slip adds {added:.4e} m, {error:+.1%}"
                             f" (half plane {half_plane(forces[k], arg.half_width):.4e} m)")
                print(line)
            width = exact[arg.force][1]
            print(f"  sticks within {sticks:.4f} m, finite elements {width:.4f}, Cattaneo and Mindlin "
                  f"{arg.half_width * math.sqrt(1 - arg.force):.4f}", flush=True)
            bad |= abs(sticks - width) > 1 / (5 * cells) + arg.fine
    sys.exit(int(math.isfinite(arg.within) and bad))


if __name__ == "__main__":
    main()
