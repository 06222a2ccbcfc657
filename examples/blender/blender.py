"""Draws an exported scene in Blender as a capture: the instant, its buffers, its sub-frames, and Blender's own blur.

    shuttertruth engine export railing --gltf out/gltf
    blender -b --python examples/blender/blender.py -- out/gltf/railing captures/railing --size 160x90
    shuttertruth engine audit captures/railing
    shuttertruth engine ingest captures/railing
    shuttertruth run railing out/engine/railing

The blur is the compositor's Vector Blur, which reads the vector pass as a real-time blur reads its velocity buffer, or with
`--blur cycles` the motion blur of Cycles, which opens a shutter. `--blur eevee` draws everything with EEVEE and its motion blur; it
needs Blender 5.0 and OpenGL, but no display. `--blur none` draws neither blur nor sub-frames, and `--blur-only` draws only the blur.

For a scene that `engine import` made of a glTF file, `--original FILE --at SECONDS --fps RATE` draws the meshes of that file, at the
time and rate that the import was given, in the place of the exported ones: pictures of the original beside those of its import.

The importer keeps places, motion, colours and the sun. The script adds what glTF cannot say: the lens, the sky, light without limits on
bounces, and diffuse surfaces without Blender's own gloss. Tried with Blender 3.4.1, and with the module bpy 5.0.1 as
`python examples/blender/blender.py -- FOLDER OUT`.
"""

import argparse
import json
import math
import os
import re
import sys

import numpy

# Blender 3.4's importer names a type that newer versions of numpy lack.
numpy.bool = bool

import bpy  # noqa: E402

# Blender 4.0 renamed this and some inputs of surfaces.
LINEAR = "Linear" if bpy.app.version < (4, 0) else "Linear Rec.709"
# Blender 5.0 changed the compositor's tree and the settings of files, and made the second EEVEE the only one.
IS_5 = bpy.app.version >= (5, 0)
# The far plane that EEVEE gets, in metres.
FAR = 1e5
# Vectors lead back to the frame before, in pixels with y up; depth is in metres.
CONVENTION = """[convention]
velocity_sign = "previous_minus_current"
velocity_y = "up"
"""

parser = argparse.ArgumentParser(prog="blender -b --python blender.py --")
parser.add_argument("folder", help="folder of an exported scene")
parser.add_argument("out", help="folder to write: the capture")
parser.add_argument("--size", default="160x90", help="columns x rows")
parser.add_argument("--samples", type=int, default=64, help="samples per pixel of every picture")
parser.add_argument("--original", help="the glTF file that the scene was imported from")
parser.add_argument("--at", type=float, default=0, help="time of the frame in that file, in seconds")
parser.add_argument("--fps", type=int, default=24, help="frames per second of that file")
parser.add_argument("--blur", choices=["vectors", "cycles", "eevee", "none"], default="vectors")
parser.add_argument("--alignment", choices=["centred", "trailing", "leading"], default="centred", help="shutter of Cycles or EEVEE")
parser.add_argument("--blur-only", action="store_true", help="draw the blurred picture alone, which is no capture")
parser.add_argument("--seed", type=int, default=0, help="seed of Cycles' noise")
options = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])
if options.blur == "eevee" and not IS_5:
    parser.error(f"--blur eevee needs Blender 5.0; this is {bpy.app.version_string}")
if options.blur == "vectors" and options.alignment != "centred":
    parser.error("Vector Blur is centred; allowed for another shutter: --blur cycles or eevee")
folder = options.folder
with open(f"{folder}/manifest.json") as file:
    manifest = json.load(file)

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.context.scene.render.fps = round(1 / manifest["seconds_per_frame"])
bpy.ops.import_scene.gltf(filepath=f"{folder}/scene.gltf")
scene = bpy.context.scene
scene.camera = next(o for o in bpy.data.objects if o.type == "CAMERA")


