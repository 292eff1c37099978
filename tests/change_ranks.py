"""A run that is resumed on another number of ranks, from one to two and back, has the history
of the run on one rank.

    change_ranks.py KEDGE MPIRUN ROOT OUTPUT TOLERANCE

The sums of the ranks differ by round-off, so that the histories agree to TOLERANCE of
each column's scale (see run_scene.py).
"""
import shutil
import subprocess
import sys
from pathlib import Path

import mpirun
from run_scene import compare, read_history

KEDGE, MPIRUN, ROOT, OUTPUT, TOLERANCE = sys.argv[1:]
OUTPUT = Path(OUTPUT)


def run(ranks, folder, end, *options):
    """The spinning body up to a time."""
    line = [KEDGE, "prm/spinning_body.prm", "-o", str(OUTPUT / folder), "-s", "Constants/h = 1",
            "-s", f"Time/End = {end}", "-s", "Output/Points interval = 0", *options]
    done = subprocess.run(mpirun.command(MPIRUN, ranks, line), cwd=ROOT, capture_output=True,
                          text=True, env=mpirun.environment(), check=False)
    print(*line, done.stdout, done.stderr)
    if done.returncode != 0:
        sys.exit(f"TEST FAILED: exit code {done.returncode}")


shutil.rmtree(OUTPUT, ignore_errors=True)
OUTPUT.mkdir(parents=True)
run(1, "whole", 4)
run(1, "parts", 2)
run(2, "parts", 3, "--resume")
run(1, "parts", 4, "--resume")
whole, parts = (read_history(OUTPUT / name) for name in ("whole", "parts"))
compare(whole, parts, float(TOLERANCE), True)
