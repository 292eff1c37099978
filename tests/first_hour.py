"""What happens to a run from outside: pipes that close, full disks, two runs in a folder,
tables changed by hand, a later end, loads that are no numbers.

    first_hour.py KEDGE ROOT OUTPUT
"""
import csv
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

KEDGE, ROOT, OUTPUT = Path(sys.argv[1]).resolve(), Path(sys.argv[2]), Path(sys.argv[3])
GOOD = ROOT / "tests/scenes/bad_input/good.prm"
LOAD = ["-s", "Tractions/lid/Body = block", "-s", "Tractions/lid/Side = top"]
HELD = ["-s", "Node conditions/base/Side = bottom", "-s", "Node conditions/base/Component x = fixed",
        "-s", "Node conditions/base/Component y = fixed"]


def demand(condition, message):
    """Ends the test with `message` unless `condition` holds."""
    if not condition:
        sys.exit("TEST FAILED: " + message)


def run(name, *options, code=0, scene=GOOD, **how):
    """Runs the scene into a folder of its own; returns what it said on both streams."""
    line = [KEDGE, scene, "-o", OUTPUT / name, *options]
    how = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **how}
    done = subprocess.run(line, text=True, check=False, **how)
    print(" ".join(map(str, line)), done.stdout, done.stderr, sep="\n")
    demand(done.returncode == code, f"{name}: exit code {done.returncode} instead of {code}")
    return (done.stdout or "") + (done.stderr or "")


def history(name):
    """history.csv as a list of dictionaries of numbers."""
    with open(OUTPUT / name / "history.csv", newline="", encoding="utf-8") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def test_text_into_a_closed_pipe():
    """Nobody reads what --help prints: no word of MPI's or PETSc's."""
    for option in ("--help", "--print-parameters", "--version"):
        read, write = os.pipe()
        os.close(read)
        done = subprocess.run([KEDGE, option], stdout=write, stderr=subprocess.PIPE, text=True,
                              check=False, preexec_fn=lambda: signal.signal(signal.SIGPIPE,
                                                                            signal.SIG_DFL))
        os.close(write)
        demand(done.stderr == "", f"{option} into a closed pipe says {done.stderr}")


def test_odd_command_lines():
    """Whatever stands on the command line: a message and exit code 1, or the text asked for."""
    lines = [[], ["--"], ["-"], ["-o"], ["--output"], ["--set"], ["--threads", "0"], ["-x"], [""],
             ["--help=1"], ["--set="], ["--resume"], ["--drive"], ["/"], ["."], ["/dev/null"],
             ["no such.prm"], ["a.prm", "b.prm"], ["\u00e9.prm"], ["--" + "a" * 10000],
             ["a" * 10000], [GOOD, "-s", "="], [GOOD, "-s", "a/b/c/d = 1"], [GOOD, "-s", "/ = 1"],
             [GOOD, "-s", "Time/End"], [GOOD, "-o", ""], [GOOD, "-o", "/proc/nothing"],
             [GOOD, "--resume", "-o", "/nowhere"], [GOOD, "--drive"], [GOOD, "--drive", "--validate"],
             ["--print-parameters", "Nothing"], ["--print-parameters", "Time", "Grid"]]
    for line in lines:
        done = subprocess.run([KEDGE, *line], stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, check=False, cwd=OUTPUT)
        demand(done.returncode == 1, f"{line} ends with {done.returncode}")
        demand(done.stderr.startswith("kedge: ") and len(done.stderr) < 9000,
               f"{line} says {done.stderr[:200]}")
    for line in (["--version"], ["-h"], ["--print-parameters", "json"], ["--help", "--version"]):
        done = subprocess.run([KEDGE, *line], capture_output=True, text=True, check=False)
        demand(done.returncode == 0 and done.stdout and not done.stderr, f"{line}: {done.stderr}")


def test_full_disk():
    """What cannot be printed is an error; the run's files are whole all the same."""
    if not Path("/dev/full").exists():
        return
    with open("/dev/full", "w", encoding="utf-8") as full:
        done = subprocess.run([KEDGE, "--help"], stdout=full, stderr=subprocess.PIPE, check=False)
        demand(done.returncode == 1, "--help into a full disk ends with 0")
        run("full", stdout=full, code=1)
    demand(len(history("full")) == 11, "a run whose words are lost stops early")


