"""Lets an engine draw our scenes, audits and measures what it drew, and writes results/engines/NAME.md: `make engines`.

With CHECK set in the environment it compares the measured numbers with that page instead.

    python3 engines/measure.py bevy target/engines/bevy -- PROGRAM {scene} {capture} {width} {height}

The command after `--` draws one scene: {scene} is the folder of the exported scene, {capture} the folder to write. Its
`blurred.exr` is the engine's own blur over half a frame; beside it, `blurred_default.exr` is the blur with its defaults, if it differs.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
from datetime import date

import numpy as np

from pictures import read_color, read_png, sheet, write_png
from program import audit, shuttertruth

SCENES = ["sliding_panel", "fan", "railing", "crossing", "walker", "flag", "dolly", "roll"]
# Ports of each engine's own blur.
PORTS = {
    "bevy": ["bevy:default", "bevy:msaa"],
    "threejs": ["three:default", "three:corrected"],
    "three_rs": ["three:default", "three:corrected"],
    "babylon": ["babylon:default"],
    "vector_blur": ["blender:compositor"],
    "eevee": ["blender:eevee", "blender:eevee_mean"],
    "eevee_one_sample": ["blender:eevee"],
    "godot": ["godot_blur:default"],
}
ROOT = pathlib.Path(__file__).resolve().parent.parent
# Where ports lie that are no built-in filters.
FOLDERS = {"godot_blur:default": ROOT / "examples/first_blur/godot"}
# Engines that run the port's own shader, so that both draw the same numbers.
SAME_SHADER = {"godot"}
# The target that measures an engine, if not `make engines`.
TARGETS = {"godot": "godot"}
# Where the program that draws lies, if not in a folder of the engine's name.
PROGRAMS = {name: "examples/blender" for name in ("vector_blur", "eevee", "eevee_one_sample")}
SIZE, SUBFRAMES = (160, 90), 32
SHOWN = "fan"
# The scene that smears are measured on, in a picture in which they are many pixels long.
MEASURED, LARGE = "sliding_panel", (640, 360)
# The heading of what people wrote of an engine.
NOTES = "\n## What it shows\n"
# How far a number may be from the page's, and a smear, in degrees.
TOLERANCE, DEGREES = 0.003, 4
SMEARS = r"has (\d+) degrees with its defaults and (\d+) set"
RESULTS = ROOT / "results/engines"


def size_of(scene):
    return LARGE if scene.partition("@")[0] == MEASURED else SIZE


def draw(folder, command, scene):
    """Exports a scene, draws and audits it; returns the folder of the capture, and what the audit says."""
    exported, capture = folder / "gltf" / scene, folder / "captures" / scene.partition("@")[0]
    shuttertruth("engine", "export", scene, "--gltf", exported.parent, "--subframes", SUBFRAMES)
    shutil.rmtree(capture, ignore_errors=True)
    width, height = size_of(scene)
    known = {"scene": exported, "capture": capture, "width": width, "height": height}
    subprocess.run([word.format(**known) for word in command], check=True)
    verdict, findings = audit(capture, "--out", folder / "audit", allowed=(0, 1, 2))
    return capture, f"{verdict}: {'; '.join(findings)}" if findings else verdict


def score(engine, folder, scene, capture):
    """Scores what the engine blurred, ports of its blur on its frame, and no blur.

    Returns FLIP by preset, `own` and `identity`, and the smear of `own` in degrees of the frame; None if more than a thing moves.
    """
    ingested, out = folder / "ingested" / capture.name, folder / "runs" / scene
    shuttertruth("engine", "ingest", capture, "--out", ingested)
    filters = ",".join(str(FOLDERS.get(port, port)) for port in PORTS[engine])
    shuttertruth("run", ingested, "--filter", filters, "--as-written", "--quiet", "--out", out)
    if engine in SAME_SHADER:
        expect_equal(capture / "blurred.exr", *out.glob(f"*/{PORTS[engine][0].replace(':', '_')}/output.exr"))
    run = json.loads((out / "run.json").read_text())
    flip, smear = {}, None
    for case in run["cases"]:
        name = f"{case['filter']}:{case['preset']}" if case["preset"] else case["filter"]
        # The engine's own picture comes after those that are made from the truth, which show no smear.
        is_own = name not in (*PORTS[engine], "identity")
        flip["own" if is_own else name] = case["scores"]["moving"]["flip"]["value"]
        if is_own and case.get("smear"):
            smear = 360 * case["exposure"] * (case["smear"]["close"] - case["smear"]["open"])
    return flip, smear


def expect_equal(theirs, ours):
    apart = np.abs(read_color(theirs) - read_color(ours)).max()
    if apart > 0:
        sys.exit(f"{theirs} and {ours} come from one shader, but differ by up to {apart:.2e}")


def score_default(engine, folder, scene, capture):
    """Scores likewise with the engine's blur as its defaults make it; None if that is the blur over half a frame."""
    if not (capture / "blurred_default.exr").exists():
        return None
    other = folder / "captures_default" / capture.name
    shutil.rmtree(other, ignore_errors=True)
    shutil.copytree(capture, other)
    (other / "blurred_default.exr").replace(other / "blurred.exr")
    return score(engine, folder / "default", scene, other)


def described(capture, key):
    return re.search(rf'^{key} = "(.*)"', (capture / "capture.toml").read_text(), re.M)[1]


