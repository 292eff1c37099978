"""The facets of rigid bodies that a run writes are where its books say that the bodies are.

    rigid_pictures.py KEDGE ROOT WORK

A body that flies and tumbles, in 2D and in 3D: history.csv has its centre and its rotation vector,
from which Rodrigues' formula, a path of its own, gives the place of each corner and its velocity.
Both come from the same state, to round-off: 1e-12 of the body's distance.
"""
import csv
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

SCENE = """set Dimension = {dim}
subsection Rigid bodies
  subsection first
    set Mass   = 1
    set Centre = {origin}
  end
  subsection tumbler
    set Geometry         = {box}
    set Density          = 1
    set Velocity         = {velocity}
    set Angular velocity = {rate}
  end
end
subsection Time
  set End  = 1
  set Step = 0.02
end
subsection Output
  set Points interval = 0.25
end
"""
CASES = {2: {"origin": "0, 0", "box": "box(1, 1; 2, 1.5)", "velocity": "1, 2", "rate": "5"},
         3: {"origin": "0, 0, 0", "box": "box(1, 1, 1; 2, 1.5, 1.2)", "velocity": "1, 2, -1",
             "rate": "1, 4, 2"}}


def rotated(vectors, turn):
    """Vectors turned by the rotation vector `turn`."""
    angle = np.linalg.norm(turn)
    if angle == 0:
        return vectors
    axis = turn / angle
    return (np.cos(angle) * vectors + np.sin(angle) * np.cross(axis, vectors)
            + (1 - np.cos(angle)) * np.outer(vectors @ axis, axis))


def vector(row, what, dim):
    """A vector of the second body in a row of the history; in 2D it turns about z."""
    return np.array([row.get(f"{what}_tumbler_{axis}", 0.0) for axis in "xyz"])


def check(reader, kedge, work, dim):
    """Runs a scene and compares all of its pictures."""
    work.mkdir(parents=True, exist_ok=True)
    scene = work / f"tumbler_{dim}d.prm"
    scene.write_text(SCENE.format(dim=dim, **CASES[dim]), encoding="utf-8")
    output = work / f"{dim}d"
    shutil.rmtree(output, ignore_errors=True)
    subprocess.run([kedge, scene, "-o", output], check=True, stdout=subprocess.DEVNULL)
    with open(output / "history.csv", newline="", encoding="utf-8") as file:
        rows = [{name.strip(): float(text) for name, text in row.items()}
                for row in csv.DictReader(file)]
    series = reader.read_pvd(output / "rigid_bodies.pvd")
    assert len(series) == 5, series # at 0, .25, .. 1
    start, _ = reader.read_surfaces(series[0][1])
    assert np.allclose(start.min(axis=(0, 1))[:dim], 1, atol=1e-15), start
    largest = 0.0
    for time, path in series:
        row = min(rows, key=lambda row: abs(row["time"] - time))
        corners, fields = reader.read_surfaces(path)
        assert np.all(fields["body"] == 1) # the first one has no shape
        lever = start.reshape(-1, 3) - vector(rows[0], "position", dim)
        expected = vector(row, "position", dim) + rotated(lever, vector(row, "rotation", dim))
        largest = max(largest, np.abs(corners.reshape(-1, 3) - expected).max())
        points = reader.read_points(path)
        rate = rotated(vector(row, "body_rate", dim)[None, :], vector(row, "rotation", dim))
        velocity = vector(row, "velocity", dim) + np.cross(
            rate, points.position - vector(row, "position", dim))
        largest = max(largest, np.abs(points.fields["velocity"] - velocity).max())
    print(f"{dim}D: corners and velocities off by {largest}")
    assert largest < 1e-12, largest


def main():
    """Both dimensions."""
    kedge, root, work = map(Path, sys.argv[1:4])
    sys.path.insert(0, str(root / "source/plot"))
    import vtu_reader # pylint: disable=import-outside-toplevel
    for dim in (2, 3):
        check(vtu_reader, kedge, work, dim)


if __name__ == "__main__":
    main()
