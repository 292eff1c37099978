#!/usr/bin/env python3
"""The safety factor of a homogeneous slope by limit analysis: an upper bound.

    python3 benchmarks/soil/slope_limit.py [--phi 20] [--ratio 0.05] [--slope 2]

A block of soil turns rigidly on a spiral r = r0 exp((theta - theta0) tan phi) through the toe; what its
weight does equals what cohesion dissipates along the spiral (Chen 1975, section 9.2). The least
gamma H/c of all spirals is a rigorous upper bound for soil whose dilation is its friction; the factor F is
the one by which c and tan phi may be divided until it is reached. Printed first: the critical heights of vertical
cuts, 3.83 c/gamma without friction and 5.50 c/gamma for 20 degrees (Chen's table 9.1)."""
import argparse
import math


def height(phi, beta, theta0, theta1):
    """gamma H/c of the spiral from theta0 at the crest to theta1 at the toe; infinity if there is none."""
    t = math.tan(phi)
    growth = math.exp((theta1 - theta0) * t)
    rise = math.sin(theta1) * growth - math.sin(theta0)
    length = math.cos(theta0) - math.cos(theta1) * growth - rise / math.tan(beta)
    if rise <= 0 or length <= 0:
        return math.inf
    f1 = ((3 * t * math.cos(theta1) + math.sin(theta1)) * growth**3
          - (3 * t * math.cos(theta0) + math.sin(theta0))) / (3 * (1 + 9 * t * t))
    f2 = length * (2 * math.cos(theta0) - length) * math.sin(theta0) / 6
    f3 = growth * (math.sin(theta1 - theta0) - length * math.sin(theta1)) * (
        math.cos(theta0) - length + math.cos(theta1) * growth) / 6
    work = f1 - f2 - f3
    return (growth**2 - 1) / (2 * t * work) * rise if work > 0 else math.inf


def least_height(phi, beta):
    """The least gamma H/c, on grids of angles that close in on it."""
    best, centre, width = math.inf, (0.8, 1.6), (0.75, 1.3)
    for _ in range(40):
        n = 12
        for i in range(-n, n + 1):
            for j in range(-n, n + 1):
                theta0 = centre[0] + width[0] * i / n
                theta1 = centre[1] + width[1] * j / n
                if 0 < theta0 < theta1 < math.pi:
                    value = height(phi, beta, theta0, theta1)
                    if value < best:
                        best, found = value, (theta0, theta1)
        centre, width = found, (0.6 * width[0], 0.6 * width[1])
    return best


def safety_factor(phi, ratio, beta):
    """F for c = ratio gamma H, by bisection."""
    low, high = 0.1, 10.
    while high - low > 1e-6:
        factor = 0.5 * (low + high)
        reduced = math.atan(math.tan(phi) / factor)
        if least_height(reduced, beta) > factor / ratio:
            low = factor
        else:
            high = factor
    return low


def main():
    """Prints the checks and the factor."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--phi", type=float, default=20., help="friction [deg]")
    parser.add_argument("--ratio", type=float, default=0.05, help="c/(gamma H)")
    parser.add_argument("--slope", type=float, default=2., help="horizontal to 1 vertical")
    arg = parser.parse_args()
    for phi in (1e-3, 20.):
        print(f"vertical cut, phi = {phi:g} deg: gamma H/c = "
              f"{least_height(math.radians(phi), math.pi / 2):.4f}")
    factor = safety_factor(math.radians(arg.phi), arg.ratio, math.atan(1 / arg.slope))
    print(f"slope {arg.slope:g}:1, phi = {arg.phi:g} deg, c = {arg.ratio:g} gamma H: F <= {factor:.4f}")


if __name__ == "__main__":
    main()
