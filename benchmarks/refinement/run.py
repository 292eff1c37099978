#!/usr/bin/env python3
"""Time against error of grids with small cells where they matter, beside equal cells.

    python3 benchmarks/refinement/run.py [SCENE] [--kedge PROGRAM] [--output FOLDER] [--runs N]

Runs prm/strip_footing.prm (a strip held by nodes) or prm/strip_rigid.prm (a rigid body in contact) with
equal cells and with cells that are halved again and again towards the strip, in turn, and prints the limit load in
units of Prandtl's, points, unknowns, and the least of the times (user and system) of the runs.
"""
import argparse
import csv
import math
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

EDGE = "max(abs(x - 1), -y)"  # distance from the strip's edge and from the surface [half widths]
CASES = {
    "strip_footing": [
        ("equal cells", 8, ""), ("equal cells", 16, ""), ("equal cells", 32, ""),
        ("halved once", 4, f"if({EDGE} < 1.25, 1, 0)"),
        ("halved twice", 8, f"if({EDGE} < 0.25, 2, if({EDGE} < 0.5, 1, 0))"),
        ("halved three times", 8,
         f"if({EDGE} < 0.125, 3, if({EDGE} < 0.25, 2, if({EDGE} < 0.5, 1, 0)))")],
    "strip_rigid": [
        ("equal cells", 8, ""), ("equal cells", 16, ""), ("equal cells", 32, ""),
        ("halved once", 8, "if(distance < 1, 1, 0)"),
        ("halved twice", 8, "if(distance < 0.3, 2, if(distance < 1, 1, 0))")]}
# of half the strip: what the column is over (2 + pi) c B
LOAD = {"strip_footing": ("reaction_footing_y", -(2 + math.pi) * 1e4 / math.sqrt(2)),
        "strip_rigid": ("reaction_footing_y", -(2 + math.pi) * 1e4 / 2)}


def run(kedge, folder, scene, n, refinement):
    """(load, points, unknowns, seconds) of a run."""
    line = [kedge, str(ROOT / "prm" / f"{scene}.prm"), "-o", str(folder),
            "-s", f"Constants/n = {n}", "-s", f"Grid/Refinement = {refinement}",
            "-s", "Output/Points interval = 0"]
    before = os.times()
    done = subprocess.run(line, capture_output=True, text=True, check=False)
    after = os.times()
    if "finished" not in done.stdout + done.stderr:
        sys.exit(done.stdout + done.stderr)
    with open(folder / "history.csv", encoding="utf-8") as file:
        last = list(csv.DictReader(file))[-1]
    column, limit = LOAD[scene]
    seconds = (after.children_user - before.children_user
               + after.children_system - before.children_system)
    return float(last[column]) / limit, last["n_points"], last["n_dofs"], seconds


def main():
    """Runs and prints."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="?", choices=sorted(CASES), default="strip_footing")
    parser.add_argument("--kedge", default=str(ROOT / "build" / "kedge"))
    parser.add_argument("--output", type=Path, default=ROOT / "output" / "refinement")
    parser.add_argument("--runs", type=int, default=3, help="of each grid (3)")
    arg = parser.parse_args()
    cases = CASES[arg.scene]
    results = [[] for _ in cases]
    for _ in range(arg.runs):
        for number, (_, n, refinement) in enumerate(cases):
            results[number].append(run(arg.kedge, arg.output / str(number), arg.scene, n,
                                       refinement))
    print("| grid | n | load | points | unknowns | time [s] |\n|---|---|---|---|---|---|")
    for (name, n, _), runs in zip(cases, results):
        load, points, unknowns, _ = runs[0]
        seconds = min(r[3] for r in runs)
        print(f"| {name} | {n} | {load:.4f} | {points} | {unknowns} | {seconds:.2f} |")


if __name__ == "__main__":
    main()
