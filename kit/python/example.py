"""Draws a sky of coloured squares behind a black hole, as a PNG: `python example.py [file] [r] [motion]`."""

import struct
import sys
import zlib

import numpy as np

import lensbake

WIDTH, HEIGHT, ACROSS = 640, 360, 90.0  # pixels, degrees
SAMPLES = 3  # along each side of a pixel


def view_directions():
    """Directions of the samples, array (height, width, 3), for a camera that looks at the hole, along −Z."""
    half = np.tan(np.radians(ACROSS) / 2.0)
    x = half * ((np.arange(WIDTH * SAMPLES) + 0.5) / (WIDTH * SAMPLES) * 2.0 - 1.0)
    y = half * HEIGHT / WIDTH * (1.0 - (np.arange(HEIGHT * SAMPLES) + 0.5) / (HEIGHT * SAMPLES) * 2.0)
    x, y = np.meshgrid(x, y)
    return np.stack([x, y, -np.ones_like(x)], axis=-1)


def sky(d):
    """Colour of the sky in the directions `d`: squares of 10°, and a white sun straight behind the hole."""
    longitude, latitude = np.arctan2(d[..., 0], -d[..., 2]), np.arcsin(np.clip(d[..., 1], -1.0, 1.0))
    squares = (np.floor(longitude / np.radians(10.0)) + np.floor(latitude / np.radians(10.0))) % 2.0
    colour = (0.3 + 0.5 * squares)[..., None] * (0.6 + 0.4 * d)
    return np.where(d[..., 2:] < -np.cos(np.radians(1.5)), 1.0, colour)


def write_png(name, picture):
    bytes_ = (255.0 * np.clip(picture, 0.0, 1.0) ** (1.0 / 2.2) + 0.5).astype(np.uint8)
    height, width, _ = bytes_.shape
    lines = b"".join(b"\0" + line.tobytes() for line in bytes_)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    with open(name, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)))
        file.write(chunk(b"IDAT", zlib.compress(lines, 9)) + chunk(b"IEND", b""))


def main(name="picture.png", r="12", motion="rest"):
    from_where = lensbake.atlas().row(float(r), motion).directions(view_directions())
    samples = np.nan_to_num(sky(from_where))  # captured: black
    write_png(name, samples.reshape(HEIGHT, SAMPLES, WIDTH, SAMPLES, 3).mean(axis=(1, 3)))


if __name__ == "__main__":
    main(*sys.argv[1:])
