"""Draws with Cycles through lensbake.osl, and compares every pixel with the closed form and pictures with the viewer's.

    python test_lensbake.py --bake BAKE --viewer VIEWER --work FOLDER [--picture FILE.png]

needs the packages bpy and numpy. It sets the camera up by setup_lensbake.py, as a user does. --picture also draws the
picture of the README. Exit code 1 if an error exceeds its bound.
"""

import argparse
import contextlib
import math
import os
import runpy
import shutil
import subprocess
import sys
import time

import bpy
import numpy as np
from mathutils import Matrix

KIT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
WIDTH, HEIGHT = 480, 270

# The largest errors of all views; behind them, what bpy 5.0.1 gives on x86-64.
# A view direction and a direction on the sky are three f32 each, in Cycles as in the world shader. Rounding the former
# by e moves the latter by e dθ'/dθ, so the error is bounded in rad after division by 1 + |dθ'/dθ|.
MAX_RAD = 1e-6  # 7.8e-7
# In image space, of pixels WIDTH wide. The largest is in the view 1° across, where rounding by 1.2e-7 is 3e-3 pixels.
MAX_PX = 7e-3  # 5.2e-3
# Where only one of the two takes the ray for captured: how far it is from the edge of the shadow.
MAX_EDGE_PX = 2e-3  # none
# Of the picture against the viewer's, out of 255. Both are means over the pixel; they differ near the edge of the
# shadow, where the whole sky lies within a few pixels: 64 samples against the viewer's filter.
MAX_MEAN, MAX_999 = 0.1, 8.0  # 0.071, 5.9


@contextlib.contextmanager
def quiet():
    """Keeps Blender's progress, which it writes past Python, off the standard output."""
    sys.stdout.flush()
    kept, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        yield
    finally:
        sys.stdout.flush()
        os.dup2(kept, 1)
        os.close(kept)
        os.close(nowhere)


def setup(folder, *options):
    """Runs the set-up script in `folder` with command-line options, as Blender does."""
    sys.argv = ["blender", "--", *map(str, options)]
    with quiet():
        runpy.run_path(os.path.join(folder, "setup_lensbake.py"), run_name="__main__")
    return bpy.data.objects["Lensbake"]


def empty_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def new_world():
    """A world without nodes but a background and an output: returns the nodes, the links, and the background."""
    world = bpy.data.worlds.new("Test")
    bpy.context.scene.world = world
    if world.node_tree is None:
        world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    nodes.clear()
    background, output = nodes.new("ShaderNodeBackground"), nodes.new("ShaderNodeOutputWorld")
    links.new(background.outputs[0], output.inputs["Surface"])
    return nodes, links, background


def pixels(path):
    """The RGB of a picture as it is in the file, array (height, width, 3), the top row first."""
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    width, height = image.size
    values = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(values)
    bpy.data.images.remove(image)
    return values.reshape(height, width, -1)[::-1, :, :3].astype(np.float64)


def render(path):
    """Renders the scene to a 32-bit EXR file, in linear light. Returns its pixels."""
    scene = bpy.context.scene
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_mode = "RGB"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = path
    with quiet():
        bpy.ops.render.render(write_still=True)
    return pixels(path)


def render_size(width, height):
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100


def exact(bake, r, theta):
    """The bending in rad by the closed form, NaN where the ray is captured."""
    lines = "".join(f"{r!r} {degrees!r}\n" for degrees in np.degrees(theta).ravel().tolist())
    command = [bake, "query", "--method", "exact"]
    answers = subprocess.run(command, input=lines, capture_output=True, text=True, check=True).stdout.split()
    return np.array([math.nan if a == "captured" else float(a) for a in answers]).reshape(theta.shape)


def shadow_angle(r):
    """Angular radius of the shadow for the observer at rest at r: sin θ_c = (3√3/2) √(1 − 1/r) / r."""
    angle = math.asin(min(1.5 * math.sqrt(3.0) * math.sqrt(1.0 - 1.0 / r) / r, 1.0))
    return angle if r >= 1.5 else math.pi - angle


def angle_between(a, b):
    return np.arctan2(np.linalg.norm(np.cross(a, b), axis=-1), np.sum(a * b, axis=-1))


