"""What other programs needed for the same problems: rivals.csv, read and judged.

Its columns: time from cpu_low to cpu_high [s], equal if it was measured as a
whole; the error from error_low to error_high, or, where the rival's answers are
known, answer_1, answer_2 and the offset of its outermost points, which the
functions of errors.py judge as they judge kedge's:
  cantilever_static  tip displacement x, y [m] at the full load
  collapse           x of the front and y of the top left point [m]
  taylor_bar         displacement of the free end, radius of the foot [m]
"""
import csv
from dataclasses import dataclass
from pathlib import Path

import errors
from results import read_table


@dataclass
class Rival:
    """One run of another program."""
    problem: str
    variant: str
    measure: str
    name: str
    label: str
    time: tuple   # [s] from, to
    error: tuple  # from, to
    source: str


def _judge(row):
    """(measure, error) of the answers in a row."""
    first, second = float(row["answer_1"]), float(row["answer_2"])
    if row["problem"] == "cantilever_static":
        # its answer holds the settlement of the pin; take the reference's
        wall = read_table(errors.REFERENCES / "cantilever_static.csv")["root.displacement_y"][-1]
        error = errors.static_tip_error(float(row["offset"]), first, second - wall)
        return {"tip": error}
    if row["problem"] == "collapse":
        return {"corners": errors.collapse_error(float(row["offset"]), first, second)}
    return errors.taylor_error(first, second)


def read_rivals():
    """All rows of rivals.csv as a list of Rival, one for each measure."""
    rivals = []
    with open(Path(__file__).with_name("rivals.csv"), newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["answer_1"]:
                judged = {name: (value, value) for name, value in _judge(row).items()}
            else:
                judged = {row["measure"]: (float(row["error_low"]), float(row["error_high"]))}
            for measure, error in judged.items():
                rivals.append(Rival(row["problem"], row["variant"], measure, row["rival"],
                                    row["label"], (float(row["cpu_low"]), float(row["cpu_high"])),
                                    error, row["source"]))
    return rivals
