"""Tests `kedge init`, `kedge sweep` and `kedge safety`: tools.py KEDGE ROOT OUTPUT"""
import csv
import re
import shutil
import subprocess
import sys
from pathlib import Path

KEDGE, ROOT, OUTPUT = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), Path(sys.argv[3])
TOOLS = ROOT / "source/tools"


def call(*line, code=0):
    """Runs a command in OUTPUT; returns what it says on both streams."""
    done = subprocess.run(list(map(str, line)), cwd=OUTPUT, capture_output=True, text=True,
                          check=False)
    print(" ".join(map(str, line)), done.stdout, done.stderr, sep="\n")
    assert done.returncode == code, f"exit code {done.returncode} instead of {code}"
    return done.stdout + done.stderr


def init(*arguments, code=0):
    """kedge init"""
    return call(sys.executable, TOOLS / "kedge_init.py", *arguments, code=code)


def sweep(*arguments, code=0):
    """kedge sweep"""
    return call(sys.executable, TOOLS / "kedge_sweep.py", "--kedge", KEDGE, *arguments, code=code)


def table(folder):
    """sweep.csv as a list of dictionaries."""
    with open(OUTPUT / folder / "sweep.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_init():
    """Each kind of scene runs as it is and gives its known answer."""
    for kind in ("solid", "footing", "soil"):
        assert f"{kind}-scene.prm" in init(f"{kind}-scene", kind)
        text = (OUTPUT / f"{kind}-scene.prm").read_text("utf-8")
        assert f"./kedge {kind}-scene.prm" in text and "NAME" not in text
        assert "PASS" in call(KEDGE, f"{kind}-scene.prm", "--strict")
        assert "note:" not in call(KEDGE, f"{kind}-scene.prm", "--validate")
    assert "cannot write solid-scene.prm: File exists" in init("solid-scene", code=1)


def test_sweep():
    """All combinations; the reaction of the ground is the pressure times the width."""
    init("press", "solid")
    sweep("press.prm", "-s", "Constants/p = 1e5, 2e5", "-s", "Constants/B = 1 | 2",
          "-s", "Constants/h = 0.5", "-q", "last(history.reaction_ground_y)", "-o", "table",
          "-j", "2")
    rows = table("table")
    assert len(rows) == 4
    for row in rows: # equilibrium, to the tolerance of Newton's method
        force = float(row["Constants/p"]) * float(row["Constants/B"])
        assert abs(float(row["last(history.reaction_ground_y)"]) - force) < 1e-6 * force, row
        assert row["exit_code"] == "0" and (OUTPUT / "table" / row["folder"]).is_dir()
    assert (OUTPUT / "table/sweep.png").stat().st_size > 3000
    said = sweep("press.prm", "-s", "Constants/p = 1e5, 2e5", "-s", "Constants/B = 1, 2", "-s",
                 "Constants/h = 0.5", "-o", "table", "--resume")
    assert said.count("finished before") == 4


def test_sweep_goes_on():
    """A run that cannot be used leaves the others alone and shows in the exit code."""
    sweep("press.prm", "-s", "Constants/p = 1e5, -x", "-s", "Constants/h = 0.5, 0.5", "--pair",
          "-o", "mixed", code=1)
    assert [row["exit_code"] for row in table("mixed")] == ["0", "1"]
    assert [row["reaction"] != "" for row in table("mixed")] == [True, False]


def test_wrong_sweeps():
    """What the user may get wrong is said before anything runs."""
    for arguments, words in ((["-s", "Constants/p"], "does not have the form"),
                             (["-s", "Constants/p = 1"], "nothing to sweep"),
                             (["-s", "Constants/p = 1, 2", "-s", "Constants/B = 1, 2, 3",
                               "--pair"], "as many values"),
                             (["-s", "Constants/p = 1, 2", "-q", "mean(history.mass)"],
                              "is no quantity")):
        assert words in sweep("press.prm", *arguments, "-o", "wrong", code=1)
    assert "no scene" in sweep("nowhere.prm", "-s", "a = 1, 2", code=1)
    # a column that no run writes is known once the first one has ended, not when all have
    said = sweep("press.prm", "-s", "Constants/p = 1, 2, 3, 4, 5", "-q", "last(history.load)",
                 "-j", "1", "-o", "unknown", code=1)
    assert "has no column 'load'" in said, said
    assert len(list((OUTPUT / "unknown").glob("00*"))) <= 2, said


def safety(*arguments, code=0):
    """kedge safety"""
    return call(sys.executable, TOOLS / "kedge_safety.py", "--kedge", KEDGE, *arguments, code=code)


def test_safety():
    """The slope's factor; Griffiths and Lane have 1.4, five cells over its height 6 % more."""
    slope = ROOT / "prm/slope.prm"
    said = safety(slope, "-s", "Constants/n = 5", "--between", "1.3", "1.7", "--tolerance", "0.03",
                  "-o", "factor", "-j", "2")
    factor = float(re.search(r"safety factor: ([0-9.]+)", said)[1])
    assert 1.4 < factor < 1.4 * 1.08, factor
    with open(OUTPUT / "factor/safety.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    verdicts = [row["verdict"] == "stands" for row in rows] # by factor: it stands, then it fails
    assert verdicts == sorted(verdicts, reverse=True) and len(rows) >= 4
    for row in rows:
        assert (float(row["strength_reduction"]) < factor) == (row["verdict"] == "stands")


def test_wrong_safety():
    """What cannot be bracketed is said."""
    slope, coarse = ROOT / "prm/slope.prm", ["-s", "Constants/n = 5", "-o", "wrong"]
    assert "larger HIGH" in safety(slope, *coarse, "--between", "1", "1.1", code=1)
    assert "smaller LOW" in safety(slope, *coarse, "--between", "1.8", "2", code=1)
    assert "no scene" in safety("nowhere.prm", code=1)
    assert "must not be less" in safety(slope, "-s", "Materials/soil/Cohesion = -1", code=1)


shutil.rmtree(OUTPUT, ignore_errors=True)
OUTPUT.mkdir(parents=True)
test_init()
test_sweep()
test_sweep_goes_on()
test_wrong_sweeps()
test_safety()
test_wrong_safety()
print("init, sweep and safety do what they say")
