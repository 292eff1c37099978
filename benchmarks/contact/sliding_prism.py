#!/usr/bin/env python3
"""Reference of the prism that slides down a soft incline (prm/prism_soft.prm, prism_sliding.prm).

    python3 benchmarks/contact/sliding_prism.py [--cells 8 16 32] [--rounding 0.5] [--stiff 1]

An independent computation that shares neither code nor method with kedge: finite elements that fit both bodies
(bilinear, four Gauss points, referred to the start, lumped masses), Hencky's law in plane strain, explicit
central differences in time, and contact by a penalty: nodes of either surface that lie inside the other body are
pushed towards the closest place of its boundary, sole and faces of the prism, top of the ground, each side for half
of the load. Prints for each number of elements per metre the way of the prism's middle at t = 1 s, the drift of the
total energy, the deepest sinking of the sole. With 32 elements about two minutes, with 64 eight times as many.

Units: SI. Arrays: fields of nodes have shape (ny + 1, nx + 1, 2), of Gauss points (4, ny, nx, ..).
"""
import argparse
import math
import time

import numpy as np

ANGLE, GRAVITY, DENSITY, POISSON, DURATION = math.pi / 12, 10.0, 2000.0, 0.35, 1.0
CORNERS = ((0, 0), (0, 1), (1, 0), (1, 1))  # of an element, in y and x
GAUSS = [(0.5 - sign_y / math.sqrt(12), 0.5 - sign_x / math.sqrt(12))
         for sign_y in (1, -1) for sign_x in (1, -1)]


class Body:
    """A rectangle of bilinear elements with given places of the nodes."""

    def __init__(self, start, young, acceleration):
        self.start = start
        self.ny, self.nx = (n - 1 for n in start.shape[:2])
        self.u = np.zeros_like(start)
        self.v = np.zeros_like(start)
        self.lame = young * POISSON / (1 + POISSON) / (1 - 2 * POISSON)
        self.shear = young / 2 / (1 + POISSON)
        self.modulus = self.lame + 2 * self.shear  # of one-dimensional compression
        self.mass = np.zeros((self.ny + 1, self.nx + 1, 1))
        self.gauss = [self.slopes_at(eta, xi) for eta, xi in GAUSS]
        for (eta, xi), (_, weight) in zip(GAUSS, self.gauss):
            for j, i in CORNERS:
                part = (eta if j else 1 - eta) * (xi if i else 1 - xi)
                self.mass[j:j + self.ny, i:i + self.nx, 0] += DENSITY * weight * part
        self.weight = self.mass * np.asarray(acceleration)
        self.energy = 0.0

    def at_corner(self, field, corner):
        """The values of a field of nodes at this corner of all elements."""
        return field[corner[0]:corner[0] + self.ny, corner[1]:corner[1] + self.nx]

    def slopes_at(self, eta, xi):
        """Of all elements: slopes of the corners' functions at a Gauss point [1/m], its area [m^2]."""
        reference = {(j, i): ((1 if i else -1) * (eta if j else 1 - eta),
                              (1 if j else -1) * (xi if i else 1 - xi)) for j, i in CORNERS}
        jacobian = np.zeros((self.ny, self.nx, 2, 2))  # d x_a / d (xi, eta)_b
        for corner, (sx, sy) in reference.items():
            jacobian[..., 0] += sx * self.at_corner(self.start, corner)
            jacobian[..., 1] += sy * self.at_corner(self.start, corner)
        inverse = np.linalg.inv(jacobian)
        slopes = {corner: (sx * inverse[..., 0, 0] + sy * inverse[..., 1, 0],
                           sx * inverse[..., 0, 1] + sy * inverse[..., 1, 1])
                  for corner, (sx, sy) in reference.items()}
        return slopes, np.linalg.det(jacobian) / 4

    def forces(self):
        """Internal forces on the nodes [N/m]; sets the strain energy [J/m]."""
        result = np.zeros_like(self.u)
        self.energy = 0.0
        for slopes, weight in self.gauss:
            xx, xy, yx, yy = 1.0, 0.0, 0.0, 1.0  # F = I + grad u
            for corner, (sx, sy) in slopes.items():
                ux, uy = np.moveaxis(self.at_corner(self.u, corner), -1, 0)
                xx, xy, yx, yy = xx + sx * ux, xy + sy * ux, yx + sx * uy, yy + sy * uy
            cxx, cxy, cyy = xx * xx + yx * yx, xx * xy + yx * yy, xy * xy + yy * yy
            mean, half = (cxx + cyy) / 2, (cxx - cyy) / 2
            radius = np.sqrt(half * half + cxy * cxy) + 1e-12
            first, second = mean + radius, mean - radius
            e1, e2 = np.log(first) / 2, np.log(second) / 2
            volume = self.lame * (e1 + e2)
            self.energy += np.sum(
                weight * (volume * (e1 + e2) / 2 + self.shear * (e1 * e1 + e2 * e2)))
            s1, s2 = (volume + 2 * self.shear * e1) / first, (volume + 2 * self.shear * e2) / second
            slope = (s1 - s2) / (2 * radius)
            level = s1 - slope * first
            sxx, sxy, syy = level + slope * cxx, slope * cxy, level + slope * cyy
            pxx, pxy = xx * sxx + xy * sxy, xx * sxy + xy * syy
            pyx, pyy = yx * sxx + yy * sxy, yx * sxy + yy * syy
            for corner, (sx, sy) in slopes.items():
                part = self.at_corner(result, corner)
                part[..., 0] += weight * (pxx * sx + pxy * sy)
                part[..., 1] += weight * (pyx * sx + pyy * sy)
        return result

    def kinetic(self, v):
        """Kinetic energy of nodal velocities [J/m]."""
        return 0.5 * float(np.sum(self.mass * v * v))


