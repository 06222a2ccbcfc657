"""Runs the steps of action.yml, read from that file, in a bare Debian without cargo, as a job of GitHub Actions does.

    python3 release/try_action.py ARCHIVE [--root FOLDER] [--suite bookworm]

Needs root, debootstrap and PyYAML. `make action` runs this. The steps that use actions of GitHub (cache, artifact) are played by
functions of this file; every `run` is executed as it stands.
"""

import argparse
import glob
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import yaml

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent
ACTION = yaml.safe_load((REPOSITORY / "action.yml").read_text())
TOKEN = re.compile(r"'[^']*'|==|!=|&&|\|\||!|\(|\)|[\w.-]+|\s+")


class Job:
    """A job on a fresh machine with one step: this action."""

    def __init__(self, root, store, given):
        self.root, self.store = root, store
        declared = ACTION["inputs"]
        assert set(given) <= set(declared), f"no such input: {set(given) - set(declared)}"
        missing = [name for name, input in declared.items() if input.get("required") and name not in given]
        assert not missing, f"missing inputs: {missing}"
        self.inputs = {name: given.get(name, str(input.get("default", ""))) for name, input in declared.items()}
        self.steps, self.environment, self.paths = {}, {}, []
        self.failed, self.log, self.artifacts = False, "", {}
        shutil.rmtree(self.inside("/runner"), ignore_errors=True)
        for folder in ("/runner/temp", "/runner/files", "/workspace"):
            self.inside(folder).mkdir(parents=True, exist_ok=True)

    def inside(self, path):
        return pathlib.Path(f"{self.root}{path}")

    def run(self):
        for step in ACTION["runs"]["steps"]:
            condition = step.get("if", "success()")
            if not self.evaluate(condition, and_success="()" not in condition):
                print(f"-- {step['name']}: left out")
                continue
            print(f"-- {step['name']}", flush=True)
            values = {name: self.fill(value) for name, value in {**step.get("env", {}), **step.get("with", {})}.items()}
            outputs = self.execute(step, values) if "run" in step else PLAYED[step["uses"]](self, values)
            if "id" in step:
                self.steps[step["id"]] = outputs
        outputs = ACTION["outputs"].items()
        return {name: self.fill(output["value"]) for name, output in outputs}

    def execute(self, step, environment):
        """Runs the script of a step as GitHub does; reads the files by which it speaks to later steps."""
        assert step["shell"] == "bash", "a composite action names the shell of each step"
        files = {name: f"/runner/files/{name}" for name in ("GITHUB_OUTPUT", "GITHUB_ENV", "GITHUB_PATH")}
        for path in files.values():
            self.inside(path).write_text("")
        self.inside("/runner/files/step.sh").write_text(step["run"])
        path = ":".join([*reversed(self.paths), "/usr/sbin:/usr/bin:/sbin:/bin"])
        whole = {
            "PATH": path, "HOME": "/root", "CI": "true", "RUNNER_TEMP": "/runner/temp", "GITHUB_ACTION_PATH": "/action",
            "GITHUB_STEP_SUMMARY": "/runner/files/summary.md", **files, **self.environment, **environment,
        }
        words = ["env", "-i", *(f"{name}={value}" for name, value in whole.items()), "chroot", str(self.root), "bash", "-c",
                 "cd /workspace && exec bash --noprofile --norc -eo pipefail /runner/files/step.sh"]
        done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.log += done.stdout
        print("   " + "\n   ".join(done.stdout.splitlines()[-12:]), flush=True)
        self.failed |= done.returncode != 0
        outputs, more = (read_pairs(self.inside(files[name])) for name in ("GITHUB_OUTPUT", "GITHUB_ENV"))
        self.environment |= more
        self.paths += self.inside(files["GITHUB_PATH"]).read_text().split()
        return outputs

    def fill(self, text):
        return re.sub(r"\$\{\{(.*?)\}\}", lambda found: str(self.evaluate(found[1])), str(text))

    def evaluate(self, expression, and_success=False):
        tokens = TOKEN.findall(expression)
        assert "".join(tokens) == expression, f"not understood: {expression}"
        words = {"&&": " and ", "||": " or ", "!": " not ", "always": "(lambda: True)", "success": f"(lambda: {not self.failed})"}
        python = "".join(words.get(token) or self.translate(token) for token in tokens)
        value = eval(python.strip())
        return value and not self.failed if and_success else value

    def translate(self, token):
        if not re.match(r"[A-Za-z]", token):
            return token
        scope, *names = token.split(".")
        known = {"inputs": self.inputs, "runner": {"temp": "/runner/temp", "os": "Linux", "arch": "X64"}}
        if scope == "steps":
            step, outputs, name = names
            known = {i["id"] for i in ACTION["runs"]["steps"] if "id" in i}
            assert step in known and outputs == "outputs", f"no such step: {token}"
            return repr(self.steps.get(step, {}).get(name, ""))
        return repr(known[scope][names[0]])


def read_pairs(path):
    return dict(line.split("=", 1) for line in path.read_text().splitlines())


def restore_cache(job, given):
    exact = job.store / given["key"]
    prefix = given.get("restore-keys", "").strip()
    older = sorted(job.store.glob(f"{prefix}*"), key=os.path.getmtime) if prefix else []
    found = exact if exact.is_dir() else older[-1] if older else None
    if found:
        shutil.copytree(found, job.inside(given["path"]), dirs_exist_ok=True)
    print(f"   restored: {found and found.name}")
    return {"cache-hit": "true" if found == exact else "false" if found else ""}


