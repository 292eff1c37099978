"""Runs programs and says what they cost: user time, wall time, peak memory."""
import os
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

# A command is not repeated once its runs have taken this long in all [s].
LONG_ENOUGH = 20.


@dataclass
class Sample:
    """What one run of a program cost."""
    user: float    # [s], all threads and ranks
    system: float  # [s]
    wall: float    # [s]
    memory: float  # [MB], of the largest process
    code: int      # its exit code


@dataclass
class Cost:
    """The samples of one command."""
    samples: list = field(default_factory=list)

    def median(self, name):
        """The median of one of the figures."""
        return statistics.median(getattr(sample, name) for sample in self.samples)

    @property
    def code(self):
        """The first exit code that is not 0, else 0."""
        return next((sample.code for sample in self.samples if sample.code), 0)


def environment():
    """One thread per process, so that user time is the work that is done."""
    threads = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    root = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    return {**os.environ, **threads, **root}


def run_once(command, log):
    """Runs a command once with its output in the file `log`."""
    log = Path(log)
    log.parent.mkdir(parents=True, exist_ok=True)
    with open(log, "wb") as file:
        begin = time.monotonic()
        process = subprocess.Popen(command, stdout=file, stderr=subprocess.STDOUT,
                                   stdin=subprocess.DEVNULL, env=environment())
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.monotonic() - begin
    process.returncode = os.waitstatus_to_exitcode(status)
    return Sample(usage.ru_utime, usage.ru_stime, wall, usage.ru_maxrss / 1024.,
                  process.returncode)


def run_interleaved(commands, logs, repeats):
    """
    Runs commands in turns, A B C A B C ..., so that a machine that slows down
    slows all of them. A cost per command.
    """
    costs = [Cost() for _ in commands]
    for _ in range(repeats):
        for command, log, cost in zip(commands, logs, costs):
            spent = sum(sample.wall for sample in cost.samples)
            if not cost.code and (spent == 0. or spent < LONG_ENOUGH):
                cost.samples.append(run_once(command, log))
    return costs


def ratio(first, second, name="user", offset=0.):
    """The median of the ratios of two commands' figures, less an offset, turn by turn."""
    return statistics.median((getattr(a, name) - offset) / (getattr(b, name) - offset)
                             for a, b in zip(first.samples, second.samples))


def demand(cost, command, log):
    """Ends the program if a run failed, with the end of what it said."""
    if cost.code:
        text = Path(log).read_text(errors="replace").strip().splitlines()[-5:]
        sys.exit(f"exit code {cost.code}: {' '.join(map(str, command))}\n" + "\n".join(text))
