"""Draws the table that a tutorial's program writes: its columns over the first one.

    draw_table.py TABLE.csv PICTURE.png "what is across [unit]" "what is up [unit]"

The first of the columns, what was computed, as points, the others as lines.
"""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def main():
    """One figure of all columns."""
    table, picture, across, up = sys.argv[1:]
    with open(table, newline="", encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    columns = list(zip(*[[float(word) for word in row] for row in rows]))
    figure, axes = plt.subplots(figsize=(7, 3.6), layout="constrained")
    for number, (name, column) in enumerate(zip(names[1:], columns[1:])):
        style = {"ls": "", "marker": "o", "ms": 4} if number == 0 else {"lw": 1.3}
        axes.plot(columns[0], column, label=name, zorder=3 if number == 0 else 2, **style)
    axes.set(xlabel=across, ylabel=up)
    axes.legend()
    axes.grid(alpha=0.3)
    figure.savefig(picture, dpi=120)


if __name__ == "__main__":
    main()
