#!/usr/bin/env python3
"""Runs the scenes of the gallery and draws its pictures: doc/gallery.md.

    python3 doc/make_gallery.py [KEDGE [FOLDER]]

KEDGE is the program (build/kedge), FOLDER where the runs go (output/gallery).
"""
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
KEDGE = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else ROOT / "build/kedge"
RUNS = Path(sys.argv[2]) if len(sys.argv) > 2 else ROOT / "output/gallery"
PICTURES = ROOT / "doc/pictures/gallery"
DOMAINS = "-s", ("Output/Fields = displacement, velocity, cauchy_stress, pressure, "
                 "von_mises_stress, det_F, half_lengths, deformation_gradient, volume, body")
PLASTIC = "-s", ("Output/Fields = displacement, cauchy_stress, pressure, von_mises_stress, "
                 "equivalent_plastic_strain, half_lengths, deformation_gradient, volume, body")

# title, scene, its options, options of the plot, the picture
GALLERY = [
    ("A ball hits a ring: smooth stress", "prm/quickstart.prm", DOMAINS,
     ("--only", "body"), "body-von_mises_stress"),
    ("The same, each material point by itself", "prm/quickstart.prm", DOMAINS,
     ("--only", "body", "--points", "-n", "3"), "body-von_mises_stress"),
    ("Energies and the error of their books", "prm/quickstart.prm", DOMAINS,
     ("--only", "histories"), "energies"),
    ("Strip footing on clay: load over displacement", "prm/strip_footing.prm", PLASTIC,
     ("--only", "histories"), "load-displacement"),
    ("Strip footing: where the clay flows", "prm/strip_footing.prm", PLASTIC,
     ("--only", "body", "-f", "equivalent_plastic_strain", "-n", "2"),
     "body-equivalent_plastic_strain"),
    ("Two bodies, by name", "prm/crossing_bodies.prm", DOMAINS,
     ("--only", "body", "-f", "body", "-n", "3"), "body-body"),
    ("A block tumbles in space", "prm/block_3d.prm", ("-s", "Constants/h = 0.25"),
     ("--only", "body", "-n", "3"), "body-von_mises_stress"),
    ("Terzaghi's consolidation: effective stress and pore pressure", "prm/terzaghi.prm", (),
     ("--only", "histories", "--log-time"), "probes"),
    ("Undrained triaxial compression", "prm/triaxial.prm", (), (), "element-test"),
    ("A cantilever swings", "prm/cantilever_dynamic_a.prm", DOMAINS,
     ("--only", "body", "-f", "cauchy_stress_xx"), "body-cauchy_stress_xx"),
    ("Two balls meet: the pressure between them", "prm/spheres_collision.prm", (),
     ("--only", "contact", "--view", "-20", "25", "-n", "3"), "contact"),
    ("A prism slides: pressures on both surfaces", "prm/prism_sliding.prm", (),
     ("--only", "contact", "-n", "6"), "contact"),
    ("Two saturated discs collide: pore pressure", "prm/saturated_impact.prm", (),
     ("--only", "body", "-f", "pore_pressure", "-t", "1", "1.4", "2"), "body-pore_pressure"),
    ("Their energies and the error of their books", "prm/saturated_impact.prm", (),
     ("--only", "histories"), "energies"),
]


def call(*line):
    """Runs a command in the project's root; its words only if it fails."""
    done = subprocess.run(list(map(str, line)), cwd=ROOT, capture_output=True, text=True,
                          check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, line))}\n{done.stdout}{done.stderr}")


def main():
    """Runs each scene once, draws each picture, writes the page."""
    shutil.rmtree(PICTURES, ignore_errors=True)
    PICTURES.mkdir(parents=True)
    lines = ["# Gallery", "", "Each picture comes from the two commands below it; all of them from",
             "`python3 doc/make_gallery.py`.", ""]
    done = set()
    for number, (title, scene, options, plot, picture) in enumerate(GALLERY, 1):
        name = Path(scene).stem
        folder = RUNS / name
        if name not in done:
            call(KEDGE, scene, "-o", folder, *options)
            done.add(name)
        drawn = RUNS / "pictures"
        call("/usr/bin/python3", "source/plot/kedge_plot.py", folder, "-o", drawn, "--formats",
             "png", *plot)
        shutil.copy(drawn / f"{picture}.png", PICTURES / f"{number:02d}-{picture}.png")
        words = [f'"{word}"' if " " in word else word for word in options]
        lines += [f"## {title}", "", f"![{title}](pictures/gallery/{number:02d}-{picture}.png)", "",
                  f"    ./kedge {' '.join([scene, *words])}",
                  f"    ./kedge plot {' '.join(['output/' + name, *plot])}", ""]
        print(title)
    (ROOT / "doc/gallery.md").write_text("\n".join(lines), encoding="utf-8")


if __name__ == "__main__":
    main()
