#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reference rolls for trajectory_test.cpp: python3 trajectory_reference.py > trajectory_reference.inc (mpmath; a few minutes).

Time and distance by tanh-sinh quadrature of Eq. 12 over y = ln(v0/u) with 40 digits, the speed at a time by the secant method,
the derivatives by central differences with a step of 1e-12 (relative error about 1e-24): nothing here knows a power integral,
a series or a panel.
"""
from mpmath import mp, mpf, quad, sqrt, exp, log

mp.dps = 40
R, g = mpf(0.04), mpf(9.81)  # the doubles, exactly


def integrand(exact, K, a, b, v0):
    def force(y):
        u = v0 * exp(-y)
        D = a * u ** b / R
        A = sqrt(max(mpf(0), 1 - D * D)) if exact else mpf(1)
        return (K + A) * R / (g * a) * u ** (1 - b)
    return force


def pieces(y):
    n = int(y / 2) + 1
    return [y * i / n for i in range(n + 1)]


def time_of(y, *law):
    return quad(integrand(*law), pieces(y))


def roll(t, y, exact, K, a, b, v0):
    """v and x at time t; y is about ln(v0/v)."""
    f = integrand(exact, K, a, b, v0)
    for _ in range(60):
        step = (quad(f, pieces(y)) - t) / f(y)
        y -= step
        if abs(step) < mpf(10) ** -34 * y:
            break
    return v0 * exp(-y), quad(lambda u: f(u) * v0 * exp(-u), pieces(y))


print("// Made by trajectory_reference.py: exact, K, a, b, v0, t, v, x, v_a, v_b, v_v0, x_a, x_b, x_v0")
tiny = 2.0 ** -50
for exact in (0, 1):
    for b in (-0.5, -0.1, 0.0, 0.0244, 0.215, 0.5, 1 - tiny, 1.0, 1 + tiny, 1.5, 2 - 2 * tiny, 2.0, 2 + 2 * tiny, 3.0):
        for K, v0, depth in ((0.5, 0.5, 0.04), (0.83, 2.0, 0.45), (0.0, 0.03, 0.7), (0.5, 0.5, 0.97)):
            if not exact and depth > 0.5:
                continue
            a = float(depth * 0.04 * v0 ** -b)
            law = (exact, mpf(K), mpf(a), mpf(b), mpf(v0))
            for rho in (1 - 1e-6, 0.8, 0.1, 1e-4):
                y = -log(mpf(rho))
                if exact and depth * rho ** b > 0.999:
                    continue
                t = float(time_of(y, *law))
                v, x = roll(mpf(t), y, *law)
                row = [v, x]
                slopes = []
                for i in (2, 3, 4):
                    h = mpf(10) ** -12 * max(abs(law[i]), mpf("0.01"))
                    ends = []
                    for sign in (1, -1):
                        p = list(law)
                        p[i] += sign * h
                        ends.append(roll(mpf(t), log(p[4] / v), *p))
                    slopes.append([(ends[0][j] - ends[1][j]) / (2 * h) for j in (0, 1)])
                row += [s[0] for s in slopes] + [s[1] for s in slopes]
                print("{%d, %r, %r, %r, %r, %r, %s}," % (exact, K, a, b, v0, t, ", ".join(repr(float(q)) for q in row)))
