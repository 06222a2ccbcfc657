"""Renders the mean over the shutter of an exported scene with LuxCore: two pictures of different samples, `a.exr` and `b.exr`.

    python draw.py out/gltf/fan out/luxcore/fan --size 160x90 --samples 256

Needs pyluxcore and OpenEXR. Draws rigid scenes of diffuse and emitting surfaces with a still camera, and says why it refuses others.
"""

import argparse
import json
import math
import os
import pathlib
import sys
import time

import numpy as np
import OpenEXR
import pyluxcore
from PIL import Image

# Poses over the shutter; LuxCore turns evenly between two.
STEPS = 17
KINDS = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


class File:
    """A glTF file with one buffer."""

    def __init__(self, folder):
        self.json = json.loads((folder / "scene.gltf").read_text())
        self.bytes = (folder / self.json["buffers"][0]["uri"]).read_bytes()

    def array(self, index):
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        width, kind = WIDTHS[accessor["type"]], KINDS[accessor["componentType"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        return np.frombuffer(self.bytes, kind, accessor["count"] * width, start).reshape(-1, width)

    def sample(self, sampler, seconds):
        times, values = self.array(sampler["input"])[:, 0].astype(float), self.array(sampler["output"]).astype(float)
        if sampler["interpolation"] == "CUBICSPLINE":
            at = int(np.clip(np.searchsorted(times, seconds) - 1, 0, len(times) - 2))
            (_, before, leaving), (arriving, after, _) = values.reshape(len(times), 3, -1)[at : at + 2]
            span = times[at + 1] - times[at]
            u = np.clip((seconds - times[at]) / span, 0, 1)
            weights = 2 * u**3 - 3 * u**2 + 1, u**3 - 2 * u**2 + u, 3 * u**2 - 2 * u**3, u**3 - u**2
            return weights[0] * before + weights[1] * span * leaving + weights[2] * after + weights[3] * span * arriving
        if values.shape[1] == 4:
            values = values * np.cumprod([1, *np.where((values[1:] * values[:-1]).sum(1) < 0, -1, 1)])[:, None]
        return [np.interp(seconds, times, column) for column in values.T]

    def world(self, node, seconds):
        """The node's pose in the world at a time."""
        parents = [number for number, other in enumerate(self.json["nodes"]) if node in other.get("children", [])]
        pose = self.pose(node, seconds)
        return self.world(parents[0], seconds) @ pose if parents else pose

    def pose(self, node, seconds):
        """The node's pose in its parent. Keys of turns are dense, so quaternions are interpolated by components."""
        parts = dict(translation=[0, 0, 0], rotation=[0, 0, 0, 1], scale=[1, 1, 1])
        parts.update({name: self.json["nodes"][node][name] for name in parts if name in self.json["nodes"][node]})
        for clip in self.json.get("animations", []):
            for channel in clip["channels"]:
                if channel["target"]["node"] == node:
                    parts[channel["target"]["path"]] = self.sample(clip["samplers"][channel["sampler"]], seconds)
        x, y, z, w = np.array(parts["rotation"]) / np.linalg.norm(parts["rotation"])
        turn = np.array([
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ])
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = turn * parts["scale"], parts["translation"]
        return matrix


def refusals(file, manifest):
    """Lists what keeps LuxCore from drawing a scene as it is meant."""
    camera = next(index for index, node in enumerate(file.json["nodes"]) if "camera" in node)
    targets = [channel["target"] for clip in file.json.get("animations", []) for channel in clip["channels"]]
    materials = file.json["materials"]
    flags = {
        "a moving camera": any(target["node"] == camera for target in targets),
        "deforming meshes": any(target["path"] == "weights" for target in targets),
        "glass or films": any(material["alphaMode"] != "OPAQUE" or "KHR_materials_transmission" in material.get("extensions", {}) for material in materials),
        "a lens": manifest["lens"] is not None,
        "a shutter that opens slowly": manifest["has_shutter_profile"],
    }
    return [name for name, is_so in flags.items() if is_so]


def linear_texture(folder, file, texture, out):
    """Writes a texture as linear floats, since LuxCore's gamma is no sRGB; returns its path."""
    source = file.json["images"][file.json["textures"][texture["index"]]["source"]]["uri"]
    srgb = np.asarray(Image.open(folder / source).convert("RGB")) / 255.0
    linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4).astype(np.float32)
    path = out / (pathlib.Path(source).stem + ".exr")
    OpenEXR.File({"type": OpenEXR.scanlineimage}, {"RGB": linear}).write(str(path))
    return path


class Lux:
    """A scene of LuxCore and the properties that describe it."""

    def __init__(self):
        self.scene, self.properties = pyluxcore.Scene(), pyluxcore.Properties()

    def set(self, name, *values):
        self.properties.Set(pyluxcore.Property(name, list(values)))

    def color(self, name, factor, path):
        """Sets a colour, or a texture times a colour."""
        if path is None:
            self.set(name, *factor)
            return
        texture = "texture_" + name.replace(".", "_")
        for key, values in {
            f"{texture}.type": ["imagemap"], f"{texture}.file": [str(path)], f"{texture}.gamma": [1.0], f"{texture}.colorspace": ["nop"],
            f"{texture}.mapping.uvscale": [1.0, 1.0], f"{texture}_times.type": ["scale"],
            f"{texture}_times.texture1": [texture], f"{texture}_times.texture2": list(factor),
        }.items():
            self.set(f"scene.textures.{key}", *values)
        self.set(name, f"{texture}_times")


def matrix_of(matrix):
    """LuxCore's order: column by column."""
    return [float(value) for value in matrix.T.ravel()]


def add_materials(lux, folder, file, out):
    for number, material in enumerate(file.json["materials"]):
        surface, name = material["pbrMetallicRoughness"], f"scene.materials.m{number}"
        path = linear_texture(folder, file, surface["baseColorTexture"], out) if "baseColorTexture" in surface else None
        lux.set(f"{name}.type", "matte")
        lux.color(f"{name}.kd", surface["baseColorFactor"][:3], path)
        if any(material["emissiveFactor"]):
            strength = material.get("extensions", {}).get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1.0)
            path = linear_texture(folder, file, material["emissiveTexture"], out) if "emissiveTexture" in material else None
            lux.color(f"{name}.emission", [strength * value for value in material["emissiveFactor"]], path)


