#!/usr/bin/env python3
"""Runs a scene with all combinations of some settings, on all cores, each into a folder of
its own, and puts what came out into one table and one figure."""
import argparse
import csv
import itertools
import json
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

EXAMPLES = """examples
  kedge sweep prm/strip_footing.prm -s "Constants/n = 4, 8, 16" -q "last(history.reaction_footing_y)"
  kedge sweep scene.prm -s "Time/Scheme = newmark, midpoint" -s "Constants/E = 1e6, 2e6" -j 2
  kedge sweep scene.prm -s "Grid/Cells = 4, 2 | 8, 4" --resume

Values stand between commas, or between bars | where they hold commas themselves. A setting with
one value goes to all runs. Quantities are last, minimum, maximum or max_abs of history.COLUMN or
probe.NAME.COLUMN; without -q the values of the scene's Checks are taken."""
STATISTICS = {"last": lambda values: values[-1], "minimum": min, "maximum": max,
              "max_abs": lambda values: max(map(abs, values))}


class Wrong(Exception):
    """What the user gave cannot be used."""


def arguments():
    """The command line, parsed."""
    parser = argparse.ArgumentParser(prog="kedge sweep", description=__doc__, epilog=EXAMPLES,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", metavar="SCENE")
    parser.add_argument("-s", "--set", action="append", default=[], metavar='"A/B = 1, 2"',
                        help="a setting and its values; repeatable")
    parser.add_argument("-q", "--quantity", action="append", default=[],
                        metavar='"last(history.COLUMN)"', help="what the table shows; repeatable")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count(), metavar="N",
                        help="runs at a time (default: all cores)")
    parser.add_argument("-o", "--output", type=Path, metavar="DIR",
                        help="default: output/<scene name>-sweep")
    parser.add_argument("--pair", action="store_true",
                        help="the first values together, the second ones, ..; not all combinations")
    parser.add_argument("--resume", action="store_true",
                        help="leave out what is finished, go on where there is a checkpoint")
    parser.add_argument("--kedge", type=Path, required=True, help=argparse.SUPPRESS)
    arg = parser.parse_args()
    if arg.jobs < 1:
        parser.error("--jobs must be at least 1")
    return arg


def split(text, separator):
    """The parts of a list; separators within parentheses and || do not count."""
    parts, depth = [""], 0
    for letter in text.replace("||", "\0"):
        depth += (letter == "(") - (letter == ")")
        if letter == separator and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.replace("\0", "||").strip() for part in parts]


def read_setting(text):
    """Name and values of `A/B = 1, 2`."""
    name, equals, values = text.partition("=")
    if not equals or not name.strip():
        raise Wrong(f"'{text}' does not have the form \"Section/Name = value, value\"")
    bars = split(values, "|")
    return name.strip(), bars if len(bars) > 1 else split(values, ",")


def read_quantity(text):
    """Statistic, table and column of `last(history.total_energy)`."""
    match = re.fullmatch(r"(\w+)\((history|probe)\.(.+)\)", text.strip())
    if not match or match[1] not in STATISTICS:
        raise Wrong(f"'{text}' is no quantity: write one of {', '.join(STATISTICS)} of "
                    "history.COLUMN or probe.NAME.COLUMN, such as last(history.total_energy)")
    return match.groups()


def combinations(settings, pair):
    """A dictionary from setting to value for each run."""
    names, values = [name for name, _ in settings], [list(given) for _, given in settings]
    if pair:
        longest = max(map(len, values), default=1)
        values = [given * longest if len(given) == 1 else given for given in values]
        if any(len(given) != longest for given in values):
            raise Wrong("--pair needs as many values of each setting")
        return [dict(zip(names, chosen)) for chosen in zip(*values)]
    return [dict(zip(names, chosen)) for chosen in itertools.product(*values)]


def folder_name(number, settings, swept):
    """A short name that says which run it is, and is one of a folder."""
    words = [f"{name.split('/')[-1]}={settings[name]}" for name in swept]
    return re.sub(r"[^\w=.,+()-]+", "_", f"{number:03d}-" + ",".join(words))[:100]


