"""The two containers of a table: `.lbt` (binary) and `.exr` (OpenEXR). docs/format.md describes them."""

import io
import os
import struct
import zlib

import numpy as np

from ._table import MAX_TEXELS, Header, Measured, TableError

_MAGIC = b"LENSBAKE"
_EXR_MAGIC = b"\x76\x2f\x31\x01"
_MAX_SOLVER = 4016
_MAX_HEADER = _MAX_SOLVER + 124
#: Most bytes of a file: three channels of floats, and an allowance for the header.
_MAX_FILE = MAX_TEXELS * 12 + (1 << 20)
_AXES = ("residual", "b", "inverse-b", "log-b")
_ROW_MAPS = ("one", "chi", "chi+ln-u")


def read(path):
    """The header and the texels in the file `path`. Raises TableError without the name of the file."""
    with open(path, "rb") as file:
        # A device or a pipe has no size, so the reading is bounded, too.
        size = os.fstat(file.fileno()).st_size
        data = b"" if size > _MAX_FILE else file.read(_MAX_FILE + 1)
    if size > _MAX_FILE or len(data) > _MAX_FILE:
        raise TableError(f"larger than any table, which has at most {_MAX_FILE} bytes")
    if data.startswith(_MAGIC):
        return _read_lbt(data)
    if data.startswith(_EXR_MAGIC):
        return _read_exr(path)
    raise TableError("not a table: begins neither as a .lbt nor as an .exr")


def _read_lbt(data):
    if len(data) < 16:
        raise TableError(f"has {len(data)} bytes where 16 are needed")
    version, length = struct.unpack_from("<II", data, 8)
    _check_version(version)
    if length > _MAX_HEADER:
        raise TableError(f"the header is {length} bytes long, more than {_MAX_HEADER}")
    end = 16 + length
    if len(data) < end:
        raise TableError(f"has {len(data)} bytes where {end} are needed")
    header = _decode_header(data[16:end], version)
    header.check()
    expected = end + 8 * header.rows * header.texels + 4
    if len(data) != expected:
        raise TableError(f"has {len(data)} bytes where {expected} are needed")
    _check_crc(zlib.crc32(data[16:-4]), struct.unpack_from("<I", data, expected - 4)[0])
    texels = np.frombuffer(data, "<f4", 2 * header.rows * header.texels, end)
    return header, texels.reshape(header.rows, header.texels, 2)


def _read_exr(path):
    try:
        import OpenEXR
    except ImportError:
        raise ImportError(f"{path}: an .exr takes the package OpenEXR: pip install lensbake[exr]") from None
    try:
        # The size is checked before memory is allocated for the pixels.
        with OpenEXR.File(os.fspath(path), header_only=True) as file:
            if len(file.parts) != 1:
                raise TableError("has more than one part")
            attributes = dict(file.header())  # the file clears its own when it is closed
        header, crc = _from_attributes(attributes)
        header.check()
        low, high = attributes["dataWindow"]
        width, height = (int(high[i]) - int(low[i]) + 1 for i in (0, 1))
        if (width, height) != (header.texels, header.rows):
            raise TableError(
                f"the picture is {width} x {height} where its attributes say {header.texels} x {header.rows}"
            )
        with OpenEXR.File(os.fspath(path), separate_channels=True) as file:
            if len(file.parts) != 1:  # the package leaves out a part that it cannot decode
                raise TableError("damaged: its pixels cannot be decoded")
            channels = file.channels()
            planes = [channels[name].pixels for name in "RG"]
    except TableError:
        raise
    except Exception as error:  # the package raises RuntimeError and others, at what it finds in a damaged file
        raise TableError(f"OpenEXR: {' '.join(str(error).split()) or type(error).__name__}") from None
    if any(plane.dtype != np.float32 for plane in planes):
        raise TableError("the channels are not 32-bit floats, so the table has lost its accuracy")
    texels = np.stack(planes, axis=-1)
    _check_crc(zlib.crc32(texels.astype("<f4").tobytes(), zlib.crc32(encode_header(header))), crc)
    return header, texels


def _check_version(version):
    if version not in (1, 2):
        raise TableError(f"version {version} is not known: this reads 1 and 2")


def _check_crc(computed, stored):
    if computed != stored:
        raise TableError(f"damaged: its checksum is {computed:08x}, not {stored:08x}")


