"""Golan's jump-flood motion blur in numpy, written from reading the demo's shaders.

Repository  https://github.com/sphynx-owner/JFA_driven_motion_blur_demo (MIT)
Commits     fc7a04c3d196f1395173503b59c858c02fa31dcd (2024-07-07, the paper's state): `paper`
            a34ff7f25f235c245e00157a85c6a98567e76c4f (2024-07-09): `july_2024`
Paths       MyJumpFloodIteration/jfp_backtracking_experimental.glsl (dilation and way back)
            MyJumpFloodIteration/jump_flood_blur.glsl (gather)
            MyJumpFloodIteration/jump_flood_blur.gd (passes, textures, values handed to the shaders)
            MainScene.tscn (the values that the demo's scene sets)

All arithmetic has 32 bits and the order of the shaders, in UV, since decisions hang on the last bit. `paper` has the
doubles of its shader.

The constants are those of the demo, and not those of the preset: a preset with another value must show. Only the step of the
dilation comes from the preset, because it is a number of pixels, which a run may scale to its width.

What differs from the demo on purpose, here as in the filters:

- The exposure of the frame stands for the demo's intensity. The demo shrinks its intensity below 30 frames per second,
  and leaves it at 1 above.
- Colour, velocity, depth and result have 32 bits. Godot hands over 16 bits of colour and velocity, and the demo's shaders store 16 bits
  of the result.
- Device depth is 0.05 m / distance. That is Godot's reverse depth with its default near plane, but for the far plane, and the
  shaders take it for that too.
- `paper` keeps its map in 32 bits, as jump_flood_blur.gd allocates it. The shader declares the same images as rgba16f, which
  Vulkan leaves undefined.
- `july_2024` rounds its map of 16 bits towards zero. Vulkan leaves the rounding to the driver. Direct3D prescribes this one, and
  Mesa's llvmpipe, on which the original ran for comparison, has it.
- The colour of the result alone is kept: no debug views, and no frozen past frame.

The filters keep places in pixels, exact at their centres, and the demo in UV, which miss them by their last bits. That decides
where a source lies exactly at the end of a trail, and the tenth root makes much of it where motions are alike but for their last
bits. Another order of the shader's own operations changes as many pixels there: see ../fidelity.toml.
"""

from dataclasses import dataclass

import numpy as np

LARGEST = np.float32(3.402823466e38)
SMALLEST = np.float32(1.175494351e-38)
NEAR_PLANE = np.float32(0.05)
# Offsets in the shader's order, without the centre, which both commits skip.
NEIGHBOURS = [(1, 1), (0, 1), (-1, 1), (1, 0), (1, -1), (-1, 0), (-1, -1), (0, -1)]


@dataclass(frozen=True)
class Demo:
    """Settings of the demo's scene, and behaviour of its commit's shaders."""

    samples: int = 8
    passes: int = 3
    perpendicular_tolerance: float = 0.3
    probes: int = 16
    match_threshold: float = 0.5
    parallel_sensitivity: float = 1.0
    perpendicular_sensitivity: float = 0.2
    # Difference of device depth; None if the way back only uses velocities.
    depth_match: float | None = None
    # Matching probes in a row that end the way back.
    hits: int = 1
    # Factor on the reach, in the gather only.
    reach: int = 1
    # Whether noise shifts taps instead of stretching trails.
    shifts: bool = False
    # Whether taps that are not the mover's are drawn towards the pixel.
    replaces: bool = False
    half_map: bool = False
    doubles: bool = False


PAPER = Demo(doubles=True)
JULY_2024 = Demo(
    probes=8,
    match_threshold=0.9,
    perpendicular_sensitivity=0.05,
    depth_match=0.001,
    hits=3,
    reach=2,
    shifts=True,
    replaces=True,
    half_map=True,
)


def dot(a, b):
    return a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1]


