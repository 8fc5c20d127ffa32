#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""extremes.py [SHORT]: `simulate` at the ends of what can be asked, against 30 digits.

A row for each scene: the error of v where the body has lost half of its speed, as a part of v0, that
of the stop, as a part of its time, the seconds that the tool took, or its refusal. The reference is
the time as an integral over the speed (mpmath), t(v) = int (K + A) R/(g (D cos + A R sin)) dv. With
a memory of length L both are the distance from the law without one, to which they tend with L; the
ringing before rest takes a time that goes as the square root of L. On roads the rows are those of
`simulate --report`: a tolerance each, against 1e-12, v as a part of the highest speed, and the
seconds are those of a row of the motion. Needs python3-mpmath."""
import math
import pathlib
import subprocess
import sys
import tempfile
import time

from mpmath import mp, mpf

mp.dps = 30
K, R, g = mpf(0.5), mpf(0.04), mpf(9.81)


def deceleration(v, a, b, slope, exact):
    D = a * v**b
    A = mp.sqrt(1 - (D / R) ** 2) if exact else mpf(1)
    cos = 1 / mp.sqrt(1 + slope**2)
    return g * (D * cos + A * R * slope * cos) / ((K + A) * R)


def time_between(low, high, *law):
    """In the share of the highest speed, and of the time that its deceleration takes: mp.quad knows
    absolute errors alone. In s^4 down to 0, where the integrand has a power of v."""
    unit = high / deceleration(high, *law)
    at = lambda share: deceleration(high, *law) / deceleration(high * share, *law)
    if low == 0:
        return unit * mp.quad(lambda s: 4 * s**3 * at(s**4), [0, 1])
    return unit * mp.quad(at, [low / high, 1])


def run(options):
    begin = time.perf_counter()
    done = subprocess.run(["simulate", *options], capture_output=True, text=True, timeout=600)
    seconds = time.perf_counter() - begin
    rows = [line.split("\t") for line in done.stdout.splitlines() if line and not line.startswith("#")]
    said = done.stderr.strip().splitlines()
    return rows, seconds, (said[-1].split(": ", 1)[-1] if done.returncode else "")


def row(name, a, b, v0, slope=0.0, exact=False, more=(), stops=True):
    a, b, v0, slope = mpf(a), mpf(b), mpf(v0), mpf(slope)
    options = ["-K", "0.5", "-R", "0.04", "-a", repr(float(a)), "-b", repr(float(b)), "--v0", repr(float(v0)),
               "--slope=" + repr(float(slope)), *(["--exact"] if exact else []), *more]
    law = (a, b, slope, exact)
    half = float(time_between(v0 / 2, v0, *law))
    rows, seconds, refused = run([*options, "--columns", "t,v", "--until", repr(half), "--dt", repr(half)])
    v_error = stop_error = ""
    if not refused:
        # the reference at this very double
        v = v0 / 2 - deceleration(v0 / 2, *law) * (mpf(half) - time_between(v0 / 2, v0, *law))
        v_error = "%.1e" % (abs(mpf(float(rows[-1][1])) - v) / v0)
    if stops:
        rows, more_seconds, refused = run([*options, "--columns", "t,v", "--dt", repr(10 * half)])
        seconds += more_seconds
        if not refused:
            stop = time_between(0, v0, *law)
            stop_error = "%.1e" % (abs(mpf(float(rows[-1][0])) - stop) / stop)
    print(f"{name}\t{v_error}\t{stop_error}\t{seconds:.2f}\t{refused}", flush=True)


def timed(name, options):
    _, seconds, refused = run(options)
    print(f"{name}\t\t\t{seconds:.2f}\t{refused}", flush=True)


def road(name, heights, coefficients, options):
    """heights: of x and h; coefficients: of a law, by their columns."""
    with tempfile.TemporaryDirectory() as folder:
        table, law = pathlib.Path(folder, "heights"), pathlib.Path(folder, "law")
        table.write_text("x[m]\th[m]\n" + "".join(f"{x!r}\t{h!r}\n" for x, h in heights))
        law.write_text("\t".join(coefficients) + "\n" + "\t".join(map(repr, coefficients.values())) + "\n")
        rows, _, refused = run(["--height", str(table), "--law", str(law), "--report", *options])
    for _, tolerance, v, stop, _, seconds in rows:
        print(f"{name}, tolerance {tolerance}\t{float(v):.1e}\t{float(stop):.1e}\t{float(seconds):.1e}\t{refused}", flush=True)


def main():
    short = len(sys.argv) > 1
    print("# scene\tv\tstop\tseconds\trefusal")
    rubber = (1.87e-3, 0.215)
    for L in [1e-3] if short else [10.0**-k for k in range(3, 16, 2)]:
        row(f"memory of {L:g} m", *rubber, 0.5, more=("--memory", repr(L)))
    for b in [0.0, 1.0] if short else [-0.5, -1e-9, 0, 1e-300, 1e-9, 1 - 1e-9, 1, 1 + 1e-9, 2 - 1e-9, 2, 2 + 1e-9, 50]:
        row(f"b = {b:.10g}", 1e-3, b, 0.5 if b < 10 else 1.0, stops=b < 0.9)
    for exponent in [-300] if short else [-300, -150, -30, -3, 3, 30, 70]:
        v0 = float(mpf(10) ** exponent)
        row(f"v0 = 1e{exponent}, D(v0) = 1 mm", float(1e-3 * mpf(v0) ** -mpf(0.1)), 0.1, v0)
    for below in [1e-3] if short else [1e-3, 1e-6, 1e-9, 1e-12]:
        row(f"D(v0) = R (1 - {below:g}), exact", mpf(0.04) * (1 - mpf(below)), 0.3, 1.0, exact=True)
    for off in [1e-3] if short else [1e-3, 1e-6, 1e-9]:
        row(f"slope within {off:g} of balance", 1e-3, 0.0, 0.5, slope=float(mpf("-0.025") * (1 - mpf(off))))
    # D(0) = R S holds the body, one ulp more does not.
    ulp = 0.025 * (1 + 2.0**-52)
    for name, S in [("held", 0.025), ("not held by an ulp", ulp)]:
        rows, seconds, refused = run(["-K", "0.5", "-R", "0.04", "-a", "1e-3", "-b", "0", "--v0", "0.5", "--slope",
                                      repr(S), "--until", "1000", "--dt", "1000", "--columns", "v"])
        print(f"turning point, {name}: v = {float(rows[-1][0]):.1e} m/s\t\t\t{seconds:.2f}\t{refused}")
    road("hills", [(x, math.sin(2 * math.pi * x / 800)) for x in range(-60, 2500, 10)],
         {"d0[m]": 3.058103975535168e-3, "d2[s^2/m]": 8.154943934760448e-6},
         ["-K", "0.04", "-R", "0.3", "--v0", "33", "--until", "100"])
    road("bowl", [(i / 100, 1.14 * math.sin(i / 114) ** 2) for i in range(-30, 31)],
         {"d0[m]": 2.54e-5}, ["-K", "0.4", "-R", "0.0127", "--v0", "0", "--x0", "0.15", "--until", "9"])
    if not short:
        timed("1e7 rows", ["-K", "0.5", "-R", "0.04", "-a", "1e-9", "-b", "0", "--v0", "0.5", "--until", "1e5", "--dt", "0.01",
                           "--columns", "v"])
    timed("t = 1e9 s, steps of 1e-6 s", ["-K", "0.5", "-R", "0.04", "-a", "1e-3", "-b", "0", "--v0", "0.5", "--t0", "1e9", "--dt", "1e-6",
                                         "--until", "1000000000.0001"])


main()
