//! Filter folders from disk: the one in the documentation works, and each wrong one says what is wrong.

use std::path::Path;

use filters::{Blur, Filter, FilterError, Gpu, Input, Settings, Value, list_adapters};
use frame::Raster;

const README: &str = include_str!("../../shaders/README.md");

/// The first code block of that language in shaders/README.md.
fn example(language: &str) -> &'static str {
    let start = README.split_once(&format!("```{language}\n")).unwrap().1;
    start.split_once("```").unwrap().0
}

fn write(folder: &Path, name: &str, manifest: &str, kernels: &str) {
    std::fs::write(folder.join("filter.toml"), manifest).unwrap();
    std::fs::write(folder.join(format!("{name}.wgsl")), kernels).unwrap();
}

/// Loads the example with one piece of its files replaced.
fn load_changed(file: &str, from: &str, to: &str) -> Result<Filter, FilterError> {
    let folder = tempfile::tempdir().unwrap();
    let (mut manifest, mut kernels) = (example("toml").to_owned(), example("wgsl").to_owned());
    let text = match file {
        "filter.toml" => &mut manifest,
        _ => &mut kernels,
    };
    assert!(text.contains(from), "the example holds \"{from}\"");
    *text = text.replacen(from, to, 1);
    write(folder.path(), "centre_blur", &manifest, &kernels);
    Filter::load(folder.path())
}

/// A bar that moves right, at the middle of a wide image.
fn blurred_row(filter: &Filter, settings: &Settings) -> Vec<f32> {
    let gpu = Gpu::new(None).expect("these tests run filters");
    let color = Raster::from_fn(90, 5, |x, _| {
        [if (40..50).contains(&x) { 1.0 } else { 0.0 }; 3]
    });
    let velocity = Raster::filled(90, 5, [20.0, 0.0]);
    let depth = Raster::filled(90, 5, 3.0);
    let mut blur = Blur::new(&gpu, filter, settings, 90, 5).unwrap();
    let input = Input {
        color: &[&color],
        velocity: &velocity,
        depth: &depth,
        reprojection: None,
        exposure: 0.5,
        frame_index: 0,
    };
    let output = blur.run(&input).unwrap();
    (0..90).map(|x| output[0].at(x, 2)[0]).collect()
}

#[test]
fn the_documented_example_loads_from_a_folder_and_blurs() {
    let folder = tempfile::tempdir().unwrap();
    write(
        folder.path(),
        "centre_blur",
        example("toml"),
        example("wgsl"),
    );
    let filter = Filter::load(folder.path()).unwrap();
    assert_eq!(filter.alignment, frame::Alignment::Centred);
    let settings = filter.settings(None).unwrap();
    assert_eq!(settings.preset, "fast");
    let row = blurred_row(&filter, &settings);
    // Ten pixels of motion on ten pixels of bar: a triangle over 35 to 55.
    let energy: f32 = row.iter().sum();
    assert!(
        (energy - 10.0).abs() < 1e-4,
        "taps of one weight move light, and add none: {energy}"
    );
    let centre: f32 = row
        .iter()
        .enumerate()
        .map(|(x, v)| (x as f32 + 0.5) * v)
        .sum::<f32>()
        / energy;
    assert!(
        (centre - 45.0).abs() < 1e-3,
        "a centred blur stays where it was: {centre}"
    );
    let reach: Vec<usize> = (0..90).filter(|x| row[*x] > 0.0).collect();
    assert_eq!((reach[0], reach[reach.len() - 1]), (35, 54));
}

const SHIFT_MANIFEST: &str = r#"
name = "shift"
summary = "Moves the image right by one pixel per iteration."
alignment = "trailing"

[[parameter]]
name = "distance"
kind = "integer"
default = 3
range = [1, 9]
doc = "In pixels; each costs one pass."

[[texture]]
name = "held"
format = "rgba32float"

[[pass]]
entry = "hold"

[[pass]]
entry = "shift"
repeat = "distance"

[[pass]]
entry = "show"
"#;

const SHIFT_KERNELS: &str = "
struct Parameters {
    distance: i32,
}
@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var held: texture_2d<f32>;
@group(0) @binding(4) var held_out: texture_storage_2d<rgba32float, write>;
@group(0) @binding(5) var output: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(4, 4)
fn hold(@builtin(global_invocation_id) id: vec3<u32>) {
    textureStore(held_out, id.xy, textureLoad(color, id.xy, 0));
}

