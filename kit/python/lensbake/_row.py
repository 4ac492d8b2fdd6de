"""The row of one observer: the lookup of docs/format.md in float64, on arrays.

There are no masks: captured rays have 1 − x ≤ 0 and become NaN in the logarithm.
"""

import math

import numpy as np

from ._pieces import floats, in_pieces, plain
from ._place import B_CRIT

#: b_c minus the float64 nearest to it: with it, b − b_c keeps its digits next to b_c.
_B_CRIT_REST = -7.151834159792777e-17

#: Stands for sin θ = 0 in a divisor.
_TINY = 1e-300
_PI = math.pi
#: π in float32 is greater than π; angles up to it count as π.
_PI_UP = float(np.float32(np.pi))


class Row:
    """The lookup for one observer. Made by :meth:`Table.row`.

    Angles are in rad, lengths in Schwarzschild radii. θ is the view angle from the direction of the hole, from 0 to
    π, in the observer's own frame. Methods take arrays of any shape and return float64 arrays of that shape, or a
    float for a scalar. Light of the sky does not come from captured directions; their results are NaN. A NaN in the
    input gives a NaN. A row can be used by several threads at once.

    Attributes: `r`, `motion`, `theta_c` (angular radius of the shadow, rad), `texels` (the mixed row, array
    (n, 2) of values and slopes).
    """

    def __init__(self, place, texels):
        self.r, self.motion = place.r, place.motion
        self.theta_c = 2.0 * math.atan(place.tan_half)
        self.texels = texels
        self._place, self._tan_half = place, place.tan_half
        self._aberrant = place.motion == "fall" and not place.inside and place.u > 0.0
        # tan(θ₀/2)/tan(θ/2), with θ₀ the view angle of the observer at rest
        self._boost = place.z_out / place.lapse if self._aberrant else 1.0
        self._sigma = (0.5 * place.minus) ** 0.6 if place.inside else 1.0
        self._weight = 5.0 / 18.0 * place.c / self._sigma
        self._last = float(len(texels) - 1)
        # Row i of `_cells` has the coefficients of the Hermite cubic between texels i and i + 1, the constant first. A
        # last, constant cell serves q = 1.
        value, slope = texels[:, 0], texels[:, 1]
        self._cells = np.zeros((len(texels), 4))
        self._cells[:, 0], self._cells[:, 1] = value, slope
        rise = np.diff(value)
        self._cells[:-1, 2] = 3.0 * rise - 2.0 * slope[:-1] - slope[1:]
        self._cells[:-1, 3] = slope[:-1] + slope[1:] - 2.0 * rise

    def bend(self, theta):
        """The deflection angle Δ = θ − θ_sky at the view angles `theta`, rad; NaN for captured rays.

        θ_sky is the angle of the light's origin on the sky from the direction of the hole. It is not reduced to 0 to
        π: it is negative for light from the other side of the hole, and Δ grows without bound towards the shadow.

        With the built-in atlas, for 1 − x ≥ 1e-6, x = tan(θ_c/2)/tan(θ/2): within 1e-7 rad of the closed form for
        r > 1 (at rest from r = 1.005), 2e-6 rad for 0.1 ≤ r ≤ 1 and 2e-5 rad for 0.01 ≤ r < 0.1.

        Raises ValueError for an angle outside 0 to π, and for the observer at infinity, whose rays have an impact
        parameter and no angle: :meth:`bend_b`.
        """
        return self._angles(theta, self._bend_piece)

    def sky(self, theta):
        """θ_sky = θ − Δ, rad, for the view angles `theta`: see :meth:`bend`. It is not reduced to 0 to π."""
        theta = floats(theta)
        return plain(np.subtract(theta, self.bend(theta)))

    def captured(self, theta):
        """Whether the ray at the view angles `theta` (rad) is captured: θ ≤ θ_c. Array of bool; False for a NaN.

        Raises ValueError as :meth:`bend`.
        """
        theta = floats(theta)
        tan_half = self._angles(theta, self._tangent)
        return plain(np.less_equal(tan_half, self._tan_half))

    def shift(self, theta):
        """ν_obs/ν_∞ = 1/(z_in cos²(θ/2) + z_out sin²(θ/2)) at the view angles `theta`; NaN for captured rays.

        The frequency that the observer sees, divided by that at infinity. Light is g⁴ times as bright for a shift g.
        It is computed, not looked up. Raises ValueError as :meth:`bend`.
        """
        return self._angles(theta, self._shift_piece)

    def bend_cos(self, cos, sin):
        """:meth:`bend` for cos θ and sin θ in place of θ, with cos² + sin² = 1 and sin ≥ 0; the shapes are broadcast.

        It needs no arc cosine, and keeps its digits towards the hole and away from it. Not for the observer at
        infinity. Raises ValueError for a negative sine.
        """
        self._check_near()
        cos, sin = np.broadcast_arrays(floats(cos), floats(sin))
        out = np.empty(cos.shape)
        in_pieces(self._bend_cos_piece, [cos.reshape(-1), sin.reshape(-1)], out.reshape(-1))
        return plain(out)

    def bend_b(self, b, away=False):
        """The deflection angle, rad, for the impact parameter `b`, at any r, also math.inf; NaN for captured rays.

        b is that of the ray far from the hole, and 0 < b ≤ r/√(1−1/r) for r > 1. Two rays have the same b: by default
        the one on the side of the hole (θ < 90° for the observer at rest), which has passed its closest approach and
        is captured at b ≤ b_c = 3√3/2. With `away=True` the other one, on its way in. For r ≤ 3/2 only that one comes
        from the sky, for b < b_c. At infinity, only the first is bent.

        Δ is in the frame of the observer's motion, as in :meth:`bend`. Raises ValueError for b outside its range.
        """
        place = self._place
        b = floats(b)
        if np.any(b <= 0.0) or np.any(np.isinf(b)):
            raise ValueError("b must be positive and finite (in Schwarzschild radii)")
        b = np.maximum(b, 1e-100)  # below it, squares overflow and nothing changes
        e = ((b - B_CRIT) - _B_CRIT_REST) / b  # 1 − b_c/b
        inverse = B_CRIT / b
        # x solves (1+C) x² − 2 (b_c/b) x + (1−C) = 0, and d = 1 − x solves (1+C) d² − 2 (C+e) d + 2 e = 0. Of each
        # pair of roots the form is taken that does not cancel.
        square = inverse * inverse - place.plus * place.minus
        if np.any(square < -1e-12 * inverse * inverse):
            raise ValueError(f"b is above r/sqrt(1 - 1/r), the largest impact parameter of a ray through r = {self.r}")
        root = np.sqrt(np.maximum(square, 0.0))
        half = place.c + e
        with np.errstate(all="ignore"):
            if away:
                d = np.where(half > 0.0, (half + root) / place.plus, 2.0 * e / (half - root))
            elif place.c > 0.0:
                d = np.where(half > 0.0, 2.0 * e / (half + root), (half - root) / place.plus)
            else:
                d = np.full(b.shape, np.nan)
        # Rounding may exceed 1 where the ray is straight away.
        d = np.minimum(d, 1.0)
        out = np.empty(b.shape)
        in_pieces(self._bend_gap_piece, [d.reshape(-1)], out.reshape(-1))
        if self._aberrant:
            # θ − θ₀ by the subtraction of arc tangents, with x in place of tan(θ/2)
            x = 1.0 - d
            tan = self._tan_half
            out -= 2.0 * np.arctan((self._boost - 1.0) * tan * x / (x * x + self._boost * tan * tan))
        elif place.inside:
            out += 2.0 * np.arctan2(self._tan_half, 1.0 - d) - _PI
        return plain(out)

    def directions(self, d):
        """Where the light comes from: unit directions on the sky for the view directions `d`, array (..., 3).

        Both are in the hole frame, the hole along −Z: (0, 0, −1) looks at it. `d` need not have unit length. The
        result is an array of the same shape, NaN where captured. It is as accurate as :meth:`bend`, and takes neither
        an arc cosine nor a sine. Not for the observer at infinity. Raises ValueError for another shape.
        """
        self._check_near()
        d = floats(d)
        if d.ndim == 0 or d.shape[-1] != 3:
            raise ValueError(f"directions have the shape (..., 3), not {d.shape}")
        out = np.empty(d.shape)
        in_pieces(self._directions_piece, [d.reshape(-1, 3)], out.reshape(-1, 3))
        return out

    # The methods below work on one piece: inputs and `out` of m rays, `work` of buffers with m places.

    def _bend_piece(self, theta, out, work):
        t, d = work.floats[0], work.floats[1]
        self._tangent(theta, t, work)
        # t − T is exact near the edge, where 1 − x = (t − T)/t would otherwise cancel.
        np.subtract(t, self._tan_half, out=d)
        np.divide(d, t, out=d)
        self._bend_row(d, out, work)
        if self._aberrant:
            # θ₀ − θ = 2 atan((k−1) t/(1 + k t²)): no difference of two arc tangents
            k, square = self._boost, work.floats[1]
            np.multiply(t, t, out=square)
            square *= k
            square += 1.0
            t *= k - 1.0
            np.divide(t, square, out=t)
            self._subtract_twice_arctan(t, out)
        elif self._place.inside:
            # θ₀ = π
            out += np.minimum(theta, _PI, out=t)
            out -= _PI

    def _bend_cos_piece(self, cos, sin, out, work):
        if sin.min() < 0.0:
            raise ValueError("sin must not be negative")
        d = work.floats[1]
        self._gap(cos, sin, d, work.floats[2])
        self._bend_row(d, out, work)
        t, f = work.floats[0], work.floats[1]
        if self._aberrant:
            # as above, with t = sin/(1 + cos): (k−1) sin/((1+cos) + k (1−cos))
            k = self._boost
            np.multiply(cos, 1.0 - k, out=f)
            f += 1.0 + k
            np.multiply(sin, k - 1.0, out=t)
            np.divide(t, f, out=t)
            self._subtract_twice_arctan(t, out)
        elif self._place.inside:
            np.arctan2(sin, cos, out=t)
            out += t
            out -= _PI

    def _bend_gap_piece(self, gap, out, work):
        np.copyto(work.floats[1], gap)
        self._bend_row(work.floats[1], out, work)

    def _shift_piece(self, theta, out, work):
        t, square = work.floats[0], work.floats[1]
        self._tangent(theta, t, work)
        # 1/g = (z_in + z_out t²)/(1 + t²), which is NaN only where t² overflows: θ ≤ π gives t < 2e16.
        np.multiply(t, t, out=square)
        np.multiply(square, self._place.z_out, out=out)
        out += self._place.z_in
        square += 1.0
        np.divide(square, out, out=out)
        # log(1 − T/t), times 0, is NaN for captured rays; so is the quotient 0/0 at t = T.
        np.subtract(t, self._tan_half, out=t)
        np.sqrt(t, out=square)
        np.divide(t, square, out=t)
        t *= 0.0
        out += t

    def _directions_piece(self, d, out, work):
        cos, sin, gap, row_bend, wide = work.floats[4:9]
        x, y, z = d[:, 0], d[:, 1], d[:, 2]
        np.multiply(x, x, out=sin)
        np.multiply(y, y, out=wide)
        sin += wide
        np.multiply(z, z, out=wide)
        wide += sin
        np.sqrt(sin, out=sin)
        np.sqrt(wide, out=wide)
        np.divide(z, wide, out=cos)
        np.negative(cos, out=cos)
        np.divide(sin, wide, out=sin)
        np.maximum(sin, _TINY, out=sin)
        wide *= sin  # length of (x, y)
        self._gap(cos, sin, gap, row_bend)
        self._bend_row(gap, row_bend, work)
        # The tangent of half the bending gives its cosine and sine, faster than both functions.
        half, square, a, b = work.floats[:4]
        row_bend *= 0.5
        np.tan(row_bend, out=half)
        np.multiply(half, half, out=square)
        if self._place.inside:
            # θ₀ = π: cos θ_sky = −cos Δ, sin θ_sky = sin Δ
            np.subtract(square, 1.0, out=a)
            np.multiply(half, 2.0, out=b)
        else:
            if self._aberrant:
                self._to_rest(cos, sin, gap, a)
            # cos(θ₀−Δ) and sin(θ₀−Δ), both times 1 + half²
            half *= 2.0
            np.subtract(1.0, square, out=gap)
            np.multiply(cos, gap, out=a)
            np.multiply(sin, half, out=b)
            a += b
            np.multiply(sin, gap, out=b)
            np.multiply(cos, half, out=gap)
            b -= gap
        square += 1.0
        np.divide(a, square, out=a)
        np.divide(b, square, out=b)
        np.divide(b, wide, out=b)
        np.multiply(x, b, out=out[:, 0])
        np.multiply(y, b, out=out[:, 1])
        np.negative(a, out=out[:, 2])

    def _tangent(self, theta, out, work):
        """tan(θ/2), with the angles checked."""
        if not (theta.min() >= 0.0 and theta.max() <= _PI):
            if np.any(theta < 0.0) or np.any(theta > _PI_UP):
                raise ValueError("theta must be from 0 to pi (rad, from the direction of the hole)")
            theta = np.minimum(theta, _PI)
        np.multiply(theta, 0.5, out=out)
        np.tan(out, out=out)

    def _gap(self, cos, sin, out, spare):
        """1 − x from cos θ and sin θ, with that form of tan(θ/2) that does not cancel near the edge."""
        if self._tan_half <= 1.0:
            np.add(cos, 1.0, out=out)
            np.maximum(out, 0.0, out=out)
            out *= -self._tan_half
            np.maximum(sin, _TINY, out=spare)
            out += spare
            np.divide(out, spare, out=out)
        else:
            np.subtract(1.0, cos, out=spare)
            np.maximum(spare, 0.0, out=spare)
            np.multiply(sin, -self._tan_half, out=out)
            out += spare
            np.divide(out, spare, out=out)

    def _to_rest(self, cos, sin, a, b):
        """Replaces cos θ, sin θ by those of θ₀, the view angle of the observer at rest."""
        square = self._boost**2
        np.multiply(cos, 1.0 - square, out=a)
        a += 1.0 + square
        np.multiply(cos, 1.0 + square, out=b)
        b += 1.0 - square
        np.divide(b, a, out=cos)
        sin *= 2.0 * self._boost
        np.divide(sin, a, out=sin)

    @staticmethod
    def _subtract_twice_arctan(t, out):
        np.arctan(t, out=t)
        t *= 2.0
        out -= t

    def _bend_row(self, d, out, work):
        """Steps 3 and 4 of the lookup: the row's Δ from d = 1 − x, which is overwritten."""
        a, b = work.floats[2], work.floats[3]
        if self._place.inside:
            # d becomes 1 − X = σ d/(1 + (σ−1) d)
            np.multiply(d, self._sigma - 1.0, out=a)
            a += 1.0
            d *= self._sigma
            np.divide(d, a, out=d)
        np.subtract(1.0, d, out=a)
        np.sqrt(a, out=a)
        if self._place.inside:
            np.multiply(a, 48.0, out=b)
            b += 1.0
            np.sqrt(b, out=b)
            b += 7.0
            a += 1.0
            a *= b
            a *= 0.125
        else:
            a += 1.0
        np.divide(d, a, out=a)
        np.sqrt(a, out=a)
        a *= self._last
        np.floor(a, out=b)
        # A NaN becomes the index of any cell; its t is NaN.
        np.copyto(work.index, b, casting="unsafe")
        a -= b
        np.take(self._cells, work.index, axis=0, out=work.cells, mode="clip")
        cells = work.cells
        np.multiply(cells[:, 3], a, out=out)
        out += cells[:, 2]
        out *= a
        out += cells[:, 1]
        out *= a
        out += cells[:, 0]
        # Written as ln d + w (d ln d), so that d = 0 gives NaN: −∞ × 0.
        np.log(d, out=b)
        out -= b
        d *= b
        d *= self._weight
        out -= d

    def _check_near(self):
        if self._place.u == 0.0:
            raise ValueError("an observer at infinity has an impact parameter, not a view angle: use bend_b(b)")

    def _angles(self, theta, piece):
        self._check_near()
        theta = floats(theta)
        out = np.empty(theta.shape)
        in_pieces(piece, [theta.reshape(-1)], out.reshape(-1))
        return plain(out)