class Side:
    """A polyline of a body's nodes with the body on its left, and the lengths that nodes stand for."""

    def __init__(self, body, rows, columns):
        self.body, self.rows, self.columns = body, np.asarray(rows), np.asarray(columns)
        pieces = np.linalg.norm(np.diff(self.places(), axis=0), axis=1)
        self.length = (np.append(pieces, 0) + np.insert(pieces, 0, 0)) / 2

    def places(self):
        """Where its nodes are [m]."""
        return self.body.start[self.rows, self.columns] + self.body.u[self.rows, self.columns]


def press(sampled, other, stiffness, deepest, forces_sampled, forces_other):
    """Adds the forces on nodes of one side that lie inside the other; the energy stored [J/m]."""
    x, y = sampled.places(), other.places()
    lower, upper = y.min(axis=0) - deepest, y.max(axis=0) + deepest
    near = np.flatnonzero(np.all((x > lower) & (x < upper), axis=1))
    if len(near) == 0:
        return 0.0
    x = x[near]
    along = y[1:] - y[:-1]
    square = np.sum(along * along, axis=1)
    normals = np.stack([along[:, 1], -along[:, 0]], axis=1) / np.sqrt(square)[:, None]
    at_nodes = np.zeros_like(y)
    at_nodes[:-1] += normals
    at_nodes[1:] += normals
    offset = x[:, None] - y[None, :-1]
    part = np.clip(np.einsum("psd,sd->ps", offset, along) / square, 0, 1)
    offset -= part[..., None] * along
    distance = np.einsum("psd,psd->ps", offset, offset)
    best = np.argmin(distance, axis=1)
    rows = np.arange(len(near))
    part, offset, distance = part[rows, best], offset[rows, best], np.sqrt(distance[rows, best])
    outward = np.where((part == 0)[:, None], at_nodes[best],
                       np.where((part == 1)[:, None], at_nodes[best + 1], normals[best]))
    inside = (np.sum(offset * outward, axis=1) < 0) & (distance < deepest)
    # what lies beyond the ends of the line has no partner
    inside &= ~(((best == 0) & (part == 0)) | ((best == len(y) - 2) & (part == 1)))
    near, best, part, offset = near[inside], best[inside], part[inside], offset[inside]
    length = sampled.length[near]
    push = -stiffness * length[:, None] * offset
    np.add.at(forces_sampled, (sampled.rows[near], sampled.columns[near]), push)
    for end, weight in ((0, 1 - part), (1, part)):
        np.add.at(forces_other, (other.rows[best + end], other.columns[best + end]),
                  -weight[:, None] * push)
    return 0.5 * stiffness * float(np.sum(length * np.sum(offset * offset, axis=1)))


def levels(length, h, coarsest):
    """Places from 0 on, h apart at first, then up to so many h."""
    steps = [h]
    while sum(steps) < length:
        steps.append(min(steps[-1] * 1.05, coarsest * h))
    return np.insert(np.cumsum(steps), 0, 0) * length / sum(steps)


