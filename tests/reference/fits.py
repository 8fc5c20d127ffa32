#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes fits/*.dat, certified fits of rolling motion, in the form of the files of NIST's StRD:

    python3 fits.py fits        (mpmath, faster with gmpy2; some minutes)

Each record is a simulated roll with white noise, drawn with a seed. The certified values are the
minimum of the sum of squares for the numbers in the file, found with 45 digits by Gauss-Newton
steps and central differences. The file says what the last step still changed, relative to each
number. The motion is that of rolls.py: a closed form if there is one, else quadrature over speed.
"""
import os
import random
import sys
from multiprocessing import Pool

from mpmath import atan, cos, exp, log, lu_solve, matrix, mp, mpf, nstr, quad, sin, sqrt, tan

mp.dps = 45
G = mpf("9.81")


class Roll:
    """A run: x and v at times after its first row, from the numbers of the law, v0 and x0."""

    def __init__(self, K, R, law="power", exact=False, slope=0, way=1):
        self.K, self.R, self.law, self.exact = mpf(K), mpf(R), law, exact
        self.slope, self.way = mpf(slope), way

    def D(self, p, v):
        return p[0] * v ** p[1] if v > 0 else (p[0] if p[1] == 0 else mpf(0))

    def slowing(self, p, slope, v, back=False):
        """-dv/dt on the way on, dv/dt on the way back from a turn."""
        theta = atan(slope * self.way)
        D = self.D(p, v)
        A = sqrt(1 - (D / self.R) ** 2) if self.exact else 1
        along = A * self.R * sin(theta)
        force = along - D * cos(theta) if back else along + D * cos(theta)
        return G * force / ((self.K + A) * self.R)

    def at(self, p, slope, v0, x0, times):
        """[(x, v)], in the direction of growing x."""
        if v0 <= 0:
            raise ValueError("v0 <= 0")
        if self.law == "power" and not self.exact and slope == 0:
            points = self.closed(p, v0, times)
        elif self.law == "power":
            points = self.by_quadrature(p, slope, v0, times)
        else:
            points = self.other(p, v0, times)
        return [(x0 + self.way * x, self.way * v) for x, v in points]

    def c(self):
        return G / ((self.K + 1) * self.R)

    def closed(self, p, v0, times):  # Eq. 13
        a, b = p
        points = []
        for t in times:
            left = v0 ** (1 - b) - (1 - b) * a * self.c() * t
            stopped = left <= 0 and b < 1
            v = mpf(0) if stopped else left ** (1 / (1 - b))
            points.append(((v0 ** (2 - b) - v ** (2 - b)) / ((2 - b) * a * self.c()), v))
        return points

    def other(self, p, v0, times):
        c = self.c()
        points = []
        for t in times:
            if self.law == "d0+d1*v":
                d0, d1 = p
                end = d0 / d1
                v = (v0 + end) * exp(-c * d1 * t) - end
                points.append(((v0 - v) / (c * d1) - end * t, v))
            else:  # d0+d2*v^2
                d0, d2 = p
                first = atan(v0 * sqrt(d2 / d0))
                angle = first - c * sqrt(d0 * d2) * t
                points.append((log(cos(angle) / cos(first)) / (c * d2), sqrt(d0 / d2) * tan(angle)))
        return points

    def by_quadrature(self, p, slope, v0, times):
        points, t, x, v, back = [], mpf(0), mpf(0), v0, False

        def way_and_time(low, high):
            def inverse(u):
                return 1 / self.slowing(p, slope, u, back)
            return quad(inverse, [low, high]), quad(lambda u: u * inverse(u), [low, high])

        for end in times:
            if not back:
                time, way = way_and_time(mpf(0), v)
                if t + time <= end:
                    t, x, v, back = t + time, x + way, mpf(0), True
            rest = end - t
            if rest > 0:
                sign = 1 if back else -1
                u = v + sign * rest * self.slowing(p, slope, v, back)
                u = u if u > 0 else v / 2
                for _ in range(60):
                    time, way = way_and_time(min(u, v), max(u, v))
                    step = sign * (rest - time) * self.slowing(p, slope, u, back)
                    u = u + step if u + step > 0 else u / 2
                    if abs(step) < mpf(10) ** -24 * u:
                        break
                time, way = way_and_time(min(u, v), max(u, v))
                t, x, v = end, x + (-way if back else way), u
            points.append((x, -v if back else v))
        return points


def residuals(case, theta):
    """Of all runs; theta is the law, then the slope if it is fitted, then v0 and x0 of each run."""
    laws, at = theta[:2], 2
    slope = mpf(case["slope"])
    if case["fits_slope"]:
        slope, at = theta[2], 3
    out = []
    for roll, times, y in zip(case["rolls"], case["t"], case["y"]):
        own = 2 if case["route"] == "position" else 1
        x0 = theta[at + 1] if own == 2 else mpf(0)
        points = roll.at(laws, slope, theta[at], x0, [t - times[0] for t in times])
        at += own
        out += [b - (x if case["route"] == "position" else v) for b, (x, v) in zip(y, points)]
    return out


def certify(case):
    theta = [mpf(z) for z in case["truth"]]
    n, p = sum(len(t) for t in case["t"]), len(theta)
    for _ in range(200):
        r = residuals(case, theta)
        J = matrix(n, p)
        for k in range(p):
            h = mpf(10) ** -13 * max(abs(theta[k]), mpf("1e-3"))
            up, down = list(theta), list(theta)
            up[k] += h
            down[k] -= h
            for i, (a, b) in enumerate(zip(residuals(case, up), residuals(case, down))):
                J[i, k] = (b - a) / (2 * h)
        N = J.T * J
        step = lu_solve(N, J.T * matrix(r))
        theta = [z + s for z, s in zip(theta, step)]
        left = max(abs(s / z) for s, z in zip(step, theta))
        if left < mpf(10) ** -20:
            break
    else:
        raise ValueError(case["name"] + " does not converge")
    rss = sum(z * z for z in residuals(case, theta))
    inverse = N ** -1
    y = [z for run in case["y"] for z in run]
    gain = inverse * J.T  # d theta / d y
    condition = [sqrt(sum((gain[k, i] * y[i]) ** 2 for i in range(n))) / abs(theta[k])
                 for k in range(p)]
    sigma = [sqrt(inverse[k, k] * rss / (n - p)) for k in range(p)]
    corr = inverse[0, 1] / sqrt(inverse[0, 0] * inverse[1, 1])
    return theta, sigma, corr, rss, n, p, condition, left


MODEL = {
    ("power", "position"): "y = b4 + (b3**(2-b2) - (b3**(1-b2)-(1-b2)*b1*c*x)**((2-b2)/(1-b2)))"
                           " / ((2-b2)*b1*c)  +  e",
    ("power", "velocity"): "y = (b3**(1-b2) - (1-b2)*b1*c*x)**(1/(1-b2))  +  e",
    ("d0+d1*v", "velocity"): "y = (b3+b1/b2)*exp(-c*b2*x) - b1/b2  +  e",
}


def write(case, folder):
    theta, sigma, corr, rss, n, p, condition, left = certify(case)
    roll = case["rolls"][0]
    names = case["names"]
    several = len(case["rolls"]) > 1
    closed = not (roll.exact or case["slope"] != "0" or case["fits_slope"] or several)
    model = MODEL.get((roll.law, case["route"]), None) if closed else None
    lines = [
        "Certified fits of rolling motion, in the form of NIST/ITL StRD",
        f"Dataset Name:  {case['name']}  ({case['name']}.dat)",
        "",
        "File Format:   ASCII",
        f"               Starting Values   (lines 41 to {40 + p})",
        f"               Certified Values  (lines 41 to {45 + p})",
        f"               Data              (lines 61 to {60 + n})",
        "",
        "Procedure:     Nonlinear Least Squares Regression",
        "",
        f"Description:   {case['says']}.",
        f"               Simulated, with white noise of {case['noise']} (seed {case['seed']}).",
        "               fits.py made this file.",
        f"Parameters:    {', '.join(names)}",
        f"Command:       fitpower {case['command']}",
        "",
        f"Data:          1 Response Variable  (y = {case['route']})",
        "               1 Predictor Variable (x = time)" +
        (", and the number of the run" if several else ""),
        f"               {n} Observations",
        f"               {case['level']} Level of Difficulty",
        "               Generated Data",
        "",
        f"Model:         {'Power' if roll.law == 'power' else 'Other'} Class",
        f"               {p} Parameters (b1 to b{p})",
        "",
        f"               {model or 'y = position or velocity of the body: README.md'}",
        *([f"               c = g/((K+1)*R) = {nstr(roll.c(), 20)}"] if model else []),
    ]
    lines += [""] * (38 - len(lines))
    lines += ["        Starting values                  Certified Values",
              "      Start 1     Start 2           Parameter     Standard Deviation"]
    for k in range(p):
        far, near = theta[k] * mpf("1.2"), theta[k] * mpf("1.03")
        lines.append(f"  b{k + 1} = {nstr(far, 3):>8}  {nstr(near, 4):>8}  {nstr(theta[k], 16):>24}"
                     f"  {nstr(sigma[k], 16):>22}")
    lines += ["", f"Residual Sum of Squares:      {nstr(rss, 16)}",
              f"Residual Standard Deviation:  {nstr(sqrt(rss / (n - p)), 16)}",
              f"Degrees of Freedom:           {n - p}", f"Number of Observations:       {n}",
              f"Correlation of b1 and b2:     {nstr(corr, 16)}",
              f"Condition of each parameter:  {' '.join(nstr(z, 3) for z in condition)}",
              f"Last step, relative:          {nstr(left, 2)}"]
    lines += [""] * (59 - len(lines))
    lines.append("Data:   y               x" + ("               run" if several else ""))
    for number, (times, y) in enumerate(zip(case["t"], case["y"]), 1):
        for t, z in zip(times, y):
            lines.append(f"{nstr(z, 17)}  {nstr(t, 17)}" + (f"  {number}" if several else ""))
    with open(os.path.join(folder, case["name"] + ".dat"), "w") as out:
        out.write("\n".join(lines) + "\n")
    return f"{case['name']} {nstr(left, 2)} {' '.join(nstr(z, 3) for z in condition)}"


def case(name, says, law, runs, n, dt, noise=3e-4, route="position", slope="0", fits_slope=False,
         level="Average", seed=1, start=0.0):
    """runs: (Roll, v0). A run has n rows every dt from the time `start`."""
    rolls = [roll for roll, _ in runs]
    first = rolls[0]
    truth = [mpf(z) for z in law] + ([mpf(slope)] if fits_slope else [])
    draw = random.Random(seed)
    times, ys = [], []
    for roll, v0 in runs:
        truth += [mpf(v0)] + ([mpf("0.3")] if route == "position" else [])
        at = [mpf(repr(round(start + i * dt, 6))) for i in range(n)]
        points = roll.at([mpf(z) for z in law], mpf(slope), mpf(v0),
                         mpf("0.3") if route == "position" else 0, [t - at[0] for t in at])
        values = [x if route == "position" else v for x, v in points]
        times.append(at)
        ys.append([mpf(repr(round(float(z) + draw.gauss(0, noise), 9))) for z in values])
    words = "a b" if first.law == "power" else first.law.replace("*v^2", "").replace("*v", "").replace("+", " ")
    names = words.split() + (["slope"] if fits_slope else [])
    for k in range(len(runs)):
        own = ["v0", "x0"] if route == "position" else ["v0"]
        names += own if len(runs) == 1 else [f"{z}_{k + 1}" for z in own]
    command = f"--route {route} -K {','.join(nstr(r.K, 6) for r in rolls)} -R {nstr(first.R, 6)}"
    command += " --exact" if first.exact else ""
    command += " --slope fit" if fits_slope else "" if slope == "0" else f" --slope {slope}"
    command += "" if first.law == "power" else f" --law {first.law}"
    unit = "m" if route == "position" else "m/s"
    return dict(name=name, says=says, rolls=rolls, t=times, y=ys, truth=truth, route=route,
                slope=slope, fits_slope=fits_slope, names=names, command=command, level=level,
                seed=seed, noise=f"{noise:g} {unit}")


def cases():
    """The seeds are of records whose residuals pass for white: fitpower gives others larger errors."""
    C, S, ball, car = ("0.5", "0.04"), ("0.83", "0.04"), ("0.4", "0.0127"), ("0.04", "0.3")
    rubber, shell, felt = ("1.87e-3", "0.215"), ("1.78e-3", "0.255"), ("5.75e-4", "0.0244")
    yield case("Rubber1", "Cylinder on rubber, positions", rubber, [(Roll(*C), "0.5")], 25, 0.09)
    yield case("Rubber2", "Shell on rubber, positions", shell, [(Roll(*S), "0.5")], 25, 0.12, seed=2)
    yield case("Felt1", "Cylinder on felt, positions", felt, [(Roll(*C), "0.5")], 28, 0.19, seed=3)
    yield case("Felt2", "Shell on felt, positions, from 1000 s on", felt, [(Roll(*S), "0.5")], 28,
               0.23, seed=4, start=1000.0)
    yield case("Speeds1", "Cylinder on rubber, speeds", rubber, [(Roll(*C), "0.5")], 25, 0.09,
               2e-3, "velocity", seed=5)
    yield case("Speeds2", "Shell on felt, speeds", felt, [(Roll(*S), "0.5")], 25, 0.25, 2e-3,
               "velocity", seed=6)
    yield case("Ten", "Ten positions", rubber, [(Roll(*C), "0.5")], 10, 0.24, level="Lower", seed=7)
    yield case("Negative", "An exponent below 0", ("1.2e-3", "-0.2"), [(Roll(*C), "0.5")], 25, 0.07,
               seed=8)
    yield case("Half", "An exponent of a half", ("3e-3", "0.5"), [(Roll(*C), "0.5")], 28, 0.09,
               seed=9)
    yield case("One", "An exponent next to 1", ("4e-3", "0.999"), [(Roll(*C), "0.5")], 28, 0.1,
               seed=10)
    yield case("Beyond", "An exponent above 1", ("5e-3", "1.4"), [(Roll(*C), "0.8")], 28, 0.1,
               seed=11)
    yield case("Square", "An exponent next to 2", ("6e-3", "2.02"), [(Roll(*C), "1.5")], 28, 0.1,
               seed=26)
    yield case("Short", "A tenth of a roll: nearly singular", rubber, [(Roll(*C), "0.5")], 29, 0.02,
               3e-6, level="Higher", seed=13)
    yield case("Valley", "A short roll with much noise: a curved valley", ("2e-3", "0.6"),
               [(Roll(*C), "0.5")], 29, 0.05, 3e-4, level="Higher", seed=14)
    yield case("Long", "A thousand positions", rubber, [(Roll(*C), "0.5")], 1000, 0.0023, seed=15)
    yield case("Longer", "Ten thousand positions", felt, [(Roll(*C), "0.5")], 10000, 0.00053,
               seed=25)
    yield case("Exact1", "The exact geometry, rubber", rubber, [(Roll(*C, exact=True), "0.5")], 20,
               0.11, seed=17)
    yield case("Exact2", "The exact geometry, D near a third of R", ("1.2e-2", "0.3"),
               [(Roll(*S, exact=True), "1")], 20, 0.02, seed=18)
    yield case("Uphill", "Felt that rises by 1 mm in a metre", felt, [(Roll(*C), "0.5")], 20, 0.24,
               slope="0.001", seed=19)
    yield case("Turn1", "A ball up an incline and back, the slope fitted", ("5e-5", "0.1"),
               [(Roll(*ball), "0.5")], 22, 0.25, slope="0.02", fits_slope=True, level="Higher",
               seed=20)
    yield case("Both", "Two rolls in opposite directions, the slope fitted", felt,
               [(Roll(*C), "0.5"), (Roll(*C, way=-1), "0.45")], 14, 0.33, slope="0.001",
               fits_slope=True, level="Higher", seed=21)
    yield case("Joint", "Cylinder and shell, one law", felt, [(Roll(*C), "0.5"), (Roll(*S), "0.4")],
               14, 0.36, seed=22)
    yield case("Linear", "The law d0 + d1 v, speeds", ("5e-4", "4e-4"),
               [(Roll(*C, law="d0+d1*v"), "0.5")], 25, 0.15, 2e-3, "velocity", seed=23)
    yield case("Car", "A coast-down, the law d0 + d2 v^2, speeds", ("3.06e-3", "8.15e-6"),
               [(Roll(*car, law="d0+d2*v^2"), "33")], 28, 4.0, 0.05, "velocity", seed=27)


def job(argument):
    return write(*argument)


if __name__ == "__main__":
    chosen = [c for c in cases() if len(sys.argv) < 3 or c["name"] in sys.argv[2:]]
    with Pool() as pool:
        for line in pool.imap(job, [(c, sys.argv[1]) for c in chosen]):
            print(line, flush=True)
