"""Blender's motion blur, in numpy: EEVEE's three shaders at 10d8c389, and those of the compositor's Vector Blur at 34ba03e2.

Both store rows from below and motion with +y up, so frames are turned over first. A motion is four numbers, as in Blender: two back to
the earlier instant, two back from the later one. Tables of tiles hold, like Blender's, the length in whole pixels above the place of the
tile, so that the largest number wins. `eevee_as_listed` has what the preset lists as different: motion and tiles of 32 bits.
"""

import numpy as np
from sampling import linear

F = np.float32

TILE = 32
TABLE = 512
# Taps move along x and y, the later motion against the way it is stored.
SIGNS = np.array([1, 1, -1, -1], F)


def length(v):
    return np.sqrt((v * v).sum(-1, dtype=F))


def saturate(x):
    return np.clip(x, F(0), F(1))


def texels(width, height):
    return np.stack(np.meshgrid(np.arange(width), np.arange(height)), -1)


def nearest(image, uv):
    height, width = image.shape[:2]
    at = np.floor(uv * np.array([width, height], F)).astype(int)
    return image[np.clip(at[..., 1], 0, height - 1), np.clip(at[..., 0], 0, width - 1)]


def gradient_noise(texel, seed):
    x = texel[..., 0].astype(F) + F(seed) * (F(47) * F(0.695))
    y = texel[..., 1].astype(F) + F(seed) * (F(17) * F(0.695))
    return (F(52.9829189) * ((F(0.06711056) * x + F(0.00583715) * y) % F(1))) % F(1)


def blocks(image, fill):
    """The texels of every tile, in a row each; beyond the picture, those of its border or what `fill` says."""
    height, width = image.shape[:2]
    more = ((0, -height % TILE), (0, -width % TILE), (0, 0))
    image = np.pad(image, more, **fill)
    rows, columns = image.shape[0] // TILE, image.shape[1] // TILE
    return image.reshape(rows, TILE, columns, TILE, -1).swapaxes(1, 2).reshape(rows, columns, TILE * TILE, -1)


def cut_at_border(uv, way):
    """How much of a way, in NDC, lies within the square from -1 to 1."""
    safe = np.maximum(F(1e-8), np.abs(way)) * np.where(way < 0, F(-1), F(1))
    origin = uv * F(2) - F(1)
    return np.minimum(np.maximum((F(1) - origin) / safe, (F(-1) - origin) / safe).min(-1), F(1))


def flatten(motion, uv, size, stored):
    """EEVEE: the longest of a tile in whole pixels, then the highest row, then the last column; cut at the border."""
    first = cut_at_border(uv, motion[..., :2] * F(2))
    second = cut_at_border(uv, -motion[..., 2:] * F(2))
    pixels = motion * np.stack([first, first, second, second], -1) * np.concatenate([size, size]) * SIGNS
    tiles = blocks(pixels, {"mode": "edge"})
    thread = texels(TILE, TILE).reshape(-1, 2)
    low = thread[:, 1] << 8 | thread[:, 0]
    best = lambda v: np.argmax(np.ceil(length(v)).astype(np.int64) << 16 | low, -1)[..., None, None]
    halves = [np.take_along_axis(v, best(v), 2)[..., 0, :] for v in (tiles[..., :2], tiles[..., 2:])]
    return stored(np.concatenate(halves, -1))


def reduced(motion):
    """The compositor: lengths compared exactly, in ten steps that each fold the second half of a tile upon the first."""
    tiles = blocks(motion, {"mode": "constant"})
    while tiles.shape[2] > 1:
        left, right = np.split(tiles, 2, 2)
        keep = lambda a, b: np.where(((a * a).sum(-1) > (b * b).sum(-1))[..., None], a, b)
        halves = (slice(0, 2), slice(2, 4))
        tiles = np.concatenate([keep(left[..., half], right[..., half]) for half in halves], -1)
    return tiles[:, :, 0]


def tables(tiles):
    """Who counts in each tile, for the earlier and the later motion: each tile writes to all that its lines may touch."""
    rows, columns = tiles.shape[:2]
    table = np.zeros((2, TABLE, TABLE), np.int64)
    for y in range(rows):
        for x in range(columns):
            motions = tiles[y, x, :2], tiles[y, x, 2:]
            numbers = [int(np.ceil(length(motion))) << 18 | x << 9 | y for motion in motions]
            for motion in motions:
                for tile_x, tile_y in touched(x, y, motion, columns, rows):
                    for step in (0, 1):
                        table[step, tile_y, tile_x] = max(table[step, tile_y, tile_x], numbers[step])
    return table


def touched(x, y, motion, columns, rows):
    end = np.array([x, y]) + (np.sign(motion) * np.ceil(np.abs(motion) / F(TILE))).astype(int)
    speed = length(motion)
    way = motion / speed if speed > 0 else motion
    for tile_x in range(max(min(x, end[0]), 0), min(max(x, end[0]), columns - 1) + 1):
        for tile_y in range(max(min(y, end[1]), 0), min(max(y, end[1]), rows - 1) + 1):
            aside = -way[1] * F(x - tile_x) + way[0] * F(y - tile_y)
            if abs(aside) < F(np.sqrt(2)):
                yield tile_x, tile_y


