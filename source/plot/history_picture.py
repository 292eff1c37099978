"""Energies and their error, momenta, the solver's work, reactions, loads over displacements,
probes."""
import numpy as np

import style
from rigid_picture import names_of

plt = style.plt

ENERGIES = ["kinetic_energy", "strain_energy", "hardening_energy", "plastic_dissipation",
            "stabilisation_energy", "fluid_energy", "darcy_dissipation", "external_work",
            "total_energy"]
PROBE_QUANTITIES = ["displacement", "velocity", "cauchy_stress", "total_stress", "pressure",
                    "pore_pressure"]


class Histories:
    """The tables of some runs, and how the user wants to see them."""

    def __init__(self, runs, options):
        self.runs, self.options = runs, options
        self.dimension = runs[0].dimension()
        self.unit = style.time_unit(max(run.history["time"][-1] for run in runs),
                                    options.time_unit)

    def time(self, table):
        """The times of a table in the unit of the figure."""
        return table["time"] / style.SECONDS[self.unit]

    def titled(self, quantity, index):
        """What the legend says: the quantity, and the run if there are several."""
        if len(self.runs) > 1:
            quantity += f", {self.runs[index].name}"
        return style.wrapped(quantity)

    def finish_time(self, panel):
        """The axis of time."""
        panel.set_xlabel(f"Time [{style.UNIT_WORDS[self.unit]}]")
        if self.options.log_time:
            panel.set_xscale("log")

    def panels(self, count, height):
        """So many panels over each other with one axis of time."""
        figure, panels = plt.subplots(count, 1, sharex=True, squeeze=False,
                                      figsize=(9, height * count + 0.6))
        if len(self.runs) == 1:
            figure.suptitle(self.runs[0].title())
        return figure, panels[:, 0]

    def energies(self):
        """Energies above, the error of the books below."""
        figure, (upper, lower) = self.panels(2, 3.2)
        shown = ENERGIES if len(self.runs) == 1 else ["kinetic_energy", "strain_energy",
                                                      "external_work", "total_energy"]
        shown = [name for name in shown if name == "total_energy" or any(
            np.any(run.history.get(name, 0)) for run in self.runs)]
        for index, run in enumerate(self.runs):
            time = self.time(run.history)
            for number, name in enumerate(shown):
                if name not in run.history:
                    continue
                total = name == "total_energy"
                above = ({"dashes": (4, 2), "zorder": 4}
                         if name == "external_work" and len(self.runs) == 1 else {})
                upper.plot(time, run.history[name], "-" if above else style.line_style(index),
                           color="black" if total else style.colour(number, len(shown)),
                           linewidth=1.9 if total or above else 1.3,
                           label=self.titled(style.label(name), index), **above,
                           **style.thin(time))
            error = np.abs(run.history["energy_error"]) / run.energy_scale()
            lower.semilogy(time, np.where(error > 0, error, np.nan),
                           color=style.colour(index, len(self.runs)), label=run.name,
                           **style.thin(time))
        upper.set(ylabel=f"Energy [{style.book_unit('energy', self.dimension)}]",
                  title="Energies")
        style.legend(upper)
        lower.set(ylabel="|error| / largest energy", title="Error of the energy books")
        self.finish_time(lower)
        if len(self.runs) > 1:
            style.legend(lower)
        return figure

    def momenta(self):
        """Linear momentum above, angular momentum about the origin below."""
        figure, panels = self.panels(2, 3)
        for panel, kind in zip(panels, ("linear_momentum", "angular_momentum")):
            for index, run in enumerate(self.runs):
                for number, axis in enumerate("xyz"):
                    values = run.history.get(f"{kind}_{axis}")
                    if values is not None:
                        panel.plot(self.time(run.history), values, style.line_style(index),
                                   color=style.COLOURS[number], label=self.titled(axis, index),
                                   **style.thin(values))
            panel.set(title=style.label(kind),
                      ylabel=f"[{style.book_unit(kind, self.dimension)}]")
            style.legend(panel)
        self.finish_time(panels[-1])
        return figure

    def solver(self):
        """Newton's and the linear solver's iterations, the time step."""
        names = [name for name in ("newton_iterations", "linear_iterations",
                                   "rejected_attempts", "time_step")
                 if any(np.any(run.history.get(name, 0)) for run in self.runs)]
        figure, panels = self.panels(len(names), 2.3)
        for panel, name in zip(panels, names):
            for index, run in enumerate(self.runs):
                if name in run.history:
                    panel.step(self.time(run.history), run.history[name], where="pre",
                               color=style.colour(index, len(self.runs)), linewidth=1.1,
                               label=run.name)
            counts = name != "time_step"
            panel.set(title=style.label(name, style.field_unit(name))
                      + (" per step" if counts else ""))
            if counts:
                panel.set_ylim(bottom=0)
                panel.yaxis.get_major_locator().set_params(integer=True)
        if len(self.runs) > 1:
            style.legend(panels[0])
        self.finish_time(panels[-1])
        return figure

    def reactions(self):
        """The forces of supports over time; None if the scene asks for none."""
        names = list(dict.fromkeys(name for run in self.runs for name in run.reactions()))
        if not names:
            return None
        figure, panels = self.panels(len(names), 2.6)
        for panel, name in zip(panels, names):
            for index, run in enumerate(self.runs):
                for direction, column in run.reactions().get(name, {}).items():
                    panel.plot(self.time(run.history), run.history[column],
                               style.line_style(index),
                               color=style.COLOURS["xyz".index(direction)],
                               label=self.titled(direction, index),
                               **style.thin(run.history["time"]))
            panel.set(title=f"Reaction of '{name}'",
                      ylabel=f"[{style.book_unit('force', self.dimension)}]")
            style.legend(panel)
        self.finish_time(panels[-1])
        return figure

    def load_displacement(self):
        """Forces over the displacements that go with them; None if nothing is pushed."""
        curves = [(index, *curve) for index, run in enumerate(self.runs)
                  for curve in load_curves(run)]
        if not curves:
            return None
        figure, panel = plt.subplots(figsize=(7.5, 5))
        for number, (index, name, across, up, _, _) in enumerate(curves):
            panel.plot(across, up, style.line_style(index),
                       color=style.colour(number, len(curves)), label=self.titled(name, index), **style.thin(across))
        force = style.book_unit("force", self.dimension)
        forces = {label for *_, label in curves}
        panel.set(xlabel=curves[0][4] if len({c[4] for c in curves}) == 1 else "Displacement [m]",
                  ylabel=f"{forces.pop()} [{force}]" if len(forces) == 1 else f"Load [{force}]",
                  title="Load over displacement")
        style.legend(panel)
        return figure

    def trajectories(self):
        """The paths of rigid bodies' centres: up over across, in space seen from the side and from
        above; None if there are none that move."""
        views = [("x", "z"), ("x", "y")] if self.dimension == 3 else [("x", "y")]
        paths = [(index, name) for index, run in enumerate(self.runs) for name in names_of(run)
                 if any(np.ptp(run.history[f"position_{name}_{axis}"]) > 0
                        for axis in "xyz"[:self.dimension])]
        if not paths:
            return None
        figure, panels = plt.subplots(len(views), 1, squeeze=False,
                                      figsize=(8, 4.2 * len(views) + 0.6))
        for panel, (across, up) in zip(panels[:, 0], views):
            for number, (index, name) in enumerate(paths):
                history = self.runs[index].history
                panel.plot(history[f"position_{name}_{across}"], history[f"position_{name}_{up}"],
                           style.line_style(index), color=style.colour(number, len(paths)),
                           label=self.titled(name, index))
            panel.set(xlabel=f"{across} [m]", ylabel=f"{up} [m]")
            spans = [max(np.ptp(self.runs[index].history[f"position_{name}_{axis}"])
                         for index, name in paths) for axis in (across, up)]
            if min(spans) > 0.1 * max(spans): # else a flat path would be a straight line
                panel.set_aspect("equal", adjustable="datalim")
        panels[0, 0].set_title("Paths of the centres")
        style.legend(panels[0, 0])
        return figure

    def probes(self):
        """One panel for each quantity; None if no probe moved or was stressed."""
        wanted = {quantity: self.probe_columns(quantity) for quantity in PROBE_QUANTITIES}
        wanted = {quantity: columns for quantity, columns in wanted.items() if columns}
        if not wanted:
            return None
        figure, panels = self.panels(len(wanted), 2.6)
        saturated = any(run.scene.is_saturated() for run in self.runs)
        for panel, (quantity, columns) in zip(panels, wanted.items()):
            factor, unit = style.handy(
                style.field_unit(quantity),
                [run.probes[column] for run in self.runs for column in columns
                 if column in run.probes], self.options.stress_unit)
            for number, column in enumerate(columns):
                for index, run in enumerate(self.runs):
                    if column in run.probes:
                        probe, _, rest = column.rpartition(".")
                        what = f"{probe} {rest[len(quantity):].strip('_')}".strip()
                        panel.plot(self.time(run.probes), factor * run.probes[column],
                                   style.line_style(index),
                                   color=style.colour(number, len(columns)),
                                   label=self.titled(what, index),
                                   **style.thin(run.probes["time"]))
            panel.set(title=style.label(style.stress_name(quantity, saturated)),
                      ylabel=f"[{unit}]")
            style.legend(panel)
        self.finish_time(panels[-1])
        return figure

    def probe_columns(self, quantity):
        """The columns NAME.quantity.. of all probes that are not zero all the time."""
        found = {}
        for run in self.runs:
            for column, values in run.probes.items():
                probe, _, rest = column.rpartition(".")
                component = rest[len(quantity):]
                if probe and rest.startswith(quantity) and component[:1] in ("", "_"):
                    found[column] = max(found.get(column, 0.0), np.max(np.abs(values), initial=0))
        largest = max(found.values(), default=0.0)
        return [column for column, size in found.items() if size > 1e-9 * largest]

    def curve(self, across, up):
        """Any column over any other: history.COLUMN, probe.NAME.COLUMN or COLUMN."""
        figure, panel = plt.subplots(figsize=(7.5, 5))
        for index, run in enumerate(self.runs):
            x, y = column_of(run, across), column_of(run, up)
            n_rows = min(len(x), len(y))
            panel.plot(x[:n_rows], y[:n_rows], color=style.colour(index, len(self.runs)),
                       label=style.wrapped(run.name), **style.thin(x))
        panel.set(xlabel=axis_label(across), ylabel=axis_label(up))
        if len(self.runs) > 1:
            style.legend(panel)
        return figure


