"""A run of a scene, step by step or to its end."""
import atexit
import json
import shutil
import tempfile
import weakref
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from . import _core
from .results import read_table, unknown_column
from .scene import Scene

_FINISHED, _USER_ERROR, _NUMERICAL_STOP, _INTERRUPTED = range(4)
atexit.register(_core.end) # MPI, which can end only when no run is left


class NumericalStop(RuntimeError):
    """A run that cannot go on: its smallest step was reached, or a number is not finite."""


class _History(Mapping):
    """Columns by name: arrays over the accepted steps so far, the start included. An array
    that was taken keeps its length and its numbers; it is no copy of the table."""

    def __init__(self, columns):
        self._place = {name: place for place, name in enumerate(columns)}
        self._table = np.empty((64, len(columns)))
        self._n_rows = 0

    def _append(self, row):
        if self._n_rows == len(self._table): # arrays that were taken keep the old table
            table = np.empty((2 * self._n_rows, self._table.shape[1]))
            table[:self._n_rows] = self._table
            self._table = table
        self._table[self._n_rows] = row
        self._n_rows += 1

    def __getitem__(self, name):
        if name not in self._place:
            raise KeyError(unknown_column(name, self._place))
        column = self._table[:self._n_rows, self._place[name]]
        column.flags.writeable = False
        return column

    def __iter__(self):
        return iter(self._place)

    def __len__(self):
        return len(self._place)


class _Folder:
    """The folder of the results, or one that goes with the run."""

    def __init__(self, output, scene):
        if output is True:
            output = Path("output") / scene.name
        self.is_kept = output is not None
        self.path = Path(output if self.is_kept else tempfile.mkdtemp(prefix="kedge-"))
        self.leave = lambda: None
        if not self.is_kept: # at the end of Python if not before
            self.leave = weakref.finalize(self, shutil.rmtree, self.path, ignore_errors=True)


class Run:
    """A run of a scene, open at its start.

        with kedge.Run(scene, "output/beam") as run:
            while run.step():
                print(run.time, run.history["total_energy"][-1])

    output  folder for the results as the program writes them; True: output/<scene name>;
            None: none are kept
    resume  go on from the last checkpoint in that folder; the history then begins there
    log     show the log of the run
    """

    def __init__(self, scene, output=None, *, resume=False, log=False):
        if not isinstance(scene, Scene):
            scene = Scene(scene) if isinstance(scene, dict) else Scene.read(scene)
        if output is None and _core.n_ranks() > 1:
            raise _core.UserError("Several processes need a folder for the results that all of "
                                  "them know: give output.")
        self._folder, self._ended = _Folder(output, scene), False
        self._core = _core.Run(scene._core, str(self._folder.path), resume, log)
        self.summary = None
        self.dimension = self._core.dimension()
        self.history = _History(self._core.columns())
        self.history._append(self._core.row())

    def step(self):
        """One accepted step, however often its size is cut. False when there is none left:
        the end was reached and its summary, checks and last picture are written.

        Raises NumericalStop if the run cannot go on, KeyboardInterrupt after a signal, with
        a checkpoint; BufferError while a view() is in use.
        """
        if self._ended:
            return False
        end = self._core.advance()
        if end is None:
            self.history._append(self._core.row())
            return True
        self._ended = True
        code, reason = end
        summary = self._folder.path / "summary.json"
        self.summary = json.loads(summary.read_text("utf-8"))
        if code == _INTERRUPTED:
            raise KeyboardInterrupt(reason)
        if code == _NUMERICAL_STOP:
            raise NumericalStop(reason)
        return False

    def run(self, callback=None, every=1):
        """Runs to the end; returns the run. After every `every`-th step callback(run) is
        called; if it returns False the run stays where it is, and step() or run() goes on."""
        while self.step():
            if callback is not None and self.n_steps % every == 0 and callback(self) is False:
                break
        return self

    @property
    def time(self):
        """Simulated time [s]."""
        return float(self.history["time"][-1])

    @property
    def n_steps(self):
        """Accepted steps so far, those before a resumed run included."""
        return int(self.history["step"][-1])

    @property
    def has_ended(self):
        """Whether no step is left."""
        return self._ended

    @property
    def output(self):
        """The folder of the results; None if they are not kept."""
        return self._folder.path if self._folder.is_kept else None

    @property
    def checks(self):
        """The scene's known answers, once the run has ended: name, value, reference, pass."""
        return self.summary["checks"] if self.summary else []

    @property
    def probes(self):
        """probes.csv so far, as arrays by column name."""
        return read_table(self._folder.path / "probes.csv")

    @property
    def fields(self):
        """Names for field()."""
        return self._core.field_names()

    def field(self, name):
        """A field of the material points as pictures show it, a copy: a row per point in the
        order of their ids, always of three dimensions (vectors x y z; stresses xx yy zz xy yz
        xz). Of several processes each has its own points."""
        return self._core.field(name)

    @property
    def ids(self):
        """Ids of the points in the rows of field()."""
        return self._core.ids(False)

    @property
    def views(self):
        """Names for view()."""
        return self._core.stored_names()

    def view(self, name):
        """What the points remember, in place: no copy, read-only, in the order of view_ids.
        Vectors and tensors have the scene's dimension; symmetric ones xx, yy, xy or xx, yy,
        zz, xy, xz, yz. While such an array, or a part of it, is alive the run makes no step
        (BufferError): del it, or numpy.array() it."""
        return self._core.view(name)

    @property
    def view_ids(self):
        """Ids of the points in the rows of view(); a copy."""
        return self._core.ids(True)

    def checkpoint(self):
        """Keeps the present state in the output folder, for Run(..., resume=True)."""
        self._core.write_checkpoint()

    def close(self):
        """Lets go of everything; the history and the summary stay."""
        self._core.close()
        self._folder.leave()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __repr__(self):
        return f"<kedge.Run at t = {self.time:g} s, step {self.n_steps}>"


def drive(scene, output=None, *, log=False):
    """A single material point along the Path of a scene: the columns of history.csv as arrays
    by name. Raises NumericalStop if a step finds no stress."""
    if not isinstance(scene, Scene):
        scene = Scene(scene) if isinstance(scene, dict) else Scene.read(scene)
    folder = _Folder(output, scene)
    try:
        if _core.drive(scene._core, str(folder.path), log) != _FINISHED:
            raise NumericalStop("the path cannot be followed to its end; log=True says why")
        return read_table(folder.path / "history.csv")
    finally:
        folder.leave()
