"""Throws random and damaged scenes at kedge.

    fuzz.py KEDGE SCENES OUTPUT [--seed N] [--cases N] [--seconds S]

Half of the cases are small random scenes, which run; a quarter are mutations of such,
which run too; a quarter are mutations of the scenes in the folder SCENES, which are only
validated. Whatever the scene, kedge must end with the exit code 0, 1 or 2 (3 if it is
told to stop because it takes long; kept in OUTPUT/slow), say in plain words what is wrong, and write finite
numbers. A scene that breaks this is kept in OUTPUT/failures.

The same seed gives the same scenes. By hand, for as long as you like:

    python3 tests/fuzz/fuzz.py build/kedge prm /tmp/fuzz --seed 7 --cases 100000 --seconds 36000
"""
import argparse
import csv
import math
import random as random_module
import resource
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

from scene_generator import generate, mutate

FORBIDDEN = ("internal error", "terminate called", "Traceback", "PETSC ERROR", "Segmentation",
             "runtime error", "AddressSanitizer", "LeakSanitizer")
LONGEST_RUN = 20 # [s] wall time; then it is told to stop
LONGEST_STOP = 60
MOST_MEMORY = 6 << 30
LONGEST_MESSAGE = 10000


def arguments():
    """The command line, parsed."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kedge", type=Path)
    parser.add_argument("scenes", type=Path)
    parser.add_argument("output", type=Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cases", type=int, default=160)
    parser.add_argument("--seconds", type=float, default=120, help="stop after so long")
    parser.add_argument("--only", type=int, help="the number of a single case")
    parser.add_argument("--no-memory-limit", action="store_true", help="for sanitizers")
    return parser.parse_args()


def make_case(seed, number, scenes):
    """The text of a case, and whether it is only validated."""
    random = random_module.Random(f"{seed}-{number}")
    kind = number % 4
    if kind < 2:
        return generate(random), False
    if kind == 2:
        return mutate(random, generate(random), generate(random)), False
    first, second = (random.choice(scenes).read_text("utf-8") for _ in range(2))
    return mutate(random, first, second), True


def limit_memory():
    """In the child: what it may take."""
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))


def run(arg, scene, validate, folder):
    """Runs a scene; returns exit code, standard error, and whether it had to be stopped."""
    line = [arg.kedge.resolve(), scene.resolve(), "-o", folder]
    if validate:
        line.append("--validate")
    with open(folder.with_suffix(".err"), "wb") as errors:
        process = subprocess.Popen(line, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=errors,
                                   preexec_fn=None if arg.no_memory_limit else limit_memory)
        stopped = False
        try:
            process.wait(LONGEST_RUN)
        except subprocess.TimeoutExpired:
            stopped = True
            process.send_signal(signal.SIGTERM)
            try:
                process.wait(LONGEST_STOP)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
    return process.returncode, folder.with_suffix(".err").read_text("utf-8", "replace"), stopped


def faults(code, errors, stopped, folder):
    """What is wrong with how a run ended."""
    # before the first step there is nothing to save, and the signal ends the process
    allowed = (0, 1, 2, 3, -signal.SIGTERM) if stopped else (0, 1, 2)
    if code not in allowed:
        yield f"exit code {code}"
    for text in FORBIDDEN:
        if text in errors:
            yield f"'{text}' on stderr"
    if code == 1 and not errors.startswith("kedge: "):
        yield "exit code 1 without a message"
    if len(errors) > LONGEST_MESSAGE:
        yield f"a message of {len(errors)} characters"
    for table in ("history.csv", "probes.csv"):
        path = folder / table
        if path.exists():
            yield from bad_numbers(path)


def bad_numbers(path):
    """Columns of a table that hold something else than finite numbers; one fault each."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    bad = {rows[0][i] for row in rows[1:] if len(row) == len(rows[0])
           for i, cell in enumerate(row) if not math.isfinite(float(cell))}
    if bad:
        yield f"{path.name} has numbers that are not finite: {', '.join(sorted(bad))}"


def main():
    """Runs the cases, counts, and ends with 1 if one failed."""
    arg = arguments()
    shutil.rmtree(arg.output, ignore_errors=True)
    arg.output.mkdir(parents=True)
    scenes = sorted(arg.scenes.rglob("*.prm"))
    begin, codes, failed, n_stopped = time.monotonic(), {}, [], 0
    numbers = range(arg.cases) if arg.only is None else [arg.only]
    for number in numbers:
        if time.monotonic() - begin > arg.seconds:
            break
        text, validate = make_case(arg.seed, number, scenes)
        scene, folder = arg.output / "scene.prm", arg.output / "run"
        scene.write_text(text, "utf-8", errors="surrogateescape")
        shutil.rmtree(folder, ignore_errors=True)
        code, errors, stopped = run(arg, scene, validate, folder)
        codes[code] = codes.get(code, 0) + 1
        n_stopped += stopped
        if stopped:
            keep = arg.output / "slow" / f"{arg.seed}-{number}.prm"
            keep.parent.mkdir(exist_ok=True)
            shutil.copy(scene, keep)
        found = list(faults(code, errors, stopped, folder))
        if found:
            keep = arg.output / "failures" / f"{arg.seed}-{number}.prm"
            keep.parent.mkdir(exist_ok=True)
            shutil.copy(scene, keep)
            failed.append(number)
            print(f"case {number}{' (--validate)' if validate else ''}: {'; '.join(found)}\n"
                  f"  {keep}\n  {errors[:500].strip()}", flush=True)
    print(f"{sum(codes.values())} scenes, seed {arg.seed}: exit codes "
          + ", ".join(f"{code}: {count}" for code, count in sorted(codes.items()))
          + f"; {n_stopped} stopped; {len(failed)} failed")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
