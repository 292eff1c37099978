"""Reads the tables of a run's output folder."""
import csv
from pathlib import Path

import numpy as np

from scene_reader import SceneFile


class NoRun(Exception):
    """A folder that holds no run; says what is missing."""


def read_table(path):
    """A table as a dictionary from column to array; an unfinished last row is left out."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = [row for row in csv.reader(file) if row]
    if not rows:
        return {}
    names = [name.strip() for name in rows[0]]
    whole = [row for row in rows[1:] if len(row) == len(names)]
    values = np.array(whole, dtype=float).reshape(-1, len(names))
    return {name: values[:, column] for column, name in enumerate(names)}


class Run:
    """One output folder: its name, `history`, `probes`, and the file of its material points."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.name = self.folder.resolve().name
        if not self.folder.is_dir():
            raise NoRun(f"there is no folder {folder}")
        if not (self.folder / "history.csv").exists():
            raise NoRun(f"{folder} is no output folder of kedge: it has no history.csv")
        self.history = read_table(self.folder / "history.csv")
        if len(self.history.get("time", ())) == 0:
            raise NoRun(f"{folder}/history.csv has no rows yet")
        self.probes = self.read_probes()
        self.points_file = self.folder / "points.pvd"
        self.scene = SceneFile(self.folder / "parameters.prm")

    def read_probes(self):
        """probes.csv, and in saturated soil the total stresses; without the file, nothing."""
        path = self.folder / "probes.csv"
        table = read_table(path) if path.exists() else {}
        for column, effective in list(table.items()):
            probe, _, rest = column.rpartition(".")
            pressure = table.get(f"{probe}.pore_pressure")
            if pressure is not None and rest in [f"cauchy_stress_{a}{a}" for a in "xyz"]:
                table[column.replace("cauchy_stress", "total_stress")] = effective - pressure
        return table

    def title(self):
        """The run's name, and what its scene shows."""
        title = self.scene.title()
        return f"{self.name}: {title}" if title else self.name

    def dimension(self):
        """2 or 3: in 2D the angular momentum has its z component only."""
        return 3 if "angular_momentum_x" in self.history else 2

    def reactions(self):
        """The columns of supports' forces: name of the condition to its columns by direction."""
        found = {}
        for column in self.history:
            if column.startswith("reaction_"):
                name, _, direction = column[len("reaction_"):].rpartition("_")
                found.setdefault(name, {})[direction] = column
        return found

    def energy_scale(self):
        """The largest energy in the books [J], 1 if all are zero: what errors are measured against."""
        largest = max(np.max(np.abs(values), initial=0.0) for name, values in self.history.items()
                      if name in ("kinetic_energy", "strain_energy", "total_energy",
                                  "external_work"))
        return largest if largest > 0 else 1.0


def name_apart(runs):
    """Gives runs whose folders have the same name longer names."""
    names = [run.name for run in runs]
    for run in runs:
        if names.count(run.name) > 1:
            run.name = "/".join(run.folder.resolve().parts[-2:])
    return runs
