"""Reads what a run of kedge, or of the finite element program, has written."""
import bisect
import csv
import json
import math


def read_table(path):
    """A CSV file as a dictionary from column to list of numbers."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    names, values = rows[0], [[float(entry) for entry in row] for row in rows[1:]]
    return {name: [row[i] for row in values] for i, name in enumerate(names)}


class Run:
    """An output folder."""

    def __init__(self, folder):
        self.folder = folder
        self.summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))

    def history(self):
        """history.csv"""
        return read_table(self.folder / "history.csv")

    def probes(self):
        """probes.csv"""
        return read_table(self.folder / "probes.csv")

    def check(self, name):
        """The value of a check of the scene."""
        for check in self.summary["checks"]:
            if check["name"] == name:
                return check["value"]
        raise KeyError(f"{self.folder}: no check '{name}'")

    def counts(self):
        """Points, unknowns, steps and iterations."""
        counts = self.summary["counts"]
        return {"points": counts["material_points"], "unknowns": counts["dofs"],
                "steps": self.summary["steps"], "newton": self.summary["newton_iterations"]}

    def phases(self):
        """CPU seconds by phase."""
        return self.summary["phase_cpu_seconds"]


def interpolate(times, values, time):
    """A history at a time, linear in between."""
    i = bisect.bisect_left(times, time)
    if i == 0 or i == len(times):
        return values[min(i, len(times) - 1)]
    share = (time - times[i - 1]) / (times[i] - times[i - 1])
    return values[i - 1] + share * (values[i] - values[i - 1])


def relative_difference(times, values, reference_times, reference_values):
    """Root mean square of the difference of two histories over that of the reference."""
    difference = square = 0.
    for time, value in zip(times, values):
        exact = interpolate(reference_times, reference_values, time)
        difference += (value - exact) ** 2
        square += exact ** 2
    return math.sqrt(difference / square)


def zero_crossings(times, values, begin):
    """Times after `begin` at which a history changes its sign."""
    crossings = []
    for i in range(1, len(times)):
        if times[i - 1] >= begin and values[i - 1] * values[i] < 0:
            share = values[i - 1] / (values[i - 1] - values[i])
            crossings.append(times[i - 1] + share * (times[i] - times[i - 1]))
    return crossings
