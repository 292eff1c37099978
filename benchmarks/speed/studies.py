"""The parts beside the suite: cost by phase, growth, ranks, what is not used, all scenes."""
import re
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import report
from measure import demand, ratio, run_interleaved
from programs import ROOT, Programs
from results import Run

HERE = Path(__file__).resolve().parent
PHASES = ["activation", "transfer", "residual", "tangent", "history update", "output",
          "linear solve"]
KERNELS = {"2D linear": ("block_2d.prm", "linear"), "2D GIMP": ("block_2d.prm", "gimp"),
           "3D linear": ("block_3d.prm", "linear"), "3D GIMP": ("block_3d.prm", "gimp")}


def command(kedge, scene, folder, settings):
    """The line that runs a scene of this folder, or of prm/, with settings."""
    path = HERE / scene if (HERE / scene).exists() else ROOT / "prm" / scene
    line = [kedge, str(path), "-o", str(folder)]
    for name, value in settings.items():
        line += ["-s", f"{name} = {value}"]
    return line


def measure(arg, part, runs, prefixes=None):
    """
    Runs scenes in turns. `runs` are (name, scene, settings); `prefixes` are put
    before the command of a name, such as mpirun. (Cost, Run) by name.
    """
    folders = [arg.output / part / name.replace(" ", "_").replace(",", "") for name, _, _ in runs]
    commands = [(prefixes or {}).get(name, []) + command(arg.kedge, scene, folder, settings)
                for (name, scene, settings), folder in zip(runs, folders)]
    logs = [Path(f"{folder}.log") for folder in folders]
    costs = run_interleaved(commands, logs, arg.repeats)
    for cost, line, log in zip(costs, commands, logs):
        demand(cost, line, log)
    return {name: (cost, Run(folder)) for (name, _, _), cost, folder in zip(runs, costs, folders)}


def per_point_iteration(run):
    """Microseconds per material point and Newton iteration, by phase, of the last run."""
    counts = run.counts()
    work = counts["points"] * counts["newton"]
    return {phase: 1e6 * run.phases()[phase] / work for phase in PHASES}


def without_solver(phases):
    """All phases but the linear solve."""
    return sum(value for phase, value in phases.items() if phase != "linear solve")


def finish(arg, part, rows, heads, note=""):
    """Writes, shows and, if asked for, documents a table."""
    report.write_csv(rows, arg.output / f"{part}.csv")
    table = report.markdown(rows, heads) + note
    (arg.output / f"{part}.md").write_text(table, encoding="utf-8")
    print(f"{part}\n\n{table}", flush=True)
    if arg.write_doc:
        report.replace_part(part, table)
    return 0


def cost(arg):
    """The four kernels, elastic, conserving stress: everything but the linear solve."""
    size = {"block_2d.prm": {"short": 8, "medium": 100}.get(arg.level, 160),
            "block_3d.prm": {"short": 3, "medium": 12}.get(arg.level, 16)}
    runs = [(name, scene, {"Constants/n": size[scene], "Bodies/block/Basis": basis})
            for name, (scene, basis) in KERNELS.items()]
    rows = []
    for name, (spent, run) in measure(arg, "cost", runs).items():
        phases = per_point_iteration(run)
        counts = run.counts()
        rows.append({"kernel": name, "points": counts["points"],
                     "iterations": counts["newton"] / counts["steps"], **phases,
                     "kernels": without_solver(phases),
                     "whole": 1e6 * spent.median("user") / (counts["points"] * counts["newton"])})
    heads = {"kernel": "", "points": "points", "iterations": "iterations per step",
             **{phase: phase for phase in PHASES}, "kernels": "all but the linear solve",
             "whole": "whole run"}
    return finish(arg, "cost", rows, heads, operations(arg, rows))


def operations(arg, rows):
    """Operations and bytes of residual and tangent, and their share of what one core can do."""
    known = Programs(arg).operations()
    flops, rate = known["peak_operations_per_second"], known["peak_bytes_per_second"]
    table = []
    for row in rows:
        kernel = known["kernels"][row["kernel"]]
        for phase in ("residual", "tangent"):
            count, size = kernel[f"{phase}_operations"], kernel[f"{phase}_bytes"]
            table.append({"kernel": f"{row['kernel']}, {phase}", "nodes": kernel["nodes"],
                          "flops": count, "bytes": size, "time": row[phase],
                          "share": 100 * count / (1e-6 * row[phase]) / flops,
                          "traffic": 100 * size / (1e-6 * row[phase]) / rate})
    report.write_csv(table, arg.output / "operations.csv")
    return ("\n" + report.markdown(table, {
        "kernel": "kernel", "nodes": "nodes", "flops": "operations per point",
        "bytes": "bytes per point", "time": "us per point and iteration",
        "share": "% of the peak's operations", "traffic": "% of the memory's rate"})
            + f"\nPeak of one core, measured: {flops / 1e9:.0f} Gflop/s with {known['lanes']} lanes, "
            f"{rate / 1e9:.0f} GB/s from memory.\n")


