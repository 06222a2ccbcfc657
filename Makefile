# `make run` does the main job, and `make site` makes a site of its results. `make test` proves that the program is right, and
# `make prove` repeats it at full breadth in about two hours: CONTRIBUTING.md. `make archive` makes the release archive; `make action` and
# `make image` try it in a bare Debian and in two images. `make wheel` makes the Python wheel, and `make try_wheel` tries it:
# docs/release.md.
#
# All look for a Vulkan driver first and, on Debian and Ubuntu, install the software one where there is none. The tests need Python:
# Optuna drives the tuning service, Snakemake runs the jobs of a plan, numpy and OpenEXR compare presets with their originals, and
# flip-evaluator computes FLIP as its authors do. maturin builds the Python module.
# They need Chromium to open reports, and glslang to compile shaders in GLSL. `make prove` needs Blender, mdBook, and node, which installs
# and drives three.js, too. `make engines` builds real engines and lets them draw our scenes: engines/README.md.
# On macOS and Windows plain cargo commands work.

.PHONY: bpy run site pictures test module wheel try_wheel prove breadth guides engines godot oracles price replays fuzz mutants growth archive action release image publish debootstrap vulkan software_vulkan python chromium node glslang blender mdbook

# Mesa complains on every start where a login session has not set it, as in containers; nothing is written there.
export XDG_RUNTIME_DIR ?= /tmp

TARGET_DIR := $(or $(CARGO_TARGET_DIR),target)

# What `make run` measures; `make run SCENES=` takes all.
SCENES ?= sliding_panel,panel_over_texture,two_spheres,railing,fan

run: vulkan
	cargo run --locked --bin shuttertruth -- run $(SCENES) --samples-per-pixel 64 --out out

# A static site in target/site: results, a page per engine, the gallery, live cases of $(SCENES), and the guides.
site: vulkan mdbook
	cargo build --locked --bin shuttertruth --example results
	"$(PROGRAM)" run $(SCENES) --size 320x180 --samples-per-pixel 64 --out "$(TARGET_DIR)/site_run" \
	    --filter "identity$$(sed -n 's/^shape = "\(.*\)"/,\1/p' results/engines.toml | tr -d '\n')"
	rm -rf "$(TARGET_DIR)/site_source"
	"$(dir $(PROGRAM))examples/results" --site "$(TARGET_DIR)/site_source" "$(TARGET_DIR)/site_run/run.json"
	"$(MDBOOK)" build "$(TARGET_DIR)/site_source" --dest-dir "$(abspath $(TARGET_DIR)/site)"

# Makes the pictures of the pages, or with CHECK=1 compares them with what the program makes now; `make pictures RUNS=fan,report`
# takes two of the runs of examples/pictures/pictures.toml.
pictures: software_vulkan chromium
	cargo build --locked --bin shuttertruth --example results --example pictures
	$(SOFTWARE) "$(dir $(PROGRAM))examples/pictures" $(if $(CHECK),--check) $(RUNS)

# Tests compare numbers, which graphics cards round in their own ways. They run on Mesa's software driver, or on VK_DRIVER_FILES.
SOFTWARE = VK_DRIVER_FILES="$${VK_DRIVER_FILES:-$$(ls /usr/share/vulkan/icd.d/lvp_icd*.json 2>/dev/null | head -n 1)}"
TEST = $(SOFTWARE) cargo test --locked

# The tests make and delete many small files, for which ext4 takes a tenth of their time. These lie in memory where 4 GiB are free in
# /dev/shm and programs may run there, unless TMPDIR names a folder.
TEMPORARY = TMPDIR="$${TMPDIR:-$$(free=$$(df --output=avail /dev/shm 2>/dev/null | tail -n 1); \
    if [ "$${free:-0}" -gt 4194304 ] && ! grep -q ' /dev/shm .*noexec' /proc/mounts; then echo /dev/shm; else echo /tmp; fi)}"

