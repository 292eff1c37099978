"""Where the programs are, and how those that only benchmarks need are built."""
import json
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class Programs:
    """The executables that are measured."""

    def __init__(self, arg):
        self.kedge = arg.kedge
        self.build = Path(arg.kedge).resolve().parent
        self.built = {}

    def own(self, name):
        """A program of this folder; built on first use."""
        if name not in self.built:
            subprocess.run(["cmake", "--build", str(self.build), "--target", name],
                           check=True, stdout=subprocess.DEVNULL)
            self.built[name] = str(self.build / "benchmarks" / name)
        return self.built[name]

    def finite_element(self):
        """The finite element program."""
        return self.own("kedge_finite_element")

    def operations(self):
        """What the kernels do per point, and what the machine can do."""
        return json.loads(subprocess.run([self.own("kedge_operations")], check=True,
                                         capture_output=True, text=True).stdout)
