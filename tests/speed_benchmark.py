"""Runs the short form of the speed benchmark, whatever the times are: KEDGE ROOT FOLDER"""
import csv
import shutil
import subprocess
import sys
from pathlib import Path

KEDGE, ROOT, FOLDER = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])


def demand(condition, message):
    """Ends the test with `message` unless `condition` holds."""
    if not condition:
        sys.exit("TEST FAILED: " + message)


def main():
    """Runs the suite and a part, and looks at what they wrote."""
    shutil.rmtree(FOLDER, ignore_errors=True)
    program = str(ROOT / "benchmarks" / "speed" / "run.py")
    for part in ("suite", "cost"):
        subprocess.run(["/usr/bin/python3", program, part, "--short", "--repeats", "1",
                        "--kedge", KEDGE, "--output", str(FOLDER)], check=True)

    with open(FOLDER / "suite.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    problems = {row["problem"] for row in rows}
    demand(problems >= {"column", "cantilever_static", "spinning_body", "discs", "collapse"},
           f"problems are missing: {problems}")
    demand(all(float(row["user_s"]) > 0 and float(row["memory_MB"]) > 0 for row in rows),
           "a run without time or memory")
    # the same figure as AMPLE 1.1's on the same grid, to the four digits printed
    column = next(row for row in rows if row["problem"] == "column" and "kedge" in row["method"])
    demand(abs(float(column["stress"]) / 3.659e-3 - 1.) < 5e-4, f"stress {column['stress']}")
    # linear elements: constant stress in a cell, at Gauss points h/(2 sqrt 3) off on the mean
    element = next(row for row in rows if row["problem"] == "column" and "FEM" in row["method"])
    demand(abs(float(element["stress"]) * 32. * 3. ** 0.5 - 1.) < 5e-3,
           f"stress of the elements {element['stress']}")
    discs = next(row for row in rows if row["problem"] == "discs")
    demand(float(discs["energy"]) < 1e-10, f"the discs lose energy: {discs['energy']}")
    for name in ("column.png", "column.svg", "collapse.png"):
        demand((FOLDER / "figures" / name).stat().st_size < 300_000, f"{name} is too large")
    demand("AMPLE" in (FOLDER / "suite.md").read_text(encoding="utf-8"), "no rivals in the table")
    with open(FOLDER / "cost.csv", newline="", encoding="utf-8") as file:
        demand(len(list(csv.DictReader(file))) == 4, "cost.csv should have four kernels")


main()
