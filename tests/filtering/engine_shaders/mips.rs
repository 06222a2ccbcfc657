//! Textures with mip levels: a pyramid of the fastest motions, level by level.

use filters::{Blur, Filter};
use frame::{Image, Raster};
use tests::open_gpu;

use super::{assert_refused, blur, busy_picture, largest_difference, make};

const SPEED: &str = r"#version 450
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D velocity;
layout(r32f, set = 0, binding = 1) uniform writeonly image2D speeds;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, imageSize(speeds)))) {
        imageStore(speeds, pixel, vec4(length(texelFetch(velocity, pixel, 0).xy)));
    }
}
";

/// Takes the fastest of 2 x 2 texels, and of the odd ones at the border.
const HALVE: &str = r"#version 450
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D finer;
layout(r32f, set = 0, binding = 1) uniform writeonly image2D coarser;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = imageSize(coarser);
    if (any(greaterThanEqual(texel, size))) {
        return;
    }
    ivec2 last = textureSize(finer, 0) - 1;
    ivec2 reach = mix(ivec2(1), ivec2(2), equal(texel, size - 1));
    float fastest = 0.0;
    for (int y = 0; y <= reach.y; y++) {
        for (int x = 0; x <= reach.x; x++) {
            fastest = max(fastest, texelFetch(finer, min(2 * texel + ivec2(x, y), last), 0).x);
        }
    }
    imageStore(coarser, texel, vec4(fastest));
}
";

/// The same as a fragment shader.
const HALVE_FRAGMENT: &str = r"
@group(0) @binding(0) var finer: texture_2d<f32>;

@fragment
fn main(@builtin(position) position: vec4<f32>) -> @location(0) f32 {
    let texel = vec2<i32>(position.xy);
    let last = vec2<i32>(textureDimensions(finer)) - 1;
    let size = max((last + 1) / 2, vec2<i32>(1));
    let reach = select(vec2<i32>(1), vec2<i32>(2), texel == size - 1);
    var fastest = 0.0;
    for (var y = 0; y <= reach.y; y++) {
        for (var x = 0; x <= reach.x; x++) {
            fastest = max(fastest, textureLoad(finer, min(2 * texel + vec2<i32>(x, y), last), 0).x);
        }
    }
    return fastest;
}
";

const SHOW: &str = r"#version 450
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D speeds;
layout(rgba32f, set = 0, binding = 1) uniform writeonly image2D picture;
layout(push_constant) uniform Params { float level; } params;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = imageSize(picture);
    if (all(lessThan(pixel, size))) {
        vec2 uv = (vec2(pixel) + 0.5) / vec2(size);
        imageStore(picture, pixel, vec4(textureLod(speeds, uv, params.level).x));
    }
}
";

const DECLARATIONS: &str = r#"
[[parameter]]
name = "level"
kind = "real"
default = 3
range = [0, 4]
doc = "Level that is shown."

[[texture]]
name = "pyramid"
format = "r32float"
mips = 5

[[pass]]
shader = "speed.comp"
over = "pyramid"

[[pass.binding]]
binding = 0
texture = "velocity"
sampler = "nearest"

[[pass.binding]]
binding = 1
texture = "pyramid"

[[pass]]
shader = "halve.comp"
over = "pyramid"
repeat = 4

[[pass.binding]]
binding = 0
texture = "pyramid"
level = "iteration"
sampler = "nearest"

[[pass.binding]]
binding = 1
texture = "pyramid"
level = "iteration + 1"

[[pass]]
shader = "show.comp"

[[pass.binding]]
binding = 0
texture = "pyramid"
sampler = "nearest"

[[pass.binding]]
binding = 1
texture = "output"

[[pass.binding]]
push_constants = true
"#;

const DRAWN: (&str, &str) = (
    "shader = \"halve.comp\"\nover = \"pyramid\"\nrepeat = 4\n",
    "shader = \"halve.wgsl\"\nstage = \"fragment\"\ntargets = [\"pyramid\"]\nlevel = \"iteration + 1\"\nrepeat = 4\n",
);

const WRITTEN: &str =
    "[[pass.binding]]\nbinding = 1\ntexture = \"pyramid\"\nlevel = \"iteration + 1\"\n";

const FILES: [(&str, &str); 4] = [
    ("speed.comp", SPEED),
    ("halve.comp", HALVE),
    ("halve.wgsl", HALVE_FRAGMENT),
    ("show.comp", SHOW),
];

/// Computes the level of the pyramid by hand.
fn expected_level(level: u32) -> Raster<f32> {
    let speed = |v: &[f32; 2]| v[0].hypot(v[1]);
    let mut finer = busy_picture().velocity.map(speed);
    for _ in 0..level {
        let size = [finer.width, finer.height].map(|side| (side / 2).max(1));
        finer = Raster::from_fn(size[0], size[1], |x, y| {
            let reach = |at: u32, size: u32| if at == size - 1 { 2 } else { 1 };
            let mut fastest = 0.0_f32;
            for row in 0..=reach(y, size[1]) {
                for column in 0..=reach(x, size[0]) {
                    let (x, y) = (2 * x + column, 2 * y + row);
                    fastest =
                        fastest.max(*finer.at(x.min(finer.width - 1), y.min(finer.height - 1)));
                }
            }
            fastest
        });
    }
    finer
}

fn show(filter: &Filter, level: f64) -> Image {
    let mut settings = filter.settings(None).unwrap();
    settings.set(filter, "level", &level.to_string()).unwrap();
    blur(filter, &settings, &busy_picture())
}