def halved(values):
    """Round towards zero to 16-bit floats."""
    wide = np.ascontiguousarray(values, np.float32)
    narrow = wide.astype(np.float16)
    too_large = np.abs(narrow.astype(np.float32)) > np.abs(wide)
    return np.where(too_large, np.nextafter(narrow, np.float16(0)), narrow).astype(np.float32)


class Sampler:
    """A linear sampler that clamps to the edge."""

    def __init__(self, texels):
        self.texels = np.ascontiguousarray(texels, np.float32)
        self.size = np.array(texels.shape[1::-1])

    def at(self, uv):
        place = uv * self.size.astype(np.float32) - np.float32(0.5)
        base = np.floor(place)
        fraction = place - base
        low = np.clip(base.astype(np.int64), 0, self.size - 1)
        high = np.clip(base.astype(np.int64) + 1, 0, self.size - 1)
        right, down = fraction[..., 0, None], fraction[..., 1, None]
        texel = lambda x, y: self.texels[y[..., 1], x[..., 0]]
        top_left, bottom_left = texel(low, low), texel(low, high)
        top = top_left + right * (texel(high, low) - top_left)
        bottom = bottom_left + right * (texel(high, high) - bottom_left)
        return top + down * (bottom - top)


class Frame:
    """One frame in Godot's form: velocity points back, in UV; device depth is larger nearby."""

    def __init__(self, color, velocity, depth):
        self.height, self.width = depth.shape
        self.size = np.array([self.width, self.height], np.float32)
        self.color = Sampler(color)
        self.velocities = Sampler(-np.asarray(velocity, np.float32) / self.size)
        device = 0.05 / np.asarray(depth, np.float64)
        self.depths = Sampler(device[..., None])
        rows, columns = np.mgrid[0 : self.height, 0 : self.width]
        self.pixels = np.stack([columns, rows], -1)
        self.uv = (self.pixels.astype(np.float32) + np.float32(0.5)) / self.size

    def velocity(self, uv):
        return self.velocities.at(uv)

    def depth(self, uv):
        return self.depths.at(uv)[..., 0]


def on_image(uv):
    return np.all((uv >= 0) & (uv <= 1), axis=-1)


def fitness(demo, exposure, offset, back):
    """Time at which a source passed over the pixel, in frames, and whether the shutter was open then."""
    motion = -back
    square = dot(motion, motion)
    moves = square > SMALLEST
    divisor = np.maximum(SMALLEST, square)
    frames = dot(motion, offset) / divisor
    beside = np.abs(offset[..., 1] * motion[..., 0] - offset[..., 0] * motion[..., 1]) / divisor
    wide = np.float64 if demo.doubles else np.float32
    middle = wide(exposure) / wide(2)
    on_trail = np.abs(frames.astype(wide) - middle) <= middle
    on_path = beside <= np.float32(demo.perpendicular_tolerance) * exposure
    return frames, moves & on_trail & on_path


def dilate(demo, frame, exposure, step_multiplier):
    """The map of sources after the last step: position, velocity, distance and time of the best, and whether there is one."""
    shape = frame.pixels.shape[:2]
    stored = frame.uv
    for iteration in range(demo.passes):
        step = 2 ** (demo.passes - 1 - iteration)
        uv_step = np.float32(step) * np.float32(step_multiplier) / frame.size
        best = {
            "place": frame.uv.copy(),
            "back": np.zeros((*shape, 2), np.float32),
            "distance": np.full(shape, LARGEST),
            "frames": np.full(shape, LARGEST),
            "valid": np.zeros(shape, bool),
        }
        for neighbour in NEIGHBOURS:
            offset = np.array(neighbour, np.float32) * uv_step
            place = frame.uv + offset
            inside = on_image(place)
            offset = np.broadcast_to(offset, place.shape)
            if iteration > 0:
                column, row = np.moveaxis((place * frame.size).astype(np.int64), -1, 0)
                clamped = np.clip(row, 0, frame.height - 1), np.clip(column, 0, frame.width - 1)
                place = stored[clamped]
                offset = place - frame.uv
            back = frame.velocity(place)
            distance = NEAR_PLANE / frame.depth(place)
            frames, valid = fitness(demo, exposure, offset, back)
            # Without the impossible case, the shader's comparison reduces to this.
            better = inside & valid & (~best["valid"] | (distance < best["distance"]))
            candidate = {"place": place, "back": back, "distance": distance, "frames": frames, "valid": valid}
            for name, values in candidate.items():
                mask = better[..., None] if values.ndim == 3 else better
                best[name] = np.where(mask, values, best[name])
        stored = halved(best["place"]) if demo.half_map else best["place"]
    return best


