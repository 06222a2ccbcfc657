"""Plants ten reported defects of motion blur again, and writes results/studies/replays.md.

    python3 engines/replays.py target/replays

Defects of an engine's buffers are planted into a capture of one of our scenes, and `engine audit` looks for them. Defects of a
blur are planted into a shader folder, and `check` looks for them with limits measured without the defect. Right and wrong
pictures are then compared as the project's own screenshot test does it. With CHECK set in the environment, verdicts are
compared with the page instead.
"""

import os
import pathlib
import re
import shutil
import sys
from collections import Counter
from dataclasses import dataclass
from typing import Callable

import numpy as np
import OpenEXR

from pictures import encode_srgb, read_channels, read_color
from program import audit, shuttertruth

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "results/studies/replays.md"
SIZE = "160x90"
# Samples per pixel of captures, whose colour is not compared with a truth, and of truths.
CAPTURE_SAMPLES, TRUTH_SAMPLES = 16, 64
# The scenes of crates/gate/guides/ci.md.
SHADER_SCENES = ["fan", "railing", "roll", "two_spheres", "sliding_panel"]
# Half a frame.
EXPOSURE = 0.5


def write_channels(path, channels):
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    with OpenEXR.File(header, {name: np.ascontiguousarray(plane) for name, plane in channels.items()}) as file:
        file.write(str(path))


# Scenes, right and wrong


def edited(text, edits):
    """Replaces each text, which must be there once."""
    for old, new in edits:
        if text.count(old) != 1:
            sys.exit(f"replays.py: {old!r} is {text.count(old)} times in a scene; mend the edits")
        text = text.replace(old, new)
    return text


def copy_scene(folder, scene, edits):
    """Copies a scene into `folder`, with edits of its scene.toml and, for `flag`, the cloth's rest pose; returns `folder`."""
    target = folder / scene
    shutil.rmtree(target, ignore_errors=True)
    shutil.copytree(ROOT / "scenes" / scene, target)
    shutil.copy(ROOT / "scenes/bounds.toml", folder)
    file = target / "scene.toml"
    file.write_text(edited(file.read_text(), edits))
    if scene == "flag":
        flatten(target / "flag_2.obj", target / "rest.obj")
    return folder


def flatten(cloth, rest):
    """Writes a cloth without its waves: the pose that a modeller binds bones in."""
    lines = (line.split() for line in cloth.read_text().splitlines())
    flat = (["v", words[1], words[2], "0"] if words[:1] == ["v"] else words for words in lines)
    rest.write_text("\n".join(" ".join(words) for words in flat) + "\n")


def render(folder, scene):
    """Renders the frame of a scene in `folder`; returns its colour, velocity, depth and object ids."""
    settings = ["--size", SIZE, "--samples-per-pixel", CAPTURE_SAMPLES, "--velocity", "previous_frame", "--exposure", EXPOSURE]
    shuttertruth("truths", "render", scene, "--scenes-dir", folder, *settings, "--quiet", "--out", folder / "rendered")
    channels = read_channels(folder / "rendered" / scene / "frame.exr")
    return {name: channels[name] for name in ["R", "G", "B", "Z", "velocity.X", "velocity.Y", "object.id"]}


