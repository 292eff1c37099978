"""SIGUSR1 to mpirun ends a run on two ranks with a checkpoint and the exit code 3.

    stop_mpirun.py KEDGE MPIRUN ROOT OUTPUT
"""
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import mpirun

KEDGE, MPIRUN, ROOT, OUTPUT = sys.argv[1:]
shutil.rmtree(OUTPUT, ignore_errors=True)
line = mpirun.command(MPIRUN, 2, [KEDGE, "prm/spinning_body.prm", "-o", OUTPUT, "-s",
                                  "Constants/h = 1", "-s", "Time/End = 1e6", "-s",
                                  "Output/Points interval = 1e5"])
with subprocess.Popen(line, cwd=ROOT, env=mpirun.environment(), stdout=subprocess.PIPE,
                      text=True) as run:
    while "step " not in (said := run.stdout.readline()):
        if not said:
            sys.exit("TEST FAILED: the run ended before its first step")
        time.sleep(0.01)
    run.send_signal(signal.SIGUSR1)
    print(run.stdout.read())
if run.returncode != 3:
    sys.exit(f"TEST FAILED: exit code {run.returncode} instead of 3")
if not list(Path(OUTPUT).glob("checkpoint/state-*/manifest.txt")):
    sys.exit("TEST FAILED: there is no checkpoint")
