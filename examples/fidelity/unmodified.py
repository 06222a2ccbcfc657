"""Compares presets with the shaders that they follow, unmodified, on frames of three scenes.

    sh examples/engine_shaders/fetch.sh
    python3 examples/fidelity/unmodified.py --program shuttertruth --scenes-dir scenes --out out/unmodified

Shaders from npm packages have to be written out before, as the first lines of the `write_wgsl.mjs` there say; or leave them out with
--only, which names folders. Each filter of ../engine_shaders runs twice: with textures of the formats that its engine has, and with
32-bit inputs and output. Where the camera alone blurs, it moves in the scenes. The script prints one row per pair as Markdown, and
then how near KinoMotion's shaders come to their transcription once it takes the 10 bits that the driver stored. Last, it
compares the shader that three.js writes out with a transcription.
"""

import re
import shutil
import sys

import numpy as np
from compare import HERE, SCENES, Difference, blur_with, options, render, table

sys.path.insert(0, str(HERE / "originals"))
import bevy
import jump_flood
import kino

# (filter of ../engine_shaders, preset, parameters of the preset that differ)
PAIRS = [
    ("bevy", "bevy:default", []),
    ("bevy", "bevy:high", ["bevy_motion_blur.samples=8"]),
    ("kino", "kino:default", []),
    ("ppv2", "kino:ppv2", []),
    ("urp", "urp:default", ["unity_urp.intensity=0.5"]),
    ("godot_jump_flood_paper", "jump_flood:paper", []),
    ("godot_jump_flood_paper", "jump_flood:paper", ["jump_flood.map=float16"]),
    ("godot_jump_flood_july_2024", "jump_flood:july_2024", []),
    ("godot_jump_flood", "jump_flood:paper", []),
    ("godot_jump_flood", "jump_flood:july_2024", []),
    ("godot_guertin", "guertin:paper", []),
    ("godot_guertin", "mcguire:paper", []),
    ("three", "three:default", ["three_motion_blur.blur_amount=0.5"]),
    ("babylon", "babylon:default", []),
    ("babylon_screen", "babylon_screen:default", []),
]
# Scenes with a moving camera and a near object.
CAMERA_SCENES = ["dolly", "roll", "cockpit"]
FORMATS = re.compile(r'^(color|velocity|output)_format = .*\n', re.M)


def main():
    arguments = options(__doc__).parse_args()
    frames = {scene: frame for scene, frame in zip(SCENES, render(arguments))}
    frames |= zip(CAMERA_SCENES, render(arguments, CAMERA_SCENES))
    rows = []
    for folder, preset, values in PAIRS:
        if arguments.only and folder not in arguments.only:
            continue
        scenes = CAMERA_SCENES if folder == "babylon_screen" else SCENES
        values_of = lambda name: [value for value in values if value.split(".")[0] == name]
        filters = {"its formats": HERE.parent / "engine_shaders" / folder}
        filters["32 bits"] = widened(filters["its formats"], arguments.out / "wide" / folder)
        theirs = {
            kind: [blur_with(arguments, str(path.resolve()), scene, values_of(name_of(path))) for scene in scenes]
            for kind, path in filters.items()
        }
        ours = [blur_with(arguments, preset, scene, values_of(preset.split(":")[0])) for scene in scenes]
        moved = Difference(zip(ours, [frames[scene].color for scene in scenes]))
        differences = [Difference(zip(ours, theirs[kind])) for kind in filters]
        cells = [cell for difference in differences for cell in (f"{difference.largest:.0e}", f"{difference.mean:.1e}", str(difference.large))]
        with_values = "".join(f" {value.split('.', 1)[1]}" for value in values)
        rows.append([f"`{folder}`", f"`{preset}`{with_values}", *cells, f"{moved.mean:.4f}"])
    head = ["shader", "preset", "largest", "mean", "> 0.02", "largest, 32 bits", "mean", "> 0.02", "mean of the blur"]
    print(table(head, rows))
    frames = [frames[scene] for scene in SCENES]
    print(f"\n{', '.join(SCENES)} at {arguments.size}: {frames[0].depth.size * len(SCENES)} pixels; babylon_screen on {', '.join(CAMERA_SCENES)}.")
    for folder, samples in {"kino": kino.SAMPLES, "ppv2": kino.SAMPLES_PPV2}.items():
        if arguments.only and folder not in arguments.only:
            continue
        difference = explained_kino(arguments, frames, folder, samples)
        print(f"\n{folder} and its transcription on what the driver packed: largest {difference.largest:.0e}, {difference.small} pixels above 0.001.")
    if not arguments.only or "three" in arguments.only:
        difference = transcribed_three(arguments, frames)
        print(f"\nthree and its transcription: largest {difference.largest:.0e}.")


