"""A run that stops at the floor of its step keeps its last good state: resumed
with a smaller floor it gives, bit for bit, the books of a run that had the
smaller floor from the start.

    stop_and_resume.py KEDGE ROOT OUTPUT

The column settles under a load that grows nine times faster from t = 0.5 s
on; three Newton iterations are then too few for the nominal step, and enough
for half of it.
"""
import shutil
import subprocess
import sys
from pathlib import Path

from kill_and_resume import books

LOAD = "Body force/Acceleration = 0; -g*if(t < 0.5, t/5, 0.1 + 1.8*(t - 0.5))"


def run(output, smallest, expected, *options):
    """Runs the scene; gives what it printed."""
    line = [KEDGE, "prm/column_quasi_static.prm", "-o", str(output), *options]
    for entry in (LOAD, "Newton/Iterations = 3", "Newton/Log = true",
                  f"Time/Smallest step factor = {smallest}"):
        line += ["-s", entry]
    done = subprocess.run(line, cwd=ROOT, capture_output=True, text=True, check=False)
    print(done.stdout, done.stderr)
    if done.returncode != expected:
        sys.exit(f"TEST FAILED: exit code {done.returncode} instead of {expected}")
    return done.stdout


KEDGE, ROOT, OUTPUT = sys.argv[1], sys.argv[2], Path(sys.argv[3])
WHOLE = Path(f"{OUTPUT}.whole")
for folder in (OUTPUT, WHOLE):
    shutil.rmtree(folder, ignore_errors=True)
    folder.parent.mkdir(parents=True, exist_ok=True)
run(WHOLE, "1/1024", 0)
if "the step is at its floor" not in run(OUTPUT, "1", 2):
    sys.exit("TEST FAILED: the run did not stop at the floor")
STOPPED = len(books(OUTPUT / "history.csv"))
run(OUTPUT, "1/1024", 0, "--resume")
for name in ("history.csv", "probes.csv", "newton.csv"):
    if books(OUTPUT / name) != books(WHOLE / name):
        sys.exit(f"TEST FAILED: {name} differs from that of the uninterrupted run")
if not 2 < STOPPED < len(books(WHOLE / "history.csv")):
    sys.exit("TEST FAILED: the stop was not on the way")