def put_original_in_place():
    """Exchanges the meshes of the scene for those of the glTF file; camera, lights, floor and wall stay, and stand still."""
    replaced = [o for o in bpy.data.objects if o.type == "MESH" and o.name not in ("floor", "wall")]
    # With their meshes, so that the names are free. Several objects may share one.
    for mesh in {o.data for o in replaced}:
        bpy.data.meshes.remove(mesh)
    stay = set(bpy.data.objects)
    bpy.context.scene.render.fps = options.fps
    bpy.ops.import_scene.gltf(filepath=options.original)
    for thing in [o for o in bpy.data.objects if o not in stay and is_left_out(o)]:
        bpy.data.objects.remove(thing)


def is_left_out(thing):
    """Cameras and lights stay the scene's, and the importer of Blender 5 adds a mesh that only shows where bones are."""
    shows_bones = any(collection.name.startswith("glTF_not_exported") for collection in thing.users_collection)
    return thing.type in ("CAMERA", "LIGHT") or shows_bones


if options.original:
    put_original_in_place()


def add_sky():
    world = bpy.data.worlds.new("sky")
    scene.world = world
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    sky = nodes.new("ShaderNodeTexEnvironment")
    sky.image = bpy.data.images.load(f"{folder}/{manifest['sky']}")
    sky.image.colorspace_settings.name = LINEAR
    place = nodes.new("ShaderNodeTexCoord")
    turn = nodes.new("ShaderNodeMapping")
    # The middle of the sky is towards -Z in glTF, which is +Y in Blender; Blender's own skies have it towards -X.
    turn.inputs["Rotation"].default_value[2] = -math.pi / 2
    links.new(place.outputs["Generated"], turn.inputs["Vector"])
    links.new(turn.outputs["Vector"], sky.inputs["Vector"])
    links.new(sky.outputs["Color"], nodes["Background"].inputs["Color"])


def set_lens():
    """Gives the camera its lens. Blender's aperture is the focal length in millimetres divided by the f-number."""
    lens, camera = manifest["lens"], scene.camera.data
    if lens:
        camera.dof.use_dof = True
        camera.dof.focus_distance = lens["focus"]
        camera.dof.aperture_fstop = camera.lens / 1000 / lens["aperture"]
        # A disc without blades.
        camera.dof.aperture_blades = 0


def set_sun():
    for light in (o.data for o in bpy.data.objects if o.type == "LIGHT"):
        irradiance = manifest["sun_irradiance"]
        light.energy = max(irradiance)
        light.color = [part / light.energy for part in irradiance]
        light.angle = 2 * math.radians(manifest["sun_angular_radius"])


def make_pane(material, surface):
    """Turns a transmitting surface into thin glass: light passes straight on, with all reflections between both sides of a pane.

    A side reflects r by Fresnel's equations, and light keeps the share a between them. Then (1 - r)^2 a / (1 - r^2 a^2) = T passes, and
    r + r a T is reflected. The importer's surface is the side of a solid body instead.
    """
    nodes, links = material.node_tree.nodes, material.node_tree.links

    def connect(value, socket):
        if isinstance(value, bpy.types.NodeSocket):
            links.new(value, socket)
        else:
            socket.default_value = value

    def math_node(operation, *values):
        node = nodes.new("ShaderNodeMath")
        node.operation = operation
        for value, socket in zip(values, node.inputs):
            connect(value, socket)
        return node.outputs[0]

    def vector_node(operation, *values, scale=None):
        node = nodes.new("ShaderNodeVectorMath")
        node.operation = operation
        for value, socket in zip(values, node.inputs):
            connect(value, socket)
        if scale is not None:
            connect(scale, node.inputs["Scale"])
        return node.outputs["Vector"]

    index = surface.inputs["IOR"].default_value
    a = surface.inputs["Base Color"].default_value[:3]
    # Fresnel's node treats the other side of a surface as the inside of a body. A pane is the same from both.
    behind = nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"]
    fresnel = nodes.new("ShaderNodeFresnel")
    connect(math_node("POWER", index, math_node("SUBTRACT", 1, math_node("MULTIPLY", 2, behind))), fresnel.inputs["IOR"])
    r = fresnel.outputs[0]
    once = math_node("SUBTRACT", 1, r)
    round_trip = vector_node("SCALE", [part * part for part in a], scale=math_node("MULTIPLY", r, r))
    passed = vector_node(
        "DIVIDE",
        vector_node("SCALE", a, scale=math_node("MULTIPLY", once, once)),
        vector_node("SUBTRACT", [1, 1, 1], round_trip),
    )
    reflected = vector_node("SCALE", vector_node("ADD", [1, 1, 1], vector_node("MULTIPLY", a, passed)), scale=r)
    straight = nodes.new("ShaderNodeBsdfTransparent")
    connect(passed, straight.inputs["Color"])
    mirror = nodes.new("ShaderNodeBsdfGlossy")
    mirror.inputs["Roughness"].default_value = 0
    connect(reflected, mirror.inputs["Color"])
    both = nodes.new("ShaderNodeAddShader")
    connect(straight.outputs[0], both.inputs[0])
    connect(mirror.outputs[0], both.inputs[1])
    for link in list(surface.outputs[0].links):
        links.new(both.outputs[0], link.to_socket)


