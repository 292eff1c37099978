#!/usr/bin/env python3
"""How much stresses and velocities of material points scatter within cells, and what a filter costs.

    python3 benchmarks/noise/run.py [--kedge PROGRAM] [--output FOLDER] [--end SECONDS]

Runs prm/quickstart.prm (a ball hits a ring, nothing dissipates) with each basis and with
filters of the velocities (Mapping/Filter time), and prints in percent
  stress    root of the mean square of the points' pressure less the mean of their body in their cell,
            over that of the pressure itself, at the end
  velocity  the same of velocities, over the root of the mean square of velocities less their mean
  lost      energy that the filter has taken over the whole run, of the energy
"""
import argparse
import csv
import subprocess
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "source" / "plot"))
import vtu_reader  # noqa: E402

CELL = 0.125  # of the scene [m]
STEP = 0.005  # of the scene [s]
BODIES = ("ball", "ring")


def scatter(values, groups):
    """Root of the mean square of values less the mean of their group."""
    _, index = np.unique(groups, return_inverse=True)
    index = index.ravel()
    count = np.bincount(index)
    means = np.bincount(index, weights=values) / count
    return np.sqrt(np.mean((values - means[index]) ** 2))


def measure(folder):
    """(stress, velocity, lost) of a finished run, in percent."""
    points = vtu_reader.read_points(vtu_reader.read_pvd(folder / "points.pvd")[-1][1])
    cells = np.floor(points.position[:, :2] / CELL).astype(int)
    groups = (cells[:, 0] * 100000 + cells[:, 1]) * 2 + points.values("body").astype(int) % 2
    pressure = points.values("pressure")
    stress = scatter(pressure, groups) / np.sqrt(np.mean(pressure ** 2))
    parts = [points.values(f"velocity_{axis}") for axis in "xy"]
    whole = np.sqrt(sum(np.var(part) for part in parts))
    velocity = np.sqrt(sum(scatter(part, groups) ** 2 for part in parts)) / whole
    with open(folder / "history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    lost = float(rows[-1].get("mapping_dissipation", 0)) / float(rows[0]["total_energy"])
    return 100 * stress, 100 * velocity, 100 * lost


def main():
    """Runs and prints."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kedge", default=str(ROOT / "build" / "kedge"))
    parser.add_argument("--output", type=Path, default=ROOT / "output" / "noise")
    parser.add_argument("--end", type=float, default=1.2, help="of the runs [s] (1.2)")
    arg = parser.parse_args()
    print("| basis | filter time [steps] | stress [%] | velocity [%] | lost [%] |\n"
          "|---|---|---|---|---|")
    for basis in ("linear", "gimp", "spline"):
        for steps in ("", 100, 20, 5):
            folder = arg.output / f"{basis}_{steps}"
            line = [arg.kedge, str(ROOT / "prm" / "quickstart.prm"), "-o", str(folder),
                    "-s", f"Output/Points interval = {arg.end}", "-s", f"Time/End = {arg.end}",
                    "-s", "Output/Fields = pressure, velocity, body"]
            for body in BODIES:
                line += ["-s", f"Bodies/{body}/Basis = {basis}"]
            if steps:
                line += ["-s", f"Mapping/Filter time = {steps * STEP}"]
            run = subprocess.run(line, capture_output=True, text=True, check=False)
            if "finished" not in run.stdout + run.stderr:
                sys.exit(run.stdout + run.stderr)
            print(f"| {basis} | {steps or 'none'} | "
                  + " | ".join(f"{value:.3g}" for value in measure(folder)) + " |", flush=True)


if __name__ == "__main__":
    main()
