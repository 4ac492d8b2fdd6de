"""Sets a scene up for the camera lensbake.osl: what an observer at rest near a black hole sees of the world around.

Run it in Blender's Text Editor, or: blender [scene.blend] --python setup_lensbake.py -- [--radius 10] [--fov 90]
[--pan 0] [--tilt 0] [--roll 0] [--sky-only] [--render picture.png]. Without --render it only sets up; -b before
--python keeps the window closed. Run it again to change the parameters: what is not given stays as it is.
"""

import argparse
import math
import os
import sys

import bpy

NAME = "Lensbake"
SHADER = "lensbake.osl"


def arguments():
    parser = argparse.ArgumentParser(prog="setup_lensbake.py", description=__doc__.splitlines()[0])
    parser.add_argument("--radius", type=float, metavar="R", help="radius in Schwarzschild radii, above 1")
    parser.add_argument("--fov", dest="field_of_view", type=float, metavar="DEG", help="horizontal field of view")
    for name in ("pan", "tilt", "roll"):
        parser.add_argument("--" + name, type=float, metavar="DEG")
    parser.add_argument("--sky-only", action="store_true", help="hide the scene's objects in renders")
    parser.add_argument("--render", metavar="FILE.png", help="render the picture to this file")
    # Blender leaves what follows -- to scripts; in the Text Editor there is nothing.
    given = parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
    if given.radius is not None and not given.radius > 1.0:
        parser.error("--radius must be above 1: at the horizon and below nobody is at rest")
    if given.field_of_view is not None and not 0.0 < given.field_of_view < 180.0:
        parser.error("--fov must be between 0 and 180")
    return given


def find_shader():
    """The path of lensbake.osl, or else the text block of this name, or else an error that says what to do."""
    # In the Text Editor, __file__ is no path: the .blend and the name of the text block. The block knows its own.
    folders = [os.path.dirname(os.path.abspath(__file__))] if os.path.isfile(__file__) else []
    texts = [text for text in bpy.data.texts if text.filepath and "setup_lensbake" in text.name]
    folders += [os.path.dirname(bpy.path.abspath(text.filepath)) for text in texts]
    if bpy.data.filepath:
        folders.append(os.path.dirname(bpy.data.filepath))
    for folder in folders:
        path = os.path.join(folder, SHADER)
        if os.path.isfile(path):
            # Blender compiles to a .oso file beside the .osl file; where it cannot, take the text into the .blend file.
            return path if os.access(folder, os.W_OK) else bpy.data.texts.load(path)
    if SHADER in bpy.data.texts:
        return bpy.data.texts[SHADER]
    looked = " or ".join(folders) or "no folder, because this script is not saved"
    raise FileNotFoundError(
        f"{SHADER} not found (looked in {looked}). Put it beside setup_lensbake.py, or open it in the Text Editor."
    )


def use_cycles(scene):
    """Only Cycles has custom cameras. Settings of scenes that are drawn by Cycles already stay as they are."""
    if scene.render.engine != "CYCLES":
        scene.render.engine = "CYCLES"
        scene.cycles.samples = 32
        # There is no noise in a sky, and the denoiser takes small stars for noise.
        scene.cycles.use_denoising = False


def lensbake_camera(scene):
    """The camera object, made at the place of the scene's camera, or at the origin with the hole along +Y."""
    camera = bpy.data.objects.get(NAME)
    if camera is None or camera.type != "CAMERA":
        camera = bpy.data.objects.new(NAME, bpy.data.cameras.new(NAME))
        if scene.camera is not None:
            camera.matrix_world = scene.camera.matrix_world
        else:
            camera.rotation_euler = (math.radians(90.0), 0.0, 0.0)
    if camera.name not in scene.collection.all_objects:
        scene.collection.objects.link(camera)
    scene.camera = camera
    return camera