def explained_kino(arguments, frames, folder, samples):
    """The transcription, on velocity and depth as packed by the driver, and with tiles of halves that it rounds towards zero."""
    wide = arguments.out / "wide" / folder
    packing = wide.parent / f"{folder}_packing"
    shutil.rmtree(packing, ignore_errors=True)
    shutil.copytree(wide, packing)
    head, first, *_ = (packing / "filter.toml").read_text().split("[[pass]]\n")
    head = re.split(r"\[\[parameter\]\]", head)[0] + '[[texture]]\nname = "packed"\nformat = "rgb10a2unorm"\n\n'
    (packing / "filter.toml").write_text(f'{head}[[pass]]\n{first}[[pass]]\nshader = "show.wgsl"\nstage = "fragment"\n')
    (packing / "show.wgsl").write_text(
        "@group(0) @binding(0) var packed: texture_2d<f32>;\n\n@fragment\n"
        "fn main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {\n"
        "    return textureLoad(packed, vec2<i32>(position.xy), 0);\n}\n")
    pairs = []
    for scene, frame in zip(SCENES, frames):
        radius = np.float32(kino.MAX_BLUR_PERCENT * frame.depth.shape[0] // 100)
        packed = blur_with(arguments, str(packing.resolve()), scene, [])
        kino.packed = lambda *_: ((packed[..., :2] * 2 - 1) * radius, packed[..., 2])
        theirs = kino.blur(frame.color, frame.velocity, frame.depth, frame.exposure, jump_flood.halved, samples)
        pairs.append((blur_with(arguments, str(wide.resolve()), scene, []), theirs))
    return Difference(pairs)


def transcribed_three(arguments, frames):
    """MotionBlur of three.js, as in ../engine_shaders/three: with halves."""
    folder = HERE.parent / "engine_shaders" / "three"
    pairs = []
    for scene, frame in zip(SCENES, frames):
        height, width = frame.depth.shape
        columns, rows = np.meshgrid(np.arange(width), np.arange(height))
        uv = np.stack([(columns + 0.5) / width, (rows + 0.5) / height], -1).astype(np.float32)
        halves = lambda values: values.astype(np.float16).astype(np.float32)
        color = halves(frame.color)
        ndc = halves(frame.velocity * np.float32([2 / width, -2 / height]))
        total = bevy.linear(color, uv)
        for i in range(1, 17):
            total = total + bevy.linear(color, uv + ndc * np.float32(frame.exposure * (i / 15 - 0.5)))
        pairs.append((blur_with(arguments, str(folder.resolve()), scene, []), total / 16))
    return Difference(pairs)


def name_of(folder):
    return re.search(r'^name = "(.*)"', (folder / "filter.toml").read_text(), re.M)[1]


def widened(folder, copy):
    """A copy of a filter with inputs and output of 32 bits."""
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(folder, copy)
    manifest = copy / "filter.toml"
    manifest.write_text(FORMATS.sub("", manifest.read_text()))
    return copy


if __name__ == "__main__":
    sys.exit(main())
