#!/usr/bin/env python3
"""Reference for power_integral_test.cpp: python3 power_integral_reference.py > power_integral_reference.inc (mpmath, 150 digits).

The integrals in their textbook form; 150 digits bear its cancellation.
"""
from mpmath import mp, mpf, exp

mp.dps = 150


def p(s, y):
    return y if s == 0 else (1 - exp(-s * y)) / s


def m(s, y):
    return y * y / 2 if s == 0 else (1 - (1 + s * y) * exp(-s * y)) / s**2


print("// Made by power_integral_reference.py: s, lambda, power_integral, power_moment, headway integral, headway moment")
for s in (-2.5, -1 - 2.0**-52, -1.0, -1 + 2.0**-53, -0.3, -1e-9, -1e-16, 0.0, 2.0**-52, 1e-9, 0.02, 0.785, 1.0, 1.5, 7.3):
    for y in (1e-12, 1e-3, 0.12, 0.9, 1.1, 3.0, 30.0, 200.0):
        S, Y = mpf(s), mpf(y)
        rho = exp(-Y)
        row = [p(S, Y), m(S, Y), p(S + 1, Y) - rho * p(S, Y), m(S + 1, Y) - rho * m(S, Y)]
        print("{%r, %r, %s}," % (s, y, ", ".join(repr(float(q)) for q in row)))