def find_input(surface, *names):
    """Finds an input of a surface, some of which Blender 4.0 renamed."""
    return next(surface.inputs[name] for name in names if name in surface.inputs)


def make_diffuse(material):
    """Replaces the importer's surface, since its diffuse part is not Lambert's; keeps emissive ones, and makes glass thin."""
    nodes, links = material.node_tree.nodes, material.node_tree.links
    for surface in [n for n in nodes if n.type == "BSDF_PRINCIPLED"]:
        if find_input(surface, "Transmission", "Transmission Weight").default_value > 0:
            make_pane(material, surface)
            continue
        emission = find_input(surface, "Emission", "Emission Color")
        shines = emission.links or max(emission.default_value[:3]) > 0
        if shines and surface.inputs["Emission Strength"].default_value > 0:
            find_input(surface, "Specular", "Specular IOR Level").default_value = 0
            continue
        diffuse = nodes.new("ShaderNodeBsdfDiffuse")
        color = surface.inputs["Base Color"]
        diffuse.inputs["Color"].default_value = color.default_value
        if color.links:
            links.new(color.links[0].from_socket, diffuse.inputs["Color"])
        for link in list(surface.outputs[0].links):
            links.new(diffuse.outputs[0], link.to_socket)


def decode_textures():
    """Replaces 8-bit textures with linear 32-bit ones: Cycles interpolates 8-bit texels before it decodes sRGB."""
    for image in [i for i in bpy.data.images if i.colorspace_settings.name == "sRGB" and i.has_data]:
        encoded = numpy.empty(len(image.pixels), dtype=numpy.float32)
        image.pixels.foreach_get(encoded)
        texels = encoded.reshape(-1, 4)
        color = texels[:, :3]
        texels[:, :3] = numpy.where(color <= 0.04045, color / 12.92, ((color + 0.055) / 1.055) ** 2.4)
        linear = bpy.data.images.new(image.name + " linear", *image.size, alpha=True, float_buffer=True)
        linear.colorspace_settings.name = LINEAR
        linear.pixels.foreach_set(texels.ravel())
        image.user_remap(linear)


def open_shutter(alignment):
    """Blurs over the scene's exposure: a box in time. Cycles has a pose at each of 129 instants, the most that it accepts.

    EEVEE keeps its defaults: one pose, and at most 32 pixels of blur.
    """
    scene.render.use_motion_blur = True
    scene.render.motion_blur_shutter = manifest["exposure"]
    shutter = scene.render if IS_5 else scene.cycles
    shutter.motion_blur_position = {"trailing": "END", "centred": "CENTER", "leading": "START"}[alignment]
    curve = scene.render.motion_blur_shutter_curve.curves[0]
    while len(curve.points) > 2:
        curve.points.remove(curve.points[1])
    for point, at in zip(curve.points, (0, 1)):
        point.location = (at, 1)
    for thing in bpy.data.objects:
        if hasattr(thing, "cycles"):
            thing.cycles.use_motion_blur = True
            thing.cycles.motion_steps = 7


