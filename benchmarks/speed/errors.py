"""The errors of a run: of each problem one or more measures, each a number to be small.

Answers come from closed forms or from ../references; the same functions judge
kedge, the finite element program and, where they give their answers, the rivals.
"""
import math
from pathlib import Path

from results import interpolate, read_table, relative_difference, zero_crossings

REFERENCES = Path(__file__).resolve().parent.parent / "references"


def column(run):
    """Mean of |stress - exact| at the material points over rho g H."""
    return {"stress": run.check("stress error")}


def static_tip_error(offset, tip_x, tip_y):
    """
    The error of the tip's displacement, tip_y against the left edge, of
    material points that lie `offset` away from the end face; the slope of the
    end face in the reference carries it there.
    """
    reference = read_table(REFERENCES / "cantilever_static.csv")
    exact_x = reference["tip.displacement_x"][-1]
    exact_y = reference["tip.displacement_y"][-1] - reference["root.displacement_y"][-1]
    return math.hypot(tip_x - exact_x - 0.85826 * offset,
                      tip_y - exact_y - 0.98789 * offset) / math.hypot(exact_x, exact_y)


def cantilever_static(run):
    """The tip's displacement at the full load."""
    probes = run.probes()
    tip_x, tip_y = probes["tip.displacement_x"][-1], probes["tip.displacement_y"][-1]
    offset = 10. - (probes["tip.position_x"][-1] - tip_x)
    return {"tip": static_tip_error(offset, tip_x, tip_y - probes["root.displacement_y"][-1])}


def cantilever_dynamic(run, case, release=25.):
    """The tip's history, the period after release, the energy lost after release."""
    reference = read_table(REFERENCES / f"cantilever_dynamic_{case}.csv")
    probes, history = run.probes(), run.history()
    # the first bending mode at the points' distance from the end face
    offset = 10. - (probes["tip.position_x"][-1] - probes["tip.displacement_x"][-1])
    tip = [value * (1. + 0.14 * offset) for value in probes["tip.displacement_y"]]
    exact = zero_crossings(reference["time"], reference["tip.displacement_y"], release)
    found = zero_crossings(probes["time"], tip, release)
    period = (found[-1] - found[0]) / (len(found) - 1) if len(found) > 1 else math.nan
    exact_period = (exact[-1] - exact[0]) / (len(exact) - 1)
    total = [energy for time, energy in zip(history["time"], history["total_energy"])
             if time > release + 1e-6]
    return {"history": relative_difference(probes["time"], tip, reference["time"],
                                           reference["tip.displacement_y"]),
            "period": abs(period / exact_period - 1.),
            "energy": max(abs(energy / total[0] - 1.) for energy in total)}


def cantilever_dynamic_a(run):
    """Analysis A."""
    return cantilever_dynamic(run, "a")


def cantilever_dynamic_b(run):
    """Analysis B, nearly incompressible."""
    return cantilever_dynamic(run, "b")


def spinning_body(run):
    """Angle of the corner [rad], root mean square over the run; drift of the energy."""
    reference = read_table(REFERENCES / "spinning_body.csv")
    probes, history = run.probes(), run.history()
    square, times = 0., probes["time"]
    for time, x, y in zip(times, probes["corner.position_x"], probes["corner.position_y"]):
        angle = math.atan2(y, x) - interpolate(reference["time"], reference["angle"], time)
        square += math.remainder(angle, 2. * math.pi) ** 2
    total = history["total_energy"]
    return {"angle": math.sqrt(square / len(times)),
            "energy": max(abs(energy / total[0] - 1.) for energy in total)}


def discs(run):
    """The energy at the end, closed form and dissipation on the books, over that brought."""
    history = run.history()
    brought = history["total_energy"][0]
    return {"energy": abs(history["energy_error"][-1]) / brought}


def collapse_error(offset, front_x, top_y):
    """Of the two outer corners' places, at points `offset` away from their edges, over 8 m."""
    reference = read_table(REFERENCES / "collapse.csv")
    exact_x = interpolate(reference["offset"], reference["front.position_x"], offset)
    exact_y = interpolate(reference["offset"], reference["top left.position_y"], offset)
    return math.hypot(front_x - exact_x, top_y - exact_y) / 8.


def collapse(run):
    """The places of the outer corners at the full weight."""
    probes = run.probes()
    front_x = probes["front.position_x"][-1]
    offset = 8. - (front_x - probes["front.displacement_x"][-1])
    return {"corners": collapse_error(offset, front_x, probes["top left.position_y"][-1])}


def taylor_error(tip_displacement, foot_radius):
    """Of the shortening and of the spread of the foot [m], each over the reference's."""
    reference = read_table(REFERENCES / "taylor_bar.csv")
    shortening = 1e-3 * reference["tip_displacement_mm"][-1]
    spread = 1e-3 * reference["foot_radius_mm"][-1] - 3.2e-3
    return {"length": abs(tip_displacement / shortening - 1.),
            "foot": abs((foot_radius - 3.2e-3) / spread - 1.)}


def taylor_bar(run):
    """Shortening and foot at 80 microseconds."""
    probes = run.probes()
    # the end of the bar is hardly deformed and moves with its last points; the
    # foot's outermost points move in proportion to their distance from the axis
    rim = probes["rim.position_x"][-1] - probes["rim.displacement_x"][-1]
    foot = 3.2e-3 * (1. + probes["rim.displacement_x"][-1] / rim)
    return taylor_error(probes["tip.displacement_y"][-1], foot)


MEASURES = {"column": column, "cantilever_static": cantilever_static,
            "cantilever_dynamic_a": cantilever_dynamic_a,
            "cantilever_dynamic_b": cantilever_dynamic_b, "spinning_body": spinning_body,
            "discs": discs, "collapse": collapse, "taylor_bar": taylor_bar}
