"""vort_MotionBlur for ReShade, in numpy, from vort_MotionBlur.fxh and its includes at b410b9f0.

What its scatter pass finds, the motion from the next frame back to this one, comes in as `velocity_next`. The blue noise is the noise that
the preset lists; UI_MB_BlurMult is the exposure. The picture is scRGB, and depth reversed, from 0.1 m on. `default_as_listed` has what
the preset lists as different: motion in pixels, and textures of 32 bits.
"""

import numpy as np
from sampling import linear

F = np.float32

FAR_PLANE = F(1000)
MAX_SAMPLES = 9
BOX_OFFS = (
    (0, 0), (1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, -1), (-1, 1), (1, -1), (2, 0), (0, 2), (-2, 0), (0, -2),
    (2, 1), (2, -1), (-2, 1), (-2, -1), (1, 2), (-1, 2), (1, -2), (-1, -2), (2, 2), (-2, -2), (-2, 2), (2, -2))


def dot(a, b):
    return (a * b).sum(-1, dtype=F)


def length(v):
    return np.sqrt(dot(v, v))


def saturate(x):
    return np.clip(x, F(0), F(1))


def point(image, uv):
    height, width = image.shape[:2]
    at = np.floor(uv * np.array([width, height], F)).astype(int)
    return image[np.clip(at[..., 1], 0, height - 1), np.clip(at[..., 0], 0, width - 1)]


def gradient_noise(x, y):
    return (F(52.9829189) * ((F(0.06711056) * x + F(0.00583715) * y) % F(1))) % F(1)


def get_depth(metres):
    depth = F(1) - F(0.1) / metres
    return saturate(depth / (FAR_PLANE - depth * (FAR_PLANE - F(1))))


def limit_motion(motion, exposure, k):
    old_len = length(motion)
    new_len = np.minimum(old_len * F(0.5) * F(exposure), F(k * 2))
    motion = motion * (new_len / np.maximum(F(1e-15), old_len))[..., None]
    return np.where((old_len < 1)[..., None], F(0), motion)


def longest(motions, contributes=None):
    best = np.zeros_like(motions[0])
    for i, motion in enumerate(motions):
        wins = dot(motion, motion) > dot(best, best)
        wins = wins if contributes is None else wins & contributes(motion, i)
        best = np.where(wins[..., None], motion, best)
    return best


