"""Scores a filter of your own, written in numpy, against path-traced truth and against a built-in filter.

    python examples/python/score_my_filter.py
    python examples/python/score_my_filter.py fan railing --size 320x180

A filter in torch is no different: `torch.from_numpy(made.frame.copy())` goes in, `result.numpy()` comes out. Each `# %%` begins a
cell for editors that show scripts as notebooks.
"""

# %% Scenes and sizes
import argparse

import numpy as np

import shuttertruth as st

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("scenes", nargs="*", default=["sliding_panel", "two_spheres"])
parser.add_argument("--size", default="320x180")
parser.add_argument("--samples", type=int, default=64)
parser.add_argument("--against", default="mcguire:paper", help="a built-in filter; needs a Vulkan driver")
arguments = parser.parse_args()
width, height = map(int, arguments.size.split("x"))


# %% The filter
def fastest_nearby(velocity: np.ndarray, reach: int) -> np.ndarray:
    """Spreads the fastest motion of each tile, and of its neighbours, over the tile."""
    rows, columns = -(-height // reach), -(-width // reach)
    padded = np.pad(velocity, ((0, rows * reach - height), (0, columns * reach - width), (0, 0)))
    tiles = padded.reshape(rows, reach, columns, reach, 2).swapaxes(1, 2).reshape(rows, columns, -1, 2)
    around = np.pad(tiles, ((1, 1), (1, 1), (0, 0), (0, 0)))
    around = np.concatenate([around[i : i + rows, j : j + columns] for i in range(3) for j in range(3)], axis=2)
    fastest = np.linalg.norm(around, axis=-1).argmax(axis=2)[..., None, None]
    best = np.take_along_axis(around, fastest, axis=2)[:, :, 0]
    return best.repeat(reach, axis=0).repeat(reach, axis=1)[:height, :width]


def my_blur(made: st.Render, taps: int = 16) -> np.ndarray:
    """Averages, along the fastest motion nearby, what moves over a pixel while the shutter is open. Depth plays no part."""
    y, x = np.mgrid[:height, :width]
    opens, closes = made.shutter
    speed = np.linalg.norm(made.velocity, axis=-1)
    along = fastest_nearby(made.velocity, max(1, int(speed.max() * (closes - opens) / 2)))
    total = np.zeros_like(made.frame)
    for tap in range(taps):
        time = opens + (tap + 0.5) / taps * (closes - opens)
        # What is seen here at this time is that far away in the frame.
        column = np.clip(np.rint(x - time * along[..., 0]).astype(int), 0, width - 1)
        row = np.clip(np.rint(y - time * along[..., 1]).astype(int), 0, height - 1)
        distance = np.hypot(column - x, row - y)
        arrives = speed[row, column] * abs(time) + 0.5 >= distance
        total += np.where(arrives[..., None], made.frame[row, column], made.frame)
    return total / taps


# %% The ranking: FLIP where anything moves, 0 is best; skill is 0 for no blur and about 1 for the best that one frame allows
for scene in arguments.scenes:
    made = st.render(scene, size=(width, height), samples=arguments.samples)
    pictures = {"no blur": made.frame, "mine": my_blur(made), arguments.against: st.blur(made, arguments.against)}
    scores = {name: st.score(picture, made) for name, picture in pictures.items()}
    print(f"{scene}, noise of the truth {made.noise:.4f}")
    for name, of in sorted(scores.items(), key=lambda row: row[1]["flip_moving"]):
        skill = of.get("skill_flip", float("nan"))
        print(f"  {name:16} FLIP {of['flip_moving']:.3f}  skill {skill:5.2f}  PSNR {of['psnr_moving']:.1f} dB")
