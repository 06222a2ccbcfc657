"""Compares the processor time of our truths with that of Cycles at equal noise: `make price`.

    python3 engines/price.py target/tmp/price target/engines/price -- PYTHON_WITH_BPY -W ignore examples/blender/blender.py --

The first folder has the scenes; `cargo bench -p shuttertruth-tracer -- truths` writes it. Prints a row per scene: the ratio of both
means, seconds and noise of both, and our price in parts of that of Cycles. A price is time times the square of noise, which does not
change with the number of samples if noise falls with their root. Of two times the shorter one counts, since other work only adds.
"""

import pathlib
import resource
import shutil
import sys

import numpy as np

from oracles import Cycles
from pictures import read_colors
from program import shuttertruth

SIZE, SAMPLES = "320x180", 512
# The fewest samples of Cycles, whose time is that of starting.
FEWEST = 4


def processor_time(work):
    """Returns the processor seconds of the programs that some work starts, and its result."""
    used = lambda: sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
    before = used()
    result = work()
    return used() - before, result


def measure_cycles(cycles, exported, out):
    """Returns seconds of rendering, without those of starting and of building trees, the noise, and the mean radiance."""
    start, _ = processor_time(lambda: cycles.render(exported, out / "start", SIZE, FEWEST, seed=1))
    renders = [processor_time(lambda: cycles.render(exported, out / str(seed), SIZE, SAMPLES, seed)) for seed in (1, 2)]
    seconds, (first, second) = zip(*renders)
    return min(seconds) - start, np.sqrt(((first - second) ** 2).mean() / 2), np.mean([first, second])


def measure_ours(scene, folder, out):
    """Returns seconds of the truth alone, with those of starting, the noise of the mean of both halves, and the mean radiance."""
    words = ["truths", "render", scene, "--scenes-dir", folder, "--alignments", "centred", "--size", SIZE, "--samples-per-pixel", SAMPLES]
    render = lambda: shuttertruth(*words, "--quiet", "--out", out)
    shutil.rmtree(out / scene, ignore_errors=True)
    render()
    seconds = []
    for _ in range(2):
        # The frame stays, so that only the truth is rendered.
        shutil.rmtree(out / scene / "truth_centred")
        (out / scene / "truth_centred.exr").unlink()
        seconds.append(processor_time(render)[0])
    first, second = read_colors(out / scene / "truth_centred.exr")
    return min(seconds), np.sqrt(((first - second) ** 2).mean()) / 2, np.mean([first, second])


def main():
    scenes, out, _, *command = sys.argv[1:]
    scenes, out = pathlib.Path(scenes), pathlib.Path(out)
    print("| scene | mean, of Cycles' | ours, s | noise | Cycles, s | noise | price, of Cycles' |\n|---|---|---|---|---|---|---|")
    for scene in sorted(path.parent.name for path in scenes.glob("*/scene.toml")):
        shuttertruth("engine", "export", scene, "--scenes-dir", scenes, "--gltf", out / "gltf")
        seconds, noise, mean = measure_ours(scene, scenes, out / "truths")
        theirs, their_noise, their_mean = measure_cycles(Cycles(command), out / "gltf" / scene, out / "cycles" / scene)
        price = seconds * noise**2 / (theirs * their_noise**2)
        print(f"| {scene} | {mean / their_mean:.4f} | {seconds:.1f} | {noise:.5f} | {theirs:.1f} | {their_noise:.5f} | {price:.2f} |", flush=True)


if __name__ == "__main__":
    main()
