#!/usr/bin/env python3
"""What the soil laws cost per material point and iteration, beside von Mises' law.

    python3 benchmarks/soil/cost.py build/kedge [--cells 100]

A block of points is sheared at constant volume by conditions on all nodes, from 100 kPa of
pressure until it flows, so that nothing but the points takes time: processor time of residual and
tangent over points times iterations. Elastic: the same with a hundredth of the strain."""
import argparse
import json
import subprocess
import tempfile
from pathlib import Path

SCENE = """
set Dimension = 2
subsection Constants
  set n = {cells}
end
subsection Grid
  set Origin = -0.5, -0.5
  set Extent = 2, 2
  set Cells  = 2*n, 2*n
end
subsection Materials
  subsection soil
    set Density = 2000
{law}
  end
end
subsection Bodies
  subsection block
    set Geometry       = box(0, 0; 1, 1)
    set Material       = soil
    set Initial stress = -1e5; -1e5; -1e5; 0
  end
end
subsection Node conditions
  subsection everywhere
    set Where       = 1
    set Component x = motion(x*(exp({strain}*dt) - 1))
    set Component y = motion(y*(exp(-{strain}*dt) - 1))
  end
end
subsection Time
  set Scheme = quasi-static
  set End    = 1
  set Step   = 0.05
end
subsection Output
  set Points interval = 0
end
"""
MODULI = ["Bulk modulus = 20e6", "Shear modulus = 10e6"]
SAND = ["Cohesion = 1e3", "Friction angle = 30", "Dilation angle = 5"]
LAWS = {
    "hencky": MODULI,
    "von_mises": MODULI + ["Model = von_mises", "Yield radius rho_y = 7e4"],
    "von_mises, s_u, softening": MODULI + ["Model = von_mises", "Undrained strength = 5e4",
                                           "Remoulded strength ratio = 0.3"],
    "tresca": MODULI + ["Model = tresca", "Undrained strength = 5e4"],
    "tresca, softening and rate": MODULI + ["Model = tresca", "Undrained strength = 5e4",
                                            "Remoulded strength ratio = 0.3",
                                            "Rate coefficient = 0.1",
                                            "Reference shear rate = 1e-3"],
    "drucker_prager": MODULI + ["Model = drucker_prager"] + SAND,
    "mohr_coulomb": MODULI + ["Model = mohr_coulomb"] + SAND,
    "modified_cam_clay": ["Model = modified_cam_clay", "Shear modulus = 10e6",
                          "Swelling slope = 0.01", "Compression slope = 0.1",
                          "Initial void ratio = 1", "Critical state slope = 1",
                          "Overconsolidation ratio = 1.2"],
    "critical_state, improved_hencky": MODULI + ["Model = critical_state", "Initial porosity = 0.4",
                                                 "Preconsolidation pressure = 1.5e5",
                                                 "Critical state slope = 0.8", "Surface alpha = 1",
                                                 "Surface gamma = 1"]}


def cost(kedge, law, strain, cells):
    """Microseconds per point and iteration."""
    lines = "\n".join(f"    set {entry}" for entry in law)
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder) / "cost.prm"
        scene.write_text(SCENE.format(law=lines, strain=strain, cells=cells), "utf-8")
        subprocess.run([kedge, scene, "-o", Path(folder) / "out"], check=True,
                       stdout=subprocess.DEVNULL)
        summary = json.loads((Path(folder) / "out/summary.json").read_text("utf-8"))
    phases = summary["phase_cpu_seconds"]
    work = summary["counts"]["material_points"] * summary["newton_iterations"]
    return 1e6 * (phases["residual"] + phases["tangent"]) / work


def main():
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("kedge", type=Path)
    parser.add_argument("--cells", type=int, default=100)
    parser.add_argument("--repeat", type=int, default=3, help="the fastest of so many runs")
    arg = parser.parse_args()
    print("| law | elastic | flowing | flowing over von Mises |\n|---|---|---|---|")
    reference = None
    for name, law in LAWS.items():
        times = [min(cost(arg.kedge.resolve(), law, strain, arg.cells)
                     for _ in range(arg.repeat)) for strain in (2e-4, 2e-2)]
        if name == "von_mises":
            reference = times[1]
        ratio = f"{times[1] / reference:.2f}" if reference else ""
        print(f"| {name} | {times[0]:.3f} | {times[1]:.3f} | {ratio} |", flush=True)


if __name__ == "__main__":
    main()
