"""The body at chosen times, coloured by a field."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

import style
from vtu_reader import BadFile, read_points, read_pvd

# What is shown if the user does not say: the first of these that was written.
FAVOURITES = ["von_mises_stress", "pressure", "cauchy_stress_yy", "velocity", "displacement",
              "det_F"]
SIGNED = ("pressure", "cauchy_stress_", "kirchhoff_stress_", "velocity_", "displacement_")
MANY_POINTS = 4000 # above, an SVG holds the body as an image: shapes would make it huge
CORNERS = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], dtype=float)


def choose(series, times, n_snapshots):
    """The entries nearest to the wanted times, or evenly spread ones; each once."""
    have = np.array([time for time, _ in series])
    if times:
        chosen = [int(np.argmin(np.abs(have - time))) for time in times]
    else:
        wanted = np.linspace(have[0], have[-1], min(n_snapshots, len(have)))
        chosen = [int(np.argmin(np.abs(have - time))) for time in wanted]
    return [series[index] for index in dict.fromkeys(chosen)]


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


def shapes(points):
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
    return points.position[:, None, :2] + np.einsum("pij,cj->pci", edges, CORNERS)


def draw_plane(axes, points, values, norm, cmap):
    """A plane body as the domains of its points."""
    collection = PolyCollection(shapes(points), array=values, norm=norm, cmap=cmap,
                                edgecolors="face", linewidths=0.25)
    axes.add_collection(collection)
    return collection


def project(position):
    """Parallel projection: right, up, and towards the viewer."""
    azimuth, height = np.radians(-60), np.radians(25)
    right = np.array([-np.sin(azimuth), np.cos(azimuth), 0])
    towards = np.array([np.cos(height) * np.cos(azimuth), np.cos(height) * np.sin(azimuth),
                        np.sin(height)])
    up = np.cross(towards, right)
    return position @ np.stack([right, up, towards], axis=1)


def draw_solid(axes, points, values, norm, cmap):
    """A body in space as squares, the nearest drawn last."""
    place = project(points.position)
    order = np.argsort(place[:, 2])
    half = 0.6 * spacing(points)[order]
    squares = place[order, None, :2] + half[:, None, None] * CORNERS
    collection = PolyCollection(squares, array=values[order], norm=norm, cmap=cmap,
                                edgecolors=(0, 0, 0, 0.12), linewidths=0.2)
    axes.add_collection(collection)
    return collection


def colours(field, values):
    """Limits and colour map; signed quantities are centred on zero."""
    everything = np.concatenate(values)
    everything = everything[np.isfinite(everything)]
    low, high = (np.percentile(everything, [0.5, 99.5]) if len(everything) else (0.0, 1.0))
    if field.startswith(SIGNED) and low < 0 < high:
        largest = max(-low, high)
        return plt.Normalize(-largest, largest), "RdBu_r"
    if high - low <= 1e-12 * max(abs(high), abs(low)):
        low, high = low - 0.5 * abs(low) - 1e-300, high + 0.5 * abs(high) + 1e-300
    return plt.Normalize(low, high), "viridis"


def layout(width, height, n_pictures):
    """Rows, columns and size of the figure, whose panels have the shape of the body."""
    ratio = np.clip(height / width, 0.15, 4.0)
    columns = 1 if ratio < 0.3 else min(n_pictures, 3 if ratio < 1 else 5)
    rows = -(-n_pictures // columns)
    panel = 6.5 if columns == 1 else 9.5 / columns
    return rows, columns, (panel * columns + 1.2, (panel * ratio + 0.75) * rows)


def field_of(points, field, path):
    """The wanted field, or the first favourite that is there."""
    if field is None:
        field = next((name for name in FAVOURITES if name in points.names()), None)
        if field is None and points.names():
            field = points.names()[0]
    if field not in points.names():
        raise BadFile(f"{path} has no field '{field}'. It has: {', '.join(points.names())}")
    return field


def draw_body(run, field, times, n_snapshots):
    """A figure of the run's body and the name of its field; None if it wrote no points."""
    if not run.points_file.exists():
        return None
    series = read_pvd(run.points_file)
    if not series:
        return None
    chosen = choose(series, times, n_snapshots)
    states = [read_points(path) for _, path in chosen]
    field = field_of(states[0], field, chosen[0][1])
    values = [state.values(field).astype(float) for state in states]
    in_space = run.dimension() == 3
    flat = [project(state.position) if in_space else state.position for state in states]

    low = np.min([place.min(axis=0) for place in flat], axis=0)[:2]
    high = np.max([place.max(axis=0) for place in flat], axis=0)[:2]
    margin = 0.04 * max(high - low) + np.max(spacing(states[0]))
    low, high = low - margin, high + margin
    rows, columns, size = layout(*(high - low), len(states))
    figure, axes = plt.subplots(rows, columns, figsize=size, squeeze=False)
    norm, cmap = colours(field, values)
    drawn = None
    for panel in axes.flat[len(states):]:
        panel.set_visible(False)
    for panel, (time, _), state, value in zip(axes.flat, chosen, states, values):
        drawn = (draw_solid if in_space else draw_plane)(panel, state, value, norm, cmap)
        drawn.set_rasterized(len(value) > MANY_POINTS)
        panel.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal",
                  title=f"t = {time:.4g} s")
        if in_space:
            panel.set_axis_off()
        else:
            panel.set(xlabel="x [m]", ylabel="y [m]")
            panel.label_outer()
    figure.colorbar(drawn, ax=axes, label=style.label(field, style.field_unit(field)),
                    shrink=0.8, aspect=30, extend="both")
    figure.suptitle(run.name)
    return figure, field