def view(camera, pan, tilt, roll):
    """The orientation of a plain camera with the same view, and the direction of the hole, in the world."""
    across = camera.matrix_world.to_3x3().normalized()
    # The camera object looks at the hole. In its frame, X is to the right, Y up, and the axis along −Z.
    turned = across.to_4x4()
    for axis, degrees in (("Y", -pan), ("X", tilt), ("Z", -roll)):
        turned = turned @ Matrix.Rotation(math.radians(degrees), 4, axis)
    return turned, -np.array(across, np.float64)[:, 2]


def compare_directions(bake, work, camera, r, fov, pan, tilt, roll):
    """One line of the table. The camera must be set up, and the world show its direction as its colour."""
    scene, data = bpy.context.scene, camera.data
    for name, value in dict(radius=r, field_of_view=fov, pan=pan, tilt=tilt, roll=roll).items():
        data.cycles_custom[name] = float(value)
    data.update_tag()
    start = time.perf_counter()
    seen = render(os.path.join(work, "bent.exr"))
    seconds = time.perf_counter() - start

    # Cycles jitters the ray inside the pixel. Its own perspective camera does so by the same random numbers: it
    # tells the undeflected direction of each ray, and shares no code with the shader.
    plain_data = bpy.data.cameras.new("Plain")
    plain_data.sensor_fit, plain_data.angle = "HORIZONTAL", math.radians(fov)
    plain = bpy.data.objects.new("Plain", plain_data)
    plain.matrix_world, hole = view(camera, pan, tilt, roll)
    scene.collection.objects.link(plain)
    scene.camera = plain
    undeflected = render(os.path.join(work, "plain.exr"))
    scene.camera = camera
    across = np.array(plain.matrix_world.to_3x3(), np.float64)
    bpy.data.objects.remove(plain)
    bpy.data.cameras.remove(plain_data)
    assert np.abs(np.linalg.norm(undeflected, axis=-1) - 1.0).max() < 1e-6, "the picture is not linear light"
    undeflected /= np.linalg.norm(undeflected, axis=-1, keepdims=True)

    # That camera itself: its rays pass through the centres of the pixels but for the jitter.
    pitch = 2.0 * math.tan(0.5 * math.radians(fov)) / WIDTH
    local = undeflected @ across
    x, y = local[..., 0] / -local[..., 2] / pitch, local[..., 1] / -local[..., 2] / pitch
    columns, rows = np.arange(WIDTH) + 0.5 - 0.5 * WIDTH, 0.5 * HEIGHT - 0.5 - np.arange(HEIGHT)
    assert max(np.abs(x - columns).max(), np.abs(y - rows[:, None]).max()) < 0.01, "the plain camera's view differs"
    # The smallest angle between neighbouring pixels: across the direction from the picture's centre it is larger.
    pixel = pitch * local[..., 2] ** 2

    theta = angle_between(undeflected, hole)
    beyond = theta - shadow_angle(r)
    step = np.minimum(0.05 * pixel, 0.1 * np.abs(beyond))
    bend, less, more = exact(bake, r, np.stack([theta, theta - step, theta + step]))
    stretch = np.abs(1.0 - (more - less) / (2.0 * step))

    captured, seen_captured = np.isnan(bend), ~seen.any(axis=-1)
    wrong = captured != seen_captured
    edge_px = (np.abs(beyond) / pixel)[wrong].max(initial=0.0)
    sky = ~captured & ~seen_captured
    off_hole = undeflected - np.sum(undeflected * hole, axis=-1, keepdims=True) * hole
    off_hole /= np.linalg.norm(off_hole, axis=-1, keepdims=True)
    sky_theta = (theta - bend)[..., None]
    expected = np.cos(sky_theta) * hole + np.sin(sky_theta) * off_hole
    tangent = np.cos(sky_theta) * off_hole - np.sin(sky_theta) * hole
    error = angle_between(seen, expected)
    # In image space: the part of the error in the plane of the ray, by which the picture is shifted.
    shift = np.abs(np.arctan2(np.sum(seen * tangent, axis=-1), np.sum(seen * expected, axis=-1))) / (stretch * pixel)
    scaled = error / (1.0 + stretch)
    weak = sky & (stretch < 2.0)
    figures = dict(
        sky=int(sky.sum()),
        px=shift[sky].max(initial=0.0),
        rad=scaled[sky].max(initial=0.0),
        rad_weak=error[weak].max(initial=0.0),
        rad_all=error[sky].max(initial=0.0),
        wrong=int(wrong.sum()),
        edge_px=edge_px,
    )
    few = f"{figures['rad_weak']:8.1e}" if weak.any() else "       -"
    print(
        f"{r:6g} {fov:4g} {pan:4g} {tilt:4g} {roll:5g} {figures['sky']:7d} {figures['px']:8.1e}"
        f" {figures['rad']:10.1e} {few} {figures['rad_all']:8.1e} {figures['wrong']:4d} {edge_px:7.1e} {seconds:5.2f}",
        flush=True,
    )
    return figures


