"""Tests of `import kedge`: python_module.py KEDGE MPIRUN OUTPUT, with the module in PYTHONPATH.

Runs in the module are compared with those of the program, which are tested elsewhere, and with
closed forms.
"""
import csv
import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

import kedge

KEDGE, MPIRUN, OUTPUT = Path(sys.argv[1]).resolve(), sys.argv[2], Path(sys.argv[3]).resolve()
LENGTH, MODULUS, DENSITY = 1., 1e6, 1000.


def bar(**more):
    """A bar along x, held at its left end, pulled at its right one until t = 1 s."""
    scene = {
        "Dimension": 2,
        "Constants": {"p": 1e4, "n": 4},
        "Grid": {"Extent": [1.5, 0.5], "Cells": ["1.5*n", "0.5*n"]},
        "Materials": {"rubber": {"Density": DENSITY, "Young's modulus": MODULUS,
                                 "Poisson's ratio": 0}},
        "Bodies": {"bar": {"Geometry": "box(0, 0; 1, 0.25)", "Material": "rubber",
                           "Points per cell": 2, "Initial velocity": [0, 0]}},
        "Node conditions": {"wall": {"Side": "left", "Component x": "fixed", "Reaction": True},
                            "floor": {"Side": "bottom", "Component y": "fixed"}},
        "Tractions": {"pull": {"Body": "bar", "Side": "right", "Traction": ["p*t", 0]}},
        "Time": {"Scheme": "quasi-static", "End": 1, "Step": 0.125},
        "Output": {"Fields": ["displacement", "cauchy_stress"]}}
    def merge(into, entries):
        for name, value in entries.items():
            if isinstance(value, dict):
                merge(into.setdefault(name, {}), value)
            else:
                into[name] = value
    merge(scene, more)
    return kedge.Scene(scene, name="bar")


def raises(error, words, action):
    """What `action` raises has these words."""
    try:
        action()
    except error as caught:
        for word in words:
            assert word in str(caught), f"'{word}' is not in: {caught}"
        return
    raise AssertionError(f"no {error.__name__}")


