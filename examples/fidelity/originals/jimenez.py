"""The engines behind the presets of `shaders/jimenez`, in numpy.

Each function was written from the engine's own sources, which its text names, and not from the kernel of this project. It keeps
their names, the order of their steps and their ways at the border of the picture. What it leaves out on purpose stands beside it.

Colours are H x W x 3, scene-linear; velocity is H x W x 2 in pixels per frame, +x right, +y down, where things go; depth is H x W
in metres. `parameters` are the values of a preset, of which those in pixels are read, so that they may be scaled.
"""

import numpy as np

F = np.float32


def saturate(x):
    return np.clip(x, F(0), F(1))


def length(v):
    return np.sqrt((v * v).sum(axis=-1, dtype=F))


def grid(height, width):
    """Column and row of every pixel."""
    return np.meshgrid(np.arange(width), np.arange(height))


def texel(image, x, y):
    """Reads whole positions, clamped to the picture."""
    height, width = image.shape[:2]
    return image[np.clip(y, 0, height - 1), np.clip(x, 0, width - 1)]


def point(image, uv):
    """Samples the nearest texel, clamped."""
    height, width = image.shape[:2]
    x = np.floor(uv[..., 0] * F(width)).astype(np.int64)
    y = np.floor(uv[..., 1] * F(height)).astype(np.int64)
    return texel(image, x, y)


def linear(image, uv):
    """Samples between texels, clamped."""
    height, width = image.shape[:2]
    at = uv * np.array([width, height], F) - F(0.5)
    base = np.floor(at)
    part = (at - base).astype(F)
    x, y = base[..., 0].astype(np.int64), base[..., 1].astype(np.int64)
    fx, fy = part[..., 0:1], part[..., 1:2]
    top = texel(image, x, y) * (1 - fx) + texel(image, x + 1, y) * fx
    bottom = texel(image, x, y + 1) * (1 - fx) + texel(image, x + 1, y + 1) * fx
    return (top * (1 - fy) + bottom * fy).astype(F)


def columns_first(block):
    """The vectors of some tiles in the order of loops over x and, within, over y."""
    return block.transpose(1, 0, 2).reshape(-1, 2)


def first_longest(vectors):
    return vectors[np.argmax((vectors * vectors).sum(-1))]


def last_longest(vectors):
    return first_longest(vectors[::-1])


def gradient_noise(x, y):
    """Interleaved gradient noise."""
    inner = F(0.06711056) * x.astype(F) + F(0.00583715) * y.astype(F)
    outer = F(52.9829189) * (inner - np.floor(inner))
    return (outer - np.floor(outer)).astype(F)


def depth_cmp(center, sample, scale):
    """Weights for a sample behind the centre, and in front of it."""
    farther = F(scale) * (sample - center)
    return saturate(F(0.5) + farther), saturate(F(0.5) - farther)


# ---------------------------------------------------------------------------------------------------------------------------------
# Unity HDRP