def check_directions(bake, work):
    """Whether all directions are within the bounds."""
    empty_scene()
    nodes, links, background = new_world()
    links.new(nodes.new("ShaderNodeTexCoord").outputs["Generated"], background.inputs["Color"])
    camera = setup(work)
    scene = bpy.context.scene
    scene.cycles.samples = 1
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 0.01
    render_size(WIDTH, HEIGHT)
    print(f"Cycles, {WIDTH}x{HEIGHT}, one ray a pixel, against the closed form: the largest error of all pixels")
    print(
        "                             pixels  error    error rad  error rad where       captured differently\n"
        "                                 of     px    over      |dθ'/dθ|     any-      and px from\n"
        "     r  fov  pan tilt  roll the sky           1+|dθ'/dθ|      < 2    where     the edge       s",
        flush=True,
    )
    # Up to r = 1.5 the shadow fills the half of the view towards the hole: look away.
    views = [(r, 90, 180, 0, 0) for r in (1.01, 1.2, 1.5)] + [(r, 90, 0, 0, 0) for r in (3, 10, 100, 1000)]
    views += [(1.01, 150, 180, 0, 0), (1.2, 60, 150, 20, 0), (1.5, 120, 100, 30, 15), (3, 30, 50, -10, 200)]
    views += [(10, 20, 15, -5, 30), (10, 170, -60, 45, -75), (100, 4, 1, 0.5, 45), (1000, 1, 0, 0, 0)]
    results = []
    for number, values in enumerate(views):
        # Along an axis of the world, then in any other direction, and not at the origin.
        turned = number >= 7
        camera.location = (3.0, -20.0, 7.0) if turned else (0.0, 0.0, 0.0)
        camera.rotation_euler = (1.1, 0.3, -0.7) if turned else (0.5 * math.pi, 0.0, 0.0)
        bpy.context.view_layer.update()
        results.append(compare_directions(bake, work, camera, *values))
    largest = {name: max(result[name] for result in results) for name in results[0]}
    ok = largest["px"] <= MAX_PX and largest["rad"] <= MAX_RAD and largest["edge_px"] <= MAX_EDGE_PX
    print(
        f"largest: {largest['px']:.1e} px (bound {MAX_PX:g}), {largest['rad']:.1e} rad (bound {MAX_RAD:g}), captured"
        f" differently up to {largest['edge_px']:.1e} px from the edge (bound {MAX_EDGE_PX:g})"
    )
    # A view without sky would have no error.
    return ok and all(result["sky"] > 0 for result in results)


def panorama(width):
    """A smooth sky of soft lines every 15° and a gradient, array (height, width, 3); the middle column is 0°."""
    longitude = (np.arange(width) + 0.5) / width * 2.0 * math.pi - math.pi
    latitude = 0.5 * math.pi - (np.arange(width // 2) + 0.5) / width * 2.0 * math.pi
    longitude, latitude = np.meshgrid(longitude, latitude)
    d = np.stack([np.cos(latitude) * np.sin(longitude), np.sin(latitude), -np.cos(latitude) * np.cos(longitude)], -1)
    # Distance from the nearest line, as an angle on the sky.
    period = math.radians(15.0)
    off = [np.abs((angle + 0.5 * period) % period - 0.5 * period) for angle in (longitude, latitude)]
    off[0] = off[0] * np.cos(latitude)
    lines = np.exp(-((np.minimum(*off) / math.radians(0.8)) ** 2)) * np.cos(latitude)
    return 0.25 + 0.2 * d + 0.35 * lines[..., None] * np.array([1.0, 0.9, 0.7])


def srgb(light):
    light = np.clip(light, 0.0, 1.0)
    return 255.0 * np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1.0 / 2.4) - 0.055)


