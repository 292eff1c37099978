#!/usr/bin/env python3
"""kedge's run time: what it costs to be right, where the time goes, how it grows.

    python3 benchmarks/speed/run.py PART [options]

Parts: `suite` (the default) measures run time against error over the problems,
grids, points, steps, bases and programs; the others one thing each. Tables,
pictures and the runs themselves go to the output folder; with --write-doc the
tables and pictures of doc/benchmarks.md are renewed.
"""
import argparse
import importlib.util
import os
import sys
from pathlib import Path

import cases
import studies

ROOT = Path(__file__).resolve().parents[2]
SYSTEM_PYTHON = "/usr/bin/python3"
PARTS = {"suite": "run time against error",
         "cost": "microseconds per material point and Newton iteration of the four kernels",
         "scaling": "time and memory per point from 1e4 to 1e6 points in 2D",
         "ranks": "one and two processes on 2e5 points in 3D",
         "unneeded": "what a scene pays for that it does not use",
         "off": "share of what is compiled in but off",
         "scenes": "the time of all scenes of prm/ as they ship",
         "all": "everything, one after the other"}


def arguments():
    """The command line, parsed."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="parts:\n" + "\n".join(f"  {name:10s}{text}" for name, text in PARTS.items()))
    parser.add_argument("part", nargs="?", default="suite", choices=PARTS, metavar="PART")
    parser.add_argument("--kedge", default=str(ROOT / "build" / "kedge"))
    parser.add_argument("--output", type=Path, default=ROOT / "output" / "speed")
    parser.add_argument("--repeats", type=int, default=3, help="runs of each case (3)")
    parser.add_argument("--write-doc", action="store_true", help="renew doc/benchmarks.md")
    size = parser.add_mutually_exclusive_group()
    for level in cases.LEVELS:
        size.add_argument(f"--{level}", dest="level", action="store_const", const=level)
    parser.set_defaults(level="full")
    parser.add_argument("--case", default="", metavar="NAME",
                        help="suite: only cases whose problem, method and run contain this text")
    parser.add_argument("--compare", metavar="KEDGE",
                        help="suite: another kedge, run in turns with this one")
    parser.add_argument("--no-finite-elements", action="store_true",
                        help="suite: do not build and run the finite element program")
    arg = parser.parse_args()
    if arg.write_doc and arg.case:
        parser.error("--write-doc needs all cases")
    return arg


def need_matplotlib():
    """Goes on with the system's Python if this one has no matplotlib."""
    if importlib.util.find_spec("matplotlib"):
        return
    if os.path.realpath(sys.executable) == os.path.realpath(SYSTEM_PYTHON):
        sys.exit("the pictures need: apt install python3-matplotlib python3-numpy")
    os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, *sys.argv])


def run_suite(arg):
    """The suite, whose pictures need matplotlib."""
    import suite  # pylint: disable=import-outside-toplevel
    return suite.run(arg)


def main():
    """Runs one part or all."""
    arg = arguments()
    arg.output = arg.output.resolve()
    names = [name for name in PARTS if name != "all"] if arg.part == "all" else [arg.part]
    if "suite" in names:
        need_matplotlib()
    sys.exit(max(run_suite(arg) if name == "suite" else studies.PARTS[name](arg)
                 for name in names))


if __name__ == "__main__":
    main()