# Many tests wait for a program that they run, or for a disk: twice as many run at once as there are processors.
THREADS = RUST_TEST_THREADS="$${RUST_TEST_THREADS:-$$((2 * $$(nproc)))}"

# Tools are installed while cargo compiles: one waits for the network, the other for the processors. `make --dry-run` runs every line
# that names MAKE; this one would compile.
TOOLS = $(MAKE) --no-print-directory python chromium glslang

test: software_vulkan
	@$(TOOLS) & tools=$$!; \
	$(TEST) --no-run; compiled=$$?; \
	wait $$tools && exit $$compiled
	$(TEMPORARY) $(THREADS) $(TEST)
	$(MAKE) --no-print-directory module

# The Python module, built as the tests are, and tested in a fresh environment; numpy is fetched once. Cargo's default packages leave
# it out.
WHEELS = $(TARGET_DIR)/wheels
MODULE = $(TARGET_DIR)/module
MATURIN = "$(PYTHON)" -m maturin build -q --locked --manifest-path crates/python/Cargo.toml --out
FETCH = "$(PYTHON)" -m pip download -q --no-deps --dest "$(WHEELS)" numpy==2.4.6

module: software_vulkan python
	rm -rf "$(MODULE)" "$(WHEELS)"/shuttertruth-*
	$(MATURIN) "$(WHEELS)"
	$(FETCH) --no-index --find-links "$(WHEELS)" 2>/dev/null || $(FETCH)
	"$(PYTHON)" -m venv --without-pip "$(MODULE)"
	"$(PYTHON)" -m pip --python "$(MODULE)/bin/python3" install -q --no-index --find-links "$(WHEELS)" shuttertruth
	cd crates/python/tests && $(SOFTWARE) "$(abspath $(MODULE))/bin/python3" -m unittest $(NAMES)

# The wheel for this kind of machine: module and program. `make try_wheel` installs it in a fresh environment, and times the first
# ranking.
wheel: python
	rm -rf "$(TARGET_DIR)/wheel"
	$(MATURIN) "$(TARGET_DIR)/wheel" --release

try_wheel: software_vulkan wheel
	$(SOFTWARE) "$(PYTHON)" release/try_wheel.py "$(TARGET_DIR)/wheel"/shuttertruth-*.whl

# Runs every part, even after one that fails. Prints at the end how long each took: `make prove PARTS=guides`.
PARTS ?= breadth guides pictures engines oracles replays fuzz mutants growth

# Pictures that `make prove` compares; the others take an hour.
PROVED = report,first_ten_minutes,fan,camera_only

# Minutes of the fuzzer.
MINUTES ?= 10

prove:
	@failed=0; took=""; \
	for part in $(PARTS); do \
	    echo "prove: $$part" >&2; start=$$(date +%s); end=passed; \
	    $(MAKE) --no-print-directory $$part MINUTES=$(MINUTES) CHECK=1 RUNS=$(PROVED) || { end=FAILED; failed=1; }; \
	    took="$$took$$(printf 'prove: %-8s %5d s %s' $$part $$(($$(date +%s) - start)) $$end)\n"; \
	done; \
	printf "$$took"; exit $$failed

# Tests that `make test` leaves out. The guides are a part of their own.
breadth: software_vulkan python chromium node glslang blender site
	$(TEST) --tests --no-fail-fast -- --ignored --skip guides::

# Runs every command of every page, and prints each with its time: `make guides PAGES=README.md,docs/your-scene.md` takes two pages.
guides: software_vulkan python glslang
	PAGES=$(PAGES) $(TEST) --test command_line -- --ignored --nocapture --test-threads 1 guides$(if $(PAGES),::every_command)

# Real engines draw our scenes, and their blur and vectors are measured: results/engines. Building Bevy takes some ten minutes on two
# cores.
ENGINES = $(abspath $(TARGET_DIR))/engines

# The newest bpy that Python 3.11 takes.
BLENDER_5 = $(abspath $(TARGET_DIR))/bpy/bin/python

