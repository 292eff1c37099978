"""The runs of the suite: problems over grids, material points, steps, bases and programs."""
from dataclasses import dataclass, field

# How much is run: `short` is what the tests do, `medium` a few minutes, `full` all.
SHORT, MEDIUM, FULL = 0, 1, 2
LEVELS = {"short": SHORT, "medium": MEDIUM, "full": FULL}


@dataclass
class Case:
    """One run of one program."""
    problem: str    # whose error is measured, see errors.py
    variant: str    # of the same problem, drawn in a figure of its own
    method: str     # a curve in the figure
    label: str      # a point of it
    scene: str      # in prm/, or in finite_element/ if the program is that
    settings: dict = field(default_factory=dict)
    level: int = FULL

    @property
    def finite_element(self):
        """Whether the finite element program solves it."""
        return self.method.startswith("FEM")

    @property
    def name(self):
        """As the user picks it."""
        return f"{self.problem} {self.variant} {self.method} {self.label}"


def kedge_case(problem, variant, basis, label, scene, level, **constants):
    """A run of kedge; an entry with a section is given as Section__Name."""
    settings = {"Output/Points interval": 0}
    for name, value in constants.items():
        settings[name.replace("__", "/").replace("_", " ") if "__" in name
                 else f"Constants/{name}"] = value
    return Case(problem, variant, f"kedge {basis}", label, scene, settings, level)


def level_of(size, short, medium):
    """Sizes up to `short` are in the short part, up to `medium` in the medium one."""
    return SHORT if size <= short else MEDIUM if size <= medium else FULL


def fem_case(problem, variant, degree, label, level, **parameters):
    """A run of the finite element program with elements of degree 1 or 2."""
    settings = {"Degree": degree, **{name.replace("_", " "): value
                                     for name, value in parameters.items()}}
    return Case(problem, variant, f"FEM Q{degree}", label, f"{problem}.prm", settings, level)


def column_cases():
    """One cell wide: soft in 40 and stiff in 20 load steps; all bases, finite elements."""
    for variant, modulus, steps in (("E=1e4", 1e4, 40), ("E=1e6", 1e6, 20)):
        for cells in (16, 32, 64, 128, 256, 512, 1024, 2048, 4096):
            level = level_of(cells, 16 if modulus < 1e5 else 0, 1024)
            common = {"n": cells, "E": modulus, "steps": steps}
            yield kedge_case("column", variant, "GIMP", f"{cells} cells", "column_quasi_static",
                             level, **common)
            yield kedge_case("column", variant, "spline", f"{cells} cells", "column_quasi_static",
                             max(level, MEDIUM), Bodies__column__Basis="spline", **common)
            if cells <= 1024 and (modulus < 1e5 or cells <= 256):
                yield kedge_case("column", variant, "linear", f"{cells} cells",
                                 "column_quasi_static", max(level, MEDIUM),
                                 Bodies__column__Basis="linear", **common)
            yield fem_case("column", variant, 1, f"{cells} cells", level, Cells=f"1, {cells}",
                           **{"Young's_modulus": modulus, "Steps": steps})
            if cells <= 512:
                yield fem_case("column", variant, 2, f"{cells} cells", max(level, MEDIUM),
                               Cells=f"1, {cells}",
                               **{"Young's_modulus": modulus, "Steps": steps})


