"""Makes pairs for deblurring and optical flow: blurred and sharp pictures, flow both ways, and depth.

    python examples/python/make_deblurring_pairs.py --out pairs
    python examples/python/make_deblurring_pairs.py fan@seal1 fan@seal2 --frames 3 --size 640x360 --out pairs

Writes a folder per pair: blurred.npy, sharp.npy (scene-linear radiance), depth.npy (metres), and the motion to the next and to the
previous frame as next.flo, previous.flo (Middlebury) and next.png, previous.png (KITTI). The sharp picture is the middle of the
shutter. `@seal1` and other numbers are variants of a scene with other speeds, directions and colours.
"""

# %% What to make
import argparse
import pathlib
import struct
import time
import zlib

import numpy as np

import shuttertruth as st

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("scenes", nargs="*", default=["fan", "railing"])
parser.add_argument("--frames", type=int, default=1, help="consecutive frames of each scene")
parser.add_argument("--size", default="320x180")
parser.add_argument("--exposure", type=float, default=0.5, help="in frames")
parser.add_argument("--noise", type=float, default=0.002, help="most noise of both pictures, in radiance")
parser.add_argument("--out", type=pathlib.Path, default="pairs")
arguments = parser.parse_args()


# %% Files of flow
def write_flo(path: pathlib.Path, flow: np.ndarray) -> None:
    """Writes Middlebury's .flo: a tag, the size, and float32 pairs."""
    height, width, _ = flow.shape
    path.write_bytes(struct.pack("<fii", 202021.25, width, height) + flow.astype("<f4").tobytes())


def write_kitti(path: pathlib.Path, flow: np.ndarray) -> None:
    """Writes KITTI's PNG of 16 bits: 64 steps a pixel from -512 on, and 1 where they are valid."""
    height, width, _ = flow.shape
    valid = np.abs(flow).max(axis=-1, keepdims=True) < 512
    steps = np.where(valid, np.rint(64 * flow) + 2**15, 0)
    rows = np.concatenate([steps, valid], axis=-1).astype(">u2").reshape(height, -1)
    filtered = b"".join(b"\0" + row.tobytes() for row in rows)
    header = struct.pack(">IIBBBBB", width, height, 16, 2, 0, 0, 0)
    chunks = [(b"IHDR", header), (b"IDAT", zlib.compress(filtered)), (b"IEND", b"")]
    framed = [struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body)) for kind, body in chunks]
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(framed))


# %% The pairs
width, height = map(int, arguments.size.split("x"))
began = time.monotonic()
pairs = [(scene, frame) for scene in arguments.scenes for frame in range(arguments.frames)]
for scene, frame in pairs:
    made = st.render(
        scene,
        (width, height),
        arguments.exposure,
        samples=64,
        noise=arguments.noise,
        velocity="previous_frame",
        at_frame=frame,
    )
    folder = arguments.out / f"{made.scene.replace('/', '_')}"
    folder.mkdir(parents=True, exist_ok=True)
    for name, array in [("blurred", made.blurred), ("sharp", made.frame), ("depth", made.depth)]:
        np.save(folder / f"{name}.npy", array)
    for name, flow in [("next", made.velocity_next), ("previous", -made.velocity)]:
        write_flo(folder / f"{name}.flo", flow)
        write_kitti(folder / f"{name}.png", flow)
    print(f"{folder}: noise of blurred {made.noise:.4f}, of sharp {made.frame_noise:.4f}")
took = time.monotonic() - began
print(f"{len(pairs)} pairs in {took:.0f} s: {3600 * len(pairs) / took:.0f} pairs an hour")
