#!/usr/bin/env python3
"""Terzaghi's consolidation: errors over step and cell, and the overshoot of the first step.

    python3 benchmarks/saturated/terzaghi.py [--kedge PROGRAM] [--output DIR]
        [--cells N ...] [--steps SECONDS ...] [--limit PERCENT]

Runs prm/terzaghi.prm with its small load and a fluid that is all but
incompressible, as the series has it. The first table holds the largest error of
the pressure of a material point at T = 0.05 over the load and the order between
neighbours; the second the largest pressure over the load less one after a single step,
of three pairs of spaces, with the step over h^2/(6 c_v), below which an
implicit step on linear elements cannot be monotonic (Vermeer and Verruijt 1981).
With --limit the exit code is 1 if a step above that limit overshoots by more.
"""
import argparse
import math
import os
import subprocess
import sys
from pathlib import Path

import with_numpy  # noqa: F401 pylint: disable=unused-import

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(ROOT / "source" / "plot"))
import vtu_reader  # noqa: E402

LOAD, C_V = 100., 0.01
PAIRS = {
    "equal, PPP": {"Pore fluid/Pressure space": "equal"},
    "GIMP on half cells, coarse": {"Pore fluid/Pressure space": "coarse",
                                   "Bodies/column/Points per cell": 4},
    "Q2-Q1": {"Pore fluid/Pressure space": "coarse", "Bodies/column/Basis": "quadratic",
              "Bodies/column/Points per cell": 4},
}


def arguments():
    """The command line, parsed."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kedge", default=str(ROOT / "build" / "kedge"))
    parser.add_argument("--output", type=Path, default=ROOT / "output" / "terzaghi_orders")
    parser.add_argument("--cells", type=int, nargs="+", default=[10, 20, 40, 80])
    parser.add_argument("--steps", type=float, nargs="+", default=[0.5, 0.25, 0.125, 0.0625, 0.005])
    parser.add_argument("--limit", type=float, help="largest overshoot above h^2/(6 c_v) [%%]")
    return parser.parse_args()


def series(depth, factor):
    """p over the load at a depth over H below the drained end, (4.191)."""
    terms = [math.pi * (m + 0.5) for m in range(400)]
    return sum(2 / M * math.sin(M * depth) * math.exp(-M * M * factor) for M in terms)


def pressures(arg, cells, end, step, settings):
    """(depth, pressure over the load) of all points at T = end."""
    folder = arg.output / "run"
    all_settings = {"Constants/n": cells, "Constants/T": end, "Constants/dt": step,
                    "Pore fluid/Bulk modulus": 2.2e14, "Output/Points interval": 1e9, **settings}
    line = [arg.kedge, str(ROOT / "prm" / "terzaghi.prm"), "-o", str(folder)]
    for name, value in all_settings.items():
        line += ["-s", f"{name} = {value}"]
    subprocess.run(line, check=True, stdout=subprocess.DEVNULL,
                   env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
    points = vtu_reader.read_points(vtu_reader.read_pvd(folder / "points.pvd")[-1][1])
    place = points.position[:, 1] - points.values("displacement_y")
    return [(1. - y, p / LOAD) for y, p in zip(place, points.values("pore_pressure"))]


def largest_error(arg, cells, step, end=0.05):
    """Of any point at T = end, over the load."""
    exact = {}
    return max(abs(p - exact.setdefault(depth, series(depth, end)))
               for depth, p in pressures(arg, cells, end, step, {}))


def table(heads, rows):
    """Markdown."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines) + "\n"


def order_table(arg):
    """Errors, with the order to the left (step) and above (cells) in brackets."""
    errors = [[largest_error(arg, n, dt) for dt in arg.steps] for n in arg.cells]
    rows = []
    for i, n in enumerate(arg.cells):
        row = [n]
        for j, error in enumerate(errors[i]):
            text = f"{error:.2e}"
            if i > 0:
                order = math.log(errors[i - 1][j] / error) / math.log(n / arg.cells[i - 1])
                text += f" (h^{order:.2f})"
            row.append(text)
        rows.append(row)
    rows.append(["order in the step"] + [""] + [
        f"{math.log(errors[-1][j - 1] / errors[-1][j]) / math.log(arg.steps[j - 1] / arg.steps[j]):.2f}"
        for j in range(1, len(arg.steps))])
    return table(["cells"] + [f"dt = {dt:g} s" for dt in arg.steps], rows)


def overshoot_table(arg, cells=40):
    """After one step; and the largest overshoot of a step above h^2/(6 c_v) [%]."""
    limit = 1. / (6. * cells * cells)
    worst, rows = 0., []
    for end in (1e-6, 1e-5, 5e-5, 1.05 * limit, 2e-4, 5e-4, 1e-3):
        row = [f"{end:.3g}", f"{end / limit:.2f}"]
        for settings in PAIRS.values():
            over = 100. * max(0., max(p for _, p in pressures(arg, cells, end, end / C_V, settings))
                              - 1.)
            if end > limit:
                worst = max(worst, over)
            row.append(f"{over:.2f} %")
        rows.append(row)
    return table(["T of the step", "dt/(h^2/(6 c_v))", *PAIRS], rows), worst


def main():
    """Writes both tables."""
    arg = arguments()
    orders = order_table(arg)
    overshoots, worst = overshoot_table(arg)
    text = f"{orders}\n{overshoots}"
    (arg.output / "table.md").write_text(text, encoding="utf-8")
    print(text)
    if arg.limit is not None and worst > arg.limit:
        sys.exit(f"a step above h^2/(6 c_v) overshoots by {worst:.2f} %")


if __name__ == "__main__":
    main()
