"""Godot's motion blur, in numpy, with a still camera, so that no depth changes: of the add-on, from guertin_sphynx_blur.glsl at 0337fbf,
guertin_tile_max_x.glsl and _y at a86ee25, guertin_neighbor_max.glsl at 182a7af and pre_blur_processor.glsl at af604f9; and of the engine's
proposal, from motion_blur_*.glsl at 94165d9, with tile_max_x of 4f322a4 and tile_max_y of cbc031a.

The intensity is the exposure. Samplers read the nearest texel; a fetch outside of a texture gives zeros. The far plane is at 4000 m.
"""

import numpy as np

F = np.float32

SAMPLES = 8
FAR = F(4000)
EPSILON = F(1e-6)


def length(v):
    return np.sqrt((v * v).sum(-1, dtype=F))


def dot(a, b):
    return (a * b).sum(-1, dtype=F)


def clamp(x):
    return np.clip(x, F(0), F(1))


def mix(a, b, t):
    return a * (1 - t)[..., None] + b * t[..., None]


def soft_compare(a, b, sze):
    return clamp(F(sze) * (a - b))


def interleaved_gradient_noise(x, y):
    inner = (F(0.06711056) * x + F(0.00583715) * y) % F(1)
    return (F(52.9829189) * inner) % F(1)


def nearest(image, uv):
    height, width = image.shape[:2]
    at = np.floor(uv * np.array([width, height], F)).astype(int)
    return image[np.clip(at[..., 1], 0, height - 1), np.clip(at[..., 0], 0, width - 1)]


def longest_of(lines):
    """The first of the longest vectors along the last axis but one."""
    first = np.argmax(dot(lines, lines), -1)
    return np.take_along_axis(lines, first[..., None, None], -2)[..., 0, :]


