"""The motion blur of three.js, in numpy, from examples/jsm/tsl/display/MotionBlur.js at 8540d9f.

Velocity is what the engine's VelocityNode writes: normalised device coordinates, +y up, now minus before. The effect adds it to
texture coordinates, which have +y down on WebGPU. The factor on it is half the exposure.
"""

import numpy as np
from sampling import linear

F = np.float32

SAMPLES = 16


def default(color, velocity, depth, exposure, frame_index, parameters):
    height, width = depth.shape
    columns, rows = np.meshgrid(np.arange(width, dtype=F), np.arange(height, dtype=F))
    uvs = np.stack([(columns + F(0.5)) / F(width), (rows + F(0.5)) / F(height)], -1)
    ndc = velocity * np.array([2 / width, -2 / height], F) * F(0.5 * exposure)
    result = linear(color, uvs)
    for i in range(1, SAMPLES + 1):
        offset = ndc * F(F(i) / F(SAMPLES - 1) - F(0.5))
        result = result + linear(color, uvs + offset)
    return result / F(SAMPLES)


ORIGINALS = {"three:default": default}