def test_one_run_at_a_time():
    """A second run, fresh or resumed, is kept out; a killed one leaves no lock."""
    run("locked", "-s", "Time/End = 0.4")
    line = [KEDGE, GOOD, "-o", OUTPUT / "locked", "--resume", "-s", "Time/End = 1e5",
            "-s", "Output/Points interval = 1e4"]
    with subprocess.Popen(line, stdout=subprocess.PIPE, text=True) as first:
        while "step" not in first.stdout.readline():
            time.sleep(0.01)
        for option in ([], ["--resume"]):
            said = run("locked", *option, code=1)
            demand(re.search(rf"Another run of kedge, process {first.pid}\b.*--output", said),
                   "the lock does not say who holds it")
        first.kill()
    run("locked", "--resume", "-s", "Time/End = 0.6")
    run("locked")


def test_changed_table():
    """A digit of a row before the checkpoint was changed by hand."""
    run("changed", "-s", "Time/End = 0.4")
    path = OUTPUT / "changed/history.csv"
    lines = path.read_text("utf-8").split("\n")
    lines[2] = lines[2].replace("0.1", "0.2", 1)
    path.write_text("\n".join(lines), "utf-8")
    demand("has been changed" in run("changed", "--resume", code=1), "nobody saw the change")


def test_later_end():
    """A finished run goes on to a later end, as the run that had it from the start."""
    run("whole", "-s", "Time/End = 1")
    run("prolonged", "-s", "Time/End = 0.5")
    run("prolonged", "--resume", "-s", "Time/End = 1")
    demand([row["time"] for row in history("prolonged")] == [row["time"] for row in history("whole")],
           "the prolonged run has other steps")


def test_numbers_that_are_none():
    """Loads without a value: the run stops and names them, and no row holds them."""
    cases = (("0; 0/t", "At the start|not finite", ["-s", "Time/Scheme = trapezoidal"]),
             ("0; 1/(t - 0.35)^2*0/(t - 0.35)", "Tractions/lid = .* is (nan|-nan)", HELD),
             ("0; if(t > 0.44, 0/0, 1)", "Tractions/lid", HELD))
    for number, (traction, pattern, more) in enumerate(cases):
        name = f"nan{number}"
        line = [KEDGE, GOOD, "-o", OUTPUT / name, *LOAD, "-s", f"Tractions/lid/Traction = {traction}",
                *more]
        done = subprocess.run(line, capture_output=True, text=True, check=False)
        print(" ".join(map(str, line)), done.stdout, done.stderr, sep="\n")
        if done.returncode != 0:
            demand(done.returncode in (1, 2), f"{name}: exit code {done.returncode}")
            demand(re.search(pattern, done.stdout + done.stderr), f"{name}: '{pattern}' not found")
        if (OUTPUT / name / "history.csv").exists():
            demand(all(math.isfinite(value) for row in history(name) for value in row.values()),
                   f"{name}: a row holds a number that is none")
    demand("kinetic_energy is inf" in run("inf", "-s", "Materials/rubber/Density = 1e300", "-s",
                                          "Bodies/block/Initial velocity = 1e10; 0", code=1),
           "an infinite energy is not named")


def test_stop_at_a_load():
    """A run that cannot carry its load says how much it carried, and shows its last good state."""
    said = run("stop", *LOAD, *HELD, "-s", "Tractions/lid/Traction = 0; -1e7*t", "-s",
               "Time/Scheme = quasi-static", "-s", "Materials/rubber/Model = von_mises", "-s",
               "Materials/rubber/Yield radius rho_y = 1e4", code=2)
    rows = history("stop")
    reached = re.search(r"parts of those at Time/End: Tractions/lid ([0-9.e-]+)", said)
    # the load grows with time, which ends at 1
    demand(reached and abs(float(reached.group(1)) - rows[-1]["time"]) < 1e-3 * rows[-1]["time"],
           "the load factor is not that of the last row")
    demand("./kedge plot" in said and "--resume" in said, "no word on how to go on")
    pictures = (OUTPUT / "stop/points.pvd").read_text("utf-8")
    last = re.findall(r'timestep="([^"]+)"', pictures)[-1]
    demand(float(last) == rows[-1]["time"], "the last good state has no picture")


