"""transfer_audit.csv against the closed expressions of Tables 3.1 and 3.2, and
against history.csv.

    transfer_audit.py KEDGE ROOT OUTPUT

For a spinning body, with consistent and with blended mass and with both
mappings: both measure the same, to round-off of the body's energy and
momentum; and what the two mappings lose together is what the history says is
lost, since between them the scheme conserves.
"""
import csv
import shutil
import subprocess
import sys
from pathlib import Path

ROUND_OFF = 1e-10


def read(path):
    """The columns of a table."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


def demand_small(values, scale, what):
    """Ends the test unless all values are round-off of `scale`."""
    largest = max(abs(value) for value in values)
    print(f"{what:50} {largest / scale:.1e}")
    if not largest <= ROUND_OFF * scale:
        sys.exit(f"TEST FAILED: {what}: {largest} against {scale}")


def check(output, velocity, lumping):
    """Compares one run's tables."""
    audit, history = read(output / "transfer_audit.csv"), read(output / "history.csv")
    case = f"{velocity}, lumping {lumping}: "
    energy, momentum = history["total_energy"][0], abs(history["angular_momentum_z"][0])
    if audit["step"] != history["step"][1:]:
        sys.exit("TEST FAILED: not one row per accepted step")
    for name, scale in (("linear_momentum_x", momentum), ("linear_momentum_y", momentum)):
        demand_small(audit["p2g_lost_" + name], scale, case + "p2g " + name)
        demand_small(audit["g2p_lost_" + name], scale, case + "g2p " + name)
    demand_small(audit["p2g_lost_angular_momentum_z"], momentum, case + "p2g angular momentum")
    for name, scale in (("p2g_{}_kinetic_energy", energy), ("g2p_{}_kinetic_energy", energy),
                        ("g2p_{}_angular_momentum_z", momentum)):
        difference = [a - b for a, b in zip(audit[name.format("lost")],
                                            audit[name.format("expected")])]
        demand_small(difference, scale, case + name.format("lost - expected"))
    # (change of points) - (change of grid) is minus what g2p loses; the grid conserves
    lost = audit["g2p_lost_angular_momentum_z"]
    books = history["angular_momentum_z"]
    demand_small([b - a + c for a, b, c in zip(books, books[1:], lost)], momentum,
                 case + "angular momentum of the history")
    books, lost = history["total_energy"], audit["g2p_lost_kinetic_energy"]
    demand_small([b - a + c for a, b, c in zip(books, books[1:], lost)], energy,
                 case + "energy of the history")
    return max(map(abs, audit["p2g_expected_kinetic_energy"])) / energy


def main():
    """All cases."""
    kedge, root, output = sys.argv[1], sys.argv[2], Path(sys.argv[3])
    output.parent.mkdir(parents=True, exist_ok=True)
    for velocity in ("flip", "pic"):
        for lumping in ("0", "0.3"):
            shutil.rmtree(output, ignore_errors=True)
            line = [kedge, "prm/spinning_body.prm", "-o", str(output)]
            for entry in ("Constants/h = 1", "Time/End = 1", "Mapping/Audit = true",
                          f"Mapping/Velocity = {velocity}", f"Mapping/Lumping = {lumping}"):
                line += ["-s", entry]
            subprocess.run(line, cwd=root, check=True)
            if check(output, velocity, lumping) < 1e3 * ROUND_OFF:
                sys.exit("TEST FAILED: nothing is lost, so nothing is tested")


if __name__ == "__main__":
    main()
