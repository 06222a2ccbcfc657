"""KinoMotion, in numpy, from ReconstructionFilter.cs, Prefilter.cginc and Reconstruction.cginc at 35d5d51; and the motion blur of Unity's
Post Processing Stack, from MotionBlur.cs, MotionBlur.shader and StdLib.hlsl at ea3f7dd: the same with ten samples, and without the clock.

Textures between the passes are sampled at points, at UV: where the picture's sides are no multiples of a tile, the original has
fewer tiles and stretches them. The clock stands at 0. What the presets list as different: tiles of 32-bit floats.
"""

import numpy as np
from sampling import linear

F = np.float32

MAX_BLUR_PERCENT = 5
SAMPLES, SAMPLES_PPV2 = 8, 10
FAR_PLANE = F(1000)


def length(v):
    return np.sqrt((v * v).sum(-1, dtype=F))


def saturate(x):
    return np.clip(x, F(0), F(1))


def point(image, uv):
    height, width = image.shape[:2]
    at = np.floor(uv * np.array([width, height], F)).astype(int)
    return image[np.clip(at[..., 1], 0, height - 1), np.clip(at[..., 0], 0, width - 1)]


def grid(width, height):
    columns, rows = np.meshgrid(np.arange(width, dtype=F), np.arange(height, dtype=F))
    return np.stack([(columns + F(0.5)) / F(width), (rows + F(0.5)) / F(height)], -1)


def longer(a, b):
    """VMax: the first of two equal ones."""
    return np.where(((a * a).sum(-1) < (b * b).sum(-1))[..., None], b, a)


def packed(velocity, depth, exposure, radius):
    """frag_VelocitySetup, out of a texture with 10 bits per channel and unpacked again."""
    v = velocity * F(exposure) * F(0.5)
    v = v / np.maximum(F(1), length(v) / F(radius))[..., None]
    bits = lambda value: np.round(saturate(value) * F(1023)) / F(1023)
    xy = bits((v / F(radius) + 1) / 2)
    return (xy * 2 - 1) * F(radius), bits(depth / FAR_PLANE)


def halved(motion, width, height, stored):
    """frag_TileMax1 and 2: the longest of four texels."""
    uv = grid(width, height)
    texel = np.array([1 / motion.shape[1], 1 / motion.shape[0]], F)
    tap = lambda x, y: point(motion, uv + texel * np.array([x, y], F) * F(0.5))
    return stored(longer(longer(longer(tap(-1, -1), tap(1, -1)), tap(-1, 1)), tap(1, 1)))


def tiles_of(motion, tile, stored):
    height, width = motion.shape[:2]
    for divider in (2, 4, 8):
        motion = halved(motion, width // divider, height // divider, stored)
    columns, rows = width // tile, height // tile
    texel = np.array([1 / motion.shape[1], 1 / motion.shape[0]], F)
    corner = grid(columns, rows) - texel * F((tile / 8 - 1) * 0.5)
    longest = np.zeros((rows, columns, 2), F)
    for x in range(tile // 8):
        for y in range(tile // 8):
            longest = longer(longest, point(motion, corner + texel * np.array([x, y], F)))
    return stored(neighbors(stored(longest)))


def neighbors(tiles):
    """frag_NeighborMax."""
    edge = np.pad(tiles, ((1, 1), (1, 1), (0, 0)), mode="edge")
    rows, columns = tiles.shape[:2]
    at = lambda x, y: edge[1 + y : 1 + y + rows, 1 + x : 1 + x + columns]
    line = lambda y, middle: longer(at(-1, y), longer(middle, at(1, y)))
    center = at(0, 0) * F(1.01)
    return longer(line(-1, at(0, -1)), longer(line(0, center), line(1, at(0, 1)))) / F(1.01)


def gradient_noise(x, y):
    inner = (F(0.06711056) * x + F(0.00583715) * y) % F(1)
    return (F(52.9829189) * inner) % F(1)


def blur(color, velocity, depth, exposure, stored, samples=SAMPLES):
    height, width = depth.shape
    size = np.array([width, height], F)
    radius = MAX_BLUR_PERCENT * height // 100
    tile = ((radius - 1) // 8 + 1) * 8
    motion, near = packed(velocity, depth, exposure, radius)
    uv = grid(width, height)
    columns, rows = np.meshgrid(np.arange(width, dtype=F), np.arange(height, dtype=F))

    # JitterTile
    angle = gradient_noise(columns + F(2 * width), rows) * F(2 * np.pi)
    around = np.stack([np.cos(angle), np.sin(angle)], -1)
    tiles = tiles_of(motion, tile, stored)
    count = np.array([tiles.shape[1], tiles.shape[0]], F)
    v_max = point(tiles, uv + around / count / 4)

    l_v_p = np.maximum(length(motion), F(0.5))
    l_v_max = length(v_max)
    still = l_v_max < 2
    l_v_max = np.maximum(l_v_max, F(2))
    v_alt = np.where((l_v_p * 2 > l_v_max)[..., None], motion * (l_v_max / l_v_p)[..., None], v_max)
    sc = np.floor(np.minimum(F(samples // 2), l_v_max / 2))
    dt = 1 / sc
    t_offs = (gradient_noise(columns, rows) - F(0.5)) * dt
    l_v_bg = np.maximum(l_v_p, F(1))
    acc, total = np.zeros((height, width, 3), F), np.zeros((height, width), F)
    for count in range(samples):
        t = 1 - dt / 2 - (count // 2) * dt
        runs = t > dt / 4
        v_s = v_alt if count % 4 >= 2 else v_max
        t_s = (-t if count % 2 else t) + t_offs
        l_t = l_v_max * np.abs(t_s)
        at = uv + v_s * t_s[..., None] / size
        c, tap, tap_depth = linear(color, at), point(motion, at), point(near, at)
        with np.errstate(divide="ignore", invalid="ignore"):
            fg = saturate(np.nan_to_num((near - tap_depth) * 20 / near, posinf=1, neginf=0))
        l_v = l_v_bg + (length(tap) - l_v_bg) * fg
        w = saturate(l_v - l_t) / np.maximum(l_v, F(1e-6)) * (F(1.2) - t) * runs
        acc += c * w[..., None]
        total += w
        l_v_bg = np.where(runs, np.maximum(l_v_bg, l_v), l_v_bg)
    w = F(1.2) / (l_v_bg * sc * 2)
    mixed = (acc + color * w[..., None]) / (total + w)[..., None]
    return np.where(still[..., None], color, mixed)


def with_samples(samples, stored):
    return lambda color, velocity, depth, exposure, frame_index, parameters: blur(color, velocity, depth, exposure, stored, samples)


PRESETS = {"kino:default": SAMPLES, "kino:ppv2": SAMPLES_PPV2}
ORIGINALS = {name: with_samples(samples, lambda v: v.astype(np.float16).astype(F)) for name, samples in PRESETS.items()}
AS_LISTED = {name: with_samples(samples, lambda v: v) for name, samples in PRESETS.items()}
