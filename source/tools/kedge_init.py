#!/usr/bin/env python3
"""Writes a commented scene to start from.

    kedge init NAME [KIND]

NAME.prm is a scene that runs as it is. KIND is `solid` (a block that is pressed, the
default), `footing` (a strip footing on layered clay, with its load over the settlement) or
`soil` (a saturated layer that consolidates under a load)."""
import argparse
import os
import sys
from pathlib import Path

TEMPLATES = Path(__file__).resolve().parent / "templates"


def arguments():
    """The command line, parsed."""
    kinds = sorted(path.stem for path in TEMPLATES.glob("*.prm"))
    parser = argparse.ArgumentParser(prog="kedge init", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("name", metavar="NAME", help="of the scene; NAME.prm is written")
    parser.add_argument("kind", metavar="KIND", nargs="?", default="solid", choices=kinds,
                        help=", ".join(kinds))
    return parser.parse_args()


def main():
    """Ends with 1 if there is a file of that name."""
    arg = arguments()
    path = Path(arg.name if arg.name.endswith(".prm") else arg.name + ".prm")
    text = (TEMPLATES / f"{arg.kind}.prm").read_text("utf-8").replace("NAME", path.stem)
    command = os.environ.get("KEDGE_COMMAND", "./kedge")
    text = text.replace("./kedge", command)
    try:
        with open(path, "x", encoding="utf-8") as file:
            file.write(text)
    except OSError as error:
        sys.exit(f"kedge init: cannot write {path}: {error.strerror}")
    print(f"{path}: now   {command} {path}   and   {command} plot output/{path.stem}")


if __name__ == "__main__":
    main()
