"""Runs the commands of the tutorials and compares what they show.

    tutorials.py KEDGE ROOT OUTPUT

An indented line of doc/tutorials/*.md that begins with ./kedge is a command; one that does not
shows a line of what the command before it says: the same words, and numbers within 5 %
(they are there to be understood; the scenes' own checks are sharper) or both of round-off.
"""
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

KEDGE, ROOT, OUTPUT = (Path(word).resolve() for word in sys.argv[1:])
TOOLS = {"init": ["source/tools/kedge_init.py"], "plot": ["source/plot/kedge_plot.py"],
         "sweep": ["source/tools/kedge_sweep.py", "--kedge", KEDGE]}
PYTHON = "/usr/bin/python3" # that of ./kedge plot
NUMBER = re.compile(r"-?\d+(\.\d+)?(e[+-]?\d+)?$")


def demand(condition, message):
    """Ends the test with `message` unless `condition` holds."""
    if not condition:
        sys.exit("TEST FAILED: " + message)


def run(command):
    """What a command says."""
    words = shlex.split(command)[1:]
    if words[0] in TOOLS:
        tool, *options = TOOLS[words[0]]
        line = [PYTHON, ROOT / tool, *options, *words[1:]]
    else:
        line = [KEDGE, *words]
    done = subprocess.run(list(map(str, line)), cwd=OUTPUT, capture_output=True, text=True,
                          check=False)
    print(command, done.stdout, done.stderr, sep="\n")
    demand(done.returncode == 0, f"'{command}' ends with {done.returncode}")
    return done.stdout


def is_shown(expected, said):
    """Whether a line of `said` has the words of `expected`, and nearly its numbers."""
    wanted = expected.split()
    for line in said.splitlines():
        words = line.split()[:len(wanted)]
        if len(words) == len(wanted) and all(map(alike, wanted, words)):
            return True
    return False


def alike(wanted, word):
    """Equal words; numbers within 5 %, or both of round-off."""
    if not (NUMBER.match(wanted) and NUMBER.match(word)):
        return wanted == word
    a, b = float(wanted), float(word)
    return abs(a - b) <= 0.05 * abs(a) or max(abs(a), abs(b)) < 1e-12


def main():
    """All tutorials, each in the order of its lines."""
    shutil.rmtree(OUTPUT, ignore_errors=True)
    OUTPUT.mkdir(parents=True)
    shutil.copytree(ROOT / "prm", OUTPUT / "prm")
    for page in sorted((ROOT / "doc/tutorials").glob("*.md")):
        said = ""
        for line in page.read_text("utf-8").replace("\\\n", " ").splitlines():
            if line.startswith("    ./kedge "):
                said = run(line.strip())
            elif line.startswith("    ") and line.strip():
                demand(is_shown(line, said), f"{page.name} shows '{line.strip()}', not so")
    print("the tutorials show what comes out")


if __name__ == "__main__":
    main()
