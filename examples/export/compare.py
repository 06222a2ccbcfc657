"""Prints how far two OpenEXR pictures of one size are from each other: `compare.py ENGINE.exr FRAME.exr`."""

import sys

import numpy as np
import OpenEXR


def read(path):
    with OpenEXR.File(path) as file:
        channels = file.parts[0].channels
        name = "RGB" if "RGB" in channels else "RGBA"
        return channels[name].pixels[..., :3].astype(float)


engine, frame = (read(path) for path in sys.argv[1:3])
if engine.shape != frame.shape:
    sys.exit(f"{sys.argv[1]} has {engine.shape[1]}x{engine.shape[0]} pixels, {sys.argv[2]} {frame.shape[1]}x{frame.shape[0]}")
difference = np.abs(engine - frame)
print(f"mean radiance: {engine.mean():.4f} and {frame.mean():.4f}, ratio {engine.mean() / frame.mean():.4f}")
print(f"difference: median {np.median(difference):.4f}, 95 % of pixels below {np.percentile(difference, 95):.4f}")
