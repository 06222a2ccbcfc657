"""Compares captures of three.js with the tracer's renders, and three.js's blur with the mean of its own sub-frames.

    shuttertruth truths render railing --size 320x180 --velocity previous_frame --out out/render
    python3 engines/threejs/compare.py out/capture/railing out/render/railing

Arguments are pairs: a capture, and the folder of the rendered scene, or the word `still` for a capture with `--before 0`, in which
nothing may move. Velocity is in pixels per frame. Its error is the length of the difference, at pixels where both have the same object
at the centre. Objects with errors above a hundredth of a pixel are named.
"""

import json
import sys
from pathlib import Path

import numpy as np
import OpenEXR

# Sum of the weights of three.js's blur with 16 taps: it adds the pixel itself to them, and divides by 16.
GAIN = 17 / 16

def read(path):
    with OpenEXR.File(str(path), separate_channels=True) as file:
        return {name: channel.pixels.astype(float) for name, channel in file.parts[0].channels.items()}


def read_color(path):
    planes = read(path)
    return np.stack([planes[name] for name in "RGB"], axis=-1)


def read_table(path):
    """Reads `key = value` lines; the standard library reads TOML from Python 3.11 on only."""
    lines = (line.split(" = ", 1) for line in path.read_text().splitlines() if " = " in line)
    return {key: json.loads(value) for key, value in lines}


def read_capture(folder):
    """Reads velocity in pixels per frame, +y down, and depth in metres, infinite for the background."""
    convention = read_table(folder / "engine.toml")
    velocity = read(folder / "velocity.exr")
    height, width = velocity["velocity.X"].shape
    velocity = np.stack([velocity["velocity.X"] * width / 2, -velocity["velocity.Y"] * height / 2], axis=-1)
    near, far = convention["near"], convention["far"]
    window = read(folder / "depth.exr")["Z"]
    depth = near * far / (far - window * (far - near))
    return velocity, np.where(window == 1, np.inf, depth), read(folder / "object.exr")["object"]


def spread(values):
    if values.size == 0:
        return "none"
    middle, most = np.percentile(values, [50, 95])
    return f"median {middle:.4f}, 95 % {most:.4f}, worst {values.max():.4f}"


def compare_vectors(folder, rendered):
    velocity, depth, ids = read_capture(folder)
    sky = np.isinf(depth)
    expected = np.zeros_like(velocity)
    if rendered.name != "still":
        frame = read(rendered / "frame.exr")
        same = ids == frame["object.id"]
        print(f"  same object: {100 * same.mean():.2f} % of pixels")
        surface = same & ~sky
        print(f"  depth, relative: {spread(np.abs(depth[surface] / frame['Z'][surface] - 1))}")
        expected = np.stack([frame["velocity.X"], frame["velocity.Y"]], axis=-1)
        ids = np.where(same, ids, -1)
    error = np.linalg.norm(velocity - expected, axis=-1)
    print(f"  velocity of all objects: {spread(error[ids > 0])} px")
    names = json.loads((folder / "manifest.json").read_text())["objects"]
    masks = [(name, ids == at) for at, name in enumerate(names)]
    errors = [(np.percentile(error[mask], 95), name, mask) for name, mask in masks if mask.sum() >= 8]
    worst = [one for one in errors if one[0] > 0.01]
    for most, name, mask in sorted(worst, key=lambda one: -one[0])[:4]:
        length = [np.linalg.norm(one[mask], axis=-1).mean() for one in (velocity, expected)]
        print(f"    {name}: {spread(error[mask])} px; length {length[0]:.2f} px, expected {length[1]:.2f} px")


def compare_blur(folder):
    parts = [read_color(path) for path in sorted((folder / "subframes").iterdir())]
    truth = np.mean(parts, axis=0)
    color = read_color(folder / "color.exr")
    moving = np.ptp(parts, axis=0).max(axis=-1) > 1e-3
    error = lambda picture: np.abs(picture - truth)[moving].mean()
    blurred, turned = (read_color(folder / f"{name}.exr") for name in ("blurred", "blurred_y_turned"))
    velocity, _, _ = read_capture(folder)
    still = (np.linalg.norm(velocity, axis=-1) < 1e-3) & (color.min(axis=-1) > 1e-3)
    if still.any():
        gain = np.median((blurred / np.maximum(color, 1e-9))[still])
        print(f"  gain where nothing moves: {gain:.6f}")
    if not moving.any():
        return
    print(f"  blur, mean error where anything moves ({100 * moving.mean():.0f} % of pixels): {error(blurred):.4f}; "
          f"without any blur {error(color):.4f}, with a gain of 1 {error(blurred / GAIN):.4f}, "
          f"with y turned as well {error(turned / GAIN):.4f}")


if len(sys.argv) < 3 or len(sys.argv) % 2 == 0:
    sys.exit(__doc__)
for folder, rendered in zip(map(Path, sys.argv[1::2]), map(Path, sys.argv[2::2])):
    print(f"{folder}:")
    compare_vectors(folder, rendered)
    compare_blur(folder)
