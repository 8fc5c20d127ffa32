#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fits the records of fits/*.dat with this project and, those that have a closed form, with other
programs, and prints how many digits of the certified values each finds: the least over the
parameters / the least over their standard deviations. A program that asks for starting values gets
both of the file, and the worse one counts; `-` if it finds no minimum from one of them.

    python3 peers.py FOLDER [RECORD...]   scipy, lmfit, gnuplot; the tools on the PATH
"""
import glob
import os
import re
import subprocess
import sys
import tempfile

import lmfit
import numpy as np
import scipy
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
    return min(16, -np.log10(max(off.max(), 1e-16))) if np.all(off < 0.1) else np.nan


def with_numpy(model, c):
    code = compile(model, "model", "eval")
    def of(x, *b):
        with np.errstate(all="ignore"):
            return np.nan_to_num(eval(code, {"exp": np.exp, "x": x, "c": c, **{
                f"b{i + 1}": z for i, z in enumerate(b)}}), nan=1e3)
    return of


def of_scipy(of, x, y, start):
    found, covariance = curve_fit(of, x, y, start, maxfev=20000, ftol=1e-15, xtol=1e-15, gtol=1e-15)
    return found, np.sqrt(np.diag(covariance))


def of_lmfit(of, x, y, start):
    names = [f"p{i}" for i in range(len(start))]
    parameters = lmfit.Parameters()
    for name, value in zip(names, start):
        parameters.add(name, value)
    fit = lmfit.minimize(lambda p: of(x, *[p[n].value for n in names]) - y, parameters,
                         ftol=1e-15, xtol=1e-15, gtol=1e-15)
    return (np.array([fit.params[n].value for n in names]),
            np.array([fit.params[n].stderr or np.nan for n in names]))


def of_gnuplot(model, c, x, y, start):
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


def of_rolling():
    """As right-digits.awk has them: {record: (digits of the parameters, of their sigmas)}."""
    script = os.path.join(os.path.dirname(__file__), "../pipeline/certified-fits.sh")
    out = subprocess.run([script, "table"], capture_output=True, text=True, check=True)
    right = {}
    for name, _, *words in (line.split() for line in out.stdout.splitlines()):
        cells = [(what, float(z)) for what, z in zip(words[::2], words[1::2]) if what != "rms"]
        right[name] = (min(z for what, z in cells if not what.startswith("sigma_")),
                       min(z for what, z in cells if what.startswith("sigma_")))
    return right


def show(pair):
    return "-" if np.isnan(pair).any() else "%.1f / %.1f" % tuple(pair)


def worst(fit, rows):
    pairs = []
    for start in (rows[:, 0], rows[:, 1]):
        try:
            found, sigma = fit(start)
            pairs.append((digits(found, rows[:, 2]), digits(sigma, rows[:, 3])))
        except (RuntimeError, ValueError, IndexError):
            pairs.append((np.nan, np.nan))
    return show(np.min(pairs, axis=0))


def version(program):
    out = subprocess.run([program, "--version"], capture_output=True, text=True, check=True)
    return re.search(r"\d[.\d]*( patchlevel \d+)?", out.stdout).group().replace(" patchlevel ", ".")


def main():
    programs = {"rolling": version("fitpower"), "scipy": scipy.__version__,
                "lmfit": lmfit.__version__, "gnuplot": version("gnuplot")}
    print(("%-9s" + "%15s" * 4) % ("record", *(f"{p} {v}" for p, v in programs.items())))
    ours = of_rolling()
    for path in sorted(glob.glob(os.path.join(sys.argv[1], "*.dat"))):
        name = os.path.basename(path)[:-4]
        if sys.argv[2:] and name not in sys.argv[2:]:
            continue
        cells = [show(ours[name])]
        case = read(path)
        if case:
            model, c, rows, y, x = case
            of = with_numpy(model, c)
            cells += [worst(lambda start: of_scipy(of, x, y, start), rows),
                      worst(lambda start: of_lmfit(of, x, y, start), rows),
                      worst(lambda start: of_gnuplot(model, c, x, y, start), rows)]
        print("%-9s" % name + "".join("%15s" % cell for cell in cells), flush=True)


main()
