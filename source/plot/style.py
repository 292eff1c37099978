"""How kedge's pictures look, and the units of what they show."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)

# Okabe and Ito's colours, told apart by colour-blind readers too.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]
DASHES = ["-", "--", "-.", ":"]

# Units of history, probes and point fields; of some, per metre in 2D.
UNITS = {
    "time": "s", "time_step": "s", "wall_time": "s",
    "position": "m", "displacement": "m", "half_lengths": "m",
    "velocity": "m/s", "acceleration": "m/s²",
    "cauchy_stress": "Pa", "kirchhoff_stress": "Pa", "pressure": "Pa", "von_mises_stress": "Pa",
    "pore_pressure": "Pa", "strain_energy": "J/m³", "kinetic_energy": "J/m³",
}
PER_METRE = {"energy": "J", "linear_momentum": "kg m/s", "angular_momentum": "kg m²/s",
             "mass": "kg", "volume": "m³"}


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


def book_unit(kind, dimension):
    """The unit of an energy or a momentum, e.g. J/m in 2D."""
    return PER_METRE[kind] + ("/m" if dimension == 2 else "")


def field_unit(name):
    """The unit of a point field or a component of it; empty if it has none."""
    for field, unit in UNITS.items():
        if name == field or name.startswith(field + "_"):
            return unit
    return ""


def label(name, unit=""):
    """A name for people: cauchy_stress_yy [Pa] becomes `Cauchy stress yy [Pa]`."""
    words = name.replace("_", " ").replace("cauchy", "Cauchy").replace("kirchhoff", "Kirchhoff")
    words = words.replace("von mises", "von Mises")
    words = words[0].upper() + words[1:]
    return f"{words} [{unit}]" if unit else words


def line_style(index_of_run):
    """Runs differ by dashes where colours tell quantities apart."""
    return DASHES[index_of_run % len(DASHES)]