FLAG_KEYS = """    { time = -1, mesh = "flag_0.obj" },
    { time = -0.5, mesh = "flag_1.obj" },
    { time = 0, mesh = "flag_2.obj" },
    { time = 0.5, mesh = "flag_3.obj" },
    { time = 1, mesh = "flag_4.obj" },
"""
FLAG_CAMERA = "position = [-2.2, 3.5, 5.2]\nlook_at = [1.2, 3.35, 0]\n"
MOVING_CAMERA = """keys = [
    { time = -1, position = [-2.4, 3.5, 5.2], look_at = [1.0, 3.35, 0] },
    { time = 1, position = [-2.0, 3.5, 5.2], look_at = [1.4, 3.35, 0] },
]
"""
CAR_KEYS = """keys = [
    { time = -1, translation = [7.4, 0, -2.2], rotation = { axis = [0, 1, 0], degrees = 180 } },
    { time = 1, translation = [5.6, 0, -2.2], rotation = { axis = [0, 1, 0], degrees = 180 } },
]

# The same"""
PARKED = "{ time = %d, translation = [6.5, 0, -2.2], rotation = { axis = [0, 1, 0], degrees = 180 } }"
DOLLY_CAMERA = """    { time = -1, position = [1.6, 1.5, 1.2], look_at = [1.6, 0.9, -4.8] },
    { time = 1, position = [1.6, 1.5, -1.2], look_at = [1.6, 0.9, -7.2] },
"""
DOLLY_CAR = """keys = [
    { time = -1, translation = [1.6, 0.02, -4.1], rotation = { axis = [0, 1, 0], degrees = 90 } },
    { time = 1, translation = [1.6, 0.02, -6.5], rotation = { axis = [0, 1, 0], degrees = 90 } },
]

[object.wheel_rear_right]"""


def cloth(*keys):
    """The edit that gives the cloth these shapes, (time, file)."""
    return FLAG_KEYS, "".join(f'    {{ time = {time}, mesh = "{mesh}.obj" }},\n' for time, mesh in keys)


def stale_index(folder):
    """A parked car, whose previous matrix is read where a moving mesh's is now: the lorry's."""
    right = copy_scene(folder / "right", "crossing", [(CAR_KEYS, f"keys = [{PARKED % -1}, {PARKED % 1}]\n\n# The same")])
    lorrys = "{ time = -1, translation = [-2, 0, 1.75], rotation = { axis = [0, 1, 0], degrees = 0 } }"
    wrong = copy_scene(folder / "wrong", "crossing", [(CAR_KEYS, f"keys = [{lorrys}, {PARKED % 0}, {PARKED % 1}]\n\n# The same")])
    return "crossing", right, render(wrong, "crossing")


REST_FIRST = (-3, "rest"), (-1, "flag_0"), (-0.5, "flag_1"), (0, "flag_2"), (0.5, "flag_3"), (1, "flag_4")


def unskinned_before(folder):
    """A waving cloth whose previous vertices are those of the rest pose."""
    right = copy_scene(folder / "right", "flag", [cloth(*REST_FIRST)])
    wrong = copy_scene(folder / "wrong", "flag", [cloth((-1, "rest"), (0, "flag_2"), (1, "flag_4"))])
    return "flag", right, render(wrong, "flag")


def current_for_previous(folder):
    """A waving cloth whose previous vertices are today's."""
    right = copy_scene(folder / "right", "flag", [cloth(*REST_FIRST)])
    wrong = copy_scene(folder / "wrong", "flag", [cloth((-1, "flag_2"), (0, "flag_2"), (1, "flag_4"))])
    return "flag", right, render(wrong, "flag")


def still_morph(folder):
    """A cloth that is morphed and stands still, whose previous vertices are those without morphs."""
    right = copy_scene(folder / "right", "flag", [cloth((-3, "rest"), (-1, "flag_2"), (1, "flag_2"))])
    wrong = copy_scene(folder / "wrong", "flag", [cloth((-1, "rest"), (0, "flag_2"), (1, "flag_2"))])
    return "flag", right, render(wrong, "flag")


def background_alone(folder):
    """A drive that turns, whose vectors are the background's: the camera's rotation, but neither its way nor objects."""
    turning = """    { time = -1, position = [1.6, 1.5, 1.2], look_at = [1.2, 0.9, -4.8] },
    { time = 1, position = [1.6, 1.5, -1.2], look_at = [2.0, 0.9, -7.2] },
"""
    turning_in_place = """    { time = -1, position = [1.6, 1.5, 0], look_at = [1.2, 0.9, -6] },
    { time = 1, position = [1.6, 1.5, 0], look_at = [2.0, 0.9, -6] },
"""
    parked = """translation = [1.6, 0.02, -5.3]
rotation = { axis = [0, 1, 0], degrees = 90 }

[object.wheel_rear_right]"""
    right = copy_scene(folder / "right", "dolly", [(DOLLY_CAMERA, turning)])
    wrong = copy_scene(folder / "wrong", "dolly", [(DOLLY_CAMERA, turning_in_place), (DOLLY_CAR, parked)])
    file = wrong / "dolly/scene.toml"
    file.write_text(re.sub(r"degrees = -?214\.8592", "degrees = 0", file.read_text()))
    return "dolly", right, render(wrong, "dolly")


