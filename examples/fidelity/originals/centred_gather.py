"""Two gathers on both sides of a pixel along its own motion, in numpy: Armory's mode Object, and Spartan Engine's of June 2024."""

import numpy as np
from sampling import linear

F = np.float32


def places(height, width):
    """Returns texture coordinates of the pixels' centres, from the top left."""
    columns, rows = np.meshgrid(np.arange(width, dtype=F), np.arange(height, dtype=F))
    return np.stack([(columns + F(0.5)) / F(width), (rows + F(0.5)) / F(height)], -1)


def armory(color, velocity, depth, exposure, frame_index, parameters):
    """Armory's motion_blur_veloc_pass.frag.glsl, with _InvY, so that texture coordinates count rows from the top.

    https://github.com/armory3d/armory at 258a33de5511e0b190f11e8982ff65e43a7d9592. Its velocity is what make_mesh.py writes: now minus
    before, in texture coordinates with +y up. The intensity is 1; frameScale is the exposure here.
    """
    height, width = depth.shape
    coordinates = places(height, width)
    velocity = velocity * np.array([1 / width, -1 / height], F) * F(exposure)
    velocity = velocity * np.array([1, -1], F)
    total = linear(color, coordinates)
    samples = 8
    for i in range(samples):
        offset = velocity * F(F(i) / F(samples - 1) - F(0.5))
        total = total + linear(color, coordinates + offset)
    return total / F(samples + 1)


def spartan_2024(color, velocity, depth, exposure, frame_index, parameters):
    """Spartan Engine's motion_blur.hlsl.

    https://github.com/PanosK92/SpartanEngine at 014b9d9335cf3e9709a57a06c7ae3528535af724. Its velocity is what g_buffer.hlsl writes: now
    minus before, in texture coordinates with +y down. The shutter divided by the frame's duration is the exposure.
    """
    height, width = depth.shape
    coordinates = places(height, width)
    border = np.pad(velocity * np.array([1 / width, 1 / height], F), ((1, 1), (1, 1), (0, 0)), mode="edge")
    velocity = sum(border[y : y + height, x : x + width] for y in range(3) for x in range(3)) / F(9)
    velocity = velocity * F(exposure)
    total = color.copy()
    samples = 32
    for i in range(1, samples):
        offset = velocity * F(F(i) / F(samples - 1) - F(0.5))
        total = total + linear(color, coordinates + offset)
    return total / F(samples)


ORIGINALS = {"centred_gather:armory": armory, "centred_gather:spartan_2024": spartan_2024}
