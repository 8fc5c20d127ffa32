#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reference rolls on a slope for slope_test.cpp: python3 slope_reference.py > slope_reference.inc (mpmath; a few minutes).

Time and distance by quadrature over y = ln(v0/u) of du / (-dv/dt) with 34 digits, where
dv/dt = -g (D cos(theta) + A R sin(theta)) / ((K + A) R); the speed at a time by the secant method, the derivatives by central
differences with a step of 1e-12 (relative error about 1e-24): nothing here knows a panel.
"""
from mpmath import mp, mpf, quad, sqrt, exp, log

mp.dps = 34
R, g = mpf(0.04), mpf(9.81)  # the doubles, exactly


def integrand(exact, K, a, b, v0, S):
    def force(y):
        u = v0 * exp(-y)
        D = a * u ** b / R
        A = sqrt(max(mpf(0), 1 - D * D)) if exact else mpf(1)
        return (K + A) * u * sqrt(1 + S * S) / (g * (D + A * S))
    return force


def integral(f, y):
    """Over 0 to y, in pieces that shrink towards y, where 1/(-dv/dt) may have its pole."""
    ends = [y * i / 4 for i in range(4)] + [y * (1 - mpf(4) ** -k / 4) for k in range(1, 10)] + [y]
    return quad(f, ends, method="gauss-legendre")


def time_of(y, *law):
    return integral(integrand(*law), y)


def roll(t, y, *law):
    """v and x at time t; y is ln(v0/v) but for a small part, whose square does not matter."""
    f, v0 = integrand(*law), law[4]
    before, x = integral(f, y), integral(lambda u: f(u) * v0 * exp(-u), y)
    step = mpf(0)
    for _ in range(4):
        gone = before + quad(f, [y, y + step], method="gauss-legendre") if step else before
        step += (t - gone) / f(y + step)
    return v0 * exp(-y - step), x + quad(lambda u: f(u) * v0 * exp(-u), [y, y + step], method="gauss-legendre")


def targets(exact, a, b, v0, S):
    """y = ln(v0/v) of some moments: towards the stop, or towards the speed that the body tends to."""
    D = a * v0 ** b / R
    A = sqrt(1 - D * D) if exact else 1
    slows = D + A * S > 0
    balance = (abs(S) / sqrt(1 + S * S) if exact else abs(S)) * R
    way = 1 if slows else -1
    end = mpf(way) * 12
    if S < 0 and b > 0:
        end = log(v0 / (balance / a) ** (1 / b))
    if abs(end) > 12:
        end = mpf(way) * 12
    if exact and b < 0 and slows:
        end = min(end, log(D) / b * mpf(0.99))
    return [end * mpf(part) for part in (1e-2, 0.3, 0.9, 1 - 1e-4)]


print("// Made by slope_reference.py: exact, K, a, b, v0, S, t, v, x, v_a, v_b, v_v0, v_S, x_a, x_b, x_v0, x_S")
for exact in (0, 1):
    for b in (-5.0, -2.0, -0.5, 0.0, 0.0244, 0.215, 1.0, 1.5, 3.0, 20.0):
        for K, v0, depth, S in ((0.5, 0.5, 0.04, 1e-3), (0.5, 0.5, 0.04, -1e-3), (0.83, 0.5, 0.0145, -5e-3), (0.5, 2.0, 0.45, 0.1), (0.83, 0.1, 0.9, -0.3),
                                (0.5, 0.3, 0.01, -0.02), (0.5, 0.3, 0.01, -1.5), (0.0, 1.3, 0.3, 2.0)):
            a = float(depth * 0.04 * v0 ** -b)
            law = (exact, mpf(K), mpf(a), mpf(b), mpf(v0), mpf(S))
            for y in targets(exact, *law[2:]):
                if not exact and depth * exp(-b * y) > 50:
                    continue
                t = float(time_of(y, *law))
                v, x = roll(mpf(t), y, *law)
                slopes = []
                for i in (2, 3, 4, 5):
                    h = mpf(10) ** -12 * (law[i] if i == 2 else max(abs(law[i]), mpf("0.01"))) * (mpf("1e-3") if i == 5 else 1)
                    ends = []
                    for sign in (1, -1):
                        p = list(law)
                        p[i] += sign * h
                        ends.append(roll(mpf(t), log(p[4] / v), *p))
                    slopes.append([(ends[0][j] - ends[1][j]) / (2 * h) for j in (0, 1)])
                row = [v, x] + [s[0] for s in slopes] + [s[1] for s in slopes]
                print("{%d, %r, %r, %r, %r, %r, %r, %s}," % (exact, K, a, b, v0, S, t, ", ".join(repr(float(q)) for q in row)), flush=True)