def compare_subframes(folder, scene, capture):
    """Returns how bright the engine's sub-frames are beside our truth, and the median difference of a pixel."""
    size = "x".join(map(str, size_of(scene)))
    alignment = described(capture, "alignment")
    shuttertruth("truths", "render", scene, "--size", size, "--samples-per-pixel", 256, "--alignments", alignment, "--quiet", "--out", folder / "truths")
    theirs = np.mean([read_color(path) for path in sorted((capture / "subframes").glob("*.exr"))], axis=0)
    ours = read_color(folder / "truths" / scene / f"truth_{alignment}.exr")
    return theirs.mean() / ours.mean(), float(np.median(np.abs(theirs - ours)))


def measure(engine, folder, command):
    """Measures all scenes.

    Returns the engine's version, rows of the table, the first of them its head, and the smears of its own blur in degrees: with its
    defaults, and set to half a frame.
    """
    ports, version, smears = PORTS[engine], None, None
    head = ["scene", "own blur", "own, half a frame", *(f"`{port}`" for port in ports), "no blur", "ratio", "median"]
    rows = [[*head, "audit of velocity, depth and colour"]]
    for name in SCENES:
        scene = f"{name}@unlit"
        capture, verdict = draw(folder, command, scene)
        version = described(capture, "engine")
        flip, smear = score(engine, folder, scene, capture)
        default, default_smear = score_default(engine, folder, scene, capture) or (flip, smear)
        if name == MEASURED:
            smears = [default_smear, smear]
        ratio, median = compare_subframes(folder, scene, capture)
        scores = [default["own"], *(flip[name] for name in ("own", *ports, "identity"))]
        rows.append([name, *(f"{score:.3f}" for score in scores), f"{ratio:.4f}", f"{median:.4f}", verdict])
        print(" | ".join(rows[-1]), flush=True)
    return version, rows, smears


def show(folder):
    """Shows a scene's frame, the mean of its sub-frames, the engine's own blur, and our truth."""
    capture = folder / "captures" / SHOWN
    subframes = np.mean([read_color(path) for path in sorted((capture / "subframes").glob("*.exr"))], axis=0)
    truth = read_color(*(folder / "truths" / f"{SHOWN}@unlit").glob("truth_*.exr"))
    return sheet([read_color(capture / "color.exr"), subframes, read_color(capture / "blurred.exr"), truth])


def write_page(engine, version, rows, smears, picture):
    page = RESULTS / f"{engine}.md"
    # What people wrote below stays.
    written = page.read_text() if page.exists() else ""
    notes = written[written.index(NOTES) :] if NOTES in written else ""
    program = PROGRAMS.get(engine, f"engines/{engine}")
    table = "\n".join(f"| {' | '.join(row)} |" for row in [rows[0], ["---"] * len(rows[0]), *rows[1:]])
    RESULTS.mkdir(parents=True, exist_ok=True)
    write_png(RESULTS / f"{engine}.png", picture)
    page.write_text(f"""# {version.partition(" (")[0]}, drawn by the engine itself

Made by `make {TARGETS.get(engine, "engines")}` on {date.today()}, at {SIZE[0]}x{SIZE[1]}, `{MEASURED}` at {LARGE[0]}x{LARGE[1]}, from scenes without light.
[{program}](../../{program}) draws them.

{table}

The first columns are FLIP where anything moves, against the mean of {SUBFRAMES} sub-frames that the engine drew over half a frame; lower
is better. Own blur is the engine's, with its defaults, then set to half a frame; the ports of it run on the engine's frame. Ratio and
median compare those sub-frames with our truth of the scene: mean radiance over ours, and the median difference of a pixel.

On `{MEASURED}`, the even smear that fits its own blur on the mover best has {smears[0]:.0f} degrees with its defaults and {smears[1]:.0f} set to
half a frame, which is 180 degrees. [The results](../README.md) have the lengths of edges, at 1920x1080.

![{SHOWN}: the frame, the mean of the sub-frames, its own blur, and our truth]({engine}.png)

*From `{SHOWN}`, all but the last drawn by the engine: the frame, the mean of its sub-frames, its own blur over half a frame; our truth.*
{notes}""")


def differences(engine, rows, smears, picture):
    """Lists what is not as on the page: numbers that are TOLERANCE apart, verdicts by their first word, the picture by its mean."""
    text = (RESULTS / f"{engine}.md").read_text()
    page = text.splitlines()
    written = [[cell.strip() for cell in line.strip("|").split("|")] for line in page if line.startswith("|")]
    if [row[0] for row in written] != ["scene", "---", *SCENES]:
        return [f"the page has rows for {[row[0] for row in written[2:]]}, not for {SCENES}"]
    found = []
    for old, new in zip(written[2:], rows[1:]):
        far = [abs(float(a) - float(b)) > TOLERANCE for a, b in zip(old[1:-1], new[1:-1], strict=True)]
        if any(far) or old[-1].split(":")[0] != new[-1].split(":")[0]:
            found.append(f"{old[0]}: the page says {old[1:]}, measured {new[1:]}")
    degrees = [float(number) for number in re.search(SMEARS, text).groups()]
    if any(smear is None or abs(smear - known) > DEGREES for smear, known in zip(smears, degrees)):
        found.append(f"the page says smears of {degrees} degrees, measured {smears}")
    apart = np.abs(read_png(RESULTS / f"{engine}.png").astype(float) - picture).mean()
    if apart > 1:
        found.append(f"the picture is {apart:.1f} of 255 off in the mean")
    return found


def main():
    engine, folder, _, *command = sys.argv[1:]
    version, rows, smears = measure(engine, pathlib.Path(folder), command)
    picture = show(pathlib.Path(folder))
    if not os.environ.get("CHECK"):
        write_page(engine, version, rows, smears, picture)
    elif found := differences(engine, rows, smears, picture):
        sys.exit(f"results/engines/{engine}.md: " + "\n".join(found))


if __name__ == "__main__":
    main()
