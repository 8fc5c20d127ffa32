#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes rolls.tsv, a table of rolls for whoever wants to test a program of rolling motion:

    python3 rolls.py >rolls.tsv        (mpmath, 60 digits; a few minutes)

The motion is dv/dt = -f(v), f(v) = g (D(v) cos(theta) + A R sin(theta)) / ((K + A) R), where
S = tan(theta) and A is 1 or sqrt(1 - D^2/R^2). So time and way from v0 to v are integrals of 1/f
and u/f over speed u, their derivatives by a number p those of -f_p/f^2 and -u f_p/f^2, and at a
fixed time dv/dp = f dt/dp and dx/dp is that at a fixed speed, less v dt/dp. A body that comes to
rest where the shift does not hold it, A R sin(theta) > D(0) cos(theta), rolls back, with D against
the motion. All integrals are by quadrature, whose estimate of its error has to be below 1e-32.
"""
import sys
from functools import lru_cache
from multiprocessing import Pool

from mpmath import atan, cos, exp, log, mp, mpf, nstr, quad, sin, sqrt

mp.dps = 60
DIGITS = 25
ENOUGH = mpf(10) ** -32


def bisect(f, p, q):
    for _ in range(220):
        middle = (p + q) / 2
        p, q = (middle, q) if f(p) * f(middle) > 0 else (p, middle)
    return (p + q) / 2


class PowerLaw:
    def __init__(self, a, b):
        self.a, self.b = mpf(a), mpf(b)
        self.columns = [repr(a), repr(b), "-"]
        self.parameters = ["a", "b"]
        self.knots = []
        self.at_rest = mpf(0) if b > 0 else self.a if b == 0 else mp.inf

    def shift(self, u):
        """D and its derivatives by the parameters."""
        D = self.a * u**self.b
        return D, [D / self.a, D * log(u)]


class Table:
    """Cubics with the slopes of Steffen (1990), at the ends those of the lines to the next points;
    constant below the first point."""

    def __init__(self, *points):
        self.v, self.D = [mpf(v) for v, _ in points], [mpf(D) for _, D in points]
        self.columns = ["-", "-", ",".join(f"{v!r}:{D!r}" for v, D in points)]
        self.parameters = []
        self.knots = self.v
        self.at_rest = self.D[0]
        n = len(points) - 1
        self.h = [self.v[i + 1] - self.v[i] for i in range(n)]
        self.s = [(self.D[i + 1] - self.D[i]) / self.h[i] for i in range(n)]
        self.slope = [self.s[0]] + [self.steffen(i) for i in range(1, n)] + [self.s[-1]]

    def steffen(self, i):
        h, s = self.h[i - 1 : i + 1], self.s[i - 1 : i + 1]
        p = (s[0] * h[1] + s[1] * h[0]) / (h[0] + h[1])
        sign = [1 if q > 0 else -1 if q < 0 else 0 for q in s]
        return (sign[0] + sign[1]) * min(abs(s[0]), abs(s[1]), abs(p) / 2)

    def shift(self, u):
        if u <= self.v[0]:
            return self.D[0], []
        i = max(j for j in range(len(self.h)) if u >= self.v[j])
        z, h = u - self.v[i], self.h[i]
        cubic = (self.slope[i] + self.slope[i + 1] - 2 * self.s[i]) / h**2
        square = (3 * self.s[i] - 2 * self.slope[i] - self.slope[i + 1]) / h
        return ((cubic * z + square) * z + self.slope[i]) * z + self.D[i], []


class Roll:
    def __init__(self, kind, law, v0=0.5, S=0.0, exact=False, K=0.5, R=0.04, g=9.81):
        self.kind, self.law, self.exact = kind, law, exact
        self.columns = [kind, "exact" if exact else "1"]
        self.columns += [repr(x) for x in (K, R, g, S)] + law.columns + [repr(v0)]
        self.K, self.R, self.g, self.S, self.v0 = map(mpf, (K, R, g, S, v0))
        self.parameters = law.parameters + ["v0", "S"]
        self.ahead = lru_cache(None)(lambda u: self.deceleration(u, 1))
        self.back = lru_cache(None)(lambda w: self.deceleration(w, -1))

    def deceleration(self, u, direction):
        """f and its derivatives by the law's parameters and by S; direction -1: rolling back."""
        D, slopes = self.law.shift(u)
        R, K, S = self.R, self.K, self.S
        c, s = 1 / sqrt(1 + S**2), S / sqrt(1 + S**2)
        A = sqrt(1 - (D / R) ** 2) if self.exact else mpf(1)
        A_D = -D / (R**2 * A) if self.exact else mpf(0)
        unit = self.g / ((K + A) * R)
        f = unit * (direction * D * c + A * R * s)
        f_D = unit * (direction * c + A_D * R * s) - f * A_D / (K + A)
        f_S = unit * (-direction * D * S + A * R) * c**3
        return f, [f_D * q for q in slopes] + [f_S]

    def integrals(self, rate, low, high, only_time=False):
        """Over speeds from low to high, of 1/f and u/f, then, for each parameter of the law and
        for S, of -f_p/f^2 and -u f_p/f^2."""
        b = getattr(self.law, "b", mpf(0))
        ends = [low] + [k for k in self.law.knots if low < k < high] + [high]
        if low == 0:  # u = y^power takes the singularity of u^-b away
            power = 1 / (1 - b) if self.S == 0 and 0 < b < 1 else mpf(1)
            points = [e ** (1 / power) for e in ends]
            speed, stretch = lambda y: y**power, lambda y: power * y ** (power - 1)
        else:  # u = e^y, in pieces
            points, speed, stretch = [log(ends[0])], exp, exp
            for e in ends[1:]:
                step = log(e) - points[-1]
                n = int(step / 2) + 1
                points += [points[-1] + step * i / n for i in range(1, n)] + [log(e)]

        @lru_cache(None)
        def node(y):
            return (stretch(y), speed(y), *rate(speed(y)))

        def integral(weight):
            def integrand(y):
                du, u, f, f_p = node(y)
                return du * weight(u, f, f_p)

            # mpmath's quad has an absolute tolerance: it gets integrals of about 1
            middles = [(p + q) / 2 for p, q in zip(points, points[1:])]
            unit = max(abs(integrand(y)) for y in middles) * (points[-1] - points[0])
            for method in ("tanh-sinh",) if low == 0 else ("gauss-legendre", "tanh-sinh"):
                value, error = quad(
                    lambda y: integrand(y) / unit, points, error=True, method=method
                )
                if error <= ENOUGH * abs(value):
                    return value * unit
            sys.exit(f"{self.columns}: error {nstr(error, 3)} of {nstr(value, 5)}")

        if only_time:
            return [integral(lambda u, f, f_p: 1 / f)]
        both = [integral(lambda u, f, f_p: 1 / f), integral(lambda u, f, f_p: u / f)]
        for i in range(len(self.law.parameters) + 1):
            infinite = low == 0 and self.S == 0 and i == len(self.law.parameters) and 2 * b >= 1
            both.append(mp.inf if infinite else integral(lambda u, f, f_p: -f_p[i] / f**2))
            both.append(integral(lambda u, f, f_p: -u * f_p[i] / f**2))
        return both

    def advance(self, state, rate, start, end, **only):
        """Time, way and their slopes at the speed end, from those at the speed start."""
        part = self.integrals(rate, min(start, end), max(start, end), **only)
        t_sign = -1 if rate is self.ahead and end > start else 1
        x_sign = -1 if rate is self.back else t_sign
        return [s + (x_sign if i % 2 else t_sign) * p for i, (s, p) in enumerate(zip(state, part))]

    def speed_at(self, toward, rate, u, t):
        """The speed at the time toward, from the speed u of the time t near it: Newton's method."""
        sign = 1 if rate is self.ahead else -1
        for _ in range(12):
            step = -sign * rate(u)[0] * (toward - t)
            if abs(step) < u * mpf(10) ** -50:
                return u + step
            t += sign * quad(lambda q: 1 / rate(q)[0], [u + step, u])
            u += step
        sys.exit(f"{self.columns}: no speed at {toward}")

    def line(self, t, v, x, dv, dx, stop):
        def number(q):
            if q is None:
                return "-"
            return nstr(q, DIGITS, strip_zeros=not q, min_fixed=-4, max_fixed=6)

        names = ("a", "b", "v0", "S")
        slopes = [number(d.get(p)) for d in (dv, dx) for p in names]
        ends = [number(q) for q in stop or (None, None)]
        return "\t".join(self.columns + [repr(t), number(v), number(x)] + slopes + ends)

    def instants(self, rate, state, start, speeds, stop):
        """Lines at about these speeds, whose times are put to six digits, or twelve close to the
        turn; the state at the last."""
        lines = []
        f0 = self.ahead(self.v0)[0]
        for about in speeds:
            t_about = self.advance(state, rate, start, about, only_time=True)[0]
            t = float(nstr(t_about, 6 if rate is self.ahead else 12))
            u = self.speed_at(mpf(t), rate, about, t_about)
            state, start = self.advance(state, rate, start, u), u
            t_p = dict(zip(self.law.parameters + ["S"], state[2::2]), v0=1 / f0)
            x_p = dict(zip(self.law.parameters + ["S"], state[3::2]), v0=self.v0 / f0)
            v = -u if rate is self.back else u
            dv = {p: rate(u)[0] * q for p, q in t_p.items()}
            dx = {p: x_p[p] - v * q for p, q in t_p.items()}
            lines.append(self.line(t, v, state[1], dv, dx, stop))
        return lines, state, start

    def lines(self, ratios=(0.999, 0.8, 0.3, 0.01), back=(0.01, 0.3, 0.8), stops=True):
        """At these ratios of the speed to v0 (or, where the body tends to a speed, of the distance
        from that), then at rest or at these ratios on the way back; not so far without stops."""
        zero = [mpf(0)] * (4 + 2 * len(self.law.parameters))
        limit = self.limit(self.ahead)
        if limit is not None:
            speeds = [limit + (self.v0 - limit) * mpf(r) for r in ratios]
        elif self.ahead(self.v0)[0] < 0:
            speeds = [self.v0 / mpf(r) for r in ratios]
        else:
            speeds = [self.v0 * mpf(r) for r in ratios]
        if limit is not None or self.ahead(self.v0)[0] < 0 or getattr(self.law, "b", 0) >= 1:
            stops = False
        stop = None
        if stops:
            end = self.advance(zero, self.ahead, self.v0, mpf(0))
            stop = end[:2]
        result, _, _ = self.instants(self.ahead, zero, self.v0, speeds, stop)
        if not stops:
            return result
        angle = atan(self.S)
        if sin(angle) * self.R <= self.law.at_rest * cos(angle):  # it stays
            t = float(nstr(stop[0] * mpf(1.25), 4))
            names = self.law.parameters + ["S"]
            x_p = dict(zip(names, end[3::2]), v0=self.v0 / self.ahead(self.v0)[0])
            if self.law.at_rest == 0:  # on a slope, however small, it would roll back
                del x_p["S"]
            return result + [self.line(t, mpf(0), stop[1], dict.fromkeys(x_p, mpf(0)), x_p, stop)]
        if self.back(self.v0 * mpf("1e-6"))[0] <= 0:  # a way back so slow counts as rest
            return result
        limit = self.limit(self.back)
        top = self.v0 if limit is None else min(limit, self.v0)
        more, _, _ = self.instants(self.back, end, mpf(0), [top * mpf(r) for r in back], stop)
        return result + [line.replace(self.kind, "back", 1) for line in more]

    def limit(self, rate):
        """The speed at which forces balance, below v0 if the body slows down there, or above; None
        without one."""
        ratios = [mpf(10) ** (mpf(k) / 8) for k in range(1, 240)]
        slows = rate is self.ahead and rate(self.v0)[0] > 0
        speeds = [self.v0 / r if slows else self.v0 * r for r in ratios]
        if rate is self.back:
            speeds = [self.v0 * mpf(10) ** (mpf(k) / 8 - 12) for k in range(1, 200)]
        if isinstance(self.law, Table):
            return None
        last = self.v0 if rate is self.ahead else speeds[0]
        for u in speeds:
            if self.exact and self.law.shift(u)[0] >= self.R:
                return None
            if rate(u)[0] * rate(last)[0] < 0:
                return bisect(lambda q: rate(q)[0], last, u)
            last = u
        return None


