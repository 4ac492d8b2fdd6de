"""Arrays in pieces.

A lookup is some thirty cheap operations, so the memory traffic between them decides its speed. Arrays are therefore
taken in pieces whose buffers stay in a core's own cache, and every operation writes into a buffer.
"""

import numpy as np

#: Rays per piece: at most 128 bytes a ray, so 1 MiB, which is about a level 2 cache. Twice or half of it is as fast.
_PIECE = 8192


class _Work:
    """The buffers for `size` rays."""

    def __init__(self, size):
        self._floats = np.empty((9, size))
        self._cells = np.empty((size, 4))
        self._index = np.empty(size, np.intp)
        self.first(size)

    def first(self, m):
        """Use the first `m` places."""
        self.floats, self.cells, self.index = self._floats[:, :m], self._cells[:m], self._index[:m]


def in_pieces(piece, inputs, out):
    """Calls `piece(*inputs, out, work)` on the same rows of all arrays, _PIECE at a time."""
    count = len(out)
    size = min(count, _PIECE)
    if size == 0:
        return
    work = _Work(size)
    with np.errstate(all="ignore"):
        for start in range(0, count, size):
            here = slice(start, min(start + size, count))
            if here.stop - start < size:
                work.first(here.stop - start)
            piece(*(array[here] for array in inputs), out[here], work)


def floats(values):
    """The values as a float64 array; ValueError or TypeError if they are not real numbers."""
    array = np.asarray(values)
    if array.dtype.kind == "c":
        raise ValueError("complex numbers have no place here")
    return array.astype(np.float64, copy=False)


def plain(array):
    """A Python scalar for an array without dimensions."""
    return array.item() if array.ndim == 0 else array
