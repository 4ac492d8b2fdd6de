#!/usr/bin/env python3
"""Writes studies/data/regimes.csv: the regimes of the atlas of stability and, for each, the closed form
with 60 digits, from exactly the numbers that the programs get. Needs mpmath; run from the root of the
repository.

Kinds of input:  b     the observer at infinity, impact parameter b
                 edge  a static observer at r, edge coordinate x = 1 - gap
                 view  a static observer at r, view angle theta from the hole
"""
import math
from mpmath import mp, mpf, acos, asin, atan, cos, elliprf, pi, quad, sin, sqrt, tan, inf

mp.dps = 60
B_CRIT = 3 * sqrt(mpf(3)) / 2
NEXT, BEFORE = math.inf, -math.inf


def roots(b):
    """The roots of u^3 - u^2 + 1/b^2, complex ones included, by ascending real part."""
    alpha = acos(1 - 27 / (2 * b * b))
    return [(1 + 2 * cos((alpha + 2 * pi * k) / 3)) / 3 for k in (1, 2, 0)]


def angle(b, low, high):
    """Integral of du / sqrt(u^3 - u^2 + 1/b^2): Carlson's R_F, DLMF 19.29.4."""
    factors = [(sqrt(s * (high - a)), sqrt(s * (low - a))) for s, a in zip((1, -1, -1), roots(b))]

    def u(i, j, k):
        (xi, yi), (xj, yj), (xk, yk) = factors[i], factors[j], factors[k]
        return ((xi * xj * yk + yi * yj * xk) / (high - low)) ** 2

    return (2 * elliprf(u(0, 1, 2), u(0, 2, 1), u(1, 2, 0))).real


def escaping(b, u0, inwards, theta):
    """The bending of a ray that escapes."""
    phi = angle(b, mpf(0), u0) if u0 > 0 else mpf(0)
    if inwards:
        apsis = roots(b)[1].real
        phi = 2 * angle(b, mpf(0), apsis) - phi
    return phi - pi + theta


def from_b(b):
    b = mpf(b)
    return escaping(b, mpf(0), True, mpf(0)) if b > B_CRIT else None


def edge_angle(u):
    # The sine is 1 at the photon sphere; rounding must not carry it beyond.
    angle = asin(min(mpf(1), B_CRIT * u * sqrt(1 - u)))
    return angle if u < mpf(2) / 3 else pi - angle


def from_view_angle(u, theta):
    if theta <= edge_angle(u):
        return None
    b = sin(theta) / (u * sqrt(1 - u))
    return escaping(b, u, theta < pi / 2, theta)


def from_edge(r, gap):
    x = 1 - mpf(gap)
    if gap <= 0:
        return None
    if r == math.inf:
        return escaping(B_CRIT / x, mpf(0), True, mpf(0))
    u = 1 / mpf(r)
    return from_view_angle(u, 2 * atan(tan(edge_angle(u) / 2) / x))


def from_view(r, theta):
    return from_view_angle(1 / mpf(r), mpf(theta))


def check():
    """The closed form against quadrature of the integral itself, for each path a ray can take."""
    for b, u0, inwards in [(3, 0, True), (4, 0.1, True), (3, 0.2, False), (2, 0.5, False), (2.5, 0.9, False)]:
        b, u0 = mpf(b), mpf(u0)
        rate = lambda u: 1 / sqrt(1 / b**2 - u * u + u**3)
        apsis = roots(b)[1].real if inwards else None
        turning = lambda low: 2 * quad(lambda t: t * rate(apsis - t * t), [0, sqrt(apsis - low)])
        phi = turning(mpf(0)) + turning(u0) if inwards else quad(rate, [0, u0])
        assert abs(phi - pi - escaping(b, u0, inwards, mpf(0))) < mpf(10) ** -25, (b, u0)


