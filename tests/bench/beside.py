#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of README.md and the figure samples/fit-routes.svg: the exponent b of the same simulated
runs, by the routes of fitpower and by what one would use in its place.

    PATH=$PWD/bin:$PATH python3 tests/bench/beside.py [RUNS]        (scipy, lmfit)

Each run is one of `simulate --sensor pasco`. rolling takes it as it is. The others get the free roll,
cut at the times that are known here, and its positions. Printed are, for CR and CF, the standard
deviation of b, its bias, the share of nominal 95 % intervals that hold the true b, the mean of the
standard uncertainties as a multiple of that standard deviation, and the processor time of a fit: that
of the whole program fitpower, its start included. The rows `of v` fit the velocities that the program
of the sensor exports.
"""
import io
import resource
import subprocess
import sys

import lmfit
import numpy as np
from scipy import odr

RUNS = int(sys.argv[1]) if len(sys.argv) > 1 else 200
PUSHED, G, K, R = 1.5, 9.81, 0.5, 0.04
C = G / ((K + 1) * R)
BODY = ["-K", str(K), "-R", str(R)]
D_OF_X = [["differentiate", "-c", "x"], ["smooth", "-w", "11"], ["differentiate"], ["shift-from-accel", "-q", *BODY]]


def scene(name):
    lines = open(f"samples/{name}.toml").read().splitlines()
    values = dict(line.split(" = ") for line in lines if " = " in line)
    return [float(values[key]) for key in ("coefficient", "exponent", "v0")]


def run(name, seed):
    return subprocess.run(["simulate", "--scene", f"samples/{name}.toml", "--sensor", "pasco", "--seed",
                           str(seed)], capture_output=True, text=True, check=True).stdout


def readings(text, a, b, v0, column, margin):
    """Times and readings of the free roll: from the release to the stop of the law, less a margin."""
    t, y = np.genfromtxt(io.StringIO(text), delimiter=",", skip_header=1, usecols=(0, column)).T
    stop = PUSHED + v0 ** (1 - b) / ((1 - b) * a * C)
    kept = (t >= PUSHED + margin - 1e-9) & (t < stop - margin) & ~np.isnan(y)
    return t[kept] - PUSHED, y[kept]


def points(t, x):
    """v and D, as in a spreadsheet: differences, a mean over eleven rows, differences."""
    def central(y, at):
        return (y[2:] - y[:-2]) / (at[2:] - at[:-2]), at[1:-1]
    v, at = central(x, t)
    v, at = np.convolve(v, np.ones(11) / 11, "valid"), at[5:-5]
    slope, _ = central(v, at)
    return v[1:-1], -slope / C


def by_hand(t, x):
    v, D = points(t, x)
    kept = (D > 0) & (v > 0)
    (b, _), covariance = np.polyfit(np.log(v[kept]), np.log(D[kept]), 1, cov=True)
    return b, np.sqrt(covariance[0, 0])


def by_odr(t, x, start):
    v, D = points(t, x)
    model = odr.Model(lambda p, v: p[0] * np.maximum(v, 1e-9) ** p[1])
    fit = odr.ODR(odr.RealData(v, D * 1e3, sx=1e-3, sy=0.1), model, beta0=[1e3 * start[0], start[1]]).run()
    return fit.beta[1], fit.sd_beta[1]


def by_lmfit(t, y, start, of_v=False):
    def residuals(p):
        a, b, v0, x0 = (p[name].value for name in ("a", "b", "v0", "x0"))
        v = np.maximum(v0 ** (1 - b) - (1 - b) * 1e-3 * a * C * t, 0) ** (1 / (1 - b))
        return v - y if of_v else x0 + (v0 ** (2 - b) - v ** (2 - b)) / ((2 - b) * 1e-3 * a * C) - y
    p = lmfit.Parameters()
    p.add("a", 1e3 * start[0], min=1e-6)
    p.add("b", start[1], max=0.95)
    p.add("v0", start[2], min=1e-3)
    p.add("x0", y[0], vary=not of_v)
    fit = lmfit.minimize(residuals, p)
    return fit.params["b"].value, fit.params["b"].stderr or np.nan


def piped(text, *commands):
    for command in commands:
        text = subprocess.run(command, input=text, capture_output=True, text=True, check=True).stdout
    return text


def by_rolling(rows, route):
    row = piped(rows, ["fitpower", "-q", "--route", route, *BODY]).splitlines()[-1]
    return [float(cell) for cell in row.split("\t")[2:4]]


def seconds():
    return sum(part for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
               for part in resource.getrusage(who)[:2])


found = {}
for name in ("CR", "CF"):
    law = scene(name)
    for seed in range(1, RUNS + 1):
        text = run(name, seed)
        t, x = readings(text, *law, column=1, margin=0)
        of_v = readings(text, *law, column=2, margin=0.08)
        roll, roll_of_v = (piped(text, ["smooth", "-q", "--coast", "-c", column]) for column in "xv")
        shifts = piped(roll, *D_OF_X)
        fits = {
            "log-log by hand": lambda: by_hand(t, x),
            "scipy.odr": lambda: by_odr(t, x, law),
            "lmfit": lambda: by_lmfit(t, x, law),
            "lmfit of v": lambda: by_lmfit(*of_v, law, of_v=True),
            "rolling": lambda: by_rolling(roll, "position"),
            "rolling of v": lambda: by_rolling(roll_of_v, "velocity"),
            "rolling, shift": lambda: by_rolling(shifts, "shift"),
            "rolling, loglog": lambda: by_rolling(shifts, "loglog"),
        }
        for what, fit in fits.items():
            begin = seconds()
            b, sigma = fit()
            found.setdefault((name, what), []).append((b, sigma, seconds() - begin))
print("# scene", "by", "sd_b", "bias_b", "coverage", "sigma_over_sd", "ms", sep="\t")
for (name, what), fits in found.items():
    b, sigma, time = np.array(fits).T
    off = b - scene(name)[1]
    print(name, what, f"{np.std(b):.4f}", f"{np.mean(off):+.4f}", f"{np.mean(np.abs(off) < 1.96 * sigma):.3f}",
          f"{np.mean(sigma) / np.std(b):.2f}", f"{1e3 * np.median(time):.1f}", sep="\t")