def add_objects(lux, file, shutter):
    times = np.linspace(*shutter, STEPS)
    for node, content in enumerate(file.json["nodes"]):
        if "mesh" not in content:
            continue
        poses = [file.world(node, time) for time in times]
        for part, primitive in enumerate(file.json["meshes"][content["mesh"]]["primitives"]):
            name, attributes = f"o{node}_{part}", primitive["attributes"]
            rows = lambda index: [tuple(row) for row in file.array(index).tolist()]
            points, normals, uvs = (rows(attributes[key]) if key in attributes else None for key in ("POSITION", "NORMAL", "TEXCOORD_0"))
            triangles = [tuple(row) for row in file.array(primitive["indices"]).reshape(-1, 3).tolist()]
            lux.scene.DefineMesh(name, points, triangles, normals, uvs, None, None)
            lux.set(f"scene.objects.{name}.shape", name)
            lux.set(f"scene.objects.{name}.material", f"m{primitive['material']}")
            for step, pose in enumerate(poses):
                lux.set(f"scene.objects.{name}.motion.{step}.time", step / (STEPS - 1))
                lux.set(f"scene.objects.{name}.motion.{step}.transformation", *matrix_of(pose))


def add_lights(lux, folder, file, manifest):
    if manifest["sky_constant"] is None:
        lux.set("scene.lights.sky.type", "infinite")
        lux.set("scene.lights.sky.file", str(folder / manifest["sky"]))
        lux.set("scene.lights.sky.gamma", 1.0)
        lux.set("scene.lights.sky.colorspace", "nop")
        # LuxCore's sky has its poles along Z.
        lux.set("scene.lights.sky.transformation", *matrix_of(np.array([[0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 0], [0, 0, 0, 1.0]])))
    elif any(manifest["sky_constant"]):
        lux.set("scene.lights.sky.type", "constantinfinite")
        lux.set("scene.lights.sky.color", *manifest["sky_constant"])
    for number, node in enumerate(file.json["nodes"]):
        if "KHR_lights_punctual" in node.get("extensions", {}):
            pose = file.world(number, manifest["instant"])
            radius = manifest["sun_angular_radius"] or 0
            # A disc has a radiance, and a sharp sun an irradiance.
            share = math.pi * math.sin(radius) ** 2 if radius else 1
            lux.set("scene.lights.sun.type", "distant" if radius else "sharpdistant")
            lux.set("scene.lights.sun.direction", *(-pose[:3, 2]).tolist())
            lux.set("scene.lights.sun.color", *(value / share for value in manifest["sun_irradiance"]))
            lux.set("scene.lights.sun.theta", math.degrees(radius))


