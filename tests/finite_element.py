"""Holds the finite element program of the benchmarks to known answers: PROGRAM ROOT FOLDER"""
import csv
import json
import subprocess
import sys
from pathlib import Path

PROGRAM, ROOT, FOLDER = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])


def run(name, **settings):
    """The last rows of history and probes, and the summary."""
    folder = FOLDER / name
    line = [PROGRAM, str(ROOT / "benchmarks" / "finite_element" / f"{name}.prm"), "-o", str(folder)]
    for entry, value in settings.items():
        line += ["-s", f"{entry.replace('_', ' ')} = {value}"]
    subprocess.run(line, check=True)
    rows = {}
    for table in ("history", "probes"):
        with open(folder / f"{table}.csv", newline="", encoding="utf-8") as file:
            rows[table] = {key: float(value) for key, value in list(csv.DictReader(file))[-1].items()}
    return rows["history"], rows["probes"], json.loads((folder / "summary.json").read_text())


def near(name, value, reference, relative):
    """Prints a comparison and ends the test if it fails."""
    print(f"{name}: {value:.8g}, reference {reference:.8g}, off by {value / reference - 1:.1e}")
    if not abs(value / reference - 1) <= relative:
        sys.exit(f"TEST FAILED: {name}")


def column():
    """
    Strain energy of the column in closed form with Lambert's function, W(4) =
    1.2021678732: E^2/(2 rho g) (exp(W) (W^3 - 2 W^2 + 4 W - 4) + 4) = 178387.4 J/m.
    Quadratic elements: O(h^4), 16 of them 6e-6 off.
    """
    history, _, summary = run("column", Degree=2, Cells="1, 16")
    near("column, strain energy", history["strain_energy"], 178387.382, 2e-5)
    if not summary["checks"][0]["value"] < 1e-3:
        sys.exit("TEST FAILED: column, stress")


def cantilever():
    """
    An independent finite element program, checked against CalculiX: bilinear
    elements, 80 x 8, mean of the end face (-5.5339, -8.2670). It spreads the end
    load in another way over the nodes of the end face, worth 1e-4.
    """
    _, probes, _ = run("cantilever_static", Degree=1, Cells="80, 8", Steps=10)
    near("cantilever, tip sideways", probes["tip.displacement_x"], -5.5339, 5e-4)
    near("cantilever, tip down", probes["tip.displacement_y"], -8.2670, 5e-4)


def conservation():
    """The conserving stress keeps the energy of the spinning body: I omega^2/2 = 64000/3 J/m."""
    history, _, _ = run("spinning_body", End=2)
    near("spinning body, energy", history["total_energy"], 64000. / 3., 1e-9)


column()
cantilever()
conservation()
