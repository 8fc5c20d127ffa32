#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fits the records of fits/*.dat that have a closed form with other programs, and prints how many
digits of the certified values each finds: the least over the parameters and over their standard
deviations, from both starting values; `-` if it finds no minimum.

    python3 peers.py fits        (scipy, lmfit, gnuplot)
"""
import glob
import os
import re
import subprocess
import sys
import tempfile

import lmfit
import numpy as np
from scipy.optimize import curve_fit


def read(path):
    text = open(path).read()
    model = re.search(r"y = (.*?)  \+  e", text)
    c = re.search(r"c = g/\(\(K\+1\)\*R\) = (\S+)", text)
    if not model or not c:
        return None
    rows = [[float(z) for z in line.split()[2:]]
            for line in re.findall(r"^  b\d+ = .*$", text, re.M)]
    data = np.array([[float(z) for z in line.split()] for line in text.split("Data:   y")[1]
                     .splitlines()[1:]])
    return model.group(1), float(c.group(1)), np.array(rows), data[:, 0], data[:, 1] - data[0, 1]


def digits(found, certified):
    off = np.abs(found / certified - 1)
    return "-" if not np.all(off < 0.1) else "%.1f" % min(16, -np.log10(max(off.max(), 1e-16)))


def with_numpy(model, c):
    code = compile(model, "model", "eval")
    def of(x, *b):
        with np.errstate(all="ignore"):
            return np.nan_to_num(eval(code, {"exp": np.exp, "x": x, "c": c, **{
                f"b{i + 1}": z for i, z in enumerate(b)}}), nan=1e3)
    return of


def scipy(of, x, y, start):
    found, covariance = curve_fit(of, x, y, start, maxfev=20000, ftol=1e-15, xtol=1e-15, gtol=1e-15)
    return found, np.sqrt(np.diag(covariance))


def of_lmfit(of, x, y, start):
    names = [f"p{i}" for i in range(len(start))]
    parameters = lmfit.Parameters()
    for name, value in zip(names, start):
        parameters.add(name, value)
    fit = lmfit.minimize(lambda p: of(x, *[p[n].value for n in names]) - y, parameters)
    return (np.array([fit.params[n].value for n in names]),
            np.array([fit.params[n].stderr or np.nan for n in names]))


def gnuplot(model, c, x, y, start):
    with tempfile.TemporaryDirectory() as folder:
        np.savetxt(os.path.join(folder, "data"), np.c_[x, y], fmt="%.17g")
        b = [f"b{i + 1}" for i in range(len(start))]
        script = f"c={c!r}\nset fit quiet nolog errorvariables limit 1e-15\nf(x)={model}\n"
        script += "".join(f"{n}={z!r}\n" for n, z in zip(b, start))
        script += f"fit f(x) 'data' via {','.join(b)}\nset print '-'\n"
        script += "".join(f"print sprintf('%.17g %.17g', {n}, {n}_err)\n" for n in b)
        out = subprocess.run(["gnuplot"], input=script, cwd=folder, capture_output=True, text=True)
        rows = np.array([[float(z) for z in line.split()] for line in out.stdout.splitlines()])
        return rows[:, 0], rows[:, 1]


def main():
    programs = ["scipy", "lmfit", "gnuplot"]
    print("%-10s" % "record" + "".join("%16s" % p for p in programs))
    for path in sorted(glob.glob(os.path.join(sys.argv[1], "*.dat"))):
        case = read(path)
        if not case:
            continue
        model, c, rows, y, x = case
        of = with_numpy(model, c)
        line = "%-10s" % os.path.basename(path)[:-4]
        for program in programs:
            cells = []
            for start in (rows[:, 0], rows[:, 1]):
                try:
                    found, sigma = (scipy(of, x, y, start) if program == "scipy" else
                                    of_lmfit(of, x, y, start) if program == "lmfit" else
                                    gnuplot(model, c, x, y, start))
                    cells.append(digits(found, rows[:, 2]) + "/" + digits(sigma, rows[:, 3]))
                except Exception:
                    cells.append("-")
            line += "%16s" % " ".join(cells)
        print(line, flush=True)


main()