def axis_label(column):
    """A column's name with its unit."""
    name = column.split(".")[-1]
    place = column.split(".")[-2] + ": " if column.count(".") > 1 else ""
    return place + style.label(name, style.field_unit(name))


def column_of(run, name):
    """A column of history.csv or probes.csv; an error that lists those that are there."""
    place, _, rest = name.partition(".")
    tables = {"history": run.history, "probe": run.probes}
    table, column = (tables[place], rest) if place in tables else (run.history, name)
    if column not in table:
        known = [f"history.{key}" for key in run.history] + [f"probe.{key}" for key in run.probes]
        raise ValueError(f"{run.folder} has no column '{name}'. It has: {', '.join(known)}")
    return table[column]


def load_curves(run):
    """
    Pairs of load and displacement of a run: name, displacements, loads, and their names.
    A support that is moved and whose reaction is written gives one; else a load that
    changes with time and each probe of the body on which it acts.
    """
    curves = []
    time = run.history["time"]
    for name, columns in run.reactions().items():
        for direction, column in columns.items():
            motion = (run.scene.get(f"Node conditions/{name}/Component {direction}")
                      or run.scene.get(f"Body conditions/{name}/Component {direction}"))
            if motion.startswith("displacement(") and np.any(run.history[column]):
                across = run.scene.history(motion[len("displacement("):-1], time)
                if across is not None and np.ptp(across) > 0:
                    curves.append((f"{name}, {direction}", np.abs(across),
                                   np.abs(run.history[column]), "Displacement of the support [m]",
                                   "Reaction"))
    curves += tool_curves(run) + line_curves(run)
    if not curves:
        curves = loaded_probes(run)
    return curves


