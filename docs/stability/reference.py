#!/usr/bin/env python3
"""Writes studies/data/regimes.csv: the regimes of the atlas of stability and, for each, the closed form
with 60 digits, from exactly the numbers that the programs get. Needs mpmath; run from the root of the
repository.

Kinds of input:  b     the observer at infinity, impact parameter b
                 edge  an observer at r, edge coordinate x = 1 - gap
                 view  an observer at r, view angle theta from the hole and azimuth from the motion

Motions, as bake understands them: rest, fall, orbit, or a velocity BR,BT relative to the observer at rest,
at the horizon and below to the one in free fall. The bending is theta minus the angle of the sky, in the
frame of the observer.
"""
import math
from mpmath import mp, mpf, acos, asin, atan, atan2, cos, elliprf, pi, quad, sin, sqrt, tan

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


def falling_edge_angle(u):
    """The shadow of the observer who has fallen from rest at infinity."""
    w = mpf(2) / 3 - u
    return 2 * atan((1 - B_CRIT * w * sqrt(1 - w)) / (B_CRIT * u * (1 + sqrt(u))))


def from_falling(u, theta):
    """As from_view_angle, for the observer who has fallen from rest at infinity. The frequency at infinity
    is 1 - sqrt(u) cos(theta) times his; cos(theta) > sqrt(u) is light that moves outwards."""
    energy = 1 - sqrt(u) * cos(theta)
    if energy <= 0:
        return None
    b = sin(theta) / (u * energy)
    outwards, far = cos(theta) > sqrt(u), u < mpf(2) / 3
    if not (far and b > B_CRIT if outwards else far or b < B_CRIT):
        return None
    return escaping(b, u, outwards, theta)


def velocity(r, motion):
    """The velocity (outwards, along the tangent) relative to the observer that from_base is for."""
    if motion == "orbit":
        return mpf(0), sqrt(1 / (2 * (mpf(r) - 1)))
    return tuple(mpf(float(part)) for part in motion.split(","))


def aberrated(theta, azimuth, radial, tangential):
    """The direction in which the observer sees the same light who moves at this velocity backwards."""
    speed = sqrt(radial**2 + tangential**2)
    ahead = (-radial / speed, tangential / speed, 0)
    n = (cos(theta), sin(theta) * cos(azimuth), sin(theta) * sin(azimuth))
    c = sum(i * j for i, j in zip(n, ahead))
    along, across = (c - speed) / (1 - speed * c), sqrt(1 - speed**2) / (1 - speed * c)
    n = [across * (i - c * j) + along * j for i, j in zip(n, ahead)]
    return atan2(sqrt(n[1] ** 2 + n[2] ** 2), n[0]), atan2(n[2], n[1])


def from_base(r, theta):
    u = 1 / mpf(r)
    return from_view_angle(u, theta) if u < 1 else from_falling(u, theta)


def from_edge(r, gap, motion):
    x = 1 - mpf(gap)
    if gap <= 0:
        return None
    if r == math.inf:
        return escaping(B_CRIT / x, mpf(0), True, mpf(0))
    u = 1 / mpf(r)
    if motion == "fall":
        return from_falling(u, 2 * atan(tan(falling_edge_angle(u) / 2) / x))
    return from_view_angle(u, 2 * atan(tan(edge_angle(u) / 2) / x))


def from_view(r, theta, azimuth, motion):
    theta = mpf(theta)
    if motion == "rest":
        return from_view_angle(1 / mpf(r), theta)
    if motion == "fall":
        return from_falling(1 / mpf(r), theta)
    base, _ = aberrated(theta, mpf(azimuth), *velocity(r, motion))
    bend = from_base(r, base)
    return None if bend is None else bend - base + theta


def view_at_edge(r, gap, motion):
    """The view angle, at azimuth 0, of the direction at 1 - x = gap on the side of the motion."""
    theta = 2 * atan(tan(edge_angle(1 / mpf(r)) / 2) / (1 - mpf(gap)))
    own, azimuth = aberrated(theta, mpf(0), *(-part for part in velocity(r, motion)))
    assert azimuth == 0
    return float(own)


def check():
    """The closed form against quadrature of the integral itself, for each path a ray can take; the shadow of
    the falling observer against b_c; and the fall against the boost that it is of the observer at rest."""
    for b, u0, inwards in [(3, 0, True), (4, 0.1, True), (3, 0.2, False), (2, 0.5, False), (2.5, 0.9, False),
                           (2, 2, False), (0.01, 30, False), (2.5, 100, False)]:
        b, u0 = mpf(b), mpf(u0)
        rate = lambda u: 1 / sqrt(1 / b**2 - u * u + u**3)
        apsis = roots(b)[1].real if inwards else None
        turning = lambda low: 2 * quad(lambda t: t * rate(apsis - t * t), [0, sqrt(apsis - low)])
        places = [place for place in (0, 0.5, 0.7, 1, 3, 10) if place < u0] + [u0]
        phi = turning(mpf(0)) + turning(u0) if inwards else quad(rate, places)
        assert abs(phi - pi - escaping(b, u0, inwards, mpf(0))) < mpf(10) ** -25, (b, u0)
    for r in (10, 1.5, 1, 0.5, 0.01):
        u = 1 / mpf(r)
        edge = falling_edge_angle(u)
        assert abs(sin(edge) / (u * (1 - sqrt(u) * cos(edge))) - B_CRIT) < mpf(10) ** -50, r
    for r, degrees in ((10, 20), (10, 150), (1.2, 60)):
        theta, u = pi * degrees / 180, 1 / mpf(r)
        base, _ = aberrated(theta, mpf(0), -sqrt(u), mpf(0))
        off = from_falling(u, theta) - (from_view_angle(u, base) - base + theta)
        assert abs(off) < mpf(10) ** -50, (r, degrees)


