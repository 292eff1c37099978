"""Where the programs are, and how the finite element program is built."""
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class Programs:
    """The executables that are measured."""

    def __init__(self, arg):
        self.kedge = arg.kedge
        self.build = Path(arg.kedge).resolve().parent
        self.built = None

    def finite_element(self):
        """The finite element program; built on first use."""
        if self.built is None:
            subprocess.run(["cmake", "--build", str(self.build), "--target",
                            "kedge_finite_element"], check=True, stdout=subprocess.DEVNULL)
            self.built = str(self.build / "benchmarks" / "kedge_finite_element")
        return self.built
