"""Motion blur, measured against path-traced truth.

    import shuttertruth as st

    fan = st.render("fan", size=(320, 180))
    blurred = st.blur(fan, "kino:default")
    print(st.score(blurred, fan)["flip_moving"])

Pictures are arrays of shape (height, width, 3): scene-linear Rec.709 radiance, row 0 at the top. Rendering and scoring need the
processor alone; `blur` and `run` need a Vulkan driver.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from numbers import Integral
from os import PathLike, fspath
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._native import Error, Render

__all__ = ["Error", "Render", "Scores", "blur", "filters", "flip", "render", "run", "scenes", "score"]

Path = Union[str, "PathLike[str]"]

_native.name_module(_native.__file__)


class Scores(dict[str, float]):
    """Scores of a picture by name, such as `flip_moving`, `psnr_full`, `skill_flip`: numbers."""

    missing: dict[str, str]
    """Scores that do not apply, each with the reason."""
    notes: list[str]
    """What else to know of the scores, each a sentence."""

    def __init__(self, values: Iterable[tuple[str, float]], missing: Iterable[tuple[str, str]], notes: list[str]) -> None:
        super().__init__(values)
        self.missing = dict(missing)
        self.notes = notes

    def __missing__(self, name: str) -> float:
        if name in self.missing:
            raise Error(f"{name} does not apply: {self.missing[name]}")
        raise KeyError(name)


def scenes(scenes_dir: Optional[Path] = None) -> list[str]:
    """Lists the scenes of a folder [default: `scenes` here if there is one, else the built-in ones]."""
    return _native.scene_names(_path(scenes_dir))


def filters() -> list[str]:
    """Lists the built-in filters with their presets, such as `kino:default`."""
    return _native.filter_names()


def render(
    scene: Path,
    size: tuple[int, int] = (640, 360),
    exposure: Optional[float] = 0.5,
    samples: int = 256,
    seed: int = 0,
    subframes: int = 0,
    *,
    alignment: str = "centred",
    velocity: str = "instantaneous",
    at_frame: int = 0,
    noise: Optional[float] = None,
    scenes_dir: Optional[Path] = None,
) -> Render:
    """Renders one frame of a scene, and its truth: what a camera with an open shutter sees.

    scene: a name of `scenes()`, with an optional variant such as "fan@seal7" or "fan@24fps", or the path of a scene's folder.
    size: columns and rows, 16 to 16384.
    exposure: time that the shutter is open, in frames: 0.5 is 180 degrees. None takes the scene's own.
    samples: mean samples per pixel, a multiple of 8. Time grows with them; noise falls with about their square root.
    seed: seed of all random numbers. The same arguments render the same bytes.
    subframes: sharp pictures to render over the shutter. Each takes as long as the frame.
    alignment: "centred" (the frame shows the middle of the shutter), "trailing" (it shows the end) or "leading".
    velocity: "instantaneous" (the derivative, in pixels per frame), "previous_frame" (the motion since the frame before, as
        engines have it) or "camera_only".
    at_frame: renders the scene as many frames later. Scenes end with their keys; beyond them is an error.
    noise: most noise of truth and frame, a root mean square of radiance. Each takes the samples that it needs for it, `samples` at least.

    Uses all cores; other threads of Python go on meanwhile, and Ctrl-C ends it.
    """
    options = {
        "size": _size(size),
        "exposure": exposure,
        "samples": _count("samples", samples),
        "seed": _count("seed", seed, 2**64),
        "subframes": _count("subframes", subframes),
        "alignment": alignment,
        "velocity": velocity,
        "at_frame": _count("at_frame", at_frame),
        "noise": noise,
        "scenes_dir": _path(scenes_dir),
    }
    return _native.render(fspath(scene), options)


def blur(
    frame: Render,
    filter: Path,
    *,
    color: Optional[ArrayLike] = None,
    set: Mapping[str, Any] = {},
    as_written: bool = False,
    frame_index: int = 0,
    adapter: Optional[str] = None,
    allow_commands: bool = False,
) -> NDArray[np.float32]:
    """Runs a filter on a frame, and returns its picture: float32 of shape (height, width, 3).

    filter: a name of `filters()`, without preset its first one, or the path of a filter's folder. It blurs for one alignment of the
        shutter, which the frame's render must have.
    color: a picture to blur in the frame's place, with the frame's velocity and depth.
    set: values in place of the preset's, by parameter: {"samples": 16}.
    as_written: keeps lengths in pixels as the preset has them, instead of scaling them to the picture's width.
    frame_index: seeds the noise of filters that have some.
    adapter: number or part of the name of the graphics adapter.
    allow_commands: lets a filter run that is a program. Read first what it does.
    """
    options = {
        "set": {name: _text(value) for name, value in set.items()},
        "as_written": as_written,
        "frame_index": _count("frame_index", frame_index),
        "adapter": adapter,
        "allow_commands": allow_commands,
    }
    color = None if color is None else _picture("color", color)
    return _native.blur(frame, fspath(filter), color, options)


def score(
    image: ArrayLike,
    truth: Optional[Render] = None,
    *,
    reference: Optional[ArrayLike] = None,
) -> Scores:
    """Scores a picture against the truth of a render, or against another picture.

    image: scene-linear radiance, a float array of shape (height, width, 3) and of the truth's size.
    truth: the render of the frame that the picture was made from.
    reference: what the picture should be, if there is no render: scores of the whole picture, such as `flip_full` and `ssim_full`.
    """
    if (truth is None) == (reference is None):
        raise Error("score needs a truth or a reference; allowed: one of the two")
    if truth is not None:
        return Scores(*_native.score(_picture("image", image), truth))
    assert reference is not None
    return Scores(*_native.score_pair(*_pair("image", image, "reference", reference)))


def run(
    scenes: Union[str, Iterable[str]] = (),
    filters: Union[str, Iterable[str]] = (),
    size: tuple[int, int] = (320, 180),
    samples: int = 256,
    seed: int = 1,
    *,
    out: Path = "out",
    options: Iterable[str] = (),
) -> list[dict[str, Any]]:
    """Measures filters on scenes as the command `shuttertruth run` does, and returns a row per case.

    A row holds the names of scene and filter, alignment and exposure, and every score by its name, NaN where it does not apply:
    `pandas.DataFrame(st.run("fan", "kino:*"))`. Reference pictures, such as `identity` (no blur), have `reference` True.

    scenes, filters: names, patterns or folders; none means all.
    out: folder for pictures, truths and run.json. What is finished there is not measured again; `shuttertruth report` makes its page.
    options: further options of the command, such as ["--frame-rate", "24"]. No shuttertruth.toml is read.
    """
    width, height = _size(size)
    words = ["--size", f"{width}x{height}", "--samples-per-pixel", str(samples), "--seed", str(seed), "--out", fspath(out)]
    for option, names in [("--scenes", scenes), ("--filter", filters)]:
        for name in [names] if isinstance(names, str) else names:
            words += [option, fspath(name)]
    return _native.measure_filters([*words, *options])


def flip(a: ArrayLike, b: ArrayLike, *, stops: float = 0.0, srgb: bool = False) -> NDArray[np.float32]:
    """Maps LDR-FLIP, the difference that a person sees: float32 in 0 to 1, shape (height, width); `.mean()` is its usual number.

    a, b: the reference and the picture, float arrays of shape (height, width, 3).
    stops: exposure at which scene-linear pictures are shown: radiance times 2**stops is 1 at display white.
    srgb: True if the pictures are sRGB values in 0 to 1, such as a PNG's divided by 255.
    """
    return _native.flip(*_pair("a", a, "b", b), stops, srgb)


def _path(path: Optional[Path]) -> Optional[str]:
    return None if path is None else fspath(path)


def _text(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def _count(what: str, number: int, limit: int = 2**32) -> int:
    """Returns a whole number; refuses others."""
    if not isinstance(number, Integral) or not 0 <= number < limit:
        raise Error(f"{what} is {number!r}; allowed: whole numbers from 0 to {limit - 1}")
    return int(number)


def _size(size: tuple[int, int]) -> list[int]:
    """Returns columns and rows; refuses what is not two of them."""
    sides = list(size) if isinstance(size, Iterable) else [size]
    if len(sides) != 2 or not all(isinstance(side, Integral) and 16 <= side <= 16384 for side in sides):
        raise Error(f"size is {size!r}; allowed: columns and rows from 16 to 16384, such as (640, 360)")
    return [int(side) for side in sides]


def _picture(what: str, pixels: ArrayLike) -> NDArray[np.float32]:
    """Converts a picture to contiguous float32; refuses other numbers and shapes."""
    array = np.asarray(pixels)
    if array.dtype.kind != "f" or array.ndim != 3 or array.shape[2] != 3 or array.size == 0:
        raise Error(
            f"{what} is an array of {array.dtype} of shape {array.shape}; allowed: floats of shape (height, width, 3), scene-linear; "
            "divide 8-bit values by 255 and decode sRGB first, and move channels to the end with numpy.moveaxis(array, 0, -1)"
        )
    return np.ascontiguousarray(array, dtype=np.float32)


def _pair(
    what: str, pixels: ArrayLike, other: str, other_pixels: ArrayLike
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Converts two pictures; refuses two sizes, and what is no number."""
    pair = _picture(what, pixels), _picture(other, other_pixels)
    if pair[0].shape != pair[1].shape:
        raise Error(f"{what} has the shape {pair[0].shape}, {other} has {pair[1].shape}; allowed: pictures of one size")
    for name, array in zip((what, other), pair):
        if not np.isfinite(array).all():
            y, x, _ = np.argwhere(~np.isfinite(array))[0]
            raise Error(f"{name} holds {array[y, x]} at column {x}, row {y}; allowed: finite numbers")
    return pair