class _Fields:
    """Reads numbers from the bytes of a header, one after the other."""

    def __init__(self, data):
        self._file = io.BytesIO(data)

    def take(self, kinds):
        kinds = "<" + kinds
        found = self._file.read(struct.calcsize(kinds))
        if len(found) < struct.calcsize(kinds):
            raise TableError("the header is too short")
        values = struct.unpack(kinds, found)
        return values if len(values) > 1 else values[0]

    def text(self):
        length = self.take("Q")
        if length > _MAX_SOLVER:
            raise TableError(f"the solver's name has {length} bytes, more than {_MAX_SOLVER}")
        try:
            return self.take(f"{length}s").decode()
        except UnicodeDecodeError:
            raise TableError("the solver's name is not UTF-8") from None

    def measured(self):
        return Measured(*self.take("dIdd"))

    def end(self):
        rest = len(self._file.read())
        if rest:
            raise TableError(f"the header is {rest} bytes too long")


def _decode_header(data, version):
    fields = _Fields(data)
    axis = fields.take("I")
    if axis >= len(_AXES):
        raise TableError(f"axis is {axis}, must be from 0 to 3")
    b_min, b_max = fields.take("dd") if axis else (None, None)
    row_map = fields.take("I")
    if row_map >= len(_ROW_MAPS):
        raise TableError(f"the rows are of kind {row_map}, must be from 0 to 2")
    inverse_radius, r_min, rows, below = None, None, 1, 0
    if row_map == 0:
        inverse_radius = fields.take("d")
    elif row_map == 1:
        rows = fields.take("I")
    else:
        above, below, r_min = fields.take("IId")
        rows = above + below
    texels, solver, tolerance = fields.take("I"), fields.text(), fields.take("d")
    measured, measured_below = fields.measured(), None
    if version == 2:
        has_below = fields.take("B")
        if has_below > 1:
            raise TableError(f"the mark of the error below the horizon is {has_below}, must be 0 or 1")
        measured_below = fields.measured() if has_below else None
    fields.end()
    names = _AXES[axis], b_min, b_max, _ROW_MAPS[row_map], inverse_radius, rows, below, r_min
    return Header(version, *names, texels, solver, tolerance, measured, measured_below)


def encode_header(header):
    """The bytes of a header in a `.lbt`; an `.exr` has their checksum."""
    axis, row_map = _AXES.index(header.axis), _ROW_MAPS.index(header.row_map)
    data = struct.pack("<I", axis)
    if axis:
        data += struct.pack("<dd", header.b_min, header.b_max)
    data += struct.pack("<I", row_map)
    if row_map == 0:
        data += struct.pack("<d", header.inverse_radius)
    elif row_map == 1:
        data += struct.pack("<I", header.rows)
    else:
        data += struct.pack("<IId", header.rows - header.rows_below, header.rows_below, header.r_min)
    solver = header.solver.encode()
    data += struct.pack("<IQ", header.texels, len(solver)) + solver
    data += struct.pack("<d", header.tolerance) + struct.pack("<dIdd", *header.measured)
    if header.version == 2:
        below = header.measured_below
        data += b"\0" if below is None else b"\1" + struct.pack("<dIdd", *below)
    return data


def _from_attributes(attributes):
    """The header from the attributes of an `.exr`, and the stored checksum."""
    types = {int: "an integer", float: "a number", str: "text"}

    def get(name, kind):
        value = attributes.get(f"lensbake.{name}")
        if isinstance(value, np.ndarray) and value.dtype == np.float64 and value.size == 1:
            value = float(value.reshape(-1)[0])  # the package makes an array of a double
        if not isinstance(value, kind):
            raise TableError(f"the attribute lensbake.{name} is missing or not {types[kind]}")
        return value & 0xFFFFFFFF if kind is int else value  # counts and the checksum are unsigned

    def measured(start):
        rays = get(f"{start}measured_rays", int)
        names = f"{start}max_error", f"{start}measured_r_min", f"{start}measured_edge_gap"
        error, r_min, gap = (get(name, float) for name in names)
        return Measured(error, rays, r_min, gap)

    version, axis, row_map = get("version", int), get("axis", str), get("row_map", str)
    _check_version(version)
    if axis not in _AXES or row_map not in _ROW_MAPS:
        raise TableError("the attribute lensbake.axis or lensbake.row_map is not one of the known names")
    in_b, through = axis != "residual", row_map == "chi+ln-u"
    header = Header(
        version,
        axis,
        get("b_min", float) if in_b else None,
        get("b_max", float) if in_b else None,
        row_map,
        get("inverse_radius", float) if row_map == "one" else None,
        1 if row_map == "one" else get("rows", int),
        get("rows_below", int) if through else 0,
        get("r_min", float) if through else None,
        get("texels", int),
        get("solver", str),
        get("tolerance", float),
        measured(""),
        measured("below_") if "lensbake.below_max_error" in attributes else None,
    )
    return header, get("crc32", int)
