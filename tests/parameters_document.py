"""Keeps doc/parameters.md what `kedge --print-parameters` says.

parameters_document.py KEDGE doc/parameters.md           fails if it is out of date
parameters_document.py KEDGE doc/parameters.md --write   brings it up to date
"""
import difflib
import subprocess
import sys
from pathlib import Path

HEAD = """# Every parameter of a scene

Written by `kedge --print-parameters`, in the form of a scene file: meaning and
unit, what is allowed, default. What the sections are for, with examples:
[user_guide.md](user_guide.md).

```
"""


def main():
    """Compares or writes."""
    kedge, path, write = sys.argv[1], Path(sys.argv[2]), "--write" in sys.argv[3:]
    printed = subprocess.run([kedge, "--print-parameters"], capture_output=True, text=True,
                             check=True).stdout
    wanted = HEAD + printed.rstrip("\n") + "\n```\n"
    if write:
        path.write_text(wanted, encoding="utf-8")
        return
    there = path.read_text(encoding="utf-8") if path.exists() else ""
    if there != wanted:
        sys.stdout.writelines(difflib.unified_diff(there.splitlines(True), wanted.splitlines(True),
                                                   str(path), "kedge --print-parameters"))
        sys.exit(f"{path} is out of date; renew it with\n"
                 f"  python3 tests/parameters_document.py build/kedge doc/parameters.md --write")


if __name__ == "__main__":
    main()
