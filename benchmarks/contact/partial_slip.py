#!/usr/bin/env python3
"""How far a cylinder moves under a tangential force in partial slip, against Cattaneo and Mindlin.

    python3 benchmarks/contact/partial_slip.py [--kedge PROGRAM] [--output DIR] [--cells 16 24 32] [--steps 4 8]
        [--force 0.9] [--half-width 0.18] [--within 0.03]

In two dimensions the displacement of a body under a force has no value of its own: it grows with the logarithm of the
distance to where it is held. What is well defined is the difference to contact without slip. The tractions of both
have one resultant, and what their difference moves far away does not depend on the distance. With

    q(x) = mu p(x; a, P) - mu p(x; c, P - Q/mu),  c^2 = a^2 (1 - Q/mu P)       partial slip (ellipses),
    q_s(x) = Q/(pi sqrt(a^2 - x^2))                                            no slip,

and the surface displacement -2 (1 - nu^2)/(pi E) int q ln|x - xi| d xi of a half plane, twice for two like bodies,

    D(q) = (2 (1 - nu^2) mu P/(pi E)) [q + (1 - q) ln(1 - q)],   q = Q/(mu P),   2 (1 - nu^2) mu P/(pi E) = mu a^2/(4 R).

Contact without slip moves in proportion to the force; hence the displacement u of the upper body's top obeys
u(q) - 2 u(q/2) = D(q) - 2 D(q/2). Runs prm/cattaneo_mindlin.prm with --steps load steps of either force, and prints
the ratio of both sides; exit code 1 if one is off by more than --within. What sticks may creep by a thousandth of a
cell: the difference must be larger than that, so q near 1.
"""
import argparse
import csv
import math
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
FRICTION, RADIUS = 0.5, 10.0  # of the scene


def exact(force, half_width):
    """D(q) - 2 D(q/2) [m]."""
    def beyond(q):
        return q + (1 - q) * math.log(1 - q)
    return FRICTION * half_width**2 / (4 * RADIUS) * (beyond(force) - 2 * beyond(force / 2))


def measured(arg, cells, steps):
    """u(q) - 2 u(q/2) of the top [m]."""
    folder = arg.output / f"partial_slip_{cells}_{steps}"
    line = [arg.kedge, str(ROOT / "prm" / "cattaneo_mindlin.prm"), "-o", str(folder)]
    for setting in (f"Constants/n = {cells}", f"Constants/q = {arg.force}",
                    f"Constants/a = {arg.half_width}", f"Time/Step = {1 / steps}",
                    "Output/Points interval = 0"):
        line += ["-s", setting]
    process = subprocess.run(line, stdout=subprocess.DEVNULL, check=False,
                             env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
    if process.returncode not in (0, 2):  # 2: a check of the scene failed, on a coarse grid
        sys.exit(f"{' '.join(line)} ended with {process.returncode}")
    with open(folder / "probes.csv", encoding="utf-8") as file:
        ways = {round(float(row["time"]), 6): float(row["top.displacement_x"])
                for row in csv.DictReader(file)}
    return (ways[2] - ways[1]) - 2 * (ways[1.5] - ways[1])


def main():
    """Prints a row for each grid and number of steps."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kedge", default=str(ROOT / "build" / "kedge"))
    parser.add_argument("--output", type=Path, default=ROOT / "output" / "contact")
    parser.add_argument("--cells", type=int, nargs="+", default=[16, 24, 32])
    parser.add_argument("--steps", type=int, nargs="+", default=[4, 8])
    parser.add_argument("--force", type=float, default=0.9, help="Q over mu P")
    parser.add_argument("--half-width", type=float, default=0.18, help="of the contact [m]")
    parser.add_argument("--within", type=float, default=math.inf)
    arg = parser.parse_args()
    arg.output.mkdir(parents=True, exist_ok=True)
    reference = exact(arg.force, arg.half_width)
    print(f"u(q) - 2 u(q/2) = {reference:.4e} m by Cattaneo and Mindlin, q = {arg.force}")
    worst = 0.0
    for cells in arg.cells:
        for steps in arg.steps:
            error = measured(arg, cells, steps) / reference - 1
            worst = max(worst, abs(error))
            print(f"  {cells} cells/m, {steps} steps: {error:+.1%}", flush=True)
    sys.exit(worst > arg.within)


if __name__ == "__main__":
    main()