def compile_shader(camera, shader):
    """Gives the camera its shader. Compiling makes its parameters, and keeps the values of those that it has."""
    try:
        import oslquery  # noqa: F401 (Blender's own code imports it to read the parameters)
    except ImportError:
        # The bpy module from PyPI brings it, but outside its path.
        version = "python{}.{}".format(*sys.version_info[:2])
        sys.path.append(os.path.join(bpy.utils.system_resource("PYTHON"), "lib", version, "site-packages"))
    data = camera.data
    data.type = "CUSTOM"
    if isinstance(shader, str):
        data.custom_mode = "EXTERNAL"
        data.custom_filepath = shader
    else:
        data.custom_mode = "INTERNAL"
        data.custom_shader = shader
    # The operator works on the active object.
    bpy.context.view_layer.objects.active = camera
    bpy.ops.object.camera_custom_update()
    if "radius" not in data.cycles_custom:
        raise RuntimeError(f"Cycles has not compiled {SHADER}; the system console has its messages")


def has_sky(scene):
    """Whether the world shows more than one colour."""
    world = scene.world
    if world is None or world.node_tree is None:
        return False
    plain = ("ShaderNodeBackground", "ShaderNodeOutputWorld")
    return any(node.bl_idname not in plain for node in world.node_tree.nodes)


def make_sky(scene, camera):
    """A world of stars before a band of nebulae that passes behind the hole. The old world stays in the file."""
    if scene.world is not None:
        scene.world.use_fake_user = True
    scene.world = world = bpy.data.worlds.new(NAME + " sky")
    if world.node_tree is None:
        world.use_nodes = True  # needed up to Blender 4.5
    # Cycles would first evaluate the sky at millions of points, to light objects by it; this one has almost no light.
    world.cycles.sampling_method = "NONE"
    tree = world.node_tree
    tree.nodes.clear()

    def node(kind, inputs=(), **settings):
        made = tree.nodes.new("ShaderNode" + kind)
        for name, value in settings.items():
            setattr(made, name, value)
        for socket, value in dict(inputs).items():
            if isinstance(value, bpy.types.NodeSocket):
                tree.links.new(value, made.inputs[socket])
            else:
                made.inputs[socket].default_value = value
        return made

    def math_(operation, a, b=0.0, c=0.0):
        return node("Math", {0: a, 1: b, 2: c}, operation=operation).outputs[0]

    def vector(operation, a, b):
        return node("VectorMath", {0: a, 1: b}, operation=operation)

    def smooth(value, from_, to):
        inputs = {"Value": value, "From Min": from_, "From Max": to}
        return node("MapRange", inputs, interpolation_type="SMOOTHSTEP").outputs["Result"]

    def scaled(colour, factor):
        return node("VectorMath", {0: colour, "Scale": factor}, operation="SCALE").outputs[0]

    # The direction on the sky in the frame of the camera, in which the hole is at (0, 0, -1).
    world_from_camera = camera.matrix_world.to_3x3().normalized()
    generated = node("TexCoord").outputs["Generated"]
    axes = [vector("DOT_PRODUCT", generated, tuple(axis)).outputs["Value"] for axis in world_from_camera.transposed()]
    direction = node("CombineXYZ", dict(enumerate(axes))).outputs[0]

    def noise(scale, detail, offset):
        moved = vector("ADD", direction, offset).outputs[0]
        inputs = {"Vector": moved, "Scale": scale, "Detail": detail, "Roughness": 0.62, "Distortion": 0.6}
        return node("TexNoise", inputs).outputs[0]

    across = vector("DOT_PRODUCT", direction, (math.sin(math.radians(28.0)), math.cos(math.radians(28.0)), 0.0))
    waves = math_("MULTIPLY_ADD", noise(1.6, 1.0, (3.0, 1.0, 7.0)), 0.5, -0.25)
    latitude = math_("ADD", across.outputs["Value"], waves)
    band = math_("EXPONENT", math_("MULTIPLY", math_("MULTIPLY", latitude, latitude), -14.0))
    clouds = smooth(noise(2.4, 6.0, (0.0, 0.0, 0.0)), 0.36, 0.78)
    dust = smooth(noise(3.4, 5.0, (5.0, 2.0, 9.0)), 0.42, 0.62)
    light = math_("MULTIPLY", math_("MULTIPLY", clouds, band), math_("SUBTRACT", 1.0, math_("MULTIPLY", dust, 0.8)))
    hue = node("ValToRGB", {"Fac": smooth(noise(1.3, 1.0, (1.0, 8.0, 4.0)), 0.35, 0.65)})
    ramp = hue.color_ramp.elements
    ramp[0].color = (0.10, 0.25, 1.0, 1.0)
    ramp[1].color = (1.0, 0.30, 0.10, 1.0)
    ramp.new(0.5).color = (0.75, 0.22, 0.70, 1.0)
    nebula = scaled(hue.outputs["Color"], math_("MULTIPLY", light, 1.6))
    total = vector("ADD", nebula, (0.0012, 0.0018, 0.004)).outputs[0]

    # Cells on the sphere: about a third has a feature point near enough to the sphere to be seen as a star.
    for cells, size, strength in ((45.0, 0.08, 6.0), (110.0, 0.15, 0.9)):
        cell = node("TexVoronoi", {"Vector": direction, "Scale": cells})
        random = node("SeparateXYZ", {0: cell.outputs["Color"]})
        spot = smooth(cell.outputs["Distance"], size, 0.0)
        brightness = math_("MULTIPLY", spot, math_("MULTIPLY", math_("POWER", random.outputs[0], 6.0), strength))
        kelvin = math_("MULTIPLY_ADD", math_("POWER", random.outputs[1], 2.0), 9000.0, 3500.0)
        colour = node("Blackbody", {0: kelvin}).outputs[0]
        total = vector("ADD", total, scaled(colour, brightness)).outputs[0]

    background = node("Background", {"Color": total})
    node("OutputWorld", {"Surface": background.outputs[0]})


