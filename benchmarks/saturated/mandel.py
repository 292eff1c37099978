"""Mandel's problem (1953): pore pressure and settlement of a saturated slab between stiff smooth plates.

usage: mandel.py [cells over the half width]

Series of Cheng and Detournay (1988), roots by bisection, for the numbers of prm/mandel.prm; the load
grows as 1 - cos over the first hundredth of a^2/c. Prints what the scene holds as constants.
"""
import sys
from math import cos, exp, pi, sin, tan

a, b, load = 1.0, 0.25, 100.0  # half width, height, load per area of the plate
K, G, n0, K_f, kappa, gamma = 6e6, 3e6, 0.3, 2.2e9, 1e-5, 1e4
ramp = 0.01

M = K_f / n0  # Biot's modulus; grains do not give
K_u = K + M
nu = (3 * K - 2 * G) / (2 * (3 * K + G))
nu_u = (3 * K_u - 2 * G) / (2 * (3 * K_u + G))
B = M / K_u
c = kappa / gamma * M * (K + 4 / 3 * G) / (K_u + 4 / 3 * G)
ratio = (1 - nu) / (nu_u - nu)


def root(i):
    """Of tan x = ratio x, in the i-th interval below a pole."""
    low, high = max((i - 0.5) * pi - pi, 0) + 1e-9, (i - 0.5) * pi - 1e-12
    if i == 1:
        low = 1e-3
    for _ in range(200):
        middle = 0.5 * (low + high)
        if tan(middle) < ratio * middle:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


ROOTS = [root(i) for i in range(1, 200)]


def decay(x, T):
    """exp(-x^2 T) of a load that is there at once, its mean over the growth of one that is not; T >= ramp."""
    lam = x * x
    return 0.5 * pi**2 / (lam**2 * ramp**2 + pi**2) * (exp(-lam * (T - ramp)) + exp(-lam * T))


def pressure(x, T):
    F = load * a
    return 2 * F * B * (1 + nu_u) / (3 * a) * sum(
        sin(r) / (r - sin(r) * cos(r)) * (cos(r * x / a) - cos(r)) * decay(r, T) for r in ROOTS)


def settlement(T):
    F = load * a
    transient = sum(sin(r) * cos(r) / (r - sin(r) * cos(r)) * decay(r, T) for r in ROOTS)
    return F * b * ((1 - nu) / (2 * G * a) - (1 - nu_u) / (G * a) * transient)


if __name__ == "__main__":
    n = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    print(f"nu_u {nu_u:.10f}  B {B:.10f}  c {c:.10g} m^2/s")
    for i, r in enumerate(ROOTS[:6], 1):
        print(f"root {i}: {r:.12f}")
    x = a / n / 4
    times = [k * 1e-3 for k in range(10, 300)]
    top = max(times, key=lambda T: pressure(x, T))
    print(f"largest pressure at x = {x} a: {pressure(x, top) / load:.6f} of the load, at T = {top}")
    for T in (0.01, 0.02, 0.05, 0.1, 0.2, 0.5):
        print(f"T {T}: pressure there {pressure(x, T) / load:.6f}, settlement {settlement(T):.8e} m")