def render(lux, file, manifest, size, samples, seed):
    number = next(index for index, node in enumerate(file.json["nodes"]) if "camera" in node)
    pose = file.world(number, manifest["instant"])
    eye, ahead, up = pose[:3, 3], -pose[:3, 2], pose[:3, 1]
    width, height = size
    aspect = width / height
    for key, values in {
        "type": ["perspective"], "lookat.orig": eye, "lookat.target": eye + ahead, "up": up, "fieldofview": [manifest["vertical_fov"]],
        # LuxCore draws a row too low.
        "screenwindow": [-aspect, aspect, -1 - 2 / height, 1 - 2 / height], "shutteropen": [0.0], "shutterclose": [1.0],
    }.items():
        lux.set(f"scene.camera.{key}", *map(lambda value: value if isinstance(value, str) else float(value), values))
    lux.scene.Parse(lux.properties)
    settings = pyluxcore.Properties()
    for key, value in {
        "renderengine.type": "PATHCPU", "sampler.type": "SOBOL", "renderengine.seed": seed, "film.width": width, "film.height": height,
        "film.filter.type": "BOX", "film.filter.width": 0.5, "path.pathdepth.total": 64, "path.pathdepth.diffuse": 64, "path.russianroulette.depth": 8,
        "film.imagepipelines.0.0.type": "NOP", "batch.haltspp": samples, "sampler.sobol.adaptive.strength": 0.0, "path.clamping.variance.maxvalue": 0.0,
    }.items():
        settings.Set(pyluxcore.Property(key, value))
    session = pyluxcore.RenderSession(pyluxcore.RenderConfig(settings, lux.scene))
    session.Start()
    while not session.HasDone():
        time.sleep(0.1)
        session.UpdateStats()
    pixels = np.zeros((height, width, 3), np.float32)
    session.GetFilm().GetOutputFloat(pyluxcore.FilmOutputType.RGB_IMAGEPIPELINE, pixels, 0, True)
    session.Stop()
    return pixels[::-1]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--size", default="160x90")
    parser.add_argument("--samples", type=int, default=256)
    options = parser.parse_args()
    file, manifest = File(options.folder), json.loads((options.folder / "manifest.json").read_text())
    if reasons := refusals(file, manifest):
        sys.exit(f"{options.folder}: {' and '.join(reasons)}")
    options.out.mkdir(parents=True, exist_ok=True)
    pyluxcore.Init(lambda text: None)
    for seed, name in enumerate(("a", "b"), 1):
        lux = Lux()
        add_materials(lux, options.folder, file, options.out)
        add_objects(lux, file, manifest["shutter"]["centred"])
        add_lights(lux, options.folder, file, manifest)
        pixels = render(lux, file, manifest, list(map(int, options.size.split("x"))), options.samples, seed)
        OpenEXR.File({"type": OpenEXR.scanlineimage}, {"RGB": np.ascontiguousarray(pixels)}).write(str(options.out / f"{name}.exr"))
    # LuxCore crashes when Python ends.
    sys.stdout.flush()
    os._exit(0)


if __name__ == "__main__":
    main()
