"""Values of material points as a smooth field: the mean at the nodes of the grid, weighted
by volume and by the nodes' hat functions, and between the nodes linear in each direction."""
import itertools

import numpy as np


class NodalAverage:
    """The field of one body at one time. `at` gives its value anywhere."""

    def __init__(self, position, values, weights, origin, cell):
        self.dim = len(cell)
        self.cell = np.asarray(cell, dtype=float)
        place = (position[:, :self.dim] - origin) / self.cell
        self.low = np.floor(place.min(axis=0)).astype(int) - 1
        shape = np.ceil(place.max(axis=0)).astype(int) + 2 - self.low
        self.origin = np.asarray(origin) + self.low * self.cell
        total, weight = np.zeros(shape), np.zeros(shape)
        for node, share in self.corners(position):
            np.add.at(weight, node, share * weights)
            np.add.at(total, node, share * weights * values)
        known = weight > 1e-6 * weight.max()
        field = np.divide(total, weight, out=np.zeros(shape), where=known)
        self.field = spread(field, known)

    def corners(self, position):
        """For each corner of the cells in which the places lie: its node, and its hat function."""
        place = (position[:, :self.dim] - self.origin) / self.cell
        base = np.floor(place).astype(int)
        inside = place - base
        for corner in itertools.product((0, 1), repeat=self.dim):
            share = np.prod([inside[:, d] if corner[d] else 1 - inside[:, d]
                             for d in range(self.dim)], axis=0)
            yield tuple(base[:, d] + corner[d] for d in range(self.dim)), share

    def at(self, position):
        """The value at each place; places outside take those of the nearest cell."""
        upper = self.origin + (np.array(self.field.shape) - 1.000001) * self.cell
        inside = np.clip(position[:, :self.dim], self.origin, upper)
        return sum(share * self.field[node] for node, share in self.corners(inside))


class FilledPart(NodalAverage):
    """How much of the plane a body fills, 1 within and 0 without, smeared over its outline."""

    def __init__(self, position, volumes):
        width = 1.5 * np.sqrt(np.median(volumes)) # of the points' spacings: no gap shows
        super().__init__(position, volumes, np.ones(len(volumes)), np.zeros(2), np.full(2, width))
        self.field = np.zeros(self.field.shape)
        for node, share in self.corners(position):
            np.add.at(self.field, node, share * volumes / width**2)


def spread(field, known):
    """Gives nodes that no point reaches the mean of their neighbours, from the body outwards."""
    field, known = field.copy(), known.copy()
    while not known.all():
        total, count = np.zeros(field.shape), np.zeros(field.shape)
        for axis, step in itertools.product(range(field.ndim), (-1, 1)):
            source, target = [slice(None)] * field.ndim, [slice(None)] * field.ndim
            source[axis] = slice(1, None) if step > 0 else slice(None, -1)
            target[axis] = slice(None, -1) if step > 0 else slice(1, None)
            total[tuple(target)] += np.where(known, field, 0)[tuple(source)]
            count[tuple(target)] += known[tuple(source)]
        new = ~known & (count > 0)
        field[new] = total[new] / count[new]
        known |= new
    return field


def smoothed(position, values, bodies, weights, grid):
    """A NodalAverage for each body that is there: a dictionary from its number."""
    origin, cell = grid
    return {int(body): NodalAverage(position[bodies == body], values[bodies == body],
                                    weights[bodies == body], origin, cell)
            for body in np.unique(bodies)}