def hdrp(color, velocity, depth, exposure, frame_index, parameters, mirror_weights=False, layers=True):
    """Unity HDRP, 8 samples, with its intensity at twice the exposure.

    https://github.com/Unity-Technologies/Graphics at 8bdf5073c28fadabda28ae4782e749cb44715642, below
    Packages/com.unity.render-pipelines.high-definition/Runtime/PostProcessing/Shaders: MotionBlurMotionVecPrep.compute,
    MotionBlurGenTilePass.compute, MotionBlurNeighborhoodTilePass.compute and MotionBlurMergeTilePass.compute with SCATTERING,
    MotionBlur.compute; its parameters as HDRenderPipeline.PostProcess.cs sets them.

    Left out: motion and depth in 11, 11 and 10 bits, tiles in 16 bits, the race between tiles that spread their motion and
    receive some, special clamps of the camera's motion (off by default), alpha.
    """
    height, width = depth.shape
    size = np.array([width, height], F)
    magnitude = np.sqrt((size * size).sum())
    tile_size = int(parameters.get("tile_size", 16))
    sample_count = 2 * int(parameters.get("pairs", 4))
    threshold = F(parameters.get("shortest", 2.0))
    per_tap = F(parameters.get("tap_length", 1.0))
    dot_from = F(parameters.get("direction_from", 0.3))
    intensity = F(2.0 * exposure)

    # MotionVecPreppingCS, NO_SPECIAL_CLAMP: motion in parts of the picture, cut.
    vec = intensity * velocity.astype(F) / size
    lengths = length(vec)
    longest = F(parameters.get("longest", 200.0)) / magnitude
    vec = np.where((lengths > 1e-4)[..., None], vec * (np.minimum(lengths, longest) / np.maximum(lengths, F(1e-30)))[..., None], 0)
    lengths = length(vec)
    # EncodeMotionVector.
    vec = np.where((lengths < 0.0001)[..., None], F(0), vec).astype(F)
    lengths = length(vec)

    tile_vec, tile_min = hdrp_tiles(vec, lengths, tile_size, magnitude)
    rows, columns = tile_min.shape

    x, y = grid(height, width)
    random = gradient_noise(x, y)
    jitter = (random - F(0.5)) * F(0.5)
    # GetTileUV, sampled at the nearest tile.
    tile_x = np.clip(np.floor((x + F(0.5)) / F(tile_size) + jitter), 0, columns - 1).astype(int)
    tile_y = np.clip(np.floor((y + F(0.5)) / F(tile_size) + jitter), 0, rows - 1).astype(int)
    max_vec = tile_vec[tile_y, tile_x]
    max_len = length(max_vec) * magnitude
    min_len = tile_min[tile_y, tile_x] * magnitude

    early_out = max_len <= threshold
    fast_path = (max_len < magnitude * F(0.333)) & (min_len > F(0.25) * max_len)

    whole = np.floor(max_len / per_tap).astype(int)
    count = np.maximum(np.minimum(whole + (whole & 1), sample_count), 2)
    steps = count // 2
    inverse = F(1) / count.astype(F)
    center_uv = np.stack([x + F(0.5), y + F(0.5)], -1).astype(F) / size
    half = F(0.5) * max_vec
    center_len = lengths * magnitude
    to_samples = steps.astype(F) / np.maximum(max_len, F(1e-20))

    def sample(i, sign):
        direction = F(sign) * half
        offset = (F(i) + F(0.5)) + F(sign) * (random - F(0.5))
        uv = center_uv + (offset * inverse)[..., None] * direction
        tap_vec, tap_depth = point(vec, uv), point(depth, uv)
        tap_len = length(tap_vec) * magnitude
        square = np.maximum((direction * direction).sum(-1), F(1e-30))
        along = saturate(np.abs((tap_vec * direction).sum(-1) / square))
        along = np.where((center_len > 0) & (tap_len > dot_from), along, F(1))
        behind, before = depth_cmp(depth, tap_depth, parameters.get("depth_scale", 1.0))
        late = np.maximum(offset - F(1), F(0))
        weight = behind * saturate(to_samples * center_len - late) + before * saturate(to_samples * tap_len - late) * along
        return point(color, uv), weight.astype(F), tap_depth, tap_len

    plain = np.zeros_like(color)
    total = np.zeros_like(color)
    weights = np.zeros_like(depth)
    for i in range(sample_count // 2):
        runs = i < steps
        color_1, weight_1, depth_1, len_1 = sample(i, -1)
        color_2, weight_2, depth_2, len_2 = sample(i, 1)
        if mirror_weights:
            farther, faster = depth_1 > depth_2, len_1 > len_2
            weight_1 = np.where(farther & faster, weight_2, weight_1)
            weight_2 = np.where(farther | faster, weight_2, weight_1)
        plain += np.where(runs[..., None], color_1 + color_2, 0)
        total += np.where(runs[..., None], color_1 * weight_1[..., None] + color_2 * weight_2[..., None], 0)
        weights += np.where(runs, weight_1 + weight_2, 0)

    alpha = (weights * inverse)[..., None]
    if layers:
        # BlendMotionBlurLayers.
        covered = (weights >= 1e-4)[..., None]
        top = np.where(covered, total / np.where(covered, weights[..., None], 1), color)
        back = color + (top - color) * alpha
        share = saturate(center_len / np.maximum(max_len, F(1e-20)))[..., None]
        slow = back + (top - back) * share
    else:
        slow = total * inverse[..., None] + (1 - alpha) * color
    blurred = np.where(fast_path[..., None], plain * inverse[..., None], slow)
    return np.where(early_out[..., None], color, blurred).astype(F)


def hdrp_tiles(vec, lengths, side, magnitude):
    """The longest motion spread to every tile, and the smallest length around it."""
    height, width = lengths.shape
    rows, columns = -(-height // side), -(-width // side)
    # PackMotionVec: the length's 16 bits, then the angle's.
    angles = np.where(lengths > 0, np.arctan2(vec[..., 1], vec[..., 0]) * F(0.5 / np.pi) + F(0.5), F(0)).astype(np.float16)
    keys = lengths.astype(np.float16).view(np.uint16).astype(np.int64) << 16 | angles.view(np.uint16)
    # TileGenPass.
    best = {}
    least = np.zeros((rows, columns), F)
    for row in range(rows):
        for column in range(columns):
            top, left = row * side, column * side
            if left < width - side and top < height - side:
                block = (slice(top, top + side), slice(left, left + side))
                at = np.unravel_index(np.argmax(keys[block]), (side, side))
                place = (top + at[0], left + at[1])
                least[row, column] = lengths[block].min()
            else:
                place = (top, left)
                least[row, column] = lengths[place]
            best[row, column] = (int(keys[place]), float(lengths[place]), vec[place])
    # TileNeighbourhood: every tile writes its motion along lines, and the longest stays.
    spread = dict(best)
    for (row, column), entry in best.items():
        if entry[1] * magnitude <= 0.5:
            continue
        line = entry[2] * np.array([columns, rows], F) * F(0.5)
        for signed in (line, -line):
            for x, y in cohen(column, row, signed):
                if (y, x) in spread and entry[0] > spread[y, x][0]:
                    spread[y, x] = entry
    # TileMerge.
    tile_vec = np.zeros((rows, columns, 2), F)
    tile_min = np.zeros((rows, columns), F)
    for (row, column), entry in spread.items():
        tile_vec[row, column] = entry[2]
        pixels = entry[1] * magnitude
        if pixels > side * 0.5:
            reach = min(max(int(pixels / side), 1), 4)
            taps_y = np.clip(np.arange(row - reach, row + reach), 0, rows - 1)
            taps_x = np.clip(np.arange(column - reach, column + reach), 0, columns - 1)
            tile_min[row, column] = least[np.ix_(taps_y, taps_x)].min()
        else:
            tile_min[row, column] = least[row, column]
    return tile_vec, tile_min


def cohen(column, row, line):
    """The tiles that a line crosses."""
    x, y = column - 1, row - 1
    to_x, to_y = (int(np.ceil(part + F(1))) for part in line)
    sign_x, sign_y = int(np.sign(to_x)), int(np.sign(to_y))
    across, down = abs(to_x), abs(to_y)
    error = down - across
    for _ in range(across + down):
        if error < 0:
            x += sign_x
            error += 2 * down
        else:
            y += sign_y
            error -= 2 * across
        yield x, y


def hdrp_mirrored(color, velocity, depth, exposure, frame_index, parameters):
    """Unity HDRP before it gave up mirrored weights.

    The same repository at 1390609ca74ecc860907a6e87759644f944fbada, MotionBlur.compute; passes over tiles as in `hdrp`.
    """
    return hdrp(color, velocity, depth, exposure, frame_index, parameters, mirror_weights=True, layers=False)


# ---------------------------------------------------------------------------------------------------------------------------------
# Open 3D Engine


def o3de(color, velocity, depth, exposure, frame_index, parameters, strength=0.5):
    """Open 3D Engine at quality High.

    https://github.com/o3de/o3de at 06b365d77e08b3734a4a598028b0af7ede8be4d3, below
    Gems/Atom/Feature/Common/Assets/Shaders/PostProcessing: MotionBlurTileMaxHor.azsl, MotionBlurTileMaxVer.azsl,
    MotionBlurTileFilter.azsl, MotionBlur.azsl; TileMax textures are rounded up as PassAttachmentReflect.cpp does it.
    """
    height, width = depth.shape
    size = np.array([width, height], F)
    side = int(parameters.get("tile_size", 20))
    omitted = F(parameters.get("shortest", 1.0))
    vec = velocity.astype(F) * F(exposure) / size

    rows, columns = -(-height // side), -(-width // side)
    tiles = np.zeros((rows, columns, 2), F)
    for row in range(rows):
        for column in range(columns):
            block = vec[row * side : (row + 1) * side, column * side : (column + 1) * side].reshape(-1, 2)
            tiles[row, column] = last_longest(block)
    filtered = np.zeros_like(tiles)
    for row in range(rows):
        for column in range(columns):
            block = tiles[max(row - 1, 0) : row + 2, max(column - 1, 0) : column + 2]
            filtered[row, column] = last_longest(columns_first(block))

    x, y = grid(height, width)
    angle = gradient_noise(x + 2 * width, y) * F(3.14159) * F(2)
    jitter = np.stack([np.cos(angle), np.sin(angle)], -1).astype(F) * (F(side) / size) / F(4)
    uv = np.stack([x, y], -1).astype(F) / size
    tile = linear(filtered, uv + jitter) * size * F(strength)
    tile_len = length(tile)

    dither = (F(-0.25) + F(0.5) * (x % 2)) * (F(-1) + F(2) * (y % 2))
    count = int(parameters.get("pairs", 24))
    step = tile / F(count)
    to_units = F(1) / np.maximum(length(step), F(1e-20))
    lengths = length(vec * size * F(strength))
    total = np.zeros_like(color)
    weights = np.zeros_like(depth)
    for i in range(count):
        along = (F(i) + dither).astype(F)
        offset = np.trunc(along[..., None] * step).astype(int)
        taps = []
        for sign in (1, -1):
            at = np.clip(x + sign * offset[..., 0], 0, width - 1), np.clip(y + sign * offset[..., 1], 0, height - 1)
            tap_depth, tap_len = depth[at[1], at[0]], lengths[at[1], at[0]]
            behind, before = depth_cmp(depth, tap_depth, 1.0)
            weight = behind * saturate(to_units * tile_len - along + 1) + before * saturate(to_units * tap_len - along + 1)
            taps.append((color[at[1], at[0]], weight, tap_depth, tap_len))
        (color_1, weight_1, depth_1, len_1), (color_2, weight_2, depth_2, len_2) = taps
        farther, faster = depth_1 > depth_2, len_2 > len_1
        weight_1 = np.where(farther & faster, weight_2, weight_1)
        weight_2 = np.where(farther | faster, weight_2, weight_1)
        total += weight_1[..., None] * color_1 + weight_2[..., None] * color_2
        weights += weight_1 + weight_2
    blurred = np.maximum(total * F(0.5 / count), 0) + (1 - weights[..., None] * F(0.5 / count)) * color
    sharp = (tile_len < omitted) | (weights == 0)
    return np.where(sharp[..., None], color, blurred).astype(F)


# ---------------------------------------------------------------------------------------------------------------------------------
# Wicked Engine


def wicked(color, velocity, depth, exposure, frame_index, parameters):
    """Wicked Engine, strength 128 times the exposure at 60 frames per second.

    https://github.com/turanszkij/WickedEngine at bc3ef1654778d59d3fb07eef799139b8943db16b, WickedEngine/shaders:
    motionblur_tileMaxVelocity_horizontalCS.hlsl, motionblur_tileMaxVelocity_verticalCS.hlsl,
    motionblur_neighborhoodMaxVelocityCS.hlsl, motionblurCS.hlsl; dither() and clamp_uv_to_scissor() of globals.hlsli and
    ShaderInterop_Renderer.h. Its velocity points back.

    Replaced: the texture of blue noise, by gradient noise that walks with the frame. Left out: tiles in 16 bits.
    `screen_extent` of the parameters is its 7.5 steps, which are pixels.
    """
    height, width = depth.shape
    size = np.array([width, height], F)
    side = int(parameters.get("tile_size", 32))
    strength = F(128.0)
    vec = -velocity.astype(F) * F(exposure) / size

    rows, columns = -(-height // side), -(-width // side)
    x, y = grid(columns * side, columns * side)
    padded = texel(vec, *grid(rows * side, columns * side))
    largest = np.zeros((rows + 2, columns + 2, 2), F)
    smallest = np.zeros((rows + 2, columns + 2, 2), F)
    for row in range(rows):
        for column in range(columns):
            block = padded[row * side : (row + 1) * side, column * side : (column + 1) * side].reshape(-1, 2)
            lengths = length(block)
            largest[row + 1, column + 1] = block[np.argmax(lengths)]
            smallest[row + 1, column + 1] = block[np.argmin(lengths)]
    # Reads beyond the texture are zero, here the frame of zeros around it.
    neighborhood = np.zeros((rows, columns, 2), F)
    sort = np.zeros((rows, columns), int)
    for row in range(rows):
        for column in range(columns):
            block = columns_first(largest[row : row + 3, column : column + 3])
            most = block[np.argmax(length(block))]
            least = length(smallest[row : row + 3, column : column + 3]).min()
            longest = length(most)
            if longest < 0.0001:
                sort[row, column] = 0
                continue
            sort[row, column] = 1 if abs(longest - least) < 0.002 else 2
            neighborhood[row, column] = most

    x, y = grid(height, width)
    # dither(): ordered, over 16 pixels.
    rank = np.zeros_like(x)
    for bit, weight in ((0, 32), (1, 8), (2, 2)):
        row_bit, column_bit = (x >> bit) & 1, (y >> bit) & 1
        rank += weight * (row_bit ^ column_bit) + weight // 2 * column_bit
    dither = (rank + 1).astype(F) / F(65)
    amplitude = F(side) / F(2)
    # Converted to whole tiles, towards zero; beyond the texture nothing moves.
    tile_x = np.trunc((x + (dither - F(0.5)) * amplitude) / F(side)).astype(int)
    tile_y = np.trunc((y + (dither - F(0.5)) * amplitude) / F(side)).astype(int)
    inside = (tile_x < columns) & (tile_y < rows)
    near = np.where(inside[..., None], neighborhood[np.minimum(tile_y, rows - 1), np.minimum(tile_x, columns - 1)], 0) * strength
    near_len = length(near)
    sort = sort[y // side, x // side]

    walk = F(5.588238) * F(frame_index % 64)
    random = gradient_noise(x.astype(F) + walk, y.astype(F) + walk)
    motion = vec * strength
    own_len = length(motion)
    steps = F(parameters.get("screen_extent", 7.5))
    pixel = steps / F(7.5) / size
    direction = np.where((sort == 1)[..., None], motion, near) * random[..., None] * pixel
    uv = np.stack([x + F(0.5), y + F(0.5)], -1).astype(F) / size
    low, high = F(0.5) / size, (size - F(0.5)) / size
    at = uv - F(7.5) * direction
    total = np.zeros_like(color)
    weights = np.zeros_like(depth)

    def tap(at):
        tap_depth, tap_len, tap_color = point(depth, at), length(point(vec, at)), point(color, at)
        behind, before = depth_cmp(depth, tap_depth, 1.0)
        weight = behind * saturate(F(1000) * own_len - near_len + 1) + before * saturate(F(1000) * tap_len - near_len + 1)
        return tap_depth, tap_len, tap_color, weight

    for _ in range(8):
        at = np.clip(at, low, high)
        depth_1, len_1, color_1, weight_1 = tap(at)
        at = np.clip(at + direction, low, high)
        depth_2, len_2, color_2, weight_2 = tap(at)
        at = np.clip(at + direction, low, high)
        farther, faster = depth_1 > depth_2, len_2 > len_1
        weight_1 = np.where(farther & faster, weight_2, weight_1)
        weight_2 = np.where(farther | faster, weight_2, weight_1)
        weight_1 = np.where(sort == 1, F(1), weight_1)
        weight_2 = np.where(sort == 1, F(1), weight_2)
        total += weight_1[..., None] * color_1 + weight_2[..., None] * color_2
        weights += weight_1 + weight_2
    blurred = total / F(16) + (1 - weights[..., None] / F(16)) * color
    return np.where((sort == 0)[..., None], color, blurred).astype(F)


# ---------------------------------------------------------------------------------------------------------------------------------
# kajiya


def kajiya(color, velocity, depth, exposure, frame_index, parameters, motion_blur_scale=16.0 / 7.0):
    """kajiya since its commit 4b649f1.

    https://github.com/EmbarkStudios/kajiya at 9fdec0f074f9f822d395f9cfd041b58749e32303, crates/lib/rust-shaders/src/motion_blur.rs
    as crates/lib/kajiya/src/renderers/motion_blur.rs calls it. Its reprojection map points back. Left out: tiles in 16 bits.
    """
    height, width = depth.shape
    size = np.array([width, height], F)
    side = int(parameters.get("tile_size", 16))
    vec = -velocity.astype(F) * F(exposure) / size

    rows, columns = -(-height // side), -(-width // side)
    tiles = np.zeros((rows + 4, columns + 4, 2), F)
    for row in range(rows):
        for column in range(columns):
            block = vec[row * side : (row + 1) * side, column * side : (column + 1) * side].reshape(-1, 2)
            tiles[row + 2, column + 2] = first_longest(block)
    dilated = np.zeros((rows, columns, 2), F)
    for row in range(rows):
        for column in range(columns):
            dilated[row, column] = first_longest(columns_first(tiles[row : row + 5, column : column + 5]))

    x, y = grid(height, width)
    uv = np.stack([x + F(0.5), y + F(0.5)], -1).astype(F) / size
    # The scramble.
    place_x, place_y = x.astype(np.int32), y.astype(np.int32)
    place_x = place_x + (place_x << 4)
    place_x = place_x ^ (place_x >> 6)
    place_y = place_y + (place_x << 1)
    place_y = place_y + (place_y << 6)
    place_y = place_y ^ (place_y >> 2)
    place_x = place_x ^ place_y
    noise = F(0.5) * (((place_x ^ (place_y << 1)) & 31) - 15).astype(F) / F(15)
    # Of a tile of 16 pixels.
    away_x = ((place_x & 31) - 15) * F(side) / F(16)
    away_y = ((place_y & 31) - 15) * F(side) / F(16)
    tile_x = np.clip(np.floor(x + F(0.5) + away_x), 0, width - 1).astype(int) // side
    tile_y = np.clip(np.floor(y + F(0.5) + away_y), 0, height - 1).astype(int) // side
    blur_scale = F(0.5 * motion_blur_scale)
    tile = blur_scale * dilated[tile_y, tile_x]

    center_uv = uv + tile * (noise / F(4) * F(0.5))[..., None]
    center_color = point(color, center_uv)
    center_depth = point(depth, center_uv)
    center_len = length(blur_scale * linear(vec, center_uv) * size)

    def sample(i):
        at = uv + tile * ((F(i) + noise) / F(4) * F(0.5))[..., None]
        tap_depth = point(depth, at)
        tap_len = length(blur_scale * point(vec, at) * size)
        offset = length((at - uv) * size)
        behind, before = depth_cmp(center_depth, tap_depth, 16.0)
        weight = behind * saturate(center_len - (offset + 1)) + before * saturate(tap_len - (offset + 1))
        valid = np.all((at >= 0) & (at <= 1), axis=-1).astype(F)
        return linear(color, at), weight, tap_depth, tap_len, valid

    total = np.zeros_like(color)
    weights = np.zeros_like(depth)
    count = np.ones_like(depth)
    for i in range(1, 4):
        color_1, weight_1, depth_1, len_1, valid_1 = sample(i)
        color_2, weight_2, depth_2, len_2, valid_2 = sample(-i)
        farther, faster = depth_1 > depth_2, len_2 > len_1
        weight_1 = np.where(farther & faster, weight_2, weight_1)
        weight_2 = np.where(farther | faster, weight_2, weight_1)
        weight_1, weight_2 = weight_1 * valid_1, weight_2 * valid_2
        count += valid_1 + valid_2
        total += color_1 * weight_1[..., None] + color_2 * weight_2[..., None]
        weights += weight_1 + weight_2
    moving = length(tile) > 0
    total = np.where(moving[..., None], total / count[..., None], 0)
    weights = np.where(moving, weights / count, 0)
    return (total + (1 - weights[..., None]) * center_color).astype(F)


ORIGINALS = {
    "jimenez:hdrp": hdrp,
    "jimenez:hdrp_mirrored": hdrp_mirrored,
    "jimenez:o3de": o3de,
    "jimenez:wicked": wicked,
    "jimenez:kajiya": kajiya,
}