def blur_vectors():
    """Blurs the sharp frame in the compositor, centred on it.

    Vector Blur has the shutter's time in frames in Blender 3.4 and 5.0, and half of it in Blender 4.2.
    """
    # In Blender 5.0, the node of the view layer has only the outputs that are on.
    scene.view_layers[0].use_pass_z = scene.view_layers[0].use_pass_vector = True
    if IS_5:
        tree = scene.compositing_node_group = bpy.data.node_groups.new("blur", "CompositorNodeTree")
        tree.interface.new_socket("Image", in_out="OUTPUT", socket_type="NodeSocketColor")
    else:
        scene.use_nodes = True
        tree = scene.node_tree
        tree.nodes.clear()
    drawn = tree.nodes.new("CompositorNodeRLayers")
    blur = tree.nodes.new("CompositorNodeVecBlur")
    if IS_5:
        blur.inputs["Shutter"].default_value = manifest["exposure"]
    else:
        blur.factor = manifest["exposure"] / (1 if bpy.app.version < (4, 0) else 2)
    for output, socket in (("Image", "Image"), ("Depth", "Z"), ("Vector", "Speed")):
        tree.links.new(drawn.outputs[output], blur.inputs[socket])
    shown = tree.nodes.new("NodeGroupOutput" if IS_5 else "CompositorNodeComposite")
    tree.links.new(blur.outputs["Image"], shown.inputs["Image"])


def set_quality():
    """Draws light without limits, and the mean over a pixel's square. The seed is the same in every picture."""
    scene.render.engine = "BLENDER_EEVEE" if options.blur == "eevee" else "CYCLES"
    scene.eevee.taa_render_samples = options.samples
    if options.blur == "eevee":
        # The importer gives a camera without a far plane one at 1e12 metres. EEVEE loses the sky, the ground and their vectors then.
        scene.camera.data.clip_end = min(scene.camera.data.clip_end, FAR)
        # Without light there are none, but a software driver clears all their memory for every sample.
        scene.eevee.use_shadows = not manifest["scene"].endswith("@unlit")
    scene.render.filter_size = 1.5
    scene.cycles.samples = options.samples
    scene.cycles.seed = options.seed
    # Blender 3.4 has wrong vectors with it.
    scene.render.use_persistent_data = IS_5
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = scene.cycles.diffuse_bounces = 16
    scene.cycles.transparent_max_bounces = 64
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.sample_clamp_indirect = 0
    scene.view_settings.view_transform = "Raw"
    scene.render.resolution_x, scene.render.resolution_y = map(int, options.size.split("x"))
    scene.render.resolution_percentage = 100


def number_objects():
    """Numbers the objects as the manifest does; the background is 0.

    The import writes `_` for other signs in the names of a glTF file, and invents a name where there is none.
    """
    plain = lambda name: re.sub(r"\W", "_", name)
    things = {plain(o.name): o for o in bpy.data.objects if o.type == "MESH"}
    numbers = {plain(name): number for number, name in enumerate(manifest["objects"]) if number > 0}
    named = {name: things.pop(name) for name in numbers if name in things}
    unnamed = [name for name in numbers if name not in named]
    if len(unnamed) != len(things) or len(unnamed) > 1:
        sys.exit(f"{unnamed} of the scene are not in Blender, and {list(things)} in Blender are not in the scene")
    for name, thing in [*named.items(), *zip(unnamed, things.values())]:
        thing.pass_index = numbers[name]


