"""Runs the program of a tutorial, compares what it says with the tutorial's page, draws its picture.

    tutorial_program.py PAGE.md PROGRAM

What the program says stands on the page in the block after "and says"; the picture is drawn by
the command that stands there, `python3 ../draw_table.py TABLE PICTURE ..`. Numbers within a thousandth (the
program itself judges them by its exit code) or both of round-off.
"""
import re
import shlex
import struct
import subprocess
import sys
from pathlib import Path

PAGE, PROGRAM = (Path(word).resolve() for word in sys.argv[1:])
PYTHON = "/usr/bin/python3" # that of ./kedge plot
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")


def demand(condition, message):
    """Ends the test with `message` unless `condition` holds."""
    if not condition:
        sys.exit("TEST FAILED: " + message)


def alike(shown, said):
    """The same words, and nearly the same numbers."""
    if NUMBER.sub("#", shown) != NUMBER.sub("#", said):
        return False
    pairs = zip(map(float, NUMBER.findall(shown)), map(float, NUMBER.findall(said)))
    return all(abs(a - b) <= 1e-3 * abs(a) or max(abs(a), abs(b)) < 1e-8 for a, b in pairs)


def main():
    """Runs, compares, draws, in the present folder."""
    page = PAGE.read_text("utf-8")
    done = subprocess.run([PROGRAM], capture_output=True, text=True, check=False)
    print(done.stdout, done.stderr)
    demand(done.returncode == 0, f"{PROGRAM.name} ends with {done.returncode}")
    shown = re.search(r"and says\n\n```\n(.*?)\n```", page, re.DOTALL)[1].splitlines()
    said = done.stdout.splitlines()
    demand(len(shown) == len(said) and all(map(alike, shown, said)),
           f"{PAGE.name} shows\n" + "\n".join(shown))

    command = re.search(r"^python3 \.\./(draw_table\.py .*)$", page, re.MULTILINE)[1]
    script, table, picture, *titles = shlex.split(command)
    drawn = subprocess.run([PYTHON, PAGE.parent / script, table, picture, *titles],
                           capture_output=True, text=True, check=False)
    demand(drawn.returncode == 0, drawn.stderr)
    head = Path(picture).read_bytes()[:24]
    demand(head[:8] == b"\x89PNG\r\n\x1a\n" and struct.unpack(">II", head[16:]) == (840, 432),
           f"{picture} is no picture of 840 x 432 points")
    demand(f"pictures/{PROGRAM.name}.png" in page, "the page does not show the picture")


if __name__ == "__main__":
    main()
