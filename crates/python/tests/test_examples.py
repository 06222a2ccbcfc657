"""Tests of `examples/python`, small."""

import contextlib
import io
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

import numpy as np

import shuttertruth as st

EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "examples/python"


def run(name, *words, **options):
    """Runs an example; returns what it prints."""
    done = subprocess.run([sys.executable, EXAMPLES / name, *words], capture_output=True, text=True, **options)
    assert done.returncode == 0, done.stderr
    return done.stdout


def read_flo(path):
    tag, width, height = struct.unpack("<fii", path.read_bytes()[:12])
    assert abs(tag - 202021.25) < 1e-3
    return np.frombuffer(path.read_bytes()[12:], "<f4").reshape(height, width, 2)


def read_kitti(path):
    """Decodes the flow of a PNG of 16 bits without filters, and where it is valid."""
    data, at, parts = path.read_bytes(), 8, {}
    while at < len(data):
        [length] = struct.unpack(">I", data[at : at + 4])
        kind, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + length]
        [checksum] = struct.unpack(">I", data[at + 8 + length : at + 12 + length])
        assert checksum == zlib.crc32(kind + body)
        parts[kind] = body
        at += 12 + length
    width, height, bits, color = struct.unpack(">IIBB", parts[b"IHDR"][:10])
    assert (bits, color) == (16, 2)
    rows = np.frombuffer(zlib.decompress(parts[b"IDAT"]), np.uint8).reshape(height, 1 + 6 * width)
    assert not rows[:, 0].any()
    pixels = np.ascontiguousarray(rows[:, 1:]).view(">u2").reshape(height, width, 3).astype(float)
    return (pixels[..., :2] - 2**15) / 64, pixels[..., 2] == 1


class Examples(unittest.TestCase):
    def test_the_code_of_the_page_runs(self):
        page = (EXAMPLES.parents[1] / "crates/python/README.md").read_text()
        [code] = [block.split("```")[0] for block in page.split("```python")[1:]]
        self.assertIn("size=(320, 180)", code)
        with contextlib.redirect_stdout(io.StringIO()) as said:
            exec(code.replace("size=(320, 180)", "size=(96, 54)"), {})
        flip, skill = map(float, said.getvalue().split())
        self.assertTrue(0.0 < flip < 1.0 and skill < 1.0, said.getvalue())

    def test_my_filter_beats_no_blur(self):
        said = run("score_my_filter.py", "two_spheres", "--size", "96x54")
        ranked = [line.split("FLIP")[0].strip() for line in said.splitlines()[1:]]
        self.assertEqual(len(ranked), 3)
        self.assertLess(ranked.index("mine"), ranked.index("no blur"))

    def test_pairs_are_clean_and_their_flows_lead_both_ways(self):
        with tempfile.TemporaryDirectory() as out:
            said = run("make_deblurring_pairs.py", "sliding_panel", "--frames", "2", "--size", "64x36", "--out", out)
            self.assertRegex(said, r"2 pairs in \d+ s: \d+ pairs an hour")
            folders = sorted(path.parent for path in pathlib.Path(out).rglob("sharp.npy"))
            self.assertEqual(len(folders), 2)
            self.check_pair(folders[0])

    def check_pair(self, folder):
        made = st.render(
            "sliding_panel", (64, 36), samples=64, noise=0.002, velocity="previous_frame"
        )
        self.assertLessEqual(max(made.noise, made.frame_noise), 0.002)
        for name, array in [("blurred", made.blurred), ("sharp", made.frame), ("depth", made.depth)]:
            np.testing.assert_array_equal(np.load(folder / f"{name}.npy"), array)
        for name, flow in [("next", made.velocity_next), ("previous", -made.velocity)]:
            np.testing.assert_array_equal(read_flo(folder / f"{name}.flo"), flow)
            rounded, valid = read_kitti(folder / f"{name}.png")
            self.assertTrue(valid.all())
            # Half of a step of 1/64 px.
            np.testing.assert_allclose(rounded, flow, atol=0.5 / 64 + 1e-6)
        # The sharp picture shows a point of the panel where the next frame's flow says that it goes.
        later = st.render("sliding_panel", (64, 36), samples=64, at_frame=1)
        y, x = np.argwhere(made.object_id == made.objects.index("panel")).mean(axis=0).astype(int)
        across, down = np.rint(made.velocity_next[y, x]).astype(int)
        self.assertEqual(later.object_id[y + down, x + across], made.object_id[y, x])


if __name__ == "__main__":
    unittest.main()
