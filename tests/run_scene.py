"""Runs one scene as a test; kedge_add_scene_test in kedge_tests.cmake explains the options."""
import argparse
import csv
import json
import math
import re
import shutil
import subprocess
import sys
from pathlib import Path

import mpirun

# What may differ between one and two ranks: the clock, and the work of the
# linear solver, whose preconditioner depends on the partition.
NOT_COMPARED = {"wall_time", "linear_iterations", "rejected_attempts"}


def arguments():
    """The command line, parsed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene")
    parser.add_argument("--kedge", required=True)
    parser.add_argument("--mpirun", default="mpirun")
    parser.add_argument("--root", required=True, type=Path)
    parser.add_argument("--output", required=True, type=Path)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--option", action="append", default=[])
    parser.add_argument("--stdin", type=Path)
    parser.add_argument("--expect-exit", type=int, default=0)
    parser.add_argument("--expect-stderr")
    parser.add_argument("--expect-stdout")
    parser.add_argument("--compare-ranks", type=float)
    return parser.parse_args()


def run(arg, ranks, output):
    """Runs the scene into an empty folder `output` and checks how it ends."""
    shutil.rmtree(output, ignore_errors=True)
    output.parent.mkdir(parents=True, exist_ok=True)
    line = [arg.kedge, arg.scene, "--strict", "-o", str(output), *arg.option]
    for entry in arg.set:
        line += ["-s", entry]
    line = mpirun.command(arg.mpirun, ranks, line)
    stdin = open(arg.root / arg.stdin, "rb") if arg.stdin else subprocess.DEVNULL
    done = subprocess.run(line, cwd=arg.root, env=mpirun.environment(), stdin=stdin,
                          capture_output=True, check=False)
    stdout, stderr = (text.decode(errors="replace") for text in (done.stdout, done.stderr))
    print(" ".join(line), stdout, stderr, sep="\n")

    demand(done.returncode == arg.expect_exit,
           f"exit code {done.returncode} instead of {arg.expect_exit}")
    for name, pattern, text in (("stderr", arg.expect_stderr, stderr),
                                ("stdout", arg.expect_stdout, stdout)):
        if pattern is not None:
            demand(re.search(pattern, text), f"'{pattern}' not found on {name}")
    if arg.expect_exit == 0 and arg.expect_stdout is None and arg.expect_stderr is None:
        demand(re.search(r"^PASS ", stdout, re.MULTILINE), "the scene made no check")
        demand(not re.search(r"^FAIL ", stdout, re.MULTILINE), "a check of the scene failed")


def demand(condition, message):
    """Ends the test with `message` unless `condition` holds."""
    if not condition:
        sys.exit("TEST FAILED: " + message)


def read_history(folder):
    """history.csv as a dictionary from column to list of numbers."""
    with open(folder / "history.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file, skipinitialspace=True))
    demand(rows, f"{folder}/history.csv is empty")
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


def scales(history):
    """The magnitude that a difference in each column is measured against."""
    largest = {name: max(abs(value) for value in values) for name, values in history.items()}
    energy = max(largest[name] for name in largest
                 if name.endswith("_energy") or name == "external_work")
    momentum = math.sqrt(2 * largest["mass"] * largest["kinetic_energy"])
    for name in largest:
        if "momentum" in name or "torque" in name:
            largest[name] = max(largest[name], momentum)
        elif name == "fluid_error":
            largest[name] = largest["fluid_mass"]
        elif re.search("_(energy|work|error)(_|$)", name):  # of the whole, or of one field
            # one book: what is round-off of the whole is no difference in a part
            largest[name] = max(largest[name], energy)
    return largest


def iterates(folder):
    """Whether the run's linear systems were solved by iteration."""
    return json.loads((folder / "summary.json").read_text("utf-8"))["linear_iterations"] > 0


def compare(one, two, tolerance, same_solver):
    """
    Demands that two histories agree; prints the largest difference of each column.
    Iterations can be compared only with the same kind of solver: one that iterates
    itself solves no better than Newton's method needs.
    """
    demand(list(one) == list(two), f"columns differ: {list(one)} and {list(two)}")
    demand(len(one["step"]) == len(two["step"]),
           f"{len(one['step'])} and {len(two['step'])} steps")
    scale = scales(one)
    bad = []
    for name in one:
        if name in NOT_COMPARED:
            continue
        difference = max(abs(a - b) for a, b in zip(one[name], two[name]))
        if name == "newton_iterations":
            # one more or less happens when a residual lands on the criterion of convergence,
            # another one when it lands on that of the iterations added for the books
            good, relative = difference <= 2 or not same_solver, difference
        else:
            relative = difference / scale[name] if difference > 0 else 0.0
            good = relative <= tolerance
        print(f"{name:28} {relative:.3e} {'' if good else 'DIFFERS'}")
        if not good:
            bad.append(name)
    demand(not bad, "1 and 2 ranks differ in " + ", ".join(bad))


def main():
    """Runs on the ranks asked for, or on one and two and compares."""
    arg = arguments()
    if arg.compare_ranks is None:
        run(arg, arg.ranks, arg.output)
        return
    outputs = [Path(f"{arg.output}.{ranks}rank") for ranks in (1, 2)]
    for ranks, output in zip((1, 2), outputs):
        run(arg, ranks, output)
    compare(*(read_history(output) for output in outputs), arg.compare_ranks,
            iterates(outputs[0]) == iterates(outputs[1]))


if __name__ == "__main__":
    main()
