//! Fragment shaders over the whole picture.

use std::fs;

use filters::{Blur, Filter, FilterError};
use tests::filter_folder::load_filter;
use tests::open_gpu;

use super::super::folders::example;
use super::{blur, busy_picture, fixtures, head, largest_difference};

const PASSES: &str = r#"[[pass]]
shader = "fastest.wgsl"
entry = "fastest"
stage = "fragment"
targets = ["tile_motion"]

[[pass.binding]]
binding = 0
texture = "velocity"

[[pass.binding]]
group = 1
binding = 0
values = { side = "tile_size" }

[[pass]]
shader = "gather.frag"

[[pass.binding]]
binding = 0
texture = "color"

[[pass.binding]]
binding = 1
texture = "tile_motion"
sampler = "nearest"

[[pass.binding]]
push_constants = true
values = { picture = ["width", "height"], noisy = "spacing" }
"#;

/// A pass in the WGSL of an engine, with groups and names of its own.
const FASTEST: &str = r"
struct Tile { side: i32 }
@group(0) @binding(0) var motion_vectors: texture_2d<f32>;
@group(1) @binding(0) var<uniform> tile: Tile;

struct Corner {
    @builtin(position) position: vec4<f32>,
    @location(0) uv: vec2<f32>,
}

@fragment
fn fastest(in: Corner) -> @location(0) vec2<f32> {
    let size = vec2<i32>(textureDimensions(motion_vectors));
    let corner = vec2<i32>(in.position.xy) * tile.side;
    var fastest = vec2<f32>(0.0);
    for (var y = 0; y < tile.side; y++) {
        for (var x = 0; x < tile.side; x++) {
            let pixel = corner + vec2<i32>(x, y);
            if all(pixel < size) {
                let candidate = textureLoad(motion_vectors, pixel, 0).xy;
                if length(candidate) > length(fastest) {
                    fastest = candidate;
                }
            }
        }
    }
    return fastest;
}
";

fn load(passes: &str, gather: impl Fn(String) -> String) -> Result<Filter, FilterError> {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let fragment = fs::read_to_string(fixtures().join("gather.frag")).unwrap();
    // Keys of the whole filter stand before its first table.
    write(
        "filter.toml",
        &format!("time_limit = 5\n{}{passes}", head()),
    );
    write("fastest.wgsl", FASTEST);
    write("gather.frag", &gather(fragment));
    Filter::load(folder.path())
}

#[test]
fn fragment_shaders_blur_as_kernels_do() {
    let filter = load(PASSES, |text| text).unwrap();
    let kernels = load_filter("centre_blur", example("toml"), example("wgsl")).unwrap();
    let picture = busy_picture();
    for preset in ["fast", "fine"] {
        let [expected, found] = [&kernels, &filter].map(|filter| {
            let settings = filter.settings(Some(preset)).unwrap();
            blur(filter, &settings, &picture)
        });
        // Coordinates are interpolated over the triangle: some 1e-5 of a pixel.
        let difference = largest_difference(&expected, &found);
        assert!(difference < 1e-4, "{preset}: {difference}");
    }
}

#[test]
fn half_floats_keep_three_digits() {
    let halves = "[convention]\ncolor_format = \"rgba16float\"\noutput_format = \"rgba16float\"\n";
    let [full, half] = ["", halves].map(|head| load(&format!("{head}{PASSES}"), |text| text));
    let (full, half) = (full.unwrap(), half.unwrap());
    let picture = busy_picture();
    let settings = full.settings(None).unwrap();
    let [full, half] = [full, half].map(|filter| blur(&filter, &settings, &picture));
    let difference = largest_difference(&full, &half);
    // Half of the last of 11 binary digits, of values below 4, twice.
    assert!(difference > 0.0 && difference < 4e-3, "{difference}");
}

#[test]
fn wrong_targets_are_refused() {
    // (text of the passes, replacement, expected parts of the message)
    #[rustfmt::skip]
    let wrong: &[(&str, &str, &[&str])] = &[
        ("targets = [\"tile_motion\"]", "targets = []", &["targets: allowed: from one to eight"]),
        ("targets = [\"tile_motion\"]", "targets = [\"tiles\"]", &["targets: \"tiles\" is neither output nor a declared texture"]),
        ("targets = [\"tile_motion\"]", "targets = [\"tile_motion\", \"output\"]", &["pass \"fastest\"", "locations [0]", "tile_motion, output in `targets`"]),
        ("targets = [\"tile_motion\"]", "over = \"tile_motion\"", &["over and workgroup_per_texel are for kernels", "runs over its `targets`"]),
        ("stage = \"fragment\"\ntargets = [\"tile_motion\"]", "over = \"tile_motion\"", &["fastest.wgsl", "no compute entry point \"fastest\"", "fastest (fragment)"]),
    ];
    for (from, to, parts) in wrong {
        assert!(PASSES.contains(from), "the passes hold \"{from}\"");
        let message = load(&PASSES.replacen(from, to, 1), |text| text)
            .unwrap_err()
            .to_string();
        for part in *parts {
            assert!(
                message.contains(part),
                "\"{from}\" -> \"{to}\": no \"{part}\" in: {message}"
            );
        }
    }
    let colourless =
        |text: String| text.replace("layout(location = 0) out vec4 result;", "vec4 result;");
    let message = load(PASSES, colourless).unwrap_err().to_string();
    assert!(message.contains("colours to locations []"), "{message}");
}

#[test]
fn broken_pixels_and_endless_loops_are_reported_with_their_pass() {
    let gpu = open_gpu();
    let picture = busy_picture();
    let colors = [&picture.color];
    // (text of gather.frag, replacement, expected part of the message)
    for (from, to, says) in [
        (
            "result = vec4(0.0);",
            "result = vec4(0.0); if (pixel == ivec2(3, 4)) discard;",
            "leaves pixel (3, 4) of the output unwritten",
        ),
        (
            "result = vec4(0.0);",
            "result = vec4(0.0); result.y = pixel == ivec2(3, 4) ? sqrt(uv.x - 9.0) : 0.0;",
            "to pixel (3, 4); every value must be finite",
        ),
        (
            "for (int i = 0; i < params.samples; i++)",
            "for (int i = 0; params.samples > 0; i++)",
            "loop",
        ),
    ] {
        let change = |text: String| {
            assert!(text.contains(from), "gather.frag holds \"{from}\"");
            text.replace(from, to)
        };
        let filter = load(PASSES, change).unwrap();
        let settings = filter.settings(None).unwrap();
        let mut blur = Blur::new(&gpu, &filter, &settings, 61, 43).unwrap();
        let message = blur.run(&picture.input(&colors)).unwrap_err().to_string();
        assert!(
            message.contains("pass gather: ") && message.contains(says),
            "{message}"
        );
    }
}
