"""Types of the compiled module. A test compares the descriptions with the module's own."""

from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

_Floats = NDArray[np.float32]
_Scores = tuple[list[tuple[str, float]], list[tuple[str, str]], list[str]]

class Error(ValueError):
    """What was found, what is allowed, and the way out, as one sentence."""

class Render:
    """One frame of a scene and its truth: the picture that a camera with an open shutter takes.

    Arrays are read-only views of memory that the object holds; copy one before you change it.
    Pictures are scene-linear Rec.709 radiance, 0 and above, not limited to 1: float32 of shape
    (height, width, 3), row 0 at the top. Velocities are float32 of shape (height, width, 2), +x
    right, +y down."""

    @property
    def blurred(self) -> _Floats:
        """Truth: radiance integrated over the shutter."""
    @property
    def halves(self) -> list[_Floats]:
        """Two independent halves of `blurred`, which is their mean: their difference shows its noise."""
    @property
    def standard_error(self) -> _Floats:
        """Standard error of `blurred`, per channel, in radiance."""
    @property
    def frame(self) -> _Floats:
        """Sharp picture of the instant, time 0, which a filter gets."""
    @property
    def velocity(self) -> _Floats:
        """Motion at the instant, in pixels per frame: the kind that `render` was asked for."""
    @property
    def velocity_next(self) -> _Floats:
        """Motion of the same points from the instant to the next frame, in pixels."""
    @property
    def depth(self) -> _Floats:
        """Distance along the view axis in metres, above 0; 1e10 where nothing is seen. Shape (height,
        width)."""
    @property
    def object_id(self) -> NDArray[np.uint32]:
        """Object seen at the pixel's centre: an index of `objects`, uint32 of shape (height, width)."""
    @property
    def objects(self) -> list[str]:
        """Names of the objects; the first is `background`."""
    @property
    def coverage(self) -> dict[str, _Floats]:
        """Share of shutter and pixel that shows each object, by its name: float32 in 0 to 1, shape
        (height, width)."""
    @property
    def subframes(self) -> tuple[_Floats, ...]:
        """Sharp pictures at the middles of equal parts of the shutter, the earliest first; empty unless
        `render` was asked for some."""
    @property
    def noise(self) -> float:
        """Noise of `blurred` where anything moves: a root mean square of radiance."""
    @property
    def frame_noise(self) -> float:
        """Noise of `frame` over the whole picture: a root mean square of radiance."""
    @property
    def shutter(self) -> tuple[float, float]:
        """Times at which the shutter opens and closes, in frames; the instant is 0."""
    @property
    def alignment(self) -> str:
        """Place of the shutter around the instant: `trailing`, `centred` or `leading`."""
    @property
    def scene(self) -> str:
        """Name of the scene, with its variant and frame."""
    @property
    def size(self) -> tuple[int, int]:
        """Columns and rows."""

def blur(render: Render, filter: str, color: Optional[_Floats], options: dict[str, Any]) -> _Floats: ...
def filter_names() -> list[str]: ...
def flip(reference: _Floats, image: _Floats, stops: float, srgb: bool) -> _Floats: ...
def measure_filters(words: list[str]) -> list[dict[str, Any]]: ...
def name_module(path: str) -> None: ...
def render(scene: str, options: dict[str, Any]) -> Render: ...
def run_program(words: list[str]) -> int: ...
def scene_names(scenes_dir: Optional[str]) -> list[str]: ...
def score(image: _Floats, render: Render) -> _Scores: ...
def score_pair(image: _Floats, reference: _Floats) -> _Scores: ...
