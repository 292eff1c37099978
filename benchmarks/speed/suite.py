"""The suite: runs the cases, measures time, memory and error, writes tables and pictures."""
import math
from pathlib import Path

import cases
import figures
import report
import rivals
from errors import MEASURES
from measure import ratio, run_interleaved
from programs import ROOT, Programs
from results import Run
from studies import start_time


def scene_command(programs, case, kedge, folder):
    """The line that runs a case."""
    if case.finite_element:
        line = [programs.finite_element(),
                str(ROOT / "benchmarks" / "finite_element" / case.scene)]
    else:
        line = [kedge, str(ROOT / "prm" / f"{case.scene}.prm")]
    line += ["-o", str(folder)]
    for name, value in case.settings.items():
        line += ["-s", f"{name} = {value}"]
    return line


def cost_columns(cost):
    """What a case cost."""
    return {"runs": len(cost.samples), "user_s": cost.median("user"),
            "system_s": cost.median("system"), "wall_s": cost.median("wall"),
            "memory_MB": cost.median("memory")}


def row_of(case, cost, folder):
    """A row of the table; a run that did not finish has no errors but its exit code."""
    row = {"problem": case.problem, "variant": case.variant, "method": case.method,
           "label": case.label, "ended": "" if cost.code == 0 else f"exit {cost.code}",
           **cost_columns(cost)}
    if cost.code:
        return row
    run = Run(folder)
    row.update(run.counts())
    row["inside_s"] = run.summary.get("wall_seconds", "")
    work = row["points"] * row["newton"]
    row["us"] = 1e6 * row["user_s"] / work if work else ""
    row.update({name: value for name, value in MEASURES[case.problem](run).items()
                if math.isfinite(value)})
    return row


def run_problem(arg, programs, group):
    """The rows of the cases of one problem, which are run in turns."""
    folders = [arg.output / "runs" / case.name.replace(" ", "_").replace("/", "_")
               for case in group]
    commands = [scene_command(programs, case, programs.kedge, folder)
                for case, folder in zip(group, folders)]
    own = len(commands)
    pairs = {}
    for index, (case, folder) in enumerate(zip(group, folders[:own])):
        if arg.compare and not case.finite_element:
            pairs[index] = len(commands)
            folders.append(folder.with_name(folder.name + ".other"))
            commands.append(scene_command(programs, case, arg.compare, folders[-1]))
    costs = run_interleaved(commands, [Path(f"{folder}.log") for folder in folders],
                            arg.repeats)
    rows = []
    for index, case in enumerate(group):
        row = row_of(case, costs[index], folders[index])
        if index in pairs and not costs[pairs[index]].code:
            row["other_user_s"] = costs[pairs[index]].median("user")
            row["ratio"] = ratio(costs[index], costs[pairs[index]])
        rows.append(row)
        print_row(row)
    return rows


def print_row(row):
    """A row as a line on the screen."""
    errors = "  ".join(f"{name} {row[name]:.2e}" for name in
                       ("stress", "tip", "history", "period", "angle", "corners", "length",
                        "foot", "energy") if row.get(name, "") != "")
    ratio_text = f"  this/other {row['ratio']:.3f}" if "ratio" in row else ""
    print(f"{row['problem']:20s} {row['variant']:7s} {row['method']:20s} {row['label']:24s} "
          f"{row['user_s']:8.2f} s {row['memory_MB']:7.0f} MB  {row['ended']}{errors}{ratio_text}",
          flush=True)


def measures_of(rows, problem):
    """The measures that rows of the problem have."""
    names = ("stress", "tip", "history", "period", "angle", "corners", "length", "foot", "energy")
    return [name for name in names
            if any(row["problem"] == problem and row.get(name, "") != "" for row in rows)]


def run(arg):
    """Runs the suite."""
    selected = [case for case in cases.all_cases()
                if case.level <= cases.LEVELS[arg.level] and arg.case in case.name
                and not (case.finite_element and arg.no_finite_elements)]
    programs = Programs(arg)
    problems = list(dict.fromkeys(case.problem for case in selected))
    rows = []
    for problem in problems:
        rows += run_problem(arg, programs, [case for case in selected if case.problem == problem])
        report.write_csv(rows, arg.output / "suite.csv")
    known = rivals.read_rivals()
    tables = {problem: report.suite_table(rows, problem, measures_of(rows, problem))
              for problem in problems}
    comparison = report.equal_error(rows, [rival for rival in known if rival.problem in problems])
    text = "".join(f"## {problem}\n\n{table}\n{report.rival_table(known, problem)}\n"
                   for problem, table in tables.items())
    price = report.price(rows)
    (arg.output / "suite.md").write_text(
        f"{text}## equal error\n\n{comparison}\n## beside finite elements\n\n{price}",
        encoding="utf-8")
    drawn = figures.draw_suite(rows, known, start_time(arg), arg.output / "figures")
    if arg.write_doc:
        report.replace_part("machine", report.machine(arg.kedge))
        for problem, table in tables.items():
            report.replace_part(problem, table)
            if report.rival_table(known, problem):
                report.replace_part(f"{problem} rivals", report.rival_table(known, problem))
        report.replace_part("equal error", comparison)
        report.replace_part("price", price)
        report.keep_pictures(arg.output / "figures", drawn)
    return 1 if any(row["ended"] for row in rows) else 0
