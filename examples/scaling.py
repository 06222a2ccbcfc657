"""Measures how the time and memory of run, check and report grow with scenes, presets, triangles and pixels.

    cargo build --release --bin shuttertruth
    python3 examples/scaling.py --program target/release/shuttertruth --out out/scaling

Prints a table, and writes a chart to `scaling.svg` in the folder. Scenes are copies of `fan`, presets are copies of `mcguire:paper`,
triangles are those of a moving sheet, and pixels are those of `fan`. Ends with an error if anything grows faster than its work.
"""

import argparse
import os
import shutil
import subprocess
import sys
from math import log2
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RUN = "run --quiet --jitter-frames 0 --samples-per-pixel"
SMALL = ["--size", "160x90"]
# Growth that counts as that of the work, since times scatter.
TOLERANCE = 1.15
# Shorter times scatter by more.
LEAST_SECONDS = 1
# The chart shows shorter times as this one.
LEAST_DRAWN = 0.1
SCENE = """
size = [160, 90]
exposure = 0.5
family = "translation"
exposes = "Triangles."

[camera]
position = [0, 0, 5]
look_at = [0, 0, 0]
vertical_fov = 40

[background]
constant = [0.5, 0.5, 0.5]

[object.sheet]
mesh = "sheet.obj"
keys = [{ time = -1, translation = [-0.3, 0, 0] }, { time = 1, translation = [0.3, 0, 0] }]
"""


def main():
    arguments = parse_arguments()
    out = arguments.out.resolve()
    if out.exists():
        sys.exit(f"{out}: is there already; remove it, or name another folder with --out")
    axes = {"scenes": scenes, "presets": presets, "triangles": triangles, "pixels": pixels}
    rows = []
    for name in arguments.axes.split(","):
        for work, label, words, cwd in axes[name](out / name):
            costs = [
                measure([arguments.program.resolve(), *words, "--out", "out"], cwd),
                measure([arguments.program.resolve(), "check", "--run", "out", "--scenes-dir", "scenes"], cwd, [0, 1, 2]),
                measure([arguments.program.resolve(), "report", "out"], cwd),
            ]
            rows.append((name, work, label, costs))
            print_row(rows)
            shutil.rmtree(cwd / "out")
    (out / "scaling.svg").write_text(chart(rows))
    if faster := find_faster(rows):
        sys.exit("\n".join(faster))


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=Path, default=Path("target/release/shuttertruth"), help="the program to measure")
    parser.add_argument("--out", type=Path, required=True, help="new folder")
    parser.add_argument("--axes", default="scenes,presets,triangles,pixels", help="what grows, separated by commas")
    return parser.parse_args()


def scenes(out):
    """Yields for each step the work, its name, the words of the command, and the folder that it runs in."""
    for count in (1, 2, 4, 8):
        folder = out / str(count)
        names = [f"fan_{at}" for at in range(count)]
        for name in names:
            copy_scene("fan", folder / "scenes" / name)
        yield count, f"{count}", [*RUN.split(), "64", *SMALL, "--filter", "mcguire:paper", *names, "--scenes-dir", "scenes"], folder


def presets(out):
    for count in (1, 2, 4, 8):
        folder = out / str(count)
        copy_scene("fan", folder / "scenes/fan")
        for at in range(count):
            copy = folder / f"mcguire_{at}"
            shutil.copytree(ROOT / "shaders/mcguire", copy)
            declared = (copy / "filter.toml").read_text()
            (copy / "filter.toml").write_text(declared.replace('name = "mcguire"', f'name = "mcguire_{at}"', 1))
            (copy / "mcguire.wgsl").rename(copy / f"mcguire_{at}.wgsl")
        filters = ",".join(f"./mcguire_{at}:paper" for at in range(count))
        yield count, f"{count}", [*RUN.split(), "64", *SMALL, "--filter", filters, "fan", "--scenes-dir", "scenes"], folder


def triangles(out):
    for millions in (1.25, 2.5, 5, 10):
        folder = out / str(millions)
        scene = folder / "scenes/sheet"
        scene.mkdir(parents=True)
        (scene / "scene.toml").write_text(SCENE)
        write_sheet(scene / "sheet.obj", round((millions * 1e6 / 2) ** 0.5))
        words = [*RUN.split(), "16", *SMALL, "--filter", "mcguire:paper", "sheet", "--scenes-dir", "scenes"]
        yield millions, f"{millions:g} million", words, folder
        shutil.rmtree(scene)


