"""The bending of light by a Schwarzschild black hole, from a lookup table.

    import lensbake
    lensbake.bend(10, 0.5)                      # 0.553166...: at r = 10, looking 0.5 rad beside the hole
    row = lensbake.atlas().row(10)              # the lookup for one observer, to be kept
    row.bend(theta)                             # array of the deflection angle, NaN where captured
    row.directions(d)                           # array (..., 3): where the light of each pixel comes from

Units: lengths in Schwarzschild radii (r_s = 2GM/c²), angles in rad. θ is the angle of a view direction from the
direction of the hole, in the observer's own frame; r is the areal radius.
"""

import functools
import os

import numpy as np

from ._pieces import floats
from ._place import B_CRIT
from ._row import Row
from ._table import Header, Measured, Table, TableError

__all__ = ["B_CRIT", "Header", "Measured", "Row", "Table", "TableError", "atlas", "bend", "read"]
__version__ = "0.1.0"

read = Table.read


@functools.lru_cache(maxsize=None)
def atlas():
    """The built-in table, for every observer with r ≥ 0.01: read at the first call, then kept."""
    return Table.read(os.path.join(os.path.dirname(__file__), "atlas.lbt"))


@functools.lru_cache(maxsize=64)
def _atlas_row(r, motion):
    return atlas().row(r, motion)


def bend(r, theta, motion="rest"):
    """The deflection angle Δ = θ − θ_sky, rad, at the view angles `theta` of the observer at `r`; NaN where captured.

    `atlas().row(r, motion).bend(theta)`: see :meth:`Table.row` for r and motion, :meth:`Row.bend` for the accuracy and
    the errors. If both are arrays, their shapes are broadcast. A row is mixed for each different r, so this is fast for
    few different radii. Returns a float for two scalars, else a float64 array.
    """
    if np.ndim(r) == 0:
        return _atlas_row(float(r), motion).bend(theta)
    r, theta = np.broadcast_arrays(floats(r), floats(theta))
    radii, group, counts = np.unique(r, return_inverse=True, return_counts=True)
    order = np.argsort(group.reshape(-1), kind="stable")
    sorted_theta = theta.reshape(-1)[order]
    bends = np.empty(theta.size)
    ends = np.cumsum(counts)
    for radius, start, end in zip(radii, ends - counts, ends):
        bends[order[start:end]] = atlas().row(radius, motion).bend(sorted_theta[start:end])
    return bends.reshape(theta.shape)
