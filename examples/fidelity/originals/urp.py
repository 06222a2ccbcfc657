"""The motion blur of Unity's URP, mode Camera And Objects, in numpy, from CameraMotionBlur.shader at 438e586.

Motion vectors are now minus before in texture coordinates. The intensity is half the exposure. The noise is
InterleavedGradientNoise of the render pipelines' core, for frame 0. Colours are read at points.
"""

import numpy as np

F = np.float32


def point(image, uv):
    height, width = image.shape[:2]
    at = np.floor(uv * np.array([width, height], F)).astype(int)
    return image[np.clip(at[..., 1], 0, height - 1), np.clip(at[..., 0], 0, width - 1)]


def gradient_noise(position):
    inner = (position[..., 0] * F(0.06711056) + position[..., 1] * F(0.00583715)) % F(1)
    return (F(52.9829189) * inner) % F(1)


def blur(color, velocity, intensity, iterations):
    height, width = color.shape[:2]
    size = np.array([width, height], F)
    columns, rows = np.meshgrid(np.arange(width, dtype=F), np.arange(height, dtype=F))
    uv = np.stack([(columns + F(0.5)) / F(width), (rows + F(0.5)) / F(height)], -1)
    # Twice as long, which the original does on purpose.
    motion = -(velocity / size) * F(intensity) * F(2)
    random = gradient_noise(uv * size)[..., None]
    inverse_count = F(1) / F(2 * iterations)
    total = np.zeros_like(color)
    for i in range(iterations):
        for sign in (F(-1), F(1)):
            offset = (F(i) + F(0.5)) + sign * (random - F(0.5))
            total += point(color, uv + offset * inverse_count * motion * sign)
    return total * inverse_count


def quality(iterations):
    return lambda color, velocity, depth, exposure, frame_index, parameters: blur(color, velocity, 0.5 * exposure, iterations)


ORIGINALS = {
    "urp:default": quality(2),
    "urp:medium": quality(3),
    "urp:high": quality(4),
}