def jitter_left_in(folder):
    """Vectors with the jitter of both frames: the second and third place of Halton's sequence in bases 2 and 3."""
    right = copy_scene(folder / "right", "crossing", [])
    wrong = render(right, "crossing")
    wrong["velocity.X"] = wrong["velocity.X"] + np.float32(3 / 4 - 1 / 4)
    wrong["velocity.Y"] = wrong["velocity.Y"] + np.float32(1 / 9 - 2 / 3)
    return "crossing", right, wrong


def bones_not_kept(folder):
    """A waving cloth before a moving camera; previous view and projection, today's vertices."""
    camera = (FLAG_CAMERA, MOVING_CAMERA)
    right = copy_scene(folder / "right", "flag", [cloth(*REST_FIRST), camera])
    wrong = copy_scene(folder / "wrong", "flag", [cloth((-1, "flag_2"), (0, "flag_2"), (1, "flag_4")), camera])
    return "flag", right, render(wrong, "flag")


# Captures


def write_capture(folder, scene, frame):
    folder.mkdir(parents=True, exist_ok=True)
    write_channels(folder / "color.exr", {name: frame[name] for name in "RGB"})
    write_channels(folder / "velocity.exr", {name: frame[name] for name in ["velocity.X", "velocity.Y"]})
    write_channels(folder / "depth.exr", {"Z": frame["Z"]})
    write_channels(folder / "object.exr", {"object": frame["object.id"].astype(np.float32)})
    write_channels(folder / "frame.exr", {name: plane for name, plane in frame.items() if name != "object.id"})
    (folder / "engine.toml").write_text("[convention]\n")
    (folder / "capture.toml").write_text(f'engine = "replay"\nscene = "{scene}"\n')


def audit_capture(capture, scenes):
    return audit(capture, "--scenes-dir", scenes, "--out", capture / "audit")


def blur(frame, own_blur):
    """Blurs a frame; returns the picture."""
    out = frame.with_name("blurred.exr")
    shuttertruth("engine", "blur", "--filter", own_blur, "--frame", frame, "--exposure", EXPOSURE, "--out", out)
    return read_picture(out)


def replay_capture(folder, plant, own_blur):
    """Plants a defect into a capture; returns what the audit says, and the right and the wrong picture."""
    scene, scenes, wrong = plant(folder)
    right = render(scenes, scene)
    # The defect is in the vectors alone.
    wrong = right | {name: wrong[name] for name in ["velocity.X", "velocity.Y"]}
    captures = {"right": right, "wrong": wrong}
    for name, frame in captures.items():
        write_capture(folder / "captures" / name, scene, frame)
    _, findings = audit_capture(folder / "captures/right", scenes)
    if findings:
        sys.exit(f"{folder}: the capture without the defect fails: {findings}")
    pictures = [blur(folder / "captures" / name / "frame.exr", own_blur) for name in captures]
    return audit_capture(folder / "captures/wrong", scenes)[1], {scene: pictures}


# Shaders

SHADER_TOML = """name = "my_three"
summary = "The motion blur of three.js, with its divisor, direction and length mended."
alignment = "centred"
mirror_symmetric = true

[[pass]]
entry = "gather"
"""
SHADER_SETTINGS = [
    ("parameters.coordinates == COORDINATES_DEVICE", "false"),
    ("parameters.divisor == DIVISOR_SAMPLES", "false"),
    ("* parameters.blur_amount", ""),
    ("@group(0) @binding(1) var<uniform> parameters: Parameters;\n", ""),
]


