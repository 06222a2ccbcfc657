//! Textures, images and uniforms in engines' forms: packed formats, sides rounded down, images that
//! are read and written, variables without registers.

use filters::Limits;
use tests::near::assert_near;
use tests::text::assert_contains;

use super::{blur_busy, busy_picture, largest_difference, make, make_declared};
use crate::filter_files::{FilterFiles, ready};

/// Stores colours in the texture `kept`, in this format, and shows it.
fn pack(format: &str) -> String {
    format!(
        "[[texture]]\nname = \"kept\"\nformat = \"{format}\"\n\
         [[pass]]\nshader = \"pack.wgsl\"\nstage = \"fragment\"\ntargets = [\"kept\"]\n\
         [[pass]]\nshader = \"show.wgsl\"\nstage = \"fragment\"\n"
    )
}

#[test]
fn render_targets_of_10_bits_keep_10_bits() {
    // Colours go up to 2.5.
    for (format, error) in [
        ("rgba32float", 0.0..1e-5),
        // A step of 10 bits: llvmpipe rounds down.
        ("rgb10a2unorm", 1e-5..1.0 / 0.3 / 1023.0),
        ("rg11b10ufloat", 1e-5..2.5 / 32.0),
    ] {
        let shown = blur_busy(&make("resources", &pack(format)));
        let difference = largest_difference(&shown, &busy_picture().color);
        assert!(error.contains(&difference), "{format}: {difference}");
    }
}

/// A format of storage textures.
struct Stored {
    format: &'static str,
    /// Name in GLSL.
    qualifier: &'static str,
    channels: usize,
    /// Largest error of values up to 0.75.
    error: f32,
}

/// All formats of floats. The first four have all kinds of precision and numbers of channels.
#[rustfmt::skip]
const STORED: [Stored; 10] = [
    Stored { format: "r32float", qualifier: "r32f", channels: 1, error: 1e-6 },
    Stored { format: "rg16float", qualifier: "rg16f", channels: 2, error: 5e-4 },
    Stored { format: "rgba8unorm", qualifier: "rgba8", channels: 3, error: 1.0 / 255.0 },
    Stored { format: "rg11b10ufloat", qualifier: "r11f_g11f_b10f", channels: 3, error: 0.75 / 32.0 },
    Stored { format: "rg32float", qualifier: "rg32f", channels: 2, error: 1e-6 },
    Stored { format: "rgba32float", qualifier: "rgba32f", channels: 3, error: 1e-6 },
    Stored { format: "r16float", qualifier: "r16f", channels: 1, error: 5e-4 },
    Stored { format: "rgba16float", qualifier: "rgba16f", channels: 3, error: 5e-4 },
    Stored { format: "r8unorm", qualifier: "r8", channels: 1, error: 1.0 / 255.0 },
    Stored { format: "rgb10a2unorm", qualifier: "rgb10_a2", channels: 3, error: 1.0 / 1023.0 },
];

#[test]
fn storage_textures_keep_what_their_format_holds() {
    check_stored(&STORED[..4]);
}

#[test]
#[ignore = "prove: six more formats"]
fn storage_textures_keep_what_every_further_format_holds() {
    check_stored(&STORED[4..]);
}

fn check_stored(formats: &[Stored]) {
    let color = busy_picture().color;
    for stored in formats {
        let Stored {
            format,
            qualifier,
            channels,
            error,
        } = stored;
        let declarations = format!(
            "[[texture]]\nname = \"kept\"\nformat = \"{format}\"\n\
             [[pass]]\nshader = \"store.comp\"\nover = \"kept\"\n\
             [[pass.binding]]\nbinding = 0\nsampler = \"nearest\"\n\
             [[pass]]\nshader = \"show.wgsl\"\nstage = \"fragment\"\n"
        );
        let files = make("resources", &declarations);
        let shown = blur_busy(&files.changed("store.comp", "QUALIFIER", qualifier));
        for (actual, color) in shown.pixels.iter().zip(&color.pixels) {
            for channel in 0..*channels {
                let expected = [0.3, 0.2, 0.1][channel] * color[channel];
                let difference = (0.3 * actual[channel] - expected).abs();
                assert!(difference <= *error, "{format}: {difference} in {channel}");
            }
        }
    }
}

