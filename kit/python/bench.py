"""How many rays a second the lookup answers on one core, and how far it is off the closed form.

    python bench.py [path of the program bake]

Speeds are of float64 arrays of a million rays: the best and the median of 15 repeats by the clock, and the best by the
CPU time of the process, which other programs disturb less. The largest error needs the program `bake`, whose
`query --method exact` is the reference.
"""

import math
import os
import platform
import statistics
import subprocess
import sys
import time

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"  # before numpy is loaded

import numpy as np  # noqa: E402

import lensbake  # noqa: E402

RAYS = 1_000_000
REPEATS = 15


def speed(name, call):
    call()
    wall, cpu = [], []
    for _ in range(REPEATS):
        start = time.perf_counter(), time.process_time()
        call()
        wall.append(time.perf_counter() - start[0])
        cpu.append(time.process_time() - start[1])
    best, median, by_cpu = (RAYS / 1e6 / seconds for seconds in (min(wall), statistics.median(wall), min(cpu)))
    print(f"{name:46} best {best:6.1f}   median {median:6.1f}   best by CPU time {by_cpu:6.1f}")


def speeds():
    print(f"numpy {np.__version__}, Python {platform.python_version()}; million rays a second on one core")
    rng = np.random.default_rng(1)
    for r, motion in ((10.0, "rest"), (1.5, "rest"), (10.0, "fall"), (0.5, "fall")):
        row = lensbake.atlas().row(r, motion)
        # r = 10: outside the shadow. The others: all directions, about half of them captured at r = 1.5.
        theta = rng.uniform(row.theta_c if r == 10.0 else 0.0, math.pi, RAYS)
        azimuth = rng.uniform(0.0, 2.0 * math.pi, RAYS)
        cos, sin = np.cos(theta), np.sin(theta)
        d = np.stack([sin * np.cos(azimuth), sin * np.sin(azimuth), -cos], axis=-1)
        of = f"r = {r:g}, {motion}"
        speed(f"{of}: bend(theta)", lambda: row.bend(theta))
        speed(f"{of}: bend_cos(cos, sin)", lambda: row.bend_cos(cos, sin))
        speed(f"{of}: directions(d)", lambda: row.directions(d))


def rays(rng, row, count):
    """View angles in degrees outside the shadow: a half uniform, a half with 1 − x from 1e-6 to 1."""
    wide = np.degrees(rng.uniform(row.theta_c, math.pi, count // 2))
    x = 1.0 - 10.0 ** rng.uniform(-6.0, 0.0, count - count // 2)
    near = np.degrees(2.0 * np.arctan2(math.tan(row.theta_c / 2.0), x))
    return np.concatenate([wide, near])


def error(bake, name, radii, motion, per_row=200):
    rng = np.random.default_rng(2)
    degrees = [rays(rng, lensbake.atlas().row(r, motion), per_row) for r in radii]
    lines = "".join(f"{float(r)!r} {float(t)!r}\n" for r, angles in zip(radii, degrees) for t in angles)
    command = [bake, "query", "--method", "exact", "--motion", motion]
    answers = subprocess.run(command, input=lines, capture_output=True, text=True, check=True).stdout.split()
    exact = np.array([math.nan if a == "captured" else float(a) for a in answers]).reshape(len(radii), -1)
    found = {"bend": [], "bend_cos": [], "directions": []}
    for r, angles, bend in zip(radii, degrees, exact):
        row, theta = lensbake.atlas().row(r, motion), np.radians(angles)
        cos, sin = np.cos(theta), np.sin(theta)
        sky = row.directions(np.stack([sin, 0.0 * sin, -cos], axis=-1))
        turn = np.arctan2(sky[:, 0], -sky[:, 2]) - (theta - bend)
        # Whether a ray is captured is a matter of rounding where 1 − x is about 1e-16; none of these is as close.
        assert np.array_equal(np.isnan(bend), np.isnan(row.bend(theta)))
        found["bend"].append(np.nanmax(np.abs(row.bend(theta) - bend)))
        found["bend_cos"].append(np.nanmax(np.abs(row.bend_cos(cos, sin) - bend)))
        found["directions"].append(np.nanmax(np.abs(np.remainder(turn + math.pi, 2.0 * math.pi) - math.pi)))
    errors = ", ".join(f"{key} {max(of):.2e}" for key, of in found.items())
    print(f"{name:24} {exact.size} rays, largest error in rad: {errors}")


def errors(bake):
    rng = np.random.default_rng(3)
    above = 1.0 / np.sin(rng.uniform(1e-3, math.asin(math.sqrt(1.0 / 1.005)), 400)) ** 2
    error(bake, "at rest, r > 1.005", above, "rest")
    error(bake, "in fall, r > 1", 1.0 / rng.uniform(1e-6, 1.0, 400), "fall")
    error(bake, "in fall, 0.1 <= r <= 1", 10.0 ** rng.uniform(-1.0, 0.0, 200), "fall")
    error(bake, "in fall, 0.01 <= r < 0.1", 10.0 ** rng.uniform(-2.0, -1.0, 200), "fall")


if __name__ == "__main__":
    speeds()
    if len(sys.argv) > 1:
        errors(sys.argv[1])
