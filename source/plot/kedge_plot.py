#!/usr/bin/env python3
"""Pictures of kedge's runs: energies and their error, momenta, reactions, loads over
displacements, the solver's work, probes, and the body at chosen times coloured by a field;
the pressures on surfaces in contact; rigid bodies and the paths of their centres;
of element tests of soil the curves of stress and strain, of other single points the stress over
time."""
import argparse
import sys
from pathlib import Path

import style
from body_picture import BodyPicture
from contact_picture import draw_contact
from film import write_film
from history_picture import Histories
from rigid_picture import draw_rigid
from run_reader import NoRun, Run, name_apart
from soil_picture import draw_element_tests, draw_paths, is_element_test, is_path
from vtu_reader import BadFile

plt = style.plt

EXAMPLES = """examples
  kedge plot output/quickstart
  kedge plot output/a output/b -o comparison          several runs in one figure
  kedge plot output/quickstart -f pressure -t 0 0.5 1
  kedge plot output/strip_footing -f cauchy_stress_yy --range -100 0 --stress-unit kPa
  kedge plot output/run --curve probe.tip.displacement_y history.reaction_base_y
  kedge plot output/quickstart --film gif             an animation"""


def arguments():
    """The command line, parsed."""
    parser = argparse.ArgumentParser(prog="kedge plot", description=__doc__, epilog=EXAMPLES,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", metavar="DIR", help="output folder of a run")
    parser.add_argument("-o", "--output", type=Path, metavar="OUT",
                        help="folder for the pictures (default: DIR/pictures of the first DIR)")
    parser.add_argument("-f", "--field", action="append", metavar="NAME",
                        help="what the body is coloured by, e.g. pressure, cauchy_stress_yy, "
                             "velocity, body; repeatable")
    parser.add_argument("-t", "--times", type=float, nargs="+", metavar="T",
                        help="simulated times at which the body is shown [s]")
    parser.add_argument("-n", "--snapshots", type=int, default=6, metavar="N",
                        help="without --times: number of evenly spread times (default: 6)")
    parser.add_argument("--points", action="store_true",
                        help="each material point in its own colour, instead of the mean at the "
                             "grid's nodes")
    parser.add_argument("--range", type=float, nargs=2, metavar=("LOW", "HIGH"),
                        help="of the colours, in the unit that the bar shows")
    parser.add_argument("--view", type=float, nargs=2, default=(-60, 25),
                        metavar=("AZIMUTH", "HEIGHT"),
                        help="degrees from which a body in space is seen (default: -60 25)")
    parser.add_argument("--curve", nargs=2, action="append", metavar=("ACROSS", "UP"),
                        help="a figure of one column over another, e.g. "
                             "probe.tip.displacement_y history.reaction_base_y; repeatable")
    parser.add_argument("--film", choices=("gif", "mp4"), help="an animation of all output times")
    parser.add_argument("--log-time", action="store_true", help="logarithmic axis of time")
    parser.add_argument("--time-unit", choices=("auto", *style.SECONDS), default="auto",
                        help="d: days, a: years")
    parser.add_argument("--stress-unit", choices=("auto", "Pa", "kPa", "MPa", "GPa"),
                        default="auto")
    parser.add_argument("--only", choices=("histories", "body", "contact"), help="one kind of picture")
    parser.add_argument("--formats", default="png,svg", help="default: png,svg")
    arg = parser.parse_intermixed_args()
    if arg.snapshots < 1:
        parser.error("--snapshots must be at least 1")
    if arg.range and not arg.range[0] < arg.range[1]:
        parser.error("--range needs LOW < HIGH")
    return arg


def save(figure, output, name, formats):
    """Writes a figure in all formats and says so."""
    for ending in formats.split(","):
        path = output / f"{name}.{ending.strip()}"
        figure.savefig(path)
        print(path)
    plt.close(figure)


def draw_histories(arg, runs, output):
    """All pictures of tables that the runs have data for."""
    histories = Histories(runs, arg)
    for number, (across, up) in enumerate(arg.curve or []):
        name = "curve" if number == 0 else f"curve-{number + 1}"
        save(histories.curve(across, up), output, name, arg.formats)
    for name, draw in (("energies", histories.energies), ("momenta", histories.momenta),
                       ("reactions", histories.reactions),
                       ("load-displacement", histories.load_displacement),
                       ("trajectories", histories.trajectories),
                       ("solver", histories.solver), ("probes", histories.probes)):
        figure = draw()
        if figure is not None:
            save(figure, output, name, arg.formats)


def draw_bodies(arg, runs, output):
    """The body of each run in each field."""
    for run in runs:
        which = "" if len(runs) == 1 else "-" + run.name.replace("/", "-")
        if "n_points" in run.history and run.history["n_points"][0] == 0:
            arg.time_unit = style.time_unit(run.history["time"][-1], arg.time_unit)
            figure = draw_rigid(run, arg)
            if figure is not None:
                save(figure, output, f"rigid-bodies{which}", arg.formats)
            continue
        if not run.points_file.exists():
            print(f"{run.folder} has no points.pvd: no picture of the body (Output/Formats = vtu, "
                  "Output/Points interval)", file=sys.stderr)
            continue
        arg.time_unit = style.time_unit(run.history["time"][-1], arg.time_unit)
        for field in arg.field or [None]:
            picture = BodyPicture(run, field, arg)
            name = f"body-{picture.field}{which}"
            figure = picture.figure()
            if figure is not None:
                save(figure, output, name, arg.formats)
                if arg.film:
                    print(write_film(picture, output / f"{name}.{arg.film}"))


def draw_contacts(arg, runs, output):
    """The pressures on surfaces in contact of each run that has them."""
    for run in runs:
        which = "" if len(runs) == 1 else "-" + run.name.replace("/", "-")
        figure = draw_contact(run, arg)
        if figure is not None:
            save(figure, output, f"contact{which}", arg.formats)


def draw_all(arg, runs, output):
    """All pictures that the runs have data for."""
    if all(map(is_element_test, runs)):
        save(draw_element_tests(runs), output, "element-test", arg.formats)
        return
    if all(map(is_path, runs)):
        save(draw_paths(runs), output, "path", arg.formats)
        return
    for run in runs:
        if "energy_error" not in run.history:
            raise NoRun(f"{run.folder} holds a single material point, which is not drawn together "
                        "with runs of bodies")
    if arg.only in (None, "histories"):
        draw_histories(arg, runs, output)
    if arg.only in (None, "body"):
        draw_bodies(arg, runs, output)
    if arg.only in (None, "contact"):
        draw_contacts(arg, runs, output)


def main():
    """Ends with 1 if something is wrong with what the user gave."""
    arg = arguments()
    try:
        runs = name_apart([Run(folder) for folder in arg.folders])
        output = arg.output or runs[0].folder / "pictures"
        output.mkdir(parents=True, exist_ok=True)
        style.set_style()
        draw_all(arg, runs, output)
    except BrokenPipeError: # whoever read the names of the pictures has left
        sys.stderr.close()
    except (NoRun, BadFile, OSError, ValueError) as error:
        sys.exit(f"kedge plot: {error}")


if __name__ == "__main__":
    main()
