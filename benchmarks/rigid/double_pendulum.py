#!/usr/bin/env python3
"""Two rods hinged to each other and to space, by Lagrange's equations of their two angles: the numbers
that prm/double_pendulum.prm compares with.

    double_pendulum.py

Classical Runge-Kutta steps of 2e-5 and 1e-5 s, which agree to ten digits. It shares nothing with
kedge: two coordinates and no constraint.
"""
from math import cos, pi, sin

L1, M1, L2, M2, G = 1.0, 2.0, 0.7, 1.0, 9.81
START = (pi / 2, pi / 3) # from hanging, at rest


def rates(state):
    """d/dt of the angles a, b from hanging and of their velocities."""
    a, b, u, v = state
    inertia_1, inertia_2 = M1 * L1**2 / 12, M2 * L2**2 / 12
    k = M2 * L1 * L2 / 2
    m11, m22 = inertia_1 + M1 * L1**2 / 4 + M2 * L1**2, inertia_2 + M2 * L2**2 / 4
    m12 = k * cos(a - b)
    f1 = -k * sin(a - b) * v * v - (M1 / 2 + M2) * L1 * G * sin(a)
    f2 = k * sin(a - b) * u * u - M2 * L2 / 2 * G * sin(b)
    det = m11 * m22 - m12 * m12
    return u, v, (m22 * f1 - m12 * f2) / det, (m11 * f2 - m12 * f1) / det


def integrate(times, dt):
    """The states at some times, each a multiple of dt."""
    state, found, step = (*START, 0.0, 0.0), [], 0
    for time in times:
        while step < round(time / dt):
            k1 = rates(state)
            k2 = rates([x + dt / 2 * k for x, k in zip(state, k1)])
            k3 = rates([x + dt / 2 * k for x, k in zip(state, k2)])
            k4 = rates([x + dt * k for x, k in zip(state, k3)])
            state = tuple(x + dt / 6 * (p + 2 * q + 2 * r + s)
                          for x, p, q, r, s in zip(state, k1, k2, k3, k4))
            step += 1
        found.append(state)
    return found


def main():
    """Prints angles, and the place of the lower rod's centre."""
    times = (0.5, 1.0, 2.0)
    for dt in (2e-5, 1e-5):
        for time, (a, b, u, v) in zip(times, integrate(times, dt)):
            x = L1 * sin(a) + L2 / 2 * sin(b)
            y = -L1 * cos(a) - L2 / 2 * cos(b)
            print(f"dt {dt:g}  t {time:3.1f}  a {a:.10f}  b {b:.10f}  lower centre {x:.10f} {y:.10f}"
                  f"  velocities {u:.8f} {v:.8f}")


if __name__ == "__main__":
    main()
