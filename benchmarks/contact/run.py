#!/usr/bin/env python3
"""Contact against closed forms on finer and finer grids, and its order of convergence.

    python3 benchmarks/contact/run.py [--kedge PROGRAM] [--output DIR] [--only NAME ...]

Runs scenes of prm/ that carry their answers as checks, with more and more cells, and prints for
each check the error relative to its reference, then the order between the first and the last grid:
log(error ratio) over log(ratio of the sizes of cells). Hertz's line and point contact: force, size and largest
pressure; partial slip under a cylinder (Cattaneo, Mindlin) at four forces; the rolling cylinder of Pretti (2024),
Table 5.3, by the method printed there (augmented Lagrangian at nodes) and by surface points.
"""
import argparse
import json
import math
import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
HERE = Path(__file__).resolve().parent
GRIDS = (40, 50, 60, 70, 80)  # cells per direction of Table 5.3
AT_NODES = {"Contact/rim/Method": "augmented lagrangian", "Contact/rim/Surface spacing": ""}
SERIES = {
    "hertz_line": ("hertz_line.prm", "n", (12, 24, 48), {}),
    "hertz_sphere": (HERE / "hertz_sphere.prm", "n", (8, 16, 24), {}),
    **{f"table 5.3 {name} mu = {mu}":
       ("cylinder_rolling.prm", "n", GRIDS, {"mu": mu, "lay": 0, **method})
       for name, method in (("at nodes", AT_NODES), ("surfaces", {})) for mu in (0.4, 0.2)},
    **{f"cattaneo_mindlin q = {q}": ("cattaneo_mindlin.prm", "n", (16, 24, 32), {"q": q})
       for q in (0.25, 0.5, 0.75, 0.9)},
}


def arguments():
    """The command line, parsed."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kedge", default=str(ROOT / "build" / "kedge"))
    parser.add_argument("--output", type=Path, default=ROOT / "output" / "contact")
    parser.add_argument("--only", nargs="+", choices=list(SERIES), default=list(SERIES))
    return parser.parse_args()


def run(arg, scene, values):
    """One run: its summary; nothing if the numerics stopped it."""
    scene = ROOT / "prm" / scene
    parts = [scene.stem, *(f"{name}{value}" for name, value in values.items())]
    folder = arg.output / re.sub("[^A-Za-z0-9.]+", "_", "_".join(parts))
    line = [arg.kedge, str(scene), "-o", str(folder)]
    for name, value in {**{name if "/" in name else f"Constants/{name}": value
                           for name, value in values.items()},
                        "Output/Points interval": 0}.items():
        line += ["-s", f"{name} = {value}"]
    process = subprocess.run(line, stdout=subprocess.DEVNULL, check=False,
                             env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
    if process.returncode not in (0, 2):
        sys.exit(f"{' '.join(line)} ended with {process.returncode}")
    if process.returncode == 2:
        return None
    return json.loads((folder / "summary.json").read_text())


def main():
    """Runs the series and prints the tables."""
    arg = arguments()
    for name in arg.only:
        scene, constant, sizes, values = SERIES[name]
        print(f"\n{name}: errors relative to the reference")
        errors = {}
        for size in sizes:
            summary = run(arg, scene, {constant: size, **values})
            if summary is None:
                print(f"  {constant} = {size}: stopped before its end", flush=True)
                continue
            for check in summary["checks"]:
                if check["reference"] != 0:
                    errors.setdefault(check["name"], []).append(
                        check["value"] / check["reference"] - 1)
            print(f"  {constant} = {size}: " + ", ".join(
                f"{check} {found[-1]:+.2%}" for check, found in errors.items()) +
                  f"; {summary['cpu_seconds']:.1f} s", flush=True)
        for check, found in errors.items():
            if len(found) == len(sizes) and found[0] != 0 and found[-1] != 0:
                order = math.log(abs(found[0] / found[-1])) / math.log(sizes[-1] / sizes[0])
                print(f"  order of {check}: {order:.2f}")


if __name__ == "__main__":
    main()
