"""Draws layers.jpg, a picture and its layers in false colours, from an .exr with all layers. Needs numpy, OpenEXR, Pillow.

    viewer render -o frame.exr --aov all --size 480x270 -r 5 --motion orbit --yaw 25 --fov 100
    python docs/layers/figure.py frame.exr docs/layers/layers.jpg
"""

import sys

import numpy as np
import OpenEXR
from PIL import Image, ImageDraw, ImageFont

with OpenEXR.File(sys.argv[1], separate_channels=True) as file:
    channel = {name: channel.pixels for name, channel in file.channels().items()}


def stack(*names):
    return np.stack([channel[name] for name in names], axis=-1)


def blend(value, *colours):
    """Colours for values from 0 to 1, evenly spaced."""
    colours = np.array(colours)
    place = np.clip(value, 0, 1) * (len(colours) - 1)
    low = np.minimum(place.astype(int), len(colours) - 2)
    part = (place - low)[..., None]
    return colours[low] * (1 - part) + colours[low + 1] * part


def shown(light):
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * np.maximum(light, 1e-9) ** (1 / 2.4) - 0.055)


BLUE, WHITE, RED, BLACK = (0.15, 0.3, 0.9), (1, 1, 1), (0.85, 0.15, 0.1), (0, 0, 0)
sky = 1 - channel["captured.V"][..., None]
uv = stack("uv.U", "uv.V")
# A panorama made of nothing but its coordinates: squares of 10°.
squares = (np.floor(uv[..., 0] * 36) + np.floor(uv[..., 1] * 18)) % 2
swapped = blend(squares * 0.75 + 0.25 * uv[..., 1], (0.1, 0.1, 0.3), (0.9, 0.5, 0.2), (1, 1, 0.8)) * sky
# From 1/4 to 4 times the frequency, and from 1/32 to 32 times the area; the sign as the colour.
octaves = np.log2(np.maximum(channel["shift.V"], 1e-9)) / 2
magnification = channel["magnification.V"]
area = 0.5 + np.log2(np.maximum(abs(magnification), 1e-9)) / 10
PANELS = [
    ("picture", shown(np.clip(stack("R", "G", "B"), 0, 1))),
    ("direction: X, Y, Z as red, green, blue", (0.5 + 0.5 * stack(*("direction." + axis for axis in "XYZ"))) * sky),
    ("shift: red 1/2, white 1, blue 2", blend(0.5 + octaves, RED, WHITE, BLUE) * sky),
    (
        "magnification: bright is large, red is mirrored",
        np.where(magnification[..., None] < 0, blend(area, BLACK, RED, WHITE), blend(area, BLACK, BLUE, WHITE)) * sky,
    ),
    ("order: 0 blue, 1 red, 2 and more white", blend(channel["order.V"] / 2, BLUE, RED, WHITE) * sky),
    ("uv: U as red, V as green", np.concatenate([uv, 0 * sky], axis=-1)),
    ("captured", np.repeat(1 - sky, 3, axis=-1)),
    ("another sky by uv", swapped),
]
COLUMNS, MARGIN, TITLE = 4, 6, 24
height, width = sky.shape[:2]
cell = (width + MARGIN, height + TITLE + MARGIN)
rows = -(-len(PANELS) // COLUMNS)
sheet = Image.new("RGB", (COLUMNS * cell[0] + MARGIN, rows * cell[1] + MARGIN), "white")
for index, (title, colours) in enumerate(PANELS):
    x, y = MARGIN + index % COLUMNS * cell[0], MARGIN + index // COLUMNS * cell[1]
    ImageDraw.Draw(sheet).text((x, y), title, "black", ImageFont.load_default(17))
    pixels = (255 * np.clip(colours, 0, 1) + 0.5).astype(np.uint8)
    sheet.paste(Image.fromarray(pixels), (x, y + TITLE))
sheet.save(sys.argv[2], quality=88)