def pixels(out):
    # 3840x2160 needs 34 GiB.
    for width, height in ((480, 270), (960, 540), (1920, 1080)):
        folder = out / f"{width}x{height}"
        copy_scene("fan", folder / "scenes/fan")
        size = f"{width}x{height}"
        yield width * height, size, [*RUN.split(), "8", "--size", size, "--filter", "mcguire:paper", "fan", "--scenes-dir", "scenes"], folder


def copy_scene(name, folder):
    shutil.copytree(ROOT / "scenes" / name, folder)
    shutil.copy(ROOT / "scenes/bounds.toml", folder.parent)


def write_sheet(path, side):
    """Writes a wavy sheet of 2 x side x side triangles."""
    with path.open("w") as file:
        for row in range(side + 1):
            y = 2 * row / side - 1
            file.write("".join(f"v {2 * at / side - 1:.5f} {y:.5f} {(at * 7 + row * 13) % 29 / 1000}\n" for at in range(side + 1)))
        for row in range(side):
            first = row * (side + 1) + 1
            file.write("".join(f"f {at} {at + 1} {at + side + 2} {at + side + 1}\n" for at in range(first, first + side)))


def measure(command, cwd, allowed=(0,)):
    """Runs a command; returns its seconds of processor time, and its peak memory in MiB."""
    process = subprocess.Popen(command, cwd=cwd, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    errors = process.stderr.read()
    _, status, used = os.wait4(process.pid, 0)
    if os.waitstatus_to_exitcode(status) not in allowed:
        sys.exit(f"{' '.join(map(str, command))}, in {cwd}:\n{errors}")
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def print_row(rows):
    if len(rows) == 1:
        print("| grows | to | run | check | report |\n|---|---|---|---|---|")
    name, _, label, costs = rows[-1]
    cells = " | ".join(f"{seconds:.1f} s, {memory:.0f} MiB" for seconds, memory in costs)
    print(f"| {name} | {label} | {cells} |", flush=True)


def find_faster(rows):
    """Lists what grew faster than its work from one step to the next."""
    found = []
    for (name, work, _, costs), (next_name, next_work, label, next_costs) in zip(rows, rows[1:]):
        if name != next_name:
            continue
        for command, old, new in zip(("run", "check", "report"), costs, next_costs):
            for unit, before, after in zip(("seconds", "MiB"), old, new):
                is_large = after > (LEAST_SECONDS if unit == "seconds" else 0)
                if is_large and after / before > TOLERANCE * next_work / work:
                    found.append(f"{command} with {label} {name}: {before:.1f} -> {after:.1f} {unit}, work x {next_work / work:.2g}")
    return found


def chart(rows):
    """Draws the seconds of each command over the work, both relative to the first step, both on logarithmic axes."""
    names = list(dict.fromkeys(row[0] for row in rows))
    colors = {"run": "#0072b2", "check": "#d55e00", "report": "#009e73"}
    side, gap = 220, 60
    parts = []
    for column, name in enumerate(names):
        mine = [row for row in rows if row[0] == name]
        most = max(log2(mine[-1][1] / mine[0][1]), 1)
        left = gap + column * (side + gap)
        place = lambda x, y: f"{left + side * x / most:.1f},{gap + side - side * max(y, 0) / most:.1f}"
        parts.append(f'<rect x="{left}" y="{gap}" width="{side}" height="{side}" fill="none" stroke="#888"/>')
        parts.append(f'<polyline points="{place(0, 0)} {place(most, most)}" stroke="#bbb" stroke-dasharray="4" fill="none"/>')
        parts.append(f'<text x="{left}" y="{gap - 10}">{name}: {mine[0][2]} to {mine[-1][2]}</text>')
        for at, (command, color) in enumerate(colors.items()):
            seconds = [max(row[3][at][0], LEAST_DRAWN) for row in mine]
            points = [(log2(row[1] / mine[0][1]), log2(time / seconds[0])) for row, time in zip(mine, seconds)]
            parts.append(f'<polyline points="{" ".join(place(*point) for point in points)}" stroke="{color}" fill="none" stroke-width="2"/>')
    legend = "".join(
        f'<text x="{gap + 90 * at}" y="{2 * gap + side - 20}" fill="{color}">{command}</text>' for at, (command, color) in enumerate(colors.items())
    )
    width, height = gap + len(names) * (side + gap), 2 * gap + side
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="13">'
        f'<rect width="{width}" height="{height}" fill="white"/>{"".join(parts)}{legend}</svg>\n'
    )


if __name__ == "__main__":
    main()
