#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reference rolls with D = min(a v^b, R), b < 0, for trajectory_test.cpp: python3 radius_reference.py > radius_reference.inc (mpmath; some seconds).

Time and distance by quadrature over u of du / (-dv/dt) and u du / (-dv/dt) with 60 digits, where
-dv/dt = g (D cos(theta) + A R sin(theta)) / ((K + A) R), in w with u = v_R e^(w^2), which removes the root that A has at D = R;
below v_R by uniform deceleration. The derivatives are central differences with a step of 1e-30. Each roll at a moment while D is R,
if a double of t tells it, and at rest.
"""
from mpmath import mp, mpf, quad, sqrt, exp, log, nstr

mp.dps = 60
R, g = mpf(0.04), mpf(9.81)  # the doubles, exactly


def until_radius(K, a, b, v0, S):
    """v_R, and time and distance from v0 to there."""
    v_R, cos = (R / a) ** (1 / b), 1 / sqrt(1 + S * S)

    def integral(f):
        def by_w(w):
            u = v_R * exp(w * w)
            D = a * u ** b
            A = sqrt(max(mpf(0), 1 - (D / R) ** 2))
            return (K + A) * R / (g * cos * (D + A * R * S)) * f(u) * 2 * u * w
        end = sqrt(log(v0 / v_R))
        return quad(by_w, [end * i / 12 for i in range(13)])

    return v_R, integral(lambda u: 1), integral(lambda u: u)


def stop(*law):
    v_R, time, way = until_radius(*law)
    held = v_R * law[0] * sqrt(1 + law[4] ** 2) / g
    return time, time + held, way + v_R * held / 2


def roll(t, *law):
    """v and x at a time t after D = R."""
    _, stopped, way = stop(*law)
    if t >= stopped:
        return mpf(0), way
    v = g / sqrt(1 + law[4] ** 2) / law[0] * (stopped - t)
    return v, way - v * (stopped - t) / 2


print("// Made by radius_reference.py: K, a, b, v0, S, t, time at D = R, stop, v, x, v_a, v_b, v_v0, v_S, x_a, x_b, x_v0, x_S")
for values in ((0.5, 2e-3, -0.5, 0.5, 0), (0.5, 2e-3, -0.1, 0.5, 0), (0.83, 5e-3, -2, 0.5, 0), (0, 2e-3, -0.5, 0.5, 0),
               (0.5, 2e-3, -0.5, 0.5, 1e-3), (0.5, 2e-3, -0.5, 0.5, -1e-3), (0.83, 5e-3, -1, 0.3, 0.1), (0, 2e-3, -0.5, 0.5, 0.1)):
    law = [mpf(x) for x in values]
    time, stopped, _ = stop(*law)
    for t in ([float(time + (stopped - time) / 4)] if stopped - time > 1e-9 * time else []) + [float(stopped * 1.5)]:
        slopes = []
        for i in (1, 2, 3, 4):
            h = mpf(10) ** -30
            above, below = ([x + s * h * (j == i) for j, x in enumerate(law)] for s in (1, -1))
            slopes.append([(x - y) / (2 * h) for x, y in zip(roll(t, *above), roll(t, *below))])
        numbers = [*law, t, time, stopped, *roll(t, *law), *(s[0] for s in slopes), *(s[1] for s in slopes)]
        print("{" + ", ".join(nstr(mpf(x), 17) for x in numbers) + "},")
