"""Bodies in contact, of the stability bench."""
from case import SHIFTS, Case, constants

RATIOS = (1e-3, 1e-2, 1e-1, 10, 100, 1000)


def hit(name, short=False, **values):
    """A disc hits another one."""
    return Case("contact", name, "hit.prm", constants(**values), short)


def stack(name, short=False, **values):
    """Three blocks on a floor and on each other."""
    return Case("contact", name, "stack.prm", constants(**values), short)


def contact_cases():
    """Cuts, grazing hits, spin, unlike stiffness, steps, stacks, drops."""
    cases = []
    for mu in (0, 0.5):
        for shift in SHIFTS:
            cases.append(hit(f"hit, shift {shift}, mu {mu}", shift == 0.125, shift=shift, mu=mu))
        for ratio in RATIOS:
            cases.append(hit(f"hit, stiffness 1:{ratio:g}, mu {mu}", ratio == 0.01 and mu > 0,
                             ratio=ratio, mu=mu))
        for cfl in (0.5, 5, 15, 50):
            cases.append(hit(f"hit, {cfl} CFL, mu {mu}", cfl == 50, cfl=cfl, mu=mu))
    for mu in (0, 0.5, 2):
        for offset in (0.5, 0.9, 0.99):
            cases.append(hit(f"graze at {offset} of the radii, mu {mu}", offset == 0.9 and mu == 2,
                             offset=offset, mu=mu))
    for mu in (0.2, 2):
        for spin in (0.05, 0.2):
            cases.append(hit(f"spin, rim at {spin} of the wave speed, mu {mu}", mu == 2,
                             spin=spin, mu=mu))
    for shift in SHIFTS:
        cases.append(stack(f"stack, shift {shift}", shift == 0.5, shift=shift))
    for mu in (0, 0.2, 2):
        cases.append(stack(f"stack dropped, mu {mu}", mu == 0.2, mu=mu, gap=0.03, drop=2))
    for ratio in (1e-3, 0.1, 10, 1000):
        cases.append(stack(f"stack, middle 1:{ratio:g}", ratio == 10, ratio=ratio))
    for cfl in (0.5, 5, 15, 50):
        cases.append(stack(f"stack, {cfl} CFL", cfl == 15, cfl=cfl))
    return cases
