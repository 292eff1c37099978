"""Runs a command under mpirun, as the tests need it.

    mpirun.py MPIRUN N COMMAND...

More ranks than cores are allowed, ranks are not bound to cores (tests run
side by side and would all be bound to the first), and root may run it.
"""
import os
import subprocess
import sys


def command(mpirun, ranks, program):
    """The command line; one rank runs without mpirun."""
    if ranks == 1:
        return list(program)
    return [mpirun, "-np", str(ranks), "--oversubscribe", "--bind-to", "none", *program]


def environment():
    """The environment for it: Open MPI refuses to run as root unless told."""
    variables = dict(os.environ)
    # ranks that wait give way: tests share their cores with others
    variables["OMPI_MCA_mpi_yield_when_idle"] = "1"
    if os.geteuid() == 0:
        variables["OMPI_ALLOW_RUN_AS_ROOT"] = "1"
        variables["OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"] = "1"
    return variables


if __name__ == "__main__":
    line = command(sys.argv[1], int(sys.argv[2]), sys.argv[3:])
    sys.exit(subprocess.run(line, env=environment(), check=False).returncode)
