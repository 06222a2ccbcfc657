#!/bin/sh
# Fetches the shaders of engines that the filters here bind, each at a named commit. Nothing is changed in them.
set -eu
cd "$(dirname "$0")"

# fetch REPOSITORY COMMIT FOLDER FILES TO
fetch() {
    copy=$(mktemp -d)
    git -C "$copy" init -q
    git -C "$copy" fetch -q --depth 1 "$1" "$2"
    for file in $4; do
        git -C "$copy" show "FETCH_HEAD:$3/$file" > "$5/$file"
    done
    rm -rf "$copy"
}

fetch "${GODOT_GUERTIN:-https://github.com/sphynx-owner/godot-motion-blur-addon-simplified}" \
    63ec6a700b2302337e6637c7482a7c11eca0735c \
    addons/sphynx_motion_blur_toolkit/guertin/shader_stages/shader_files \
    "guertin_tile_max_x.glsl guertin_tile_max_y.glsl guertin_neighbor_max.glsl guertin_sphynx_blur.glsl" \
    godot_guertin

fetch "${GODOT_JUMP_FLOOD:-https://github.com/sphynx-owner/JFA_driven_motion_blur_demo}" \
    d0c16fc1581eb757e993ff6eaf5877078c8d24cd \
    addons/SphynxMotionBlurToolkit/JumpFlood/ShaderFiles \
    "jf_guertin_tile_max_x.glsl jf_guertin_tile_max_y.glsl jfp_simple.glsl jf_neighbor_max.glsl jump_flood_simple_new_blur.glsl" \
    godot_jump_flood
