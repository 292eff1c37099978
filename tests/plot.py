"""Tests the plot program: plot.py KEDGE_PLOT.py OUTPUT_FOLDER

Writes the files of a small made-up run, reads them back with the program's
own reader (bit for bit: the numbers went in as doubles) in every encoding,
and demands that all pictures are drawn.
"""
import base64
import math
import shutil
import struct
import subprocess
import sys
import zlib
from pathlib import Path

PROGRAM, OUTPUT = Path(sys.argv[1]), Path(sys.argv[2])
sys.path.insert(0, str(PROGRAM.parent))

import numpy as np  # noqa: E402
from history_picture import load_curves  # noqa: E402
from rigid_picture import RigidShapes, outline_of  # noqa: E402
from run_reader import Run  # noqa: E402
from scene_reader import SceneFile, Unknown, evaluate  # noqa: E402
from smooth_field import FilledPart, NodalAverage  # noqa: E402
from vtu_reader import read_points  # noqa: E402

PARAMETERS = """set Dimension = 2
set Title     = A bar swings
subsection Constants
  set a = 2*b
  set b = 0.5
end
subsection Grid
  set Origin = -a, -2
  set Extent = 12, 6
  set Cells  = 12/a, 6
end
subsection Bodies
  subsection bar
    set Geometry = box(0, 0; 10, 2)
  end
end
subsection Node conditions
  subsection foot
    set Reaction    = true
    set Component y = displacement(-a*t/4)
  end
end
"""


def compressed(values):
    """VTK's compressed array in blocks of 64 bytes, as (header, body)."""
    data = values.tobytes()
    blocks = [zlib.compress(data[i:i + 64]) for i in range(0, len(data), 64)]
    header = [len(blocks), 64, len(data) % 64, *map(len, blocks)]
    return struct.pack(f"<{len(header)}Q", *header), b"".join(blocks)


def write_vtu(path, arrays, encoding, squeeze):
    """arrays: {name: (values, component names)}; the first one is the position."""
    appended, lines = b"", []
    for name, (values, labels) in arrays.items():
        values = np.ascontiguousarray(values, dtype="<f8")
        if squeeze:
            header, body = compressed(values)
        else:
            header, body = struct.pack("<Q", values.nbytes), values.tobytes()
        if encoding == "raw":
            data = header + body
        elif squeeze:
            data = base64.b64encode(header) + base64.b64encode(body)
        else:
            data = base64.b64encode(header + body)
        text = f'<DataArray type="Float64" Name="{name}" NumberOfComponents="{values.shape[1]}"'
        text += "".join(f' ComponentName{i}="{label}"' for i, label in enumerate(labels))
        if encoding == "ascii":
            numbers = " ".join(repr(float(value)) for value in values.ravel())
            text += f' format="ascii">{numbers}</DataArray>'
        elif encoding == "inline":
            text += f' format="binary">{data.decode()}</DataArray>'
        else:
            text += f' format="appended" offset="{len(appended)}"/>'
            appended += data
        lines.append(text)
    text = ('<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" '
            'byte_order="LittleEndian" header_type="UInt64"'
            + (' compressor="vtkZLibDataCompressor"' if squeeze else "")
            + f'>\n<UnstructuredGrid>\n<Piece NumberOfPoints="{len(values)}" NumberOfCells="0">\n'
            + f"<Points>\n{lines[0]}\n</Points>\n<PointData>\n" + "\n".join(lines[1:])
            + "\n</PointData>\n</Piece>\n</UnstructuredGrid>\n")
    data = text.encode()
    if appended:
        data += f'<AppendedData encoding="{encoding}">\n_'.encode()
        data += appended + b"\n</AppendedData>\n"
    path.write_bytes(data + b"</VTKFile>\n")


def body(time):
    """A bar of 20 x 4 points that bends and grows, with the fields a run writes."""
    x, y = (grid.ravel() for grid in np.meshgrid(np.arange(20) / 2 + 0.25, np.arange(4) / 2 + 0.25))
    angle, zero, one = 0.1 * time * x, 0 * x, 0 * x + 1
    position = np.stack([x, y + 0.05 * time * x**2, zero], axis=1)
    gradient = np.stack([np.cos(angle), -np.sin(angle), zero, np.sin(angle), np.cos(angle), zero,
                         zero, zero, one], axis=1)
    stress = np.stack([1e4 * time * (y - 1) * (10 - x), zero, zero, 1e3 * y, zero, zero], axis=1)
    return {"Points": (position, []),
            "velocity": (np.stack([zero, 0.05 * x**2, zero], axis=1), list("xyz")),
            "cauchy_stress": (stress, ["xx", "yy", "zz", "xy", "yz", "xz"]),
            "pressure": (-stress[:, :1] / 3, []),
            "body": (0 * stress[:, :1], []), "volume": (0 * stress[:, :1] + 0.25, []),
            "half_lengths": (np.full((len(x), 3), 0.25), list("xyz")),
            "deformation_gradient": (gradient, [a + b for a in "xyz" for b in "xyz"])}