def tool_curves(run):
    """Curves of the reactions of rigid bodies along what moves them over the way."""
    curves = []
    for name in names_of(run):
        for direction in "xyz":
            reaction = run.history.get(f"reaction_{name}_{direction}")
            place = run.history.get(f"position_{name}_{direction}")
            if reaction is not None and np.any(reaction) and np.ptp(place) > 0:
                curves.append((f"{name}, {direction}", np.abs(place - place[0]), np.abs(reaction),
                               "Displacement of the rigid body [m]", "Reaction"))
    return curves


def line_curves(run):
    """Curves of the tensions of lines over the way of the bodies that they tow."""
    curves = []
    for line in run.scene.names("Lines"):
        tension = run.history.get("tension_" + line.replace(" ", "_"))
        name = run.scene.get(f"Lines/{line}/Body").replace(" ", "_")
        if tension is None or name not in names_of(run) or not np.any(tension):
            continue
        places = np.stack([run.history[f"position_{name}_{axis}"] for axis in "xyz"
                           if f"position_{name}_{axis}" in run.history], axis=1)
        way = np.linalg.norm(places - places[0], axis=1)
        if np.ptp(way) > 0:
            curves.append((f"{line}", way, tension, "Way of the body at the line [m]", "Tension"))
    return curves


def loaded_probes(run):
    """Curves of point loads over the displacements of the probes."""
    curves = []
    time = run.probes.get("time")
    if time is None:
        return curves
    for name in run.scene.names("Point loads"):
        for number, text in enumerate(run.scene.get(f"Point loads/{name}/Force").split(";")):
            load = run.scene.history(text, time)
            if load is None or not np.ptp(load) > 0:
                continue
            for column, values in run.probes.items():
                probe, _, rest = column.rpartition(".")
                if rest == f"displacement_{'xyz'[number]}" and np.any(values):
                    curves.append((f"{name}, {probe} {'xyz'[number]}", np.abs(values),
                                   np.abs(load), "Displacement of the probe [m]", "Point load"))
    return curves
