"""Surfaces in contact at chosen times, with the pressure on them."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

import style
from panels import choose, layout, projection
from rigid_picture import RigidShapes
from vtu_reader import read_pvd, read_surfaces

STATES = {1: "#9a9a9a", 2: "#1f6fb4", 3: "#d1495b"} # near, sticks, slides
NAMES = {2: "sticks", 3: "slides"}
LONGEST = 0.12 # of the drawn pressures over the size of the bodies


def draw_bars(panel, corners, pressure, states, length):
    """A plane surface; on pressed facets a bar outward, as long as the pressure, in the colour of
    its state. Bodies lie on the left of their facets."""
    lines = corners[:, :, :2]
    panel.add_collection(LineCollection(lines, colors="#555555", linewidths=0.7))
    along = lines[:, 1] - lines[:, 0]
    outward = np.stack([along[:, 1], -along[:, 0]], axis=1)
    outward /= np.maximum(np.linalg.norm(outward, axis=1), 1e-300)[:, None]
    tips = lines + (length * pressure)[:, None, None] * outward[:, None, :]
    pressed = pressure > 0
    bars = np.concatenate([lines, tips[:, ::-1]], axis=1)[pressed]
    panel.add_collection(PolyCollection(bars, linewidths=0.3, edgecolors="face", alpha=0.8,
                                        facecolors=[STATES[state] for state in states[pressed]]))


def draw_triangles(panel, corners, pressure, norm, axes_of_view):
    """A surface in space: one looks through what is not pressed, for bodies hide what is between
    them; the pressed facets nearest last."""
    place = corners @ axes_of_view
    pressed = pressure > 0
    panel.add_collection(PolyCollection(place[~pressed, :, :2], facecolors="#9a9a9a18",
                                        edgecolors="#00000020", linewidths=0.2))
    order = np.flatnonzero(pressed)[np.argsort(place[pressed, :, 2].mean(axis=1))]
    panel.add_collection(PolyCollection(place[order, :, :2],
                                        facecolors=plt.get_cmap("viridis")(norm(pressure[order])),
                                        edgecolors="#00000030", linewidths=0.2))


def explain_bars(figure, states, pressures, longest):
    """A legend beside the panels of what bars there are."""
    seen = set()
    for (_, fields), pressure in zip(states, pressures):
        seen.update(int(state) for state in fields["state"][pressure > 0, 0])
    handles = [plt.Rectangle((0, 0), 1, 1, color=STATES[state]) for state in sorted(seen)]
    names = [NAMES[state] for state in sorted(seen)]
    figure.get_layout_engine().set(rect=(0, 0, 0.89, 1))
    figure.legend(handles, names, loc="upper right", fontsize=8, title_fontsize=8,
                  title=f"longest bar\n{longest}" if seen else "nothing presses\nat these times")


def draw_contact(run, options):
    """Panels of the chosen times; None if the run has written no surfaces."""
    file = run.folder / "surfaces.pvd"
    series = read_pvd(file) if file.exists() else []
    if not series:
        return None
    options.time_unit = style.time_unit(run.history["time"][-1], options.time_unit)
    entries = choose(series, options.times, options.snapshots)
    states = [read_surfaces(path) for _, path in entries]
    view = projection(options.view)
    in_space = run.dimension() == 3
    flat = [(corners @ view if in_space else corners)[:, :, :2] for corners, _ in states]
    everything = np.concatenate([place.reshape(-1, 2) for place in flat])
    if len(everything) == 0: # all of it has left the grid
        return None
    low, high = everything.min(axis=0), everything.max(axis=0)
    pressures = [fields["contact_pressure"][:, 0] for _, fields in states]
    factor, unit = style.handy("Pa", pressures, options.stress_unit)
    largest = max(max(values.max(initial=0.0) for values in pressures), 1e-300)
    norm = plt.Normalize(0, factor * largest)
    rigid = RigidShapes(run, view)
    times = [time for time, _ in entries]
    low, high = rigid.limits(times, low, high)
    margin = (LONGEST if not in_space else 0.04) * max(high - low)
    rows, columns, size = layout(*(high - low + 2 * margin), len(states))
    figure, axes = plt.subplots(rows, columns, figsize=size, squeeze=False)
    for panel in axes.flat[len(states):]:
        panel.set_visible(False)
    for panel, (time, _), (corners, fields), pressure in zip(axes.flat, entries, states, pressures):
        if in_space:
            draw_triangles(panel, corners, factor * pressure, norm, view)
        else:
            rigid.draw(panel, time, lambda body: "#dfe2e6", zorder=0.5) # bars stand in the tool
            draw_bars(panel, corners, pressure, fields["state"][:, 0],
                      LONGEST * max(high - low) / largest)
        panel.set(xlim=(low[0] - margin, high[0] + margin), aspect="equal",
                  ylim=(low[1] - margin, high[1] + margin),
                  title=f"t = {style.time_text(time, options.time_unit)}")
        panel.grid(False)
        if in_space:
            panel.set_axis_off()
        else:
            panel.set(xlabel="x [m]", ylabel="y [m]")
            panel.label_outer()
    if in_space:
        figure.colorbar(plt.cm.ScalarMappable(norm=norm, cmap="viridis"), ax=axes, shrink=0.8,
                        aspect=30, label=style.label("contact pressure", unit))
    else:
        explain_bars(figure, states, pressures, f"{factor * largest:.3g} {unit}")
    figure.suptitle(run.title())
    return figure