def write_run(folder, frequency):
    """The output folder of a run that swings."""
    (folder / "points").mkdir(parents=True)
    times = np.linspace(0, 4, 161)
    (folder / "parameters.prm").write_text(PARAMETERS, encoding="utf-8")
    with open(folder / "history.csv", "w", encoding="utf-8") as file:
        file.write("step,time,time_step,newton_iterations,linear_iterations,rejected_attempts,"
                   "kinetic_energy,strain_energy,external_work,total_energy,energy_error,"
                   "linear_momentum_x,linear_momentum_y,angular_momentum_z,"
                   "reaction_foot_y,mass,wall_time\n")
        for step, time in enumerate(times):
            kinetic = 1e3 * math.sin(frequency * time) ** 2
            file.write(f"{step},{time},0.025,{3 + step % 2},0,0,{kinetic},{1e3 - kinetic},0,1000,"
                       f"{1e-10 * math.sin(9 * time)},{math.cos(frequency * time)},2,3,{-time / (1 + time)},1,0.1\n")
        file.write("161,4.0") # a row that was being written
    with open(folder / "probes.csv", "w", encoding="utf-8") as file:
        file.write("time,tip.position_x,tip.displacement_x,tip.displacement_y,tip.pressure\n")
        for time in times:
            file.write(f"{time},10,0,{math.sin(frequency * time)},{1e5 * math.cos(time)}\n")
    entries = ""
    for number, time in enumerate((0.0, 1.0, 2.0, 4.0)):
        write_vtu(folder / f"points/points-{number:06d}.vtu", body(time), "raw", True)
        entries += f'<DataSet timestep="{time}" part="0" file="points/points-{number:06d}.vtu"/>\n'
    (folder / "points.pvd").write_text(
        f'<?xml version="1.0"?>\n<VTKFile type="Collection"><Collection>\n{entries}'
        "</Collection></VTKFile>\n", encoding="utf-8")


def test_reader():
    """Every encoding gives back the numbers that went in."""
    expected = body(1.7)
    for encoding in ("ascii", "inline", "base64", "raw"):
        for squeeze in (False, True):
            path = OUTPUT / f"{encoding}-{squeeze}.vtu"
            write_vtu(path, expected, encoding, squeeze)
            points = read_points(path)
            assert np.array_equal(points.position, expected["Points"][0]), path
            for name in list(expected)[1:]:
                assert np.array_equal(points.fields[name], expected[name][0]), (path, name)
            assert np.array_equal(points.values("cauchy_stress_xy"),
                                  expected["cauchy_stress"][0][:, 3]), path


def plot(*options, code=0):
    """Runs the program; gives what it printed."""
    done = subprocess.run([sys.executable, PROGRAM, *map(str, options)], capture_output=True,
                          text=True, check=False)
    assert done.returncode == code, f"exit code {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout + done.stderr


def test_pictures():
    """One run and two runs; every picture exists and is not empty."""
    write_run(OUTPUT / "one", 2)
    write_run(OUTPUT / "two", 3)
    plot(OUTPUT / "one")
    plot(OUTPUT / "one", OUTPUT / "two", "-o", OUTPUT / "both", "--field", "cauchy_stress_xx",
         "--times", "1", "4", "--formats", "svg")
    for folder, endings, bodies in (
            ("one/pictures", ("png", "svg"), ["body-pressure"]),
            ("both", ("svg",), ["body-cauchy_stress_xx-one", "body-cauchy_stress_xx-two"])):
        for name in ["energies", "momenta", "solver", "probes", "reactions", "load-displacement",
                     *bodies]:
            for ending in endings:
                path = OUTPUT / folder / f"{name}.{ending}"
                assert path.stat().st_size > 3000, path


