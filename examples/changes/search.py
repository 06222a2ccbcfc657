"""Searches the smallest change of a preset that lowers its error: one parameter first, then two.

    python3 examples/changes/search.py --filter shaders/godot --preset addon --out out/changes > results/changes/godot_addon.md

It scores the preset and every change of one parameter with `shuttertruth tune evaluate`, and prints the gain in mean FLIP with its 95 %
CI over the scenes. The best change whose CI excludes 0 counts. Then it tries the best changes two at a time; the best pair
counts if the CI of its gain over that change excludes 0. What was found is measured again on sealed variants of the scenes, which took
no part in the choice. README.md has more.
"""

import argparse
import itertools
import json
import shlex
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path
from statistics import NormalDist, fmean, stdev

# A CI from fewer scenes is hardly narrower than the scores.
FEWEST_SCENES = 6


def main():
    arguments = parse_arguments()
    manifest = read_manifest(arguments.filter)
    base = written_values(manifest, arguments.preset)
    check_names([*arguments.keep, *arguments.fixed], base, arguments.filter)
    given_changes = [parse_change(text, manifest) for text in arguments.change]
    singles = given_changes or [change for change in list_changes(manifest, base) if not set(change) & set(arguments.keep)]

    scores = Scores(arguments, manifest)
    start = scores.measure({})
    print_head(f"{manifest['name']}:{arguments.preset}")
    print(f"{len(start)} scenes at {arguments.size}, {arguments.samples_per_pixel} samples per pixel: FLIP {fmean(start.values()):.4f}\n")
    ranked = rank(scores, singles, start)
    print_table("change", ranked)
    single = first_certain(ranked)
    if not single:
        print("\nsmallest change: none; no gain's CI excludes 0")
        return
    best = [trial for trial in ranked if trial.gain.mean > 0][: arguments.best]
    pair = try_pairs(scores, best, single)
    confirm(Scores(arguments, manifest, ["--seal", str(arguments.seal)]), single, pair)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], allow_abbrev=False)
    parser.add_argument("--filter", type=Path, required=True, help="folder of the filter")
    parser.add_argument("--preset", required=True, help="preset to change")
    parser.add_argument("--keep", action="append", default=[], metavar="PARAMETER", help="do not change it; name what sets the length of the smear")
    parser.add_argument("--set", action="append", default=[], dest="fixed_values", metavar="PARAMETER=VALUE", help="value of the preset itself, too")
    parser.add_argument("--change", action="append", default=[], metavar="PARAMETER=VALUE[,..]", help="measure this change only; repeatable")
    parser.add_argument("--best", type=int, default=4, help="how many of the best changes are tried in pairs [default: %(default)s]")
    parser.add_argument("--seal", type=int, default=1, help="sealed variant that confirms the change [default: %(default)s]")
    parser.add_argument("--scenes", help="scenes [default: all]")
    parser.add_argument("--scenes-dir", default="scenes", help="folder of scenes")
    parser.add_argument("--size", default="160x90", help="picture size [default: %(default)s]")
    parser.add_argument("--samples-per-pixel", default="64", help="samples of a truth [default: %(default)s]")
    parser.add_argument("--program", default="shuttertruth", help="the program")
    parser.add_argument("--out", required=True, help="folder for truths, which are kept")
    arguments = parser.parse_args()
    arguments.fixed = [text.split("=")[0] for text in arguments.fixed_values]
    return arguments


def read_manifest(folder):
    try:
        return tomllib.loads((folder / "filter.toml").read_text())
    except FileNotFoundError:
        sys.exit(f"{folder}: has no filter.toml; name a folder such as shaders/godot")


def written_values(manifest, preset):
    """Returns the values of a preset, as written: lengths in pixels of its reference width."""
    presets = {entry["name"]: entry for entry in manifest["preset"]}
    if preset not in presets:
        sys.exit(f"--preset {preset}: {manifest['name']} has {', '.join(presets)}")
    return {parameter["name"]: parameter["default"] for parameter in manifest["parameter"]} | presets[preset].get("values", {})