def cantilever_static_cases():
    """Cells of h with points per direction; 50 steps, as AMPLE, and fewer."""
    for size in (0.5, 0.25, 0.125, 0.0625):
        for points in (2, 3, 6):
            if size < 0.1 and points > 3:
                continue
            for steps in (50, 25) if points == 3 else (50,):
                level = SHORT if (size, points) == (0.5, 2) else \
                    MEDIUM if size > 0.2 else FULL
                yield kedge_case("cantilever_static", "",
                                 f"GIMP {points}x{points}, {steps} steps", f"h={size:g}",
                                 "cantilever_static", level,
                                 h=size, points=points, steps=steps)
    for size in (1, 0.5, 0.25, 0.125):
        for points, steps in ((2, 50), (3, 50), (3, 25)):
            yield kedge_case("cantilever_static", "", f"spline {points}x{points}, {steps} steps",
                             f"h={size:g}", "cantilever_static", MEDIUM if size > 0.2 else FULL,
                             h=size, points=points, steps=steps, Bodies__beam__Basis="spline")
    for size in (0.5, 0.25, 0.125):
        yield kedge_case("cantilever_static", "", "linear 3x3, 50 steps", f"h={size:g}",
                         "cantilever_static", FULL, h=size, points=3, steps=50,
                         Bodies__beam__Basis="linear")
    for degree, sizes in ((1, (0.5, 0.25, 0.125, 0.0625)), (2, (1., 0.5, 0.25, 0.125))):
        for size in sizes:
            yield fem_case("cantilever_static", "", degree, f"h={size:g}, 50 steps",
                           MEDIUM if size > 0.2 else FULL,
                           Cells=f"{10 / size:.0f}, {1 / size:.0f}", Steps=50)


def cantilever_dynamic_cases():
    """Cells of h with points per direction, steps as factors of the CFL step."""
    for analysis in ("a", "b"):
        problem, scene = f"cantilever_dynamic_{analysis}", f"cantilever_dynamic_{analysis}"
        for size, points, factor in ((1, 4, 7.5), (0.5, 2, 15), (0.5, 4, 15), (0.25, 2, 30),
                                     (0.25, 4, 30), (0.25, 4, 15)):
            yield kedge_case(problem, "", f"spline {points}x{points}",
                             f"h={size:g}, {factor:g} CFL", scene,
                             MEDIUM if (size, factor) != (0.25, 15) else FULL,
                             h=size, points=points, Time__Step=f"{factor:g} initial cfl",
                             Bodies__beam__Basis="spline")
        for size, points, factor in ((0.5, 4, 15), (0.5, 12, 15), (0.25, 4, 30), (0.25, 4, 15),
                                     (0.125, 4, 60), (0.125, 4, 30)):
            level = MEDIUM if points < 12 and (size > 0.4 or (size, factor) == (0.25, 30)) else FULL
            arguments = {"level": level, "h": size, "points": points,
                         "Time__Step": f"{factor:g} initial cfl"}
            label = f"h={size:g}, {factor:g} CFL"
            yield kedge_case(problem, "", f"GIMP {points}x{points}", label, scene, **arguments)
            if points == 4 and factor == 15 and analysis == "a":
                yield kedge_case(problem, "", "linear 4x4", label, scene,
                                 Bodies__beam__Basis="linear", **arguments)
            if points == 4 and factor in (15, 60) and analysis == "b":
                yield kedge_case(problem, "", "GIMP 4x4 cell mean", label, scene,
                                 Materials__rubber__Volume_change="cell mean", **arguments)
        for degree, size, step in ((1, 0.5, 0.625), (1, 0.25, 0.625), (1, 0.125, 0.3125),
                                   (2, 1., 0.625), (2, 0.5, 0.3125), (2, 0.25, 0.3125)):
            yield fem_case(problem, "", degree, f"h={size:g}, dt={step:g}",
                           MEDIUM if size > 0.2 else FULL,
                           Cells=f"{10 / size:.0f}, {1 / size:.0f}", Step=step)


def spinning_body_cases():
    """Ten seconds, some six turns; grids and steps."""
    for size in (1., 0.5, 0.25):
        for step in (0.1, 0.05, 0.025, 0.0125):
            level = SHORT if (size, step) == (1., 0.05) else MEDIUM if size > 0.4 else FULL
            for basis in ("GIMP", "linear", "spline"):
                yield kedge_case("spinning_body", "", f"{basis} h={size:g}", f"dt={step:g}",
                                 "spinning_body", level if basis == "GIMP" else max(level, MEDIUM),
                                 h=size, dt=step, steps=round(10 / step),
                                 Bodies__square__Basis=basis.lower())
    for degree, cells in ((1, 4), (2, 2)):
        for step in (0.1, 0.05, 0.025, 0.0125):
            yield fem_case("spinning_body", "", degree, f"{cells}x{cells}, dt={step:g}", MEDIUM,
                           Cells=f"{cells}, {cells}", Step=step)