@compute @workgroup_size(4, 4)
fn shift(@builtin(global_invocation_id) id: vec3<u32>) {
    let left = max(vec2<i32>(id.xy) - vec2<i32>(1, 0), vec2<i32>(0));
    textureStore(held_out, id.xy, textureLoad(held, left, 0));
}

@compute @workgroup_size(4, 4)
fn show(@builtin(global_invocation_id) id: vec3<u32>) {
    if inside(vec2<i32>(id.xy)) {
        textureStore(output, id.xy, textureLoad(held, id.xy, 0));
    }
}
";

#[test]
fn a_texture_that_a_pass_reads_and_writes_is_exchanged_for_every_colour() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "shift", SHIFT_MANIFEST, SHIFT_KERNELS);
    let filter = Filter::load(folder.path()).unwrap();
    let gpu = Gpu::new(None).expect("these tests run filters");
    for distance in 1..=4 {
        let mut settings = filter.settings(None).unwrap();
        let text = distance.to_string();
        settings.set(&filter, "distance", &text).unwrap();
        let mut blur = Blur::new(&gpu, &filter, &settings, 10, 3).unwrap();
        let colors = [1.0, 2.0]
            .map(|scale| Raster::from_fn(10, 3, |x, y| [scale * x as f32, y as f32, 0.0]));
        let outputs = blur
            .run(&Input {
                color: &[&colors[0], &colors[1]],
                velocity: &Raster::filled(10, 3, [0.0; 2]),
                depth: &Raster::filled(10, 3, 1.0),
                reprojection: None,
                exposure: 1.0,
                frame_index: 0,
            })
            .unwrap();
        for (color, output) in colors.iter().zip(&outputs) {
            let expected = Raster::from_fn(10, 3, |x, y| *color.at(x.saturating_sub(distance), y));
            assert_eq!(*output, expected, "by {distance} pixels");
        }
    }
}

const NUMBERS_MANIFEST: &str = r#"
name = "numbers"
summary = "Numbers the blocks of an image, with more bits than a float holds."
alignment = "trailing"

[[texture]]
name = "blocks"
format = "r32uint"
divided_by = 4

[[pass]]
entry = "number"
over = "blocks"

[[pass]]
entry = "show"
"#;

const NUMBERS_KERNELS: &str = "
@group(0) @binding(1) var blocks: texture_2d<u32>;
@group(0) @binding(2) var blocks_out: texture_storage_2d<r32uint, write>;
@group(0) @binding(3) var output: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(4, 4)
fn number(@builtin(global_invocation_id) id: vec3<u32>) {
    textureStore(blocks_out, id.xy, vec4<u32>(0xff000001u + id.x + 16u * id.y));
}

@compute @workgroup_size(4, 4)
fn show(@builtin(global_invocation_id) id: vec3<u32>) {
    let block = textureLoad(blocks, id.xy / 4u, 0).x;
    textureStore(output, id.xy, vec4<f32>(f32(block >> 24u), f32(block & 0xffu), 0.0, 0.0));
}
";

#[test]
fn whole_numbers_keep_every_bit_in_a_texture_of_a_fixed_fraction() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "numbers", NUMBERS_MANIFEST, NUMBERS_KERNELS);
    let filter = Filter::load(folder.path()).unwrap();
    let gpu = Gpu::new(None).expect("these tests run filters");
    let mut blur = Blur::new(&gpu, &filter, &filter.settings(None).unwrap(), 10, 5).unwrap();
    let color = Raster::filled(10, 5, [0.0; 3]);
    let outputs = blur
        .run(&Input {
            color: &[&color],
            velocity: &Raster::filled(10, 5, [0.0; 2]),
            depth: &Raster::filled(10, 5, 1.0),
            reprojection: None,
            exposure: 1.0,
            frame_index: 0,
        })
        .unwrap();
    let number = |x: u32, y: u32| 1 + x / 4 + 16 * (y / 4);
    let expected = Raster::from_fn(10, 5, |x, y| [255.0, number(x, y) as f32, 0.0]);
    assert_eq!(outputs[0], expected);
    // Rounded up, so that the last block is there though it is not whole.
    let blocks = blur.texture("blocks").unwrap();
    assert_eq!((blocks.width, blocks.height), (3, 2));
    assert_eq!(blocks.at(2, 1)[0].to_bits(), 0xff00_0001 + 2 + 16);
}

