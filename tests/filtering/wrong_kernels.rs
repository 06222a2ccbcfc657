//! Kernels that would make a wrong picture. Each is refused with its place, and none is scored.

use filters::{Blur, Filter, FilterError, Gpu};
use frame::Image;
use tests::filter_folder::{load_filter, one_kernel};
use tests::open_gpu;
use tests::picture::{Picture, gray_moving_by};

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

/// Loads a filter with one kernel around `body`, and a time limit in seconds.
fn load(body: &str, limit: f64) -> Filter {
    let manifest = MANIFEST.replace("LIMIT", &limit.to_string());
    load_filter("wrong", &manifest, &one_kernel("steps: i32", body)).unwrap()
}

/// Runs `body` with this many steps on a grey picture of 40x20 pixels.
fn blur(gpu: &Gpu, body: &str, steps: i64, limit: f64) -> Result<Vec<Image>, FilterError> {
    let filter = load(body, limit);
    let mut settings = filter.settings(None).unwrap();
    settings.set(&filter, "steps", &steps.to_string()).unwrap();
    let (width, height) = (40, 20);
    let picture = Picture::uniform(width, height, gray_moving_by(3.0));
    Blur::new(gpu, &filter, &settings, width, height)?.run(&picture.input(&[&picture.color]))
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

fn refusal(result: Result<Vec<Image>, FilterError>) -> String {
    match result {
        Ok(_) => panic!("this is to be refused"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn loops_that_the_adapter_cuts_are_refused_and_shorter_ones_complete() {
    let gpu = open_gpu();
    let Some(limit) = gpu.loop_limit else {
        // An adapter without a limit counts to the end.
        let output = blur(&gpu, COUNT, 1_000_000, 60.0).unwrap();
        assert_eq!(output[0].at(39, 19)[0], 1e6);
        return;
    };
    println!("{limit:?}");
    // The iteration that finds the end counts, too.
    let longest = i64::from(limit.safe()) - 2;
    let output = blur(&gpu, COUNT, longest, 60.0).unwrap();
    assert_eq!(output[0].at(39, 19)[0], longest as f32);
    for steps in [
        i64::from(limit.safe()),
        i64::from(limit.iterations) + 1,
        200_000,
    ] {
        let text = refusal(blur(&gpu, COUNT, steps, 60.0));
        for part in [
            "filter wrong, pass work",
            &limit.iterations.to_string(),
            "allowed",
        ] {
            assert!(text.contains(part), "{steps} steps: {text}");
        }
    }
}

#[test]
fn iterations_of_all_loops_and_functions_count_together() {
    let gpu = open_gpu();
    let Some(limit) = gpu.loop_limit else {
        return;
    };
    // Nested loops: the inner ones take the square of the outer iterations.
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
    blur(&gpu, nested, side / 2, 60.0).unwrap();
    assert!(refusal(blur(&gpu, nested, side + 1, 60.0)).contains("loop iterations"));
}

#[test]
fn a_pixel_that_no_pass_writes_is_named() {
    let gpu = open_gpu();
    let body = "
    if pixel.y == 7 && pixel.x >= 12 { return; }
    textureStore(output, pixel, textureLoad(color, pixel, 0));
    ";
    let text = refusal(blur(&gpu, body, 1, 60.0));
    assert!(text.contains("pass work"), "{text}");
    assert!(
        text.contains("pixel (12, 7) of the output unwritten"),
        "{text}"
    );
}

#[test]
fn a_pixel_that_is_not_finite_is_named() {
    let gpu = open_gpu();
    let body = "
    let zero = f32(parameters.steps);
    var grey = textureLoad(color, pixel, 0);
    if pixel.y == 3 && pixel.x == 5 { grey = grey / zero; }
    textureStore(output, pixel, grey);
    ";
    blur(&gpu, body, 1, 60.0).unwrap();
    let text = refusal(blur(&gpu, body, 0, 60.0));
    assert!(text.contains("to pixel (5, 3)"), "{text}");
    assert!(text.contains("finite"), "{text}");
}

#[test]
fn a_pass_past_its_time_limit_is_stopped_and_named() {
    let gpu = open_gpu();
    // Far more work than a hundredth of a second allows, in loops of allowed length.
    let text = refusal(blur(&gpu, COUNT, 8000, 1e-4));
    for part in [
        "filter wrong, pass work",
        "took longer than 0.0001 s",
        "time_limit",
    ] {
        assert!(text.contains(part), "{text}");
    }
}