#[test]
fn samplers_clamp_repeat_or_mirror_and_interpolate_or_not() {
    let color = busy_picture().color;
    let gray = |x: u32| color.at(x, 5)[0];
    // (keys, value at column 3, value at column 55)
    let linear = 0.75 * gray(13) + 0.25 * gray(14);
    for (keys, inside, beyond) in [
        ("sampler = \"nearest\"", gray(13), gray(60)),
        ("sampler = \"linear\"", linear, gray(60)),
        (
            "sampler = \"nearest\"\nwrap = \"repeat\"",
            gray(13),
            gray(4),
        ),
        (
            "sampler = \"nearest\"\nwrap = \"mirror\"",
            gray(13),
            gray(56),
        ),
        ("sampler = \"nearest\"\nwrap = \"border\"", gray(13), 0.0),
    ] {
        println!("{keys}");
        let declarations = format!(
            "[[pass]]\nshader = \"sample.wgsl\"\nstage = \"fragment\"\n[[pass.binding]]\nbinding = 1\n{keys}\n"
        );
        let shown = blur_busy(&make("resources", &declarations));
        // Samplers have 8 binary digits between texels.
        assert_near(shown.at(3, 5)[0], inside, 0.01);
        assert_near(shown.at(55, 5)[0], beyond, 0.01);
    }
}

#[test]
fn a_border_is_refused_where_no_adapter_promises_it() {
    let declarations = "[[pass]]\nshader = \"sample.wgsl\"\nstage = \"fragment\"\n[[pass.binding]]\nbinding = 1\nwrap = \"border\"\n";
    let filter = make("resources", declarations).load().unwrap();
    let error = Limits::lowest().check(&filter).unwrap_err().to_string();
    let parts = [
        "sampler \"own\" has wrap = \"border\", not allowed by the lowest common limits",
        "take wrap = \"clamp\"",
    ];
    assert_contains(&error, &parts);
}

#[test]
fn halves_are_packed_in_every_language() {
    for shader in ["halves.wgsl", "halves.frag", "halves.hlsl"] {
        let pass = format!(
            "[[pass]]\nshader = \"{shader}\"\nstage = \"fragment\"\n[[pass.binding]]\nname = \"color\"\ntexture = \"color\"\n"
        );
        let shown = blur_busy(&make("halves", &pass));
        let mut rounded = 0;
        for (pixel, color) in shown.pixels.iter().zip(&busy_picture().color.pixels) {
            for (actual, color) in pixel.iter().zip(color) {
                let exact = 0.3 * color;
                rounded += u32::from(*actual != exact);
                // Halves of values below 1 have 11 binary digits; drivers may cut the rest off.
                assert_near(*actual, exact, 1.0 / 2048.0);
            }
        }
        assert!(rounded > 1000, "{shader}: {rounded} values were rounded");
    }
}

#[test]
fn a_depth_texture_is_the_depth() {
    let pass = "[[pass]]\nshader = \"depth.wgsl\"\nstage = \"fragment\"\n[[pass.binding]]\nbinding = 1\nsampler = \"nearest\"\n";
    let files = make("depth", pass);
    let shown = blur_busy(&files);
    let depth = busy_picture().depth;
    for (x, y) in [(12_u32, 9_u32), (40, 30), (0, 0)] {
        let metres = *depth.at(x, y);
        // The second corner of a gather is the one at the bottom right.
        let due = [metres, 2.0 * metres, *depth.at(x + 1, y + 1)];
        assert_eq!(*shown.at(x, y), due, "({x}, {y})");
    }
    files.assert_refused("depth");
}

#[test]
fn the_pass_that_writes_the_first_broken_value_is_named() {
    let files = make("resources", &pack("rgba16float")).changed(
        "pack.wgsl",
        "return 0.3",
        "return sqrt(f32(i32(position.x) - 7 + 8 * abs(i32(position.y) - 5))) * 0.3",
    );
    let picture = busy_picture();
    let mut blur = ready(&files.load().unwrap(), (61, 43)).unwrap();
    let error = blur.run(&picture.input(&[&picture.color])).unwrap_err();
    let parts = [
        "pass show: writes [NaN, NaN, NaN] to pixel (0, 5)",
        "pass pack writes the first that is not, to texel (0, 5) of \"kept\"",
    ];
    assert_contains(&error.to_string(), &parts);
}

#[test]
fn an_image_that_is_read_and_written_keeps_what_is_not_written() {
    let shown = blur_busy(&make_declared("resources", "state.toml"));
    // Each run changes every third column, by its left neighbour's value.
    let mut expected = vec![1.0_f32; 61];
    for iteration in 0..3 {
        let before = expected.clone();
        for x in (0..61).filter(|x| x % 3 == iteration) {
            expected[x] += 10.0 * before[x.saturating_sub(1)];
        }
    }
    for (x, expected) in (0..61).zip(expected) {
        // Halves have 11 binary digits, three times.
        assert_near(shown.at(x, 7)[2] / expected, 1.0, 2e-3);
    }
}

