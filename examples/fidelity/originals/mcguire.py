"""Two published programs behind presets of `shaders/mcguire`, in numpy.

`motion_blur_demo`: github.com/AminAliari/motion-blur at 8eb2141, gbuffer.frag, tile.comp, neighbor.comp, reconstruct.frag. Motion is
stored as half the motion in pixels; the picture's depth lies in the alpha of its colours.

`g3d`: github.com/RomkoSI/G3D at f66b25b, MotionBlur.cpp, MotionBlur_tileMinMax.pix, MotionBlur_neighborMinMax.pix and
MotionBlur_gather.pix with its loop. Motion is whole in its tiles and cut only where it is read.
"""

import numpy as np

F = np.float32


def length(v):
    return np.sqrt((v * v).sum(-1, dtype=F))


def saturate(x):
    return np.clip(x, F(0), F(1))


def device_depth(metres, near, far):
    """Converts metres to a depth buffer that grows into the screen."""
    near, far = F(near), F(far)
    return np.clip(far / (far - near) * (1 - near / metres), F(1e-6), F(1)).astype(F)


def texel(image, x, y, repeats=False):
    height, width = image.shape[:2]
    if repeats:
        return image[y % height, x % width]
    return image[np.clip(y, 0, height - 1), np.clip(x, 0, width - 1)]


def linear(image, uv, repeats=False):
    height, width = image.shape[:2]
    at = uv * np.array([width, height], F) - F(0.5)
    base = np.floor(at)
    fx, fy = (at - base)[..., 0:1], (at - base)[..., 1:2]
    x, y = base[..., 0].astype(int), base[..., 1].astype(int)
    top = texel(image, x, y, repeats) * (1 - fx) + texel(image, x + 1, y, repeats) * fx
    bottom = texel(image, x, y + 1, repeats) * (1 - fx) + texel(image, x + 1, y + 1, repeats) * fx
    return top * (1 - fy) + bottom * fy


def positions(width, height):
    columns, rows = np.meshgrid(np.arange(width), np.arange(height))
    return columns, rows


def gradient_noise(columns, rows):
    inner = (F(0.06711056) * columns.astype(F) + F(0.00583715) * rows.astype(F)) % F(1)
    return (F(52.9829189) * inner) % F(1)


# The demo's own constants.
K, S = 20, 15


