#!/usr/bin/env python3
"""The limit load of a strip footing on soil with weight, cohesion and a surface load, by characteristics.

    python3 benchmarks/soil/strip_characteristics.py [--c 1e3] [--phi 30] [--gamma 10e3] [--q 5e3] [--B 1]

Plane strain, Mohr and Coulomb's soil whose dilation is its friction, so that limit analysis holds. With z down, s the mean
stress (compression positive), a the angle of the major stress to the vertical and e = pi/4 - phi/2 (Sokolovskii 1965)
    dx/dz = tan(a - e):  ds - 2 (s tan phi + c) da = gamma (dz + tan phi dx)
    dx/dz = tan(a + e):  ds + 2 (s tan phi + c) da = gamma (dz - tan phi dx).
Lines of the second family run from the free surface through the fan at the strip's edge. Under a smooth strip they end at
its base, with a = 0; under a rough one at the line of the first family that bounds the soil that moves with it, which goes from
the edge to the axis and has a = 0 there (Martin 2005). The lines' distances grow from the edge on, and
the meshes of 1, 2, 4 times as many lines show how accurate the load is. Printed first: what is known otherwise, N_c and
N_q of Prandtl and Reissner and N_gamma of 30 degrees (7.653 smooth, 14.754 rough)."""
import argparse
import math


class Soil:
    """Mohr and Coulomb's soil."""

    def __init__(self, c, phi, gamma, q):
        self.c, self.phi, self.gamma, self.q = c, math.radians(phi), gamma, q
        self.tan, self.sin, self.cos = math.tan(self.phi), math.sin(self.phi), math.cos(self.phi)
        self.e = math.pi / 4 - self.phi / 2
        self.passive = (q + c * self.cos) / (1 - self.sin) # mean stress at the free surface

    def fan(self, a):
        """Mean stress at the edge where the major stress leans by a."""
        shift = self.c / self.tan
        return (self.passive + shift) * math.exp(2 * (math.pi / 2 - a) * self.tan) - shift

    def radius(self, s):
        """Of Mohr's circle."""
        return self.c * self.cos + s * self.sin


def meet(soil, p, q):
    """Where the first family's line from p meets the second one's from q: x, z, s, a."""
    x, z, s, a = q
    for _ in range(50):
        d1, d2 = 0.5 * (p[3] + a) - soil.e, 0.5 * (q[3] + a) + soil.e
        c1, s1, c2, s2 = math.cos(d1), math.sin(d1), math.cos(d2), math.sin(d2)
        # (x - px) c1 = (z - pz) s1, and so for q
        r1, r2 = p[0] * c1 - p[1] * s1, q[0] * c2 - q[1] * s2
        det = -c1 * s2 + s1 * c2
        nx, nz = (-r1 * s2 + s1 * r2) / det, (c1 * r2 - c2 * r1) / det
        k1 = 2 * (0.5 * (p[2] + s) * soil.tan + soil.c)
        k2 = 2 * (0.5 * (q[2] + s) * soil.tan + soil.c)
        g1 = p[2] - k1 * p[3] + soil.gamma * (nz - p[1] + soil.tan * (nx - p[0]))
        g2 = q[2] + k2 * q[3] + soil.gamma * (nz - q[1] - soil.tan * (nx - q[0]))
        na = (g2 - g1) / (k1 + k2)
        ns = g1 + k1 * na
        change = abs(na - a) + abs(ns - s) / abs(ns)
        x, z, s, a = nx, nz, ns, na
        if change < 1e-13:
            break
    return x, z, s, a


def reach_base(soil, q, angle):
    """Where the second family's line from q comes to the base, z = 0 and a as given."""
    d = 0.5 * (q[3] + angle) + soil.e
    x, s = q[0] - q[1] * math.tan(d), q[2]
    for _ in range(50):
        k = 2 * (0.5 * (q[2] + s) * soil.tan + soil.c)
        s = q[2] + k * (q[3] - angle) + soil.gamma * (-q[1] - soil.tan * (x - q[0]))
    return x, 0., s, angle


def graded(length, n, ratio):
    """n places up to a length whose distances grow, in all by a ratio."""
    growth = ratio ** (1 / n)
    return [length * (growth**k - 1) / (growth**n - 1) for k in range(1, n + 1)]


def ends_of_lines(soil, surface, n_base, n_fan, angle):
    """What the lines of the second family end at, from the edge on: the first n_base of them at the strip's base, where
    the major stress leans by the fan's last angle, the others at the line of the first family that goes on from there."""
    angles = [math.pi / 2 + (angle - math.pi / 2) * m / n_fan for m in range(n_fan + 1)]
    line = [(0., 0., soil.fan(a), a) for a in angles]
    ends = [line[-1]]
    for k, x in enumerate(surface):
        new = [(x, 0., soil.passive, math.pi / 2)]
        for node in line:
            new.append(meet(soil, node, new[-1]))
        if k < n_base:
            new.append(reach_base(soil, new[-1], angle))
        line = new
        ends.append(line[-1])
    return ends


