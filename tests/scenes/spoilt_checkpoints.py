"""Resumes from checkpoints that are damaged or belong to another scene.

    spoilt_checkpoints.py KEDGE SCENE FOLDER

SCENE must write checkpoints. kedge must take the older state where the newer
one is damaged, and refuse with the cause and exit code 1 where none is left
or where the state is another scene's.
"""
import re
import shutil
import subprocess
import sys
from pathlib import Path


def demand(condition, message):
    """Ends the test with `message` unless `condition` holds."""
    if not condition:
        sys.exit("TEST FAILED: " + message)


class Spoiler:
    """A finished run, of which copies are spoilt and resumed."""

    def __init__(self, kedge, scene, folder):
        self.kedge, self.scene, self.folder = kedge, scene, Path(folder)
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        self.start("whole", 0)
        demand(len(self.states("whole")) == 2, "the run did not keep two states")

    def states(self, name):
        """The states of a run, older first."""
        return sorted((self.folder / name / "checkpoint").glob("state-*"))

    def copy(self, name):
        """A copy of the run, to be spoilt."""
        shutil.copytree(self.folder / "whole", self.folder / name)
        return self.states(name)

    def start(self, name, expected_exit, *options):
        """Runs kedge; returns what it says on both streams."""
        line = [self.kedge, self.scene, "-o", str(self.folder / name), *options]
        done = subprocess.run(line, capture_output=True, text=True, check=False)
        print(" ".join(line), done.stdout, done.stderr, sep="\n")
        demand(done.returncode == expected_exit,
               f"{name}: exit code {done.returncode} instead of {expected_exit}")
        return done

    def resume(self, name, expected_exit, pattern, *options):
        """Resumes; the pattern must be in the log, or on stderr if it is to fail."""
        done = self.start(name, expected_exit, "--resume", *options)
        text = done.stdout if expected_exit == 0 else done.stderr
        demand(re.search(pattern, text, re.DOTALL), f"{name}: '{pattern}' not found")


def truncate(state):
    """Cuts the points' file of a state in half."""
    file = state / "rank-0000.bin"
    content = file.read_bytes()
    file.write_bytes(content[:len(content) // 2])


def flip(state):
    """Changes one byte of the points' file of a state."""
    file = state / "rank-0000.bin"
    content = bytearray(file.read_bytes())
    content[len(content) // 2] ^= 1
    file.write_bytes(content)


def main():
    """Spoils in every way."""
    run = Spoiler(*sys.argv[1:])

    older, newer = run.copy("newer_truncated")
    truncate(newer)
    run.resume("newer_truncated", 0, f"{newer.name} is damaged: .*bytes instead of.*{older.name}")

    older, newer = run.copy("newer_flipped")
    flip(newer)
    run.resume("newer_flipped", 0, f"{newer.name} is damaged: .*checksum.*{older.name}")

    for state in run.copy("both_truncated"):
        truncate(state)
    run.resume("both_truncated", 1, "bytes instead of.*No whole checkpoint is left.*--resume")

    for state in run.copy("no_manifest"):
        (state / "manifest.txt").unlink()
    run.resume("no_manifest", 1, "No whole checkpoint is left")

    run.copy("other_scene")
    run.resume("other_scene", 1, "belongs to another scene", "-s",
               "Materials/rubber/Density = 1001")

    run.resume("never_run", 1, "no run to resume in")


if __name__ == "__main__":
    main()
