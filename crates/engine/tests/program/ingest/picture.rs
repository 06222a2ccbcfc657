//! Notes of `ingest` on an engine's pictures: the gain of its blur, and noise in its sub-frames.

use frame::Raster;
use tests::random::Random;
use tests::text::assert_contains;

use super::capture::Capture;
use super::ingest;
use crate::sandbox::{SCENE, Sandbox};

/// Makes some pixels of the engine's blurred picture brighter.
fn brighten(capture: &Capture, scale: f32, is_chosen: impl Fn(u32, u32) -> bool) {
    let blurred = capture.read_color("blurred.exr");
    let changed = Raster::from_fn(blurred.width, blurred.height, |x, y| {
        let scale = if is_chosen(x, y) { scale } else { 1.0 };
        blurred.at(x, y).map(|value| scale * value)
    });
    capture.write_color("blurred.exr", &changed);
}

#[test]
fn the_gain_of_a_blur_is_that_of_still_pixels() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox).with_subframes(8);
    let told = ingest(&sandbox);
    assert!(!told.contains("FOUND"), "{told}");
    // The plate passes the middle of the picture. A blur that is too bright there has another
    // defect than a gain.
    let blurred = capture.read_color("blurred.exr");
    brighten(&capture, 1.5, |x, y| {
        blurred.at(x, y)[2] != blurred.at(0, 0)[2]
    });
    let told = ingest(&sandbox);
    assert!(!told.contains("FOUND"), "{told}");
    capture.write_color("blurred.exr", &blurred);
    brighten(&capture, 17.0 / 16.0, |_, _| true);
    let told = ingest(&sandbox);
    // Half floats round 1.0625 times 0.2.
    let finding = "FOUND: the engine's blur makes the picture brighter, 1.062";
    assert_contains(&told, &[finding, " times where no velocity reaches"]);
}

#[test]
fn without_a_still_pixel_there_is_no_gain_to_judge() {
    let sandbox = Sandbox::new();
    let wide = "0, 0], scale = 20 }";
    sandbox.write("scene.toml", &SCENE.replace("0, 0] }", wide));
    Capture::new(&sandbox).with_subframes(4);
    let told = ingest(&sandbox);
    let words = "the gain of the engine's blur is not judged: velocity reaches every lit pixel";
    assert!(told.contains(words), "{told}");
}

/// Adds independent noise to every sub-frame.
fn add_noise(capture: &Capture, count: u32) {
    for index in 0..count {
        let name = format!("subframes/{index:04}.exr");
        let color = capture.read_color(&name);
        let mut noise = Random::new(u64::from(index));
        let noisy = color.map(|color| {
            let noise = noise.real(-0.05, 0.05);
            color.map(|value| value + noise)
        });
        capture.write_color(&name, &noisy);
    }
}

#[test]
fn noise_that_makes_still_pixels_move_is_said() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox).with_subframes(8);
    brighten(&capture, 17.0 / 16.0, |_, _| true);
    let share = |told: &str| -> f64 {
        let start = told.split("\nmoving: ").nth(1).unwrap();
        start.split(' ').next().unwrap().parse().unwrap()
    };
    let told = ingest(&sandbox);
    let still = " % of the pixels; 0.0 % change between sub-frames though no velocity reaches them";
    assert!(told.contains(still), "{told}");
    assert!(!told.contains("FOUND: the moving region"), "{told}");
    // The plate covers 144 pixels of 5184, and its path half as many.
    assert!((3.0..7.0).contains(&share(&told)), "{told}");
    add_noise(&capture, 8);
    let told = ingest(&sandbox);
    assert!(share(&told) > 95.0, "{told}");
    let parts = [
        "FOUND: the moving region has ",
        "draw all sub-frames with one seed",
        // Pixels without velocity still reveal the gain.
        "brighter, 1.06",
    ];
    assert_contains(&told, &parts);
}
