"""Reads channels of a picture with OpenEXR's own library and writes them to standard output: width and height as u32,
then the channels that the arguments after the file name, at each pixel, as f32, from the top row to the bottom one, all
little-endian."""

import struct
import sys

import numpy
import OpenEXR

with OpenEXR.File(sys.argv[1], separate_channels=True) as file:
    planes = [file.channels()[name].pixels for name in sys.argv[2:]]
if any(plane.dtype != numpy.float32 for plane in planes):
    sys.exit("a channel is not of 32-bit floats")
height, width = planes[0].shape
pixels = numpy.stack(planes, axis=-1).astype("<f4")
sys.stdout.buffer.write(struct.pack("<II", width, height) + pixels.tobytes())