#[test]
fn a_texture_is_read_as_what_it_holds() {
    let read = NUMBERS_KERNELS.replace("f32(block >> 24u), f32(block & 0xffu)", "0.0, 0.0");
    let stored = read.replace(
        "vec4<u32>(0xff000001u + id.x + 16u * id.y)",
        "vec4<f32>(0.0)",
    );
    let float = NUMBERS_MANIFEST.replace("r32uint", "r32float");
    #[rustfmt::skip]
    let wrong: [(&str, String, &[&str]); 5] = [
        (NUMBERS_MANIFEST, read.replace("<u32>;", "<f32>;"), &["numbers.wgsl:2:", "\"blocks\" does not fit the declared format R32Uint", "texture_2d<u32>"]),
        (&float, stored.replace("r32uint", "r32float"), &["\"blocks\" does not fit the declared format R32Float", "texture_2d<f32>"]),
        (NUMBERS_MANIFEST, stored.replace("r32uint", "r32float"), &["\"blocks_out\" has format R32Float", "R32Uint"]),
        (NUMBERS_MANIFEST, read.replace("<u32>;", "<i32>;"), &["\"blocks\" cannot be bound", "texture_2d<u32>", "r32uint"]),
        (NUMBERS_MANIFEST, read.replace("blocks:", "depth:").replace("(blocks,", "(depth,"), &["\"depth\" holds floats", "texture_2d<f32>"]),
    ];
    for (manifest, kernels, fragments) in wrong {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), "numbers", manifest, &kernels);
        let message = Filter::load(folder.path()).unwrap_err().to_string();
        for fragment in fragments {
            assert!(
                message.contains(fragment),
                "\"{fragment}\" is missing from: {message}"
            );
        }
    }
}

#[test]
fn the_smallest_reach_that_covers_a_trail_is_set() {
    let flood = Filter::builtin("jump_flood").unwrap();
    let passes = |preset: &str, pixels: u32| {
        let settings = flood.settings(Some(preset)).unwrap();
        let reaching = settings.reaching(&flood, pixels).unwrap();
        reaching.values["passes"].clone()
    };
    // Largest steps of 8, 16 and 128 pixels; then of 1, 16 and 128.
    for (preset, pixels, expected) in [
        ("paper", 1, 1),
        ("paper", 8, 1),
        ("paper", 9, 2),
        ("paper", 128, 5),
        ("corrected", 1, 1),
        ("corrected", 16, 5),
        ("corrected", 128, 8),
    ] {
        assert_eq!(
            passes(preset, pixels),
            Value::Integer(expected),
            "{preset}, {pixels}"
        );
    }
    let settings = flood.settings(None).unwrap();
    let message = settings.reaching(&flood, 1 << 20).unwrap_err().to_string();
    assert_eq!(
        message,
        "jump_flood.passes: found 18; allowed: a whole number from 1 to 12"
    );
    let gather = Filter::builtin("velocity_gather").unwrap();
    let settings = gather.settings(None).unwrap();
    assert_eq!(settings.reaching(&gather, 256).unwrap(), settings);
}