def solve(miss, v):
    """Newton's method for two equations with two unknowns."""
    d = 1e-7
    for _ in range(60):
        f = miss(v)
        if abs(f[0]) + abs(f[1]) < 1e-10:
            return v
        g, h = miss([v[0] + d, v[1]]), miss([v[0], v[1] + d])
        j = [[(g[i] - f[i]) / d, (h[i] - f[i]) / d] for i in (0, 1)]
        det = j[0][0] * j[1][1] - j[1][0] * j[0][1]
        step = [-(f[0] * j[1][1] - f[1] * j[0][1]) / det, -(f[1] * j[0][0] - f[0] * j[1][0]) / det]
        cut = min(1., 0.3 / max(abs(step[0]), abs(step[1]), 1e-30))
        v = [v[0] + cut * step[0], v[1] + cut * step[1]]
    raise SystemExit("no convergence")


class Strip:
    """A strip on soil, with n lines and as many in the fan."""

    def __init__(self, soil, width, n):
        self.soil, self.width, self.n = soil, width, n
        # the first distance is small beside the depth whose weight counts as much as c and q
        self.ratio = 40. + soil.gamma * width / (soil.c + soil.q)

    def smooth(self, v):
        """Ends of the lines under a smooth strip; v[0] is the length of the surface over the width."""
        surface = graded(v[0] * self.width, self.n, self.ratio)
        return ends_of_lines(self.soil, surface, self.n, self.n, 0.)

    def held(self, v):
        """Rough: all of the base is held by the soil that moves with it; v[1] is the fan's last angle."""
        surface = graded(v[0] * self.width, self.n, self.ratio)
        return ends_of_lines(self.soil, surface, 0, self.n, v[1])

    def sliding(self, v):
        """Rough: near the edge the soil slides along the base; exp v[1] is where lines begin
        that pass below, over the width."""
        n = self.n // 2
        inner = math.exp(v[1]) * self.width
        surface = graded(inner, n, self.ratio)
        rest = self.n - n
        surface += [inner + (v[0] * self.width - inner) * k / rest for k in range(1, rest + 1)]
        return ends_of_lines(self.soil, surface, n, self.n, self.soil.e - math.pi / 2)

    def miss(self, ends):
        """How far the last end is from the axis, and its major stress from the vertical."""
        return ends[-1][0] / self.width + 0.5, ends[-1][3]

    def load(self, ends):
        """Mean pressure of the strip, the soil's weight above the ends taken off."""
        load = weight = 0.
        for p, q in zip(ends, ends[1:]):
            s, a = 0.5 * (p[2] + q[2]), 0.5 * (p[3] + q[3])
            r = self.soil.radius(s)
            # compression positive: s_zz, s_xz from the major stress along (sin a, cos a)
            s_zz, s_xz = s + r * math.cos(2 * a), r * math.sin(2 * a)
            dx, dz = q[0] - p[0], q[1] - p[1]
            load += -dx * s_zz + dz * s_xz
            weight += -dx * 0.5 * (p[1] + q[1]) * self.soil.gamma
        return 2 * (load - weight) / self.width


def smooth_load(soil, width, n):
    """Mean pressure under a smooth strip."""
    strip = Strip(soil, width, n)
    v = solve(lambda v: (strip.miss(strip.smooth(v))[0], v[1]), [1.9, 0.])
    return strip.load(strip.smooth(v))


def rough_load(soil, width, n):
    """Mean pressure under a rough strip, approached from soil of more cohesion, in which none slides."""
    c, v, slides = max(soil.c, 0.1 * soil.gamma * width), [2.5, 0.1], False
    while True:
        now = Soil(c, math.degrees(soil.phi), soil.gamma, soil.q)
        strip = Strip(now, width, n if c == soil.c else 16)
        if not slides:
            v = solve(lambda v: strip.miss(strip.held(v)), v)
            if v[1] < soil.e - math.pi / 2:
                slides, v = True, [v[0], -5.]
        if slides:
            v = solve(lambda v: strip.miss(strip.sliding(v)), v)
        if c == soil.c:
            return strip.load(strip.sliding(v) if slides else strip.held(v))
        c = max(soil.c, 0.8 * c)


def main():
    """Prints the loads."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, value, text in (("c", 1e3, "cohesion [Pa]"), ("phi", 30., "friction [deg]"),
                              ("gamma", 10e3, "weight [N/m^3]"), ("q", 5e3, "surface load [Pa]"),
                              ("B", 1., "width [m]")):
        parser.add_argument(f"--{name}", type=float, default=value, help=text)
    arg = parser.parse_args()
    known = (("N_c, weightless", Soil(1., 30., 1e-9, 0.), 1., 30.1396),
             ("N_q, weightless", Soil(1e-12, 30., 1e-9, 1.), 1., 18.4011))
    for name, soil, scale, value in known:
        print(f"{name}: smooth {smooth_load(soil, 1., 20) / scale:.4f}, rough "
              f"{rough_load(soil, 1., 20) / scale:.4f} ({value})")
    soil = Soil(arg.c, arg.phi, arg.gamma, arg.q)
    print("| lines | smooth [Pa] | rough [Pa] |\n|---|---|---|")
    loads = []
    for n in (20, 40, 80):
        loads.append((smooth_load(soil, arg.B, n), rough_load(soil, arg.B, n)))
        print(f"| {n} | {loads[-1][0]:.6g} | {loads[-1][1]:.6g} |", flush=True)
    limits = [(4 * fine - coarse) / 3 for coarse, fine in zip(*loads[1:])]
    print(f"| limit, order 2 | {limits[0]:.5g} | {limits[1]:.5g} |")


if __name__ == "__main__":
    main()