def save_cache(job, given):
    assert given["key"], "a cache without a key"
    kept = job.inside(given["path"])
    if kept.is_dir():
        shutil.copytree(kept, job.store / given["key"], dirs_exist_ok=True)
    return {}


def upload(job, given):
    found = []
    for pattern in given["path"].split():
        for path in glob.glob(str(job.inside(pattern)), recursive=True):
            found += [path] if os.path.isfile(path) else glob.glob(path + "/**", recursive=True)
    job.artifacts[given["name"]] = [path for path in found if os.path.isfile(path)]
    print(f"   {given['name']}: {len(job.artifacts[given['name']])} files")
    return {}


PLAYED = {
    "actions/cache/restore@v4": restore_cache,
    "actions/cache/save@v4": save_cache,
    "actions/upload-artifact@v4": upload,
}


def prepare(root, suite, archive, store):
    if not (root / "usr/bin").is_dir():
        subprocess.run(["debootstrap", "--variant=minbase", suite, str(root)], check=True, stdout=subprocess.DEVNULL)
    # Without a Vulkan driver, as a bare machine is.
    subprocess.run(["chroot", str(root), "apt-get", "purge", "-yq", "mesa-vulkan-drivers", "libvulkan1"], capture_output=True)
    assert not (root / "root/.cargo").exists() and not shutil.which("cargo", path=str(root / "usr/bin")), "cargo is there"
    shutil.rmtree(root / "workspace", ignore_errors=True)
    (root / "workspace").mkdir()
    shutil.copy(archive, root / "workspace/program.tar.gz")
    shutil.rmtree(store, ignore_errors=True)
    store.mkdir()


def expect(what, condition):
    assert condition, f"NOT AS EXPECTED: {what}"
    print(f"ok: {what}", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("archive", type=pathlib.Path)
    parser.add_argument("--root", type=pathlib.Path, default=REPOSITORY / "target/action/root")
    parser.add_argument("--suite", default="bookworm")
    args = parser.parse_args()
    args.root.mkdir(parents=True, exist_ok=True)
    store = args.root.parent / (args.root.name + ".cache")
    prepare(args.root, args.suite, args.archive, store)
    given = {"filter": "mcguire:paper", "scenes": "fan", "archive": "program.tar.gz"}

    print("== a check that passes", flush=True)
    job = Job(args.root, store, given)
    outputs = job.run()
    expect("it passes", outputs["verdict"] == "PASS" and outputs["exit-code"] == "0" and not job.failed)
    for name in ("run", "report", "junit"):
        expect(f"there is a file {outputs[name]}", job.inside(outputs[name]).is_file())
    expect("the version is known", re.match(r"shuttertruth \d", outputs["version"]))
    expect("the step has a summary", "Shuttertruth: PASS" in job.inside("/runner/files/summary.md").read_text())
    uploaded = job.artifacts["shuttertruth"]
    expect("report, scores and pictures are uploaded", {"report.html", "run.json", "junit.xml", "output.png"} <= {os.path.basename(p) for p in uploaded})
    scores = job.inside(outputs["run"]).read_bytes()
    truth = next(job.inside("/runner/temp").rglob("truth_*.exr")).stat().st_mtime_ns

    print("== the same in a later job, from the kept truths", flush=True)
    job = Job(args.root, store, given)
    outputs = job.run()
    expect("it passes", outputs["verdict"] == "PASS")
    expect("the truth was not rendered again", next(job.inside("/runner/temp").rglob("truth_*.exr")).stat().st_mtime_ns == truth)
    expect("run.json is the same", job.inside(outputs["run"]).read_bytes() == scores)

    print("== the same on a fresh machine, from a folder of truths", flush=True)
    kept = next(job.inside("/runner/temp/shuttertruth/out").rglob("run.json")).parent
    shutil.copytree(kept, args.root / "workspace/truths")
    job = Job(args.root, store, {**given, "cache": "false", "truths": "truths"})
    outputs = job.run()
    expect("it passes", outputs["verdict"] == "PASS")
    # A truth that is taken from a folder is a link to its file.
    kept, taken = ({p.stat().st_ino for p in job.inside(folder).rglob("truth_*.exr")} for folder in ("/workspace/truths", "/runner/temp"))
    expect("nothing is rendered", taken and taken <= kept)
    expect("the cases are the same", json.loads(job.inside(outputs["run"]).read_text())["cases"] == json.loads(scores)["cases"])

    print("== a filter that breaks its bounds", flush=True)
    job = Job(args.root, store, {**given, "filter": "velocity_gather", "scenes-dir": "scenes"})
    strict_scene(args.root)
    outputs = job.run()
    expect("it fails", outputs["verdict"] == "FAIL" and outputs["exit-code"] == "1" and job.failed)
    expect("the log has an annotation", "::error file=scenes/fan/bounds.toml,line=2,title=fan / velocity_gather" in job.log)
    expect("the report is uploaded all the same", any(p.endswith("report.html") for p in job.artifacts["shuttertruth"]))

    print("== an archive with another hash than the named one", flush=True)
    job = Job(args.root, store, {**given, "sha256": "0" * 64})
    job.run()
    expect("it is refused before it is unpacked", job.failed and not job.inside("/runner/temp/shuttertruth/program").exists())
    print("all as expected")


def strict_scene(root):
    """Makes a scene in the workspace whose bound no filter keeps."""
    folder = root / "workspace/scenes"
    shutil.copytree(REPOSITORY / "scenes/fan", folder / "fan")
    (folder / "fan/bounds.toml").write_text(
        '[default]\nflip_moving = { limit = 0.1, size = [160, 90], why = "no filter keeps it" }\n'
    )


if __name__ == "__main__":
    sys.exit(main())
