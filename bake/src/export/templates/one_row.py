
import numpy as np

# tan(theta_c/2)/sigma, with theta_c the angle of the edge of the shadow; (5/18) C/sigma, with C the cosine of theta_c for an
# observer at rest, continued below the horizon; and sigma, which is 1 above the horizon.
TAN_HALF_SHADOW = TAN_HALF_NUMBER
LOG_WEIGHT = LOG_WEIGHT_NUMBER
SIGMA = SCALE_NUMBER
# Value and slope of each texel.
ROW = np.array([
NUMBERS
]).reshape(-1, 2)DECODE


def bend(theta):
    """The deflection angle in rad of the light seen at the angles theta (rad) from the direction of the hole; NaN where
    the ray ends in the hole. The light comes from the angle theta - bend(theta). Any shape."""
    return bend_cos_sin(np.cos(theta), np.sin(theta))


def bend_cos_sin(c, p):
    """As bend, from the cosine and the sine of theta."""
    c, p = np.asarray(c, dtype=float), np.asarray(p, dtype=float)
    with np.errstate(divide="ignore", invalid="ignore"):
        n = TAN_HALF_SHADOW * np.where(c < 0.0, p, 1.0 + c)
        x = n / (np.where(c < 0.0, 1.0 - c, p) - (SIGMA - 1.0) * n)
        # The denominator is negative inside the shadow.
        x = np.where((x >= 0.0) & (x < 1.0), x, np.nan)
        d = 1.0 - x
        last = len(ROW) - 1
POSITION
        i = np.minimum(np.nan_to_num(position).astype(int), last - 1)
        t = position - i
        a, slope_a, b, slope_b = ROW[i, 0], ROW[i, 1], ROW[i + 1, 0], ROW[i + 1, 1]
        rise = b - a
        value = a + t * (slope_a + t * (3.0 * rise - 2.0 * slope_a - slope_b + t * (slope_a + slope_b - 2.0 * rise)))
        return value - (1.0 + LOG_WEIGHT * d) * np.log(d)


def $function(d, hole):
    """The unit directions on the sky from which the light comes that is seen in the directions d, array of shape (..., 3).
    hole is the direction of the hole, in the same frame. NaN where the ray ends in the hole."""
    d, hole = (v / np.linalg.norm(v, axis=-1, keepdims=True) for v in (np.asarray(d, float), np.asarray(hole, float)))
    c = d @ hole
    across = d - c[..., None] * hole
    p = np.linalg.norm(across, axis=-1)
    angle = bend_cos_sin(c, p)
    cos, sin = np.cos(angle), np.sin(angle)
    sideways = (p * cos - c * sin) / np.maximum(p, 1e-300)
    return (c * cos + p * sin)[..., None] * hole + sideways[..., None] * across