#[test]
fn built_in_folders_load_from_disk_alike() {
    let shaders = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shaders");
    let folders = std::fs::read_dir(&shaders).unwrap().map(Result::unwrap);
    let mut names: Vec<String> = folders
        .filter(|entry| entry.path().is_dir())
        .map(|entry| entry.file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert!(names.len() > 1);
    assert_eq!(Filter::builtin_names(), names);
    for name in Filter::builtin_names() {
        let (built_in, on_disk) = (
            Filter::builtin(&name).unwrap(),
            Filter::load(&shaders.join(&name)).unwrap(),
        );
        assert_eq!(built_in.name, name);
        assert_eq!(built_in.parameters, on_disk.parameters);
        assert_eq!(built_in.presets, on_disk.presets);
        for said in [
            &built_in.summary,
            &built_in.source,
            &built_in.reach,
            &built_in.cannot,
        ] {
            assert!(
                !said.is_empty(),
                "{name} says what it is and what it cannot do"
            );
        }
    }
}

#[test]
fn a_wrong_folder_says_where_and_what() {
    // (file, text, what replaces it, what the message must say)
    #[rustfmt::skip]
    let wrong: &[(&str, &str, &str, &[&str])] = &[
        ("filter.toml", "summary =", "sumary =", &["filter.toml:2:", "unknown field `sumary`", "expected one of"]),
        ("filter.toml", "alignment = \"centred\"", "", &["missing field `alignment`"]),
        ("filter.toml", "\"centred\"", "\"central\"", &["filter.toml:3:", "central", "trailing, centred, leading"]),
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
        ("filter.toml", "rg32float", "rgba32float", &["centre_blur.wgsl:11:", "tile_motion_out", "Rg32Float", "Rgba32Float"]),
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
        ("filter.toml", "[[pass]]\nentry = \"fastest\"\nover = \"tile_motion\"\n", "", &["gather", "reads \"tile_motion\" before"]),
        ("filter.toml", "[[pass]]\nentry = \"gather\"\n", "", &["no pass writes \"output\""]),
        ("filter.toml", "name = \"tile_size\"\nkind = \"integer\"\ndefault = 16\nrange = [2, 64]", "name = \"tile_size\"\nkind = \"integer\"\ndefault = 16\nrange = [0, 64]", &["tile_motion", "begins at 1"]),
        ("filter.toml", "divided_by = \"tile_size\"", "divided_by = 1\nholds = \"places\"", &["tile_motion", "holds = \"places\"", "rg32float or rgba32float, and no divided_by"]),
        ("filter.toml", "divided_by = \"tile_size\"", "divided_by = 0", &["tile_motion", "divided_by = 0", "1 pixel or more"]),
        ("filter.toml", "divided_by = \"tile_size\"", "divided_by = 1.5", &["a number of pixels or the name of an integer parameter"]),
        ("filter.toml", "[[preset]]", "[reach_by]\nparameter = \"spacing\"\ngrowth = \"linear\"\n[[preset]]", &["filter.toml:", "reach_by", "\"spacing\" is not an integer"]),
        ("filter.toml", "[[preset]]", "[reach_by]\nparameter = \"tile_size\"\ngrowth = \"linear\"\nunit = \"side\"\n[[preset]]", &["reach_by", "unit", "\"side\" is no parameter"]),
        ("filter.toml", "[[preset]]", "[reach_by]\nparameter = \"tile_size\"\ngrowth = \"slow\"\n[[preset]]", &["slow", "linear", "doubling"]),
        ("kernels", "    samples: i32,\n", "", &["centre_blur.wgsl:", "samples"]),
        ("kernels", "    samples: i32,\n    tile_size: i32,", "    tile_size: i32,\n    samples: i32,", &["member 1", "tile_size", "filter.toml:5"]),
        ("filter.toml", "kind = \"integer\"", "kind = \"real\"", &["centre_blur.wgsl:7:", "samples: i32 at byte 0", "filter.toml:5 declares samples: f32 at byte 0"]),
        ("kernels", "    tile_size: i32,", "    @align(16) tile_size: i32,", &["at byte 16", "at byte 4"]),
        ("kernels", "    spacing: u32,", "    spacing: u32,\n    more: f32,", &["\"more\"", "does not declare"]),
        ("filter.toml", "[[preset]]", "[[parameter]]\nname = \"bias\"\nkind = \"real\"\ndefault = 0\nrange = [0, 1]\ndoc = \"\"\n[[preset]]", &["filter.toml:27", "\"bias\" is not a member", "centre_blur.wgsl", "`bias: f32,`"]),
        ("kernels", "var color:", "var colour:", &["centre_blur.wgsl:", "color"]),
        ("kernels", "var velocity: texture_2d<f32>;", "var velocity: texture_2d<f32>;\n@group(0) @binding(9) var normals: texture_2d<f32>;", &["centre_blur.wgsl:10:", "\"normals\" is unknown", "tile_motion"]),
        ("kernels", "@group(0) @binding(2)", "@group(1) @binding(2)", &["centre_blur.wgsl:8:", "only @group(0)"]),
        ("kernels", "var color: texture_2d<f32>", "var color: texture_depth_2d", &["centre_blur.wgsl"]),
        ("kernels", "let tile = vec2<i32>(id.xy);", "let tile = vec2<i32>(id.xy)", &["centre_blur.wgsl:", "expected `;`"]),
        ("kernels", "let tile = vec2<i32>(id.xy);", "let tile = id.xy;", &["centre_blur.wgsl:"]),
        ("kernels", "fn gather(", "fn bilinear() {}\n@compute @workgroup_size(8, 8)\nfn gather(", &["centre_blur.wgsl", "bilinear"]),
        ("kernels", "rgba32float, write", "rgba8unorm, write", &["\"output\" cannot be bound", "rgba32float"]),
    ];
    for (file, from, to, fragments) in wrong {
        let Err(error) = load_changed(file, from, to) else {
            panic!("{file}: \"{from}\" -> \"{to}\" was accepted");
        };
        let message = error.to_string();
        for fragment in *fragments {
            assert!(
                message.contains(fragment),
                "\"{from}\" -> \"{to}\" must say \"{fragment}\"; it says:\n{message}"
            );
        }
    }
}

#[test]
fn only_compute_kernels_are_passes() {
    let kernels = SHIFT_KERNELS.replace(
        "@compute @workgroup_size(4, 4)\nfn show(@builtin(global_invocation_id) id: vec3<u32>)",
        "@fragment\nfn show(@builtin(position) id: vec4<f32>)",
    );
    let kernels = kernels.replace("id.xy", "vec2<i32>(id.xy)");
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "shift", SHIFT_MANIFEST, &kernels);
    let message = Filter::load(folder.path()).unwrap_err().to_string();
    assert!(
        message.ends_with("has no such @compute entry point; it has: hold, shift"),
        "{message}"
    );
}

