//! Shaders in the manners of engines and sites, written for these tests: each blurs as the guide's
//! kernel does.

use tests::text::assert_contains;

use super::guide::assert_blurs_as_the_guide;
use super::{busy_picture, make, make_declared};
use crate::filter_files::FilterFiles;

#[track_caller]
fn assert_blurs(files: &FilterFiles) {
    assert_blurs_as_the_guide(&files.load().unwrap(), &busy_picture());
}

#[test]
fn a_tutorial_of_opengl_blurs_the_right_way_up() {
    let files = make_declared("opengl", "tutorial.toml");
    assert_blurs(&files);
    // Textures of Vulkan's GLSL in the same file keep their places.
    let newer = files.changed("tutorial.frag", "330 core", "450 core");
    let placed = newer.changed(
        "tutorial.frag",
        "uniform sampler2D screenTexture",
        "layout(binding = 5) uniform sampler2D screenTexture",
    );
    let pass = "name = \"screenTexture\"";
    assert_blurs(&placed.changed("filter.toml", pass, "binding = 5"));
}

#[test]
fn a_shadertoy_is_included() {
    let files = make_declared("shadertoy", "toy.toml");
    assert_blurs(&files);
    files.assert_refused("shadertoy");
}

#[test]
fn mini_engine_packs_halves_and_writes_in_place() {
    assert_blurs(&make_declared("mini_engine", "mini_engine.toml"));
}

#[test]
fn anki_has_several_techniques_in_a_file() {
    let files = make_declared("anki", "anki.toml");
    let common = files.text("Common.hlsl");
    assert_blurs(&files.with("AnKi/Shaders/Common.hlsl", common));
}

#[test]
fn an_effect_of_reshade_is_named_as_one() {
    let pass = "[[pass]]\nshader = \"Blur.fx\"\nstage = \"fragment\"\nentry = \"Blur\"\n";
    let error = make("reshade", pass).load().unwrap_err().to_string();
    let parts = [
        "Blur.fx:2: is an effect of ReShade by its word ReShade",
        "write its pixel shader as HLSL in a file .hlsl",
    ];
    assert_contains(&error, &parts);
}

#[test]
fn a_macro_of_unity_without_its_include_is_named() {
    let pass = "[[pass]]\nshader = \"buffer.hlsl\"\nstage = \"fragment\"\n[[pass.binding]]\nname = \"color\"\n\
                [[pass.binding]]\nbinding = 0\nvalues = { _Scale = 1 }\n";
    let files = make("reshade", pass);
    let error = files.load().unwrap_err().to_string();
    let parts = [
        "buffer.hlsl:1: uses CBUFFER_START, a macro that Unity defines in Packages/com.unity.render-pipelines.core",
        "`#define CBUFFER_START(name) cbuffer name {`",
    ];
    assert_contains(&error, &parts);
    // The way out.
    let wrapped = files.changed("filter.toml", "buffer.hlsl", "wrapped.hlsl");
    let shown = super::blur_busy(&wrapped);
    assert_eq!(shown, busy_picture().color);
}

#[test]
fn unreal_includes_by_paths_from_the_root() {
    let shader = "#include \"/Engine/Private/Common.ush\"\nTexture2D SceneColor;\n\
                  float4 Main(float4 Position : SV_Position) : SV_Target0 { return GAIN * SceneColor.Load(int3(Position.xy, 0)); }\n";
    let pass = "[[pass]]\nshader = \"Blur.usf\"\nstage = \"fragment\"\nentry = \"Main\"\n\
                [[pass.binding]]\nname = \"SceneColor\"\ntexture = \"color\"\n";
    let files = make("reshade", pass).with("Blur.usf", shader);
    let error = files.load().unwrap_err().to_string();
    let parts = [
        "/Engine/Private/Common.ush",
        "no file of this filter ; copy it to Engine/Private/Common.ush next to the shader",
    ];
    assert_contains(&error, &parts);
    let common = "#pragma once\n#include \"Platform.ush\"\n";
    let files = files.with("Engine/Private/Common.ush", common);
    let shown = super::blur_busy(&files.with("Engine/Private/Platform.ush", "#define GAIN 1.0\n"));
    assert_eq!(shown, busy_picture().color);
}
