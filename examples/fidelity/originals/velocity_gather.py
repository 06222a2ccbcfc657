"""The motion blur of E - Departure, in numpy, from the shader in the article A journey into shaders: Blurry things.

Its loop goes from 0 in steps of 0.1 while it is below 1: ten taps of one weight, the pixel among them, along the motion from one frame
to the next. Velocity keeps its floats here, and the trail is as long as the frame's shutter is open, as the preset says.
"""

import numpy as np

F = np.float32


def linear(image, x, y):
    height, width = image.shape[:2]
    left, top = np.floor(x - F(0.5)), np.floor(y - F(0.5))
    fx, fy = (x - F(0.5) - left)[..., None], (y - F(0.5) - top)[..., None]
    column, row = left.astype(int), top.astype(int)
    read = lambda dx, dy: image[np.clip(row + dy, 0, height - 1), np.clip(column + dx, 0, width - 1)]
    above = read(0, 0) * (1 - fx) + read(1, 0) * fx
    below = read(0, 1) * (1 - fx) + read(1, 1) * fx
    return above * (1 - fy) + below * fy


def blur(color, velocity, exposure, taps):
    height, width = color.shape[:2]
    x, y = np.meshgrid(np.arange(width, dtype=F) + F(0.5), np.arange(height, dtype=F) + F(0.5))
    total = np.zeros_like(color)
    for tap in range(taps):
        along = F(tap) / F(taps) * F(exposure)
        total += linear(color, x + along * velocity[..., 0], y + along * velocity[..., 1])
    return total / F(taps)


def original(taps):
    return lambda color, velocity, depth, exposure, frame_index, parameters: blur(color, velocity, exposure, taps)


ORIGINALS = {
    "velocity_gather:departure": original(10),
    "velocity_gather:coarse": original(8),
    "velocity_gather:fine": original(20),
}
