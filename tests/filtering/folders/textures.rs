//! Textures that kernels read and write.

use filters::Blur;
use frame::Raster;
use tests::filter_folder::load_filter;
use tests::open_gpu;
use tests::picture::{BLACK_WALL, Picture};
use tests::text::assert_contains;

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
fn a_texture_that_a_pass_reads_and_writes_is_swapped_for_every_colour() {
    let filter = load_filter("shift", SHIFT_MANIFEST, SHIFT_KERNELS).unwrap();
    let gpu = open_gpu();
    for distance in 1..=4 {
        let mut settings = filter.settings(None).unwrap();
        let text = distance.to_string();
        settings.set(&filter, "distance", &text).unwrap();
        let mut blur = Blur::new(&gpu, &filter, &settings, 10, 3).unwrap();
        let colors = [1.0, 2.0]
            .map(|scale| Raster::from_fn(10, 3, |x, y| [scale * x as f32, y as f32, 0.0]));
        let still = Picture::uniform(10, 3, BLACK_WALL);
        let outputs = blur.run(&still.input(&colors.each_ref())).unwrap();
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
    let filter = load_filter("numbers", NUMBERS_MANIFEST, NUMBERS_KERNELS).unwrap();
    let gpu = open_gpu();
    let mut blur = Blur::new(&gpu, &filter, &filter.settings(None).unwrap(), 10, 5).unwrap();
    let still = Picture::uniform(10, 5, BLACK_WALL);
    let outputs = blur.run(&still.input(&[&still.color])).unwrap();
    let number = |x: u32, y: u32| 1 + x / 4 + 16 * (y / 4);
    let expected = Raster::from_fn(10, 5, |x, y| [255.0, number(x, y) as f32, 0.0]);
    assert_eq!(outputs[0], expected);
    // Rounded up, so that the last, partial block is there.
    let blocks = blur.read_texture("blocks").unwrap();
    assert_eq!((blocks.width, blocks.height), (3, 2));
    assert_eq!(blocks.at(2, 1)[0].to_bits(), 0xff00_0001 + 2 + 16);
}

#[test]
fn a_texture_is_read_in_its_own_format() {
    let read = NUMBERS_KERNELS.replace("f32(block >> 24u), f32(block & 0xffu)", "0.0, 0.0");
    let stored = read.replace(
        "vec4<u32>(0xff000001u + id.x + 16u * id.y)",
        "vec4<f32>(0.0)",
    );
    let float = NUMBERS_MANIFEST.replace("r32uint", "r32float");
    #[rustfmt::skip]
    let wrong: [(&str, String, &[&str]); 5] = [
        (NUMBERS_MANIFEST, read.replace("<u32>;", "<f32>;"), &["numbers.wgsl:2:", "\"blocks\" does not fit the declared format r32uint", "texture_2d<u32>"]),
        (&float, stored.replace("r32uint", "r32float"), &["\"blocks\" does not fit the declared format r32float", "texture_2d<f32>"]),
        (NUMBERS_MANIFEST, stored.replace("r32uint", "r32float"), &["\"blocks_out\" writes texture \"blocks\" as r32float", "declared as r32uint"]),
        (NUMBERS_MANIFEST, read.replace("<u32>;", "<i32>;"), &["\"blocks\" cannot be bound", "texture_2d<u32>", "r32uint"]),
        (NUMBERS_MANIFEST, read.replace("blocks:", "depth:").replace("(blocks,", "(depth,"), &["\"depth\" holds floats", "texture_2d<f32>"]),
    ];
    for (manifest, kernels, fragments) in wrong {
        let error = load_filter("numbers", manifest, &kernels).unwrap_err();
        assert_contains(&error.to_string(), fragments);
    }
}

#[test]
fn only_compute_kernels_are_passes() {
    let kernels = SHIFT_KERNELS.replace(
        "@compute @workgroup_size(4, 4)\nfn show(@builtin(global_invocation_id) id: vec3<u32>)",
        "@fragment\nfn show(@builtin(position) id: vec4<f32>)",
    );
    let kernels = kernels.replace("id.xy", "vec2<i32>(id.xy)");
    let error = load_filter("shift", SHIFT_MANIFEST, &kernels).unwrap_err();
    let message = error.to_string();
    assert!(
        message.ends_with("has no such @compute entry point; it has: hold, shift"),
        "{message}"
    );
}
