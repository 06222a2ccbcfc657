//! Notes about filters that are allowed: a pass over too many pixels, and barriers that only some
//! invocations reach.

use filters::Filter;
use tests::text::assert_contains;

use crate::filter_files::FilterFiles;

const STORED: &str = "    kept[index] = textureLoad(color, vec2<i32>(id.xy), 0);\n";

fn notes() -> FilterFiles {
    FilterFiles::fixture("filters/notes")
}

/// Returns the notes of the filter with a piece of its kernels replaced.
fn list(from: &str, to: &str) -> Vec<String> {
    let files = notes().changed("notes.wgsl", from, to);
    files.load().unwrap().list_notes()
}

#[test]
fn a_kernel_over_the_picture_that_writes_a_smaller_texture_is_noted() {
    let over = "over = \"tiles\"\nworkgroup_per_texel = true\n";
    let listed = notes()
        .changed("filter.toml", over, "")
        .load()
        .unwrap()
        .list_notes();
    assert_eq!(listed.len(), 1, "{listed:?}");
    let parts = [
        "filter.toml:10: pass \"reduce\" has no `over`",
        "add over = \"tiles\"",
    ];
    assert_contains(&listed[0], &parts);
}

#[test]
fn a_barrier_that_only_some_invocations_reach_is_noted() {
    // A reduction in a loop, as everybody writes it.
    assert_eq!(notes().load().unwrap().list_notes(), [""; 0]);
    let after = |lines: &str| format!("{STORED}{lines}");
    let early = "    if !inside(vec2<i32>(id.xy)) { return; }\n";
    #[rustfmt::skip]
    let divergent = [
        (STORED, after(early)),
        (STORED, after("    if kept[index].x > 0.5 { workgroupBarrier(); }\n")),
        (STORED, after("    var i = 0u;\n    loop { if i >= index { break; } i++; workgroupBarrier(); }\n")),
        (STORED, after("    switch index { case 0u: { workgroupBarrier(); } default: {} }\n")),
        ("halve(half, index);", "if half > index { continue; }\n        halve(half, index);".into()),
        ("    workgroupBarrier();\n}", "    if index < half { workgroupBarrier(); }\n}".into()),
        ("half /= 2u", "half /= 1u + min(index, 1u)".into()),
    ];
    for (from, to) in divergent {
        let listed = list(from, &to);
        assert_eq!(listed.len(), 1, "{to}: {listed:?}");
        let parts = [
            "filter.toml:10: pass \"reduce\": only some invocations",
            "a barrier in \"",
        ];
        assert_contains(&listed[0], &parts);
    }
    #[rustfmt::skip]
    let uniform = [
        (STORED, after("    if frame.frame_index > 3u { return; }\n")),
        (STORED, after("    if tile.x > 3u { workgroupBarrier(); }\n")),
        (STORED, after("    var sum = 0.0;\n    for (var i = 0u; i < index; i++) { if i == 3u { break; } sum += 1.0; }\n")),
        ("half > 0u", "half > 0u && textureLoad(color, vec2<i32>(tile.xy), 0).x < 9.0".into()),
    ];
    for (from, to) in uniform {
        assert_eq!(list(from, &to), [""; 0], "{to}");
    }
}

#[test]
fn a_barrier_after_an_early_return_of_glsl_is_noted() {
    let glsl = "#version 450\nlayout(local_size_x = 8, local_size_y = 8) in;\n\
                layout(set = 0, binding = 0) uniform sampler2D color;\n\
                layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D result;\n\
                shared vec4 kept[64];\n\
                void main() {\n\
                ivec2 at = ivec2(gl_GlobalInvocationID.xy);\n\
                EARLY\n\
                kept[gl_LocalInvocationIndex] = texelFetch(color, at, 0);\n\
                for (int i = 0; i < 4; i++) { memoryBarrierShared(); barrier(); }\n\
                imageStore(result, at, kept[63 - gl_LocalInvocationIndex]);\n\
                }\n";
    let manifest = "name = \"mirrored\"\nsummary = \"Mirrors tiles.\"\nalignment = \"trailing\"\n\
                    [[pass]]\nshader = \"mirror.comp\"\n[[pass.binding]]\nname = \"color\"\n\
                    [[pass.binding]]\nname = \"result\"\ntexture = \"output\"\n";
    let load = |early: &str| -> Filter {
        let files = FilterFiles::default().with("filter.toml", manifest);
        files
            .with("mirror.comp", glsl.replace("EARLY", early))
            .load()
            .unwrap()
    };
    assert_eq!(load("").list_notes(), [""; 0]);
    let early = "if (any(greaterThanEqual(at, imageSize(result)))) return;";
    assert_contains(
        &load(early).list_notes()[0],
        &["pass \"mirror\": only some"],
    );
}

#[test]
fn built_in_filters_have_no_notes() {
    for name in Filter::builtin_names() {
        assert_eq!(
            Filter::builtin(&name).unwrap().list_notes(),
            [""; 0],
            "{name}"
        );
    }
}