bpy:
	@"$(BLENDER_5)" -c 'import bpy' 2>/dev/null || { python3.11 -m venv "$(TARGET_DIR)/bpy" && "$(BLENDER_5)" -m pip install -q bpy==5.0.1; }

DRAWN = PATH="$(dir $(abspath $(PROGRAM))):$$PATH" $(SOFTWARE) "$(PYTHON)" engines/measure.py

EEVEE = "$(BLENDER_5)" -W ignore examples/blender/blender.py -- {scene} {capture} --size {width}x{height} --blur eevee

engines: software_vulkan python chromium node bpy
	cargo build --locked --bin shuttertruth
	cargo build --locked --manifest-path engines/bevy/Cargo.toml --target-dir "$(ENGINES)/build"
	$(DRAWN) bevy "$(ENGINES)/bevy" -- "$(ENGINES)/build/debug/shuttertruth-bevy" {scene} {capture} {width} {height}
	cargo build --locked --manifest-path engines/three_rs/Cargo.toml --target-dir "$(ENGINES)/build"
	$(DRAWN) three_rs "$(ENGINES)/three_rs" -- "$(ENGINES)/build/debug/shuttertruth-three-rs" {scene} {capture} {width} {height}
	npm ci --prefix engines/threejs --no-audit --no-fund
	$(DRAWN) threejs "$(ENGINES)/threejs" -- node engines/threejs/capture.mjs {scene} --out {capture} --size {width}x{height} --near 0.1
	npm ci --prefix engines/babylon --no-audit --no-fund
	$(DRAWN) babylon "$(ENGINES)/babylon" -- node engines/babylon/capture.mjs {scene} --out {capture} --size {width}x{height}
	$(DRAWN) vector_blur "$(ENGINES)/vector_blur" -- "$(BLENDER_5)" -W ignore examples/blender/blender.py -- {scene} {capture} \
	    --size {width}x{height} --samples 16
	LIBGL_ALWAYS_SOFTWARE=1 $(DRAWN) eevee "$(ENGINES)/eevee" -- $(EEVEE) --samples 8
	LIBGL_ALWAYS_SOFTWARE=1 $(DRAWN) eevee_one_sample "$(ENGINES)/eevee_one_sample" -- $(EEVEE) --samples 1

# The Godot of Debian sid, in a folder of its own, as root. `make godot GODOT=PROGRAM` takes yours, on your screen.
GODOT_ROOT = $(abspath $(TARGET_DIR))/debian_sid
GODOT ?= engines/godot/debian.sh "$(GODOT_ROOT)"

godot: software_vulkan python glslang $(if $(findstring debian.sh,$(GODOT)),$(GODOT_ROOT))
	cargo build --locked --bin shuttertruth
	$(DRAWN) godot "$(ENGINES)/godot" -- $(GODOT) --path "$(CURDIR)/engines/godot" -s draw.gd --quit-after 1000 -- \
	    {scene} {capture} {width} {height}

$(GODOT_ROOT): | debootstrap
	rm -rf "$@.part"
	debootstrap --variant=minbase --include=godot,mesa-vulkan-drivers,xvfb,xauth,ca-certificates sid "$@.part" http://deb.debian.org/debian
	mv "$@.part" "$@"

# Ten reported defects, planted again: results/studies/replays.md.
replays: software_vulkan python
	cargo build --locked --bin shuttertruth
	PATH="$(dir $(abspath $(PROGRAM))):$$PATH" $(SOFTWARE) "$(PYTHON)" engines/replays.py "$(ENGINES)/replays"

# LuxCore and Cycles, other path tracers, render our scenes beside us: results/studies/oracles.md and oracles_cycles.md. It takes about
# 35 minutes on two cores.
LUXCORE = $(TARGET_DIR)/luxcore
ORACLE = PATH="$(dir $(abspath $(PROGRAM))):$$PATH" $(SOFTWARE) "$(PYTHON)" engines/oracles.py