def matrix_bytes(run, basis):
    """
    Memory of the matrix: what a row couples, in 8 bytes of the node matrix, 8 of
    the system and 8 of its column numbers.
    """
    dim = run.summary["dimension"]
    reach = 3 if basis == "linear" else 5
    return run.counts()["unknowns"] * dim * reach ** dim * 24


def scaling(arg):
    """Time per point and step and memory per point over the number of points, 2D."""
    sizes = {"short": (8, 16), "medium": (50, 158)}.get(arg.level, (50, 158, 500))
    runs = [(f"{basis} {n}", "block_2d.prm",
             {"Constants/n": n, "Constants/steps": 10, "Bodies/block/Basis": basis})
            for basis in ("linear", "gimp") for n in sizes]
    empty = [("smallest", "block_2d.prm", {"Constants/n": 4, "Constants/steps": 1})]
    measured = measure(arg, "scaling", empty + runs)
    base = measured.pop("smallest")[0].median("memory")
    rows = []
    for name, (spent, run) in measured.items():
        counts, basis = run.counts(), name.split()[0]
        work = counts["points"] * counts["steps"]
        memory = 1e6 * (spent.median("memory") - base)
        rows.append({"basis": basis, "points": counts["points"],
                     "iterations": counts["newton"] / counts["steps"],
                     **{phase: 1e6 * run.phases()[phase] / work for phase in PHASES},
                     "kernels": sum(1e6 * run.phases()[phase] / work
                                    for phase in PHASES if phase != "linear solve"),
                     "memory": memory / counts["points"],
                     "matrix": matrix_bytes(run, basis) / counts["points"]})
    heads = {"basis": "basis", "points": "points", "iterations": "iterations per step",
             **{phase: phase for phase in PHASES}, "kernels": "all but the linear solve",
             "memory": "bytes per point", "matrix": "of these matrix"}
    return finish(arg, "scaling", rows, heads)


def ranks(arg):
    """One and two processes on a block in space."""
    n = {"short": 4, "medium": 16}.get(arg.level, 29)
    mpirun = shutil.which("mpirun")
    if not mpirun:
        sys.exit("this part needs mpirun")
    settings = {"Constants/n": n, "Constants/steps": 10, "Bodies/block/Basis": "linear"}
    prefix = [mpirun, "--oversubscribe", "--bind-to", "none", "-np", "2"]
    measured = measure(arg, "ranks", [("1 process", "block_3d.prm", settings),
                                      ("2 processes", "block_3d.prm", settings)],
                       {"2 processes": prefix})
    (one, first), (two, second) = measured.values()
    rows = []
    for phase in PHASES:
        a, b = (run.summary["phase_wall_seconds"][phase] for run in (first, second))
        rows.append({"phase": phase, "one": a, "two": b, "gain": a / b if b > 0 else ""})
    a, b = (run.summary["wall_seconds"] for run in (first, second))
    rows.append({"phase": "whole run without start", "one": a, "two": b, "gain": a / b})
    rows.append({"phase": "whole run", "one": one.median("wall"), "two": two.median("wall"),
                 "gain": ratio(one, two, "wall")})
    note = f"\n{first.counts()['points']} points, {first.counts()['unknowns']} unknowns.\n"
    return finish(arg, "ranks", rows, {"phase": "wall time [s]", "one": "1 process",
                                       "two": "2 processes", "gain": "times faster"}, note)


def start_time(arg):
    """User time in which kedge begins and ends [s]."""
    log = arg.output / "start.log"
    return run_interleaved([[arg.kedge, "--version"]], [log], 5)[0].median("user")