NAMES = "kind A K R[m] g[m/s^2] S a b table v0[m/s] t[s] v[m/s] x[m]".split()
NAMES += [f"d{q}/d{p}" for q in "vx" for p in ("a", "b", "v0", "S")] + ["t_stop[s]", "x_stop[m]"]


def all_rolls():
    CR, SR, F = (1.87e-3, 0.215), (1.78e-3, 0.255), (5.75e-4, 0.0244)
    tiny = 2.0**-50
    deep = (0.999, 0.9, 0.7)
    for exact in (False, True):
        kind = "exact" if exact else "closed"
        for law, K in ((CR, 0.5), (SR, 0.83), (F, 0.5), (F, 0.83)):
            yield Roll(kind, PowerLaw(*law), exact=exact, K=K)
        for b in (0.0, 0.5, 0.9, 1.0, 1.5, 2.0, 3.0):
            yield Roll(kind, PowerLaw(2e-3, b), exact=exact)
        for b in (1 - tiny, 1 + tiny, 2 - 2 * tiny, 2 + 2 * tiny):
            name = "through 1" if b < 1.5 else kind
            yield Roll(name, PowerLaw(2e-3, b), exact=exact), {"stops": False}
        yield Roll(kind, PowerLaw(1e-3, -0.1), exact=exact), {"stops": not exact, "ratios": deep}
        yield Roll(kind, PowerLaw(1e-3, -0.5), exact=exact), {"stops": not exact, "ratios": deep}
        yield Roll(kind, PowerLaw(*CR), v0=5.0, exact=exact, K=0.0)
        yield Roll(kind, PowerLaw(*CR), v0=0.03, exact=exact, K=1.0, R=0.01)
        for v0, a in ((1e-9, 1e-3), (1e-9, 1e-12), (1e6, 1e-12), (1e-100, 1e-3)):
            yield Roll("small and large", PowerLaw(a, 0.3), v0=v0, exact=exact)
        yield Roll("small and large", PowerLaw(1e-3, 0.3), v0=30.0, R=1e3, g=1.62, exact=exact)
        yield Roll("small and large", PowerLaw(1e-9, 0.3), v0=1e-3, R=1e-6, exact=exact)
    for b in (0.0, 0.1, 0.5, 1.5):
        for depth in (0.9, 0.99, 0.999999):
            law = PowerLaw(float(depth * 0.04 * 0.5**-b), b)
            yield Roll("D near R", law, exact=True)
    ratios = (0.999, 0.8, 0.51)  # D is R at half the speed
    yield Roll("D near R", PowerLaw(0.02, -0.5), exact=True), {"stops": False, "ratios": ratios}
    for exact in (False, True):
        up = ((F, 1e-3), (CR, 1e-3), (CR, 5e-3), (CR, 0.1))
        for law, S in up + (((1e-3, 1.0), 0.02), ((1e-3, 2.0), 0.02)):
            yield Roll("slope", PowerLaw(*law), S=S, exact=exact), {"stops": law[1] < 1}
        ratios = (0.999, 0.5, 0.01, 1e-5)
        for law, S in ((F, -1e-3), (CR, -5e-3), (CR, -2e-2), ((1e-3, 1.0), -0.01)):
            yield Roll("slope", PowerLaw(*law), S=S, exact=exact), {"ratios": ratios}
        yield Roll("slope", PowerLaw(2e-3, 0.0), S=0.04, exact=exact)  # what holds it
        yield Roll("slope", PowerLaw(2e-3, 0.0), S=-0.04, exact=exact)
        yield Roll("turning", PowerLaw(5e-5, 0.1), S=0.02, K=0.4, R=0.0127, exact=exact)
        yield Roll("turning", PowerLaw(2e-3, 0.0), S=0.06, exact=exact)
        yield Roll("turning", PowerLaw(*SR), S=0.3, K=0.83, v0=1.5, exact=exact)
        yield Roll("turning", PowerLaw(*F), S=0.05, K=0.0, v0=1e-3, exact=exact)
        yield Roll("speeds up", PowerLaw(*CR), S=-0.1, exact=exact), {"ratios": (0.999, 0.8, 0.3)}
        yield Roll("speeds up", PowerLaw(1e-3, 0.0), S=-0.05, exact=exact)
        yield Roll("speeds up", PowerLaw(1e-3, 1.0), S=-0.02, K=0.83, exact=exact)
        yield Roll("speeds up", PowerLaw(1e-3, -0.3), S=-0.2, exact=exact)
        speeds = (0.05, 0.1, 0.2, 0.3, 0.5, 0.7)
        shifts = (9e-4, 1.1e-3, 1.3e-3, 1.2e-3, 1.7e-3, 1.9e-3)
        points = Table(*zip(speeds, shifts))
        deep_points = Table((0.1, 0.02), (0.3, 0.03), (0.6, 0.039))
        yield Roll("table", points, exact=exact)
        yield Roll("table", deep_points, exact=exact)
        yield Roll("table", points, S=0.01, exact=exact)
        yield Roll("table", points, S=-0.01, exact=exact)
        yield Roll("turning", points, S=0.1, exact=exact), {"back": (0.05, 0.3, 1.2)}


def lines_of(i):
    roll = list(all_rolls())[i]
    roll, options = roll if isinstance(roll, tuple) else (roll, {})
    return roll.lines(**options)


def main():
    print("\t".join(NAMES))
    with Pool() as pool:
        for lines in pool.imap(lines_of, range(len(list(all_rolls())))):
            print("\n".join(lines), flush=True)


if __name__ == "__main__":
    main()