def test_choices():
    """A curve of any two columns, bodies by name, points, ranges, units, a film."""
    out = OUTPUT / "choices"
    plot(OUTPUT / "one", "-o", out, "--formats", "png", "--curve", "probe.tip.displacement_y",
         "history.kinetic_energy", "-f", "body", "-f", "cauchy_stress_xx", "--range", "-50", "50",
         "--stress-unit", "kPa", "--time-unit", "min", "--log-time", "--film", "gif")
    for name in ("curve.png", "body-body.png", "body-cauchy_stress_xx.png",
                 "body-cauchy_stress_xx.gif"):
        assert (out / name).stat().st_size > 3000, name
    plot(OUTPUT / "one", "-o", out / "points", "--formats", "png", "--points", "--only", "body")
    assert (out / "points/body-pressure.png").stat().st_size > 3000
    assert "LOW < HIGH" in plot(OUTPUT / "one", "--range", "2", "1", code=2)
    assert "probe.tip.pressure" in plot(OUTPUT / "one", "--curve", "time", "probe.tip.presure",
                                        "-o", out, code=1)


def test_scene_file():
    """Expressions have the values that they have in a scene."""
    scene = SceneFile(OUTPUT / "one/parameters.prm")
    assert scene.constants == {"a": 1.0, "b": 0.5} # each may use the others, in any order
    origin, cell = scene.grid()
    assert list(origin) == [-1, -2] and list(cell) == [1, 1]
    assert scene.names("Bodies") == ["bar"] and scene.title() == "A bar swings"
    for text, value in (("2^3 - -1", 9), ("if(t > 1 && t < 3, sin(pi/2), 5)", 1), ("min(3, t)", 2)):
        assert evaluate(text, {"t": 2.0}) == value, text
    for text in ("__import__('os')", "t.real", "1/0", "foo(1)", ""):
        try:
            evaluate(text, {"t": 2.0})
        except Unknown:
            continue
        raise AssertionError(text)


def test_derived_columns():
    """Total stress is effective stress less pore pressure; moved supports and platens have curves."""
    folder = OUTPUT / "soil"
    folder.mkdir()
    for section in ("Node conditions", "Body conditions"):
        (folder / "parameters.prm").write_text(PARAMETERS.replace("Node conditions", section)
                                               + "subsection Pore fluid\n set Density = 1e3\nend\n",
                                               encoding="utf-8")
        (folder / "history.csv").write_text("time,reaction_foot_y,total_energy\n0,0,0\n4,-3,0\n",
                                            encoding="utf-8")
        (folder / "probes.csv").write_text(
            "time,a.b.cauchy_stress_yy,a.b.cauchy_stress_xy,a.b.pore_pressure\n0,-5,7,2\n4,-6,7,1\n",
            encoding="utf-8")
        run = Run(folder)
        assert list(run.probes["a.b.total_stress_yy"]) == [-7, -7]
        assert "a.b.total_stress_xy" not in run.probes
        (curve,) = load_curves(run)
        assert list(curve[1]) == [0, 1] and list(curve[2]) == [0, 3] # a t/4 with a = 1


def write_box(path, low, high):
    """The four sides of a rigid box, as a run writes facets: ascii will do."""
    (a, b), (c, d) = low, high
    corners = " ".join(f"{x} {y} 0" for x, y in ((a, b), (c, b), (c, d), (a, d)))

    def array(name, kind, text, n=1):
        return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{n}" format="ascii">'
                f"{text}</DataArray>\n")
    path.write_text(
        '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" byte_order="LittleEndian">\n'
        '<UnstructuredGrid>\n<Piece NumberOfPoints="4" NumberOfCells="4">\n'
        f'<Points>\n{array("Points", "Float64", corners, 3)}</Points>\n<Cells>\n'
        + array("connectivity", "Int64", "0 1 1 2 2 3 3 0") + array("offsets", "Int64", "2 4 6 8")
        + f'</Cells>\n<CellData>\n{array("body", "Int64", "0 0 0 0")}</CellData>\n'
        "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n", encoding="utf-8")


