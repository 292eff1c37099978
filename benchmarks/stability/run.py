#!/usr/bin/env python3
"""The stability bench: runs a matrix of small hard scenes and says how each ended.

    python3 benchmarks/stability/run.py [--short] [--only TEXT] [--output DIR]

One line per case: how it ended (finished, or the diagnosed cause), steps,
rejected attempts, Newton iterations per step, the largest error of the energy
books over the largest energy, the least det F. The table is written to
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
ENERGIES = ["kinetic_energy", "strain_energy", "hardening_energy", "plastic_dissipation",
            "stabilisation_energy", "external_work"]
COLUMNS = ["group", "case", "ended", "steps", "rejected", "newton_per_step", "energy_error",
           "least_det_F", "condition", "seconds", "sound", "cause"]


def arguments():
    """The command line, parsed."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kedge", default=str(ROOT / "build" / "kedge"))
    parser.add_argument("--output", type=Path, default=ROOT / "output" / "stability")
    parser.add_argument("--short", action="store_true", help="the two-minute part")
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


def books(folder):
    """Largest error of the energy over the largest energy, least det F; nan if none is there."""
    path = folder / "history.csv"
    if not path.exists():
        return math.nan, math.nan
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    if not rows:
        return math.nan, math.nan
    largest = max(abs(float(row[name])) for row in rows for name in ENERGIES if name in row)
    worst = max(abs(float(row["energy_error"])) for row in rows)
    return (worst / largest if largest > 0 else 0.), min(float(r["min_det_F"]) for r in rows)


def how_it_ended(code, summary):
    """finished, stopped (with a cause), or what went wrong."""
    if code == 0:
        return "finished"
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
    drift, least = books(folder) if code in (0, 2) else (math.nan, math.nan)
    ended = how_it_ended(code, summary)
    steps = max(summary.get("steps", 0), 1)
    sound = ended in ("finished", "stopped") and (math.isfinite(drift) or ended == "stopped")
    if sound and case.conserving and math.isfinite(drift):
        sound = drift <= LARGEST_DRIFT
    return {"group": case.group, "case": case.name, "ended": ended,
            "steps": summary.get("steps", 0), "rejected": summary.get("rejected_attempts", 0),
            "newton_per_step": round(summary.get("newton_iterations", 0) / steps, 2),
            "energy_error": f"{drift:.1e}", "least_det_F": f"{least:.3f}",
            "condition": f"{summary.get('largest_condition_estimate', math.nan):.1e}",
            "seconds": round(time.monotonic() - begin, 2), "sound": "yes" if sound else "NO",
            "cause": summary.get("reason", "") or errors.strip().splitlines()[-1:] or ""}


def line_of(row):
    """A row as a line on the screen."""
    text = (f"{row['group']:13s} {row['case']:44s} {row['ended']:10s} {row['steps']:6d} steps "
            f"{row['rejected']:4d} rejected {row['newton_per_step']:5.2f} Newton "
            f"energy {row['energy_error']:>8s} det F {row['least_det_F']:>7s} "
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
             if (case.short or not arg.short) and arg.only in f"{case.group} {case.name}"]
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