def check_picture(viewer, work):
    """Whether Cycles draws the viewer's picture of the same panorama."""
    empty_scene()
    sky_file, viewer_file = os.path.join(work, "sky.exr"), os.path.join(work, "viewer.exr")
    sky = panorama(4096)
    image = bpy.data.images.new("Sky", sky.shape[1], sky.shape[0], alpha=False, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    image.pixels.foreach_set(np.dstack([sky, np.ones(sky.shape[:2])])[::-1].astype(np.float32).ravel())
    image.file_format, image.filepath_raw = "OPEN_EXR", sky_file
    image.save()
    assert np.abs(pixels(sky_file) - sky).max() < 1e-3, "the panorama is not saved in linear light"

    nodes, links, background = new_world()
    texture = nodes.new("ShaderNodeTexEnvironment")
    texture.image = bpy.data.images.load(sky_file)
    links.new(texture.outputs["Color"], background.inputs["Color"])
    scene = bpy.context.scene
    scene.world.cycles.sampling_method = "NONE"
    scene.cycles.use_adaptive_sampling = False
    ok = True
    print("Cycles, 64 samples a pixel, against viewer render, of 255:")
    for r, fov, yaw, pitch, roll in ((10, 90, 0, 0, 0), (3, 60, 70, 20, 30)):
        # The middle of Blender's panorama is +X, of the viewer's −Z; both have the right half on its right.
        camera = setup(work, "--radius", r, "--fov", fov, "--pan", yaw, "--tilt", pitch, "--roll", roll)
        camera.rotation_euler = (0.5 * math.pi, 0.0, -0.5 * math.pi)
        scene.cycles.samples = 64
        scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 1.0
        render_size(960, 540)
        start = time.perf_counter()
        cycles = render(os.path.join(work, "cycles.exr"))
        seconds = time.perf_counter() - start
        command = [viewer, "render", "-r", str(r), "--fov", str(fov), "--size", "960x540"]
        command += ["--yaw", str(yaw), "--pitch", str(pitch), "--roll", str(roll)]
        command += ["--device", "cpu", "-s", sky_file, "-o", viewer_file]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        difference = np.abs(srgb(cycles) - srgb(pixels(viewer_file))).max(axis=-1)
        mean, most, largest = difference.mean(), np.quantile(difference, 0.999), difference.max()
        print(
            f"  r = {r}, fov {fov}°, pan {yaw}°, tilt {pitch}°, roll {roll}°: mean {mean:.3f}, 99.9 % below {most:.2f},"
            f" largest {largest:.1f} ({seconds:.0f} s)",
            flush=True,
        )
        ok &= mean <= MAX_MEAN and most <= MAX_999
    print(f"  bounds: mean {MAX_MEAN:g}, 99.9 % {MAX_999:g}")
    return ok


def draw_picture(work, path):
    """The picture of the README: a new file, set up, rendered."""
    empty_scene()
    camera = setup(work)
    camera.rotation_euler = (0.5 * math.pi, 0.0, 0.0)
    render_size(960, 540)
    scene = bpy.context.scene
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "RGB"
    scene.render.image_settings.compression = 100
    scene.render.filepath = path
    start = time.perf_counter()
    with quiet():
        bpy.ops.render.render(write_still=True)
    print(f"{os.path.basename(path)}: {time.perf_counter() - start:.0f} s")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--bake", required=True)
    parser.add_argument("--viewer", required=True)
    parser.add_argument("--work", required=True, metavar="FOLDER", help="for what Cycles compiles and draws")
    parser.add_argument("--picture", metavar="FILE.png", help="draw the picture of the README to this file")
    given = parser.parse_args()
    work = os.path.abspath(given.work)
    os.makedirs(work, exist_ok=True)
    for name in ("lensbake.osl", "setup_lensbake.py"):
        shutil.copy(os.path.join(KIT, name), work)
    print(f"Blender {bpy.app.version_string}")
    ok = check_directions(given.bake, work)
    ok &= check_picture(given.viewer, work)
    if given.picture:
        draw_picture(work, os.path.abspath(given.picture))
    print("passed" if ok else "FAILED: an error exceeds its bound")
    return 0 if ok else 1


if __name__ == "__main__":
    sys.exit(main())
