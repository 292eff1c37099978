"""kedge: solids and saturated soil that deform a lot, by the implicit Material Point Method.

    import kedge

    scene = kedge.Scene.read("prm/quickstart.prm")
    scene["Constants/v"] = 6
    with kedge.Run(scene) as run:
        run.run()
        print(run.history["total_energy"][-1], run.field("velocity").mean(axis=0))

Scene: what is computed, from a file or a dictionary. Run: a run, step by step or to its end.
sweep: many of them. drive: a single material point. Results: the tables of a run that was done
before. What the user may get wrong raises UserError with kedge's message, a run that cannot go
on NumericalStop.
"""
from ._core import UserError, n_ranks, rank, set_threads, versions
from .results import Results
from .run import NumericalStop, Run, drive
from .scene import Scene
from .sweep import sweep

for _thing in (NumericalStop, Results, Run, Scene, UserError, drive, sweep): # names in messages
    _thing.__module__ = "kedge"
__version__ = versions()["kedge"]
__all__ = ["NumericalStop", "Results", "Run", "Scene", "UserError", "drive", "n_ranks", "rank",
           "set_threads", "sweep", "versions"]
