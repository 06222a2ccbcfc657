"""Measures how merge, check and report grow: makes a large run of copies of a small one, and times the commands on it.

    shuttertruth check sliding_panel --filter mcguire:paper --size 160x90 --samples-per-pixel 64 --out out/small
    python3 examples/growth.py out/small --scenes 100 --filters 94 --out out/growth

The small run has one scene and one filter. Every copy of the scene has its references and `--filters` copies of the filter, each a
part of its own, as examples/snakemake makes them. Scores differ between copies by up to 20 %. Pictures of
copies are second names of the same files (hard links). Prints the time, the processor's time and the peak memory of each command.
"""

import argparse
import json
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import time
from pathlib import Path

# Of the changes of the scores.
SEED = 1


def main():
    arguments = parse_arguments()
    out = arguments.out
    if out.exists():
        sys.exit(f"{out}: is there already; remove it, or name another folder with --out")
    run = json.loads((arguments.run / "run.json").read_text())
    scene, target = find_names(run, arguments.run)
    scenes = [f"{scene}_{index:04}" for index in range(arguments.scenes)]
    filters = [f"{target['filter']}_{index:04}" for index in range(arguments.filters)]

    parts = write_parts(arguments.run, run, scenes, filters, out / "parts")
    write_scenes(arguments.scenes_dir, scene, target, scenes, filters, out / "scenes")
    merged = out / "merged"
    count = len(scenes) * (len(run["cases"]) - 1 + len(filters))
    print(f"{count} cases in {len(parts)} parts, {len(scenes)} scenes")

    measure("merge", [arguments.program, "truths", "merge", *parts, "--out", merged], [0])
    size = (merged / "run.json").stat().st_size
    print(f"run.json: {size / 1e6:.1f} MB, {size / count / 1e3:.1f} kB a case")
    # Changes of up to 20 % break some limits.
    measure("check", [arguments.program, "check", "--run", merged, "--scenes-dir", out / "scenes"], [0, 1])
    measure("report", [arguments.program, "report", merged], [0])
    page = (merged / "report.html").stat().st_size
    beside = sum(file.stat().st_size for file in merged.glob("report_files/*"))
    print(f"report.html: {page / 1e6:.1f} MB, and {beside / 1e6:.1f} MB beside it")


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("run", type=Path, help="folder of the small run")
    parser.add_argument("--scenes", type=int, default=10, help="copies of its scene")
    parser.add_argument("--filters", type=int, default=4, help="copies of its filter")
    parser.add_argument("--out", type=Path, required=True, help="new folder, on the disk of the small run")
    parser.add_argument("--program", default="shuttertruth", help="the program to measure")
    parser.add_argument("--scenes-dir", type=Path, default=Path("scenes"), help="folder of the small run's scene")
    arguments = parser.parse_args()
    if min(arguments.scenes, arguments.filters) < 1:
        parser.error("--scenes and --filters are at least 1")
    return arguments


def find_names(run, folder):
    """Returns the small run's scene, and its filter's case."""
    scenes = {case["scene"] for case in run["cases"]}
    targets = [case for case in run["cases"] if not case["bar"]]
    if len(scenes) != 1 or len(targets) != 1:
        sys.exit(
            f"{folder}: has {len(scenes)} scenes and {len(targets)} cases of filters; "
            "name a run of one scene and one preset of one filter"
        )
    return scenes.pop(), targets[0]


def write_parts(source, run, scenes, filters, out):
    """Writes a part with the references of each scene, and one per scene and filter; returns their folders."""
    numbers = random.Random(SEED)
    references = [case for case in run["cases"] if case["bar"]]
    target = next(case for case in run["cases"] if not case["bar"])
    parts = []

    def write(name, cases, new_scene, new_filter=None):
        part = out / name
        copies = [copy_case(case, new_scene, new_filter, numbers) for case in cases]
        place_files(source, part, cases, copies)
        part_run = {**run, "cases": copies, "overall": []}
        (part / "run.json").write_text(json.dumps(part_run))
        parts.append(part)

    for scene in scenes:
        write(f"{scene}_references", references, scene)
        for name in filters:
            write(f"{scene}_{name}", [target], scene, name)
    return parts


def copy_case(case, scene, name, numbers):
    """Returns a case under another name, with scores changed by up to 20 %."""
    folder = Path(case["folder"]).name
    if name is not None:
        folder = folder.replace(case["filter"], name, 1)
    factor = numbers.uniform(0.8, 1.2)
    text = json.dumps({key: case[key] for key in ("scores", "intervals", "common") if key in case})
    scores = json.loads(text, parse_float=lambda number: float(number) * factor)
    return {**case, **scores, "scene": scene, "filter": name or case["filter"], "folder": f"{scene}/{folder}"}


def place_files(source, part, cases, copies):
    """Gives the pictures of cases, and the files of their scene, second names below a part."""
    pairs = [(case["folder"], copy["folder"]) for case, copy in zip(cases, copies)]
    pairs.append((cases[0]["scene"], copies[0]["scene"]))
    for old, new in pairs:
        (part / new).mkdir(parents=True, exist_ok=True)
        for file in (source / old).iterdir():
            if file.is_file() and file.name != "case.json":
                os.link(file, part / new / file.name)


def write_scenes(root, scene, target, scenes, filters, out):
    """Copies the scene under its new names, with the limits of the small run's filter for each copy of the filter."""
    preset = f"{target['filter']}:{target['preset']}" if target["preset"] else target["filter"]
    limits = (root / scene / "bounds.toml").read_text()
    table = re.search(rf'^\[filter\."{re.escape(preset)}"\]\n(?:(?!\[).*\n?)*', limits, re.MULTILINE)
    if table is None:
        sys.exit(f"{root / scene / 'bounds.toml'}: has no limits of {preset}; name a run of a filter that has some")
    copied = "\n".join(table[0].replace(target["filter"], name, 1) for name in filters)
    out.mkdir(parents=True)
    shutil.copy(root / "bounds.toml", out)
    for name in scenes:
        shutil.copytree(root / scene, out / name)
        (out / name / "bounds.toml").write_text(copied)


def measure(name, command, allowed):
    """Runs a command and prints its cost; ends if its exit code is not allowed."""
    start = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    errors = process.stderr.read()
    _, status, used = os.wait4(process.pid, 0)
    seconds = time.monotonic() - start
    # A new process's count includes its parent's memory.
    parent = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    note = "" if used.ru_maxrss > parent else " at most"
    code = os.waitstatus_to_exitcode(status)
    if code not in allowed:
        sys.exit(f"{name} ended with {code}:\n{errors}")
    print(
        f"{name}: {seconds:.1f} s, {used.ru_utime + used.ru_stime:.1f} s of processor time, "
        f"{used.ru_maxrss / 1024:.0f} MiB{note}"
    )


if __name__ == "__main__":
    main()
