# %% [markdown]
# # A ringing bar, from Python
#
# An elastic bar, held at one end, is set swinging along its length and let go. How high is
# its note? A bar of length L in which waves run at c = sqrt(E/rho) swings with
#
#     f = c / 4L
#
# if it starts in its first mode, with the velocity v0 sin(pi x / 2L).
#
# Run this page as it is, `./kedge python doc/tutorials/ringing_bar.py`, or cell by cell: every
# `# %%` begins a cell for Jupyter (jupytext), VS Code and Spyder.

# %%
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg") # a file and no window; leave it out in a notebook
import matplotlib.pyplot as plt

import kedge

# %% [markdown]
# ## The scene
#
# A scene is a dictionary of the sections of a scene file; values are numbers, texts (with
# expressions of the constants, of the place and of the time, where the file may have them) or
# lists. `kedge.Scene.read("bar.prm")` reads a file instead, and `print(scene)` shows one.

# %%
L, E, rho, v0 = 1.0, 1e7, 1000.0, 0.01
frequency = np.sqrt(E / rho) / (4 * L) # 25 Hz

scene = kedge.Scene({
    "Dimension": 2,
    "Title": "A ringing bar",
    "Constants": {"L": L, "E": E, "v0": v0, "n": 10, "f": frequency},
    "Grid": {"Extent": ["1.2*L", "0.4*L"], "Cells": ["1.2*n", "0.4*n"]},
    "Materials": {"steel": {"Density": rho, "Young's modulus": "E", "Poisson's ratio": 0}},
    "Bodies": {"bar": {"Geometry": "box(0, 0; L, 0.2*L)", "Material": "steel",
                       "Points per cell": 2,
                       "Initial velocity": ["v0*sin(pi*x/(2*L))", 0]}},
    "Node conditions": {"wall": {"Side": "left", "Component x": "fixed"}},
    "Time": {"Scheme": "clc-midpoint", "End": "2/f", "Step": "1/(80*f)"},
    "Probes": {"tip": {"Face": "right"}},
}, name="bar")

# %% [markdown]
# ## The run
#
# A `Run` stands at the start of its scene. `step()` makes one step and says whether there
# was one; `run(callback)` makes all of them. What is in `history.csv` is at hand as arrays:

# %%
with kedge.Run(scene) as run:
    speeds = []
    run.run(lambda r: speeds.append(abs(r.field("velocity")).max()), every=20)
    history, probes = run.history, run.probes

print("largest speed every 20 steps:", np.round(speeds, 5))
drift = np.ptp(history["total_energy"]) / history["total_energy"][0]
print(f"energy is kept to {drift:.0e} of it")
assert drift < 1e-9


# %% [markdown]
# ## The note
#
# The end of the bar is at rest where it was after every half period.

# %%
def note(time, displacement):
    """Frequency from the times at which the displacement changes its sign."""
    k = np.flatnonzero(displacement[1:-1] * displacement[2:] < 0) + 1
    zeros = time[k] - displacement[k] * (time[k + 1] - time[k]) / (
        displacement[k + 1] - displacement[k])
    return 0.5 / np.mean(np.diff(zeros))


measured = note(probes["time"], probes["tip.displacement_x"])
print(f"frequency {measured:.3f} Hz, c/4L = {frequency:.3f} Hz")
assert abs(measured / frequency - 1) < 0.005

# %% [markdown]
# ## The picture
#
# ![Displacement of the end over time](pictures/ringing_bar.png)

# %%
amplitude = v0 / (2 * np.pi * frequency) * 1e6
figure, axes = plt.subplots(figsize=(7, 3.2), layout="constrained")
axes.plot(probes["time"] * 1e3, probes["tip.displacement_x"] * 1e6, "o", ms=3, label="kedge")
axes.plot(probes["time"] * 1e3, amplitude * np.sin(2 * np.pi * frequency * probes["time"]),
          "-", lw=1, label="v0/(2πf) sin 2πft, f = c/4L")
axes.set(xlabel="time [ms]", ylabel="displacement of the end [µm]")
axes.set_ylim(-1.15 * amplitude, 1.4 * amplitude)
axes.legend(loc="upper center", ncols=2)
axes.grid(alpha=0.3)
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "ringing_bar.png", dpi=120)

# %% [markdown]
# ## Many bars
#
# `sweep` runs a scene with all combinations of settings, as many at a time as there are cores,
# and makes a table of what a function takes from each run. The error of the note falls with
# the square of the cells' size; the steps are small enough not to matter.

# %%
rows = kedge.sweep(scene, {"Constants/n": [5, 10, 20], "Time/Step": ["1/(320*f)"]},
                   lambda r: {"f": note(r.probes["time"], r.probes["tip.displacement_x"])})
for row in rows:
    print(f"{row['Constants/n']:3d} cells: {row['f']:.4f} Hz, {row['f'] / frequency - 1:+.4%}")
errors = [abs(row["f"] / frequency - 1) for row in rows]
assert errors[0] > 3 * errors[1] > 9 * errors[2]
