"""What the README says of the first run and of the speed is what comes out.

    readme.py KEDGE ROOT OUTPUT

Figures that follow from the run are compared with it; the run's time, of which a loaded machine
tells little, within a factor of four. Figures of speed are compared with the table of doc/benchmarks.md, from which they are taken.
"""
import csv
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

KEDGE, ROOT, OUTPUT = (Path(word).resolve() for word in sys.argv[1:])
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
ROUND_OFF = 1e-12 # of the checks that are zero in theory; their tolerances are 1e-9 to 1e-11


def demand(condition, message):
    """Ends the test with `message` unless `condition` holds."""
    if not condition:
        sys.exit("TEST FAILED: " + message)


def skeleton(line):
    """A line without its numbers."""
    return NUMBER.sub("#", line)


def compare_runs(shown, real):
    """Lines that do not depend on the clock have the same words and numbers."""
    shown, real = ([line for line in lines if not line.startswith("step ")]
                   for lines in (shown, real))
    demand(list(map(skeleton, shown)) == list(map(skeleton, real)),
           "the README's first run does not look like this one:\n" + "\n".join(real))
    for line, truth in zip(shown, real):
        for number, expected in zip(map(float, NUMBER.findall(line)),
                                    map(float, NUMBER.findall(truth))):
            clock = truth.startswith("kedge: finished") and expected == float(
                NUMBER.findall(truth)[-1])
            small = abs(number) < ROUND_OFF and abs(expected) < ROUND_OFF
            demand(clock or small or abs(number - expected) <= 1e-9 * abs(expected),
                   f"the README says '{line}', the run '{truth}'")


def test_first_run(readme):
    """The block below `The first run` and the numbers that are compared with theory."""
    folder = OUTPUT / "output/quickstart"
    done = subprocess.run([KEDGE, ROOT / "prm/quickstart.prm", "-o", "output/quickstart"],
                          cwd=OUTPUT, capture_output=True, text=True, check=False)
    demand(done.returncode == 0, done.stderr)
    block = readme.split("## The first run")[1].split("What it wrote")[0]
    compare_runs([line[4:] for line in block.splitlines() if line.startswith("    ")],
                 done.stdout.splitlines())
    with open(folder / "history.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    strain = max(float(row["strain_energy"]) for row in rows)
    words = " ".join(readme.split())
    demand(f"rises to {strain:.0f} J" in words, f"the strain energy rises to {strain:.0f} J")
    total = [float(row["total_energy"]) for row in rows]
    theory = 3.141592653589793 / 4 * 1000 * 4**2 / 2
    demand(f"{theory:.2f} J" in readme, f"m v^2/2 is {theory:.2f} J")
    worst = max(abs(value - total[0]) for value in total) / total[0]
    stated = float(re.search(r"([\d.]+)·10⁻¹⁴ of it", readme)[1]) * 1e-14
    demand(worst <= 2 * stated, f"the energy is off by {worst:.1e}, not by {stated:.1e}")
    points = json.loads((folder / "summary.json").read_text("utf-8"))["counts"]["material_points"]
    demand(f"{points} material points" in readme, f"there are {points} material points")
    stated = float(re.search(r"less than ([\d.]+)·10⁻¹⁴ of their scale", words)[1]) * 1e-14
    for name in ("momentum", "angular momentum"): # the scene's checks divide by the scale
        change = float(re.search(rf"^PASS {name} (\S+)", done.stdout, re.MULTILINE)[1])
        demand(change <= 2 * stated, f"the {name} changes by {change:.1e}, not by {stated:.1e}")


def test_points_of_the_ball(readme):
    """How many there are, and that they weigh what the ball weighs."""
    done = subprocess.run([KEDGE, ROOT / "prm/quickstart.prm", "--validate"], capture_output=True,
                          text=True, check=True)
    number = re.search(r"ball, (\d+) material points", done.stdout)[1]
    off = float(re.search(r"volume: +ball.*\((\S+) %\)", done.stdout)[1]) / 100
    words = " ".join(readme.split())
    demand(f"its {number} material points" in words, f"the ball has {number} material points")
    stated = float(re.search(r"weighs to (\d+)·10⁻¹⁵ of it", words)[1]) * 1e-15
    demand(abs(off) <= 2 * stated, f"the points' volume is off by {off:.1e}, not by {stated:.1e}")


def test_clock(readme):
    """Times of a quiet machine; this one may be loaded, so that only their order is compared."""
    stated = float(re.search(r"Newton iterations, ([\d.]+) s", readme)[1])
    summary = json.loads((OUTPUT / "output/quickstart/summary.json").read_text("utf-8"))
    spent = summary["cpu_seconds"]
    slow = KEDGE.parent.name in ("build-debug", "build-sanitize")
    demand(slow or stated / 4 < spent < 4 * stated, f"the first run takes {spent} s, not {stated} s")


def test_speed(readme):
    """From the table of times: how often kedge goes into the time of AMPLE."""
    words = " ".join(readme.split())
    rows = [[cell.strip() for cell in line.strip("|").split("|")]
            for line in (ROOT / "doc/benchmarks.md").read_text("utf-8").splitlines()
            if "| AMPLE 1.1" in line and "kedge GIMP" in line]
    matlab = [float(row[8]) for row in rows if "MATLAB" in row[1]]
    demand("a third" in words and round(min(matlab)) == 3, f"not a third: {min(matlab)}")
    demand("a hundredth" in words and 90 < max(matlab) < 115, f"not a hundredth: {max(matlab)}")
    octave = [float(row[8]) for row in rows if "Octave" in row[1]
              and row[0].startswith(("cantilever", "collapse"))]
    low, high = re.search(r"a (\d+)th to a (\d+)th of AMPLE's under Octave", words).groups()
    for stated, measured in ((low, min(octave)), (high, max(octave))):
        demand(abs(float(stated) / measured - 1) < 0.1, f"{stated}th, the table says {measured}")


def main():
    """All, of the README as it stands."""
    shutil.rmtree(OUTPUT, ignore_errors=True)
    OUTPUT.mkdir(parents=True)
    readme = (ROOT / "README.md").read_text("utf-8")
    test_first_run(readme)
    test_points_of_the_ball(readme)
    test_clock(readme)
    test_speed(readme)
    print("the README says what is true")


if __name__ == "__main__":
    main()