def write_shader(folder, defect):
    """Writes our port of the blur of three.js with its three defects mended, then one planted again."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    text = (ROOT / "shaders/three/three.wgsl").read_text()
    text = re.sub(r"struct Parameters \{.*?\}\n", "", text, flags=re.S)
    text = edited(text, SHADER_SETTINGS).replace("parameters.samples", "16")
    (folder / "my_three.wgsl").write_text(edited(text, defect))
    (folder / "filter.toml").write_text(SHADER_TOML)


TOO_BRIGHT = [("let gain = select(1.0,", "let gain = select(17.0 / 16.0,")]
Y_FLIPPED = [("return select(vec2<f32>(1.0),", "return select(vec2<f32>(1.0, -1.0),")]
TWO_FRAMES = [("return select(vec2<f32>(1.0),", "return select(vec2<f32>(2.0),")]

RUN = ["--size", SIZE, "--samples-per-pixel", TRUTH_SAMPLES, "--quiet"]


def measure_limits(folder):
    """Measures limits of the shader without a defect, as crates/gate/guides/ci.md says; returns scenes with them, and the run."""
    shader, calibrated, scenes = folder / "my_three", folder / "calibrated", folder / "scenes"
    write_shader(shader, [])
    settings = ["--scenes-dir", ROOT / "scenes", *RUN, "--runs", 2, "--out", calibrated]
    shuttertruth("limits", "calibrate", *SHADER_SCENES, "--filter", shader, *settings)
    shutil.rmtree(scenes, ignore_errors=True)
    scenes.mkdir(parents=True)
    shutil.copy(ROOT / "scenes/bounds.toml", scenes)
    for scene in SHADER_SCENES:
        shutil.copytree(ROOT / "scenes" / scene, scenes / scene)
        with (scenes / scene / "bounds.toml").open("a") as bounds:
            bounds.write((calibrated / f"{scene}.bounds.toml").read_text())
    return scenes, calibrated / "seed_1"


def replay_shader(folder, defect, limits):
    """Plants a defect into a shader; returns what `check` says, and right and wrong pictures of each scene."""
    scenes, run = limits
    shader, checked = folder / "my_three", folder / "run"
    write_shader(shader, defect)
    settings = ["--scenes-dir", scenes, *RUN, "--jitter-frames", 0, "--truths", run, "--out", checked]
    said = shuttertruth("check", *SHADER_SCENES, "--filter", shader, *settings, allowed=(0, 1, 2))
    (folder / "check.txt").write_text(said)
    pictures = {
        scene: [read_picture(root / scene / "my_three_default/output.exr") for root in (run, checked)] for scene in SHADER_SCENES
    }
    return check_words(said), pictures


def check_words(said):
    """Shortens what `check` says to verdict, broken scores and patterns; none if it passes."""
    verdict = re.search(r"^(PASS|FAIL|UNDECIDED).*", said, re.M)[0]
    if verdict == "PASS":
        return []
    patterns = Counter(re.findall(r"(no known failure pattern matched|most like \w+, \d+ % off)", said))
    return [f"{verdict}; {', '.join(f'{pattern} ({count})' for pattern, count in patterns.most_common())}"]


# Screenshot tests


def read_picture(path):
    """Reads a picture as an 8-bit sRGB screenshot."""
    return encode_srgb(read_color(path))


def yiq_difference(right, wrong):
    """Returns pixelmatch's difference of each pixel, 1 for black against white. It leaves antialiased pixels out; this does not."""
    r, g, b = np.moveaxis(right - wrong, -1, 0)
    y = 0.29889531 * r + 0.58662247 * g + 0.11448223 * b
    i = 0.59597799 * r - 0.27417610 * g - 0.32180189 * b
    q = 0.21147017 * r - 0.52261711 * g + 0.31114694 * b
    return np.sqrt((0.5053 * y * y + 0.299 * i * i + 0.1957 * q * q) / 35215)


