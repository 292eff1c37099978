"""The saturated part of the stability bench's matrix."""
from dataclasses import replace

from case import BASES, Case, basis, constants

CUTS = ["1e-6", "1e-4", "1e-2", "0.2"]
SCHEMES = {"quasi-static": {"Time/Scheme": "quasi-static"},
           "newmark": {"Time/Scheme": "newmark", "Time/Newmark beta": 0.3025,
                       "Time/Newmark gamma": 0.6},
           "midpoint": {"Time/Scheme": "midpoint"}}


def saturated(scene, name, settings, kind, short=False, group=""):
    """A case of a saturated scene with one of its bases or pairs."""
    body = "column" if scene == "saturated_column" else "block"
    pair = {**basis(body, kind.split()[0])}
    if "coarse" in kind:
        pair.update({"Pore fluid/Pressure space": "coarse", **constants(points=4)})
    return Case(group, f"{kind} {name}", f"{scene}.prm", {**settings, **pair}, short=short,
                saturated=True, conserving=False,
                loaded_from={"saturated_block": 20 / 35, "saturated_column": 0.5}.get(scene, 0.))


def edge(kind, cut):
    """The shift after which the outermost points hold just a part of the next cell."""
    return f"{'0.25' if kind == 'linear' else '0'} + {cut}"


def cuts():
    """Nearly empty cells, at a drained surface and at a closed one. In quasi-static runs the load
    is so small that the cut stays."""
    for kind in BASES:
        for cut in CUTS:
            for scheme in ("quasi-static", "newmark", "midpoint"):
                load = f"{cut}/100" if scheme == "quasi-static" else "1e-3"
                yield saturated("saturated_block", f"cut {cut}, {scheme}",
                                {**constants(shift=edge(kind, cut), w=f"{load}*M"),
                                 **SCHEMES[scheme]},
                                kind, short=cut == "1e-6" and scheme != "midpoint",
                                group="sat. cut")


def undrained():
    """Next to no flow and a fluid that hardly gives way: bodies of constant volume."""
    for kind in (*BASES, "linear coarse", "gimp coarse", "quadratic coarse"):
        for scheme in ("quasi-static", "newmark"):
            for cut in ("0.01", "0.3"):
                shift = cut if "coarse" in kind else edge(kind, cut)
                yield saturated("saturated_block", f"shift {shift}, {scheme}",
                                {**constants(kappa=1e-12, K_f=1e14, dt=0.1, shift=shift),
                                 **SCHEMES[scheme]},
                                kind, short=kind == "gimp" and cut == "0.01",
                                group="sat. undrained")


def conductivities():
    """Tiny and huge conductivity with one step."""
    for kind in BASES:
        for kappa in (1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1e-1):
            for scheme in ("quasi-static", "newmark"):
                yield saturated("saturated_block", f"kappa {kappa:g}, {scheme}",
                                {**constants(kappa=kappa, dt=0.1, shift=edge(kind, "1e-3")),
                                 **SCHEMES[scheme]},
                                kind, short=kind == "linear" and kappa in (1e-12, 1e-1),
                                group="sat. conductivity")


def steps():
    """Steps over six decades, from a thousandth of a layer to the drained end at once."""
    for kind in BASES:
        for decade in range(-3, 4):
            for scheme in ("quasi-static", "newmark"):
                yield saturated("saturated_column", f"dt {0.05 * 10.**decade:g} H^2/c_v, {scheme}",
                                {**constants(dt=f"0.05*10^({decade})*H^2/c_v",
                                             shift=edge(kind, "1e-3")), **SCHEMES[scheme]},
                                kind, short=kind == "gimp" and decade in (-3, 3),
                                group="sat. step")


def free():
    """A free block that tumbles, from undrained to drained."""
    for kind in BASES:
        for scheme in ("newmark", "midpoint"):
            for kappa in (1e-12, 1e-4, 1e-1):
                for shift in (edge(kind, "1e-3"), "0.4"):
                    yield saturated("saturated_tumbling", f"kappa {kappa:g}, {scheme}, shift {shift}",
                                    {**constants(cfl=0.5, kappa=kappa, shift=shift),
                                     **SCHEMES[scheme]},
                                    kind, short=kind == "gimp" and scheme == "newmark" and
                                    kappa == 1e-4 and shift == "0.4", group="sat. free")


def squeezed():
    """Half of the pores lost, and more than all: with the original law that must be said, or the
    run stopped; the improved law keeps them."""
    for kind in BASES:
        for law in ("hencky", "improved_hencky"):
            for stretch in (0.66, 0.45, 0.3):
                for shift in (0, 0.5):
                    yield saturated("saturated_squeezed", f"{law}, load for {stretch}, shift {shift}",
                                    {**constants(l=stretch, shift=shift),
                                     "Materials/skeleton/Model": law},
                                    kind, short=kind == "gimp" and stretch == 0.3 and shift == 0.5,
                                    group="sat. squeezed")
        yield saturated("saturated_squeezed", "hencky, load for 0.3, warned",
                        {**constants(l=0.3), "Pore fluid/Lost porosity": "warn"},
                        kind, short=kind == "linear", group="sat. squeezed")


def conserved(case):
    """A case of the u-p equations in the scheme that conserves."""
    settings = {name: value for name, value in case.settings.items() if "Newmark" not in name}
    return replace(case, group=case.group.replace("sat.", "con."),
                   name=case.name.replace("newmark", "clc-midpoint"),
                   settings={**settings, "Time/Scheme": "clc-midpoint"}, conserving=True)


def saturated_cases():
    """Every saturated case, in order; those in motion with the conserving scheme too."""
    parts = [cuts, undrained, conductivities, steps, free, squeezed]
    cases = [case for part in parts for case in part()]
    return cases + [conserved(case) for case in cases
                    if "newmark" in case.name and "coarse" not in case.name]