def tile_down(motion, k, stored):
    height, width = (side // k * k for side in motion.shape[:2])
    horizontal = stored(longest([motion[:height, x:width:k] for x in range(k)]))
    return stored(longest([horizontal[y::k] for y in range(k)]))


def is_contributing(motion, i):
    offs = np.array(BOX_OFFS[i], F)
    if offs[0] * offs[1] == 0:
        return True
    with np.errstate(divide="ignore", invalid="ignore"):
        cos = dot(-offs, motion) / np.sqrt(dot(offs, offs) * dot(motion, motion))
        rads = (F(-0.156583) * np.abs(cos) + F(1.57079632679)) * np.sqrt(F(1) - np.abs(cos))
    rel_angle = np.where(cos < 0, F(3.14159265359) - rads, rads)
    return (rel_angle < 0.7854) | (rel_angle > 2.3561)


def neighbour_max(tiles, exposure, k, stored):
    rows, columns = tiles.shape[:2]
    padded = np.pad(tiles, ((2, 2), (2, 2), (0, 0)))
    motions = [padded[2 + y : 2 + y + rows, 2 + x : 2 + x + columns] for x, y in BOX_OFFS]
    return stored(limit_motion(longest(motions, is_contributing), exposure, k))


def tile_offs(x, y, k, screen):
    noise = (gradient_noise(y + F(0.5), x + F(0.5)) - F(0.5)) * F(0.25)
    along = np.where(((x + y) % 2 == 1)[..., None], np.array([1, 0], F), np.array([0, 1], F))
    return noise[..., None] * (F(k) / screen) * along


class Side:
    """One side of the instant: motions of pixels, and what PS_Blur knows before its loop."""

    def __init__(self, motion, max_motion, z, uv):
        self.motion, self.z = motion, z
        self.max_motion, self.max_len = max_motion, length(max_motion)
        self.cen_len = length(motion)
        self.is_still = self.cen_len < 1
        norm = lambda v: v / np.maximum(F(1e-15), length(v))[..., None]
        self.max_norm, self.cen_norm = norm(max_motion), norm(motion)
        self.max_parallel = np.where(self.is_still, F(1), np.abs(dot(self.cen_norm, self.max_norm)))

    def tap(self, color, uv, screen, st, inv_half_samples, z_scale, use_max):
        use_max = self.is_still | use_max
        norm = np.where(use_max[..., None], self.max_norm, self.cen_norm)
        motion = norm * np.where(use_max, self.max_len, self.cen_len)[..., None] / screen
        parallel = np.where(use_max, self.max_parallel, F(1))
        tap_uv = uv - (st * inv_half_samples)[..., None] * motion
        tap_motion, tap_z = point(self.motion, tap_uv), linear(self.z[..., None], tap_uv)[..., 0]
        tap_len = length(tap_motion)
        depth_cmp = saturate(F(0.5) + F(z_scale) * np.stack([tap_z - self.z, self.z - tap_z], -1))
        with np.errstate(divide="ignore", invalid="ignore"):
            px_to_step = F(1) / (inv_half_samples * self.max_len)
            # saturate() of NaN is 0.
            spread = np.nan_to_num(np.stack([self.cen_len, tap_len], -1) * px_to_step[..., None], posinf=1e9)
        spread = saturate(spread - np.maximum(F(0), st - F(1))[..., None])
        tap_norm = tap_motion / np.maximum(F(1e-15), tap_len)[..., None]
        weight = depth_cmp * spread * np.stack([parallel, np.abs(dot(tap_norm, norm))], -1)
        return linear(color, tap_uv), tap_z, tap_len, weight


def blur(color, velocity, depth, exposure, velocity_next, stored, z_scale):
    height, width = depth.shape
    screen, k = np.array([width, height], F), height // 27
    x, y = np.meshgrid(np.arange(width, dtype=F), np.arange(height, dtype=F))
    uv = np.stack([x + F(0.5), y + F(0.5)], -1) / screen
    z, sides = stored(get_depth(depth)), []
    for motion in (-velocity, velocity_next):
        motion = stored(motion, screen)
        near = neighbour_max(tile_down(motion, k, stored), exposure, k, stored)
        max_motion = point(near, uv + tile_offs(x, y, k, screen))
        sides.append(Side(stored(limit_motion(motion, exposure, k)), max_motion, z, uv))
    max_len = np.maximum(sides[0].max_len, sides[1].max_len)
    half_samples = np.clip(np.ceil(max_len * F(0.5)), 3, MAX_SAMPLES).astype(int)
    half_samples += half_samples % 2 == 0
    inv_half_samples = F(1) / half_samples.astype(F)
    noise = gradient_noise(x + F(0.5), y + F(0.5)) - F(0.5)
    bg, fg = np.zeros((height, width, 4), F), np.zeros((height, width, 4), F)
    for j in range(MAX_SAMPLES):
        steps = F(j) + F(0.5) + noise, F(j) + F(0.5) - noise
        (color0, z0, len0, w0), (color1, z1, len1, w1) = (
            side.tap(color, uv, screen, st, inv_half_samples, z_scale, j % 2 == 0) for side, st in zip(sides, steps))
        mir = np.stack([z0 > z1, len1 > len0], -1)
        w0 = np.where(mir.all(-1)[..., None], w1, w0)
        w1 = np.where(mir.any(-1)[..., None], w1, w0)
        for tap, weight in ((color0, w0), (color1, w1)):
            tap = np.concatenate([tap, np.ones_like(tap[..., :1])], -1) * (j < half_samples)[..., None]
            bg, fg = bg + tap * weight[..., :1], fg + tap * weight[..., 1:]
    cen_len = np.maximum(F(0.5), np.maximum(sides[0].cen_len, sides[1].cen_len))
    bg += np.concatenate([color, np.ones_like(z)[..., None]], -1) * saturate(F(0.05) * half_samples.astype(F) / cen_len)[..., None]
    acc = (bg + fg) / (half_samples * F(2) + F(1))[..., None]
    filled = acc[..., :3] + saturate(F(1) - acc[..., 3:]) * bg[..., :3] / bg[..., 3:]
    return np.where((max_len < 1)[..., None], color, filled)


def halves(values, unit=F(1)):
    return (values / unit).astype(np.float16).astype(F) * unit


def default(color, velocity, depth, exposure, frame_index, parameters, velocity_next):
    return blur(color, velocity, depth, exposure, velocity_next, halves, 100)


def default_as_listed(color, velocity, depth, exposure, frame_index, parameters, velocity_next):
    return blur(color, velocity, depth, exposure, velocity_next, lambda values, unit=1: values, 100)


ORIGINALS = {"vort:default": default}
AS_LISTED = {"vort:default": default_as_listed}
