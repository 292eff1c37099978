"""Newton's method converges quadratically: the order that newton.csv observes.

    newton_order.py KEDGE ROOT OUTPUT

For r_{k+1} = C r_k^2 the observed order log(r_{k+1}/r_k) / log(r_k/r_{k-1})
tends to 2; it is read where the end phase has begun (r_k < r_{k-1}/30) and
r_{k+1} is still far above round-off (1e-12 of the first residual). Looked at
are a soft column (quasi-static, GIMP) and a spinning body with the conserving
stress, whose tangent is unsymmetric. With a wrong tangent the order tends to 1.
"""
import csv
import math
import shutil
import subprocess
import sys
from pathlib import Path

LOWEST, FEWEST = 1.8, 20


def orders(kedge, root, output, scene, settings):
    """The observed orders of all attempts of a run that are in the end phase."""
    shutil.rmtree(output, ignore_errors=True)
    line = [kedge, scene, "-o", str(output), "-s", "Newton/Log = true"]
    for entry in settings:
        line += ["-s", entry]
    subprocess.run(line, cwd=root, check=True)
    with open(output / "newton.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    found, residuals = [], []
    for row in rows:
        if row["iteration"] == "0":
            residuals = []
        residuals.append(float(row["residual"]))
        order = float(row["order"])
        if math.isnan(order):
            continue
        recomputed = (math.log(residuals[-1] / residuals[-2]) /
                      math.log(residuals[-2] / residuals[-3]))
        if abs(order - recomputed) > 1e-9 * abs(order):
            sys.exit(f"TEST FAILED: order {order} is not that of {residuals}")
        if residuals[-2] < residuals[-3] / 30 and residuals[-1] > 1e-12 * residuals[0]:
            found.append(order)
    return found


def main():
    """Both scenes; every order must be high enough."""
    kedge, root, output = sys.argv[1], sys.argv[2], Path(sys.argv[3])
    output.parent.mkdir(parents=True, exist_ok=True)
    for scene, settings in (("prm/column_quasi_static.prm", ()),
                            ("prm/spinning_body.prm", ("Time/End = 2",))):
        found = orders(kedge, root, output, scene, settings)
        print(scene, "orders from", min(found, default=0), "to", max(found, default=0),
              "in", len(found), "attempts")
        if len(found) < FEWEST:
            sys.exit(f"TEST FAILED: only {len(found)} attempts reach the end phase")
        if min(found) < LOWEST:
            sys.exit(f"TEST FAILED: order {min(found)}")


if __name__ == "__main__":
    main()
