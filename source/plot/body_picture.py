"""The body at chosen times, coloured by a field."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path as Outline

import style
from panels import choose, draw_triad, layout, projection
from rigid_picture import RigidShapes
from smooth_field import FilledPart, smoothed
from vtu_reader import BadFile, read_points, read_pvd

# What is shown if the user does not say: the first of these that was written.
FAVOURITES = ["von_mises_stress", "pressure", "cauchy_stress_yy", "velocity", "displacement",
              "det_F"]
SIGNED = ("pressure", "cauchy_stress_", "kirchhoff_stress_", "total_stress_", "velocity_",
          "displacement_")
NOT_SMOOTHED = ("body", "id", "half_lengths", "mass", "volume")
CORNERS = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], dtype=float)
OVERLAP = 1.03 # of the drawn domains of points, so that no gap shows between them
RASTER = 500 # pixels of the smooth field along the longer side of a panel


def stretch(deformation_gradient):
    """U of F = R U, for an array of 2x2 tensors."""
    square = np.einsum("pki,pkj->pij", deformation_gradient, deformation_gradient)
    root_det = np.sqrt(np.maximum(np.linalg.det(square), 0))
    trace = np.sqrt(square[:, 0, 0] + square[:, 1, 1] + 2 * root_det)
    return (square + root_det[:, None, None] * np.eye(2)) / trace[:, None, None]


def spacing(points):
    """The edge of a square (cube) with the volume of a point; from its neighbours if need be."""
    extent = np.ptp(points.position, axis=0)
    dimension = 3 if extent[2] > 0 else 2
    if "volume" in points.fields:
        return np.maximum(points.values("volume"), 0) ** (1 / dimension)
    box = np.prod(np.maximum(extent[:dimension], 1e-300))
    return np.full(len(points.position), (box / len(points.position)) ** (1 / dimension))


def shapes(points, factor=OVERLAP):
    """The quadrilateral of each point of a plane body: its domain, deformed by F if F is known."""
    n_points = len(points.position)
    if "half_lengths" in points.fields:
        half = points.fields["half_lengths"][:, :2]
    else:
        half = np.repeat(0.5 * spacing(points)[:, None], 2, axis=1)
    edges = np.zeros((n_points, 2, 2))
    edges[:, [0, 1], [0, 1]] = half
    if "half_lengths" in points.fields and "deformation_gradient" in points.fields:
        gradient = points.fields["deformation_gradient"].reshape(-1, 3, 3)[:, :2, :2]
        # the half-lengths follow the diagonal of U: undo that, then apply F
        initial = half / np.einsum("pii->pi", stretch(gradient))
        edges = gradient * initial[:, None, :]
    return points.position[:, None, :2] + factor * np.einsum("pij,cj->pci", edges, CORNERS)


def draw_domains(axes, points, values, norm, cmap):
    """A plane body as the domains of its points."""
    collection = PolyCollection(shapes(points), array=values, norm=norm, cmap=cmap,
                                edgecolors="none", linewidths=0, antialiaseds=False)
    axes.add_collection(collection)
    collection.set_rasterized(True) # thousands of shapes would make an SVG huge
    return collection


def outline_of(points):
    """What a plane body covers: the domains of its points together."""
    corners = shapes(points)
    closed = np.concatenate([corners, corners[:, :1]], axis=1).reshape(-1, 2)
    codes = np.tile([Outline.MOVETO] + 3 * [Outline.LINETO] + [Outline.CLOSEPOLY], len(corners))
    return Outline(closed, codes)


def fill(axes, points, value_at, **how):
    """A plane body filled with a function of the place, cut out along its points."""
    outline = outline_of(points)
    box = outline.get_extents()
    step = max(box.width, box.height) / RASTER
    x = np.arange(box.x0 - 4 * step, box.x1 + 5 * step, step)
    y = np.arange(box.y0 - 4 * step, box.y1 + 5 * step, step)
    place = np.stack([axis.ravel() for axis in np.meshgrid(x, y)], axis=1)
    image = value_at(place).reshape(len(y), len(x))
    how.update(origin="lower", aspect="equal", zorder=2,
               extent=(x[0] - step / 2, x[-1] + step / 2, y[0] - step / 2, y[-1] + step / 2))
    if "deformation_gradient" in points.fields and "half_lengths" in points.fields:
        drawn = axes.imshow(image, interpolation="bilinear", **how)
        drawn.set_clip_path(PathPatch(outline, transform=axes.transData))
        return drawn
    # the points' domains are not known once they turn or stretch
    filled = FilledPart(points.position, np.maximum(spacing(points) ** 2, 1e-300))
    part = filled.at(place).reshape(image.shape)
    steepness = 0.5 * step / filled.cell[0] # of the part over a pixel
    return axes.imshow(image, alpha=np.clip(0.5 + (part - 0.5) / steepness, 0, 1), **how)


def draw_smooth(axes, points, fields, norm, cmap):
    """A plane body in the nodal average of each of its bodies."""
    drawn, bodies = None, body_numbers(points)
    for body, field in fields.items():
        drawn = fill(axes, points.subset(bodies == body), field.at, norm=norm, cmap=cmap)
    return drawn


def draw_solid(axes, points, values, norm, cmap, axes_of_view):
    """A body in space as squares, the nearest drawn last, darker the farther away."""
    place = points.position @ axes_of_view
    order = np.argsort(place[:, 2])
    half = 0.62 * spacing(points)[order]
    squares = place[order, None, :2] + half[:, None, None] * CORNERS
    depth = place[order, 2]
    shade = 0.72 + 0.28 * (depth - depth.min()) / max(np.ptp(depth), 1e-300)
    colour = plt.get_cmap(cmap)(norm(values[order]))
    colour[:, :3] *= shade[:, None]
    axes.add_collection(PolyCollection(squares, facecolors=colour, edgecolors="none",
                                       antialiaseds=False, rasterized=True))
    return plt.cm.ScalarMappable(norm=norm, cmap=cmap)


def colours(field, values, limits=None):
    """Limits and colour map; signed quantities are centred on zero."""
    if limits:
        signed = field.startswith(SIGNED) and limits[0] == -limits[1]
        return plt.Normalize(*limits), "RdBu_r" if signed else "viridis"
    everything = np.concatenate(values)
    everything = everything[np.isfinite(everything)]
    low, high = (np.percentile(everything, [0.5, 99.5]) if len(everything) else (0.0, 1.0))
    if field.startswith(SIGNED) and low < 0 < high:
        largest = max(-low, high)
        return plt.Normalize(-largest, largest), "RdBu_r"
    if high - low <= 1e-9 * max(abs(high), abs(low)):
        middle = 0.5 * (low + high)
        half = 0.5 * abs(middle) if middle else 1.0
        low, high = middle - half, middle + half
    return plt.Normalize(low, high), "viridis"


def field_of(points, field, path):
    """The wanted field, or the first favourite that is there."""
    if field is None:
        field = next((name for name in FAVOURITES if name in points.names()), None)
        if field is None and points.names():
            field = points.names()[0]
    if field not in points.names():
        raise BadFile(f"{path} has no field '{field}'. It has: {', '.join(points.names())}. "
                      "Output/Fields of the scene says which fields are written.")
    return field


def body_numbers(points):
    """To which body each point belongs; all to one if the file does not say."""
    if "body" in points.fields:
        return points.values("body").astype(int)
    return np.zeros(len(points.position), dtype=int)


class BodyPicture:
    """The body of a run in a field: panels for some times, or frames of a film."""

    def __init__(self, run, field, options):
        self.run, self.options = run, options
        self.series = read_pvd(run.points_file)
        self.in_space = run.dimension() == 3
        self.axes_of_view = projection(options.view)
        first = read_points(self.series[0][1]) if self.series else None
        self.field = field_of(first, field, self.series[0][1]) if self.series else None
        self.unit = style.field_unit(self.field or "")
        self.signed = False
        self.rigid = RigidShapes(run, self.axes_of_view if self.in_space else None)

    def load(self, entries):
        """The points of some times, and what they show: numbers, and smooth fields."""
        states = [read_points(path) for _, path in entries]
        values = [state.values(self.field).astype(float) for state in states]
        grid = self.run.scene.grid()
        fields = [None] * len(states)
        if not self.options.points and grid and not self.field.startswith(NOT_SMOOTHED):
            for index, (state, value) in enumerate(zip(states, values)):
                weights = state.values("volume") if "volume" in state.fields else np.ones(len(value))
                fields[index] = smoothed(state.position, value, body_numbers(state), weights, grid)
                numbers = body_numbers(state)
                values[index] = np.empty(len(value))
                for body, average in fields[index].items():
                    mine = numbers == body
                    values[index][mine] = average.at(state.position[mine])
        return states, values, fields

    def flat(self, state):
        """Where the points are on paper."""
        return (state.position @ self.axes_of_view if self.in_space else state.position)[:, :2]

    def limits(self, states, times):
        """The part of the plane that holds the body at all these times, and tools about it."""
        low = np.min([self.flat(state).min(axis=0) for state in states], axis=0)
        high = np.max([self.flat(state).max(axis=0) for state in states], axis=0)
        low, high = self.rigid.limits(times, low, high)
        margin = 0.04 * max(high - low) + np.max(spacing(states[0]))
        if self.in_space:
            return low - [margin, 3 * margin], high + margin
        return low - margin, high + margin

    def scaling(self, values):
        """Factor, unit, colours: numbers of a handy size."""
        factor, unit = style.handy(self.unit, values, self.options.stress_unit)
        wanted = self.options.range
        norm, cmap = colours(self.field, [factor * value for value in values], wanted)
        self.signed = cmap == "RdBu_r"
        return factor, unit, norm, cmap

    def draw(self, panel, state, value, fields, scaling):
        """One panel."""
        factor, _, norm, cmap = scaling
        if self.field == "body":
            return self.draw_bodies(panel, state)
        if self.in_space:
            return draw_solid(panel, state, factor * value, norm, cmap, self.axes_of_view)
        if fields is None:
            return draw_domains(panel, state, factor * value, norm, cmap)
        for field in fields.values():
            field.field *= factor
        return draw_smooth(panel, state, fields, norm, cmap)

    def draw_bodies(self, panel, state):
        """Each body in its colour."""
        numbers = body_numbers(state)
        for body in np.unique(numbers):
            mine = state.subset(numbers == body)
            colour = style.colour(int(body), len(np.unique(numbers)))
            if self.in_space:
                place = self.flat(mine)
                panel.scatter(*place.T, s=3, color=colour)
            else:
                fill(panel, mine, lambda place: np.zeros(len(place)), cmap=ListedColormap([colour]))

    def finish_panel(self, panel, time, low, high):
        """Rigid bodies, limits, axes and the time."""
        self.rigid.draw(panel, time, opaque=False)
        panel.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal",
                  title=f"t = {style.time_text(time, self.options.time_unit)}")
        panel.grid(False)
        if self.signed and not self.in_space:
            panel.set_facecolor("#e4e4e4") # zero is white
        if self.in_space:
            panel.set_axis_off()
            draw_triad(panel, self.axes_of_view, low, high)
        else:
            panel.set(xlabel="x [m]", ylabel="y [m]")
            panel.label_outer()

    def add_legend(self, figure, axes, drawn, unit):
        """A colour bar with the unit, or the names of the bodies."""
        if self.field == "body":
            names = self.run.scene.names("Bodies") or ["0"]
            handles = [Patch(color=style.colour(i, len(names)), label=name)
                       for i, name in enumerate(names)]
            last = np.atleast_1d(axes).flat[-1] if np.ndim(axes) < 2 else axes[0, -1]
            last.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.01, 1))
            return
        effective = self.run.scene.is_saturated()
        figure.colorbar(drawn, ax=axes, label=style.label(style.stress_name(self.field, effective),
                                                          unit),
                        shrink=0.8, aspect=30, extend="both")

    def figure(self):
        """Panels of the chosen times; None if no points were written."""
        if not self.series:
            return None
        entries = choose(self.series, self.options.times, self.options.snapshots)
        states, values, fields = self.load(entries)
        low, high = self.limits(states, [time for time, _ in entries])
        rows, columns, size = layout(*(high - low), len(states))
        figure, axes = plt.subplots(rows, columns, figsize=size, squeeze=False)
        scaling, drawn = self.scaling(values), None
        for panel in axes.flat[len(states):]:
            panel.set_visible(False)
        for panel, (time, _), *rest in zip(axes.flat, entries, states, values, fields):
            drawn = self.draw(panel, *rest, scaling)
            self.finish_panel(panel, time, low, high)
        self.add_legend(figure, axes, drawn, scaling[1])
        figure.suptitle(self.run.title())
        return figure
