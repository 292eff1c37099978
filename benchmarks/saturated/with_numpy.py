"""Goes on with the system's Python if this one has no numpy; to be imported first."""
import importlib.util
import os
import sys

SYSTEM_PYTHON = "/usr/bin/python3"

if not importlib.util.find_spec("numpy"):
    if os.path.realpath(sys.executable) == os.path.realpath(SYSTEM_PYTHON):
        sys.exit("this needs: apt install python3-numpy")
    os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, *sys.argv])
