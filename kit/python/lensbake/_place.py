"""Where an observer is and how he moves: the constants of step 1 of the lookup in docs/format.md."""

import math

#: Critical impact parameter b_c = 3√3/2, in Schwarzschild radii.
B_CRIT = 1.5 * math.sqrt(3.0)


class Place:
    """The observer's radius and motion, and what follows from them (`r`, `motion` as in :meth:`Table.row`).

    Raises ValueError for a motion or a radius that no observer can have.
    """

    def __init__(self, r, motion):
        if motion not in ("rest", "fall"):
            raise ValueError(f"motion must be 'rest' or 'fall', not {motion!r}")
        if not r > 0.0:
            raise ValueError(f"r must be a positive number (in Schwarzschild radii), not {r}")
        if motion == "rest" and r <= 1.0:
            raise ValueError(f"nobody is at rest at r = {r}: that takes r > 1; take motion='fall'")
        if 1e150 < r < math.inf:
            raise ValueError(f"r = {r} is too far to compute with: take math.inf")
        self.r, self.motion = r, motion
        far = math.isinf(r)
        u = 1.0 / r
        one_minus_u = 1.0 if far else (r - 1.0) / r
        self.u, self.inside = u, one_minus_u <= 0.0
        self.lapse = lapse = math.sqrt(max(one_minus_u, 0.0))
        self.z_out = 1.0 + math.sqrt(u) if motion == "fall" else lapse
        self.z_in = one_minus_u / self.z_out
        w = 2.0 / 3.0 if far else (2.0 * r - 3.0) / (3.0 * r)
        self.c = min(B_CRIT * w * math.sqrt(1.0 - w), 1.0)
        # The smaller of 1 ± C from 1 − C² = b_c² u² (1−u), so that neither cancels.
        if self.c >= 0.0:
            self.plus = 1.0 + self.c
            self.minus = (B_CRIT * u) ** 2 * one_minus_u / self.plus
            self.tan_half = B_CRIT * u * one_minus_u / (self.plus * self.z_out)
        else:
            self.minus = 1.0 - self.c
            self.plus = (B_CRIT * u) ** 2 * one_minus_u / self.minus
            self.tan_half = self.minus / (B_CRIT * u * self.z_out)
