"""Pictures of the suite: run time against error, a curve for each method and rival."""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "source" / "plot"))
import style  # noqa: E402  (its folder has to be known first)
from style import plt  # noqa: E402

# (problem, variant, measure, what is on the axis) of the panels of each picture
PICTURES = {
    "column": [("column", "E=1e4", "stress", "stress error, E = 10 kPa"),
               ("column", "E=1e6", "stress", "stress error, E = 1 MPa")],
    "cantilever_static": [("cantilever_static", "", "tip", "error of the tip's displacement")],
    "cantilever_dynamic": [
        ("cantilever_dynamic_a", "", "history", "error of the tip's history, A"),
        ("cantilever_dynamic_b", "", "history", "error of the tip's history, B"),
        ("cantilever_dynamic_a", "", "energy", "energy lost or gained, A")],
    "spinning_body": [("spinning_body", "", "angle", "error of the angle [rad]"),
                      ("spinning_body", "", "energy", "energy lost or gained")],
    "discs": [("discs", "elastic", "energy", "energy lost or gained")],
    "collapse": [("collapse", "", "corners", "error of the outer corners")],
    "taylor_bar": [("taylor_bar", "", "length", "error of the shortening"),
                   ("taylor_bar", "", "foot", "error of the foot's spread")],
}
MARKERS = {"kedge": "o", "FEM": "s"}


def _curve(axes, name, points, colour):
    """One method: (error, time) in the order of the suite."""
    kind = name.split()[0]
    axes.plot([error for error, _ in points], [time for _, time in points],
              marker=MARKERS.get(kind, "^"), markersize=4, linestyle="-", color=colour,
              label=name, alpha=0.9)


def _rival(axes, name, rivals, colour):
    """One rival, with bars where time or error are known as a range."""
    error = [math.sqrt(rival.error[0] * rival.error[1]) for rival in rivals]
    time = [math.sqrt(rival.time[0] * rival.time[1]) for rival in rivals]
    bars = {"xerr": [[e - r.error[0] for e, r in zip(error, rivals)],
                     [r.error[1] - e for e, r in zip(error, rivals)]],
            "yerr": [[t - r.time[0] for t, r in zip(time, rivals)],
                     [r.time[1] - t for t, r in zip(time, rivals)]]}
    axes.errorbar(error, time, **bars, marker="^", markersize=4, linestyle="--", linewidth=1.,
                  elinewidth=0.7, color=colour, label=name)


def _panel(axes, rows, rivals, panel, colours):
    """Draws all methods of one problem and measure."""
    problem, variant, measure, title = panel

    def colour(name):
        return colours.setdefault(name, f"C{len(colours)}")

    methods = {}
    for row in rows:
        if (row["problem"], row["variant"]) == (problem, variant) and row.get(measure):
            error = max(float(row[measure]), 1e-16)
            methods.setdefault(row["method"], []).append((error, float(row["user_s"])))
    for name, points in methods.items():
        _curve(axes, name, points, colour(name))
    others = {}
    for rival in rivals:
        if (rival.problem, rival.variant, rival.measure) == (problem, variant, measure):
            others.setdefault(rival.name, []).append(rival)
    for name, group in others.items():
        _rival(axes, name, group, colour(name))
    axes.set(xscale="log", yscale="log", xlabel=title)
    return bool(methods)


def draw_suite(rows, rivals, start, folder):
    """
    One picture per problem as PNG and SVG; the names of those drawn. `start` is
    the time in which kedge does nothing but begin and end.
    """
    style.set_style()
    plt.rcParams["axes.prop_cycle"] = plt.cycler(color=style.COLOURS + [
        "#8c510a", "#762a83", "#999999", "#5aae61", "#b2182b", "#4393c3", "#f1a340"])
    drawn = []
    for name, panels in PICTURES.items():
        present = [panel for panel in panels if any(
            (row["problem"], row["variant"]) == panel[:2] and row.get(panel[2]) for row in rows)]
        if not present:
            continue
        figure, axes = plt.subplots(1, len(present), figsize=(1. + 4. * len(present), 4.6),
                                    sharey=True, squeeze=False)
        colours = {}
        for panel, part in zip(present, axes[0]):
            _panel(part, rows, rivals, panel, colours)
            part.axhline(start, color="black", linestyle=":", linewidth=0.8,
                         label="kedge's start")
        axes[0][0].set_ylabel("user CPU time of the whole run [s]")
        handles = {}
        for part in axes[0]:
            handles.update(dict(zip(*reversed(part.get_legend_handles_labels()))))
        figure.legend(handles.values(), handles.keys(), loc="upper center",
                      bbox_to_anchor=(0.5, 0.), ncols=1 + len(present), fontsize=7.5)
        save(figure, folder, name)
        drawn.append(name)
    return drawn


def save(figure, folder, name):
    """PNG and SVG, small enough for a repository."""
    folder.mkdir(parents=True, exist_ok=True)
    figure.savefig(folder / f"{name}.png", dpi=100, bbox_inches="tight")
    figure.savefig(folder / f"{name}.svg", bbox_inches="tight", metadata={"Date": None})
    plt.close(figure)