class RunOfSweep:
    """One of the runs."""

    def __init__(self, arg, settings, folder):
        self.arg, self.settings, self.folder = arg, settings, folder
        self.code, self.status, self.results = None, "", {}

    def summary(self):
        """summary.json, or nothing."""
        try:
            return json.loads((self.folder / "summary.json").read_text("utf-8"))
        except (OSError, ValueError):
            return {}

    def run(self):
        """Runs kedge unless that is done; says how it ended."""
        line = [self.arg.kedge, self.arg.scene, "-o", self.folder]
        for name, value in self.settings.items():
            line += ["-s", f"{name} = {value}"]
        if self.arg.resume and self.summary().get("status") == "finished":
            self.code, self.status = 0, "finished before"
        else:
            if self.arg.resume and any((self.folder / "checkpoint").glob("state-*")):
                line.append("--resume")
            done = subprocess.run(list(map(str, line)), stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, text=True, check=False,
                                  env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
            self.code = done.returncode
            self.status = (self.summary().get("status", "") if done.returncode != 1
                           else done.stderr.strip())
        print(f"{self.folder.name}: {self.status.splitlines()[0] if self.status else self.code}",
              flush=True)
        for quantity in self.arg.quantity: # a wrong one is told before all the others have run
            self.value(quantity)
        return self

    def collect(self, quantities):
        """The values of the table."""
        summary = self.summary() if self.code != 1 else {}
        for quantity in quantities:
            self.results[quantity] = self.value(quantity)
        if not quantities:
            for check in summary.get("checks", []):
                self.results[check["name"]] = check["value"]
        self.results["wall_seconds"] = summary.get("wall_seconds")

    def value(self, quantity):
        """A statistic of a column; None if the run did not write it."""
        statistic, place, column = read_quantity(quantity)
        path = self.folder / ("history.csv" if place == "history" else "probes.csv")
        if self.code == 1 or not path.exists():
            return None
        with open(path, newline="", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if None not in row.values()]
        if not rows:
            return None
        if column not in rows[0]:
            raise Wrong(f"{path} has no column '{column}'; it has {', '.join(rows[0])}")
        return STATISTICS[statistic]([float(row[column]) for row in rows])


def write_table(runs, names, path):
    """sweep.csv, and the same for the eyes."""
    columns = list(dict.fromkeys(column for run in runs for column in run.results))
    rows = [["folder", *names, "exit_code", *columns]]
    for run in runs:
        values = [run.results.get(column) for column in columns]
        rows.append([run.folder.name, *(run.settings[name] for name in names), run.code,
                     *("" if value is None else f"{value:.10g}" for value in values)])
    with open(path, "w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows(rows)
    widths = [max(len(str(row[i])) for row in rows) for i in range(len(rows[0]))]
    for row in rows:
        print("  ".join(str(cell).ljust(width) for cell, width in zip(row, widths)).rstrip())


def is_number(text):
    """Whether a value is a plain number."""
    try:
        float(text)
        return True
    except ValueError:
        return False


def draw(runs, swept, path):
    """Each quantity over the first setting whose values are numbers; a line for each of the rest."""
    import matplotlib # only here: tables do without
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    across = next((name for name in swept if all(is_number(run.settings[name]) for run in runs)),
                  None)
    quantities = [name for name in dict.fromkeys(q for run in runs for q in run.results)
                  if any(run.results.get(name) is not None for run in runs)]
    if not quantities:
        return False
    figure, panels = plt.subplots(len(quantities), 1, squeeze=False, constrained_layout=True,
                                  figsize=(7.5, 2.9 * len(quantities)))
    for panel, quantity in zip(panels[:, 0], quantities):
        groups = {}
        for number, run in enumerate(runs):
            if run.results.get(quantity) is None:
                continue
            key = ", ".join(f"{name.split('/')[-1]} = {run.settings[name]}"
                            for name in swept if name != across)
            x = float(run.settings[across]) if across else number
            groups.setdefault(key if across else "", []).append((x, run.results[quantity]))
        for key, points in groups.items():
            panel.plot(*zip(*sorted(points)), marker="o", label=key)
        panel.set(ylabel=quantity, xlabel=across or "run")
        panel.grid(True, color="#dddddd")
        if len(groups) > 1:
            panel.legend(fontsize=8)
        if not across:
            panel.set_xticks(range(len(runs)), [run.folder.name for run in runs], rotation=60,
                             ha="right", fontsize=7)
    figure.savefig(path, dpi=150)
    return True


def sweep(arg):
    """All of it; returns the exit code: the largest of the runs."""
    if not Path(arg.scene).is_file():
        raise Wrong(f"there is no scene {arg.scene}")
    for quantity in arg.quantity:
        read_quantity(quantity)
    settings = [read_setting(text) for text in arg.set]
    swept = [name for name, values in settings if len(values) > 1]
    if not swept:
        raise Wrong('nothing to sweep: give a setting several values, -s "Constants/E = 1e6, 2e6"')
    output = arg.output or Path("output") / (Path(arg.scene).stem + "-sweep")
    runs = [RunOfSweep(arg, chosen, output / folder_name(number, chosen, swept))
            for number, chosen in enumerate(combinations(settings, arg.pair), 1)]
    print(f"{len(runs)} runs, {min(arg.jobs, len(runs))} at a time, into {output}", flush=True)
    output.mkdir(parents=True, exist_ok=True)
    with ThreadPoolExecutor(arg.jobs) as pool:
        try:
            list(pool.map(RunOfSweep.run, runs))
        except Wrong:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    for run in runs:
        run.collect(arg.quantity)
    write_table(runs, swept, output / "sweep.csv")
    print(output / "sweep.csv")
    try:
        if draw(runs, swept, output / "sweep.png"):
            print(output / "sweep.png")
    except ImportError:
        print("no figure: python3-matplotlib is not installed", file=sys.stderr)
    return max(run.code if run.code >= 0 else 4 for run in runs)


def main():
    """Ends with 1 if what the user gave cannot be used."""
    arg = arguments()
    try:
        sys.exit(sweep(arg))
    except (Wrong, OSError) as error:
        sys.exit(f"kedge sweep: {error}")


if __name__ == "__main__":
    main()
