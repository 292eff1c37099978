"""Tables: CSV, Markdown, and the generated parts of doc/benchmarks.md."""
import csv
import datetime
import math
import os
import re
import shutil
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCUMENT = ROOT / "doc" / "benchmarks.md"
PICTURES = ROOT / "doc" / "pictures" / "benchmarks"

# The columns of the tables, with what stands above them.
HEADS = {"variant": "", "method": "method", "label": "run", "points": "points",
         "unknowns": "unknowns", "newton": "iterations", "user_s": "CPU [s]",
         "wall_s": "wall [s]", "memory_MB": "memory [MB]", "ended": "ended",
         "other_user_s": "other CPU [s]", "ratio": "this/other"}


def write_csv(rows, path):
    """All rows; a column that only some of them have is empty in the others."""
    columns = list(dict.fromkeys(name for row in rows for name in row))
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def read_csv(path):
    """Rows as dictionaries of texts."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def number(value):
    """A number as a table shows it: three digits."""
    if isinstance(value, str) or value is None:
        return value or ""
    if isinstance(value, int) or (value == int(value) and abs(value) < 1e7):
        return str(int(value))
    if value != value or math.isinf(value):
        return str(value)
    digits = max(0, 2 - math.floor(math.log10(abs(value))))
    return f"{value:.{digits}f}" if 1e-3 <= abs(value) < 1e7 else f"{value:.1e}"


def markdown(rows, heads):
    """A Markdown table of some columns, those without any entry left out."""
    names = [name for name in heads if any(row.get(name, "") != "" for row in rows)]
    lines = ["| " + " | ".join(heads[name] for name in names) + " |", "|" + "---|" * len(names)]
    lines += ["| " + " | ".join(number(row.get(name, "")) for name in names) + " |"
              for row in rows]
    return "\n".join(lines) + "\n"


def suite_table(rows, problem, measures):
    """The table of one problem."""
    heads = dict(HEADS)
    for measure in measures:
        heads[measure] = f"{measure} error"
    return markdown([row for row in rows if row["problem"] == problem], heads)


def rival_table(rivals, problem):
    """What rivals needed for the problem."""
    def span(pair):
        return number(pair[0]) if pair[0] == pair[1] else f"{number(pair[0])} to {number(pair[1])}"

    rows = [{"variant": rival.variant, "rival": rival.name, "label": rival.label,
             "time": span(rival.time), "measure": rival.measure, "error": span(rival.error),
             "source": rival.source} for rival in rivals if rival.problem == problem]
    return markdown(rows, {"variant": "", "rival": "program", "label": "run",
                           "time": "CPU [s]", "measure": "measure", "error": "error",
                           "source": "source"}) if rows else ""


def cheapest(rows, problem, variant, measure, error, finite_element):
    """
    (time, run, shortest time without the start of the process) of the cheapest run whose
    error is no larger, to the four digits that rivals' errors have; None if there is none.
    """
    fits = [row for row in rows
            if (row["problem"], row["variant"]) == (problem, variant)
            and row["method"].startswith("FEM") == finite_element
            and row.get(measure, "") != "" and row[measure] <= 1.0005 * error]
    if not fits:
        return None
    best = min(fits, key=lambda row: row["user_s"])
    return (best["user_s"], f"{best['method']} {best['label']}",
            min((row["inside_s"] for row in fits if row.get("inside_s", "") != ""), default=""))


def gain(rival, time):
    """How many times faster than the rival a run of `time` is, or from how many to how many."""
    first, last = (other / time for other in rival.time)
    return first if first == last else f"{number(first)} to {number(last)}"


def equal_error(rows, rivals):
    """For each rival's run the cheapest of kedge's that is no worse."""
    table = []
    for rival in rivals:
        known = rival.time[0] == rival.time[1]
        row = {"problem": f"{rival.problem} {rival.variant}", "rival": rival.name,
               "label": rival.label, "measure": rival.measure, "error": rival.error[1],
               "time": rival.time[0] if known
               else f"{number(rival.time[0])} to {number(rival.time[1])}"}
        own = cheapest(rows, rival.problem, rival.variant, rival.measure, rival.error[1], False)
        if own:
            row.update(kedge=own[0], run=own[1], gain=gain(rival, own[0]), inside=own[2],
                       inner=gain(rival, own[2]))
        table.append(row)
    return markdown(table, {"problem": "problem", "rival": "program", "label": "its run",
                            "measure": "measure", "error": "its error", "time": "its CPU [s]",
                            "kedge": "kedge [s]", "run": "kedge's run",
                            "gain": "times faster", "inside": "without start [s]",
                            "inner": "times faster so"})


def price(rows):
    """Where both get there: the cheapest runs of kedge and of the elements at some errors."""
    table = []
    kinds = dict.fromkeys((row["problem"], row["variant"], measure) for row in rows
                          for measure in ("stress", "tip", "history", "angle", "corners")
                          if row.get(measure, "") != "")
    for problem, variant, measure in kinds:
        for error in (0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5):
            own, elements = (cheapest(rows, problem, variant, measure, error, finite_element)
                             for finite_element in (False, True))
            if own and elements:
                table.append({"problem": f"{problem} {variant}", "measure": measure,
                              "error": error, "kedge": own[0], "run": own[1],
                              "fem": elements[0], "element": elements[1],
                              "price": own[0] / elements[0]})
    return markdown(table, {"problem": "problem", "measure": "measure", "error": "error below",
                            "kedge": "kedge [s]", "run": "kedge's run", "fem": "FEM [s]",
                            "element": "the elements' run", "price": "kedge/FEM"})


def replace_part(name, text):
    """Puts `text` between the marks `begin NAME` and `end NAME` of doc/benchmarks.md."""
    begin, end = f"<!-- begin {name} -->", f"<!-- end {name} -->"
    document = DOCUMENT.read_text(encoding="utf-8")
    if begin not in document:
        raise KeyError(f"{DOCUMENT} has no part '{name}'")
    pattern = re.escape(begin) + ".*?" + re.escape(end)
    DOCUMENT.write_text(re.sub(pattern, lambda _: f"{begin}\n{text}{end}", document, flags=re.S),
                        encoding="utf-8")


def machine(kedge):
    """What ran the benchmark, and how busy it was."""
    text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    model = re.search(r"model name\s*: (.*)", text)
    versions = subprocess.run([kedge, "--version"], capture_output=True, text=True, check=True)
    load = os.getloadavg()[2]
    return (f"Measured on {datetime.date.today()}, {model.group(1) if model else 'unknown'}, "
            f"{os.cpu_count()} cores, mean load of the last quarter of an hour {load:.1f}; "
            f"{', '.join(versions.stdout.strip().splitlines())}.\n")


def keep_pictures(folder, names):
    """Copies pictures to where the document shows them."""
    PICTURES.mkdir(parents=True, exist_ok=True)
    for name in names:
        for kind in ("png", "svg"):
            shutil.copyfile(folder / f"{name}.{kind}", PICTURES / f"{name}.{kind}")