def test_rigid_bodies():
    """A tool is drawn with the material; alone it has pictures, a path and a load of its own."""
    for name, n_points in (("tool", 80), ("rigid", 0)):
        folder = OUTPUT / name
        if n_points:
            shutil.copytree(OUTPUT / "one", folder, ignore=shutil.ignore_patterns("pictures"))
        else:
            folder.mkdir()
        (folder / "history.csv").write_text(
            "step,time,n_points,newton_iterations,time_step,total_energy,energy_error,"
            "linear_momentum_x,position_press_x,"
            "position_press_y,reaction_press_y\n"
            f"0,0,{n_points},0,0,0,0,0,5,4,0\n1,4,{n_points},2,4,3,0,0,5,3,-7\n", encoding="utf-8")
        entries = ""
        for number, (time, sunk) in enumerate(((0.0, 0.0), (4.0, 1.0))):
            write_box(folder / f"box-{number}.vtu", (4, 3 - sunk), (6, 5 - sunk))
            entries += f'<DataSet timestep="{time}" part="0" file="box-{number}.vtu"/>\n'
        (folder / "rigid_bodies.pvd").write_text(
            f'<?xml version="1.0"?>\n<VTKFile type="Collection"><Collection>\n{entries}'
            "</Collection></VTKFile>\n", encoding="utf-8")
        run = Run(folder)
        shapes = RigidShapes(run, None)
        corners, _ = shapes.at(3.9)
        box = outline_of(corners[:, :, :2])
        assert box.contains_point((5, 3)) and not box.contains_point((5, 4.5)) # 2 .. 4 at the end
        # of a tool beyond the soil no more is shown than a part of the soil's size
        assert list(shapes.limits([0.0, 4.0], np.array([4.5, 0.0]), np.array([5.5, 2.0]))[1]) == [6, 3]
        (curve,) = [curve for curve in load_curves(run) if curve[0] == "press, y"]
        assert list(curve[1]) == [0, 1] and list(curve[2]) == [0, 7]
        plot(folder, "--formats", "png")
        for picture in ("trajectories", "load-displacement",
                        "body-pressure" if n_points else "rigid-bodies"):
            assert (folder / f"pictures/{picture}.png").stat().st_size > 3000, picture


def test_smooth_field():
    """A constant stays one, also where no point is; a body fills itself."""
    place = body(0)["Points"][0]
    weights = np.random.default_rng(1).uniform(0.5, 2, len(place))
    average = NodalAverage(place, np.full(len(place), 3.5), weights, [-1, -1], [1, 1])
    everywhere = np.array([[0.3, 0.2, 0], [9.9, 1.99, 0], [-50, 70, 0]])
    # means of equal numbers, but for rounding
    assert np.allclose(average.at(everywhere), 3.5, rtol=1e-14)
    filled = FilledPart(place, np.full(len(place), 0.25)) # 20 x 4 points of 0.5 x 0.5
    # the mean over the body; the hats of half a spacing more let it vary by some percent
    inside = filled.at(np.array([[3, 1, 0], [5.3, 1.1, 0], [8, 0.9, 0]]))
    assert np.all(np.abs(inside - 1) < 0.2), inside
    assert np.all(filled.at(np.array([[20, 1, 0], [5, -3, 0]])) < 0.05)


def test_element_tests():
    """A single point of soil; its curves are drawn, but not beside a body."""
    folder = OUTPUT / "point"
    folder.mkdir()
    columns = ["time", "strain_z", "volume_strain", "pressure", "deviator_stress",
               "pore_pressure", "void_ratio"]
    rows = [[t, -0.01 * t, -0.001 * t, 1e5 * t, 2e5 * t, 3e4 * t, 0.25 - 0.001 * t]
            for t in range(5)]
    (folder / "history.csv").write_text(
        "\n".join(",".join(map(str, row)) for row in [columns, *rows]) + "\n", encoding="utf-8")
    plot(folder)
    assert (folder / "pictures/element-test.png").stat().st_size > 3000
    assert "single material point" in plot(folder, OUTPUT / "one", code=1)


def test_bad_input():
    """A wrong folder and a wrong field are the user's errors and say what is right."""
    assert "no folder" in plot(OUTPUT / "nowhere", code=1)
    assert "cauchy_stress_xx" in plot(OUTPUT / "one", "--field", "sress", "--formats", "svg", code=1)


def test_without_matplotlib():
    """A Python that finds no packages: what to install, and no traceback."""
    run = subprocess.run([sys.executable, "-S", PROGRAM, OUTPUT / "one"], text=True,
                         capture_output=True, check=False)
    assert run.returncode == 1 and "apt-get install python3-matplotlib" in run.stderr, run.stderr
    assert "Traceback" not in run.stderr, run.stderr


shutil.rmtree(OUTPUT, ignore_errors=True)
OUTPUT.mkdir(parents=True)
test_reader()
test_pictures()
test_choices()
test_scene_file()
test_derived_columns()
test_rigid_bodies()
test_smooth_field()
test_element_tests()
test_bad_input()
test_without_matplotlib()
print("all pictures drawn")
