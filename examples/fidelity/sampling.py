"""Texture samplers in numpy, for the transcriptions."""

import numpy as np

F = np.float32


def linear(image, uv):
    """Reads an image between pixel centres; beyond its border it repeats. `uv` is 0 to 1 from the top left."""
    height, width = image.shape[:2]
    at = uv * np.array([width, height], F) - F(0.5)
    base = np.floor(at)
    fx, fy = (at - base)[..., 0:1], (at - base)[..., 1:2]
    x, y = base[..., 0].astype(int), base[..., 1].astype(int)
    read = lambda dx, dy: image[np.clip(y + dy, 0, height - 1), np.clip(x + dx, 0, width - 1)]
    top = read(0, 0) * (1 - fx) + read(1, 0) * fx
    bottom = read(0, 1) * (1 - fx) + read(1, 1) * fx
    return top * (1 - fy) + bottom * fy
