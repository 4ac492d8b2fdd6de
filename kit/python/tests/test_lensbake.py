"""Run by `PYTHONPATH=kit/python python -m unittest discover -s kit/python/tests`."""

import math
import os
import struct
import tempfile
import unittest
import zlib
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import lensbake
from lensbake import _files

try:
    import OpenEXR
except ImportError:
    OpenEXR = None

HERE = os.path.dirname(__file__)
ASSETS = os.path.join(HERE, "..", "..", "..", "tables", "assets")
BUILT_IN = os.path.join(os.path.dirname(lensbake.__file__), "atlas.lbt")

#: r, θ in degrees, Δ: the closed form, from `bake query --method exact`.
AT_REST = [
    (1.005, 175.0, 1.2407702830301701),
    (1.2, 130.0, 1.8745332602838074),
    (1.5, 91.0, 4.2051563930218068),
    (3.0, 45.0001, 12.668270597788728),
    (3.0, 150.0, 0.12148839371238962),
    (10.0, 14.3, 5.7461643712160857),
    (10.0, math.degrees(0.5), 0.553166226),
    (100.0, 2.0, 1.1220074891696705),
    (1e6, 90.0, 1.0000009726951475e-6),
]
#: r, θ in degrees, Δ, next to the ends of the rows above the horizon.
ENDS = [
    (1.0001, 179.5, 0.8936384671749913),
    (1.0001, 179.99, 0.017279853778466414),
    (1.00001, 179.9, 0.5573731638886819),
    (1.000001, 179.99, 0.1745805839410659),
    (1e6, 0.0001490, 6.562805585670763),
    (1e6, 0.0002, 1.134488497341271),
    (1e6, 1, 0.00011459826346291516),
    (1e4, 0.02, 1.1343609547725144),
    (1e4, 170, 8.749524245121876e-06),
]
#: b, Δ of rays from infinity.
FROM_INFINITY = [(2.5981, 11.200883845254953), (3.0, 1.7193883102301690), (100.0, 0.020299966239543554)]
#: r, θ in degrees, θ_sky and ν_obs/ν_∞ of observers in free fall, from docs/format.md.
IN_FALL = [
    (3.0, 150.0, 2.80346030971, 0.666666666667),
    (1.0, 90.0, 2.09593421620, 1.0),
    (0.5, 60.0, 0.637155704008, 3.41421356237),
    (0.1, 90.0, 2.44296063518, 1.0),
    (0.011, 120.0, 3.01344404735, 0.173390972421),
]
#: r, motion: one of each kind of row.
KINDS = [(10.0, "rest"), (1.2, "rest"), (10.0, "fall"), (1.2, "fall"), (1.0, "fall"), (0.1, "fall")]


def directions_at(theta, azimuth=0.7):
    sin = np.sin(theta)
    return np.stack([sin * np.cos(azimuth), sin * np.sin(azimuth), -np.cos(theta)], axis=-1)


def binary(header, texels):
    """A `.lbt`."""
    head, data = _files.encode_header(header), np.asarray(texels, "<f4").tobytes()
    crc = struct.pack("<I", zlib.crc32(head + data))
    return b"LENSBAKE" + struct.pack("<II", header.version, len(head)) + head + data + crc


