"""How kedge's pictures look, and the units of what they show."""
import sys
import textwrap

try:
    import matplotlib
    import numpy  # noqa: F401  (matplotlib needs it; the other files import it themselves)
except ModuleNotFoundError as missing:
    sys.exit(f"kedge plot: {sys.executable} has no {missing.name}; on Debian:\n"
             "  apt-get install python3-matplotlib python3-numpy")
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)

# Okabe and Ito's colours, told apart by colour-blind readers too.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]
DASHES = ["-", "--", "-.", ":"]

# Units of history, probes and point fields; of some, per metre in 2D.
UNITS = {
    "time_step": "s", "wall_time": "s", "time": "s",
    "position": "m", "displacement": "m", "half_lengths": "m",
    "velocity": "m/s", "acceleration": "m/s²", "darcy_velocity": "m/s",
    "cauchy_stress": "Pa", "kirchhoff_stress": "Pa", "total_stress": "Pa", "pressure": "Pa",
    "von_mises_stress": "Pa", "pore_pressure": "Pa", "yield_stress": "Pa", "cohesion": "Pa",
    "undrained_strength": "Pa", "preconsolidation_pressure": "Pa", "deviator_stress": "Pa",
    "strain_energy": "J/m³", "kinetic_energy": "J/m³", "plastic_dissipation": "J/m³",
    "mass": "kg", "volume": "m³",
}
PER_METRE = {"energy": "J", "linear_momentum": "kg m/s", "angular_momentum": "kg m²/s",
             "force": "N", "mass": "kg", "volume": "m³"}
PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""))
SECONDS = {"s": 1.0, "min": 60.0, "h": 3600.0, "d": 86400.0, "a": 365.25 * 86400.0}
UNIT_WORDS = {"s": "s", "min": "min", "h": "h", "d": "days", "a": "years"}


def set_style():
    """The defaults of all figures."""
    plt.rcParams.update({
        "figure.dpi": 100, "savefig.dpi": 170, "figure.constrained_layout.use": True,
        "figure.facecolor": "white", "svg.fonttype": "none",
        "font.size": 10, "axes.titlesize": 10.5, "axes.titlelocation": "left",
        "axes.titleweight": "bold", "axes.labelsize": 10, "legend.fontsize": 8.5,
        "legend.frameon": False, "axes.spines.top": False, "axes.spines.right": False,
        "axes.grid": True, "grid.color": "#dddddd", "grid.linewidth": 0.6,
        "axes.axisbelow": True, "lines.linewidth": 1.4, "axes.prop_cycle":
        plt.cycler(color=COLOURS), "axes.formatter.limits": (-3, 4),
        "axes.formatter.use_mathtext": True,
    })


def colour(index, count):
    """The colour of one of `count` things: no two have the same."""
    if count <= len(COLOURS):
        return COLOURS[index]
    return plt.get_cmap("turbo")((index + 0.5) / count)


def book_unit(kind, dimension):
    """The unit of an energy, a momentum or a force, e.g. J/m in 2D."""
    return PER_METRE[kind] + ("/m" if dimension == 2 else "")


def field_unit(name):
    """The unit of a point field or a component of it; empty if it has none."""
    for field, unit in UNITS.items():
        if name == field or name.startswith(field + "_"):
            return unit
    return ""


def handy(unit, values, wanted="auto"):
    """Factor and unit in which stresses are numbers of a handy size; other units stay."""
    if unit != "Pa":
        return 1.0, unit
    if wanted != "auto":
        size = {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9}[wanted]
        return 1 / size, wanted
    largest = max((abs(value).max() for value in values if len(value)), default=0.0)
    for size, prefix in PREFIXES:
        if largest >= size:
            return 1 / size, prefix + unit
    return 1.0, unit


def time_unit(longest, wanted="auto"):
    """The unit of times up to so many seconds: its name."""
    if wanted != "auto":
        return wanted
    if longest > 5 * SECONDS["a"]:
        return "a"
    return "d" if longest > 3 * SECONDS["d"] else "s"


def time_text(time, unit):
    """A time for the title of a panel."""
    return f"{time / SECONDS[unit]:.4g} {UNIT_WORDS[unit]}"


def label(name, unit=""):
    """A name for people: cauchy_stress_yy [Pa] becomes `Cauchy stress yy [Pa]`."""
    words = name.replace("_", " ").replace("cauchy", "Cauchy").replace("kirchhoff", "Kirchhoff")
    words = words.replace("von mises", "von Mises")
    words = words[0].upper() + words[1:]
    return f"{words} [{unit}]" if unit else words


def stress_name(name, saturated):
    """Whose stress it is: in saturated soil all are effective but the total one."""
    if saturated and name.startswith(("cauchy_stress", "von_mises_stress", "kirchhoff_stress")):
        return "effective " + name
    if saturated and name == "pressure":
        return "mean effective stress p'"
    return name


def line_style(index_of_run):
    """Runs differ by dashes where colours tell quantities apart."""
    return DASHES[index_of_run % len(DASHES)]


def wrapped(text, width=30):
    """A long name in several lines."""
    return "\n".join(textwrap.wrap(text, width)) or text


def thin(values):
    """Markers for short histories only."""
    return {"marker": "o", "markersize": 3} if len(values) <= 40 else {}


def legend(panel):
    """The legend beside the panel, where it hides no line and is not cut."""
    if panel.get_legend_handles_labels()[0]:
        panel.legend(loc="upper left", bbox_to_anchor=(1.01, 1), borderaxespad=0)
