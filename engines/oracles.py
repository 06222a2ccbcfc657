"""Compares our truths with those of another path tracer with motion blur of its own, and writes a page of results/studies.

    python3 engines/oracles.py luxcore target/engines/luxcore -- PYTHON_WITH_PYLUXCORE engines/luxcore/draw.py
    python3 engines/oracles.py cycles target/engines/cycles -- PYTHON_WITH_BPY -W ignore examples/blender/blender.py --

With CHECK set in the environment it compares with that page instead. The scenes lose their smooth normals first, in a copy: each renderer
has a way of its own to keep these from leaking light.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import textwrap
from datetime import date

import numpy as np

from pictures import read_color, read_colors
from program import shuttertruth

TOP = pathlib.Path(__file__).resolve().parent.parent
SIZE, SAMPLES = "160x90", 256
# How far a mean may be from ours, and how far a page's.
BOUND = 0.002
TOLERANCE = 0.001


class CannotDraw(Exception):
    """A scene that the other renderer cannot draw."""


class Renderer:
    def __init__(self, command):
        self.command = command

    def version(self):
        return subprocess.run([self.command[0], "-c", self.version_code], stdout=subprocess.PIPE, text=True).stdout.split()[-1]


class LuxCore(Renderer):
    """Rigid scenes before a camera that stands."""

    page = "oracles"
    name = "LuxCore"
    note = """LuxCore sees the scenes without smooth normals, and so do we for this page: the renderers keep these from leaking light in
their own ways, which is 0.3 to 0.9 % on curved objects of `fan`. Three more things differ by design, and `engines/luxcore/draw.py` sets
them: its rows are one pixel low, a sun with a disc takes radiance, and textures are given as linear floats.
[Cycles](oracles_cycles.md) draws the scenes that LuxCore leaves out."""
    version_code = "import pyluxcore; pyluxcore.Init(); print(pyluxcore.Version())"

    def draws(self, scene):
        return True

    def draw(self, exported, out):
        """Draws two independent halves of the samples; returns them."""
        words = [*self.command, exported, out, "--size", SIZE, "--samples", str(SAMPLES)]
        drawn = subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if drawn.returncode:
            raise CannotDraw(drawn.stderr.strip().splitlines()[-1].split(": ")[-1])
        return [read_color(out / f"{half}.exr") for half in "ab"]


class Cycles(Renderer):
    """Moving cameras, a lens, deforming meshes and glass."""

    page = "oracles_cycles"
    name = "Cycles of Blender"
    scenes = ["cockpit", "dolly", "flag", "foliage", "glasshouse", "neon", "pan_sky", "ramp_floor", "roll", "shallow_focus", "sparks", "wheel_roll"]
    note = """Cycles draws what [LuxCore](oracles.md) cannot: moving cameras, a lens, deforming meshes, glass. Its shutter holds 129 poses."""
    version_code = "import bpy; print(bpy.app.version_string)"

    def draws(self, scene):
        return scene in self.scenes

    def draw(self, exported, out):
        """Draws two halves with different seeds; returns them."""
        return [self.render(exported, out / str(seed), SIZE, SAMPLES // 2, seed) for seed in (1, 2)]

    def render(self, exported, out, size, samples, seed):
        """Renders the mean over a centred shutter with a number of samples per pixel; returns it."""
        # Blender draws the blur with four times the samples that it is given.
        settings = ["--size", size, "--samples", str(samples // 4), "--blur", "cycles", "--blur-only", "--seed", str(seed)]
        subprocess.run([*self.command, exported, out, *settings], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
        return read_color(out / "blurred.exr")


def copy_flat(scenes, out):
    """Copies scenes without the normals of their meshes."""
    shutil.rmtree(out, ignore_errors=True)
    shutil.copytree(scenes, out, ignore=shutil.ignore_patterns("generator"))
    for path in out.rglob("*.obj"):
        lines = [line for line in path.read_text().splitlines() if not line.startswith("vn ")]
        corner = lambda match: match[1] + ("/" + match[2] if match[2] else "")
        flat = [re.sub(r"(\d+)/(\d*)/\d+", corner, line) if line.startswith("f ") else line for line in lines]
        path.write_text("\n".join(flat) + "\n")


def compare(theirs, ours):
    """Returns the ratio of mean radiance, and the rms difference in parts of what the noise of both allows."""
    noise = np.sqrt(sum(((a - b) ** 2).mean() / 4 for a, b in (theirs, ours)))
    theirs, ours = np.mean(theirs, axis=0), np.mean(ours, axis=0)
    return theirs.mean() / ours.mean(), np.sqrt(((theirs - ours) ** 2).mean()) / noise


def main():
    name, folder, _, *command = sys.argv[1:]
    renderer = {"luxcore": LuxCore, "cycles": Cycles}[name](command)
    folder = pathlib.Path(folder)
    scenes = folder / "scenes"
    copy_flat(TOP / "scenes", scenes)
    rows, left_out = [], []
    for scene in sorted(path.parent.name for path in scenes.glob("*/scene.toml")):
        if not renderer.draws(scene):
            continue
        shuttertruth("engine", "export", scene, "--scenes-dir", scenes, "--gltf", folder / "gltf")
        try:
            theirs = renderer.draw(folder / "gltf" / scene, folder / "drawn" / scene)
        except CannotDraw as reason:
            left_out.append(f"{scene} ({reason})")
            continue
        render = ["truths", "render", scene, "--scenes-dir", scenes, "--alignments", "centred", "--size", SIZE]
        shuttertruth(*render, "--samples-per-pixel", SAMPLES, "--quiet", "--out", folder / "truths")
        ratio, noise = compare(theirs, read_colors(folder / "truths" / scene / "truth_centred.exr"))
        rows.append([scene, ratio, noise])
        print(f"{scene} {ratio:.5f} {noise:.3f}", flush=True)
    finish(renderer, rows, left_out)


def finish(renderer, rows, left_out):
    """Checks the means, and writes the page or compares with it."""
    page = TOP / f"results/studies/{renderer.page}.md"
    far = [f"{scene}: {ratio:.5f} of our mean" for scene, ratio, _ in rows if abs(ratio - 1) > BOUND]
    table = "\n".join(f"| {scene} | {ratio:.5f} | {noise:.3f} |" for scene, ratio, noise in rows)
    if not os.environ.get("CHECK"):
        missing = "\n\n" + textwrap.fill(f"Left out: {', '.join(left_out)}.", 140) if left_out else ""
        page.write_text(f"""# Our truth beside {renderer.name}

{renderer.name} {renderer.version()} renders {len(rows)} of our scenes with its own motion blur, from the exported glTF. Made by `make oracles` on
{date.today()}, at {SIZE} with {SAMPLES} samples per pixel and a centred shutter.

| scene | mean, of ours | difference, of the noise |
|---|---|---|
{table}

The last column is the rms difference over what the noise of both pictures explains: 1 is agreement.

{renderer.note}{missing}
""")
    else:
        written = dict(re.findall(r"^\| (\w+) \| ([0-9.]+) \|", page.read_text(), re.M))
        measured = {scene: ratio for scene, ratio, _ in rows}
        if written.keys() != measured.keys():
            far.append(f"the page has {sorted(written)}, measured {sorted(measured)}")
        far += [f"{scene}: the page says {written[scene]}, measured {measured[scene]:.5f}" for scene in written.keys() & measured.keys() if abs(float(written[scene]) - measured[scene]) > TOLERANCE]
    if far:
        sys.exit("\n".join(far))


if __name__ == "__main__":
    main()