def table(path):
    """A CSV file as arrays."""
    with open(path, newline="", encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    return dict(zip(names, np.array(rows, dtype=float).T))


def same_histories(a, b):
    """All columns but the clock's, bit for bit."""
    assert set(a) == set(b)
    for name in a:
        if name != "wall_time":
            assert np.array_equal(a[name], b[name]), name


def test_scene():
    """A dictionary gives the file that one would write; entries can be read and set."""
    scene = bar()
    assert scene["Grid/Cells"] == "1.5*n, 0.5*n"
    assert scene["Bodies/bar/Initial velocity"] == "0; 0" # an entry of expressions
    assert scene["Tractions/pull/Traction"] == "p*t; 0"
    assert scene["Node conditions/wall/Reaction"] == "true"
    assert "subsection Materials\n  subsection rubber\n    set Density = 1000.0\n" in str(scene)
    other = scene.copy()
    other["Constants/p"] = 5
    assert (scene["Constants/p"], other["Constants/p"]) == ("10000.0", "5")
    assert "Time/Step" in scene and "Time/step" not in scene
    raises(KeyError, ["Time/step"], lambda: scene["Time/step"])
    raises(TypeError, ["Time/End", "NoneType"], lambda: bar(Time={"End": None}))
    assert "material points:" in scene.validate()
    file = OUTPUT / "written.prm"
    file.write_text(str(scene), "utf-8")
    assert str(kedge.Scene.read(file)) == str(scene)
    raises(FileNotFoundError, ["nowhere.prm"], lambda: kedge.Scene.read("nowhere.prm"))


def test_errors():
    """kedge's message, all errors at once, with the names nearest to what was meant."""
    wrong = bar(Time={"Stp": 1}, Materials={"rubber": {"Density": -1}})
    raises(kedge.UserError, ["Time/Stp", "Did you mean 'Step'?", "Materials/rubber/Density", "bar"],
           lambda: kedge.Run(wrong))
    assert issubclass(kedge.UserError, ValueError)
    with kedge.Run(bar()) as run:
        raises(kedge.UserError, ["cauchy_stres", "cauchy_stress"], lambda: run.field("cauchy_stres"))
        raises(kedge.UserError, ["do not remember 'velocty'", "velocity"],
               lambda: run.view("velocty"))
    raises(kedge.UserError, ["closed"], run.step)


def test_same_as_program():
    """Step by step in Python and as the program does it; the answer is that of the theory."""
    file = OUTPUT / "bar.prm"
    file.write_text(str(bar()), "utf-8")
    subprocess.run([KEDGE, file, "-o", OUTPUT / "program"], check=True, stdout=subprocess.DEVNULL)
    seen = []
    with kedge.Run(file, OUTPUT / "module") as run:
        assert (run.time, run.n_steps, run.dimension, run.has_ended) == (0., 0, 2, False)
        run.run(lambda r: seen.append((r.n_steps, r.time)), every=2)
        assert seen == [(2, 0.25), (4, 0.5), (6, 0.75), (8, 1.)]
        assert run.has_ended and run.summary["status"] == "finished" and not run.step()
        stress, place = run.field("cauchy_stress"), run.field("position")
        assert stress.shape == (len(run.ids), 6) and place.shape == (len(run.ids), 3)
    same_histories(table(OUTPUT / "program/history.csv"), dict(run.history))
    same_histories(table(OUTPUT / "module/history.csv"), dict(run.history))
    # equilibrium, to the accuracy of Newton's method
    assert abs(run.history["reaction_wall_x"][-1] + 1e4 * 0.25) < 1e-6 * 1e4
    # Hencky's law in tension, nu = 0, F = l: E ln l = tau, the nominal stress tau/l = p; in the
    # middle of the bar, as the grid shows it, to the error of its four cells
    ratio = next(l for l in np.linspace(1, 1.02, 200001) if math.log(l) / l >= 1e4 / MODULUS)
    middle = np.abs(place[:, 0] - 0.5) < 0.2
    assert np.allclose(stress[middle, 0], 1e4, rtol=1e-2), stress[middle, 0]
    assert abs(ratio - 1.0102) < 1e-4


def test_results_of_the_program():
    """Tables of a run that the program has done; a wrong name says which are like it."""
    results = kedge.Results(OUTPUT / "program")
    same_histories(table(OUTPUT / "program/history.csv"), results.history)
    assert results.summary["status"] == "finished" and results.probes == {}
    assert results.checks == results.summary["checks"]
    with kedge.Run(bar()) as run:
        for columns in (results.history, run.history):
            try:
                columns["reaction_wall"]
                raise AssertionError("no error")
            except KeyError as error:
                assert "did you mean" in str(error) and "reaction_wall_x" in str(error), error
    try:
        kedge.Results(OUTPUT / "nowhere")
        raise AssertionError("no error")
    except FileNotFoundError as error:
        assert "history.csv" in str(error), error


def test_stop_and_resume():
    """A callback that returns False; a checkpoint, from which another run goes on."""
    with kedge.Run(bar(), OUTPUT / "whole") as whole:
        whole.run()
    with kedge.Run(bar(), OUTPUT / "parts") as first:
        first.run(lambda run: run.n_steps < 3)
        assert (first.n_steps, first.has_ended) == (3, False)
        assert first.step() and first.n_steps == 4
        first.checkpoint()
    with kedge.Run(bar(), OUTPUT / "parts", resume=True) as second:
        assert second.n_steps == 4
        second.run()
    same_histories(table(OUTPUT / "whole/history.csv"), table(OUTPUT / "parts/history.csv"))
    assert second.history["time"][0] == 0.5 and second.history["time"][-1] == 1


def test_histories_are_no_copies():
    """Arrays that were taken keep their length and numbers while the run goes on."""
    with kedge.Run(bar(Time={"Step": "1/100"})) as run:
        run.run(lambda r: r.n_steps < 10)
        early = run.history["time"]
        again = run.history["time"]
        assert np.shares_memory(early, again) and not early.flags.writeable
        copied = early.copy()
        run.run() # past the size at which the table grows
    assert len(early) == 11 and np.array_equal(early, copied)
    assert np.allclose(run.history["time"], np.arange(101) / 100, atol=1e-12)
    assert np.array_equal(run.history["step"], np.arange(101))


def test_views():
    """The points' memory in place: the same numbers as the field, and no step meanwhile."""
    with kedge.Run(bar()) as run:
        run.step()
        view, again = run.view("displacement"), run.view("displacement")
        assert np.shares_memory(view, again) and not view.flags.writeable
        order = np.argsort(run.view_ids)
        assert np.array_equal(view[order], run.field("displacement")[:, :2])
        assert np.array_equal(run.view("position")[order], run.field("position")[:, :2])
        gradient = run.view("deformation_gradient")[order]
        assert np.array_equal(gradient, run.field("deformation_gradient")[:, :2, :2])
        stress = run.view("kirchhoff_stress")[order]
        assert np.array_equal(stress, run.field("kirchhoff_stress")[:, [0, 1, 3]])
        assert {"position", "mass", "velocity"} <= set(run.views)
        assert "pore_pressure" not in run.views # a dry body does not store one
        part = again[3:5, 0]
        del again, view
        raises(BufferError, ["view", "numpy.array"], run.step)
        moved = np.array(part)
        del part
        assert run.step()
        assert not np.array_equal(run.view("displacement")[3:5, 0], moved)
        kept = run.view("mass")
    # the run is closed; what is looked at stays: rho V, the bar's mass
    assert abs(kept.sum() - DENSITY * LENGTH * 0.25) < 1e-9 * DENSITY


def test_stops():
    """A run that cannot go on: a dead load beyond what the bar bears; and a signal."""
    scene = bar(Materials={"rubber": {"Model": "von_mises", "Uniaxial yield stress sigma_y": 5e3}})
    run = kedge.Run(scene)
    raises(kedge.NumericalStop, ["Newton"], run.run)
    assert run.summary["status"] == "numerical_stop" and 0.3 < run.time < 0.8
    run.close()
    code = ("import kedge, os, signal, sys\n"
            "with kedge.Run(sys.argv[1], sys.argv[2]) as run:\n"
            "    def stop(r):\n        os.kill(os.getpid(), signal.SIGINT)\n"
            "    run.run(stop)\n")
    done = subprocess.run([sys.executable, "-c", code, OUTPUT / "bar.prm", OUTPUT / "stopped"],
                          check=False, capture_output=True, text=True)
    assert done.returncode in (1, 130, -2) and "KeyboardInterrupt" in done.stderr, done


def test_sweep():
    """All combinations, in processes of their own or in this one; failures stay in their row."""
    def measure(run):
        return {"tip": run.field("displacement")[:, 0].max(), "steps": run.n_steps}
    settings = {"Constants/p": [1e4, 2e4], "Materials/rubber/Young's modulus": [1e8, -1]}
    rows = kedge.sweep(bar(), settings, measure, processes=2, output=OUTPUT / "sweep")
    assert [row["error"] is None for row in rows] == [True, False, True, False]
    assert "UserError" in rows[1]["error"] and "Young's modulus" in rows[1]["error"]
    assert abs(rows[2]["tip"] / rows[0]["tip"] - 2) < 1e-3 # nearly linear: strains of 1e-4
    assert (OUTPUT / "sweep/002/summary.json").exists()
    assert kedge.sweep(bar(), settings, measure, processes=1) == rows
    pairs = kedge.sweep(bar(), {"Constants/p": [1, 2], "Constants/n": [4, 8]}, measure, pair=True)
    assert [(row["Constants/p"], row["Constants/n"]) for row in pairs] == [(1, 4), (2, 8)]
    raises(ValueError, ["pair"], lambda: kedge.sweep(bar(), {"a": [1], "b": [1, 2]}, measure,
                                                     pair=True))


def test_drive():
    """A single point in uniaxial strain: tau_xx = (lambda + 2 mu) ln F = E ln F for nu = 0."""
    path = kedge.drive({"Materials": {"rubber": {"Density": 1, "Young's modulus": MODULUS,
                                                 "Poisson's ratio": 0}},
                        "Path": {"Material": "rubber", "End": 1, "Steps": 10,
                                 "Deformation gradient": "1 + t, 0, 0; 0, 1, 0; 0, 0, 1"}})
    assert np.allclose(path["kirchhoff_stress_xx"], MODULUS * np.log(1 + path["time"]), rtol=1e-12)


def test_ranks():
    """Two processes: the books of the whole in each, points shared out."""
    # each into a file of its own: what two processes print may be mixed
    code = ("import kedge, sys\n"
            "with kedge.Run(sys.argv[1], sys.argv[2]) as run:\n"
            "    run.run()\n"
            "    with open(f'{sys.argv[3]}.{kedge.rank()}', 'w', encoding='utf-8') as said:\n"
            "        print(kedge.n_ranks(), len(run.ids),\n"
            "              repr(float(run.history['strain_energy'][-1])), file=said)\n")
    environment = {**os.environ, "OMPI_MCA_rmaps_base_oversubscribe": "1",
                   "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    done = subprocess.run([MPIRUN, "-np", "2", sys.executable, "-c", code, OUTPUT / "bar.prm",
                           OUTPUT / "ranks", OUTPUT / "said"], check=False, capture_output=True, text=True,
                          env=environment)
    assert done.returncode == 0, done
    lines = [(OUTPUT / f"said.{rank}").read_text(encoding="utf-8").split() for rank in (0, 1)]
    assert lines[0][0] == lines[1][0] == "2" and lines[0][2] == lines[1][2], lines
    serial = table(OUTPUT / "program/history.csv")
    assert sum(int(line[1]) for line in lines) == serial["n_points"][-1]
    assert abs(float(lines[0][2]) / serial["strain_energy"][-1] - 1) < 1e-9


def test_quiet_end():
    """Python ends without a word while a run and a view are open; the log is shown if asked for."""
    code = ("import kedge, sys\nrun = kedge.Run(sys.argv[1], log=len(sys.argv) > 2)\n"
            "run.step()\nview = run.view('mass')\n")
    folders = OUTPUT / "folders"  # where runs without a folder of their own make theirs
    folders.mkdir()
    for options in ([], ["log"]):
        done = subprocess.run([sys.executable, "-c", code, OUTPUT / "bar.prm", *options],
                              check=False, capture_output=True, text=True,
                              env={**os.environ, "TMPDIR": str(folders)})
        assert done.returncode == 0 and done.stderr == "", done
        assert ("material points in" in done.stdout) == bool(options), done.stdout
    assert not list(folders.glob("kedge-*")), "a folder of a run was left behind"


shutil.rmtree(OUTPUT, ignore_errors=True)
OUTPUT.mkdir(parents=True)
for name, test in list(globals().items()):
    if name.startswith("test_"):
        print(name, flush=True)
        test()
print("import kedge does what it says")