def demo(color, velocity, depth, exposure, stored):
    height, width = depth.shape
    motion = velocity * F(exposure)
    motion = motion / np.maximum(F(1), length(motion) / F(K))[..., None]
    motion = stored(motion * F(0.5))
    z = device_depth(depth, 0.1, 1000)

    # Only whole tiles; the longest of each, the first of equal ones.
    columns, rows = max(width // K, 1), max(height // K, 1)
    longer = lambda a, b: np.where(((a * a).sum(-1) >= (b * b).sum(-1))[..., None], a, b)
    tiles = np.zeros((rows, columns, 2), F)
    for y in range(K):
        for x in range(K):
            tiles = longer(tiles, motion[y : rows * K : K, x : columns * K : K][:rows, :columns])
    tiles = stored(tiles)
    around = np.pad(tiles, ((1, 1), (1, 1), (0, 0)))
    neighbors = np.zeros_like(tiles)
    for x in range(3):
        for y in range(3):
            neighbors = longer(neighbors, around[y : y + rows, x : x + columns])
    neighbors = stored(neighbors)

    column, row = positions(width, height)
    size = np.array([width, height], F)
    uv = ((np.stack([column, row], -1) + F(0.5)) / size).astype(F)
    longest = linear(neighbors, uv)
    still = length(longest) <= 0.5
    hashed = np.sin((uv * np.array([12.9898, 78.233], F)).sum(-1, dtype=F) * F(43758.5453), dtype=F)
    jitter = (hashed - np.floor(hashed)) * 2 - 1
    speed = length(linear(motion, uv)) + F(1e-8)
    weight = 1 / np.maximum(speed, F(0.5))
    total = color * weight[..., None]

    front = lambda a, b: saturate(1 - (a - b) / np.minimum(a, b))
    cone = lambda distance, speed: saturate(1 - distance / np.maximum(speed, F(1e-8)))

    def cylinder(distance, speed):
        low, high = F(0.95) * speed, F(1.05) * speed
        t = saturate((distance - low) / np.maximum(high - low, F(1e-9)))
        return 1 - t * t * (3 - 2 * t)

    for i in range(S):
        t = -1 + 2 * (i + jitter + 1) / F(S + 1)
        offset = longest * t[..., None] / size
        at = uv + offset
        tap_color = linear(color, at, repeats=True)
        tap_z = linear(z[..., None], at, repeats=True)[..., 0]
        tap = length(linear(motion, at))
        distance = length(offset)
        a = front(z, tap_z) * cone(distance, tap) + front(tap_z, z) * cone(distance, speed)
        a = a + cylinder(distance, tap) * cylinder(distance, speed) * 2
        weight = weight + a
        total = total + a[..., None] * tap_color
    return np.where(still[..., None], color, total / weight[..., None])


def motion_blur_demo(color, velocity, depth, exposure, frame_index, parameters):
    return demo(color, velocity, depth, exposure, lambda v: v.astype(np.float16).astype(F))


def motion_blur_demo_as_listed(color, velocity, depth, exposure, frame_index, parameters):
    return demo(color, velocity, depth, exposure, lambda v: v.astype(F))


SAMPLES = 27
SOFT_DEPTH_EXTENT = F(0.01)


def adjusted(v, exposure, radius):
    """readAdjustedVelocity: half the motion, at least half a pixel and at most the radius; and its length."""
    speed = length(v)
    r = speed * F(0.5) * F(exposure)
    cut = np.clip(r, F(0.5), F(radius))
    with np.errstate(divide="ignore", invalid="ignore"):
        scaled = v * (cut / speed)[..., None]
    return np.where((r >= 0.01)[..., None], scaled, v), cut


def normalized(v):
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.nan_to_num(v / length(v)[..., None])


def g3d(color, velocity, depth, exposure, frame_index, parameters):
    """The tile is the preset's: a twentieth of the preset's picture width."""
    height, width = depth.shape
    radius = parameters["tile_size"]
    z = device_depth(depth, 0.1, 1e9)
    columns, rows = -(-width // radius), -(-height // radius)
    edge = np.pad(velocity, ((0, rows * radius - height), (0, columns * radius - width), (0, 0)), mode="edge")
    largest = np.zeros((rows, columns, 2), F)
    slowest = np.full((rows, columns), F(1e6))
    for y in range(radius):
        for x in range(radius):
            v = edge[y::radius, x::radius]
            larger = (v * v).sum(-1) > (largest * largest).sum(-1)
            largest = np.where(larger[..., None], v, largest)
            slowest = np.minimum(slowest, length(v))
    fastest, square, least = np.zeros_like(largest), np.full((rows, columns), F(-1)), np.full((rows, columns), F(1e6))
    tile_column, tile_row = positions(columns, rows)
    for y in (-1, 0, 1):
        for x in (-1, 0, 1):
            v = texel(largest, tile_column + x, tile_row + y)
            least = np.minimum(least, texel(slowest, tile_column + x, tile_row + y))
            heading = np.sign(v[..., 0] * x) + np.sign(v[..., 1] * y)
            counts = ((v * v).sum(-1) > square) & (np.abs(heading) == abs(x) + abs(y))
            fastest = np.where(counts[..., None], v, fastest)
            square = np.where(counts, (v * v).sum(-1), square)

    column, row = positions(width, height)
    v_all, r_all = adjusted(fastest[row // radius, column // radius], exposure, radius)
    r_min = least[row // radius, column // radius] * F(0.5) * F(exposure)
    v_all_pixels, r_all_pixels = adjusted(velocity, exposure, radius)
    r = r_all_pixels
    w_all = normalized(np.where((r >= 5)[..., None], v_all_pixels, v_all))
    w_own = np.where((r < 1.5)[..., None], w_all, normalized(v_all_pixels))
    assumed = (r_min >= r_all) | ((r_min >= r_all * F(0.65)) & (r_min >= 4))
    jitter = gradient_noise(column, row) - F(0.5)
    weight = F(SAMPLES) / 40 / r
    total = color * weight[..., None]
    front = lambda a, b: saturate(1 - (b - a) / SOFT_DEPTH_EXTENT)
    for i in range(SAMPLES):
        if i == SAMPLES // 2:
            continue
        t = np.clip(F(2.4) * (i + 1 + jitter) / F(SAMPLES + 1) - F(1.2), -1, 1)
        distance = t * r_all
        offset = distance[..., None] * (w_own if i % 2 else w_all)
        x = np.trunc(offset[..., 0] + column + F(0.5)).astype(int)
        y = np.trunc(offset[..., 1] + row + F(0.5)).astype(int)
        tap_z = texel(z, x, y)
        tap = np.where(assumed, r_all, texel(r_all_pixels, x, y))
        distance = np.abs(distance)
        a = front(tap_z, z) * saturate(1 - distance / r) + front(z, tap_z) * saturate(1 - distance / tap)
        a = a + 2 * (np.minimum(r, tap) >= distance)
        weight = weight + a
        total = total + texel(color, x, y) * a[..., None]
    return np.where((r_all <= 0.505)[..., None], color, total / weight[..., None])


ORIGINALS = {"mcguire:motion_blur_demo": motion_blur_demo, "mcguire:g3d": g3d}
AS_LISTED = {"mcguire:motion_blur_demo": motion_blur_demo_as_listed}
