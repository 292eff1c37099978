#!/usr/bin/env python3
"""How far a column of sand comes, against the fits of experiments: cells, points, steps, heights.

    python3 benchmarks/soil/granular_collapse.py build/kedge [--quick]

The scene is prm/granular_collapse.prm, whose checks are made: it comes to rest, the books of energy close to
1e-8 of the weight's energy, and the front lies within 20 % of the fit."""
import argparse
import csv
import subprocess
import sys
import tempfile
from pathlib import Path

SCENE = Path(__file__).resolve().parents[2] / "prm/granular_collapse.prm"
HIGH = ["a = 4", "width = 8*L", "T = 5"]
RUNS = [("8 cells", ["n = 8"]),
        ("16 cells", ["n = 16"]),
        ("32 cells", ["n = 32"]),
        ("16 cells, 3 x 3 points", ["n = 16", "points = 3"]),
        ("16 cells, half the step", ["n = 16", "dt = 0.00125"]),
        ("a = 4, 8 cells", HIGH + ["n = 8"]),
        ("a = 4, 16 cells", HIGH + ["n = 16"])]


def run(kedge, name, constants, folder):
    """Runs the scene and prints a row; true if its checks passed."""
    out = Path(folder) / name.replace(" ", "_")
    command = [kedge, SCENE, "--strict", "-o", out]
    for constant in constants:
        command += ["-s", f"Constants/{constant}"]
    answer = subprocess.run(command, capture_output=True, text=True, check=False)
    checks = {line.split(" ")[1]: line.split() for line in answer.stdout.splitlines()
              if line.startswith(("PASS", "FAIL"))}
    if "front" not in checks:
        print(f"| {name} | {answer.stdout.splitlines()[-1][:80]} |")
        return False
    with open(out / "history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    error = max(abs(float(row["energy_error"])) for row in rows)
    last = {key: float(rows[-1][key]) for key in
            ("external_work", "kinetic_energy", "plastic_dissipation", "mapping_dissipation")}
    _, _, front, fit = checks["front"]
    ran, expected = float(front) - 1, float(fit) - 1
    print(f"| {name} | {ran:.3f} | {expected:.3f} | {100 * (ran / expected - 1):+.0f} % "
          f"| {last['kinetic_energy'] / last['external_work']:.0e} "
          f"| {last['mapping_dissipation'] / last['external_work']:.3f} "
          f"| {error / last['external_work']:.0e} | {len(rows) - 1} |", flush=True)
    return answer.returncode == 0


def main():
    """Prints the table; ends with 1 if a check failed."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kedge", type=Path)
    parser.add_argument("--quick", action="store_true", help="the first run only")
    arg = parser.parse_args()
    print("| run | (l - L)/L | fit | off | kinetic energy left | by the mappings | energy error | steps |\n"
          "|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        passed = [run(arg.kedge.resolve(), name, constants, folder)
                  for name, constants in RUNS[:1 if arg.quick else len(RUNS)]]
    sys.exit(0 if all(passed) else 1)


if __name__ == "__main__":
    main()
