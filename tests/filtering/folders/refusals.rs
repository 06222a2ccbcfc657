//! Wrong folders, and their error messages.

use std::path::Path;

use filters::{Filter, FilterError};
use tests::text::assert_contains;

use super::documented;
use crate::filter_files::ready;

#[test]
fn a_wrong_folder_is_refused_with_place_and_reason() {
    // (file, text, replacement, expected part of the message)
    #[rustfmt::skip]
    let wrong: &[(&str, &str, &str, &[&str])] = &[
        ("filter.toml", "summary =", "sumary =", &["filter.toml:2:", "unknown field `sumary`", "expected one of"]),
        ("filter.toml", "alignment = \"centred\"", "", &["missing field `alignment`"]),
        ("filter.toml", "\"centred\"", "\"central\"", &["filter.toml:3:", "central", "`trailing`, `centred`, `leading`"]),
        ("filter.toml", "\"centre_blur\"", "\"Centre Blur\"", &["filter.toml:1:", "Centre Blur", "a-z"]),
        ("filter.toml", "\"centre_blur\"", "\"other\"", &["other.wgsl", "cannot be read"]),
        ("filter.toml", "default = 8", "default = 65", &["filter.toml:5:", "samples", "65", "a whole number from 2 to 64"]),
        ("filter.toml", "default = 8", "default = 8.5", &["samples", "8.5"]),
        ("filter.toml", "default = \"even\"", "default = \"odd\"", &["spacing", "odd", "one of even, noisy"]),
        ("filter.toml", "range = [2, 64]", "range = [64, 2]", &["samples", "range [64, 2] is empty"]),
        ("filter.toml", "range = [2, 64]", "", &["samples", "a number has a range"]),
        ("filter.toml", "range = [2, 64]", "range = [0, 64]", &["samples", "above 0"]),
        ("filter.toml", "choices = [\"even\", \"noisy\"]", "choices = [\"even\"]", &["spacing", "at least two"]),
        ("filter.toml", "kind = \"choice\"", "kind = \"real\"\nrange = [0, 1]", &["spacing", "no choices"]),
        ("filter.toml", "kind = \"choice\"", "kind = \"flag\"", &["flag", "integer", "choice"]),
        ("filter.toml", "name = \"tile_size\"", "name = \"samples\"", &["samples", "declared twice"]),
        ("filter.toml", "values = { samples = 30", "values = { sample = 30", &["filter.toml:", "preset \"fine\"", "sample is no parameter"]),
        ("filter.toml", "values = { samples = 30", "values = { samples = 300", &["preset \"fine\"", "samples = 300", "from 2 to 64"]),
        ("filter.toml", "name = \"fine\"", "name = \"fast\"", &["preset \"fast\"", "no two presets"]),
        ("filter.toml", "name = \"fine\"", "name = \"fine\"\ntuned = { by = \"a\", from = \"slow\", seed = 1, trials = 9, size = [8, 8], samples_per_pixel = 8, scenes = [] }", &["filter.toml:", "preset \"fine\"", "tuned from \"slow\", which is no preset before it"]),
        ("filter.toml", "name = \"fine\"", "name = \"fine\"\ntuned = { by = \"a\", from = \"fast\" }", &["filter.toml:", "missing field", "seed"]),
        ("filter.toml", "rg32float", "rg8unorm", &["rg8unorm", "rg32float"]),
        ("filter.toml", "rg32float", "rgba32float", &["centre_blur.wgsl:11:", "tile_motion_out", "rg32float", "rgba32float"]),
        ("filter.toml", "divided_by = \"tile_size\"", "divided_by = \"spacing\"", &["tile_motion", "spacing", "integer parameter"]),
        ("filter.toml", "divided_by = \"tile_size\"", "divided_by = \"tile\"", &["tile_motion", "\"tile\" is no parameter"]),
        ("filter.toml", "[[texture]]", "[[texture]]\nname = \"tile_motion\"\nformat = \"r32float\"\n[[texture]]", &["tile_motion", "declared twice"]),
        ("filter.toml", "[[texture]]", "[[texture]]\nname = \"depth\"\nformat = \"r32float\"\n[[texture]]", &["\"depth\"", "none of color"]),
        ("filter.toml", "[[texture]]", "[[texture]]\nname = \"spare\"\nformat = \"r32float\"\n[[texture]]", &["spare", "used by no pass"]),
        ("filter.toml", "over = \"tile_motion\"", "over = \"tiles\"", &["fastest", "tiles", "no declared texture"]),
        ("filter.toml", "over = \"tile_motion\"", "repeat = \"spacing\"", &["fastest", "spacing", "integer parameter"]),
        ("filter.toml", "over = \"tile_motion\"", "workgroup_per_texel = true", &["fastest", "workgroup_per_texel = true without over"]),
        ("filter.toml", "over = \"tile_motion\"", "over = \"tile_motion\"\nworkgroup_per_texel = 8", &["filter.toml:", "expected a boolean"]),
        ("filter.toml", "over = \"tile_motion\"", "repeat = 0", &["fastest", "1 or more"]),
        ("filter.toml", "over = \"tile_motion\"", "repeat = 1.5", &["repeat is a count"]),
        ("filter.toml", "entry = \"gather\"", "entry = \"blur\"", &["blur", "no such @compute entry point", "fastest, gather"]),
        ("centre_blur.wgsl", "@compute @workgroup_size(8, 8)\nfn gather(@builtin(global_invocation_id) id: vec3<u32>)", "@fragment\nfn gather(@builtin(position) id: vec4<f32>)", &["gather", "has no such @compute entry point; it has: fastest"]),
        ("filter.toml", "[[pass]]\nentry = \"fastest\"\nover = \"tile_motion\"\n", "", &["gather", "reads \"tile_motion\" before"]),
        ("filter.toml", "[[pass]]\nentry = \"gather\"\n", "", &["no pass writes \"output\""]),
        ("filter.toml", "name = \"tile_size\"\nkind = \"integer\"\ndefault = 16\nrange = [2, 64]", "name = \"tile_size\"\nkind = \"integer\"\ndefault = 16\nrange = [0, 64]", &["tile_motion", "a range from 1"]),
        ("filter.toml", "divided_by = \"tile_size\"", "divided_by = 1\nholds = \"places\"", &["tile_motion", "holds = \"places\"", "rg32float or rgba32float, and no divided_by"]),
        ("filter.toml", "divided_by = \"tile_size\"", "divided_by = 0", &["tile_motion", "divided_by = 0", "1 pixel or more"]),
        ("filter.toml", "divided_by = \"tile_size\"", "divided_by = 1.5", &["a number of pixels or the name of an integer parameter"]),
        ("filter.toml", "[[preset]]", "[reach_by]\nparameter = \"spacing\"\ngrowth = \"linear\"\n[[preset]]", &["filter.toml:", "reach_by", "\"spacing\" is not an integer"]),
        ("filter.toml", "[[preset]]", "[reach_by]\nparameter = \"tile_size\"\ngrowth = \"linear\"\nunit = \"side\"\n[[preset]]", &["reach_by", "unit", "\"side\" is no parameter"]),
        ("filter.toml", "[[preset]]", "[reach_by]\nparameter = \"tile_size\"\ngrowth = \"slow\"\n[[preset]]", &["slow", "linear", "doubling"]),
        ("centre_blur.wgsl", "    samples: i32,\n", "", &["centre_blur.wgsl:", "samples"]),
        ("centre_blur.wgsl", "    samples: i32,\n    tile_size: i32,", "    tile_size: i32,\n    samples: i32,", &["member 1", "tile_size", "filter.toml:5"]),
        ("filter.toml", "kind = \"integer\"", "kind = \"real\"", &["centre_blur.wgsl:7:", "samples: i32 at byte 0", "filter.toml:5 declares samples: f32 at byte 0"]),
        ("centre_blur.wgsl", "    tile_size: i32,", "    @align(16) tile_size: i32,", &["at byte 16", "at byte 4"]),
        ("centre_blur.wgsl", "    spacing: u32,", "    spacing: u32,\n    more: f32,", &["\"more\"", "does not declare"]),
        ("filter.toml", "[[preset]]", "[[parameter]]\nname = \"bias\"\nkind = \"real\"\ndefault = 0\nrange = [0, 1]\ndoc = \"\"\n[[preset]]", &["filter.toml:27", "\"bias\" is not a member", "centre_blur.wgsl", "`bias: f32,`"]),
        ("centre_blur.wgsl", "var color:", "var colour:", &["centre_blur.wgsl:", "color"]),
        ("centre_blur.wgsl", "var velocity: texture_2d<f32>;", "var velocity: texture_2d<f32>;\n@group(0) @binding(9) var normals: texture_2d<f32>;", &["centre_blur.wgsl:10:", "\"normals\" is no known input or output", "tile_motion"]),
        ("centre_blur.wgsl", "@group(0) @binding(2)", "@group(1) @binding(2)", &["centre_blur.wgsl:8:", "only @group(0)"]),
        ("centre_blur.wgsl", "var color: texture_2d<f32>", "var color: texture_depth_2d", &["centre_blur.wgsl"]),
        ("centre_blur.wgsl", "let tile = vec2<i32>(id.xy);", "let tile = vec2<i32>(id.xy)", &["centre_blur.wgsl:", "expected `;`"]),
        ("centre_blur.wgsl", "let tile = vec2<i32>(id.xy);", "let tile = id.xy;", &["centre_blur.wgsl:"]),
        ("centre_blur.wgsl", "fn gather(", "fn bilinear() {}\n@compute @workgroup_size(8, 8)\nfn gather(", &["centre_blur.wgsl", "bilinear"]),
        ("centre_blur.wgsl", "rgba32float, write", "rgba8unorm, write", &["writes \"output\" as rgba8unorm", "rgba32float or rgba16float"]),
        ("centre_blur.wgsl", "rgba32float, write", "rgba8snorm, write", &["\"output\" cannot be bound", "rgba32float"]),
    ];
    for (file, from, to, parts) in wrong {
        documented().assert_refused(file, &[(from, to, parts)]);
    }
}

#[test]
fn a_missing_folder_names_the_file_it_looked_for() {
    let error = Filter::load(Path::new("no/such/folder")).unwrap_err();
    let parts = ["no/such/folder/filter.toml: cannot be read"];
    assert_contains(&error.to_string(), &parts);
}

#[test]
fn an_error_of_the_gpu_names_file_and_pass() {
    let large = documented().changed(
        "centre_blur.wgsl",
        "@workgroup_size(8, 8)\nfn gather",
        "@workgroup_size(999, 999)\nfn gather",
    );
    // Only the adapter knows the largest workgroup.
    let error = ready(&large.load().unwrap(), (8, 8)).unwrap_err();
    assert!(matches!(error, FilterError::Folder { .. }), "{error}");
    let parts = ["centre_blur.wgsl:33: pass \"gather\": @workgroup_size(999, 999, 1)"];
    assert_contains(&error.to_string(), &parts);
}
