#!/usr/bin/env python3
"""Finds the safety factor of a quasi-static scene: the largest F by which the strengths of its
materials (cohesion, tan phi, undrained strength, yield stress) can be divided before the loads find
no equilibrium or a point moves by Time/Failure displacement. It runs the scene with
Strength reduction = F, between two factors closer and closer to each other."""
import argparse
import csv
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

EXAMPLES = """examples
  kedge safety prm/slope.prm
  kedge safety prm/slope.prm -s "Constants/phi = 25" --between 1 2.5 --tolerance 0.005

The scene must bear its loads in full at its end, and give Time/Failure displacement. The factors
tried and how each run ended stand in safety.csv; each run has a folder of its own beside it."""


class Wrong(Exception):
    """What the user gave cannot be used, or has no answer."""


def arguments():
    """The command line, parsed."""
    parser = argparse.ArgumentParser(prog="kedge safety", description=__doc__, epilog=EXAMPLES,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", metavar="SCENE")
    parser.add_argument("-s", "--set", action="append", default=[], metavar='"A/B = 1"',
                        help="a setting; repeatable")
    parser.add_argument("--between", nargs=2, type=float, default=[0.5, 4.], metavar=("LOW", "HIGH"),
                        help="it stands with LOW and fails with HIGH (default: 0.5 4)")
    parser.add_argument("--tolerance", type=float, default=0.01, metavar="PART",
                        help="of the factor (default: 0.01)")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count(), metavar="N",
                        help="runs at a time (default: all cores)")
    parser.add_argument("-o", "--output", type=Path, metavar="DIR",
                        help="default: output/<scene name>-safety")
    parser.add_argument("--kedge", type=Path, required=True, help=argparse.SUPPRESS)
    arg = parser.parse_args()
    if arg.jobs < 1:
        parser.error("--jobs must be at least 1")
    if not 0 < arg.between[0] < arg.between[1]:
        parser.error("--between needs two factors greater than 0, the smaller one first")
    if not 0 < arg.tolerance < 1:
        parser.error("--tolerance must lie between 0 and 1")
    return arg


class Trial:
    """The scene with its strengths divided by a factor."""

    def __init__(self, arg, factor):
        self.factor = factor
        self.folder = arg.output / f"F={factor:.5g}"
        line = [arg.kedge, arg.scene, "-o", self.folder]
        for setting in arg.set + [f"Strength reduction = {factor!r}"]:
            line += ["-s", setting]
        done = subprocess.run(list(map(str, line)), stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True, check=False,
                              env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
        if done.returncode not in (0, 2):
            raise Wrong(done.stderr.strip() or f"the run in {self.folder} ended with exit code "
                        f"{done.returncode}")
        self.summary = json.loads((self.folder / "summary.json").read_text("utf-8"))
        self.stands = self.summary["status"] == "finished" and not self.summary.get("reason")
        self.time = self.summary["final"]["time"]
        self.displacement = self.summary.get("largest_displacement", "")

    def verdict(self):
        """A word for the table."""
        if self.stands:
            return "stands"
        return "fails" if self.summary["status"] == "finished" else "stops"

    def say(self):
        """A line for the eyes."""
        print(f"F = {self.factor:<9.5g} {self.verdict():<7} at t = {self.time:<9.6g} "
              f"largest displacement {self.displacement:.4g} m", flush=True)


def check_scene(arg):
    """Refuses what could never fail; kedge itself says what else is wrong."""
    if not Path(arg.scene).is_file():
        raise Wrong(f"there is no scene {arg.scene}")
    line = [arg.kedge, arg.scene, "--validate"]
    for setting in arg.set:
        line += ["-s", setting]
    done = subprocess.run(list(map(str, line)), capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Wrong(done.stderr.strip())


def try_factors(arg, factors, trials):
    """Runs the scene with each; what was learned is kept in trials."""
    with ThreadPoolExecutor(arg.jobs) as pool:
        for trial in pool.map(lambda factor: Trial(arg, factor), factors):
            trial.say()
            trials.append(trial)


def bracket(trials):
    """The largest factor with which it stood below all with which it failed, and the next."""
    failed = min(trial.factor for trial in trials if not trial.stands)
    stood = max((trial.factor for trial in trials if trial.stands and trial.factor < failed),
                default=None)
    return stood, failed


def write_table(trials, path):
    """safety.csv"""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["strength_reduction", "verdict", "time", "largest_displacement",
                         "newton_iterations", "wall_seconds", "folder"])
        for trial in sorted(trials, key=lambda trial: trial.factor):
            writer.writerow([repr(trial.factor), trial.verdict(), trial.time, trial.displacement,
                             trial.summary["newton_iterations"], trial.summary["wall_seconds"],
                             trial.folder.name])


def safety(arg):
    """Narrows the bracket until it is as small as asked for."""
    arg.output = arg.output or Path("output") / (Path(arg.scene).stem + "-safety")
    check_scene(arg)
    arg.output.mkdir(parents=True, exist_ok=True)
    trials = []
    try_factors(arg, arg.between, trials)
    low, high = trials
    if not low.stands:
        raise Wrong(f"it does not even stand with F = {low.factor:g}: take a smaller LOW "
                    "(--between), or look at how the run ended, in " + str(low.folder))
    if high.stands:
        raise Wrong(f"it stands with F = {high.factor:g} too: take a larger HIGH (--between), and "
                    "see to it that the scene gives Time/Failure displacement")
    stood, failed = bracket(trials)
    while failed - stood > arg.tolerance * failed:
        n = arg.jobs + 1 # a part of the bracket between each two neighbours
        try_factors(arg, [stood + (failed - stood) * i / n for i in range(1, n)], trials)
        stood, failed = bracket(trials)
    write_table(trials, arg.output / "safety.csv")
    stops = [trial for trial in trials if trial.verdict() == "stops"]
    if stops:
        print("note: runs that stopped without a limit load counted as failures; how they ended "
              "says log.txt in " + ", ".join(trial.folder.name for trial in stops))
    print(f"safety factor: {0.5 * (stood + failed):.4g} (stands with {stood:.4g}, fails with "
          f"{failed:.4g})")
    print(arg.output / "safety.csv")


def main():
    """Ends with 1 if what the user gave cannot be used."""
    arg = arguments()
    try:
        safety(arg)
    except (Wrong, OSError) as error:
        sys.exit(f"kedge safety: {error}")


if __name__ == "__main__":
    main()
