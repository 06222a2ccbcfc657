"""Draws an exported scene in Blender and compares it with the frame that the tracer rendered.

    shuttertruth export railing --gltf out/gltf
    shuttertruth render --scenes railing --size 160x90 --out out/render
    blender -b --python examples/export/blender.py -- out/gltf/railing out/blender.exr 160 90
    python3 examples/export/compare.py out/blender.exr out/render/railing/frame.exr

The importer keeps places, motion, colours and the sun. The script adds what glTF cannot say: the sky, light without limits on
bounces, and diffuse surfaces without Blender's own gloss. Tried with Blender 3.4.1.
"""

import json
import math
import sys

import numpy

# Blender 3.4's importer names a type that newer versions of numpy lack.
numpy.bool = bool

import bpy  # noqa: E402

folder, picture, width, height = sys.argv[sys.argv.index("--") + 1 :]
with open(f"{folder}/manifest.json") as file:
    manifest = json.load(file)

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.context.scene.render.fps = round(1 / manifest["seconds_per_frame"])
bpy.ops.import_scene.gltf(filepath=f"{folder}/scene.gltf")
scene = bpy.context.scene
scene.frame_set(round(manifest["instant"] / manifest["seconds_per_frame"]))
scene.camera = next(o for o in bpy.data.objects if o.type == "CAMERA")


def add_sky():
    world = bpy.data.worlds.new("sky")
    scene.world = world
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    sky = nodes.new("ShaderNodeTexEnvironment")
    sky.image = bpy.data.images.load(f"{folder}/{manifest['sky']}")
    sky.image.colorspace_settings.name = "Linear"
    place = nodes.new("ShaderNodeTexCoord")
    turn = nodes.new("ShaderNodeMapping")
    # The middle of the sky lies towards -Z in glTF, which is +Y in Blender, whose own skies have it towards -X.
    turn.inputs["Rotation"].default_value[2] = -math.pi / 2
    links.new(place.outputs["Generated"], turn.inputs["Vector"])
    links.new(turn.outputs["Vector"], sky.inputs["Vector"])
    links.new(sky.outputs["Color"], nodes["Background"].inputs["Color"])


def set_sun():
    for light in (o.data for o in bpy.data.objects if o.type == "LIGHT"):
        irradiance = manifest["sun_irradiance"]
        light.energy = max(irradiance)
        light.color = [part / light.energy for part in irradiance]
        light.angle = 2 * math.radians(manifest["sun_angular_radius"])


def make_diffuse(material):
    """Replaces the importer's surface, whose diffuse part is not Lambert's; one that emits is left."""
    nodes, links = material.node_tree.nodes, material.node_tree.links
    for surface in [n for n in nodes if n.type == "BSDF_PRINCIPLED"]:
        emission = surface.inputs["Emission"]
        if emission.links or max(emission.default_value[:3]) > 0:
            surface.inputs["Specular"].default_value = 0
            continue
        diffuse = nodes.new("ShaderNodeBsdfDiffuse")
        color = surface.inputs["Base Color"]
        diffuse.inputs["Color"].default_value = color.default_value
        if color.links:
            links.new(color.links[0].from_socket, diffuse.inputs["Color"])
        for link in list(surface.outputs[0].links):
            links.new(diffuse.outputs[0], link.to_socket)


add_sky()
set_sun()
for material in [m for m in bpy.data.materials if m.use_nodes]:
    make_diffuse(material)
scene.render.engine = "CYCLES"
scene.cycles.samples = 64
scene.cycles.use_denoising = False
scene.cycles.max_bounces = scene.cycles.diffuse_bounces = 16
scene.cycles.pixel_filter_type = "BOX"
scene.cycles.sample_clamp_indirect = 0
scene.view_settings.view_transform = "Raw"
scene.render.resolution_x, scene.render.resolution_y = int(width), int(height)
scene.render.resolution_percentage = 100
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.render.filepath = picture
bpy.ops.render.render(write_still=True)