def motion_difference(demo, motion, other):
    change = motion - other
    divisor = np.maximum(SMALLEST, dot(motion, motion))
    parallel = np.abs(dot(change, motion) / divisor)
    perpendicular = np.abs((change[..., 0] * motion[..., 1] - change[..., 1] * motion[..., 0]) / divisor)
    weighted = parallel * np.float32(demo.parallel_sensitivity)
    weighted = weighted + perpendicular * np.float32(demo.perpendicular_sensitivity)
    return np.clip(weighted, 0, 1)


def length(vectors):
    return np.sqrt(dot(vectors, vectors))


def cut(demo, frame, exposure, motion, factor, step_multiplier):
    """Frames after which a trail is cut: correct only for an exposure of one frame."""
    reach = np.float32(2 ** (demo.passes - 1)) * np.float32(step_multiplier) * np.float32(factor)
    with np.errstate(divide="ignore"):
        return reach / max(frame.size) / (length(motion) * exposure)


def walk_back(demo, frame, exposure, best, step_multiplier):
    """The final map: the position that each pixel takes its velocity from."""
    walks = best["valid"] & (NEAR_PLANE / frame.depth(frame.uv) >= best["distance"])
    # The way back does not use the gather's doubled reach.
    farthest = cut(demo, frame, exposure, best["back"], 1, step_multiplier)
    frames = np.where(walks, np.minimum(best["frames"], farthest), np.float32(0))
    place = frame.uv.copy()
    last_hit = frame.uv.copy()
    hits = np.zeros(walks.shape, int)
    for probe in range(-demo.probes, demo.probes + 1):
        back = frames * (np.float32(1) + np.float32(probe) / np.float32(demo.probes))
        at = frame.uv - best["back"] * back[..., None]
        looks = walks & (back <= exposure + np.float32(0.2)) & (back >= SMALLEST) & on_image(at)
        at = np.where(looks[..., None], at, frame.uv)
        difference = motion_difference(demo, best["back"], frame.velocity(at))
        matches = difference <= np.float32(demo.match_threshold)
        if demo.depth_match is not None:
            with np.errstate(divide="ignore", invalid="ignore"):
                apart = np.abs(frame.depth(at) - NEAR_PLANE / best["distance"])
            matches &= apart < np.float32(demo.depth_match)
        hit = looks & matches
        hits = hits + hit
        last_hit = np.where(hit[..., None], at, last_hit)
        # A skipped probe is no miss; a row of hits cut short by the last probe does not count.
        ends = (hit & (hits == demo.hits)) | (looks & ~matches & (hits > 0))
        place = np.where(ends[..., None], last_hit, place)
        walks = walks & ~ends
    return halved(place) if demo.half_map else place


def noise(frame, frame_index):
    """Interleaved gradient noise on a cycle of 8 frames."""
    shift = np.float32(frame_index % 8) * (np.array([47, 17], np.float32) * np.float32(0.695))
    at = frame.pixels.astype(np.float32) + shift
    inner = at[..., 0] * np.float32(0.06711056) + at[..., 1] * np.float32(0.00583715)
    outer = np.float32(52.9829189) * (inner - np.floor(inner))
    return outer - np.floor(outer)


