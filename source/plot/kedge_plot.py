#!/usr/bin/env python3
"""Pictures of kedge's runs: energies and their error, momenta, the solver's
work, probes, and the body at chosen times coloured by a field; of element tests
of soil the curves of stress and strain."""
import argparse
import sys
from pathlib import Path

import numpy as np

import style
from body_picture import draw_body
from run_reader import NoRun, Run, name_apart
from soil_picture import draw_element_tests, is_element_test
from vtu_reader import BadFile

plt = style.plt

ENERGIES = ["kinetic_energy", "strain_energy", "hardening_energy", "plastic_dissipation",
            "stabilisation_energy", "external_work", "total_energy"]
PROBE_QUANTITIES = ["displacement", "velocity", "cauchy_stress", "pressure"]


def arguments():
    """The command line, parsed."""
    parser = argparse.ArgumentParser(prog="kedge plot", description=__doc__)
    parser.add_argument("folders", nargs="+", metavar="DIR", help="output folder of a run")
    parser.add_argument("-o", "--output", type=Path, metavar="OUT",
                        help="folder for the pictures (default: DIR/pictures of the first DIR)")
    parser.add_argument("-f", "--field", action="append", metavar="NAME",
                        help="what the body is coloured by, e.g. pressure, cauchy_stress_yy, "
                             "velocity; repeatable")
    parser.add_argument("-t", "--times", type=float, nargs="+", metavar="T",
                        help="simulated times at which the body is shown [s]")
    parser.add_argument("-n", "--snapshots", type=int, default=6, metavar="N",
                        help="without --times: number of evenly spread times (default: 6)")
    parser.add_argument("--formats", default="png,svg", help="default: png,svg")
    arg = parser.parse_intermixed_args()
    if arg.snapshots < 1:
        parser.error("--snapshots must be at least 1")
    return arg


def titled(runs, quantity, run_index):
    """What the legend says: the quantity, and the run if there are several."""
    return quantity if len(runs) == 1 else f"{quantity}, {runs[run_index].name}"


def thin(values):
    """Markers for short histories only."""
    return {"marker": "o", "markersize": 3} if len(values) <= 40 else {}


def legend(panel):
    """The legend beside the title, where it hides no line; below it if it is long."""
    handles, _ = panel.get_legend_handles_labels()
    if len(handles) <= 6:
        panel.legend(loc="lower right", bbox_to_anchor=(1, 0.98), ncols=3, borderaxespad=0)
    else:
        panel.legend(loc="upper left", bbox_to_anchor=(1, 1))


def draw_energies(runs):
    """Energies above, the error of the books below."""
    figure, (upper, lower) = plt.subplots(2, 1, sharex=True, figsize=(8, 6.5),
                                          height_ratios=(1.7, 1))
    for index, run in enumerate(runs):
        time = run.history["time"]
        shown = ENERGIES if len(runs) == 1 else ["kinetic_energy", "strain_energy", "total_energy"]
        for name in shown:
            if name not in run.history or (name not in ("total_energy",)
                                           and not np.any(run.history[name])):
                continue
            total = name == "total_energy"
            upper.plot(time, run.history[name], style.line_style(index),
                       color="black" if total else style.COLOURS[shown.index(name)],
                       linewidth=1.8 if total else 1.3,
                       label=titled(runs, style.label(name), index), **thin(time))
        error = np.abs(run.history["energy_error"]) / run.energy_scale()
        lower.semilogy(time, np.where(error > 0, error, np.nan), color=style.COLOURS[index % 7],
                       label=run.name, **thin(time))
    unit = style.book_unit("energy", runs[0].dimension())
    upper.set(ylabel=f"Energy [{unit}]", title="Energies")
    legend(upper)
    lower.set(xlabel="Time [s]", ylabel="|error| / largest energy",
              title="Error of the energy books")
    if len(runs) > 1:
        legend(lower)
    return figure


def draw_momenta(runs):
    """Linear momentum above, angular momentum about the origin below."""
    figure, panels = plt.subplots(2, 1, sharex=True, figsize=(8, 6))
    for panel, kind in zip(panels, ("linear_momentum", "angular_momentum")):
        for index, run in enumerate(runs):
            for axis, colour in zip("xyz", style.COLOURS):
                values = run.history.get(f"{kind}_{axis}")
                if values is not None:
                    panel.plot(run.history["time"], values, style.line_style(index), color=colour,
                               label=titled(runs, axis, index), **thin(values))
        unit = style.book_unit(kind, runs[0].dimension())
        panel.set(title=style.label(kind), ylabel=f"[{unit}]")
        legend(panel)
    panels[-1].set_xlabel("Time [s]")
    return figure


