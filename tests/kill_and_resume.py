"""Kills a run with SIGKILL at random moments, resumes it each time, and
demands the books of an uninterrupted run bit for bit.

kedge_add_restart_test in kedge_tests.cmake registers such a test. The scene
must write checkpoints every few steps and should take some seconds.
"""
import argparse
import csv
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import mpirun


def arguments():
    """The command line, parsed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene")
    parser.add_argument("--kedge", required=True)
    parser.add_argument("--mpirun", default="mpirun")
    parser.add_argument("--root", required=True, type=Path)
    parser.add_argument("--output", required=True, type=Path)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(10**6))
    return parser.parse_args()


class Run:
    """One start of the scene, in a process group of its own."""

    def __init__(self, arg, output):
        line = [arg.kedge, arg.scene, "-o", str(output)]
        for entry in arg.set:
            line += ["-s", entry]
        if has_checkpoint(output):
            line.append("--resume")
        else:
            shutil.rmtree(output, ignore_errors=True)
        self.log = open(f"{output}.log", "ab")
        self.begin = time.monotonic()
        self.process = subprocess.Popen(mpirun.command(arg.mpirun, arg.ranks, line),
                                        cwd=arg.root, env=mpirun.environment(),
                                        stdout=self.log, stderr=self.log,
                                        stdin=subprocess.DEVNULL, start_new_session=True)

    def finish(self, seconds=None):
        """Waits; True if it ended by itself, with success."""
        try:
            code = self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            return False
        self.log.close()
        if code != 0:
            print(Path(self.log.name).read_text(encoding="utf-8", errors="replace")[-3000:])
            sys.exit(f"TEST FAILED: kedge ended with {code}")
        return True

    def kill(self):
        """SIGKILL to the process and all below it (mpirun's ranks)."""
        for pid in [*descendants(self.process.pid), self.process.pid]:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        self.process.wait()
        self.log.close()


def descendants(pid):
    """The processes that descend from `pid`."""
    found = []
    for thread in Path(f"/proc/{pid}/task").glob("*/children"):
        for child in thread.read_text(encoding="ascii").split():
            found += [int(child), *descendants(int(child))]
    return found


def has_checkpoint(output):
    """True if a run left a whole state to resume from; what is unfinished has another name."""
    return any((output / "checkpoint").glob("state-*"))


def reference(arg, output):
    """Runs without interruption; gives the seconds until the first row and in all."""
    shutil.rmtree(output, ignore_errors=True)
    run = Run(arg, output)
    first_row = None
    while not run.finish(0.01):
        if first_row is None and (output / "history.csv").exists():
            first_row = time.monotonic() - run.begin
    whole = time.monotonic() - run.begin
    return min(first_row or whole, whole), whole


def interrupted(arg, output, first_row, whole):
    """Kills and resumes until the run is through and was killed often enough."""
    rng = random.Random(arg.seed)
    shortest, longest = 0.2 * first_row, first_row + 3 * (whole - first_row) / arg.kills
    killed = resumed = finished = 0
    shutil.rmtree(output, ignore_errors=True)
    while True:
        if finished and killed < arg.kills:
            shutil.rmtree(output) # through too early: once more from the start
            finished = 0
        resumed += has_checkpoint(output)
        run = Run(arg, output)
        # kills that all came before the first checkpoint prove nothing: a few more
        if killed >= arg.kills and (resumed or killed >= 4 * arg.kills):
            run.finish()
            return killed, resumed
        ended = False
        while killed > 0 and not ended and not has_checkpoint(output):
            ended = run.finish(0.01) # a kill before the first checkpoint proves little: once
        if ended or run.finish(rng.uniform(shortest, longest)):
            compare(arg, output)
            finished = 1
            # the uninterrupted run may have had less of the machine
            shortest, longest = 0.8 * shortest, 0.8 * longest
        else:
            run.kill()
            killed += 1


def books(path):
    """The rows of a table as text, without the wall clock."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    keep = [i for i, name in enumerate(rows[0]) if name.strip() != "wall_time"]
    return [[row[i] for i in keep] for row in rows]


def compare(arg, output):
    """Demands that all books of `output` equal the reference's as text."""
    expected = Path(f"{arg.output}.reference")
    for name in ("history.csv", "probes.csv", "newton.csv", "transfer_audit.csv", "points.pvd",
                 "surfaces.pvd", "rigid_bodies.pvd"):
        if not (expected / name).exists():
            if name == "history.csv":
                sys.exit("TEST FAILED: the run wrote no history.csv")
            continue
        one, two = books(expected / name), books(output / name)
        if one == two:
            continue
        for number, (left, right) in enumerate(zip(one, two), 1):
            if left != right:
                sys.exit(f"TEST FAILED: {name} differs first in line {number}:\n{left}\n{right}")
        sys.exit(f"TEST FAILED: {name} has {len(two)} lines instead of {len(one)}")


def main():
    """The uninterrupted run, then the other; prints what happened."""
    arg = arguments()
    arg.output.parent.mkdir(parents=True, exist_ok=True)
    for log in (Path(f"{arg.output}.log"), Path(f"{arg.output}.reference.log")):
        log.unlink(missing_ok=True)
    print("seed", arg.seed, flush=True)
    first_row, whole = reference(arg, Path(f"{arg.output}.reference"))
    print(f"uninterrupted: {whole:.2f} s, first row after {first_row:.2f} s", flush=True)
    killed, resumed = interrupted(arg, arg.output, first_row, whole)
    compare(arg, arg.output)
    print(f"killed {killed} times, resumed {resumed} times: bit for bit the same")
    if resumed == 0:
        sys.exit("TEST FAILED: no run could be resumed; write checkpoints more often")


if __name__ == "__main__":
    main()