def look_up(tiles, table, tile):
    motions = []
    for step, half in enumerate((slice(0, 2), slice(2, 4))):
        entry = table[step, tile[..., 1], tile[..., 0]]
        motions.append(tiles[entry & 0x1FF, entry >> 9 & 0x1FF, half])
    return np.concatenate(motions, -1)


def gather(color, depth, motion, near, noise, samples, read, depth_scale):
    height, width = depth.shape
    size = np.array([width, height], F)
    uv = (texels(width, height).astype(F) + F(0.5)) / size
    back, front = np.zeros_like(color), np.zeros_like(color)
    total = np.zeros((height, width, 3), F)
    total[..., 2] = 1
    for half in (slice(0, 2), slice(2, 4)):
        pixel_motion, longest = motion(uv)[..., half], near[..., half]
        own_length = length(pixel_motion)
        longest = np.where((length(longest) < own_length)[..., None], pixel_motion, longest)
        moves = length(longest) >= 0.5
        for line, runs in ((longest, moves), (pixel_motion, moves & (own_length >= 0.5))):
            t = noise / F(samples)
            for _ in range(samples):
                offset = line * t[..., None]
                at = uv - offset / size
                tap_motion = motion(at)[..., half]
                tap_length = length(tap_motion)
                behind = F(depth_scale) * (read(depth[..., None], at)[..., 0] - depth)
                counts = runs & ((tap_length < 0.5) | ((offset * tap_motion).sum(-1) > 0))
                far = length(line) * t
                weight_back = saturate(F(0.5) + behind) * saturate(own_length - far + F(1)) * counts
                weight_front = saturate(F(0.5) - behind) * saturate(tap_length - far + F(1)) * counts
                tap = read(color, at)
                back += tap * weight_back[..., None]
                front += tap * weight_front[..., None]
                total += np.stack([weight_back, weight_front, counts.astype(F)], -1)
                t = t + F(1) / F(samples)
    least = F(1) / (F(50) * F(samples) * F(4))
    back += color * least
    weight_back = total[..., 0] + least
    rest = saturate(F(1) - (total[..., 1] + weight_back) / total[..., 2])
    return (front + back) / total[..., 2:] + back / weight_back[..., None] * rest[..., None]


def turned_over(color, depth, *velocities):
    return color[::-1], depth[::-1], np.concatenate([-v[::-1] * np.array([1, -1], F) for v in velocities], -1)


def eevee_blur(color, velocities, depth, exposure, stored, depth_scale=100):
    color, depth, back = turned_over(color, depth, *velocities)
    height, width = depth.shape
    size = np.array([width, height], F)
    # Half an exposure on either side, in parts of the picture; the buffer holds a hundredth of it.
    buffer = stored(back * F(0.5) * F(exposure) / np.concatenate([size, size]) * F(0.01))
    texel = texels(width, height)
    tiles = flatten(buffer * F(100), (texel.astype(F) + F(0.5)) / size, size, stored)
    shift = np.trunc((gradient_noise(texel, 0) * F(2) - F(1)) * F(TILE) * F(0.25)).astype(int)
    tile = np.trunc((texel + shift[..., None]) / TILE).astype(int)
    tile = np.clip(tile, 0, np.array([tiles.shape[1], tiles.shape[0]]) - 1)
    near = look_up(tiles, tables(tiles), tile)
    motion = lambda at: nearest(buffer, at) * F(100) * np.concatenate([size, size]) * SIGNS
    return gather(color, depth, motion, near, gradient_noise(texel, 1), 8, nearest, depth_scale)[::-1]


def compositor_blur(color, velocities, depth, exposure):
    color, depth, back = turned_over(color, depth, *velocities)
    height, width = depth.shape
    scale = F(exposure / 2) * SIGNS
    tiles = reduced(back)
    noise = gradient_noise(texels(width, height), 0)
    # The original has no brackets around the first two terms.
    shift = noise * F(2) - F(1) * F(TILE) * F(0.25)
    tile = np.trunc((texels(width, height) + np.trunc(shift)[..., None]) / TILE).astype(int)
    near = look_up(tiles, tables(tiles * scale), tile) * scale
    motion = lambda at: linear(back, at) * scale
    return gather(color, depth, motion, near, noise, 32, linear, 100)[::-1]


def eevee(color, velocity, depth, exposure, frame_index, parameters, velocity_next):
    return eevee_blur(color, (velocity, velocity_next), depth, exposure, lambda v: v.astype(np.float16).astype(F))


def eevee_as_listed(color, velocity, depth, exposure, frame_index, parameters, velocity_next):
    return eevee_blur(color, (velocity, velocity_next), depth, exposure, lambda v: v)


def compositor(color, velocity, depth, exposure, frame_index, parameters, velocity_next):
    return compositor_blur(color, (velocity, velocity_next), depth, exposure)


ORIGINALS = {"blender:eevee": eevee, "blender:compositor": compositor}
AS_LISTED = {"blender:eevee": eevee_as_listed}
