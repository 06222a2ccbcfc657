"""Tries a wheel as its user would: a bare environment, `pip install`, the first ranking. Prints how long each took.

    python release/try_wheel.py target/wheel/shuttertruth-0.1.0-cp39-abi3-manylinux_2_34_x86_64.whl

Fails if the wheel is too large, if installing and ranking take two minutes or more, or if a truth needs a Vulkan driver.
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import time
import venv

MOST_MEGABYTES = 40
MOST_SECONDS = 120

wheel = pathlib.Path(sys.argv[1]).resolve()
megabytes = wheel.stat().st_size / 1e6
print(f"{wheel.name}: {megabytes:.1f} MB")
assert megabytes < MOST_MEGABYTES, f"allowed: less than {MOST_MEGABYTES} MB"

with tempfile.TemporaryDirectory() as folder:
    environment = pathlib.Path(folder, "environment")
    venv.create(environment, with_pip=True)
    bin = environment / ("Scripts" if os.name == "nt" else "bin")

    def timed(what: str, *words: object, **options) -> float:
        began = time.monotonic()
        subprocess.run([str(word) for word in words], cwd=folder, check=True, **options)
        took = time.monotonic() - began
        print(f"{what}: {took:.0f} s", flush=True)
        return took

    installed = timed("pip install", bin / "pip", "install", "-q", wheel)
    ranked = timed("first ranking", bin / "shuttertruth", "run", "--scenes", "sliding_panel", "--samples-per-pixel", "64", "-q")
    print(f"from nothing to the first ranking: {installed + ranked:.0f} s; allowed: less than {MOST_SECONDS}")
    assert installed + ranked < MOST_SECONDS
    # The loader finds no driver.
    lacking = {**os.environ, "VK_DRIVER_FILES": "/dev/null", "VK_ICD_FILENAMES": "/dev/null"}
    code = "import shuttertruth as st; made = st.render('fan', (160, 90), samples=64); print(made, st.score(made.frame, made)['flip_moving'])"
    timed("a truth and its scores, without a Vulkan driver", bin / "python3", "-c", code, env=lacking)