def mesh(x, y):
    """Nodes at x and y."""
    return np.stack(np.meshgrid(x, y), axis=-1)


def bodies(cells, stiff, rounding, coarsest):
    """Prism and ground. Towards its ends the sole rises by up to half of the rounding, to a slope of one."""
    h = 1 / cells
    gravity = (GRAVITY * math.sin(ANGLE), -GRAVITY * math.cos(ANGLE))
    prism = mesh(np.linspace(0.75, 3.75, 3 * cells + 1), 1.5 + levels(1.5, h, coarsest))
    if rounding > 0:
        from_end = 1.5 - np.abs(prism[..., 0] - 2.25)
        rise = np.maximum(rounding - from_end, 0) ** 2 / (2 * rounding)
        prism[..., 1] += rise * (3 - prism[..., 1]) / 1.5
    ground = mesh(np.linspace(0, 6, 6 * cells + 1), 1.5 - levels(1.5, h, coarsest)[::-1])
    return Body(prism, 5e5 * stiff, gravity), Body(ground, 1e5 * stiff, (0, 0))


def run(cells, courant, penalty, stiff, rounding, coarsest):
    """The way at the end [m], the energy's drift over the work of gravity, the deepest sinking [m]."""
    h = 1 / cells
    prism, ground = bodies(cells, stiff, rounding, coarsest)
    up = np.arange(prism.ny // 2, 0, -1)
    sole = Side(prism, np.concatenate([up, np.zeros(prism.nx + 1, int), up[::-1]]),
                np.concatenate([np.zeros(len(up), int), np.arange(prism.nx + 1),
                                np.full(len(up), prism.nx)]))
    top = Side(ground, np.full(ground.nx + 1, ground.ny), np.arange(ground.nx, -1, -1))
    stiffness = penalty / h * 2 / (1 / prism.modulus + 1 / ground.modulus)
    n_steps = math.ceil(DURATION / (courant * h / math.sqrt(prism.modulus / DENSITY)))
    dt = DURATION / n_steps

    def forces():
        """Forces on both bodies' nodes, and the energy stored in the contact."""
        on_prism, on_ground = prism.weight - prism.forces(), ground.weight - ground.forces()
        stored = press(sole, top, stiffness / 2, 0.3, on_prism, on_ground)
        stored += press(top, sole, stiffness / 2, 0.3, on_ground, on_prism)
        on_ground[0] = 0
        on_ground[:, [0, -1], 0] = 0
        return (on_prism, on_ground), stored

    drift = deepest = 0.0
    now, stored = forces()
    for _ in range(n_steps):
        for body, force in zip((prism, ground), now):
            body.v += dt / 2 * force / body.mass
            body.u += dt * body.v
        now, stored = forces()
        energy = stored
        for body, force in zip((prism, ground), now):
            body.v += dt / 2 * force / body.mass
            energy += body.kinetic(body.v) + body.energy - float(np.sum(body.weight * body.u))
        drift = max(drift, abs(energy))
        deepest = max(deepest, -float(prism.u[0, :, 1].min()))
        if not math.isfinite(energy):
            break
    middle = np.argmin(np.abs(prism.start[:, prism.nx // 2, 1] - 2.25))
    return prism.u[middle, prism.nx // 2, 0], drift / float(np.sum(prism.weight * prism.u)), deepest


def main():
    """Prints a row for each mesh."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=int, nargs="+", default=[8, 16, 32])
    parser.add_argument("--courant", type=float, default=0.25)
    parser.add_argument("--penalty", type=float, default=4)
    parser.add_argument("--stiff", type=float, default=1)
    parser.add_argument("--rounding", type=float, default=0, help="of the sole's ends [m]")
    parser.add_argument("--coarsest", type=float, default=4, help="height of an element over the finest")
    arg = parser.parse_args()
    print("elements/m   way [m]   drift of energy   deepest sole [m]   time [s]")
    for cells in arg.cells:
        begin = time.time()
        way, drift, deepest = run(cells, arg.courant, arg.penalty, arg.stiff, arg.rounding,
                                    arg.coarsest)
        print(f"{cells:10d} {way:9.5f} {drift:17.2e} {deepest:18.4f} {time.time() - begin:10.0f}",
              flush=True)


if __name__ == "__main__":
    main()
