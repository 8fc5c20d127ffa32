#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# The same runs by SciPy: build/bench/signal runs 50 | tests/bench/signal_scipy.py
# Prints rows of the table of tests/bench/signal.cpp: savgol_filter and UnivariateSpline (its s from the known noise).
import sys
import time
from itertools import groupby

import numpy as np
from scipy.interpolate import UnivariateSpline
from scipy.signal import savgol_filter

DT, NOISE, ENDS = 0.04, (0.0003**2 + 0.001**2 / 12) ** 0.5, 5


def savgol(width, order):
    def apply(t, x, v):
        return savgol_filter(v, width, order), savgol_filter(v, width, order, deriv=1, delta=DT)
    return apply


def spline_of_x(t, x, v):
    s = UnivariateSpline(t, x, k=5, s=len(t) * NOISE**2)
    return s.derivative(1)(t), s.derivative(2)(t)


def spline_of_v(t, x, v):
    s = UnivariateSpline(t, v, k=3, s=len(t) * NOISE**2 / (2 * DT**2))
    return s(t), s.derivative(1)(t)


methods = {("scipy_savgol1", 23): savgol(23, 1), ("scipy_savgol2", 11): savgol(11, 2), ("scipy_savgol2", 23): savgol(23, 2),
           ("scipy_savgol2", 31): savgol(31, 2), ("scipy_spline_of_x", "NaN"): spline_of_x, ("scipy_spline_of_v", "NaN"): spline_of_v}
rows = (line.split() for line in sys.stdin)
for scene, runs in groupby(rows, key=lambda r: r[0]):
    runs = [np.array([[float(c) for c in r[2:]] for r in run]).T for _, run in groupby(runs, key=lambda r: r[1])]
    for (name, width), apply in methods.items():
        v_error, a_error, ends, relative, seconds = [], [], [], [], []
        for t, x, v_true, a_true in runs:
            v = np.gradient(x, t, edge_order=2)
            begin = time.perf_counter()
            smooth, a = apply(t, x, v)
            seconds.append((time.perf_counter() - begin) / len(t))
            error = a - a_true
            inside = slice(ENDS, -ENDS)
            v_error.append(smooth[inside] - v_true[inside])
            a_error.append(error[inside])
            relative.append(error[inside] / a_true[inside])
            ends.append(np.r_[error[:ENDS], error[-ENDS:]])
        bias = np.mean(a_error, axis=0)
        rms = lambda x: np.sqrt(np.mean(np.square(x)))
        print(scene, name, width, *(f"{f:.3e}" for f in (rms(v_error), rms(a_error), rms(bias), rms(a_error - bias), rms(ends))),
              f"{rms(relative):.4f}", f"{np.median(seconds):.2e}", sep="\t")