def regimes():
    """(group, name, kind, first number, second number, whether there is such a ray)"""
    ulp24, ulp53 = 2.0**-24, 2.0**-53
    b_crit = float(B_CRIT)
    decades = [float(f"1e-{n}") for n in range(1, 16)]
    for gap in sorted([*decades, ulp24, ulp53], reverse=True):
        note = {ulp24: ", last f32", ulp53: ", last f64"}.get(gap, "")
        yield "outside the edge, r = ∞", f"1 − x = {gap:.0e}{note}", "edge", math.inf, gap, True
    for gap in sorted([*decades, ulp24, ulp53], reverse=True):
        note = {ulp24: ", first f32", ulp53: ", first f64"}.get(gap, "")
        yield "inside the edge, r = ∞", f"x − 1 = {gap:.0e}{note}", "edge", math.inf, -gap, True
    for name, b in (
        ("b_c less one ulp", math.nextafter(b_crit, BEFORE)),
        ("b_c, the nearest f64", b_crit),
        ("b_c and one ulp more", math.nextafter(b_crit, NEXT)),
        ("b_c and one f32 ulp more", b_crit + 2.0**-22),
    ):
        yield "b from infinity", name, "b", b, 0.0, True
    for b in (5e-324, 1e-8, 1e-4, 1.0, 2.5, 2.7, 10.0, 1e2, 1e4, 1e6, 1e8):
        yield "b from infinity", f"b = {b:g}" + (", denormal" if b < 1e-300 else ""), "b", b, 0.0, True
    for name, theta in (
        ("θ = 0", 0.0),
        ("θ one ulp from 0", 5e-324),
        ("θ = 30°", math.radians(30)),
        ("θ = 90°", math.radians(90)),
        ("θ = 150°, outward", math.radians(150)),
        ("θ one ulp from π", math.nextafter(math.pi, 0)),
        ("θ = π", math.pi),
    ):
        yield "views from r = 10", name, "view", 10.0, theta, True
    for r, gap in (
        (1e15, 0.5), (1e8, 0.5), (1e8, 1e-10), (2.0, 1e-12),
        (1.5 + 2.0**-52, 1e-8), (1.5, 0.5), (1.5, 1e-8), (1.5, 1e-15), (1.5 - 2.0**-52, 1e-8), (1.5 + 1e-6, 1e-8),
        (1.1, 0.5), (1.1, 1e-12), (1.000001, 0.5), (1 + 2.0**-52, 0.5),
    ):
        near = {1.5 + 2.0**-52: "3/2 and one ulp", 1.5 - 2.0**-52: "3/2 less one ulp", 1.5: "3/2",
                1 + 2.0**-52: "1 and one ulp", 1.5 + 1e-6: "3/2 + 1e-6"}.get(r, f"{r:.7g}".replace("e+", "e"))
        yield "observers", f"r = {near}, 1 − x = {gap:g}", "edge", r, gap, True
    for r, degrees in ((2.0, 120.0), (1.2, 150.0)):
        yield "observers", f"r = {r:g}, θ = {degrees:g}°, outward", "view", r, math.radians(degrees), True
    for name, b in (("b = 0", 0.0), ("b = −1", -1.0), ("b = NaN", math.nan), ("b = ∞", math.inf)):
        yield "no ray at all", name, "b", b, 0.0, False
    for name, r, theta in (
        ("r = 1", 1.0, 1.0), ("r = 1/2", 0.5, 1.0), ("r = NaN", math.nan, 1.0),
        ("θ = NaN", 10.0, math.nan), ("θ = −0.1", 10.0, -0.1), ("θ = 3.2", 10.0, 3.2), ("θ = ∞", 10.0, math.inf),
    ):
        yield "no ray at all", name, "view", r, theta, False


def truth(kind, first, second, exists):
    if not exists:
        return "none"
    bend = {"b": lambda: from_b(first), "edge": lambda: from_edge(first, second),
            "view": lambda: from_view(first, second)}[kind]()
    return "captured" if bend is None else mp.nstr(bend, 40, min_fixed=-60, max_fixed=60)


check()
with open("studies/data/regimes.csv", "w", encoding="utf-8") as out:
    out.write("group;name;kind;first;second;truth\n")
    for group, name, kind, first, second, exists in regimes():
        out.write(f"{group};{name};{kind};{first!r};{second!r};{truth(kind, first, second, exists)}\n")
