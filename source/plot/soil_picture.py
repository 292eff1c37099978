"""The curves of element tests of soil, as a geotechnical engineer draws them."""
import numpy as np

import style

plt = style.plt

# columns of the axes: name, label, factor
STRAIN = ("strain_z", "Axial strain, compression [%]", -100.0)
PRESSURE = ("pressure", "Mean effective stress p' [kPa]", 1e-3)
DEVIATOR = ("deviator_stress", "Deviator stress q [kPa]", 1e-3)
VOID_RATIO = ("void_ratio", "Void ratio e [-]", 1.0)
PORE_PRESSURE = ("pore_pressure", "Pore pressure [kPa]", 1e-3)
VOLUME_STRAIN = ("volume_strain", "Volume strain, compression [%]", -100.0)


def is_element_test(run):
    """Whether a run is an element test: one point, no energy books."""
    return "deviator_stress" in run.history and "total_energy" not in run.history


def is_path(run):
    """Whether a run is a single material point."""
    return "deformation_gradient_xx" in run.history and "total_energy" not in run.history


def draw_paths(runs):
    """Stresses, mean and von Mises stress, and energies of single points over time."""
    groups = (("Cauchy stress", [f"cauchy_stress_{c}" for c in ("xx", "yy", "zz", "xy", "xz",
                                                                "yz")], "Pa"),
              ("Invariants", ["pressure", "von_mises_stress"], "Pa"),
              ("Energies per undeformed volume", ["strain_energy", "hardening_energy",
                                                  "plastic_dissipation"], "J/m³"))
    figure, panels = plt.subplots(3, 1, sharex=True, figsize=(8, 8))
    for panel, (title, names, unit) in zip(panels, groups):
        largest = max(np.max(np.abs(run.history.get(name, 0))) for run in runs for name in names)
        shown = [name for name in names
                 if any(np.max(np.abs(run.history.get(name, 0))) > 1e-9 * largest for run in runs)]
        factor, unit = style.handy(unit, [run.history[name] for run in runs for name in shown
                                          if name in run.history])
        for index, run in enumerate(runs):
            for number, name in enumerate(shown):
                if name in run.history:
                    text = style.label(name) + (f", {run.name}" if len(runs) > 1 else "")
                    panel.plot(run.history["time"], factor * run.history[name],
                               style.line_style(index), color=style.colour(number, len(shown)),
                               label=style.wrapped(text))
        panel.set(title=title, ylabel=f"[{unit}]")
        style.legend(panel)
    panels[-1].set_xlabel("Time [s]")
    if len(runs) == 1:
        figure.suptitle(runs[0].title())
    return figure


def keep_constants_flat(panel):
    """What differs by rounding only is shown as a constant."""
    panel.ticklabel_format(axis="y", useOffset=False)
    values = np.concatenate([line.get_ydata() for line in panel.lines] or [np.zeros(1)])
    middle = np.mean(values)
    if np.ptp(values) < 1e-6 * abs(middle):
        panel.set_ylim(middle - 0.1 * abs(middle), middle + 0.1 * abs(middle))


def keep_numbers_apart(panel):
    """On a logarithmic axis of less than a decade some plain numbers, not powers of ten."""
    low, high = panel.get_xlim()
    if high < 10 * low:
        panel.xaxis.set_major_locator(plt.MaxNLocator(4, steps=[1, 2, 5, 10]))
        panel.xaxis.set_major_formatter(plt.ScalarFormatter())
        panel.xaxis.set_minor_locator(plt.NullLocator())


def draw_element_tests(runs):
    """q over strain, q over p', e over p' (logarithmic), pore pressure or volume strain."""
    undrained = any(np.any(run.history["pore_pressure"]) for run in runs)
    fourth = PORE_PRESSURE if undrained else VOLUME_STRAIN
    figure, panels = plt.subplots(2, 2, figsize=(9, 7))
    for panel, (across, up) in zip(panels.flat, ((STRAIN, DEVIATOR), (PRESSURE, DEVIATOR),
                                                 (PRESSURE, VOID_RATIO), (STRAIN, fourth))):
        for index, run in enumerate(runs):
            if across[0] in run.history and up[0] in run.history:
                panel.plot(across[2] * run.history[across[0]], up[2] * run.history[up[0]],
                           color=style.COLOURS[index % 7], label=run.name)
        panel.set(xlabel=across[1], ylabel=up[1])
        keep_constants_flat(panel)
        if up is VOID_RATIO and any(np.any(run.history["pressure"] > 0) for run in runs):
            panel.set_xscale("log")
            keep_numbers_apart(panel)
    if len(runs) > 1:
        panels[0, 0].legend()
    return figure
