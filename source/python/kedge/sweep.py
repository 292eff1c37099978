"""Many runs of a scene."""
import itertools
import multiprocessing
import multiprocessing.connection
import os
from pathlib import Path

from .run import Run
from .scene import Scene


def _rows(settings, pair):
    """The settings of each run: all combinations, or the first values, the second ones, .."""
    values = [list(column) for column in settings.values()]
    if pair and len(set(map(len, values))) > 1:
        raise ValueError("pair=True needs as many values of each setting, not " +
                         ", ".join(f"{len(v)} of {k}" for k, v in zip(settings, values)))
    combined = zip(*values) if pair else itertools.product(*values)
    return [dict(zip(settings, row)) for row in combined]


def _one(scene, settings, measure, output):
    """The row of one run: its settings and what was measured, or why not."""
    try:
        with Run(scene.copy().update(settings), output) as run:
            run.run()
            return {**settings, **measure(run), "error": None}
    except Exception as error: # a run that fails leaves the others alone
        return {**settings, "error": f"{type(error).__name__}: {error}"}


def _work(pipe, *job):
    pipe.send(_one(*job))
    pipe.close()


def sweep(scene, settings, measure, *, processes=None, pair=False, output=None):
    """Runs a scene with all combinations of settings; a list of rows, one dictionary per run.

        kedge.sweep(scene, {"Constants/E": [1e6, 2e6], "Constants/n": [4, 8]},
                    lambda run: {"energy": run.history["total_energy"][-1]})

    measure    makes a dictionary of a run at its end; the row has its entries, those of the
               settings, and "error": None, or why there is nothing else
    processes  runs at a time, each in a process of its own (default: as many as cores;
               1, and always under mpirun: one after the other in this one)
    pair       the first values together, the second ones, ..
    output     a folder; each run has a folder 000, 001, .. in it
    """
    if not isinstance(scene, Scene):
        scene = Scene(scene) if isinstance(scene, dict) else Scene.read(scene)
    rows = _rows(settings, pair)
    folders = [None if output is None else Path(output) / f"{k:03d}" for k in range(len(rows))]
    jobs = [(scene, row, measure, folder) for row, folder in zip(rows, folders)]
    processes = min(processes or os.cpu_count(), len(jobs))
    if processes <= 1 or int(os.environ.get("OMPI_COMM_WORLD_SIZE", "1")) > 1:
        return [_one(*job) for job in jobs]
    context = multiprocessing.get_context("fork") # measure may be a function of any kind
    results, running, next_job = [None] * len(jobs), {}, 0
    while next_job < len(jobs) or running:
        while next_job < len(jobs) and len(running) < processes:
            here, there = context.Pipe(duplex=False)
            process = context.Process(target=_work, args=(there, *jobs[next_job]))
            process.start()
            there.close()
            running[here] = (next_job, process)
            next_job += 1
        for pipe in multiprocessing.connection.wait(list(running)):
            number, process = running.pop(pipe)
            try:
                results[number] = pipe.recv()
            except EOFError:
                results[number] = {**rows[number], "error": "the process has died"}
            process.join()
    return results
