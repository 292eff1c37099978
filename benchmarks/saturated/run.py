#!/usr/bin/env python3
"""Iterations and times of the block solver for saturated soil, from undrained to drained.

    python3 benchmarks/saturated/run.py [--kedge PROGRAM] [--output DIR] [--meshes N ...]
        [--conductivities K ...] [--dynamic] [--no-direct]
        [--set NAME=VALUE ...] [--limit FACTOR]

Runs strip.prm at every size and conductivity with `krylov-blocks` and, at the
first conductivity, `direct`; prints a table of all GMRES iterations per step (of
Newton's three or four linear systems) and the time of the linear solves per step. With --limit the exit code
is 1 if iterations grow by more than this factor over the table.
"""
import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
DYNAMIC = {"Time/Scheme": "trapezoidal", "Constants/dt": "0.01"}


def arguments():
    """The command line, parsed."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kedge", default=str(ROOT / "build" / "kedge"))
    parser.add_argument("--output", type=Path, default=ROOT / "output" / "saturated")
    parser.add_argument("--meshes", type=int, nargs="+", default=[16, 32, 64, 128])
    parser.add_argument("--conductivities", nargs="+",
                        default=["1e-2", "1e-4", "1e-6", "1e-8", "1e-10", "1e-12"])
    parser.add_argument("--dynamic", action="store_true", help="with inertia, steps of 0.01 s")
    parser.add_argument("--no-direct", action="store_true", help="the block solver alone")
    parser.add_argument("--set", action="append", default=[], help="for every run, NAME=VALUE")
    parser.add_argument("--limit", type=float, help="largest growth of iterations [-]")
    return parser.parse_args()


def run(arg, mesh, conductivity, method):
    """One run: its summary, with iterations and time per step."""
    folder = arg.output / f"{method}_{mesh}_{conductivity}"
    settings = {"Constants/n": mesh, "Constants/k": conductivity,
                "Linear solver/Method": method, **(DYNAMIC if arg.dynamic else {})}
    line = [arg.kedge, str(HERE / "strip.prm"), "-o", str(folder)]
    for name, value in settings.items():
        line += ["-s", f"{name} = {value}"]
    for entry in arg.set:
        line += ["-s", entry]
    subprocess.run(line, check=True, stdout=subprocess.DEVNULL,
                   env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
    summary = json.loads((folder / "summary.json").read_text())
    steps = summary["steps"]
    summary["per_step"] = summary["linear_iterations"] / steps
    summary["solve"] = summary["phase_cpu_seconds"]["linear solve"] / steps
    return summary


def main():
    """Writes the table."""
    arg = arguments()
    rows = []
    for mesh in arg.meshes:
        runs = [run(arg, mesh, k, "krylov-blocks") for k in arg.conductivities]
        direct = "-"
        if not arg.no_direct:
            direct = f"{1e3 * run(arg, mesh, arg.conductivities[0], 'direct')['solve']:.1f}"
        rows.append([mesh, runs[0]["counts"]["dofs"], *[f"{r['per_step']:.1f}" for r in runs],
                     f"{1e3 * sum(r['solve'] for r in runs) / len(runs):.1f}", direct])
        print(rows[-1], flush=True)
    heads = ["cells", "unknowns", *[f"{k} m/s" for k in arg.conductivities],
             "ms, blocks", "ms, direct"]
    table = "| " + " | ".join(heads) + " |\n|" + "---|" * len(heads) + "\n"
    table += "".join("| " + " | ".join(map(str, row)) + " |\n" for row in rows)
    (arg.output / "table.md").write_text(table, encoding="utf-8")
    counts = [float(x) for row in rows for x in row[2:-2]]
    print(f"{table}\niterations grow by {max(counts) / min(counts):.2f}")
    if arg.limit and max(counts) > arg.limit * min(counts):
        sys.exit(1)


if __name__ == "__main__":
    main()