def bevy_test(right, wrong):
    """Bevy: hashes of files; how much Pixel Eagle forgives after that is not in Bevy's repository."""
    share = np.any(right != wrong, axis=-1).mean()
    return share, share > 0


def three_test(right, wrong):
    """three.js: pixelThreshold 0.1, maxDifferentPixels 0.3 %."""
    share = (yiq_difference(right, wrong) > 0.1).mean()
    return share, share >= 0.003


def babylon_test(right, wrong):
    """Babylon.js: threshold 0.035, maxDiffPixelRatio 1.1 %."""
    share = (yiq_difference(right, wrong) > 0.035).mean()
    return share, share > 0.011


def byroredux_test(right, wrong):
    """ByroRedux: more than 1 % of pixels differ by more than 8 of 255, or one by more than 32."""
    difference = np.abs(right - wrong).max(axis=-1)
    share = (difference > 8).mean()
    return share, share > 0.01 or difference.max() > 32


def worst_test(test, pictures):
    """Compares all pictures; returns what the test says of the worst one."""
    results = {scene: test(*pair) for scene, pair in pictures.items()}
    scene = max(results, key=lambda scene: results[scene][0])
    share, fails = results[scene]
    return f"{'fails' if fails else 'passes'}: {100 * share:.2f} % in {scene}"


# The replays


@dataclass
class Replay:
    """A reported defect and how to plant it."""

    name: str
    # The issue, and what happened.
    issue: str
    found: str
    planted: str
    # Plants the defect into a capture, or edits of a shader.
    plant: Callable | list
    # Words that name the cause; none if no words are known for it.
    cause: str | None
    test: Callable
    # Whether the project's test draws motion blur.
    drawn: str
    # Our port of the project's motion blur; for ByroRedux, which has none, Bevy's.
    blur: str = "bevy:default"


