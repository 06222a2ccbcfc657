"""Lets an engine draw our scenes, audits and measures what it drew, and writes results/engines/NAME.md: `make engines`.

    python3 engines/measure.py bevy target/engines/bevy -- PROGRAM AND ITS ARGUMENTS

PROGRAM gets the folder of an exported scene, the folder of the capture to write, and the picture's width and height.
"""

import json
import pathlib
import re
import subprocess
import sys
from datetime import date

import numpy as np
import OpenEXR

SCENES = ["sliding_panel", "fan", "railing", "crossing", "walker", "flag", "dolly", "roll"]
# Ports of each engine's own blur.
PORTS = {"bevy": ["bevy:default", "bevy:msaa"]}
SIZE, SUBFRAMES = (160, 90), 32
RESULTS = pathlib.Path(__file__).resolve().parent.parent / "results/engines"


def shuttertruth(*words, allowed=(0,)):
    """Runs the program; returns what it printed."""
    done = subprocess.run(["shuttertruth", *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode not in allowed:
        sys.exit(f"shuttertruth {' '.join(map(str, words))}: {done.stdout}")
    return done.stdout


def read_color(path):
    with OpenEXR.File(str(path), separate_channels=True) as file:
        channels = file.parts[0].channels
        names = [f"{half}{part}" for half in ("A.", "B.") for part in "RGB"] if "A.R" in channels else list("RGB")
        planes = np.stack([channels[name].pixels for name in names], axis=-1).astype(float)
        return planes.reshape(*planes.shape[:2], -1, 3).mean(axis=2)


def draw(folder, command, scene):
    """Exports a scene, draws and audits it; returns the folder of the capture, and what the audit says."""
    exported, capture = folder / "gltf" / scene, folder / "captures" / scene.partition("@")[0]
    shuttertruth("engine", "export", scene, "--gltf", exported.parent, "--subframes", SUBFRAMES)
    subprocess.run([*command, exported, capture, *map(str, SIZE)], check=True)
    said = shuttertruth("engine", "audit", capture, "--out", folder / "audit", allowed=(0, 1, 2))
    findings = [" ".join(text.split()) for text in re.findall(r"^  - (.*?)(?=^  - |^[A-Z])", said, re.M | re.S)]
    verdict = re.search(r"^(PASS|FAIL|UNDECIDED)", said, re.M)[1]
    return capture, verdict if verdict == "PASS" else f"{verdict}: {'; '.join(findings)}"


def measure(engine, folder, scene, capture):
    """Scores the engine's blur and our port of it on the engine's frame; returns FLIP by filter, and how far sub-frames are from ours."""
    size = "x".join(map(str, SIZE))
    ingested = folder / "ingested" / capture.name
    shuttertruth("engine", "ingest", capture, "--out", ingested)
    shuttertruth("run", ingested, "--filter", ",".join(PORTS[engine]), "--quiet", "--out", folder / "runs" / scene)
    run = json.loads((folder / "runs" / scene / "run.json").read_text())
    flip = {f"{case['filter']}:{case['preset']}": case["scores"]["moving"]["flip"]["value"] for case in run["cases"]}
    shuttertruth("truths", "render", scene, "--size", size, "--samples-per-pixel", 256, "--alignments", "centred", "--quiet", "--out", folder / "truths")
    theirs = np.mean([read_color(path) for path in sorted((capture / "subframes").glob("*.exr"))], axis=0)
    ours = read_color(folder / "truths" / scene / "truth_centred.exr")
    return flip, theirs.mean() / ours.mean(), float(np.median(np.abs(theirs - ours)))


def main():
    engine, folder, _, *command = sys.argv[1:]
    folder = pathlib.Path(folder)
    ports = PORTS[engine]
    rows, version = [], None
    for name in SCENES:
        scene = f"{name}@unlit"
        capture, verdict = draw(folder, command, scene)
        version = re.search(r'^engine = "(.*)"', (capture / "capture.toml").read_text(), re.M)[1]
        flip, ratio, median = measure(engine, folder, scene, capture)
        own = re.sub(r" ", "_", version) + ":"
        scores = [flip[name] for name in (own, *ports, "identity:")]
        rows.append([name, *(f"{score:.3f}" for score in scores), f"{ratio:.4f}", f"{median:.4f}", verdict])
        print(" | ".join(rows[-1]), flush=True)
    head = ["scene", "own blur", *(f"`{port}`" for port in ports), "no blur", "ratio", "median", "audit of velocity, depth and colour"]
    table = "\n".join(f"| {' | '.join(row)} |" for row in [head, ["---"] * len(head), *rows])
    RESULTS.mkdir(parents=True, exist_ok=True)
    (RESULTS / f"{engine}.md").write_text(f"""# {version}, drawn by the engine itself

Made by `make engines` on {date.today()}, at {SIZE[0]}x{SIZE[1]}, from scenes without light. `engines/{engine}` draws them.

{table}

The first columns are FLIP where anything moves, against the mean of {SUBFRAMES} sub-frames that the engine drew; lower is better. Own blur is the
engine's, with its defaults; the others run on the engine's frame. Ratio and median compare those sub-frames with our truth of the scene:
mean radiance over ours, and the median difference of a pixel.
""")


if __name__ == "__main__":
    main()
