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
            last = list(csv.DictReader(file))[-1]
            rows[table] = {key: float(value) for key, value in last.items()}
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


def swing():
    """
    The same independent program, bilinear, 20 x 2, with steps of 0.2 s: the cantilever
    let go swings with a period of 50.90 s; tip at release -1.6817 m. Steps of 0.625 s
    are worth 2e-4 of both.
    """
    run("cantilever_dynamic_a", Degree=1, Cells="20, 2")
    with open(FOLDER / "cantilever_dynamic_a" / "probes.csv", newline="", encoding="utf-8") as file:
        rows = [(float(row["time"]), float(row["tip.displacement_y"]))
                for row in csv.DictReader(file)]
    release = next(tip for time, tip in rows if time > 25. - 1e-6)
    near("cantilever, tip at release", release, -1.6817, 1e-3)
    zeros = [t0 + (t1 - t0) * u0 / (u0 - u1) for (t0, u0), (t1, u1) in zip(rows, rows[1:])
             if t0 > 25. - 1e-6 and u0 * u1 < 0.]
    near("cantilever, period", 2. * (zeros[-1] - zeros[0]) / (len(zeros) - 1), 50.90, 1e-3)


def conservation():
    """The conserving stress keeps the energy of the spinning body: I omega^2/2 = 64000/3 J/m."""
    history, _, _ = run("spinning_body", End=2)
    near("spinning body, energy", history["total_energy"], 64000. / 3., 1e-9)


column()
cantilever()
swing()
conservation()
