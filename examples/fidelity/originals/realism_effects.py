"""MotionBlurEffect of realism-effects, in numpy, from src/motion-blur/shader/motion_blur.frag at 061daea.

Velocity is what its VelocityDepthNormalPass writes: now minus before in texture coordinates, 0 where nothing is drawn. Its y is up, and so
is that of texture coordinates; here both are down. Its blue noise is the noise that the presets list. deltaTime is 1/60 s in the
original, and 1/100 s in `scaled`.
"""

import numpy as np
from sampling import linear

F = np.float32

SAMPLES = 16


def gradient_noise(x, y):
    inner = (F(0.06711056) * x + F(0.00583715) * y) % F(1)
    return (F(52.9829189) * inner) % F(1)


def blur(color, velocity, depth, exposure, delta_time):
    height, width = depth.shape
    columns, rows = np.meshgrid(np.arange(width, dtype=F), np.arange(height, dtype=F))
    uv = np.stack([(columns + F(0.5)) / F(width), (rows + F(0.5)) / F(height)], -1)
    drawn = np.where(depth < F(1e10), F(1), F(0))[..., None]
    motion = velocity / np.array([width, height], F) * drawn
    did_move = (motion * motion).sum(-1) > F(0.000000001)
    blue_noise = np.stack([gradient_noise(columns, rows), gradient_noise(rows + F(37), columns + F(17))], -1)
    jitter_offset = motion * F(exposure) * blue_noise
    frame_speed = F(1 / 100 / delta_time)
    start = uv + (jitter_offset - motion * F(exposure) * F(0.5)) * frame_speed
    end = uv + (jitter_offset + motion * F(exposure) * F(0.5)) * frame_speed
    start, end = np.maximum(F(0), start), np.minimum(F(1), end)
    blurred = color.copy()
    for i in range(SAMPLES + 1):
        part = F(i) / F(SAMPLES)
        blurred = blurred + linear(color, start * (F(1) - part) + end * part)
    return np.where(did_move[..., None], blurred / F(SAMPLES + 2), color)


def default(color, velocity, depth, exposure, frame_index, parameters):
    """At 60 frames per second; the intensity is the exposure over 0.6."""
    return blur(color, velocity, depth, exposure / 0.6, 1 / 60)


ORIGINALS = {"realism_effects:default": default}