oracles: software_vulkan python bpy
	cargo build --locked --bin shuttertruth
	"$(LUXCORE)/bin/python3" -c 'import pyluxcore' 2>/dev/null || { python3 -m venv "$(LUXCORE)" && \
	    "$(LUXCORE)/bin/python3" -m pip install -q pyluxcore==2.11.2 numpy==2.4.6 OpenEXR==3.5.3 pillow==13.0.0; }
	$(ORACLE) luxcore "$(ENGINES)/luxcore" -- "$(abspath $(LUXCORE))/bin/python3" engines/luxcore/draw.py
	$(ORACLE) cycles "$(ENGINES)/cycles" -- "$(BLENDER_5)" -W ignore examples/blender/blender.py --

# The price of our truths beside that of Cycles: crates/tracer/BENCHMARKS.md. It takes about twenty minutes on two cores, half of them
# to compile.
price: software_vulkan python bpy
	cargo bench --locked -p shuttertruth-tracer -- truths
	cargo build --locked --release --bin shuttertruth
	PATH="$(abspath $(TARGET_DIR))/release:$$PATH" $(SOFTWARE) "$(PYTHON)" engines/price.py "$(TARGET_DIR)/tmp/price" "$(ENGINES)/price" -- \
	    "$(BLENDER_5)" -W ignore examples/blender/blender.py --

# How long to fuzz, what, and from which seed on: `make fuzz MINUTES=1 TARGETS=scene,obj SEED=7`. See docs/fuzzing.md.
SEED ?= $(shell date +%s)

fuzz: software_vulkan
	$(TEMPORARY) MINUTES=$(MINUTES) SEED=$(SEED) TARGETS=$(TARGETS) $(TEST) --test fuzz

# Changes shipped kernels in small ways and counts the changes that the limits notice: results/studies/mutation.md.
mutants: software_vulkan
	$(SOFTWARE) cargo run --locked -p shuttertruth --example mutants

# Joins, judges and reports a run of 10,000 cases, copies of a small one: crates/merge/guides/many-machines.md.
GROWTH = $(TARGET_DIR)/tmp/growth
PROGRAM = $(TARGET_DIR)/debug/shuttertruth

growth: software_vulkan python
	rm -rf "$(GROWTH)"
	$(TEST) --no-run
	"$(PROGRAM)" check sliding_panel --filter mcguire:paper --size 160x90 --samples-per-pixel 64 --out "$(GROWTH)/small"
	"$(PYTHON)" examples/growth.py "$(GROWTH)/small" --scenes 100 --filters 94 --out "$(GROWTH)/large" --program "$(PROGRAM)"

archive:
	release/archive.sh $(TARGET)

# The newest archive for this machine.
ARCHIVE = $(shell ls -t target/archive/shuttertruth-*-$(shell rustc -vV | sed -n 's/^host: //p').tar.gz | head -n 1)

# As root: makes a bare Debian with debootstrap, and runs the steps of action.yml in it.
action: archive python debootstrap
	"$(PYTHON)" -c 'import yaml' 2>/dev/null || "$(PYTHON)" -m pip install -q pyyaml==6.0.3
	"$(PYTHON)" release/try_action.py "$(ARCHIVE)" $(if $(ROOT),--root "$(ROOT)")

# As root: everything that a release consists of, each tried as its user would.
release: archive try_wheel action publish

# As root: BASE=IMAGE names another base than Debian's image of Docker Hub.
image: archive
	release/compare_images.sh

# Publishes nothing: packs the libraries that others can use, compiles each from its package, and builds their pages.
publish:
	cargo publish --dry-run --locked -p shuttertruth-bvh -p shuttertruth-frame -p shuttertruth-metrics -p shuttertruth-scene \
		-p shuttertruth-source-hash -p shuttertruth-tracer
	RUSTDOCFLAGS="-D warnings" cargo doc --no-deps --locked -p shuttertruth-bvh -p shuttertruth-frame -p shuttertruth-metrics -p shuttertruth-scene -p shuttertruth-tracer