BEVY = "https://github.com/bevyengine/bevy"
BEVY_TESTBEDS = "no: testbeds have no motion blur"
THREE_DRAWN = "yes; its code has the defect, and so may its picture"
REPLAYS = [
    Replay(
        "bevy_17717",
        f"[Bevy 17717]({BEVY}/pull/17717): meshes that were not updated kept an index into the previous frame's buffer, "
        "which holds others by then",
        "not said; label P-Regression",
        "`crossing`: the parked car has the lorry's last matrix",
        stale_index,
        "comes from the last matrix of",
        bevy_test,
        f"{BEVY_TESTBEDS}; the run of all examples draws `motion_blur`",
    ),
    Replay(
        "bevy_18712",
        f"[Bevy 18712]({BEVY}/pull/18712): a flag was set after specialisation, so that skinned meshes had no previous joints",
        "not said; a contributor tests it with `MotionBlur` added to an example",
        "`flag`: last vertices are those of the rest pose, which is what the shader takes without the flag",
        unskinned_before,
        "comes from the rest pose",
        bevy_test,
        f"{BEVY_TESTBEDS}, and `motion_blur` has no skin",
    ),
    Replay(
        "bevy_18715",
        f"[Bevy 18715]({BEVY}/pull/18715): the buffer of previous joints did not grow, which crashed WebGL; "
        "the fix fills it with today's joints for a frame",
        "a contributor, by the crash (18714)",
        "`flag`: last vertices are today's, the glitch that the fix leaves. The crash leaves no frame",
        current_for_previous,
        "lacks the deformation",
        bevy_test,
        f"{BEVY_TESTBEDS}; the run of all examples leaves out stress tests",
    ),
    Replay(
        "bevy_23118",
        f"[Bevy 23118]({BEVY}/issues/23118), open: previous positions of morphed meshes lack the morph, so that still bars blur",
        "a contributor, by eye, with a new option of a stress test",
        "`flag`, standing still: last vertices are those of the rest pose",
        still_morph,
        "comes from the rest pose",
        bevy_test,
        f"{BEVY_TESTBEDS}; the run of all examples leaves out stress tests",
    ),
    Replay(
        "bevy_24097",
        f"[Bevy 24097]({BEVY}/issues/24097): without shadows, meshes were not drawn into the prepass; "
        "of motion blur, the camera's rotation was left",
        "a contributor, by eye, with shadows off",
        "`dolly` with a turning camera: all vectors are the background's",
        background_alone,
        "the camera's turn alone",
        bevy_test,
        f"{BEVY_TESTBEDS}; `motion_blur` has shadows on",
    ),
    Replay(
        "three_brightness",
        "three.js 0.187: the pixel and 16 taps are divided by 16",
        "by [measuring](threejs.md); no report found",
        "shader: divisor 16 instead of 17",
        TOO_BRIGHT,
        "too_bright",
        three_test,
        THREE_DRAWN,
    ),
    Replay(
        "three_y",
        "three.js 0.187: velocity has y up, texture coordinates y down",
        "by [measuring](threejs.md); no report found",
        "shader: y of the trail flipped",
        Y_FLIPPED,
        "y_flipped",
        three_test,
        THREE_DRAWN,
    ),
    Replay(
        "three_length",
        "three.js 0.187: velocity is 2 wide, texture coordinates 1",
        "by [measuring](threejs.md); no report found",
        "shader: trails twice as long",
        TWO_FRAMES,
        "twice_length",
        three_test,
        THREE_DRAWN,
    ),
    Replay(
        "babylon_16835",
        "[Babylon.js 16835](https://github.com/BabylonJS/Babylon.js/pull/16835): vectors held the jitter of temporal antialiasing",
        "its author, while writing the feature: \"more blurry and jittery\"",
        "`crossing`: two places of Halton's sequence left in",
        jitter_left_in,
        "jitter is left in",
        babylon_test,
        "yes: reference pictures of motion blur and of reprojection",
        "babylon:default",
    ),
    Replay(
        "byroredux_641",
        "[ByroRedux 641](https://github.com/matiaszanolli/ByroRedux/issues/641): previous positions took today's bones",
        "by reading code (an audit of the renderer)",
        "`flag` before a moving camera: last vertices are today's",
        bones_not_kept,
        "lacks the deformation",
        byroredux_test,
        "no: the test came 13 days later, and stops time",
    ),
]


def verdict(replay, findings):
    """Says whether all findings of an audit name the cause first, or all guesses of `check`; quotes the first up to its advice."""
    if not findings:
        return "**missed**"
    guesses = re.findall(r"most like \w+", findings[0]) or [text.split("; ")[0] for text in findings]
    named = replay.cause and all(replay.cause in guess for guess in guesses)
    quoted = re.sub(r"; (find|keep|look|take) .*", "", findings[0])
    more = f" (and {len(findings) - 1} more objects)" if len(findings) > 1 else ""
    return f"{'named' if named else '**caught, not named**'}: *{quoted}*{more}"


def replay_all(out):
    """Replays all defects; returns a row of the table for each."""
    limits, rows = measure_limits(out / "three"), []
    for replay in REPLAYS:
        folder = out / replay.name
        if callable(replay.plant):
            findings, pictures = replay_capture(folder, replay.plant, replay.blur)
        else:
            findings, pictures = replay_shader(folder, replay.plant, limits)
        row = [replay.issue, replay.found, replay.planted, verdict(replay, findings), worst_test(replay.test, pictures), replay.drawn]
        rows.append(row)
        print(replay.name, *row[3:5], sep=" | ", flush=True)
    return rows


HEAD = ["defect", "how it was found", "planted", "Shuttertruth", "their test, on our pictures", "does their test draw motion blur?"]


