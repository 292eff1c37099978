#!/usr/bin/env python3
"""The stability bench: runs a matrix of small hard scenes and says how each ended.

    python3 benchmarks/stability/run.py [--short] [--only TEXT] [--output DIR]

One line per case: how it ended (finished, or the diagnosed cause), steps,
rejected attempts, Newton iterations per step, the largest errors of the books (energy over
the largest energy, masses of grains and fluid, linear momentum), the least det F. The table is written to
stability.csv and stability.md in the output folder. The exit code is 1 if a
case neither finished nor was stopped with a cause, left a value that is not
finite, or (with a conserving scheme) lost energy that no term accounts for.
"""
import argparse
import csv
import json
import math
import os
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from cases import all_cases

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
LARGEST_DRIFT = 1e-8
LARGEST_ENERGY_GAIN = 0.1  # of saturated bodies, whose schemes do not conserve
LEAST_ENERGY = 1e-6  # [J] below, energies are round-off of a rigid motion
LARGEST_MASS_ERROR = 1e-10
LARGEST_MOMENTUM_ERROR = 0.01  # see doc/stability.md
ENERGIES = ["kinetic_energy", "strain_energy", "hardening_energy", "plastic_dissipation",
            "stabilisation_energy", "external_work", "fluid_energy", "darcy_dissipation",
            "contact_energy", "friction_dissipation"]
COLUMNS = ["group", "case", "ended", "steps", "rejected", "newton_per_step", "energy_error",
           "mass_error", "momentum_error", "least_det_F", "condition", "seconds", "sound", "cause"]