def gather(demo, frame, exposure, sources, frame_index, step_multiplier):
    """The mean of colours along the motion of each pixel's source."""
    motion = -frame.velocity(sources)
    moves = dot(motion, motion) != 0
    farthest = cut(demo, frame, exposure, motion, demo.reach, step_multiplier)
    steps = np.float32(max(1, demo.samples - 1))
    step = motion * (np.minimum(exposure, farthest) / steps)[..., None]
    dither = noise(frame, frame_index)
    offset = np.zeros_like(step)
    if demo.shifts:
        offset = np.where(moves[..., None], step * (dither - np.float32(1))[..., None], 0)
    else:
        step = step * (np.float32(1) + (dither - np.float32(0.5)))[..., None]
    step = np.where(moves[..., None], step, 0)

    center = frame.color.at(frame.uv)
    total, weights = center.copy(), np.ones(moves.shape, np.float32)
    # The comparisons of the shader: device depth for the pixel, metres for the taps.
    depth = np.maximum(SMALLEST, frame.depth(sources))
    own_depth = np.maximum(SMALLEST, frame.depth(frame.uv))
    level = np.clip(np.float32(1) - (depth - own_depth) / np.float32(0.0001), 0, 1)
    extent = np.float32(0.1)
    soft = lambda other, this: np.clip(np.float32(1) - (other - this) / extent, 0, 1)
    goes_on = moves.copy()
    for _ in range(1, demo.samples):
        offset = offset + step
        at = frame.uv + offset
        goes_on &= on_image(at)
        at = np.where(goes_on[..., None], at, frame.uv)
        column, row = np.moveaxis((at * frame.size).astype(np.int64), -1, 0)
        clamped = np.clip(row, 0, frame.height - 1), np.clip(column, 0, frame.width - 1)
        other = sources[clamped]
        change = motion + frame.velocity(other)
        slower = dot(change, motion) / np.maximum(SMALLEST, dot(motion, motion))
        mismatch = np.power(np.clip(slower, 0, 1), np.float32(0.1))
        other_depth = np.maximum(SMALLEST, frame.depth(other))
        in_front = soft(NEAR_PLANE / other_depth, NEAR_PLANE / depth)
        weight = np.where(goes_on, np.float32(1) - in_front * mismatch, 0)
        place = at
        if demo.replaces:
            tap_depth = np.maximum(SMALLEST, frame.depth(at))
            tap_in_front = soft(NEAR_PLANE / tap_depth - extent, NEAR_PLANE / depth)
            share = (np.float32(1) - np.maximum(level, tap_in_front))[..., None]
            place = at * (np.float32(1) - share) + frame.uv * share
        total = total + frame.color.at(place) * weight[..., None]
        weights = weights + weight
    return np.where(moves[..., None], total / weights[..., None], center)


def blur(demo, color, velocity, depth, exposure, frame_index, step_multiplier):
    exposure = np.float32(exposure)
    frame = Frame(color, velocity, depth)
    if exposure == 0:
        return frame.color.texels
    best = dilate(demo, frame, exposure, step_multiplier)
    sources = walk_back(demo, frame, exposure, best, step_multiplier)
    return gather(demo, frame, exposure, sources, frame_index, step_multiplier)


def paper(color, velocity, depth, exposure, frame_index, parameters):
    """Blur as the demo of 2024-07-07 at commit fc7a04c does, with the values of its scene."""
    step = parameters.get("step_multiplier", 8)
    return blur(PAPER, color, velocity, depth, exposure, frame_index, step)


def july_2024(color, velocity, depth, exposure, frame_index, parameters):
    """Blur as the demo of 2024-07-09 at commit a34ff7f does, with the values of its scene."""
    step = parameters.get("step_multiplier", 8)
    return blur(JULY_2024, color, velocity, depth, exposure, frame_index, step)


ORIGINALS = {
    "jump_flood:paper": paper,
    "jump_flood:july_2024": july_2024,
    "jump_flood_packed:paper": paper,
    "jump_flood_packed:july_2024": july_2024,
}