#[test]
fn a_missing_folder_names_the_file_it_looked_for() {
    let message = Filter::load(Path::new("no/such/folder"))
        .unwrap_err()
        .to_string();
    assert!(
        message.starts_with("no/such/folder/filter.toml: cannot be read"),
        "{message}"
    );
}

#[test]
fn unknown_names_list_what_there_is() {
    let filter = Filter::builtin("velocity_gather").unwrap();
    let unknown = Filter::builtin("bokeh").unwrap_err().to_string();
    assert!(
        unknown.contains("bokeh") && unknown.contains(&Filter::builtin_names().join(", ")),
        "{unknown}"
    );
    let preset = filter.settings(Some("best")).unwrap_err().to_string();
    assert!(
        preset.contains("best") && preset.contains("departure, coarse, fine"),
        "{preset}"
    );
    let mut settings = filter.settings(None).unwrap();
    for (parameter, text, says) in [
        (
            "sample",
            "8",
            "velocity_gather.sample: the filter has no such parameter; allowed: samples, intensity",
        ),
        (
            "samples",
            "900",
            "velocity_gather.samples: found 900; allowed: a whole number from 1 to 64",
        ),
        (
            "samples",
            "8.5",
            "velocity_gather.samples: found 8.5; allowed: a whole number from 1 to 64",
        ),
        (
            "intensity",
            "NaN",
            "velocity_gather.intensity: found NaN; allowed: a number from 0 to 4",
        ),
    ] {
        let message = settings
            .set(&filter, parameter, text)
            .unwrap_err()
            .to_string();
        assert_eq!(message, says);
    }
    settings.set(&filter, "samples", "12").unwrap();
    assert_eq!(settings.values["samples"], Value::Integer(12));
    assert_eq!(
        settings
            .set_value(&filter, "samples", Value::Real(12.0))
            .unwrap_err()
            .to_string(),
        "velocity_gather.samples: found 12; allowed: a whole number from 1 to 64"
    );
    let nothing = Filter::builtin("identity").unwrap();
    let message = nothing
        .settings(None)
        .unwrap()
        .set(&nothing, "samples", "1")
        .unwrap_err();
    assert!(message.to_string().contains("it has none"), "{message}");
}

#[test]
fn settings_of_another_filter_are_refused() {
    let gpu = Gpu::new(None).expect("these tests run filters");
    let (gather, flood) = (
        Filter::builtin("velocity_gather").unwrap(),
        Filter::builtin("jump_flood").unwrap(),
    );
    let settings = gather.settings(None).unwrap();
    assert!(matches!(
        Blur::new(&gpu, &flood, &settings, 8, 8),
        Err(FilterError::Parameter { .. })
    ));
}

