"""The matrix of the stability bench: small hard scenes, each with its settings."""
from case import BASES, SHIFTS, Case, basis, constants
from contact_cases import contact_cases
from saturated_cases import saturated_cases


def von_mises(material, yield_radius):
    """Makes a material yield."""
    return {f"Materials/{material}/Model": "von_mises",
            f"Materials/{material}/Yield radius rho_y": yield_radius}


def shifts_and_points():
    """Small cuts: where the body lies on the grid, and with how many points."""
    for kind in BASES:
        for points in (1, 2, 3, 4, 6):
            for shift in SHIFTS:
                yield Case("cut", f"{kind} {points}x{points} points, shift {shift}",
                           "tumbling.prm",
                           {**constants(shift=shift, points=points), **basis("block", kind)},
                           short=points in (1, 2) and shift in (0.125, 0.5))


def steps_and_compressibility():
    """Large steps, and materials that hardly change their volume."""
    for kind in BASES:
        for cfl in (0.5, 5, 15, 50, 200):
            for nu in (0, 0.3, 0.49, 0.499):
                yield Case("step", f"{kind} {cfl} CFL, nu {nu}", "tumbling.prm",
                           {**constants(cfl=cfl, nu=nu, shift=0.3), **basis("block", kind)},
                           short=kind == "gimp" and cfl in (0.5, 200) and nu in (0.3, 0.499))


def aspects():
    """Long thin cells."""
    for kind in BASES:
        for aspect in (1, 4, 16):
            for shift in (0, 0.125, 0.5):
                yield Case("aspect", f"{kind} cells 1:{aspect}, shift {shift}", "tumbling.prm",
                           {**constants(aspect=aspect, shift=shift, spin=0), **basis("block", kind)},
                           short=kind == "gimp" and aspect == 16 and shift == 0.125)


def in_3d():
    """The cuts again, in space."""
    for kind in BASES:
        for points in (1, 2, 3):
            for shift in (0, 0.125, 0.5, 0.875):
                yield Case("3d", f"{kind} {points}^3 points, shift {shift}", "tumbling_3d.prm",
                           {**constants(shift=shift, points=points), **basis("block", kind)},
                           short=points == 2 and shift == 0.125)


def violence():
    """Bodies dropped, spun, torn and squeezed."""
    for kind in BASES:
        for points in (2, 3):
            for cfl in (2, 15):
                name = f"{kind} {points}x{points} points, {cfl} CFL"
                ball = {**constants(points=points, cfl=cfl), **basis("ball", kind)}
                bar = {**constants(points=points, cfl=cfl), **basis("bar", kind)}
                short = points == 3 and cfl == 15
                yield Case("dropped", name, "dropped.prm", ball, short)
                yield Case("dropped", name + ", plastic", "dropped.prm",
                           {**ball, **von_mises("matter", "yield")})
                yield Case("torn", name, "torn.prm", bar)
                yield Case("torn", name + ", plastic", "torn.prm",
                           {**bar, **von_mises("matter", "yield")}, short)
        for shift in SHIFTS:
            yield Case("squeezed", f"{kind} shift {shift}", "squeezed.prm",
                       {**constants(shift=shift), **basis("block", kind)},
                       short=shift == 0.5, conserving=False)
        for turns in (0.05, 0.3):
            yield Case("spun", f"{kind} {turns} of the wave speed at the rim", "spun.prm",
                       {**constants(rim=turns), **basis("square", kind)}, short=turns == 0.3)


def unlike_neighbours():
    """A body ten thousand times stiffer than the one it lies on."""
    for kind in BASES:
        for points in (2, 3, 4):
            yield Case("stiff on soft", f"{kind} {points}x{points} points", "stiff_on_soft.prm",
                       {**constants(points=points), **basis("bed", kind), **basis("block", kind)},
                       short=points == 3, conserving=False)
            yield Case("stiff on soft", f"{kind} {points}x{points} points, dynamic",
                       "stiff_on_soft.prm",
                       {**constants(points=points), **basis("bed", kind), **basis("block", kind),
                        "Time/Scheme": "clc-midpoint"})


def endurance():
    """Many steps, and the beam that others give up on."""
    for kind in BASES:
        for spin, motion in ((0, "flying"), (0.1, "spinning")):
            settings = {**constants(cfl=3, spin=spin), **basis("block", kind)}
            yield Case("endurance", f"{kind} {motion}, 10 000 steps", "tumbling.prm",
                       {**settings, **constants(steps=10000)})
            yield Case("endurance", f"{kind} {motion}, 1000 steps", "tumbling.prm",
                       {**settings, **constants(steps=1000)}, short=kind == "gimp")
    for h in (0.5, 0.25):
        yield Case("beam", f"2x2 points, h = {h}", "cantilever_static.prm",
                   constants(points=2, h=h), short=h == 0.5, scene_in_prm=True, conserving=False)
        yield Case("beam", f"4x4 points, h = {h}", "cantilever_static.prm",
                   constants(points=4, h=h), scene_in_prm=True, conserving=False)


def all_cases():
    """Every case of the bench, in order."""
    parts = [shifts_and_points, steps_and_compressibility, aspects, in_3d, violence,
             unlike_neighbours, endurance]
    return [case for part in parts for case in part()] + contact_cases() + saturated_cases()