debootstrap:
	@command -v debootstrap >/dev/null && exit 0; \
	$(call INSTALL,program that makes a bare Debian,debootstrap,install debootstrap; it makes Debian and Ubuntu on any Linux); \
	command -v debootstrap >/dev/null || { echo "still no debootstrap after the installation" >&2; exit 1; }

# The Python that has these packages; one of your own is used as it is. Its pip is called through it: in a copied folder the script
# `pip` still belongs to the original.
VENV := $(abspath $(TARGET_DIR))/python
export PYTHON ?= $(VENV)/bin/python3

# `$(call INSTALL,what is missing,packages,way out)`: from Debian's packages, as root.
define INSTALL
    command -v apt-get >/dev/null || { echo "no $(1) found; $(3)" >&2; exit 1; }; \
    if [ "$$(id -u)" = 0 ]; then as_root=""; \
    elif command -v sudo >/dev/null; then as_root="sudo"; \
    else echo "no $(1) found, and neither root nor sudo to install one; $(3)" >&2; exit 1; fi; \
    echo "no $(1) found: installing $(2)" >&2; \
    { $$as_root apt-get update -q && $$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -yq $(2); } >&2 || \
    { echo "the installation failed; $(3)" >&2; exit 1; }
endef

# A Vulkan driver is a manifest (an ICD) in one of the loader's folders, or one named by its variables.
define FIND_VULKAN
found() { \
    [ -n "$${VK_DRIVER_FILES:-}$${VK_ICD_FILENAMES:-}" ] && return 0; \
    for folder in /etc/vulkan /usr/share/vulkan /usr/local/share/vulkan "$${HOME}/.local/share/vulkan"; do \
        ls "$$folder"/icd.d/*.json >/dev/null 2>&1 && return 0; \
    done; \
    return 1; \
}; \
loader() { \
    PATH="$$PATH:/sbin:/usr/sbin" ldconfig -p 2>/dev/null | grep -q 'libvulkan\.so\.1'; \
}
endef

VULKAN_WAY_OUT := install a Vulkan driver and loader, for example the software one: apt-get install mesa-vulkan-drivers libvulkan1 (Debian, Ubuntu), dnf install mesa-vulkan-drivers vulkan-loader (Fedora), pacman -S vulkan-swrast vulkan-icd-loader (Arch)

vulkan:
	@command -v cargo >/dev/null || { echo "cargo is not on the PATH: install Rust (https://rustup.rs) first" >&2; exit 1; }
	@[ "$$(uname -s)" = Linux ] || exit 0; \
	$(FIND_VULKAN); \
	found && loader && exit 0; \
	$(call INSTALL,Vulkan driver,mesa-vulkan-drivers libvulkan1,$(VULKAN_WAY_OUT)); \
	found && loader || { echo "still no Vulkan driver after the installation; $(VULKAN_WAY_OUT)" >&2; exit 1; }

software_vulkan: vulkan
	@[ "$$(uname -s)" = Linux ] && [ -z "$${VK_DRIVER_FILES:-}" ] || exit 0; \
	found() { ls /usr/share/vulkan/icd.d/lvp_icd*.json >/dev/null 2>&1; }; \
	found && exit 0; \
	$(call INSTALL,software Vulkan driver,mesa-vulkan-drivers,$(VULKAN_WAY_OUT)); \
	found || { echo "still no lvp_icd*.json in /usr/share/vulkan/icd.d after the installation; $(VULKAN_WAY_OUT)" >&2; exit 1; }

python:
	@"$(PYTHON)" -c 'import optuna, snakemake, numpy, OpenEXR, maturin, flip_evaluator' 2>/dev/null && exit 0; \
	[ "$(PYTHON)" = "$(VENV)/bin/python3" ] || \
	{ echo "$(PYTHON) lacks one of optuna, snakemake, numpy, OpenEXR, maturin and flip-evaluator: pip install them, or leave PYTHON unset to have them installed" >&2; exit 1; }; \
	python3 -c 'import ensurepip' 2>/dev/null || \
	{ $(call INSTALL,Python that can make environments,python3-venv,install Python 3 with venv and pip); }; \
	echo "installing Optuna, Snakemake, numpy, OpenEXR, maturin and flip-evaluator to $(VENV)" >&2; \
	python3 -m venv "$(VENV)" && "$(VENV)/bin/python3" -m pip install -q optuna==5.0.0 snakemake==9.27.1 numpy==2.4.6 \
	    OpenEXR==3.5.3 maturin==1.16.0 flip-evaluator==1.7 >&2

CHROMIUM_WAY_OUT := install it, for example: apt-get install chromium (Debian), dnf install chromium (Fedora), pacman -S chromium (Arch), or name a Chromium or Chrome in CHROMIUM

# The tests take $CHROMIUM, or the first of these that there is. With EGL, Mesa draws for WebGL; without it Chromium's own SwiftShader.
chromium:
	@[ "$$(uname -s)" = Linux ] || exit 0; \
	found() { [ -n "$${CHROMIUM:-}" ] || command -v chromium || command -v chromium-browser || command -v google-chrome; }; \
	found >/dev/null && exit 0; \
	$(call INSTALL,Chromium,chromium libegl1,$(CHROMIUM_WAY_OUT)); \
	found >/dev/null || { echo "still no Chromium after the installation; $(CHROMIUM_WAY_OUT)" >&2; exit 1; }

NODE_WAY_OUT := install Node.js 18 or newer with npm, for example: apt-get install nodejs npm (Debian, Ubuntu), dnf install nodejs npm (Fedora), pacman -S nodejs npm (Arch)

# The test that draws with three.js installs that itself, with `npm ci`.
node:
	@[ "$$(uname -s)" = Linux ] || exit 0; \
	found() { command -v npm >/dev/null && node -e 'process.exit(parseInt(process.versions.node) < 18 ? 1 : 0)' 2>/dev/null; }; \
	found && exit 0; \
	$(call INSTALL,Node.js of version 18 or newer with npm,nodejs npm,$(NODE_WAY_OUT)); \
	found || { echo "still no Node.js 18 with npm after the installation; $(NODE_WAY_OUT)" >&2; exit 1; }

GLSLANG_WAY_OUT := install it, for example: apt-get install glslang-tools (Debian, Ubuntu), dnf install glslang (Fedora), pacman -S glslang (Arch)

glslang:
	@[ "$$(uname -s)" = Linux ] || exit 0; \
	command -v glslangValidator >/dev/null && exit 0; \
	$(call INSTALL,compiler of GLSL,glslang-tools,$(GLSLANG_WAY_OUT)); \
	command -v glslangValidator >/dev/null || { echo "still no glslangValidator after the installation; $(GLSLANG_WAY_OUT)" >&2; exit 1; }

# mdBook makes a book of Markdown pages. Optimized it would save seconds, and compile for minutes.
MDBOOK_VERSION := 0.5.4
MDBOOK = $(TARGET_DIR)/mdbook/bin/mdbook

mdbook:
	@"$(MDBOOK)" --version 2>/dev/null | grep -qxF "mdbook v$(MDBOOK_VERSION)" || \
	cargo install mdbook --version "=$(MDBOOK_VERSION)" --locked --no-default-features --features search --debug --root "$(TARGET_DIR)/mdbook"

BLENDER_WAY_OUT := install it, for example: apt-get install blender python3-numpy (Debian, Ubuntu), dnf install blender (Fedora), pacman -S blender python-numpy (Arch)

# Debian's Blender uses the system's Python, whose numpy the importer of glTF needs.
blender:
	@[ "$$(uname -s)" = Linux ] || exit 0; \
	command -v blender >/dev/null && exit 0; \
	$(call INSTALL,Blender,blender python3-numpy,$(BLENDER_WAY_OUT)); \
	command -v blender >/dev/null || { echo "still no blender after the installation; $(BLENDER_WAY_OUT)" >&2; exit 1; }
