//! Frames and truths of shipped and written scenes: CPU time at a given noise.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use frame::{Alignment, Region, Truth};
use scene::{Scene, load_scene};
use tracer::{Progress, RenderSettings, TruthTracer, trace_frame};

use crate::written_scenes::write_scenes;

const SHIPPED: [&str; 5] = ["fan", "railing", "walker", "foliage", "neon"];
/// Noise floor of the moving region that times are scaled to, by the square of the floor that was
/// reached. Noise falls faster than that, so times of noisier truths are upper limits.
const TARGET: f64 = 0.005;
/// Standard error of radiance over the whole picture that the time of a trailing truth is scaled
/// to.
const TARGET_OF_PICTURE: f64 = 0.002;
const SAMPLES: u32 = 128;

/// Renders the frame and both truths of each scene on all processors and prints their CPU time.
pub fn report() {
    let settings = RenderSettings {
        width: 160,
        height: 90,
        samples_per_pixel: SAMPLES,
        ..RenderSettings::default()
    };
    println!(
        "\n{}x{} pixels, {SAMPLES} samples each, all processors; CPU seconds",
        settings.width, settings.height
    );
    println!(
        "{:13} {:>7} {:>9} {:>7} {:>13} {:>13} {:>15} {:>17}",
        "",
        "frame",
        "trailing",
        "both",
        "floor, moving",
        "error, all",
        "all at 0.005",
        "trailing at 0.002"
    );
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let shipped = SHIPPED.map(|name| shipped.join(name));
    for scenes in [&shipped[..], &write_scenes()] {
        let mut products = [1.0, 1.0];
        for folder in scenes {
            let scaled = report_scene(folder, &settings);
            products = [0, 1].map(|of| products[of] * scaled[of]);
        }
        let [all, trailing] = products.map(|product| product.powf(1.0 / scenes.len() as f64));
        println!("{:67} {all:15.2} {trailing:17.2}", "geometric mean");
    }
}

/// Renders a scene and prints its times; returns those that are scaled to the targets.
fn report_scene(folder: &PathBuf, settings: &RenderSettings) -> [f64; 2] {
    let scene = load_scene(folder, None).expect("the scenes load");
    let (frame, _) = measure_time(|| trace_a_frame(&scene, settings));
    let (one, truth) = measure_time(|| trace_truths(&scene, settings, &[Alignment::Trailing]));
    let alignments = [Alignment::Trailing, Alignment::Centred];
    let (both, _) = measure_time(|| trace_truths(&scene, settings, &alignments));
    let floors = truth.noise_floors();
    let moving = floors.iter().find(|(region, _)| *region == Region::Moving);
    let floor = moving.expect("something moves").1;
    let error = error_of_picture(&truth);
    let all = (frame + both) * (floor / TARGET).powi(2);
    let trailing = one * (error / TARGET_OF_PICTURE).powi(2);
    let name = folder.file_name().expect("it is a folder").display();
    println!(
        "{name:13} {frame:7.2} {one:9.2} {both:7.2} {floor:13.5} {error:13.5} {all:15.2} {trailing:17.2}"
    );
    [all, trailing]
}

/// Root mean square of a truth's standard error over all pixels and components.
fn error_of_picture(truth: &Truth) -> f64 {
    let errors = truth.standard_error.pixels.iter().flatten();
    let squares: Vec<f64> = errors.map(|error| f64::from(*error).powi(2)).collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

fn trace_a_frame(scene: &Scene, settings: &RenderSettings) {
    let settings = RenderSettings {
        samples_per_pixel: settings.samples_per_pixel / 2,
        ..*settings
    };
    trace_frame(scene, &settings, &unwatched).expect("settings are allowed");
}

/// Renders the truths of some alignments; returns the first.
fn trace_truths(scene: &Scene, settings: &RenderSettings, alignments: &[Alignment]) -> Truth {
    let tracer = TruthTracer::new(scene, settings, alignments).expect("settings are allowed");
    let first = (0..settings.replicates).map(|index| {
        let mut replicates = tracer.trace(index, &unwatched).expect("nothing cancels");
        replicates.remove(0)
    });
    let first: Vec<_> = first.collect();
    Truth::of(&first).expect("their number is even")
}

fn unwatched(_: Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Runs some work; returns its CPU seconds on all threads (wall time if the system does not report
/// CPU time), and its result.
fn measure_time<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let cpu = cpu_time();
    let result = work();
    let taken = match (cpu, cpu_time()) {
        (Some(from), Some(to)) => to - from,
        _ => start.elapsed(),
    };
    (taken.as_secs_f64(), result)
}

/// CPU time of the process so far; none if `/proc/self/schedstat` is missing.
fn cpu_time() -> Option<Duration> {
    let tasks = std::fs::read_dir("/proc/self/task").ok()?;
    let mut sum = 0;
    for task in tasks {
        let text = std::fs::read_to_string(task.ok()?.path().join("schedstat")).ok()?;
        sum += text.split_whitespace().next()?.parse::<u64>().ok()?;
    }
    Some(Duration::from_nanos(sum))
}