#[test]
fn what_the_gpu_refuses_names_file_and_pass() {
    let gpu = Gpu::new(None).expect("these tests run filters");
    let filter = load_changed(
        "kernels",
        "@workgroup_size(8, 8)\nfn gather",
        "@workgroup_size(999, 999)\nfn gather",
    );
    let filter = filter.expect("how large a workgroup may be, only the adapter knows");
    let error = Blur::new(&gpu, &filter, &filter.settings(None).unwrap(), 8, 8).unwrap_err();
    let message = error.to_string();
    assert!(matches!(error, FilterError::Folder { .. }), "{message}");
    assert!(
        message.contains("centre_blur.wgsl:33: pass \"gather\": @workgroup_size(999, 999, 1)"),
        "{message}"
    );
}

#[test]
fn sizes_that_no_adapter_holds_are_refused_before_anything_is_allocated() {
    let gpu = Gpu::new(None).expect("these tests run filters");
    let filter = Filter::builtin("identity").unwrap();
    let settings = filter.settings(None).unwrap();
    for (width, height) in [(1 << 20, 1), (1, 1 << 20), (0, 4), (4, 0)] {
        let error = Blur::new(&gpu, &filter, &settings, width, height).unwrap_err();
        let message = error.to_string();
        assert!(matches!(error, FilterError::Size { .. }), "{message}");
        assert!(message.contains(&format!("{width}x{height}")), "{message}");
        assert!(message.contains("allow"), "{message}");
    }
}

#[test]
fn frames_that_cannot_be_blurred_are_refused() {
    let gpu = Gpu::new(None).expect("these tests run filters");
    let filter = Filter::builtin("identity").unwrap();
    let mut blur = Blur::new(&gpu, &filter, &filter.settings(None).unwrap(), 4, 3).unwrap();
    let color = Raster::filled(4, 3, [0.5; 3]);
    let velocity = Raster::filled(4, 3, [1.0, 2.0]);
    let depth = Raster::filled(4, 3, 2.0);
    let input = Input {
        color: &[&color],
        velocity: &velocity,
        depth: &depth,
        reprojection: None,
        exposure: 0.5,
        frame_index: 0,
    };
    blur.run(&input).expect("this frame can be blurred");
    let mut broken_velocity = velocity.clone();
    broken_velocity.pixels[6] = [f32::NAN, 0.0];
    let mut broken_depth = depth.clone();
    broken_depth.pixels[3] = 0.0;
    let mut broken_color = color.clone();
    broken_color.pixels[4] = [0.0, f32::INFINITY, 0.0];
    let narrow = Raster::filled(3, 3, 2.0);
    let colors = [&color, &broken_color];
    for (input, says) in [
        (
            Input {
                exposure: 0.0,
                ..input
            },
            "exposure is 0 frames",
        ),
        (
            Input {
                exposure: f64::NAN,
                ..input
            },
            "exposure is NaN frames",
        ),
        (
            Input {
                velocity: &broken_velocity,
                ..input
            },
            "velocity at (2, 1) is not finite",
        ),
        (
            Input {
                depth: &broken_depth,
                ..input
            },
            "depth at (3, 0) is not finite and above 0",
        ),
        (
            Input {
                color: &colors,
                ..input
            },
            "color at (0, 1) is not finite",
        ),
        (
            Input {
                depth: &narrow,
                ..input
            },
            "depth has 3x3 pixels; this blur was made for 4x3",
        ),
    ] {
        let message = blur.run(&input).unwrap_err().to_string();
        assert!(
            message.starts_with(&format!("filter identity: {says}")),
            "{message}"
        );
    }
}

#[test]
fn adapters_are_chosen_by_index_or_name_and_a_wrong_name_lists_them() {
    let adapters = list_adapters();
    assert!(
        !adapters.is_empty(),
        "these tests run filters: {}",
        FilterError::NoAdapter
    );
    assert_eq!(Gpu::new(Some("0")).unwrap().adapter, adapters[0]);
    let part: String = adapters[0].name.to_uppercase().chars().take(5).collect();
    assert_eq!(
        Gpu::new(Some(&part)).unwrap().adapter.name,
        adapters[0].name
    );
    for wanted in ["no such card", "99"] {
        let message = Gpu::new(Some(wanted)).unwrap_err().to_string();
        assert!(
            message.contains(wanted) && message.contains(&adapters[0].name),
            "{message}"
        );
    }
    assert!(
        FilterError::NoAdapter
            .to_string()
            .contains("mesa-vulkan-drivers")
    );
}
