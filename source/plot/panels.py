"""Panels of bodies at chosen times: which times, how large, seen from where."""
import numpy as np


def choose(series, times, n_snapshots):
    """The entries nearest to the wanted times, or evenly spread ones; each once."""
    have = np.array([time for time, _ in series])
    if times:
        chosen = [int(np.argmin(np.abs(have - time))) for time in times]
    else:
        wanted = np.linspace(have[0], have[-1], min(n_snapshots, len(have)))
        chosen = [int(np.argmin(np.abs(have - time))) for time in wanted]
    return [series[index] for index in dict.fromkeys(chosen)]


def layout(width, height, n_pictures):
    """Rows, columns and size of the figure, whose panels have the shape of the body."""
    ratio = np.clip(height / width, 0.15, 4.0)
    columns = 1 if ratio < 0.3 else min(n_pictures, 3 if ratio < 1 else 5)
    rows = -(-n_pictures // columns)
    panel = 6.5 if columns == 1 else 9.5 / columns
    return rows, columns, (panel * columns + 1.6, (panel * ratio + 0.75) * rows + 0.3)


def projection(view):
    """Axes of a parallel projection: right, up, and towards the viewer (z is up)."""
    azimuth, height = np.radians(view)
    right = np.array([-np.sin(azimuth), np.cos(azimuth), 0])
    towards = np.array([np.cos(height) * np.cos(azimuth), np.cos(height) * np.sin(azimuth),
                        np.sin(height)])
    return np.stack([right, np.cross(towards, right), towards], axis=1)


def draw_triad(axes, axes_of_view, low, high):
    """The directions of x, y, z, and a bar that tells the scale, below the body."""
    length = 0.12 * max(high - low)
    corner = low + 0.6 * length
    for direction, name in enumerate("xyz"):
        tip = corner + length * axes_of_view[direction, :2]
        axes.annotate("", tip, corner, arrowprops={"arrowstyle": "->", "linewidth": 1.0})
        axes.text(*(corner + 1.25 * length * axes_of_view[direction, :2]), name, ha="center",
                  va="center", fontsize=8)
    bar = 10 ** np.floor(np.log10(0.4 * (high - low)[0]))
    bar *= max(factor for factor in (1, 2, 5) if factor * bar <= 0.4 * (high - low)[0])
    begin = np.array([high[0] - bar - 0.3 * length, low[1] + 0.3 * length])
    axes.plot([begin[0], begin[0] + bar], [begin[1]] * 2, color="black", linewidth=2)
    axes.text(begin[0] + bar / 2, begin[1] + 0.15 * length, f"{bar:g} m", ha="center",
              va="bottom", fontsize=8)