def regimes_at_rest():
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


AHEAD, AWAY, ALONG = "-0.99995,0", "0.99995,0", "0,0.99995"


def power(gap):
    """1e-6 instead of Python's 1e-06."""
    return f"{gap:g}".replace("e-0", "e-")


def regimes_in_motion():
    """(group, name, kind, motion, first number, second number, azimuth in degrees, whether there is such a ray)"""
    radii = {1 + 1e-6: "1 + 1e-6", 1 + 1e-12: "1 + 1e-12", 1.0: "1", 1 - 1e-12: "1 − 1e-12", 1 - 1e-6: "1 − 1e-6"}
    for r, name in radii.items():
        for degrees in (45, 120):
            place = f"r = {name}, θ = {degrees}°"
            yield "free fall through the horizon", place, "view", "fall", r, math.radians(degrees), 0, True
    for r in (10.0, 1.0, 0.1):
        for gap in (1e-6, 1e-12, -1e-12, -1e-6):
            side = f"1 − x = {power(gap)}" if gap > 0 else f"x − 1 = {power(-gap)}"
            yield "free fall, at the shadow's edge", f"r = {r:g}, {side}", "edge", "fall", r, gap, 0, True
    # Where the error of the shipped table is largest.
    for r, gap in ((0.1, 2e-5), (0.03, 1e-5), (0.01, 7.5e-5)):
        yield "free fall, towards r = 0", f"r = {r:g}, 1 − x = {power(gap)}", "edge", "fall", r, gap, 0, True
        for degrees in (90, 150):
            place = f"r = {r:g}, θ = {degrees}°"
            yield "free fall, towards r = 0", place, "view", "fall", r, math.radians(degrees), 0, True
    for r in (10.0, 1.0, 0.1):
        for name, theta in (("θ = 0", 0.0), ("θ one ulp from π", math.nextafter(math.pi, 0)), ("θ = π", math.pi)):
            yield "free fall, straight views", f"r = {r:g}, {name}", "view", "fall", r, theta, 0, True
    for r, degrees, sign in ((0.9, 10, "<"), (0.25, 60, "="), (0.25, 20, "<"), (0.01, 80, "<")):
        place = f"r = {r:g}, θ = {degrees}°, E {sign} 0"
        yield "free fall, no energy at infinity: E ≤ 0", place, "view", "fall", r, math.radians(degrees), 0, True
    for r in (6.0, 3.0):
        for theta, azimuth in ((90, 0), (60, 0), (60, 180), (150, 45)):
            place = f"r = {r:g}, θ = {theta}°, azimuth {azimuth}°"
            yield "in orbit", place, "view", "orbit", r, math.radians(theta), azimuth, True
        place, theta = f"r = {r:g}, 1 − x = 1e-6, azimuth 0°", view_at_edge(r, 1e-6, "orbit")
        yield "in orbit", place, "view", "orbit", r, theta, 0, True
    for way, motion, views in (
        ("towards the hole", AHEAD, ((1, 0), (179, 0))),
        ("away from the hole", AWAY, ((90, 0), (179, 0))),
        ("past the hole", ALONG, ((90, 0), (90, 180), (89, 0), (91, 0))),
    ):
        for r in (10.0, 3.0):
            for theta, azimuth in views:
                place = f"r = {r:g}, θ = {theta}°" + (f", azimuth {azimuth}°" if motion == ALONG else "")
                yield f"γ = 100 {way}", place, "view", motion, r, math.radians(theta), azimuth, True
            if motion == ALONG:
                place, theta = f"r = {r:g}, 1 − x = 1e-6, azimuth 0°", view_at_edge(r, 1e-6, ALONG)
                yield f"γ = 100 {way}", place, "view", motion, r, theta, 0, True
    for theta, azimuth in ((90, 0), (89, 0), (91, 0), (120, 90)):
        place = f"r = 0.5, θ = {theta}°, azimuth {azimuth}°"
        yield "γ = 100 across the fall", place, "view", ALONG, 0.5, math.radians(theta), azimuth, True
    for name, motion, r in (("in orbit at r = 3/2", "orbit", 1.5), ("in free fall at r = 0", "fall", 0.0)):
        yield "no such observer", name, "view", motion, r, 1.0, 0, False


def regimes():
    for group, name, kind, first, second, exists in regimes_at_rest():
        yield group, name, kind, "rest", first, second, 0.0, exists
    for group, name, kind, motion, first, second, degrees, exists in regimes_in_motion():
        yield group, name, kind, motion, first, second, math.radians(degrees), exists


def truth(kind, motion, first, second, azimuth, exists):
    if not exists:
        return "none"
    bend = {"b": lambda: from_b(first), "edge": lambda: from_edge(first, second, motion),
            "view": lambda: from_view(first, second, azimuth, motion)}[kind]()
    return "captured" if bend is None else mp.nstr(bend, 40, min_fixed=-60, max_fixed=60)


check()
with open("studies/data/regimes.csv", "w", encoding="utf-8") as out:
    out.write("group;name;kind;motion;first;second;azimuth;truth\n")
    for group, name, *numbers, exists in regimes():
        fields = [field if isinstance(field, str) else repr(field) for field in numbers]
        out.write(";".join([group, name, *fields, truth(*numbers, exists)]) + "\n")
