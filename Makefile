# `make run` does the main job; `make test` passes the tests. Both check for a Vulkan driver first and, on Debian and
# Ubuntu, install the software one where none is found. On macOS and Windows plain cargo commands work.

.PHONY: run test vulkan

# Mesa complains on every start where a login session has not set it, as in containers; nothing is written there.
export XDG_RUNTIME_DIR ?= /tmp

# What `make run` measures; `make run SCENES=` takes all.
SCENES ?= sliding_panel,panel_over_texture,two_spheres,railing,fan

run: vulkan
	cargo run --release --locked --bin shuttertruth -- run $(if $(SCENES),--scenes $(SCENES)) --out out

test: vulkan
	cargo test --workspace --locked

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

vulkan:
	@command -v cargo >/dev/null || { echo "cargo is not on the PATH: install Rust (https://rustup.rs) first" >&2; exit 1; }
	@[ "$$(uname -s)" = Linux ] || exit 0; \
	$(FIND_VULKAN); \
	found && loader && exit 0; \
	way_out="install a Vulkan driver and loader, for example the software one: apt-get install mesa-vulkan-drivers libvulkan1 (Debian, Ubuntu), dnf install mesa-vulkan-drivers vulkan-loader (Fedora), pacman -S vulkan-swrast vulkan-icd-loader (Arch)"; \
	command -v apt-get >/dev/null || { echo "no Vulkan driver found; $$way_out" >&2; exit 1; }; \
	if [ "$$(id -u)" = 0 ]; then as_root=""; \
	elif command -v sudo >/dev/null; then as_root="sudo"; \
	else echo "no Vulkan driver found, and neither root nor sudo to install one; $$way_out" >&2; exit 1; fi; \
	echo "no Vulkan driver found: installing mesa-vulkan-drivers and libvulkan1" >&2; \
	$$as_root apt-get update -q >&2 && \
	$$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -yq mesa-vulkan-drivers libvulkan1 >&2 || \
	{ echo "the installation failed; $$way_out" >&2; exit 1; }; \
	found && loader || { echo "still no Vulkan driver after the installation; $$way_out" >&2; exit 1; }
