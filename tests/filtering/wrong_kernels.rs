//! Kernels that would make a wrong picture. Each is refused with its place, and none is scored.

use filters::{Blur, FilterError, Gpu};
use frame::Image;
use tests::filter_folder::{load_filter, one_kernel};
use tests::picture::{Picture, white};
use tests::text::assert_contains;
use tests::{open_gpu, shared_gpu};

const MANIFEST: &str = r#"
name = "wrong"
summary = "Does something wrong."
alignment = "trailing"
time_limit = LIMIT

[[parameter]]
name = "steps"
kind = "integer"
default = 1
range = [0, 2000000000]
doc = "Loop iterations; more take longer."

[[pass]]
entry = "work"
"#;

/// Runs `body` with this many steps, within a time limit in seconds, on a grey picture of 40x20
/// pixels.
fn blur(gpu: &Gpu, body: &str, steps: i64, limit: f64) -> Result<Image, FilterError> {
    let manifest = MANIFEST.replace("LIMIT", &limit.to_string());
    let filter = load_filter("wrong", &manifest, &one_kernel("steps: i32", body)).unwrap();
    let mut settings = filter.settings(None).unwrap();
    settings.set(&filter, "steps", &steps.to_string()).unwrap();
    let (width, height) = (40, 20);
    let picture = Picture::uniform(width, height, white(3.0));
    let mut blur = Blur::new(gpu, &filter, &settings, width, height)?;
    Ok(blur.run(&picture.input(&[&picture.color]))?.remove(0))
}

/// Fails unless `body` is refused with these words.
#[track_caller]
fn assert_refused(body: &str, steps: i64, parts: &[&str]) {
    let error = blur(shared_gpu(), body, steps, 60.0).unwrap_err();
    assert_contains(&error.to_string(), parts);
}

/// Kernel that counts to `steps` in a way that no compiler shortens, and writes the count.
const COUNT: &str = "
    var value = u32(pixel.x);
    var count = 0u;
    for (var i = 0; i < parameters.steps; i++) {
        value = value * 1664525u + 1013904223u;
        count += 1u;
    }
    textureStore(output, pixel, vec4<f32>(f32(count), f32(value & 1u), 0.0, 1.0));
";

#[test]
fn loops_that_the_adapter_cuts_are_refused_and_shorter_ones_complete() {
    // The iteration that finds the end counts, too. An adapter without a limit counts to the end.
    let limit = shared_gpu().loop_limit;
    let longest = limit.map_or(1_000_000, |limit| i64::from(limit.safe()) - 2);
    let output = blur(shared_gpu(), COUNT, longest, 60.0).unwrap();
    assert_eq!(output.at(39, 19)[0], longest as f32);
    let Some(limit) = limit else { return };
    let iterations = limit.iterations.to_string();
    let parts = ["filter wrong, pass work", &iterations, "allowed"];
    for steps in [limit.safe(), limit.iterations + 1, 200_000] {
        assert_refused(COUNT, steps.into(), &parts);
    }
}

#[test]
fn iterations_of_all_loops_and_functions_count_together() {
    let Some(limit) = shared_gpu().loop_limit else {
        return;
    };
    // Nested loops: the inner ones run the square of the outer iterations.
    let nested = "
    var value = u32(pixel.x);
    for (var i = 0; i < parameters.steps; i++) {
        for (var k = 0; k < parameters.steps; k++) {
            value = value * 1664525u + 1013904223u;
        }
    }
    textureStore(output, pixel, vec4<f32>(f32(value & 255u)));
    ";
    let side = f64::from(limit.safe()).sqrt() as i64;
    blur(shared_gpu(), nested, side / 2, 60.0).unwrap();
    assert_refused(nested, side + 1, &["loop iterations"]);
}

#[test]
fn a_pixel_that_no_pass_writes_is_named() {
    let body = "
    if pixel.y == 7 && pixel.x >= 12 { return; }
    textureStore(output, pixel, textureLoad(color, pixel, 0));
    ";
    let parts = ["pass work", "pixel (12, 7) of the output unwritten"];
    assert_refused(body, 1, &parts);
}

#[test]
fn a_pass_past_its_time_limit_is_stopped_and_named() {
    // Far more work than the time allows, in loops of allowed length. The adapter stays busy.
    let error = blur(&open_gpu(), COUNT, 60_000, 1e-4).unwrap_err();
    let parts = [
        "filter wrong, pass work",
        "took longer than 0.0001 s",
        "time_limit",
    ];
    assert_contains(&error.to_string(), &parts);
}
