"""Rigid bodies: where they are at chosen times, alone or with the material that they touch."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgba
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path as Outline

import style
from panels import choose, draw_triad, layout, projection
from vtu_reader import read_pvd, read_surfaces

GREY = "#8a8f98"
LARGEST = 0.5 # of a tool that is larger than the soil so much is shown on each side, in soil sizes


def rings(lines):
    """The closed lines that the facets of a plane body make, as lists of corners."""
    following = {tuple(begin): tuple(end) for begin, end in lines}
    found = []
    while following:
        start, place = next(iter(following.items()))
        del following[start]
        ring = [start]
        while place != start and place in following:
            ring.append(place)
            place = following.pop(place)
        found.append(ring)
    return found


def outline_of(lines):
    """What a plane body covers."""
    corners, codes = [], []
    for ring in rings(lines):
        corners += [*ring, ring[0]]
        codes += [Outline.MOVETO] + [Outline.LINETO] * (len(ring) - 1) + [Outline.CLOSEPOLY]
    return Outline(corners, codes)


class RigidShapes:
    """The surfaces of a run's rigid bodies by time; empty if it has written none."""

    def __init__(self, run, view):
        file = run.folder / "rigid_bodies.pvd"
        self.series = read_pvd(file) if file.exists() else []
        self.in_space = run.dimension() == 3
        self.view = view

    def at(self, time):
        """Corners of the facets on paper (and depth), and the numbers of their bodies."""
        times = np.array([entry for entry, _ in self.series])
        corners, fields = read_surfaces(self.series[int(np.argmin(np.abs(times - time)))][1])
        if self.in_space:
            corners = corners @ self.view
        return corners, fields["body"][:, 0].astype(int)

    def limits(self, times, low=None, high=None):
        """The part of the plane with all bodies at these times; around @p low and @p high no more
        than a part of what they span."""
        if not self.series:
            return low, high
        places = np.concatenate([self.at(time)[0].reshape(-1, 3)[:, :2] for time in times])
        least, most = places.min(axis=0), places.max(axis=0)
        if low is None:
            return least, most
        room = LARGEST * max(high - low)
        return (np.minimum(low, np.maximum(least, low - room)),
                np.maximum(high, np.minimum(most, high + room)))

    def draw(self, panel, time, colour_of=lambda body: GREY, opaque=True, zorder=3):
        """The bodies as they are at a time, above the material, or below with a small zorder."""
        if not self.series:
            return
        corners, bodies = self.at(time)
        for body in np.unique(bodies):
            mine = corners[bodies == body]
            if self.in_space:
                draw_triangles(panel, mine, colour_of(body), opaque)
            else:
                panel.add_patch(PathPatch(outline_of(mine[:, :, :2]), facecolor=colour_of(body),
                                          edgecolor="#30343a", linewidth=0.7, zorder=zorder))


def draw_triangles(panel, corners, colour, opaque):
    """A surface in space, lit from the viewer, the nearest facets last."""
    sides = corners[:, 1:] - corners[:, :1]
    normal = np.cross(sides[:, 0], sides[:, 1])
    facing = normal[:, 2] / np.maximum(np.linalg.norm(normal, axis=1), 1e-300)
    order = np.argsort(corners[:, :, 2].mean(axis=1))
    order = order[facing[order] > 0]
    colours = np.tile(to_rgba(colour), (len(order), 1))
    colours[:, :3] *= (0.55 + 0.45 * facing[order])[:, None]
    colours[:, 3] = 1.0 if opaque else 0.55
    panel.add_collection(PolyCollection(corners[order, :, :2], facecolors=colours,
                                        edgecolors=colours if opaque else "none", linewidths=0.3,
                                        rasterized=len(order) > 2000, zorder=3))


def names_of(run):
    """The rigid bodies in the order of the scene, by the names of their columns."""
    return [column[len("position_"):-len("_x")] for column in run.history
            if column.startswith("position_") and column.endswith("_x")]


def path_of(run, name, view=None):
    """Where a body's centre has been, on paper."""
    place = np.stack([run.history.get(f"position_{name}_{axis}", 0 * run.history["time"])
                      for axis in "xyz"], axis=1)
    return (place if view is None else place @ view)[:, :2]


def draw_rigid(run, options):
    """Panels of a run of rigid bodies alone at the chosen times, with the paths of their centres;
    None if there is nothing to see."""
    names = names_of(run)
    in_space = run.dimension() == 3
    view = projection(options.view) if in_space else None
    shapes = RigidShapes(run, view)
    paths = [path_of(run, name, view) for name in names]
    if not shapes.series and not any(np.ptp(path) > 1e-9 for path in paths):
        return None # points that stay
    time = run.history["time"]
    entries = choose(shapes.series or [(t, None) for t in time], options.times, options.snapshots)
    times = [entry for entry, _ in entries]
    everything = np.concatenate(paths)
    least, most = shapes.limits(times, None, None)
    low, high = everything.min(axis=0), everything.max(axis=0)
    if least is not None:
        low, high = np.minimum(low, least), np.maximum(high, most)
    margin = 0.06 * max(*(high - low), 1e-9)
    low, high = low - [margin, (3 if in_space else 1) * margin], high + margin
    rows, columns, size = layout(*(high - low), len(times))
    figure, axes = plt.subplots(rows, columns, figsize=size, squeeze=False)
    for panel in axes.flat[len(times):]:
        panel.set_visible(False)

    def colour_of(body):
        return style.colour(int(body), len(names))
    for panel, now in zip(axes.flat, times):
        shapes.draw(panel, now, colour_of)
        for number, path in enumerate(paths):
            until = time <= now * (1 + 1e-9)
            panel.add_collection(LineCollection([path[until]], colors=[colour_of(number)],
                                                linewidths=1.0, zorder=4))
            panel.plot(*path[until][-1], "o", markersize=4, color=colour_of(number), zorder=5)
        panel.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal",
                  title=f"t = {style.time_text(now, options.time_unit)}")
        panel.grid(False)
        if in_space:
            panel.set_axis_off()
            draw_triad(panel, view, low, high)
        else:
            panel.set(xlabel="x [m]", ylabel="y [m]")
            panel.label_outer()
    handles = [Patch(color=colour_of(number), label=name) for number, name in enumerate(names)]
    figure.get_layout_engine().set(rect=(0, 0, 0.88, 1))
    figure.legend(handles=handles, loc="upper right", fontsize=8)
    figure.suptitle(run.title())
    return figure
