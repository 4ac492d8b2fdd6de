"""A table in memory: its header, its texels, and the row of an observer."""

import math
import os
from typing import NamedTuple, Optional

import numpy as np

from ._place import B_CRIT, Place
from ._row import Row

#: Limits on a table's size, as in docs/format.md.
_TEXELS = (4, 1 << 16)
_ROWS = (4, 1 << 12)
MAX_TEXELS = 1 << 22


class TableError(ValueError):
    """A table that cannot be read or used: one line, which names the file if there is one."""


class Measured(NamedTuple):
    """The error of a table against the closed form, measured between its texels when it was baked."""

    max_error: float  # largest error, rad
    rays: int  # number of rays
    r_min: float  # smallest radius of their observers, Schwarzschild radii
    edge_gap: float  # smallest 1 − x: how close to the edge of the shadow they come


class Header(NamedTuple):
    """The header of a table; docs/format.md says what the fields mean."""

    version: int  # of the file, 1 or 2
    axis: str  # 'residual', 'b', 'inverse-b' or 'log-b'
    b_min: Optional[float]  # of the axes in b, else None
    b_max: Optional[float]
    row_map: str  # 'one', 'chi' or 'chi+ln-u'
    inverse_radius: Optional[float]  # of the observer of row_map 'one', else None
    rows: int  # all rows
    rows_below: int  # rows at the horizon and below, of row_map 'chi+ln-u'; else 0
    r_min: Optional[float]  # smallest radius of row_map 'chi+ln-u', else None
    texels: int  # per row
    solver: str
    tolerance: float  # of the solver, rad per radian of orbital angle
    measured: Measured
    measured_below: Optional[Measured]  # of the rows below the horizon, if there are rows on both sides

    def check(self):
        """Raises TableError unless the header satisfies docs/format.md."""
        _in_range("the number of texels in a row", self.texels, _TEXELS)
        if self.row_map == "one":
            if not 0.0 <= self.inverse_radius <= 1000.0:
                raise TableError(f"inverse_radius is {self.inverse_radius}, must be from 0 to 1000")
        else:
            _in_range("the number of rows above the horizon", self.rows - self.rows_below, _ROWS)
        if self.row_map == "chi+ln-u":
            if self.version == 1:
                raise TableError("version 1 has no rows below the horizon")
            _in_range("the number of rows below the horizon", self.rows_below, _ROWS)
            if not 0.001 <= self.r_min < 1.0:
                raise TableError(f"r_min is {self.r_min}, must be from 0.001 to below 1")
        _in_range("the number of texels in all", self.rows * self.texels, (1, MAX_TEXELS))
        if self.axis != "residual":
            if not B_CRIT < self.b_min < self.b_max < math.inf:
                raise TableError(f"b_min is {self.b_min}, b_max {self.b_max}; needs b_c < b_min < b_max < infinity")
            if self.row_map != "one" or self.inverse_radius != 0.0:
                raise TableError(f"the axis {self.axis} is for the observer at infinity only")


class Table:
    """A table of the bending of light: attributes `header` (:class:`Header`) and `texels`.

    `texels` is a read-only float32 array (rows, texels, 2) of the stored value and its slope per texel, rad.
    """

    def __init__(self, header, texels):
        """Raises TableError if the header is not valid, or the texels are not finite or not of its shape."""
        header.check()
        texels = np.asarray(texels, np.float32)
        if texels.shape != (header.rows, header.texels, 2):
            raise TableError(f"the texels are of shape {texels.shape}, not {(header.rows, header.texels, 2)}")
        bad = np.argwhere(~np.isfinite(texels).all(axis=2))
        if len(bad):
            raise TableError(f"texel {bad[0][1]} of row {bad[0][0]} is not finite")
        self.header, self.texels = header, texels.view()
        self.texels.flags.writeable = False

    @classmethod
    def read(cls, path):
        """The table in the file `path`, a `.lbt` or an `.exr` (told apart by their content).

        Everything is checked: the header, the size before anything is allocated for it, the checksum, and that the
        texels are finite. Raises TableError, with one line that names the file, if it is not a valid table; OSError
        if it cannot be opened; ImportError for an `.exr` without the package OpenEXR.
        """
        from . import _files

        try:
            return cls(*_files.read(path))
        except TableError as error:
            raise TableError(f"{os.fspath(path)}: {error}") from None

    def row(self, r, motion="rest"):
        """The :class:`Row` for the observer at `r`, in Schwarzschild radii, who is at rest or in free fall.

        `motion` is 'rest', for r > 1, or 'fall' (freely, from rest at infinity), down to the table's r_min, 0.01 for
        the built-in one. r = math.inf is the observer at infinity. The row is mixed from four rows in float64, which
        takes as long as the lookup of a few thousand rays: keep it.

        Raises ValueError for an r or a motion that the table or nature does not have, TableError for a table whose
        axis is not 'residual'.
        """
        header = self.header
        if header.axis != "residual":
            raise TableError(f"rows are looked up on the axis 'residual' only, not '{header.axis}'")
        place = Place(float(r), motion)
        first, weights = self._mix(place)
        texels = np.tensordot(weights, self.texels[first : first + len(weights)].astype(np.float64), 1)
        return Row(place, texels)

    def _mix(self, place):
        """The first of the rows that are mixed for an observer, and the weights of it and the next ones."""
        header, u = self.header, place.u
        if header.row_map == "one":
            if abs(u - header.inverse_radius) > 1e-12 * max(header.inverse_radius, 1.0):
                holds = 1.0 / header.inverse_radius if header.inverse_radius else math.inf
                raise ValueError(f"the table has only the row of r = {holds}, not of r = {place.r}")
            return 0, [1.0]
        above = header.rows - header.rows_below
        if not place.inside:
            part = math.atan2(math.sqrt(u), place.lapse) / (0.5 * math.pi)
            return _lagrange(part, above)
        reach = header.r_min if header.rows_below else 1.0
        part = math.log(u) / -math.log(reach) if reach < 1.0 else math.inf
        if part > 1.0 + 1e-12:
            rows = f"down to r = {reach}" if reach < 1.0 else "for r > 1"
            raise ValueError(f"r = {place.r} is not in the table, which has rows {rows}")
        first, weights = _lagrange(min(part, 1.0), header.rows_below)
        return above + first, weights


def _lagrange(part, count):
    """The first of the four rows around `part` (0 to 1) of `count` rows, and their weights in Lagrange's cubic.

    Next to the first and the last row the four are moved inwards: no row is repeated or extrapolated.
    """
    position = part * (count - 1)
    first = min(max(math.floor(position) - 1, 0), count - 4)
    t = position - first
    return first, [
        -(t - 1) * (t - 2) * (t - 3) / 6,
        t * (t - 2) * (t - 3) / 2,
        -t * (t - 1) * (t - 3) / 2,
        t * (t - 1) * (t - 2) / 6,
    ]


def _in_range(what, found, limits):
    if not limits[0] <= found <= limits[1]:
        raise TableError(f"{what} is {found}, must be from {limits[0]} to {limits[1]}")
