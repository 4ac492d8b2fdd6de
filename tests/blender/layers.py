"""Reads a picture with layers in Blender's compositor, compares each layer with what OpenEXR's own library reads, and swaps
the sky as docs/layers.md says. Run by scripts/layers-blender.sh."""

import argparse
import pathlib
import struct
import subprocess
import sys

import bpy
import numpy

READER = pathlib.Path(__file__).parents[1] / "readers" / "read_openexr.py"
WIDTH, HEIGHT = 640, 360
# The passes that Blender makes of the layers, and the channels in each, in its order.
PASSES = {
    "captured": ["captured.V"],
    "direction": ["direction.X", "direction.Y", "direction.Z"],
    "magnification": ["magnification.V"],
    "order": ["order.V"],
    "shift": ["shift.V"],
    "uv": ["uv.U", "uv.V"],
}
# Largest difference of the swapped sky from the one that the viewer draws, of light between 0 and 1.
SWAP_BOUND = 2e-3


def read(python, file, channels):
    """The channels of an OpenEXR file by OpenEXR's own library: [height, width, channel], row 0 at the top."""
    output = subprocess.run([python, READER, file, *channels], check=True, stdout=subprocess.PIPE).stdout
    width, height = struct.unpack("<II", output[:8])
    return numpy.frombuffer(output[8:], "<f4").reshape(height, width, len(channels))


def write_panorama(file):
    """A smooth panorama without a symmetry, in 32-bit floats."""
    width, height = 2048, 1024
    longitude = 2 * numpy.pi * ((numpy.arange(width) + 0.5) / width - 0.5)
    latitude = numpy.pi * ((numpy.arange(height) + 0.5) / height - 0.5)
    latitude, longitude = latitude[:, None], longitude[None, :]
    x, y = numpy.cos(latitude) * numpy.sin(longitude), numpy.sin(latitude) + 0 * longitude
    z = -numpy.cos(latitude) * numpy.cos(longitude)
    light = [0.5 + 0.4 * numpy.sin(phase) for phase in (5 * x + y, 7 * y + 0.3, 6 * z - x)]
    pixels = numpy.stack([*light, numpy.ones_like(x)], axis=-1).astype(numpy.float32)
    image = bpy.data.images.new("panorama", width, height, alpha=False, float_buffer=True)
    # Blender's first row is the bottom one.
    image.pixels.foreach_set(pixels.ravel())
    image.filepath_raw, image.file_format = str(file), "OPEN_EXR"
    image.save()


class Compositor:
    """Blender's compositor, with a picture."""

    def __init__(self, picture, size, work):
        self.work = work
        self.scene = bpy.context.scene
        self.tree = bpy.data.node_groups.new("compositor", "CompositorNodeTree")
        self.scene.compositing_node_group = self.tree
        self.tree.interface.new_socket("Image", in_out="OUTPUT", socket_type="NodeSocketColor")
        self.output = self.tree.nodes.new("NodeGroupOutput")
        self.picture = self.image(picture)
        render = self.scene.render
        (render.resolution_x, render.resolution_y), render.resolution_percentage = size, 100
        render.image_settings.file_format = "OPEN_EXR"
        render.image_settings.color_depth = "32"

    def image(self, file):
        node = self.tree.nodes.new("CompositorNodeImage")
        node.image = bpy.data.images.load(str(file))
        return node

    def result(self, socket, python):
        """What `socket` puts out, as a picture."""
        self.tree.links.new(socket, self.output.inputs[0])
        file = self.work / "result.exr"
        self.scene.render.filepath = str(file)
        bpy.ops.render.render(write_still=True)
        return read(python, file, "RGB")

    def swapped(self, panorama):
        """The socket of the picture with `panorama` for a sky. Map UV multiplies by the third component of its UV, which is
        made to be 1 − captured."""
        links, nodes = self.tree.links, self.tree.nodes
        sky = nodes.new("ShaderNodeMath")
        sky.operation = "SUBTRACT"
        sky.inputs[0].default_value = 1
        links.new(self.picture.outputs["captured"], sky.inputs[1])
        apart = nodes.new("ShaderNodeSeparateXYZ")
        links.new(self.picture.outputs["uv"], apart.inputs[0])
        together = nodes.new("ShaderNodeCombineXYZ")
        for component, socket in enumerate([apart.outputs[0], apart.outputs[1], sky.outputs[0]]):
            links.new(socket, together.inputs[component])
        map_uv = nodes.new("CompositorNodeMapUV")
        map_uv.inputs["Extension X"].default_value = "Repeat"
        map_uv.inputs["Extension Y"].default_value = "Extend"
        sky_picture = self.image(panorama)
        # Blender has tagged the file that it wrote as sRGB.
        sky_picture.image.colorspace_settings.name = "Linear Rec.709"
        links.new(sky_picture.outputs["Image"], map_uv.inputs["Image"])
        links.new(together.outputs[0], map_uv.inputs["UV"])
        return map_uv.outputs[0]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--viewer", required=True)
    parser.add_argument("--python", required=True, help="with OpenEXR")
    parser.add_argument("--work", required=True, type=pathlib.Path)
    args = parser.parse_args()
    args.work.mkdir(parents=True, exist_ok=True)
    picture, panorama = args.work / "picture.exr", args.work / "panorama.exr"
    write_panorama(panorama)
    scene = ["--size", f"{WIDTH}x{HEIGHT}", "-r", "6", "--motion", "orbit", "--yaw", "10", "-s", panorama, "-d", "cpu"]
    layers = ["--aov", "all", "--sampling", "single"]
    subprocess.run([args.viewer, "render", *scene, *layers, "-o", picture], check=True)
    compositor = Compositor(picture, (WIDTH, HEIGHT), args.work)
    outputs = compositor.picture.outputs
    failed = False
    for name, channels in PASSES.items():
        expected = read(args.python, picture, channels)
        found = compositor.result(outputs[name], args.python)[..., : len(channels)]
        off = numpy.abs(found - expected).max()
        print(f"{name}: {len(channels)} channels, largest difference {off:.1e}")
        failed |= off > 0 or not expected.any()
    drawn = read(args.python, picture, "RGB")
    off = numpy.abs(compositor.result(compositor.swapped(panorama), args.python) - drawn)
    print(f"sky swapped by uv: largest difference {off.max():.1e}, mean {off.mean():.1e}")
    failed |= off.max() > SWAP_BOUND
    sys.exit(1 if failed else 0)


main()
