"""Prints the differences between two OpenEXR pictures of one size: `compare.py ENGINE.exr FRAME.exr`.

The second picture may be a truth. Then its mean is compared, the difference of its halves tells its own noise, and each object is
compared where it fills at least 100 pixels.
"""

import sys

import numpy as np
import OpenEXR


def read(path):
    """Returns the picture; for a truth also half the difference of its halves, and its objects' coverage."""
    with OpenEXR.File(path) as file:
        channels = file.parts[0].channels
        color = lambda name: channels[name].pixels[..., :3].astype(float)
        if "A" in channels:
            prefix = "A.coverage."
            coverage = {c.removeprefix(prefix): channels[c].pixels for c in channels if c.startswith(prefix)}
            return (color("A") + color("B")) / 2, (color("A") - color("B")) / 2, coverage
        return color("RGB" if "RGB" in channels else "RGBA"), None, {}


(engine, _, _), (frame, noise, coverage) = (read(path) for path in sys.argv[1:3])
if engine.shape != frame.shape:
    sys.exit(f"{sys.argv[1]} has {engine.shape[1]}x{engine.shape[0]} pixels, {sys.argv[2]} {frame.shape[1]}x{frame.shape[0]}")
difference = np.abs(engine - frame)
print(f"mean radiance: {engine.mean():.4f} and {frame.mean():.4f}, ratio {engine.mean() / frame.mean():.4f}")
print(f"difference: median {np.median(difference):.4f}, 95 % of pixels below {np.percentile(difference, 95):.4f}")
if noise is not None:
    noise = np.abs(noise)
    print(f"noise of the truth: median {np.median(noise):.4f}, 95 % of pixels below {np.percentile(noise, 95):.4f}")
for name, share in coverage.items():
    filled = share > 0.999
    if filled.sum() >= 100:
        print(f"{name}: ratio {engine[filled].mean() / frame[filled].mean():.4f} over {filled.sum()} pixels")