def arguments():
    """The command line, parsed."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kedge", default=str(ROOT / "build" / "kedge"))
    parser.add_argument("--output", type=Path, default=ROOT / "output" / "stability")
    parser.add_argument("--short", action="store_true", help="the part that the tests run")
    parser.add_argument("--only", default="", help="cases whose group and name contain this text")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--timeout", type=float, default=300, help="seconds for one case")
    parser.add_argument("--set", action="append", default=[], help="for every case, as kedge -s")
    return parser.parse_args()


def command(arg, case, folder):
    """The line that runs a case."""
    scene = (ROOT / "prm" if case.scene_in_prm else HERE) / case.scene
    line = [arg.kedge, str(scene), "-o", str(folder)]
    for name, value in case.settings.items():
        line += ["-s", f"{name} = {value}"]
    for entry in arg.set:
        line += ["-s", entry]
    return line


def largest_change(rows, value, scale):
    """Of a function of a row since the first one, over the scale."""
    return max(abs(value(row) - value(rows[0])) for row in rows) / scale if scale > 0 else 0.


def energy_books(rows, loaded_from):
    """Since the body was loaded, over the largest energy: the largest error of the books, and by
    how much the energy in the bodies exceeds what was there and what was put in."""
    begin = loaded_from * rows[-1]["time"]
    loaded = [row for row in rows if row["time"] >= begin * (1 - 1e-9)]
    start = loaded[0] if loaded_from > 0 else dict.fromkeys(loaded[0], 0.)
    largest = max(abs(row[name] - start[name]) for row in loaded for name in ENERGIES
                  if name in row)
    if largest == 0:
        return 0., 0.
    error = max(abs(row["energy_error"] - start["energy_error"]) for row in loaded)
    excess = [row["total_energy"] - row["external_work"] for row in loaded]
    return error / largest, (max(excess) - excess[0]) / max(largest, LEAST_ENERGY)


def books(folder, case):
    """What the history tells, each over its scale: nothing if there is none.

    energy, gain: see energy_books(); mass: of grains and of fluid less inflow; momentum: largest change of a linear momentum over the momentum at the
    start; det F: least."""
    path = folder / "history.csv"
    if not path.exists():
        return {}
    with open(path, newline="") as file:
        rows = [{name: float(value) for name, value in row.items()}
                for row in csv.DictReader(file)]
    if not rows:
        return {}
    energy, gain = energy_books(rows, case.loaded_from)
    result = {"energy": energy, "gain": gain, "det F": min(row["min_det_F"] for row in rows)}
    components = [name for name in rows[0] if name.startswith("linear_momentum")]
    start = math.hypot(*(rows[0][name] for name in components))
    result["momentum"] = max(largest_change(rows, lambda row: row[name], start)
                             for name in components)
    if "fluid_mass" in rows[0]:
        result["mass"] = max(
            largest_change(rows, lambda row: row["solid_mass"], rows[0]["solid_mass"]),
            largest_change(rows, lambda row: row["fluid_mass"] - row["fluid_inflow"],
                           rows[0]["fluid_mass"]))
        result["porosity"] = min(row["min_porosity"] for row in rows)
    return result


def is_sound(case, ended, found, log):
    """Whether a case ended as it should, with books that close as far as the scheme promises, and
    said so if it lost its pores."""
    if ended not in ("finished", "stopped", "refused"):
        return False
    if not found:
        return ended != "finished"
    if not all(math.isfinite(value) for value in found.values()):
        return False
    if found.get("porosity", 1.) < 0 and "the porosity of a material point" not in log:
        return False
    if case.conserving:
        return found["energy"] <= LARGEST_DRIFT
    return not case.saturated or (found["gain"] <= LARGEST_ENERGY_GAIN and
                                  found["mass"] <= LARGEST_MASS_ERROR and
                                  found["momentum"] <= LARGEST_MOMENTUM_ERROR)


def how_it_ended(code, summary, is_changed):
    """finished, stopped (with a cause), refused (what --set asks for), or what went wrong."""
    if code == 0:
        return "finished"
    if code == 1 and is_changed:
        return "refused"
    if code == 2 and summary.get("reason"):
        return "stopped"
    return "timeout" if code is None else f"failed ({code})"


def run(arg, case, number):
    """Runs one case; a row of the table."""
    folder = arg.output / f"{number:03d}"
    folder.parent.mkdir(parents=True, exist_ok=True)
    begin = time.monotonic()
    try:
        process = subprocess.run(command(arg, case, folder), capture_output=True, text=True,
                                 timeout=arg.timeout, check=False,
                                 env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
        code, errors = process.returncode, process.stderr
    except subprocess.TimeoutExpired:
        code, errors = None, f"no end after {arg.timeout} s"
    path = folder / "summary.json"
    summary = json.loads(path.read_text()) if path.exists() and code is not None else {}
    found = books(folder, case) if code in (0, 2) else {}
    ended = how_it_ended(code, summary, bool(arg.set))
    steps = max(summary.get("steps", 0), 1)
    log = folder / "log.txt"
    sound = is_sound(case, ended, found, log.read_text() if log.exists() else "")

    def figure(name):
        return f"{found.get(name, math.nan):.1e}"
    return {"group": case.group, "case": case.name, "ended": ended,
            "steps": summary.get("steps", 0), "rejected": summary.get("rejected_attempts", 0),
            "newton_per_step": round(summary.get("newton_iterations", 0) / steps, 2),
            "energy_error": figure("energy"), "mass_error": figure("mass"),
            "momentum_error": figure("momentum"),
            "least_det_F": f"{found.get('det F', math.nan):.3f}",
            "condition": f"{summary.get('largest_condition_estimate', math.nan):.1e}",
            "seconds": round(time.monotonic() - begin, 2), "sound": "yes" if sound else "NO",
            "cause": summary.get("reason", "") or errors.strip().splitlines()[-1:] or ""}


def line_of(row):
    """A row as a line on the screen."""
    text = (f"{row['group']:13s} {row['case']:44s} {row['ended']:10s} {row['steps']:6d} steps "
            f"{row['rejected']:4d} rejected {row['newton_per_step']:5.2f} Newton "
            f"energy {row['energy_error']:>8s} mass {row['mass_error']:>8s} "
            f"momentum {row['momentum_error']:>8s} det F {row['least_det_F']:>7s} "
            f"cond {row['condition']:>8s} {row['seconds']:6.1f} s")
    return text + ("" if row["sound"] == "yes" else "  UNSOUND") + \
        (f"\n    {row['cause']}" if row["ended"] != "finished" else "")


def write_tables(rows, folder):
    """stability.csv and stability.md."""
    with open(folder / "stability.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)
    with open(folder / "stability.md", "w") as file:
        file.write("| " + " | ".join(COLUMNS[:-1]) + " |\n")
        file.write("|" + "---|" * (len(COLUMNS) - 1) + "\n")
        for row in rows:
            file.write("| " + " | ".join(str(row[name]) for name in COLUMNS[:-1]) + " |\n")


def print_shares(rows):
    """Per group, and in all: how many finished, how many are sound."""
    groups = list(dict.fromkeys(row["group"] for row in rows))
    for group in groups + [None]:
        part = [row for row in rows if group in (None, row["group"])]
        finished = sum(row["ended"] == "finished" for row in part)
        sound = sum(row["sound"] == "yes" for row in part)
        print(f"{group or 'all':13s} {finished:4d} of {len(part):4d} finished, {sound:4d} sound, "
              f"{sum(row['rejected'] for row in part):6d} attempts rejected")


def main():
    """Runs the bench."""
    arg = arguments()
    cases = [case for case in all_cases()
             if (case.short and "spline" not in case.name or not arg.short)
             and arg.only in f"{case.group} {case.name}"]
    begin = time.monotonic()
    rows = []
    with ThreadPoolExecutor(arg.jobs) as pool:
        for row in pool.map(lambda item: run(arg, item[1], item[0]), enumerate(cases)):
            rows.append(row)
            print(line_of(row), flush=True)
    if not rows:
        sys.exit("no case matches")
    write_tables(rows, arg.output)
    print_shares(rows)
    print(f"{time.monotonic() - begin:.0f} s; tables in {arg.output}")
    sys.exit(0 if all(row["sound"] == "yes" for row in rows) else 1)


if __name__ == "__main__":
    main()