#[test]
fn a_pyramid_of_the_fastest_motions_is_that_of_the_cpu() {
    let drawn = DECLARATIONS.replace(DRAWN.0, DRAWN.1).replace(WRITTEN, "");
    for declarations in [DECLARATIONS, &drawn] {
        let filter = make(declarations, &FILES).unwrap();
        for level in 0..5 {
            let expected = expected_level(level);
            let shown = show(&filter, f64::from(level));
            for y in 0..43 {
                for x in 0..61 {
                    let at = [(x, 61, expected.width), (y, 43, expected.height)];
                    let [column, row] = at.map(|(at, side, texels)| {
                        ((f64::from(at) + 0.5) / f64::from(side) * f64::from(texels)) as u32
                    });
                    let (found, expected) = (shown.at(x, y)[0], *expected.at(column, row));
                    let difference = (found - expected).abs();
                    assert!(
                        difference < 1e-5,
                        "level {level} at ({x}, {y}): {found}, not {expected}"
                    );
                }
            }
        }
    }
}

#[test]
fn samplers_take_the_nearest_level_or_mix_two() {
    let mixed = DECLARATIONS.replacen(
        "texture = \"pyramid\"\nsampler = \"nearest\"\n\n[[pass.binding]]\nbinding = 1\ntexture = \"output\"",
        "texture = \"pyramid\"\nsampler = \"nearest\"\nmip_filter = \"linear\"\n\n[[pass.binding]]\nbinding = 1\ntexture = \"output\"",
        1,
    );
    assert_ne!(mixed, DECLARATIONS);
    let [plain, mixed] = [DECLARATIONS, &mixed].map(|text| make(text, &FILES).unwrap());
    let [low, high] = [1.0, 2.0].map(|level| show(&plain, level));
    assert_eq!(show(&plain, 1.25), low);
    let between = low.zip(&high, |a, b| [0, 1, 2].map(|i| 0.75 * a[i] + 0.25 * b[i]));
    let difference = largest_difference(&show(&mixed, 1.25), &between);
    // Samplers have 8 binary digits between levels, of speeds up to 25.
    assert!(difference < 0.1, "{difference}");
    assert!(largest_difference(&low, &between) > 1.0);
}

#[test]
fn small_pictures_have_fewer_levels() {
    let filter = make(DECLARATIONS, &FILES).unwrap();
    let gpu = open_gpu();
    let small = tests::picture::Picture::uniform(5, 3, tests::picture::white(4.0));
    let colors = [&small.color];
    let settings = filter.settings(None).unwrap();
    // Three levels: 5 x 3, 2 x 1 and 1 x 1.
    let mut blur = Blur::new(&gpu, &filter, &settings, 5, 3).unwrap();
    let output = blur.run(&small.input(&colors)).unwrap().remove(0);
    assert!(
        output.pixels.iter().all(|pixel| *pixel == [4.0; 3]),
        "{output:?}"
    );
}

#[test]
fn wrong_levels_are_refused() {
    #[rustfmt::skip]
    assert_refused(DECLARATIONS, &FILES, &[
        ("mips = 5", "mips = 0", &["filter.toml:", "texture \"pyramid\": mips = 0; allowed: from 1 to 15"]),
        ("mips = 5", "mips = 16", &["filter.toml:", "mips = 16"]),
        ("mips = 5\n", "", &["filter.toml:", "\"pyramid\" has no mip levels", "`mips`"]),
        ("level = \"iteration\"", "level = -1", &["filter.toml:", "level = -1; allowed: whole, from 0"]),
        ("level = \"iteration\"", "level = \"width\"", &["filter.toml:", "level = \"width\"", "unknown name \"width\"", "iteration"]),
        ("over = \"pyramid\"\nrepeat = 4", "over = \"pyramid\"\nrepeat = 4\nlevel = 1", &["filter.toml:", "level of a pass is for stage = \"fragment\""]),
        ("shader = \"show.comp\"", "entry = \"show\"\nlevel = 1", &["filter.toml:", "level is for a pass with `shader`"]),
    ]);
    let drawn = DECLARATIONS.replace(DRAWN.0, DRAWN.1).replace(WRITTEN, "");
    #[rustfmt::skip]
    assert_refused(&drawn, &FILES, &[
        ("mips = 5\n", "", &["has no mip levels"]),
    ]);
    let gpu = open_gpu();
    // (text, replacement, words): what only the numbers of the settings tell.
    for (from, to, says) in [
        (
            "level = \"iteration + 1\"",
            "level = \"iteration\"",
            "reads level 0 of \"pyramid\", which it writes",
        ),
        (
            "level = \"iteration + 1\"",
            "level = \"iteration - 1\"",
            "level = -1; allowed: from 0",
        ),
        (
            "repeat = 4",
            "repeat = 3",
            "may read level 4 of \"pyramid\", which no pass has written",
        ),
        (
            "level = \"iteration\"\n",
            "",
            "may read level 1 of \"pyramid\", which no pass has written",
        ),
    ] {
        let filter = make(&DECLARATIONS.replacen(from, to, 1), &FILES).unwrap();
        let settings = filter.settings(None).unwrap();
        let message = Blur::new(&gpu, &filter, &settings, 61, 43)
            .unwrap_err()
            .to_string();
        assert!(
            message.contains(says) && message.contains("pass "),
            "{from}: {message}"
        );
    }
}