def check_names(names, base, filter):
    for name in names:
        if name not in base:
            sys.exit(f"{name}: {filter} has no such parameter; it has {', '.join(base)}")


def parse_change(text, manifest):
    """Reads a change such as `tile_size=63,tile_motion=exact`."""
    parameters = {parameter["name"]: parameter for parameter in manifest["parameter"]}
    change = {}
    for part in text.split(","):
        parameter, value = part.split("=") if part.count("=") == 1 else (part, "")
        check_names([parameter], parameters, manifest["name"])
        kind = parameters[parameter]["kind"]
        change[parameter] = value if kind == "choice" else int(value) if kind == "integer" else float(value)
    return change


def list_changes(manifest, base):
    """Lists every change of one parameter: other choices, half and twice the value, and what other presets have."""
    changes = []
    for parameter in manifest["parameter"]:
        values = [entry.get("values", {}).get(parameter["name"]) for entry in manifest["preset"]]
        values = [value for value in values if value is not None] + [parameter["default"], *neighbours(parameter, base[parameter["name"]])]
        changes += [{parameter["name"]: value} for value in dict.fromkeys(values) if value != base[parameter["name"]]]
    return changes


def neighbours(parameter, value):
    if parameter["kind"] == "choice":
        return parameter["choices"]
    low, high = parameter["range"]
    is_whole = parameter["kind"] == "integer"
    if parameter.get("scale") == "log" or parameter.get("unit") == "pixels" or is_whole:
        tried = [value / 2, value * 2]
    else:
        tried = [low, value - (high - low) / 4, value + (high - low) / 4, high]
    tried = [min(max(number, low), high) for number in tried]
    return [round(number) for number in tried] if is_whole else tried


class Gain:
    """The difference of two sets of scores, as a mean over scenes with its 95 % CI."""

    def __init__(self, before, after):
        self.gains = [before[scene] - after[scene] for scene in before]
        self.count = len(self.gains)
        self.mean = fmean(self.gains)
        half = t_quantile(self.count - 1) * stdev(self.gains) / self.count**0.5
        self.low, self.high = self.mean - half, self.mean + half

    def __str__(self):
        return f"{self.mean:+.4f} ({self.low:+.4f} to {self.high:+.4f})"