def report(scene, camera, new_sky):
    values = ", ".join(f"{name} {value:g}" for name, value in camera.data.cycles_custom.items())
    objects = [o.name for o in scene.objects if o.type not in ("CAMERA", "LIGHT", "EMPTY") and not o.hide_render]
    print(f"lensbake: the scene's camera is now {camera.name!r}: {values}")
    print("  parameters: select it; Camera properties > Lens > Parameters (radius in Schwarzschild radii, angles in °)")
    print("  direction of the hole: the axis of the camera object; pan, tilt and roll turn the view, not the hole")
    print("  sky: World properties > Color" + (f"; {scene.world.name!r} is new, for an example" if new_sky else ""))
    if objects:
        print(f"  seen as well, as if infinitely far: {', '.join(objects[:5])}{', ...' if len(objects) > 5 else ''}")
    if scene.render.film_transparent:
        print("  the sky is not drawn: switch off Render properties > Film > Transparent")
    if scene.cycles.device == "GPU":
        print("  custom cameras are drawn by the CPU or by OptiX only")


def main():
    given = arguments()
    scene = bpy.context.scene
    shader = find_shader()
    use_cycles(scene)
    camera = lensbake_camera(scene)
    compile_shader(camera, shader)
    for name in ("radius", "field_of_view", "pan", "tilt", "roll"):
        if getattr(given, name) is not None:
            camera.data.cycles_custom[name] = getattr(given, name)
    camera.data.update_tag()
    bpy.context.view_layer.update()
    if given.sky_only:
        for other in scene.objects:
            other.hide_render = other is not camera
    new_sky = not has_sky(scene)
    if new_sky:
        make_sky(scene, camera)
    report(scene, camera, new_sky)
    if given.render:
        scene.render.image_settings.file_format = "PNG"
        scene.render.filepath = os.path.abspath(given.render)
        bpy.ops.render.render(write_still=True)


main()
