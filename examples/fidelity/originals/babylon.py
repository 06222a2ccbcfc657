"""The object based motion blur of Babylon.js, in numpy, from ShadersWGSL/motionBlur.fragment.fx at 39a32df.

Velocity is what the prepass writes (ShadersInclude/pbrBlockPrePass.fx): now minus before in texture coordinates, its cube root in 8 bits
per axis, with an alpha of 1 where something is drawn and 0 elsewhere. Its y is up, and so is that of texture coordinates; here both
are down. Taps read the nearest texel, which is the default of post-processes. motionStrength is 1, and so is motionScale, at 60 frames per
second; the exposure scales them.
"""

import numpy as np

F = np.float32

SAMPLES = 32


def nearest(image, uv):
    height, width = image.shape[:2]
    at = np.floor(uv * np.array([width, height], F)).astype(int)
    return image[np.clip(at[..., 1], 0, height - 1), np.clip(at[..., 0], 0, width - 1)]


def written(velocity_uv):
    root = np.abs(velocity_uv) ** F(1 / 3) * np.sign(velocity_uv) * F(0.5) + F(0.5)
    return (np.floor(np.clip(root, 0, 1) * F(255) + F(0.5)) / F(255)).astype(F)


def default(color, velocity, depth, exposure, frame_index, parameters):
    height, width = depth.shape
    columns, rows = np.meshgrid(np.arange(width, dtype=F), np.arange(height, dtype=F))
    uv = np.stack([(columns + F(0.5)) / F(width), (rows + F(0.5)) / F(height)], -1)
    texel_size = F(1) / np.array([width, height], F)
    drawn = np.where(depth < F(1e10), F(1), F(0))[..., None]
    unpacked = written(velocity * texel_size) * F(2) - F(1)
    motion = np.abs(unpacked) ** F(3) * np.sign(unpacked) * drawn
    motion = motion * F(exposure)
    speed = np.linalg.norm(motion / texel_size, axis=-1)
    samples_count = np.clip(speed, F(1), F(SAMPLES)).astype(int)
    with np.errstate(invalid="ignore"):
        step = np.nan_to_num(motion / np.linalg.norm(motion, axis=-1)[..., None]) * texel_size
    hlim = -samples_count.astype(F) * F(0.5) + F(0.5)
    result = color.copy()
    for i in range(1, SAMPLES):
        offset = uv + step * (hlim + F(i))[..., None]
        result = result + np.where((i < samples_count)[..., None], nearest(color, offset), F(0))
    return result / samples_count[..., None].astype(F)


ORIGINALS = {"babylon:default": default}