def tile_max(velocity, tile):
    """tile_max_x if the vectors of a tile's part of a row lie one after the other; of the turned picture, tile_max_y."""
    height, width = velocity.shape[:2]
    columns = -(-width // tile)
    padded = np.pad(velocity, ((0, 0), (0, columns * tile - width), (0, 0)), mode="edge")
    return longest_of(padded.reshape(height, columns, tile, 2))


def turned(image):
    return image.transpose(1, 0, 2)


def neighbor_max(tiles, can_reach):
    rows, columns = tiles.shape[:2]
    edge = np.pad(tiles, ((1, 1), (1, 1), (0, 0)))
    longest = np.zeros_like(tiles)
    for i in (-1, 0, 1):
        for j in (-1, 0, 1):
            neighbor = edge[1 + j : 1 + j + rows, 1 + i : 1 + i + columns]
            counts = dot(neighbor, neighbor) > dot(longest, longest)
            if i != 0 and j != 0:
                counts &= can_reach(neighbor, i, j)
            longest = np.where(counts[..., None], neighbor, longest)
    return longest


class Blur:
    """What both versions of the blur share: their main()."""

    def __init__(self, color, velocity, w, render_size):
        self.color, self.velocity, self.w, self.size = color, velocity, w, render_size
        height, width = w.shape
        self.columns, self.rows = np.meshgrid(np.arange(width, dtype=F), np.arange(height, dtype=F))
        self.x = (np.stack([self.columns, self.rows], -1) + F(0.5)) / render_size

    def sample_x(self, t, vx):
        yx = self.x + t[..., None] * vx / self.size
        return nearest(self.color, yx), 1 - soft_compare(self.w, nearest(self.w[..., None], yx)[..., 0], -10)

    def sample_y(self, t, vn, weight):
        yn = self.x + t[..., None] * vn / self.size
        zyn = nearest(self.w[..., None], yn)[..., 0]
        overlapn = 1 - soft_compare(zyn, self.w, -10)
        y_weight = weight(nearest(self.velocity, yn), np.abs(t) * length(vn), overlapn)
        return nearest(self.color, yn), y_weight

    def blended(self, x, neg_x, y):
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.nan_to_num(clamp(x[1] / neg_x[1]))
        x_color = mix(neg_x[0], x[0], share)
        return mix(mix(self.color, x_color, np.maximum(x[1], neg_x[1])), y[0], y[1])

    def run(self, vx, vn, times, weight, still):
        total = self.color * EPSILON
        for i in range(SAMPLES):
            t, neg_t = times(i)
            x, neg_x = self.sample_x(t, vx), self.sample_x(neg_t, vx)
            total += self.blended(x, neg_x, self.sample_y(t, vn, weight))
            total += self.blended(neg_x, x, self.sample_y(neg_t, vn, weight))
        return np.where(still[..., None], self.color, total / (EPSILON + 2 * SAMPLES))


def addon_blur(color, velocity, depth, exposure, stored, tile):
    height, width = depth.shape
    size = np.array([width, height], F)
    # The velocity buffer holds halves. pre_blur_processor: cut at two tiles, into rgba16f.
    total = stored(-velocity / size) * F(exposure) * size
    total = total * (F(2 * tile) / np.maximum(F(2 * tile), length(total)))[..., None]
    vectors, w = stored(total), stored(-np.minimum(depth, FAR))
    # Textures of rg8i. neighbor_max overwrites the first rows of the texture that tile_max_x wrote.
    texture = np.trunc(tile_max(vectors, tile))
    tiles = turned(tile_max(turned(texture), tile))
    norm = lambda v: v / np.maximum(EPSILON, length(v))[..., None]
    diagonal = lambda i, j: np.array([i, j], F) * F(0.70710678118)
    texture[: tiles.shape[0]] = neighbor_max(tiles, lambda v, i, j: np.abs(dot(norm(v), diagonal(i, j))) > F(0.70710678118))

    blur = Blur(color, vectors, w, size)
    angle = interleaved_gradient_noise(blur.columns * 4, blur.rows * 4) * F(np.pi) * 2
    jitter = [np.trunc(part(angle) * F(tile) / 4).astype(int) for part in (np.cos, np.sin)]
    at_x, at_y = (np.trunc((at + shift) / tile).astype(int) for at, shift in zip((blur.columns, blur.rows), jitter))
    outside = (at_x >= texture.shape[1]) | (at_y >= height)
    vn = texture[np.where(outside, 0, at_y), np.where(outside, 0, at_x)]
    vn = np.where(outside[..., None], F(0), vn)
    vn_length = length(vn)

    def weight(vyn, tn, overlapn):
        vyn_length = length(vyn)
        with np.errstate(divide="ignore", invalid="ignore"):
            projected = np.nan_to_num(np.abs(dot(vyn / vyn_length[..., None], vn / vn_length[..., None])))
            dilution = np.sqrt(vn_length / vyn_length)
            y_weight = overlapn * dilution
        reaches = (vyn_length / 2 * projected >= tn) & (vyn_length >= 0.5) & (overlapn > EPSILON)
        return np.where(reaches, y_weight, F(0))

    j = interleaved_gradient_noise(blur.columns, blur.rows)
    times = lambda i: (F(-0.5) * ((i + j) / SAMPLES), F(0.5) * ((i + 1 - j) / SAMPLES))
    return blur.run(vectors, vn, times, weight, (vn_length < 0.5) & (length(vectors) < 0.5))


def engine_blur(color, velocity, depth, exposure, tile):
    height, width = depth.shape
    size = np.array([width, height], F)
    vectors, w = -velocity, -np.minimum(depth, FAR)
    tiles = turned(tile_max(turned(tile_max(vectors, tile)), tile))
    count = np.array([tiles.shape[1], tiles.shape[0]], F)
    near = neighbor_max(tiles, lambda v, i, j: dot(v, np.array([i, j], F) / count) > 0)

    intensity = F(exposure)
    blur = Blur(color, vectors * intensity, w, size)
    angle = interleaved_gradient_noise(blur.columns + 2, blur.rows) * F(np.pi) * 2
    vn = nearest(near, blur.x + np.stack([np.cos(angle), np.sin(angle)], -1) / count / 4) * intensity
    clamped = lambda v: v / np.maximum(length(v) / F(tile), F(1))[..., None]
    safenorm = lambda v: v / np.maximum(length(v), EPSILON)[..., None] * (length(v) >= 0.5)[..., None]
    vn, vx = clamped(vn), clamped(blur.velocity)

    def weight(vyn, tn, overlapn):
        vyn_length = np.maximum(F(0.5), length(vyn))
        vyn_length = vyn_length / np.maximum(vyn_length / F(tile), F(1))
        return (vyn_length * np.abs(dot(safenorm(vyn), safenorm(vn))) >= tn) * overlapn

    j = interleaved_gradient_noise(blur.columns, blur.rows)

    def times(i):
        t = F(-0.5) * (1 - (i + j) / SAMPLES)
        return t, -t

    return blur.run(vx, vn, times, weight, length(vn) < 0.5)


def addon(color, velocity, depth, exposure, frame_index, parameters):
    return addon_blur(color, velocity, depth, exposure, lambda v: v.astype(np.float16).astype(F), 32)


def engine(color, velocity, depth, exposure, frame_index, parameters):
    return engine_blur(color, velocity, depth, exposure, 40)


ORIGINALS = {"godot:addon": addon, "godot:engine": engine}