def discs_cases():
    """Collision; energy is the measure, so the cost of keeping it is what is shown."""
    for variant, size, points, factor in (
            ("elastic", 2, 35, 5), ("elastic", 2, 8, 5), ("elastic", 1, 8, 5),
            ("elastic", 0.5, 4, 5), ("elastic", 0.5, 4, 10), ("elastic", 0.5, 4, 2.5)):
        for basis in ("linear", "GIMP", "spline"):
            level = SHORT if (size, points, basis) == (2, 8, "linear") else \
                FULL if points == 35 else MEDIUM
            yield kedge_case("discs", variant, basis, f"h={size:g}, {points}x{points}, "
                             f"{factor:g} CFL", "discs_elastic", level, h=size, points=points,
                             Bodies__left_disc__Basis=basis.lower(),
                             Bodies__right_disc__Basis=basis.lower(),
                             Time__Step=f"{factor:g} cfl")


def collapse_cases():
    """Clay; cells of h with points per direction, load steps, locking remedy."""
    for size in (1, 0.5, 0.25, 0.125):
        for points, steps, mean in ((2, 40, False), (6, 40, False), (2, 40, True), (4, 40, True),
                                    (2, 160, False)):
            if size < 0.2 and (points > 4 or mean):
                continue
            level = SHORT if (size, points, steps, mean) == (1, 2, 40, False) else \
                MEDIUM if size > 0.4 else FULL
            settings = {"h": size, "points": points, "steps": steps,
                        "Time__Scheme": "quasi-static"}
            if mean:
                settings["Materials__clay__Volume_change"] = "cell mean"
            method = f"GIMP {points}x{points}{' cell mean' if mean else ''}, {steps} steps"
            yield kedge_case("collapse", "", method, f"h={size:g}", "collapse", level, **settings)
    for size in (1, 0.5, 0.25):
        for points, mean in ((2, False), (4, False), (4, True)):
            settings = {"Materials__clay__Volume_change": "cell mean"} if mean else {}
            yield kedge_case("collapse", "", f"spline {points}x{points}"
                             f"{' cell mean' if mean else ''}, 40 steps", f"h={size:g}",
                             "collapse", MEDIUM if size > 0.4 else FULL, h=size, points=points,
                             steps=40, Time__Scheme="quasi-static", Bodies__block__Basis="spline",
                             **settings)
    for degree, sizes in ((1, (1, 0.5, 0.25)), (2, (2, 1, 0.5))):
        for size in sizes:
            yield fem_case("collapse", "", degree, f"h={size:g}, 40 steps",
                           MEDIUM if size > 0.4 else FULL,
                           Cells=f"{8 / size:.0f}, {8 / size:.0f}", Steps=40)


def taylor_bar_cases():
    """In space; the finest is that of the thesis."""
    for points, cells, step, level in ((8, 25, 0.75e-6, MEDIUM), (8, 50, 0.375e-6, FULL)):
        yield kedge_case("taylor_bar", "", "GIMP", f"{cells} cells, {step * 1e6:g} us",
                         "taylor_bar", level, m=points, n=cells, step=step)
    yield kedge_case("taylor_bar", "", "spline", "25 cells, 0.75 us", "taylor_bar", FULL,
                     m=8, n=25, step=0.75e-6, Bodies__bar__Basis="spline")
    yield kedge_case("taylor_bar", "", "linear", "25 cells, 0.75 us", "taylor_bar", FULL,
                     m=8, n=25, step=0.75e-6, Bodies__bar__Basis="linear")


def all_cases():
    """The suite."""
    for cases in (column_cases, cantilever_static_cases, cantilever_dynamic_cases,
                  spinning_body_cases, discs_cases, collapse_cases, taylor_bar_cases):
        yield from cases()
