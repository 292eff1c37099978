#!/usr/bin/env python3
"""Iterations and times of multigrid for quasi-static bodies in space.

    python3 benchmarks/multigrid/run.py [--kedge PROGRAM] [--before PROGRAM] [--output DIR]
        [--cells N ...] [--cases NAME ...] [--methods METHOD ...] [--repeat K] [--limit COUNT]

Runs block.prm in each of the cases at each size with each method: `krylov-amg`, multigrid on the
lattice; `krylov-blocks`, the algebraic one that it replaced, with rigid motions. With --before
the first column of a case is another program, an older kedge, with its own `krylov-amg`. Prints
iterations per correction of Newton's method and the processor time of whole runs, the median of
K, paired in time: the methods of a case take turns. With --limit the exit code is 1 if multigrid
on the lattice takes more than this many iterations per correction anywhere.
"""
import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
BALL = {"Bodies/body/Geometry": "ball(n/2, n/2, 0.5*n; 0.47*n)",
        "Node conditions/floor/Side": "",
        "Node conditions/floor/Where": "z < 0.15*n"}
CASES = {
    "linear": {"Bodies/body/Basis": "linear"},
    "gimp": {},
    "ball": BALL,
    "nearly incompressible": {"Materials/rubber/Poisson's ratio": "0.47"},
}


def arguments():
    """The command line, parsed."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kedge", default=str(ROOT / "build" / "kedge"))
    parser.add_argument("--before", help="an older kedge to compare with")
    parser.add_argument("--output", type=Path, default=ROOT / "output" / "multigrid")
    parser.add_argument("--cells", type=int, nargs="+", default=[12, 24])
    parser.add_argument("--cases", nargs="+", choices=list(CASES), default=list(CASES))
    parser.add_argument("--methods", nargs="+", default=["krylov-amg", "krylov-blocks"])
    parser.add_argument("--repeat", type=int, default=1)
    parser.add_argument("--limit", type=float, help="most iterations per correction [-]")
    return parser.parse_args()


def run(arg, program, case, cells, method):
    """One run: its summary, with the processor time of the process."""
    folder = arg.output / f"{case}_{cells}_{method}".replace(" ", "_")
    settings = {"Constants/n": cells, "Linear solver/Method": method, **CASES[case]}
    line = [program, str(HERE / "block.prm"), "-o", str(folder)]
    for name, value in settings.items():
        line += ["-s", f"{name} = {value}"]
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run(line, check=True, stdout=subprocess.DEVNULL,
                   env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
    summary = json.loads((folder / "summary.json").read_text())
    summary["user"] = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    return summary


def main():
    """Writes the table."""
    arg = arguments()
    columns = [("before", arg.before, "krylov-amg")] if arg.before else []
    columns += [(method, arg.kedge, method) for method in arg.methods]
    print("| case | cells | unknowns | method | iterations per correction | s, linear solve "
          "| s, run | of the first |\n|---|---|---|---|---|---|---|---|")
    worst = 0.
    for case in arg.cases:
        for cells in arg.cells:
            rounds = [[run(arg, program, case, cells, method) for _, program, method in columns]
                      for _ in range(arg.repeat)]
            for k, (name, _, _) in enumerate(columns):
                runs = [row[k] for row in rounds]
                count = runs[0]["linear_iterations"] / max(1, runs[0]["newton_iterations"])
                solve = statistics.median(r["phase_cpu_seconds"]["linear solve"] for r in runs)
                user = statistics.median(r["user"] for r in runs)
                ratio = statistics.median(row[k]["user"] / row[0]["user"] for row in rounds)
                print(f"| {case} | {cells} | {runs[0]['counts']['dofs']} | {name} | {count:.1f} "
                      f"| {solve:.2f} | {user:.2f} | {ratio:.2f} |", flush=True)
                if name == "krylov-amg":
                    worst = max(worst, count)
    if arg.limit and worst > arg.limit:
        print(f"{worst:.1f} iterations per correction, more than {arg.limit}")
        sys.exit(1)


if __name__ == "__main__":
    main()
