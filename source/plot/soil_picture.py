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


def keep_constants_flat(panel):
    """What differs by rounding only is shown as a constant."""
    panel.ticklabel_format(axis="y", useOffset=False)
    values = np.concatenate([line.get_ydata() for line in panel.lines] or [np.zeros(1)])
    middle = np.mean(values)
    if np.ptp(values) < 1e-6 * abs(middle):
        panel.set_ylim(middle - 0.1 * abs(middle), middle + 0.1 * abs(middle))


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
    if len(runs) > 1:
        panels[0, 0].legend()
    return figure
