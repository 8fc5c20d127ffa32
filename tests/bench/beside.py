#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of README.md: the exponent b of the same simulated runs, by rolling and by what one would
use in its place.

    PATH=$PWD/bin:$PATH python3 tests/bench/beside.py [RUNS]        (scipy, lmfit)

Each run is one of `simulate --sensor pasco`. rolling takes it as it is. The others get the free roll,
cut at the times that are known here, and its positions. Printed are, for CR and CF, the standard
deviation of b, its bias, the share of nominal 95 % intervals that hold the true b, and the mean of the
standard uncertainties as a multiple of that standard deviation. The rows `of v` fit the velocities that
the program of the sensor exports.
"""
import io
import subprocess
import sys

import lmfit
import numpy as np
from scipy import odr

RUNS = int(sys.argv[1]) if len(sys.argv) > 1 else 200
PUSHED, G, K, R = 1.5, 9.81, 0.5, 0.04
C = G / ((K + 1) * R)
ROUTE = {"x": "position", "v": "velocity"}


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


def by_rolling(text, column):
    roll = subprocess.run(["smooth", "-q", "--coast", "-c", column], input=text, capture_output=True, text=True, check=True)
    row = subprocess.run(["fitpower", "-q", "--route", ROUTE[column], "-K", str(K), "-R", str(R)], input=roll.stdout,
                         capture_output=True, text=True, check=True)
    return [float(cell) for cell in row.stdout.splitlines()[-1].split("\t")[2:4]]


found = {}
for name in ("CR", "CF"):
    law = scene(name)
    for seed in range(1, RUNS + 1):
        text = run(name, seed)
        t, x = readings(text, *law, column=1, margin=0)
        fits = {
            "log-log by hand": by_hand(t, x),
            "scipy.odr": by_odr(t, x, law),
            "lmfit": by_lmfit(t, x, law),
            "rolling": by_rolling(text, "x"),
            "lmfit of v": by_lmfit(*readings(text, *law, column=2, margin=0.08), law, of_v=True),
            "rolling of v": by_rolling(text, "v"),
        }
        for what, fit in fits.items():
            found.setdefault((name, what), []).append(fit)
for (name, what), fits in found.items():
    b, sigma = np.array(fits).T
    off = b - scene(name)[1]
    print(f"{name} {what:16} sd of b {np.std(b):.4f}  bias {np.mean(off):+.4f}  coverage "
          f"{np.mean(np.abs(off) < 1.96 * sigma):.3f}  sigma {np.mean(sigma) / np.std(b):.2f}")