#[test]
fn hlsl_without_registers_is_bound_by_name() {
    let files = make_declared("resources", "names.toml");
    let output = blur_busy(&files);
    let picture = busy_picture();
    for (x, y) in [(12_u32, 9_u32), (40, 30), (5, 5)] {
        let [gray, ..] = *picture.color.at(x + 1, y);
        let motion = picture.velocity.at(x, y);
        let expected = [1.7 * gray + motion[0], 1.7 * gray + motion[1], 1.7 * gray];
        for (actual, expected) in output.at(x, y).iter().zip(expected) {
            assert_near(*actual, expected, 1e-4);
        }
    }
    files.assert_refused("names");
}

/// Makes a filter that stores whole numbers in a texture and shows them.
fn declare_whole(format: &str, [kind, qualifier, sign]: [&str; 3]) -> FilterFiles {
    let declarations = format!(
        "[[texture]]\nname = \"kept\"\nformat = \"{format}\"\n\
         [[pass]]\nshader = \"whole.comp\"\nover = \"kept\"\n[[pass]]\nshader = \"show_whole.frag\"\n"
    );
    let files = make("resources", &declarations);
    let text = files.text("whole.comp").replace("KIND", kind);
    let text = text.replace("QUALIFIER", qualifier).replace("SIGN", sign);
    let files = files.with("whole.comp", text);
    files.changed("show_whole.frag", "KIND", kind)
}

/// Checks textures of 1, 2 or 4 channels.
fn check_whole(channels: usize, bits: u32, signed: bool) {
    let word = ["", "r", "rg", "", "rgba"][channels];
    let (ending, short, kind, sign) = if signed {
        ("sint", "i", "i", "-")
    } else {
        ("uint", "ui", "u", "")
    };
    let format = format!("{word}{bits}{ending}");
    let glsl = [kind, &format!("{word}{bits}{short}"), sign];
    let shown = blur_busy(&declare_whole(&format, glsl));
    let side = if signed { -1.0 } else { 1.0 };
    let mut due = [side * 12.0, side * 9.0, 12.0];
    due[channels.min(3)..].fill(0.0);
    assert_eq!(*shown.at(12, 9), due, "{format}");
}

#[test]
fn textures_of_whole_numbers_keep_their_signs() {
    // Each number of channels, of bits, and sign.
    for (channels, bits, signed) in [(1, 8, true), (2, 16, false), (4, 32, true)] {
        check_whole(channels, bits, signed);
    }
    declare_whole("rg8sint", ["i", "rg8i", ""]).assert_refused("whole_numbers");
}

#[test]
#[ignore = "prove: all eighteen formats"]
fn textures_of_whole_numbers_of_every_format_keep_their_signs() {
    for channels in [1, 2, 4] {
        for bits in [8, 16, 32] {
            check_whole(channels, bits, true);
            check_whole(channels, bits, false);
        }
    }
}

#[test]
fn members_of_structs_and_storage_buffers_have_their_values() {
    let files = make_declared("resources", "members.toml");
    // Height and scale; two weights; the length of the array, its last number and 10 x exposure.
    let due = [43.5, 4.25, 5.0 + 80.0 + 7.0];
    for (actual, due) in blur_busy(&files).at(30, 20).iter().zip(due) {
        assert_near(*actual, due, 1e-4);
    }
    files.assert_refused("members");
    // Buffers of HLSL that are read have the registers of textures.
    let pass = "[[pass]]\nshader = \"table.hlsl\"\nstage = \"fragment\"\n\
                [[pass.binding]]\nbinding = 103\nvalues = { \"*\" = [1, 2, 3, 4] }\n";
    let hlsl = "StructuredBuffer<float> table : register(t3);\nfloat4 main(float4 position : SV_Position) : SV_Target\n\
                { return float4(table[1], table[3], 0.0, 1.0); }\n";
    let shown = blur_busy(&make("resources", pass).with("table.hlsl", hlsl));
    assert_eq!(*shown.at(30, 20), [2.0, 4.0, 0.0]);
    let written = files.changed("table.comp", "readonly buffer", "buffer");
    blur_busy(&written);
    written.assert_refused("written_buffer");
}
