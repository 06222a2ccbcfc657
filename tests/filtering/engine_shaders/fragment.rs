//! Fragment shaders over the whole picture.

use tests::near::assert_within;
use tests::picture::{Picture, white};
use tests::shared_gpu;
use tests::text::assert_contains;

use super::{assert_as_documented, blur_busy, largest_difference, with_passes};
use crate::filter_files::{FilterFiles, ready};

/// Makes the documented example of a fragment shader in WGSL and one in GLSL, with more keys.
fn declare(keys: &str) -> FilterFiles {
    let fixture = FilterFiles::fixture("filters/fragment");
    let files = with_passes(&format!("{keys}{}", fixture.text("passes.toml")));
    // Keys of the whole filter come before its first table.
    let manifest = format!("time_limit = 60\n{}", files.text("filter.toml"));
    files
        .with("filter.toml", manifest)
        .with("fastest.wgsl", fixture.text("fastest.wgsl"))
}

#[test]
fn fragment_shaders_blur_as_kernels_do() {
    // Coordinates are interpolated over the triangle: some 1e-5 of a pixel.
    assert_as_documented(&declare("").load().unwrap(), 1e-4);
}

#[test]
fn half_floats_keep_three_digits() {
    let halves = "[convention]\ncolor_format = \"rgba16float\"\noutput_format = \"rgba16float\"\n";
    let [full, half] = ["", halves].map(|keys| blur_busy(&declare(keys)));
    let difference = largest_difference(&full, &half);
    // Half of the last of 11 binary digits, of values below 4, twice.
    assert_within(difference, f64::MIN_POSITIVE..4e-3);
}

#[test]
fn wrong_targets_are_refused() {
    declare("").assert_refused("targets");
}

#[test]
fn broken_pixels_and_endless_loops_are_reported_with_their_pass() {
    // Every pixel of an endless loop runs its 65536 iterations.
    let picture = Picture::uniform(8, 8, white(3.0));
    let colors = [&picture.color];
    // (text of gather.frag, replacement, expected part of the message)
    #[rustfmt::skip]
    let wrong = [
        ("result = vec4(0.0);", "result = vec4(0.0); if (pixel == ivec2(3, 4)) discard;", "leaves pixel (3, 4) of the output unwritten"),
        ("result = vec4(0.0);", "result = vec4(0.0); result.y = pixel == ivec2(3, 4) ? sqrt(uv.x - 9.0) : 0.0;", "to pixel (3, 4); every value must be finite"),
        ("for (int i = 0; i < params.samples; i++)", "for (int i = 0; params.samples > 0; i++)", "loop"),
    ];
    // An adapter that cuts no loop would run the endless one until it is lost, and with it all
    // tests that share it.
    let cuts_loops = shared_gpu().loop_limit.is_some();
    for (from, to, says) in &wrong[..if cuts_loops { 3 } else { 2 }] {
        let filter = declare("").changed("gather.frag", from, to).load().unwrap();
        let mut blur = ready(&filter, (8, 8)).unwrap();
        let error = blur.run(&picture.input(&colors)).unwrap_err();
        assert_contains(&error.to_string(), &["pass gather: ", says]);
    }
}
