"""A case of the stability bench."""
from dataclasses import dataclass, field

SHIFTS = [k / 8 for k in range(8)]
BASES = ["linear", "gimp", "spline"]


@dataclass
class Case:
    """One run: a scene and the values set on top of it."""
    group: str
    name: str
    scene: str
    settings: dict = field(default_factory=dict)
    short: bool = False  # part of the short bench
    scene_in_prm: bool = False
    conserving: bool = True  # the scheme promises the books to round-off
    saturated: bool = False
    loaded_from: float = 0.  # part of the time after which the books of energy are judged


def basis(body, kind):
    """The setting of a body's basis."""
    return {f"Bodies/{body}/Basis": kind}


def constants(**values):
    """Settings of the section Constants."""
    return {f"Constants/{name}": value for name, value in values.items()}