def write_page(rows):
    table = "\n".join(f"| {' | '.join(row)} |" for row in [HEAD, ["---"] * len(HEAD), *rows])
    count = sum(row[3].startswith("named") for row in rows)
    named = "each" if count == len(rows) else count
    missed = sum(row[3].startswith("**missed") for row in rows)
    failing = sum(row[4].startswith("fails") for row in rows)
    PAGE.write_text(f"""# Ten reported defects, planted again

Shuttertruth catches {len(rows) - missed} of {len(rows)} defects, and names the cause of {named}. Under the tolerances of the projects' own
screenshot tests, {failing} wrong pictures differ from the right ones. But few of these tests draw motion blur and compare it with a
right picture: the last column.

{table}

    make replays

This command plants all defects and writes this page, in four minutes on two cores; with `CHECK=1` in the environment it compares
verdicts with the page instead. Captures are our tracer's frames with other vectors; without the defect, the audit passes. Limits of
`check` are measured without the defect, as [the CI guide](../../crates/gate/guides/ci.md) says; the number of bounds is in brackets.

## Where it shows

- **Flipped y**: of the five scenes, only `roll` shows it. A baseline of `sliding_panel`, `panel_over_texture`, `two_spheres`, `railing`
  and `fan` passed.

## What their tests do

- **Bevy**: `.github/example-run` draws testbeds without motion blur, before each of the four fixes and at 4805ca79 of 2026-08-22.
  `send-screenshots-to-pixeleagle.yml` sends hashes, and pictures whose hash is new, to Pixel Eagle. What Pixel Eagle tolerates is not
  in the repository, so any pixel counts here. TheBevyFlock/bevy-example-runner draws all examples but stress tests, with frames of
  0.0125 s (copy at 0303034c, undated).
- **three.js**: `test/e2e/puppeteer.js` allows 0.3 % of pixels above a threshold of 0.1, and draws the motion blur example (undated copy).
  `deterministic-injection.js` at 1b48bbb5 steps time by 1/60 s for two frames: velocity is not zero. The three versions of
  `motionBlur` that were read and take a velocity have all three defects; the stored picture was not looked at. An older one, at 0a3a34b2,
  divides 31 colours by 31.
- **Babylon.js**: `visualizationPlaywright.utils.ts` allows 1.1 % of pixels above a threshold of 0.035 (copy at 0c170fd5, undated), and
  in a copy at afd577ae 3 % above 0.1. `ReferenceImages` has `FrameGraph-motion-blur-skinned.png` and
  `FrameGraph-TAA-reproject-history.png`. The vectors were for antialiasing; the pictures here are of our port of the motion blur.
- **ByroRedux**: `golden_frames.rs`, of 2026-05-09, allows 1 % of pixels to differ by more than 8 of 255, and none by more than 32. The
  defect was fixed on 2026-04-26. The engine has no motion blur; the pictures here are of our port of Bevy's.

## What was read

Threads were read in stored excerpts, not to their ends; fixes of Bevy and ByroRedux in their repositories. Not all are regressions of a
release: Bevy 18715 is a crash, Babylon.js 16835 was found before it was merged, and nobody reported those of three.js as far as we found.
""")


def differences(rows):
    """Lists rows whose verdict or test differs from the page's, numbers aside; of `check`, only that it fails."""
    page = [line.strip("| ").split(" | ") for line in PAGE.read_text().splitlines() if line.startswith("|")][2:]
    if len(page) != len(rows):
        return [f"the page has {len(page)} rows, not {len(rows)}"]

    def essence(row):
        return re.sub(r"[-+\d.]+", "0", re.sub(r"FAIL: .*", "FAIL", row[3])), row[4].split(":")[0]

    pairs = [(old[0], essence(old), essence(new)) for old, new in zip(page, rows)]
    return [f"{issue}: the page says {old}, replayed {new}" for issue, old, new in pairs if old != new]


def main():
    rows = replay_all(pathlib.Path(sys.argv[1]))
    if not os.environ.get("CHECK"):
        write_page(rows)
    elif different := differences(rows):
        sys.exit(f"{PAGE}: " + "\n".join(different))


if __name__ == "__main__":
    main()
