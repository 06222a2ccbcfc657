#!/bin/sh
# Fetches the engine shaders that the filters here bind, each at a fixed commit, unchanged. GODOT_GUERTIN, GODOT_JUMP_FLOOD, BEVY, KINO,
# PPV2, URP and FLAX may name other locations of the repositories: addresses, or clones on this machine. Lists what cannot be fetched,
# fetches the others all the same, and exits with 1. Existing files with the right content stay.
# Flax's licence is its own (https://flaxengine.com/licensing): read it before you use these files.
set -u
cd "$(dirname "$0")"
missing=
sums=sha256sum
command -v sha256sum >/dev/null || sums="shasum -a 256"

# fetch REPOSITORY COMMIT FOLDER FILES TO
fetch() {
    due=
    for file in $4; do
        holds "$5/$file" || due="$due $file"
    done
    [ -n "$due" ] || return 0
    copy=
    clone=$1
    if ! [ -d "$1" ]; then
        copy=$(mktemp -d)
        clone=$copy
        # Only the files that are read are transferred, if the server allows it.
        git -C "$copy" init -q &&
            git -C "$copy" remote add origin "$1" &&
            git -C "$copy" config remote.origin.promisor true &&
            git -C "$copy" config remote.origin.partialclonefilter blob:none &&
            git -C "$copy" fetch -q --depth 1 --filter=blob:none origin "$2"
    fi
    for file in $due; do
        mkdir -p "$(dirname "$5/$file")"
        if git -C "$clone" show "$2:$3/$file" > "$5/$file.part" 2>/dev/null && mv "$5/$file.part" "$5/$file" && holds "$5/$file"; then
            continue
        fi
        rm -f "$5/$file" "$5/$file.part"
        missing="$missing
    $5/$file: $3/$file of $1 at $2"
    done
    [ -z "$copy" ] || rm -rf "$copy"
}

# holds FILE: succeeds if the file's content matches SHA256SUMS
holds() {
    known=$(grep " $1\$" SHA256SUMS) && [ -f "$1" ] && [ "$($sums "$1")" = "$known" ]
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

demo=${GODOT_JUMP_FLOOD:-https://github.com/sphynx-owner/JFA_driven_motion_blur_demo}
fetch "$demo" fc7a04c3d196f1395173503b59c858c02fa31dcd MyJumpFloodIteration \
    "jfp_backtracking_experimental.glsl jump_flood_blur.glsl" \
    godot_jump_flood_paper
fetch "$demo" a34ff7f25f235c245e00157a85c6a98567e76c4f MyJumpFloodIteration \
    "jfp_backtracking_experimental.glsl jump_flood_blur.glsl" \
    godot_jump_flood_july_2024

bevy=${BEVY:-https://github.com/bevyengine/bevy}
commit=4805ca792c3e94eef07afd6fa9a2712f388c9a67
fetch "$bevy" $commit crates/bevy_post_process/src/motion_blur motion_blur.wesl bevy
# The packages that it imports, a folder each.
fetch "$bevy" $commit crates/bevy_pbr/src "prepass/utils.wesl render/utils.wesl render/rgb9e5.wesl" bevy/bevy_pbr
fetch "$bevy" $commit crates/bevy_core_pipeline/src fullscreen_vertex_shader.wesl bevy/bevy_core_pipeline
fetch "$bevy" $commit crates/bevy_render/src "globals.wesl maths.wesl" bevy/bevy_render

fetch "${KINO:-https://github.com/keijiro/KinoMotion}" \
    35d5d5179e60703d1db5eac967715f5ea416e387 \
    Assets/Kino/Motion/Shader \
    "Common.cginc Prefilter.cginc Reconstruction.cginc" \
    kino

ppv2=${PPV2:-https://github.com/Unity-Technologies/PostProcessing}
commit=ea3f7dd8959105aa0e00ffa3fe6980f1464a5a09
fetch "$ppv2" $commit PostProcessing/Shaders "StdLib.hlsl xRLib.hlsl API/Vulkan.hlsl" ppv2
fetch "$ppv2" $commit PostProcessing/Shaders/Builtins MotionBlur.shader ppv2
# Its passes and textures are KinoMotion's, under other names; it has ten samples, and texel sizes of two numbers.
sed -e 's/"unity_kino"/"unity_ppv2"/; s/^summary = .*/summary = "Post Processing Stack v2 for Unity: its HLSL, as it is."/' \
    -e 's/^source = .*/source = "Unity-Technologies\/PostProcessing; fetch.sh says which commit."/; s/^default = 8/default = 10/' \
    -e 's/^shader = .*/shader = "MotionBlur.shader"\nshader_pass = 0/; s/"frag_/"Frag/' \
    -e '/^_VelocityTex_TexelSize/s/, "width", "height"//; /^_NeighborMaxTex_TexelSize/,/^]/{/"max/d}' \
    kino/filter.toml > ppv2/filter.toml

fetch "${URP:-https://github.com/Unity-Technologies/Graphics}" \
    438e5869f41f3920e7d1c4ee52ad273c0b9f82a6 \
    Packages/com.unity.render-pipelines.universal/Shaders/PostProcessing \
    CameraMotionBlur.shader \
    urp

flax=${FLAX:-https://github.com/FlaxEngine/FlaxEngine}
commit=1146620d4f965f106ff25f3a08b7fbec1a33b45b
fetch "$flax" $commit Source/Shaders MotionBlur.shader flax
# The folder that it includes files from.
fetch "$flax" $commit Source/Shaders "Common.hlsl GBuffer.hlsl GBufferCommon.hlsl" flax/Flax

if [ -n "$missing" ]; then
    echo "not fetched:$missing
Is git installed, and the network there? GODOT_GUERTIN, GODOT_JUMP_FLOOD, BEVY, KINO, PPV2, URP and FLAX may name clones on this machine." >&2
    exit 1
fi