class Lookup(unittest.TestCase):
    def test_at_rest_it_is_the_closed_form(self):
        for r, degrees, bend in AT_REST:
            self.assertAlmostEqual(lensbake.bend(r, math.radians(degrees)), bend, delta=1e-7)

    def test_from_infinity_it_is_the_closed_form(self):
        row = lensbake.atlas().row(math.inf)
        for b, bend in FROM_INFINITY:
            self.assertAlmostEqual(row.bend_b(b), bend, delta=1e-7)
        self.assertTrue(math.isnan(row.bend_b(2.598)))
        self.assertAlmostEqual(lensbake.atlas().row(math.inf, "fall").bend_b(3.0), FROM_INFINITY[1][1], delta=1e-7)
        # From r = 1e9 the same rays are seen at sin θ = b √(1−1/r)/r.
        b = np.array([b for b, _ in FROM_INFINITY])
        near = lensbake.bend(1e9, b / 1e9 * math.sqrt(1 - 1e-9))
        np.testing.assert_allclose(near, row.bend_b(b), rtol=0, atol=1e-7)

    def test_in_fall_it_is_the_table_of_the_format(self):
        for r, degrees, sky, shift in IN_FALL:
            row, theta = lensbake.atlas().row(r, "fall"), math.radians(degrees)
            self.assertAlmostEqual(row.sky(theta), sky, delta=1e-11)
            self.assertAlmostEqual(row.shift(theta) / shift, 1.0, delta=1e-11)
            turned = row.directions(directions_at(theta, 0.0))
            self.assertAlmostEqual(math.atan2(turned[0], -turned[2]), sky, delta=1e-11)

    def test_the_shadow(self):
        for r, motion, degrees in [(3, "rest", 45.0), (1.5, "rest", 90.0), (10, "rest", 14.26902733)]:
            self.assertAlmostEqual(math.degrees(lensbake.atlas().row(r, motion).theta_c), degrees, delta=1e-8)
        for r, degrees in [(10, 10.31), (3, 24.20), (1, 42.10), (0.5, 53.27), (0.05, 77.33)]:
            self.assertAlmostEqual(math.degrees(lensbake.atlas().row(r, "fall").theta_c), degrees, delta=0.005)

    def test_captured_is_nan(self):
        for r, motion in KINDS:
            row = lensbake.atlas().row(r, motion)
            c = row.theta_c
            theta = np.array([0.0, -0.0, 1e-300, 0.5 * c, c - 1e-12, c + 1e-12, 0.5 * (c + math.pi), math.pi, math.nan])
            outside = [False] * 5 + [True] * 3 + [False]
            turned = row.directions(directions_at(theta))[:, 0]
            for found in (row.bend(theta), row.sky(theta), row.shift(theta), turned):
                np.testing.assert_array_equal(np.isfinite(found), outside, f"{r} {motion}")
                self.assertTrue(np.isnan(found[~np.array(outside)]).all())
            np.testing.assert_array_equal(row.captured(theta), [True] * 5 + [False] * 4)
        # Exactly at the edge, where x = 1: θ_c = 90°.
        row = lensbake.atlas().row(1.5)
        self.assertTrue(math.isnan(row.bend_cos(0.0, 1.0)))

    def test_straight_away_nothing_is_bent(self):
        for r, motion in KINDS:
            row = lensbake.atlas().row(r, motion)
            self.assertAlmostEqual(row.bend(math.pi), 0.0, delta=1e-12)
            self.assertAlmostEqual(row.bend(np.float32(math.pi)), 0.0, delta=1e-12)
            np.testing.assert_array_equal(row.directions([0, 0, 2]), [0, 0, 1])

    def test_all_entries_agree(self):
        theta = np.linspace(0.001, math.pi - 1e-6, 5001)
        for r, motion in KINDS + [(1e6, "rest"), (1e6, "fall")]:
            row = lensbake.atlas().row(r, motion)
            bend = row.bend(theta)
            np.testing.assert_allclose(row.bend_cos(np.cos(theta), np.sin(theta)), bend, rtol=0, atol=1e-10)
            np.testing.assert_allclose(row.sky(theta), theta - bend, rtol=0, atol=1e-14)
            sky = row.directions(3.0 * directions_at(theta))
            np.testing.assert_allclose(sky, directions_at(row.sky(theta)), rtol=0, atol=1e-10)

    def test_the_impact_parameter_of_a_view_angle(self):
        for r, motion in KINDS:
            row = lensbake.atlas().row(r, motion)
            theta = np.linspace(row.theta_c + 1e-4, math.pi - 1e-3, 500)
            b = r * row.shift(theta) * np.sin(theta)
            if r > 1:  # seen on the far side by the observer at rest
                boost = (1 + math.sqrt(1 / r)) / math.sqrt(1 - 1 / r) if motion == "fall" else 1.0
                away = boost * np.tan(theta / 2) > 1.0
                b = np.minimum(b, r / math.sqrt(1 - 1 / r))
            else:
                away = np.full(theta.shape, True)
            bend = np.where(away, row.bend_b(b, away=True), row.bend_b(b))
            np.testing.assert_allclose(bend, row.bend(theta), rtol=0, atol=1e-9)
        self.assertEqual(lensbake.atlas().row(math.inf).bend_b(5.0, away=True), 0.0)
        self.assertAlmostEqual(lensbake.atlas().row(3.0).bend_b(1e-200, away=True), 0.0, delta=1e-12)

    def test_rows_next_to_the_ends_are_not_extrapolated(self):
        table = lensbake.atlas()
        # The closed form, from `bake query --method exact`. The rows 124 to 127 and 0 to 3 are mixed.
        for r, degrees, bend in ENDS:
            self.assertAlmostEqual(lensbake.bend(r, math.radians(degrees)), bend, delta=1e-7)
        for motion, r, index in [("rest", math.inf, 0), ("fall", 1.0, 128), ("fall", 0.01, 191)]:
            np.testing.assert_allclose(table.row(r, motion).texels, table.texels[index], rtol=0, atol=1e-9)
        nearly = table.row(1 + 1e-13).texels
        np.testing.assert_allclose(nearly, table.texels[127], rtol=0, atol=1e-4)

    def test_shapes(self):
        row = lensbake.atlas().row(10.0)
        self.assertIs(type(row.bend(1)), float)
        self.assertIs(type(row.bend(np.float32(1))), float)
        self.assertIs(type(row.captured(1.0)), bool)
        self.assertIs(type(lensbake.bend(10, 1.0)), float)
        long = np.linspace(0.3, 3.0, 20001)
        one_by_one = [row.bend(angle) for angle in long[::1000]]
        np.testing.assert_allclose(row.bend(long)[::1000], one_by_one, rtol=0, atol=1e-14)
        for shape in [(0,), (1,), (3, 0, 2), (20001, 1), (59, 339), (3, 59, 113)]:
            some = np.resize(long, shape)
            found = row.bend(some)
            self.assertEqual((found.shape, found.dtype), (shape, np.float64))
            np.testing.assert_array_equal(found.ravel(), row.bend(some.ravel()))
        turned = np.resize(long, (59, 339)).T
        np.testing.assert_array_equal(row.bend(turned), row.bend(turned.copy()))
        self.assertEqual(row.bend_cos(np.zeros((4, 1)), np.ones(3)).shape, (4, 3))
        self.assertEqual(row.directions(np.ones((5, 7, 3))).shape, (5, 7, 3))
        self.assertEqual(row.bend([1.0, 2.0]).tolist(), [row.bend(1.0), row.bend(2.0)])

    def test_many_radii(self):
        r, theta = np.array([[10.0], [3.0], [10.0]]), np.array([1.0, 2.0, 0.1, 3.0])
        expected = np.array([lensbake.atlas().row(float(one)).bend(theta) for one in r[:, 0]])
        np.testing.assert_array_equal(lensbake.bend(r, theta), expected)
        self.assertEqual(lensbake.bend([2.0, 3.0], 1.5).shape, (2,))
        self.assertEqual(lensbake.bend(np.empty(0), 1.0).shape, (0,))

    def test_threads_do_not_disturb_each_other(self):
        row, theta = lensbake.atlas().row(10.0), np.linspace(0.3, 3.0, 50000)
        expected = row.bend(theta)
        with ThreadPoolExecutor(4) as pool:
            for found in pool.map(row.bend, [theta] * 16):
                np.testing.assert_array_equal(found, expected)

    def test_refusals(self):
        table, row = lensbake.atlas(), lensbake.atlas().row(10.0)
        for r, motion in [(1.0, "rest"), (0.5, "rest"), (0.0099, "fall"), (0.0, "fall"), (-1.0, "fall")]:
            with self.assertRaisesRegex(ValueError, "r"):
                table.row(r, motion)
        for call in (
            lambda: table.row(math.nan),
            lambda: table.row(10, "orbit"),
            lambda: table.row(1e200),
            lambda: table.row(math.inf).bend(0.1),
            lambda: table.row(math.inf).directions([0, 0, 1]),
            lambda: row.bend(-1e-9),
            lambda: row.bend([1.0, 3.15]),
            lambda: row.bend([math.nan, 3.15]),
            lambda: row.bend_cos(0.6, -0.8),
            lambda: row.bend_b(0.0),
            lambda: row.bend_b(11.0),
            lambda: row.directions([1.0, 2.0]),
            lambda: lensbake.bend([10.0, 1.0], 0.5),
        ):
            self.assertRaises(ValueError, call)


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "table.lbt")
        with open(BUILT_IN, "rb") as file:
            self.bytes = file.read()

    def read(self, data):
        with open(self.path, "wb") as file:
            file.write(data)
        return lensbake.read(self.path)

    def refused(self, data):
        """The message with which a damaged file is refused: one line that names the file."""
        with self.assertRaises(lensbake.TableError) as caught:
            self.read(data)
        message = str(caught.exception)
        self.assertIn(self.path, message)
        self.assertNotIn("\n", message)
        return message

    def test_the_built_in_table(self):
        header = lensbake.atlas().header
        self.assertEqual((header.version, header.axis, header.row_map), (2, "residual", "chi+ln-u"))
        self.assertEqual((header.rows, header.rows_below, header.texels, header.r_min), (192, 64, 64, 0.01))
        self.assertEqual((header.solver, header.tolerance), ("RK4 with step doubling", 1e-9))
        self.assertEqual(header.measured.rays, 97917)
        self.assertIs(lensbake.atlas(), lensbake.atlas())
        self.assertEqual(binary(header, lensbake.atlas().texels), self.bytes)

    @unittest.skipUnless(os.path.exists(ASSETS), "outside of the repository")
    def test_the_built_in_table_is_that_of_the_repository(self):
        with open(os.path.join(ASSETS, "atlas.lbt"), "rb") as file:
            self.assertEqual(file.read(), self.bytes)

    @unittest.skipUnless(OpenEXR and os.path.exists(ASSETS), "needs OpenEXR and the repository")
    def test_the_openexr_file_is_the_same_table(self):
        path = os.path.join(ASSETS, "atlas.exr")
        table = lensbake.read(path)
        self.assertEqual(table.header, lensbake.atlas().header)
        np.testing.assert_array_equal(table.texels, lensbake.atlas().texels)
        with open(path, "rb") as file:
            data = bytearray(file.read())
        at = data.index(b"lensbake.texels\0int\0\4\0\0\0") + 24
        for wrong in (b"\xff\xff\xff\x7f", b"\x20\0\0\0", b"\0\0\0\0"):
            self.refused(data[:at] + wrong + data[at + 4 :])
        crc = data.index(b"lensbake.crc32\0int\0\4\0\0\0") + 23
        data[crc] ^= 1
        self.assertIn("checksum", self.refused(data))
        self.refused(data[:1000])

    def test_version_1_and_other_tables(self):
        above = lensbake.atlas().texels[:128]
        header = lensbake.atlas().header._replace(
            version=1, row_map="chi", rows=128, rows_below=0, r_min=None, measured_below=None
        )
        table = self.read(binary(header, above))
        self.assertEqual(table.header, header)
        self.assertEqual(table.row(7.0).bend(1.0), lensbake.bend(7.0, 1.0))
        with self.assertRaisesRegex(ValueError, "r > 1"):
            table.row(1.0, "fall")
        one = header._replace(version=2, row_map="one", rows=1, inverse_radius=0.0)
        table = self.read(binary(one, above[:1]))
        self.assertAlmostEqual(table.row(math.inf).bend_b(3.0), FROM_INFINITY[1][1], delta=1e-7)
        with self.assertRaisesRegex(ValueError, "only the row of r = inf"):
            table.row(2.0)
        in_b = one._replace(axis="b", b_min=2.6, b_max=100.0)
        table = self.read(binary(in_b, above[:1]))
        self.assertEqual(table.header, in_b)
        with self.assertRaisesRegex(lensbake.TableError, "axis"):
            table.row(math.inf)

    def test_damaged_files_are_refused(self):
        for length in [0, 5, 8, 15, 16, 17, 100, 138, 139, 1000, len(self.bytes) - 1]:
            self.refused(self.bytes[:length])
        self.refused(self.bytes + b"\0")
        for at in range(0, 500):
            for bit in (1, 0x80):
                data = bytearray(self.bytes)
                data[at] ^= bit
                self.refused(data)

    def test_sizes_that_no_table_has_are_refused_before_anything_is_allocated(self):
        header = lensbake.atlas().header
        for wrong in (
            {"texels": 2**32 - 1},
            {"rows": 2**32 - 1 + 64},
            {"texels": 65536, "rows": 4096 + 64},
            {"texels": 65536, "rows": 64},
            {"texels": 3},
            {"rows_below": 0, "rows": 128},
            {"r_min": 1.0},
            {"r_min": math.nan},
        ):
            self.refused(binary(header._replace(**wrong), lensbake.atlas().texels))
        texels = lensbake.atlas().texels.copy()
        texels[3, 5, 1] = math.nan
        self.assertIn("texel 5 of row 3", self.refused(binary(header, texels)))
        with open(self.path, "wb") as file:
            file.truncate(1 << 40)  # a sparse file of 1 TiB
        self.assertRaisesRegex(lensbake.TableError, "larger", lensbake.read, self.path)

    def test_a_missing_file_is_an_error_of_the_system(self):
        self.assertRaises(FileNotFoundError, lensbake.read, self.path)


if __name__ == "__main__":
    unittest.main()