def test_pictures_of_the_start():
    """The grid at t = 0 once, probes from step 0 on, output times hit exactly."""
    run("start", "-s", "Output/Grid = true", "-s", "Output/Points interval = 0.25", "-s",
        "Time/Largest step factor = 8", "-s", "Probes/top/Face = top")
    for name in ("grid.pvd", "points.pvd"):
        times = [float(t) for t in re.findall(r'timestep="([^"]+)"',
                                              (OUTPUT / "start" / name).read_text("utf-8"))]
        demand(times == [0, 0.25, 0.5, 0.75, 1], f"{name} has the times {times}")
    with open(OUTPUT / "start/probes.csv", newline="", encoding="utf-8") as file:
        demand(float(next(csv.DictReader(file))["time"]) == 0, "probes begin after the start")


def test_equilibrium():
    """The stage says how it goes, and its support's force is that of the first row: the weight."""
    said = run("stage", *HELD, "-s", "Node conditions/base/Reaction = true", "-s",
               "Body force/Acceleration = 0; -9.81", "-s", "Equilibrium/Steps = 3", "-s",
               "Time/Scheme = quasi-static", "-s", "Time/End = 0.2")
    demand("Equilibrium: step 3 of 3" in said, "no word of the stage")
    demand("sum of all loads: (0 -9810) N/m" in said, "the weight is not said")
    for row in history("stage"): # 1 m x 1 m of 1000 kg/m^3; to the tolerance of Newton's method
        demand(abs(row["reaction_base_y"] - 9810) < 1e-6 * 9810, f"the reaction is {row}")


def test_smooth_fields():
    """A field that is the same at all points is that at all nodes; each cell has its corners."""
    sys.path.insert(0, str(ROOT / "source/plot"))
    try:
        from vtu_reader import read_points
    except ImportError:
        return # no numpy
    run("smooth", "-s", "Output/Grid = true", "-s", "Bodies/block/Initial velocity = 2; -3", "-s",
        "Time/End = 0.2")
    for path in sorted((OUTPUT / "smooth/grid").glob("*.vtu")):
        nodes = read_points(path)
        velocity = nodes.fields["velocity"]
        # a mean of equal numbers, but for rounding and the round-off of the motion
        demand(len(velocity) >= 4 and abs(velocity - [2, -3, 0]).max() < 1e-12,
               f"{path}: velocities {velocity}")
        demand("cauchy_stress_yy" in nodes.fields and "body" not in nodes.fields, nodes.names())


def test_sizes():
    """What no machine can hold is refused before it is tried, with the figure."""
    for setting, pattern in (
            ("Bodies/block/Points per cell = 4294967295", "1.8.*e.19 material points.*GB"),
            ("Grid/Cells = 1e9, 1", "too large to tell places"),
            ("Grid/Cells = 1e6, 1e6", "4e.12 nodes"),
            ("Equilibrium/Steps = 4e9", "4e.09"),
            ("Time/Step = 1e-12", "1e.12"),
            ("Output/Points interval = 1e-300", "pictures"),
            ("Grid/Origin = 1e16, 0", "too large to tell places")):
        demand(re.search(pattern, run("size", "-s", setting, code=1)), f"{setting}: no '{pattern}'")
    said = run("long", "-s", f"Title = {'a' * 100000}", "-s", f"Grid/Cells = {'b' * 100000}", code=1)
    demand(len(said) < 5000, "a long value is printed as a whole")


def main():
    """All tests of this file."""
    shutil.rmtree(OUTPUT, ignore_errors=True)
    OUTPUT.mkdir(parents=True)
    for name, test in sorted(globals().items()):
        if name.startswith("test_"):
            print("===", name)
            test()


if __name__ == "__main__":
    main()