def draw_solver(runs):
    """Newton's and the linear solver's iterations, the time step."""
    names = [name for name in ("newton_iterations", "newton_residual", "linear_iterations",
                               "time_step")
             if any(np.any(run.history.get(name, 0)) for run in runs)]
    figure, panels = plt.subplots(len(names), 1, sharex=True, squeeze=False,
                                  figsize=(8, 2.3 * len(names) + 0.5))
    for panel, name in zip(panels[:, 0], names):
        for index, run in enumerate(runs):
            if name in run.history:
                panel.step(run.history["time"], run.history[name], where="pre",
                           color=style.COLOURS[index % 7], linewidth=1.1, label=run.name)
        counts = name.endswith("iterations")
        panel.set(title=style.label(name, style.field_unit(name)) + (" per step" if counts else ""))
        if counts:
            panel.set_ylim(bottom=0)
            panel.yaxis.get_major_locator().set_params(integer=True)
        if name == "newton_residual":
            panel.set_yscale("log")
    if len(runs) > 1:
        legend(panels[0, 0])
    panels[-1, 0].set_xlabel("Time [s]")
    return figure


def probe_columns(runs, quantity):
    """The columns NAME.quantity.. of all probes that are not zero all the time."""
    found = {}
    for run in runs:
        for column, values in run.probes.items():
            probe, _, rest = column.rpartition(".")
            if (probe and rest.startswith(quantity) and np.any(values)
                    and np.any(np.isfinite(values))):
                found[column] = None
    return list(found)


def draw_probes(runs):
    """One panel for each quantity; None if no probe moved or was stressed."""
    wanted = {quantity: probe_columns(runs, quantity) for quantity in PROBE_QUANTITIES}
    wanted = {quantity: columns for quantity, columns in wanted.items() if columns}
    if not wanted:
        return None
    figure, panels = plt.subplots(len(wanted), 1, sharex=True, squeeze=False,
                                  figsize=(8, 2.6 * len(wanted) + 0.5))
    for panel, (quantity, columns) in zip(panels[:, 0], wanted.items()):
        for number, column in enumerate(columns):
            for index, run in enumerate(runs):
                if column in run.probes:
                    probe, _, rest = column.rpartition(".")
                    what = f"{probe} {rest[len(quantity):].strip('_')}".strip()
                    panel.plot(run.probes["time"], run.probes[column], style.line_style(index),
                               color=style.COLOURS[number % 7],
                               label=titled(runs, what, index), **thin(run.probes["time"]))
        panel.set(title=style.label(quantity), ylabel=f"[{style.field_unit(quantity)}]")
        legend(panel)
    panels[-1, 0].set_xlabel("Time [s]")
    return figure


def save(figure, output, name, formats):
    """Writes a figure in all formats and says so."""
    for ending in formats.split(","):
        path = output / f"{name}.{ending.strip()}"
        figure.savefig(path)
        print(path)
    plt.close(figure)


def draw_all(arg, runs, output):
    """All pictures that the runs have data for."""
    if all(map(is_element_test, runs)):
        save(draw_element_tests(runs), output, "element-test", arg.formats)
        return
    for run in runs:
        if "energy_error" not in run.history:
            raise NoRun(f"{run.folder} holds a single material point; of these, only element "
                        "tests of soil are drawn, and not together with other runs")
    for name, draw in (("energies", draw_energies), ("momenta", draw_momenta),
                       ("solver", draw_solver), ("probes", draw_probes)):
        figure = draw(runs)
        if figure is not None:
            save(figure, output, name, arg.formats)
    for run in runs:
        for field in arg.field or [None]:
            drawn = draw_body(run, field, arg.times, arg.snapshots)
            if drawn is None:
                print(f"{run.folder} has no points.pvd: no picture of the body", file=sys.stderr)
                break
            figure, shown = drawn
            which = "" if len(runs) == 1 else "-" + run.name.replace("/", "-")
            save(figure, output, f"body-{shown}{which}", arg.formats)


def main():
    """Ends with 1 if something is wrong with what the user gave."""
    arg = arguments()
    try:
        runs = name_apart([Run(folder) for folder in arg.folders])
        output = arg.output or runs[0].folder / "pictures"
        output.mkdir(parents=True, exist_ok=True)
        style.set_style()
        draw_all(arg, runs, output)
    except (NoRun, BadFile, OSError, ValueError) as error:
        sys.exit(f"kedge plot: {error}")


if __name__ == "__main__":
    main()
