"""What stands in the folder of a run."""
import csv
import difflib
import json
from pathlib import Path

import numpy as np


class Table(dict):
    """Columns of numbers, as arrays by name."""

    def __missing__(self, name):
        raise KeyError(unknown_column(name, self))


def unknown_column(name, names):
    """Words for a column that is not there: which ones are like it, or which there are."""
    near = difflib.get_close_matches(str(name), names, 3)
    return f"no column '{name}'; " + (f"did you mean {', '.join(near)}?" if near else
                                      f"there are {', '.join(names)}")


def read_table(path):
    """A CSV file of numbers as a Table."""
    with open(path, newline="", encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    return Table(zip(names, np.array(rows, dtype=float).reshape(-1, len(names)).T.copy()))


class Results:
    """Tables of a run that was done before, with ./kedge or from Python, from its folder."""

    def __init__(self, folder):
        self.folder = Path(folder)
        if not (self.folder / "history.csv").exists():
            raise FileNotFoundError(f"{self.folder} holds no history.csv of a run of kedge")

    @property
    def history(self):
        """history.csv, as arrays by column name."""
        return read_table(self.folder / "history.csv")

    @property
    def probes(self):
        """probes.csv, as arrays by column name; nothing of a scene without probes."""
        file = self.folder / "probes.csv"
        return read_table(file) if file.exists() else Table()

    @property
    def summary(self):
        """summary.json; None of a run that has not ended."""
        file = self.folder / "summary.json"
        return json.loads(file.read_text("utf-8")) if file.exists() else None

    @property
    def checks(self):
        """The scene's known answers: name, value, reference, pass."""
        return (self.summary or {}).get("checks", [])