def add_ids():
    """Makes every material write its object's number, in a layer of the name of the pass that EEVEE lacks."""
    ids = scene.view_layers[0].aovs.add()
    ids.name, ids.type = "IndexOB", "VALUE"
    for nodes in [m.node_tree.nodes for m in bpy.data.materials if m.use_nodes]:
        written = nodes.new("ShaderNodeOutputAOV")
        written.aov_name = ids.name
        written.id_data.links.new(nodes.new("ShaderNodeObjectInfo").outputs["Object Index"], written.inputs["Value"])


def render(name, seconds, *passes):
    """Renders a time of the animation to a file, with passes in layers if there are any."""
    frame = seconds / manifest["seconds_per_frame"]
    if options.original:
        frame += options.at * options.fps - manifest["instant"] / manifest["seconds_per_frame"]
    whole = math.floor(frame + 1e-6)
    scene.frame_set(whole, subframe=max(frame - whole, 0))
    layer = scene.view_layers[0]
    for one in ("z", "vector", "object_index"):
        setattr(layer, f"use_pass_{one}", one in passes)
    settings = scene.render.image_settings
    is_layered = passes and name != "blurred"
    if IS_5:
        settings.media_type = "MULTI_LAYER_IMAGE" if is_layered else "IMAGE"
        settings.use_exr_interleave = True
    settings.file_format = "OPEN_EXR_MULTILAYER" if is_layered else "OPEN_EXR"
    settings.color_depth = "32"
    scene.render.filepath = os.path.abspath(f"{options.out}/{name}.exr")
    bpy.ops.render.render(write_still=True)


def render_buffers():
    """Renders vectors, depth and ids at the pixels' centres, as a rasteriser does, through a pinhole."""
    has_lens = scene.camera.data.dof.use_dof
    scene.camera.data.dof.use_dof = False
    scene.cycles.samples = scene.eevee.taa_render_samples = 1
    scene.render.filter_size = 0
    scene.cycles.pixel_filter_type = "BLACKMAN_HARRIS"
    scene.cycles.filter_width = 0.01
    render("buffers", manifest["instant"], "z", "vector", "object_index")
    scene.camera.data.dof.use_dof = has_lens
    set_quality()


def describe():
    """Writes engine.toml and capture.toml, the latter from the export's template."""
    blur = {"vectors": " Vector Blur", "cycles": " Cycles", "eevee": " EEVEE", "none": ""}[options.blur]
    if options.blur == "eevee" and options.samples == 1:
        blur += " with one sample"
    lines = {"engine": f"Blender {bpy.app.version_string}{blur}", "alignment": options.alignment}
    with open(f"{folder}/capture.toml") as file:
        text = file.read().split("\n", 1)[1]
    for key, value in lines.items():
        text = re.sub(f"(?m)^{key} = .*$", f'{key} = "{value}"', text)
    # EEVEE writes the far plane where nothing is, and Cycles 1e10 metres.
    far = f"far = {scene.camera.data.clip_end}\n" if options.blur == "eevee" else ""
    for name, content in (("capture", text), ("engine", CONVENTION + far)):
        with open(f"{options.out}/{name}.toml", "w") as file:
            file.write(content)


os.makedirs(options.out, exist_ok=True)
for image in bpy.data.images:
    image.update()
decode_textures()
add_sky()
set_lens()
set_sun()
number_objects()
for material in [m for m in bpy.data.materials if m.use_nodes]:
    make_diffuse(material)
if options.blur == "eevee":
    add_ids()
set_quality()
if not options.blur_only:
    render("color", manifest["instant"])
    render_buffers()
if options.blur != "none" and not options.blur_only:
    for index, seconds in enumerate(manifest["subframes"][options.alignment]):
        # EEVEE's ids are means of its samples.
        render(f"subframes/{index:04}", seconds, *([] if options.blur == "eevee" else ["object_index"]))
if options.blur == "vectors":
    blur_vectors()
    render("blurred", manifest["instant"], "z", "vector")
if options.blur in ("cycles", "eevee"):
    open_shutter(options.alignment)
    scene.cycles.samples = 4 * options.samples
    render("blurred", manifest["instant"])
describe()
