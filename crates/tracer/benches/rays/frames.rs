//! Whole truths of scenes from the catalogue: camera samples per second, and how fast the noise falls.

use std::ops::ControlFlow;
use std::path::Path;
use std::time::{Duration, Instant};

use tracer::{Progress, TruthSettings, load_scene, trace_truth};

const SCENES: [&str; 3] = ["fan", "railing", "two_spheres"];
const TURNS: u32 = 3;
/// Standard error to which times are scaled, by the square of the one that was reached. Noise falls faster than that,
/// so the times are upper bounds.
const TARGET: f64 = 0.003;

/// Renders small truths on all processors and prints what they cost.
pub fn report() {
    let settings = TruthSettings {
        width: 160,
        height: 90,
        samples_per_pixel: 128,
        ..TruthSettings::default()
    };
    println!(
        "\n{}x{} pixels, {} samples each, all processors, best of {TURNS} turns",
        settings.width, settings.height, settings.samples_per_pixel
    );
    for name in SCENES {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../../scenes")
            .join(name);
        let scene = load_scene(&folder, None).expect("the scenes of the catalogue load");
        let unwatched = |_: Progress| ControlFlow::Continue(());
        let mut best = Duration::MAX;
        let mut squares = 0.0;
        for _ in 0..TURNS {
            let start = Instant::now();
            let truth = trace_truth(&scene, &settings, &unwatched).expect("settings are allowed");
            best = best.min(start.elapsed());
            let errors = truth.standard_error.pixels.iter().flatten();
            squares = errors.map(|error| f64::from(*error).powi(2)).sum::<f64>();
        }
        let pixels = f64::from(settings.width * settings.height);
        let error = (squares / (3.0 * pixels)).sqrt();
        let samples = pixels * f64::from(settings.samples_per_pixel);
        println!(
            "{name:12} {:5.2} million camera samples/s, standard error {error:.4}; {TARGET} within {:.2} s",
            samples / best.as_secs_f64() / 1e6,
            best.as_secs_f64() * (error / TARGET).powi(2)
        );
    }
}
