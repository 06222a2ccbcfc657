"""Dagor Engine's object motion blur, in numpy, from objectMotionBlur.dshl, objectMotionBlur.cpp and object_motion_blur.blk at 7572366.

The strength is 1, at 60 frames per second; the exposure takes its place. There is no glass, and the clock stands at 0. The depth
buffer is reversed, with planes at 0.01 and 10000 m as in the engine's samples. Textures of few bits round to the nearest.
"""

import numpy as np
from sampling import linear

F = np.float32

TILE_SIZE = 16
MAX_VEL_PX = F(32)
MIN_VEL_PX = F(0.5)
MAX_SAMPLES = 16
DEPTH_COEFF = F(15)
VIGNETTE = F(0.6)
ZNEAR, ZFAR = 0.01, 10000.0


def length(v):
    return np.sqrt((v * v).sum(-1, dtype=F))


def dot(a, b):
    return (a * b).sum(-1, dtype=F)


def saturate(x):
    return np.clip(x, F(0), F(1))


def lerp(a, b, t):
    return a + (b - a) * t


def small_float(value, mantissa):
    """What a float with 5 bits of exponent keeps of a positive number."""
    exponent = np.maximum(np.frexp(value)[1] - 1, -14)
    return np.ldexp(np.rint(np.ldexp(value, mantissa - exponent)), exponent - mantissa).astype(F)


def polar_to_cartesian(vel_length, angle):
    return np.stack([np.cos(angle), np.sin(angle)], -1) * vel_length[..., None]


def normalize_safe(v, vel_length):
    return v / np.maximum(vel_length, F(1e-6))[..., None] * (vel_length >= 0.5)[..., None]


def linearize_z(raw):
    return (1 / (F(1 / ZFAR) + F((ZFAR - ZNEAR) / (ZNEAR * ZFAR)) * raw)).astype(F)


def polar_velocity(velocity, exposure, rows, columns):
    """object_motion_blur_tile_max up to the shared memory: length and angle of every thread, the threads off the picture included."""
    height, width = velocity.shape[:2]
    x, y = np.meshgrid(np.arange(columns), np.arange(rows))
    tc = np.stack([(x.astype(F) + F(0.5)) * F(1 / width), (y.astype(F) + F(0.5)) * F(1 / height)], -1)
    size = np.array([width, height], F)
    motion_vector = -velocity[np.minimum(y, height - 1), np.minimum(x, width - 1)] / size
    vel = motion_vector * (size * F(0.5) * F(exposure))
    vel_length = length(vel)
    angle = np.where(vel_length > 0, np.arctan2(vel[..., 1], vel[..., 0]), F(0))
    screen = np.abs(tc * 2 - 1)
    vignette = saturate(dot(screen, screen) + (1 - VIGNETTE))
    return np.minimum(vel_length, MAX_VEL_PX) * (vignette * vignette), angle


def reduce_step(shared, count):
    """lerp with step: the second of two equal ones."""
    first, second = shared[..., :count, :], shared[..., count : 2 * count, :]
    return np.where(second[..., :1] >= first[..., :1], second, first)


def tiles_of(vel_length, angle):
    rows, columns = vel_length.shape[0] // TILE_SIZE, vel_length.shape[1] // TILE_SIZE
    split = lambda plane: plane.reshape(rows, TILE_SIZE, columns, TILE_SIZE).transpose(0, 2, 1, 3).reshape(rows, columns, -1)
    shared = np.stack([split(vel_length), split(angle)], -1)
    for count in (128, 64, 32, 16, 8, 4, 2, 1):
        shared = reduce_step(shared, count)
    longest = polar_to_cartesian(shared[..., 0, 0], shared[..., 0, 1])
    return longest.astype(np.float16).astype(F)


def neighbors_of(tiles):
    """object_motion_blur_neighbor_max."""
    rows, columns = tiles.shape[:2]
    edge = np.pad(tiles, ((1, 1), (1, 1), (0, 0)), mode="edge")
    shared = [edge[y : y + rows, x : x + columns] for y in range(3) for x in range(3)]
    longer = lambda a, b: np.where((length(a) < length(b))[..., None], b, a)
    for count in (4, 2, 1):
        shared[:count] = [longer(shared[i], shared[i + count]) for i in range(count)]
    return longer(shared[0], shared[8])


def noise(xy):
    inner = (xy[..., 0] * F(0.06711056) + xy[..., 1] * F(0.00583715)) % F(1)
    return (F(52.9829189) * inner) % F(1)


class Flattened:
    """The texture of flattened velocity: R11G11B10F, read at points, repeated beyond its border."""

    def __init__(self, vel_length, angle, raw_depth):
        self.vel_length = small_float(vel_length, 6)
        self.angle = small_float(angle * F(0.5 / np.pi) + F(0.5), 6)
        self.raw_depth = small_float(raw_depth, 5)

    def load(self, uv):
        height, width = self.raw_depth.shape
        at = np.floor(uv * np.array([width, height], F)).astype(int)
        x, y = at[..., 0] % width, at[..., 1] % height
        angle = self.angle[y, x] * F(2 * np.pi) - F(np.pi)
        vel = polar_to_cartesian(self.vel_length[y, x], angle)
        raw = self.raw_depth[y, x]
        return vel, self.vel_length[y, x], linearize_z(raw), raw <= 0


def cone(t, vel_length):
    return saturate(1 - t / np.maximum(vel_length, F(0.00001)))


