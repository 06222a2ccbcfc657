"""Compares presets with transcriptions of the programs that they follow, on frames of three scenes.

    python3 examples/fidelity/compare.py --program target/release/shuttertruth --scenes-dir scenes --out out/fidelity

It renders the frames, blurs them with every preset that names a source, calls the transcription in `originals/`, and prints one row
per preset as Markdown. It ends with 1 where a preset is farther from its original than `fidelity.toml` allows. README.md has more.
"""

import argparse
import importlib.util
import inspect
import json
import subprocess
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import OpenEXR

HERE = Path(__file__).resolve().parent
SCENES = ["fan", "railing", "two_spheres"]
# Differences that count, in scene-linear radiance.
SMALL, LARGE = 1e-3, 0.02


def main():
    parser = options(__doc__)
    parser.add_argument("--scenes", default=",".join(SCENES), metavar="SCENES", help="scenes to compare on [default: %(default)s]")
    arguments = parser.parse_args()
    scenes = arguments.scenes.split(",")
    listing = json.loads(shuttertruth(arguments, ["list", "--json", "--scenes-dir", arguments.scenes_dir]))
    settings = tomllib.loads((HERE / "fidelity.toml").read_text())
    originals, as_listed = transcriptions()
    known, missing = presets(listing, originals)
    check(settings, known, missing, originals)
    for name in arguments.only:
        if name not in known:
            sys.exit(f"--only {name}: has no transcription; allowed: {', '.join(known)}")
    compare = arguments.only or list(known)
    frames = render(arguments, scenes)
    with ThreadPoolExecutor(2) as pool:
        blurred = pool.map(lambda case: blur(arguments, *case), [(name, scene) for name in compare for scene in scenes])
    rows, failures = [], []
    for name in compare:
        source, parameters = known[name]
        pictures = [next(blurred) for _ in scenes]
        difference = compared(originals[name], frames, pictures, parameters)
        listed = compared(as_listed[name], frames, pictures, parameters) if name in as_listed else None
        verdict = judged(settings["default"] | settings["preset"].get(name, {}), difference, listed)
        rows.append([f"`{name}`", source, *difference.cells(), listed.cells()[0] if listed else "", verdict])
        failures += [name] if verdict != "kept" else []
    print(table(["preset", "original", "largest", "> 0.001", "> 0.02", "largest as listed", "limit"], rows))
    print(f"\n{', '.join(scenes)} at {arguments.size}: {frames[0].depth.size * len(scenes)} pixels.")
    if not arguments.only:
        print()
        print(table(["preset without a transcription", "why"], [[f"`{name}`", why] for name, why in missing.items()]))
    if failures:
        sys.exit(f"farther from the original than fidelity.toml allows: {', '.join(failures)}")


def options(text):
    parser = argparse.ArgumentParser(description=text.splitlines()[0])
    parser.add_argument("--program", default="shuttertruth", help="the program [default: the one on the PATH]")
    parser.add_argument("--scenes-dir", default="scenes", help="folder that holds the scenes")
    parser.add_argument("--out", type=Path, required=True, help="folder for frames and pictures")
    parser.add_argument("--size", default="160x90", help="picture size in pixels")
    parser.add_argument("--only", action="append", default=[], metavar="FILTER:PRESET", help="compare this one; may be repeated")
    parser.add_argument("--set", action="append", default=[], metavar="FILTER.PARAMETER=VALUE", help="of the filter, or of FILTER:PRESET alone: see it differ")
    return parser


