"""The motion blur of the Bevy engine, in numpy, from crates/bevy_post_process/src/motion_blur/motion_blur.wesl at 4805ca7.

The shader runs per pixel: positions are in UV, motion is in UV per frame, and the depth buffer is 0 at infinity. With MSAA it
reads whole texels (textureLoad at the truncated position), without it a linear sampler that ends at the border.
"""

import numpy as np
from sampling import linear

F = np.float32

# Any near plane will do: the shader only compares depths.
NEAR = F(0.1)


def texel(image, x, y):
    height, width = image.shape[:2]
    return image[np.clip(y, 0, height - 1), np.clip(x, 0, width - 1)]


def whole(image, uv):
    height, width = image.shape[:2]
    at = (uv * np.array([width, height], F)).astype(int)
    return texel(image, at[..., 0], at[..., 1])


def gradient_noise(x, y, frame):
    walk = F(5.588238) * F(frame % 64)
    inner = (F(0.06711056) * (x + walk) + F(0.00583715) * (y + walk)) % F(1)
    return (F(52.9829189) * inner) % F(1)


def blur(color, velocity, depth, exposure, frame_index, samples, fetch):
    height, width = depth.shape
    size = np.array([width, height], F)
    columns, rows = np.meshgrid(np.arange(width, dtype=F), np.arange(height, dtype=F))
    uv = np.stack([(columns + F(0.5)) / F(width), (rows + F(0.5)) / F(height)], -1)
    motion = velocity / size
    device = np.where(depth >= 1e10, F(0), NEAR / depth).astype(F)
    exposure_vector = F(exposure) * motion
    noise = gradient_noise(columns, rows, frame_index)
    total = np.zeros((height, width), F)
    mixed = np.zeros((height, width, 3), F)
    for i in range(-samples, samples):
        step = F(0.5) * exposure_vector * ((F(i) + noise) / F(samples))[..., None]
        at = uv + step
        on_screen = ((at >= 0) & (at <= 1)).all(-1)
        tap_color, tap_motion, tap_depth = fetch(color, at), fetch(motion, at), whole(device, at)
        in_front = ~((tap_depth < device) & (tap_depth > 0))
        speed, tap_speed = np.linalg.norm(step, axis=-1), np.linalg.norm(tap_motion, axis=-1) / F(2)
        with np.errstate(divide="ignore", invalid="ignore"):
            cosine = (step * tap_motion).sum(-1) / (speed * tap_speed * 2)
        similarity = np.clip(np.abs(np.nan_to_num(cosine)), 0, 1)
        dropped = (tap_depth != 0) & in_front & (tap_speed * similarity < speed)
        weight = np.where(on_screen & ~dropped, F(1), F(0))
        total += weight
        mixed += weight[..., None] * tap_color
    pixels = motion * size
    stays = (total <= 0) | ((pixels * pixels).sum(-1) < 1)
    return np.where(stays[..., None], color, mixed / np.maximum(total, 1)[..., None])


def default(color, velocity, depth, exposure, frame_index, parameters):
    return blur(color, velocity, depth, exposure, frame_index, 1, linear)


def msaa(color, velocity, depth, exposure, frame_index, parameters):
    return blur(color, velocity, depth, exposure, frame_index, 1, whole)


def high(color, velocity, depth, exposure, frame_index, parameters):
    return blur(color, velocity, depth, exposure, frame_index, 8, linear)


ORIGINALS = {"bevy:default": default, "bevy:msaa": msaa, "bevy:high": high}