def cylinder(t, vel_length):
    low, high = F(0.95) * vel_length, F(1.05) * vel_length
    with np.errstate(divide="ignore", invalid="ignore"):
        part = saturate(np.nan_to_num((t - low) / (high - low), posinf=1))
    return 1 - part * part * (3 - 2 * part)


def depth_compare_greater_than(za, zb):
    return saturate(1 - DEPTH_COEFF * (zb - za) / np.minimum(za, zb))


class Center:
    def __init__(self, flattened, uv):
        self.vel, vel_length, self.depth, self.is_sky = flattened.load(uv)
        self.vel_norm = normalize_safe(self.vel, vel_length)
        self.vel_length = np.maximum(vel_length, MIN_VEL_PX)


def weight_for_sample(flattened, center, vel, t, uv, velocity_weight):
    sample_vel, sample_length, sample_depth, sample_is_sky = flattened.load(uv)
    foreground = depth_compare_greater_than(center.depth, sample_depth)
    background = depth_compare_greater_than(sample_depth, center.depth)
    total = foreground + background
    foreground_weight = np.abs(dot(sample_vel / np.maximum(sample_length, F(0.00001))[..., None], vel))
    weight = foreground / total * cone(t, sample_length) * foreground_weight
    weight = np.maximum(weight, background / total * cone(t, center.vel_length) * velocity_weight)
    both = cylinder(t, np.minimum(sample_length, center.vel_length))
    weight = np.maximum(weight, both * np.maximum(velocity_weight, foreground_weight))
    return np.where(~center.is_sky & sample_is_sky, F(0), weight)


def sample_counts(longest):
    """As many as the pixel of its group of threads needs that needs most."""
    height, width = longest.shape
    desired = longest / MAX_VEL_PX * MAX_SAMPLES
    counts = np.clip(np.ceil(desired / 4) * 4, 4, MAX_SAMPLES)
    # Threads off the picture ask for tiles inside, as those at its border do; their noise is their own.
    groups = counts.reshape(height // 16, 16, width // 16, 16).max((1, 3))
    return np.repeat(np.repeat(groups, 16, 0), 16, 1)


def dominant(neighbors, random, x, y):
    jitter = np.trunc((random * F(0.5) - F(0.25)) * TILE_SIZE).astype(int)
    tile = lambda at, shift, count: np.clip(np.trunc((at + shift) / TILE_SIZE).astype(int), 0, count - 1)
    rows, columns = neighbors.shape[:2]
    return neighbors[tile(y, jitter[..., 1], rows), tile(x, jitter[..., 0], columns)]


def default(color, velocity, depth, exposure, frame_index, parameters):
    height, width = depth.shape
    size = np.array([width, height], F)
    rows, columns = -(-height // 16) * 16, -(-width // 16) * 16
    vel_length, angle = polar_velocity(velocity, exposure, rows, columns)
    raw_depth = np.maximum(0, (ZFAR / depth.astype(np.float64) - 1) * ZNEAR / (ZFAR - ZNEAR)).astype(F)
    flattened = Flattened(vel_length[:height, :width], angle[:height, :width], raw_depth)
    neighbors = neighbors_of(tiles_of(vel_length, angle))

    # Every thread, also those off the picture.
    x, y = np.meshgrid(np.arange(columns), np.arange(rows))
    uv = np.stack([(x.astype(F) + F(0.5)) * F(1 / width), (y.astype(F) + F(0.5)) * F(1 / height)], -1)
    random = np.stack([noise(uv * size), noise((uv + np.array([0.52354, 0.62321], F)) * size)], -1)
    max_vel = dominant(neighbors, random, x, y)
    counts = sample_counts(np.maximum(length(max_vel), MIN_VEL_PX))[:height, :width]

    uv, random, max_vel = (plane[:height, :width] for plane in (uv, random, max_vel))
    max_norm = normalize_safe(max_vel, length(max_vel))
    max_length = np.maximum(length(max_vel), MIN_VEL_PX)
    center = Center(flattened, uv)
    perp = max_norm[..., ::-1] * np.array([-1, 1], F)
    perp = np.where((dot(perp, center.vel) < 0)[..., None], -perp, perp)
    mixed = lerp(perp, center.vel_norm, saturate((center.vel_length - F(0.5)) / F(1.5))[..., None])
    secondary = normalize_safe(mixed, length(mixed))

    loop_count = (counts / 2).astype(F)
    total = counts.astype(F) / (center.vel_length * 40)
    result = color * total[..., None]
    jitter = random[..., 0] - F(0.5), F(0.5) - random[..., 0]
    for first, vel, norm, vel_length in ((0, center.vel, center.vel_norm, center.vel_length), (1, max_vel, max_norm, max_length)):
        along = dot(secondary, norm)
        step_uv = vel * (1 / size) / loop_count[..., None]
        to_pixel = vel_length / loop_count
        for step in range(first, MAX_SAMPLES // 2, 2):
            runs = step < loop_count
            for side, sign in ((0, 1), (1, -1)):
                index = (step + F(0.5)) + jitter[side]
                at = uv + sign * index[..., None] * step_uv
                weight = weight_for_sample(flattened, center, norm, index * to_pixel, at, along) * runs
                result = result + linear(color, at) * weight[..., None]
                total = total + weight
    return result / total[..., None]


ORIGINALS = {"dagor:default": default}