def t_quantile(freedom):
    """Student's t at 97.5 %, by the expansion of Abramowitz and Stegun 26.7.5: off by 0.001 at most from 5 degrees of freedom on."""
    z = NormalDist().inv_cdf(0.975)
    terms = [z, (z**3 + z) / 4, (5 * z**5 + 16 * z**3 + 3 * z) / 96, (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / 384]
    terms += [(79 * z**9 + 776 * z**7 + 1482 * z**5 - 1920 * z**3 - 945 * z) / 92160]
    return sum(term / freedom**power for power, term in enumerate(terms))


class Scores:
    """Scores of candidates, from `shuttertruth tune evaluate`."""

    def __init__(self, arguments, manifest, more=()):
        words = [arguments.program, "tune", "evaluate", "--filter", str(arguments.filter), "--from", arguments.preset, "--objective", "flip"]
        words += ["--size", arguments.size, "--samples-per-pixel", arguments.samples_per_pixel, "--scenes-dir", arguments.scenes_dir]
        words += ["--out", arguments.out, "--quiet", *([arguments.scenes] if arguments.scenes else []), *more]
        self.words = [*words, "--params"]
        self.manifest = manifest
        self.width = int(arguments.size.split("x")[0])
        presets = {entry["name"]: entry for entry in manifest["preset"]}
        self.reference = presets[arguments.preset].get("reference_width", manifest.get("reference_width"))
        self.fixed = {}
        for text in arguments.fixed_values:
            self.fixed |= parse_change(text, manifest)

    def measure(self, change):
        """Returns the FLIP of each scene with a change of the preset; None if the filter refuses the change."""
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            json.dump(self.scaled(self.fixed | change), file)
            file.flush()
            ended = subprocess.run([*self.words, file.name], capture_output=True, text=True)
        if ended.returncode:
            if not change:
                sys.exit(ended.stderr)
            print(f"refused: {name(change)}: {ended.stderr}", file=sys.stderr)
            return None
        scores = json.loads(ended.stdout)["scenes"]
        if len(scores) < FEWEST_SCENES:
            sys.exit(f"{len(scores)} scenes: a CI over scenes needs at least {FEWEST_SCENES}; name more with --scenes")
        return {scene: score["flip"] for scene, score in scores.items()}

    def scaled(self, change):
        """Converts lengths to pixels of the picture, as the program does for a preset's own values."""
        scaled = dict(change)
        for parameter in self.manifest["parameter"]:
            if self.reference and parameter.get("unit") == "pixels" and parameter["name"] in change:
                low, high = parameter["range"]
                value = min(max(change[parameter["name"]] * self.width / self.reference, low), high)
                scaled[parameter["name"]] = round(value) if parameter["kind"] == "integer" else value
        return scaled


class Tried:
    """A change with its score, and its gain over some other scores."""

    def __init__(self, change, scores, before):
        self.change, self.scores, self.gain = change, scores, Gain(before, scores)


def rank(scores, changes, before):
    """Measures changes against scores; the largest gain comes first."""
    measured = [(change, scores.measure(change)) for change in changes]
    tried = [Tried(change, flips, before) for change, flips in measured if flips]
    return sorted(tried, key=lambda trial: -trial.gain.mean)


def try_pairs(scores, best, single):
    """Prints the gains of pairs over the best single change; returns the best pair if the CI of its gain excludes 0."""
    pairs = [a.change | b.change for a, b in itertools.combinations(best, 2) if not set(a.change) & set(b.change)]
    ranked = rank(scores, pairs, single.scores)
    if not ranked:
        return None
    print(f"\nover `{name(single.change)}`:\n")
    print_table("pair", ranked)
    return ranked[0] if ranked[0].gain.low > 0 else None


def first_certain(ranked):
    """Returns the largest gain with a CI that excludes 0."""
    return next((trial for trial in ranked if trial.gain.low > 0), None)


def confirm(sealed, single, pair):
    """Prints the gains on sealed scenes, and what holds there, too."""
    before, after = sealed.measure({}), sealed.measure(single.change)
    gain = Gain(before, after)
    print(f"\non {gain.count} sealed scenes: `{name(single.change)}` gains {gain}")
    more = Gain(after, sealed.measure(pair.change)) if pair else None
    if more:
        print(f"`{name(pair.change)}` gains {more} over it")
    if gain.low <= 0:
        print("smallest change: none; its gain does not hold on sealed scenes")
        return
    print(f"smallest change: `{name(single.change)}`")
    if more and more.low > 0:
        print(f"of two parameters: `{name(pair.change)}`")


def print_head(preset):
    """Prints the heading of a page, and the command without the place of the program."""
    words = [word for before, word in zip(["", *sys.argv[1:]], sys.argv[1:]) if "--program" not in (before, word)]
    print(f"# The smallest change of {preset}\n\nPrinted by `examples/changes/search.py {shlex.join(words)}`.\n")


def name(change):
    return ", ".join(f"{parameter}={value}" for parameter, value in change.items())


def print_table(head, rows):
    print(f"| {head} | FLIP | gain (95 % CI) | better on |\n|---|---|---|---|")
    for trial in rows:
        better = sum(gain > 0 for gain in trial.gain.gains)
        print(f"| `{name(trial.change)}` | {fmean(trial.scores.values()):.4f} | {trial.gain} | {better} of {trial.gain.count} |")


if __name__ == "__main__":
    main()
