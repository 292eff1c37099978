"""The surfaces that a run with contact writes carry the forces that its books hold.

    contact_surfaces.py KEDGE ROOT WORK

Of each output time: the forces of the facets of the first body, and those against it of the
second body's, add up to contact_force of history.csv, which is summed elsewhere: to round-off,
1e-12 of the forces' size. The pressure is the other way to the same number: pressure times length
over the facets of both sides, each of which bears half, is the size of the force where the contact
is flat and frictionless: to the strain of the surface, by which facets are shorter than at the start, for which
they bear: (1 + nu)(1 - 2 nu) p/E, at most 5e-3. Friction is told by the states.
"""
import csv
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

ALONE, OPEN, STICKS, SLIDES = range(4)


def fail(message):
    """Ends the test."""
    sys.exit(f"TEST FAILED: {message}")


class Pictures:
    """The surfaces of a run and the rows of its history at their times."""

    def __init__(self, reader, command, output, settings):
        kedge, root = command
        shutil.rmtree(output, ignore_errors=True)
        line = [kedge, settings[0], "-o", str(output)]
        for entry in settings[1:]:
            line += ["-s", entry]
        subprocess.run(line, cwd=root, check=True, stdout=subprocess.DEVNULL)
        with open(output / "history.csv", newline="", encoding="utf-8") as file:
            rows = [{name.strip(): float(text) for name, text in row.items()}
                    for row in csv.DictReader(file)]
        self.pictures = []
        for time, path in reader.read_pvd(output / "surfaces.pvd"):
            row = min(rows, key=lambda row: abs(row["time"] - time))
            self.pictures.append((row, *reader.read_surfaces(path)))
        if len(self.pictures) < 2:
            fail(f"{output} has {len(self.pictures)} pictures")

    def compare_forces(self, pair, first):
        """The sums over facets against the books; the number of pictures that press."""
        n_pressed = 0
        for row, _, fields in self.pictures[1:]: # facets show a step; there was none before
            on_first = np.where(fields["body"] == first, 1.0, -1.0)
            force = (on_first * fields["contact_force"]).sum(axis=0)
            size = np.abs(fields["contact_force"]).sum()
            n_pressed += size > 0
            for direction in range(3):
                booked = row.get(f"contact_force_{'xyz'[direction]}_{pair}", 0.0)
                if abs(force[direction] - booked) > 1e-12 * size:
                    fail(f"{pair} at t = {row['time']}: facets have {force}, the books {booked}")
        return n_pressed

    def last(self):
        """Row, corners, fields of the last picture."""
        return self.pictures[-1]


def main():
    """A layer under a parabola, a block on a wall, balls in space."""
    command, work = (sys.argv[1], sys.argv[2]), Path(sys.argv[3])
    sys.path.insert(0, str(Path(sys.argv[2]) / "source/plot"))
    import vtu_reader # pylint: disable=import-outside-toplevel
    work.mkdir(parents=True, exist_ok=True)

    hertz = Pictures(vtu_reader, command, work / "hertz",
                     ("prm/hertz_line.prm", "Constants/n = 12", "Constants/steps = 2"))
    hertz.compare_forces("line", 1)
    row, corners, fields = hertz.last()
    length = np.linalg.norm(corners[:, 1] - corners[:, 0], axis=1)
    load = 0.5 * np.sum(fields["contact_pressure"][:, 0] * length)
    print("pressure times length", load, "force", row["contact_force_y_line"])
    if not abs(load / row["contact_force_y_line"] - 1) < 5e-3:
        fail("the pressures do not add up to the force")
    pressed = fields["contact_pressure"][:, 0] > 0
    if not (np.all(fields["state"][pressed] == SLIDES) and
            np.all(fields["partner"][pressed] == 1 - fields["body"][pressed]) and
            np.all(np.abs(fields["gap"][pressed]) < 1e-3 / 12 * 1.001)):
        fail("states, partners or gaps of what presses without friction")
    alone = fields["state"][:, 0] == ALONE
    if not (alone.any() and np.all(np.isnan(fields["gap"][alone])) and
            np.all(fields["partner"][alone] == -1)):
        fail("facets that see nothing")

    for mu, state in (("0.6", STICKS), ("0.2", SLIDES)):
        block = Pictures(vtu_reader, command, work / "block",
                         ("prm/block_on_slope.prm", f"Constants/mu = {mu}"))
        if block.compare_forces("sole", 0) == 0:
            fail("the block never pressed")
        row, _, fields = block.last()
        pressed = fields["contact_pressure"][:, 0] > 0
        share = np.mean(fields["state"][pressed] == state)
        speed = np.linalg.norm(fields["slip_rate"][pressed], axis=1).max()
        print("mu", mu, "share of pressed facets in the state expected", share, "speed", speed)
        if share < 1 or np.any(fields["partner"][pressed] != -2):
            fail(f"states {fields['state'][pressed].ravel()}")
        moves = speed > 1e-3
        if moves != (state == SLIDES):
            fail(f"the block's surface moves with {speed} m/s")

    balls = Pictures(vtu_reader, command, work / "balls",
                     ("prm/spheres_collision.prm", "Output/Points every steps = 1"))
    if balls.compare_forces("balls", 0) < 3:
        fail("the balls hardly touched")


if __name__ == "__main__":
    main()
