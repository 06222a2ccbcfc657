"""Compares presets with the shaders that they follow, unmodified, on frames of three scenes.

    sh examples/engine_shaders/fetch.sh
    python3 examples/fidelity/unmodified.py --program shuttertruth --scenes-dir scenes --out out/unmodified

Each filter of ../engine_shaders runs twice: with textures of the formats that its engine has, and with 32-bit floats wherever filter.toml
chooses the format. It prints one row per pair as Markdown.
"""

import re
import shutil
import sys

from compare import HERE, SCENES, Difference, blur_with, parse, render, table

# (filter of ../engine_shaders, preset, parameters of the preset that differ)
PAIRS = [
    ("bevy", "bevy:default", []),
    ("bevy", "bevy:high", ["bevy_motion_blur.samples=8"]),
    ("kino", "kino:default", []),
    ("godot_jump_flood_paper", "jump_flood:paper", []),
    ("godot_jump_flood_paper", "jump_flood:paper", ["jump_flood.map=float16"]),
    ("godot_jump_flood_july_2024", "jump_flood:july_2024", []),
    ("godot_jump_flood", "jump_flood:paper", []),
    ("godot_jump_flood", "jump_flood:july_2024", []),
    ("godot_guertin", "guertin:paper", []),
    ("godot_guertin", "mcguire:paper", []),
]
FORMATS = re.compile(r'^(color|velocity|output)_format = .*\n', re.M)


def main():
    arguments = parse(__doc__)
    frames = render(arguments)
    rows = []
    for folder, preset, values in PAIRS:
        if arguments.only and folder not in arguments.only:
            continue
        own = lambda name: [value for value in values if value.split(".")[0] == name]
        filters = {"its formats": HERE.parent / "engine_shaders" / folder}
        filters["32 bits"] = widened(filters["its formats"], arguments.out / "wide" / folder)
        theirs = {
            kind: [blur_with(arguments, str(path.resolve()), scene, own(name_of(path))) for scene in SCENES]
            for kind, path in filters.items()
        }
        ours = [blur_with(arguments, preset, scene, own(preset.split(":")[0])) for scene in SCENES]
        moved = Difference(zip(ours, [frame.color for frame in frames]))
        differences = [Difference(zip(ours, theirs[kind])) for kind in filters]
        cells = [cell for found in differences for cell in (f"{found.largest:.0e}", f"{found.mean:.1e}", str(found.large))]
        with_values = "".join(f" {value.split('.')[1]}" for value in values)
        rows.append([f"`{folder}`", f"`{preset}`{with_values}", *cells, f"{moved.mean:.4f}"])
    head = ["shader", "preset", "largest", "mean", "> 0.02", "largest, 32 bits", "mean", "> 0.02", "mean of the blur"]
    print(table(head, rows))
    print(f"\n{', '.join(SCENES)} at {arguments.size}: {frames[0].depth.size * len(SCENES)} pixels.")


def name_of(folder):
    return re.search(r'^name = "(.*)"', (folder / "filter.toml").read_text(), re.M)[1]


def widened(folder, copy):
    """A copy of a filter whose inputs and output have 32 bits."""
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(folder, copy)
    manifest = copy / "filter.toml"
    manifest.write_text(FORMATS.sub("", manifest.read_text()))
    return copy


if __name__ == "__main__":
    sys.exit(main())