def unneeded(arg):
    """Pairs of runs that differ by something that the scene does not use."""
    n = {"short": 8, "medium": 30}.get(arg.level, 40)
    steps = 2 if arg.level == "short" else 10
    base = {"Constants/n": n, "Constants/steps": steps}
    never = {"Materials/rubber/Model": "von_mises", "Materials/rubber/Yield radius rho_y": 1e12}
    runs = [
        ("plain", "block_2d.prm", base),
        ("empty background, 100 times larger", "block_2d.prm",
         {**base, "Constants/space": round(4.5 * n)}),
        ("pictures every step", "block_2d.prm", {**base, "Output/Points every steps": 1}),
        ("audit of the mappings", "block_2d.prm", {**base, "Mapping/Audit": "true"}),
        ("plasticity that never yields", "block_2d.prm", {**base, **never}),
        ("cells' mean volume change", "block_2d.prm",
         {**base, "Materials/rubber/Volume change": "cell mean"}),
        ("no ties", "block_2d.prm", {**base, "Stabilisation/Method": "none"}),
        ("moving block alone", "resting.prm", {**base, "Constants/rest": 0}),
        ("with nine times as many points at rest", "resting.prm", {**base, "Constants/rest": 3}),
    ]
    measured = measure(arg, "unneeded", runs)
    start = start_time(arg)
    rows = []
    for name, _, settings in runs:
        spent, run = measured[name]
        plain = measured["moving block alone" if "Constants/rest" in settings else "plain"]
        rows.append({"run": name, "points": run.counts()["points"],
                     "user": spent.median("user"), "ratio": ratio(spent, plain[0]),
                     "inside": ratio(spent, plain[0], offset=start),
                     "memory": spent.median("memory")})
    return finish(arg, "unneeded", rows, {
        "run": "", "points": "points", "user": "CPU [s]", "ratio": "of the plain run",
        "inside": "start left out", "memory": "memory [MB]"})


# Functions, by what a scene may do without.
OFF = {"plasticity": "VonMises|CriticalState|ImprovedHencky",
       "small cuts (ties, ghosts)": "NodeTies|TiedRows|Ghost|ghost",
       "locking remedy": "GroupLaw|MeanDilatation|group_dilatation|find_groups|add_group",
       "audit of the mappings": "audit",
       "saturated soil": "Porous|Pore|porous|SurfacePressures",
       "pictures and probes": "PointsOutput|GridOutput|VtuFile|ProbeWriter|point_fields"}


def off(arg):
    """Share of samples in functions of what is off, in an elastic run without ties."""
    perf = shutil.which("perf")
    if not perf:
        print("off: this part needs perf (linux-perf); left out\n")
        return 0
    n = {"short": 8, "medium": 40}.get(arg.level, 60)
    data = arg.output / "off.data"
    line = command(arg.kedge, "block_2d.prm", arg.output / "off",
                   {"Constants/n": n, "Constants/steps": 20, "Stabilisation/Method": "none"})
    subprocess.run([perf, "record", "-q", "-F", "2000", "-o", str(data)] + line, check=True,
                   stdout=subprocess.DEVNULL)
    report_text = subprocess.run([perf, "report", "-i", str(data), "--stdio", "--no-children",
                                  "-F", "sample,sym"], check=True, capture_output=True,
                                 text=True).stdout
    samples = re.findall(r"^ *(\d+) +\[.\] (.*)$", report_text, re.M)
    total = sum(int(count) for count, _ in samples)
    rows = [{"off": name, "share": 100 * sum(int(count) for count, symbol in samples
                                             if re.search(pattern, symbol)) / total}
            for name, pattern in OFF.items()]
    return finish(arg, "off", rows, {"off": "compiled in but off", "share": "% of the run"},
                  f"\n{total} samples of the processor's time, the start of the process included.\n")


def scenes(arg):
    """All scenes of prm/ as they ship, two at a time, the longest first; no element tests."""
    longest = ["taylor_bar", "cantilever_dynamic_b_cell_mean", "strip_footing", "necking_bar",
               "cantilever_dynamic_a", "cantilever_dynamic_b"]
    names = sorted((path.stem for path in (ROOT / "prm").glob("*.prm")
                    if "subsection Path" not in path.read_text()),
                   key=lambda name: (longest + [name]).index(name))
    if arg.level == "short":
        names = ["column_quasi_static", "falling_body"]
    begin = time.monotonic()

    def one(name):
        folder = arg.output / "scenes" / name
        line = command(arg.kedge, f"{name}.prm", folder, {}) + ["--strict"]
        log = Path(f"{folder}.log")
        spent = run_interleaved([line], [log], 1)[0]
        demand(spent, line, log)
        return {"scene": name, **Run(folder).counts(), "user": spent.median("user"),
                "wall": spent.median("wall"), "memory": spent.median("memory"),
                "checks": len(Run(folder).summary["checks"])}

    with ThreadPoolExecutor(2) as pool:
        rows = list(pool.map(one, names))
    total = time.monotonic() - begin
    note = f"\nAll of them, two at a time: {total:.0f} s.\n"
    return finish(arg, "scenes", rows, {
        "scene": "scene", "points": "points", "unknowns": "unknowns", "steps": "steps",
        "newton": "iterations", "user": "CPU [s]", "wall": "wall [s]", "memory": "memory [MB]",
        "checks": "checks passed"}, note)


PARTS = {"cost": cost, "scaling": scaling, "ranks": ranks, "unneeded": unneeded,
         "off": off, "scenes": scenes}