def shuttertruth(arguments, words):
    done = subprocess.run([arguments.program, *words], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{arguments.program} {' '.join(words)} ended with {done.returncode}: {done.stderr}")
    return done.stdout


def transcriptions():
    """Returns ORIGINALS and AS_LISTED of all modules of originals/."""
    originals, as_listed = {}, {}
    for path in sorted((HERE / "originals").glob("*.py")):
        spec = importlib.util.spec_from_file_location(path.stem, path)
        module = importlib.util.module_from_spec(spec)
        sys.modules[path.stem] = module
        spec.loader.exec_module(module)
        originals |= module.ORIGINALS
        as_listed |= getattr(module, "AS_LISTED", {})
    return originals, as_listed


def presets(listing, originals):
    """Returns the presets with a transcription, their source and every value; and the others, with the reason."""
    known, missing = {}, {}
    for filter in listing["filters"]:
        defaults = {parameter["name"]: parameter["default"] for parameter in filter["parameters"]}
        for preset in filter["presets"]:
            name = f"{filter['name']}:{preset['name']}"
            source = preset["source"]
            if name in originals:
                known[name] = (place(source or {}), defaults | preset["values"])
            elif source is None:
                missing[name] = "a setting of this project, nobody else's"
            elif source.get("repository") is None:
                missing[name] = f"published without source code: {source['publication']}"
            else:
                missing[name] = f"nobody has transcribed {place(source)}"
    return known, missing


def place(source):
    if source.get("repository") is None:
        return source.get("publication") or "names no source"
    return f"{source['repository'].removeprefix('https://')} at {source['commit'][:7]}"


def check(settings, known, missing, originals):
    """Refuses words without a meaning."""
    for name in originals:
        if name not in known:
            sys.exit(f"originals/ transcribe {name}, which is no preset; presets: {', '.join([*known, *missing])}")
    for name in settings["preset"]:
        if name not in known:
            sys.exit(f"fidelity.toml: {name} has no transcription; allowed: {', '.join(known)}")


class Frame:
    """The inputs of filters from one scene."""

    def __init__(self, path):
        with OpenEXR.File(str(path), separate_channels=True) as file:
            plane = {name: channel.pixels.astype(np.float32) for name, channel in file.channels().items()}
            self.exposure = float(text(file.header()["exposure"]))
        self.color = np.stack([plane["R"], plane["G"], plane["B"]], -1)
        self.velocity, self.velocity_next = (
            np.stack([plane[f"{name}.X"], plane[f"{name}.Y"]], -1) for name in ("velocity", "velocity_next"))
        self.depth = plane["Z"]


def text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def render(arguments, scenes=SCENES):
    shuttertruth(arguments, [
        "truths", "render", "--quiet", *scenes, "--scenes-dir", arguments.scenes_dir, "--size", arguments.size,
        "--samples-per-pixel", "8", "--replicates", "2", "--further-velocities", "--out", str(arguments.out)])
    return [Frame(arguments.out / scene / "frame.exr") for scene in scenes]


def blur(arguments, name, scene):
    filter = name.split(":")[0]
    changes = [value.split(".", 1) for value in arguments.set]
    return blur_with(arguments, name, scene, [f"{filter}.{change}" for whose, change in changes if whose in (name, filter)])


def blur_with(arguments, name, scene, values):
    out = arguments.out / scene / f"{Path(name).name.replace(':', '_')}.exr"
    words = ["engine", "blur", "--as-written", "--filter", name, "--frame", str(arguments.out / scene / "frame.exr"), "--out", str(out)]
    for value in values:
        words += ["--set", value]
    shuttertruth(arguments, words)
    with OpenEXR.File(str(out), separate_channels=True) as file:
        return np.stack([file.channels()[channel].pixels for channel in "RGB"], -1)


class Difference:
    """Returns the pictures' difference in the largest channel of every pixel."""

    def __init__(self, pairs):
        distances = np.concatenate([np.abs(ours - theirs).max(-1).ravel() for ours, theirs in pairs])
        self.largest = float(distances.max()) if np.isfinite(distances).all() else float("inf")
        self.mean = float(distances.mean())
        self.small, self.large = int((~(distances <= SMALL)).sum()), int((~(distances <= LARGE)).sum())

    def cells(self):
        return [f"{self.largest:.0e}", str(self.small), str(self.large)]


def compared(original, frames, pictures, parameters):
    has_next = "velocity_next" in inspect.signature(original).parameters

    def blur(frame):
        further = {"velocity_next": frame.velocity_next} if has_next else {}
        return original(frame.color, frame.velocity, frame.depth, frame.exposure, 0, parameters, **further)

    return Difference(zip(pictures, map(blur, frames)))


def judged(limits, difference, listed):
    """Returns whether there are no more differences than allowed."""
    few = difference.small <= limits["small"] and difference.large <= limits["large"]
    near = listed is None or listed.small <= limits["small_as_listed"]
    return "kept" if few and near else "BROKEN"


def table(head, rows):
    """Formats a table as Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)


if __name__ == "__main__":
    main()
