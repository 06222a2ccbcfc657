//! Whole truths of shipped scenes: camera samples per second, and the time to a given noise.

use std::ops::ControlFlow;
use std::path::Path;
use std::time::{Duration, Instant};

use frame::{AtInstant, Picture, Raster, Truth};
use tracer::{Progress, TruthSettings, TruthTracer, load_scene, trace_truth};

const SCENES: [&str; 3] = ["fan", "railing", "two_spheres"];
const TURNS: u32 = 3;
/// Standard error that times are scaled to, by the square of the error that was reached. Noise falls faster than that, so the
/// times are upper limits.
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
        let mut stored = [0; 2];
        for _ in 0..TURNS {
            let start = Instant::now();
            let truth = trace_truth(&scene, &settings, &unwatched).expect("settings are allowed");
            best = best.min(start.elapsed());
            let errors = truth.standard_error.pixels.iter().flatten();
            stored = stored_per_pixel(&truth);
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
        let tracer = TruthTracer::new(&scene, &settings, &[settings.alignment])
            .expect("settings are allowed");
        println!(
            "{:12} {} bytes per pixel while a replicate is traced, {} in each of {} replicates, {} in the truth",
            "",
            tracer.bytes_per_pixel(),
            stored[0],
            settings.replicates,
            stored[1]
        );
    }
}

/// Bytes per pixel of a replicate, and of a truth.
fn stored_per_pixel(truth: &Truth) -> [usize; 2] {
    let replicate = in_picture(&truth.halves[0]) + in_instant(&truth.at_instant[0]);
    let own = in_raster(&truth.standard_error) + in_raster(&truth.motion);
    [replicate, 2 * replicate + own]
}

fn in_picture(picture: &Picture) -> usize {
    let coverage = picture.coverage.iter();
    in_raster(&picture.color) + coverage.map(in_raster).sum::<usize>()
}

fn in_instant(instant: &AtInstant) -> usize {
    in_raster(&instant.frozen)
        + in_raster(&instant.unknowable)
        + in_raster(&instant.placed)
        + in_raster(&instant.offset)
        + in_raster(&instant.spread)
}

fn in_raster<T>(_: &Raster<T>) -> usize {
    size_of::<T>()
}
