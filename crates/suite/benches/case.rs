//! Table of where the time of measuring one case goes: CPU seconds and peak memory of every part.
//!
//! `cargo bench -p suite --bench case -- railing jump_flood:paper 1920x1080` measures that preset on that scene, and its
//! references. Linux alone tells a process its CPU time and its peak memory, by files below /proc.

use std::error::Error;
use std::fs;
use std::path::Path;
use std::sync::Mutex;

use filters::Filter;
use suite::{FilterChoice, Monitor, RunPlan};
use tracer::RenderSettings;

/// Scene, filter preset and size, where the command line names none.
const DEFAULTS: [&str; 3] = ["railing", "jump_flood:paper", "1920x1080"];

/// Samples per pixel of the truth: what it shows does not matter here.
const SAMPLES_PER_PIXEL: u32 = 2;

/// Replicates of the truth: the fewest.
const REPLICATES: u32 = 2;

/// Frames of noise, as in `run`.
const NOISE_FRAMES: u32 = 16;

/// Ticks per second of the kernel's CPU times.
const TICKS_PER_SECOND: f64 = 100.0;

/// CPU time and memory of one part.
#[derive(Clone, Copy, Default)]
struct Cost {
    seconds: f64,
    /// Largest resident size while it ran, in bytes.
    peak: u64,
}

/// The clock, and the costs of all parts that have ended, in their order.
struct Clock {
    ended_at: f64,
    parts: Vec<(&'static str, Cost)>,
}

static CLOCK: Mutex<Clock> = Mutex::new(Clock {
    ended_at: 0.0,
    parts: Vec::new(),
});

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = (std::env::args().skip(1))
        .filter(|word| !word.starts_with("--"))
        .collect();
    let word = |at: usize| words.get(at).map_or(DEFAULTS[at], String::as_str);
    let [scene, filter, size] = [0, 1, 2].map(word);
    let (filter, preset) = filter.split_once(':').ok_or("a filter is filter:preset")?;
    let (width, height) = size.split_once('x').ok_or("a size is 1920x1080")?;
    let out = tempfile::tempdir()?;
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let plan = RunPlan {
        scenes: vec![tracer::load_scene(scenes.join(scene), None)?],
        filters: vec![FilterChoice::new(Filter::builtin(filter)?, preset)?],
        jitter_frames: NOISE_FRAMES,
        render: RenderSettings {
            width: width.parse()?,
            height: height.parse()?,
            samples_per_pixel: SAMPLES_PER_PIXEL,
            replicates: REPLICATES,
            ..RenderSettings::default()
        },
        out: out.path().to_owned(),
        monitor: Monitor {
            ended: note_end,
            ..Monitor::SILENT
        },
        ..RunPlan::default()
    };
    let gpu = suite::open_gpu(&plan.filters, None, plan.monitor)?;
    suite::measure_scenes(&plan, gpu.as_ref(), Vec::new())?;
    println!("{scene}, {filter}:{preset}, {size}");
    print_costs(&CLOCK.lock().expect("no part panics").parts);
    println!("{:6.0} MiB on disk", mebibytes(folder_size(out.path())?));
    Ok(())
}

/// Books the time since the last part's end, and the peak memory of that time, on a part.
fn note_end(part: &'static str) {
    let mut clock = CLOCK.lock().expect("no part panics");
    let now = cpu_seconds();
    let cost = Cost {
        seconds: now - clock.ended_at,
        peak: take_peak(),
    };
    clock.ended_at = now;
    clock.parts.push((part, cost));
}

/// Prints what is done once for a scene, then the parts of the last case, which is the filter's.
fn print_costs(parts: &[(&'static str, Cost)]) {
    let ends = |name: &str| parts.iter().rposition(|(part, _)| *part == name);
    let once = ends("references").map_or(0, |at| at + 1);
    let case = ends("filter made ready").unwrap_or(once);
    println!("once per scene");
    print_sums(&parts[..once]);
    println!("the filter's case");
    print_sums(&parts[case..]);
    let kernels = (parts[case..].iter()).filter(|(part, _)| part.starts_with("kernels"));
    let all: f64 = parts[case..].iter().map(|(_, cost)| cost.seconds).sum();
    let kernels: f64 = kernels.map(|(_, cost)| cost.seconds).sum();
    println!("{:8.2} s  all but kernels", all - kernels);
    let references = parts[once..case].iter().map(|(_, cost)| cost.seconds);
    println!("{:8.2} s  the references' cases", references.sum::<f64>());
}

/// Prints parts of one name as one, in the order of their first ends.
fn print_sums(parts: &[(&'static str, Cost)]) {
    let mut sums: Vec<(&str, Cost)> = Vec::new();
    for (part, cost) in parts {
        let at = sums.iter().position(|(known, _)| known == part);
        let at = at.unwrap_or_else(|| {
            sums.push((part, Cost::default()));
            sums.len() - 1
        });
        sums[at].1.seconds += cost.seconds;
        sums[at].1.peak = sums[at].1.peak.max(cost.peak);
    }
    for (part, cost) in sums {
        let peak = mebibytes(cost.peak);
        println!("{:8.2} s {peak:6.0} MiB  {part}", cost.seconds);
    }
}

fn mebibytes(bytes: u64) -> f64 {
    bytes as f64 / f64::from(1 << 20)
}

/// Reads the CPU time of this process, of all its threads and of the system for it.
fn cpu_seconds() -> f64 {
    let text = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // The name of the program, in brackets, may hold spaces; user and system time are the 12th and 13th word after it.
    let words = text.rsplit(')').next().unwrap_or_default();
    let ticks = words.split_whitespace().skip(11).take(2);
    let ticks: u64 = ticks.flat_map(str::parse::<u64>).sum();
    ticks as f64 / TICKS_PER_SECOND
}

/// Reads the largest resident size since the last call, in bytes, and begins anew.
fn take_peak() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kibibytes = line.and_then(|rest| rest.split_whitespace().next()?.parse::<u64>().ok());
    // Where it cannot be reset, every part shows the peak so far.
    let _ = fs::write("/proc/self/clear_refs", "5");
    kibibytes.unwrap_or(0) << 10
}

/// Sums the sizes of all files below a folder.
fn folder_size(folder: &Path) -> std::io::Result<u64> {
    let mut sum = 0;
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let found = entry.metadata()?;
        sum += match found.is_dir() {
            true => folder_size(&entry.path())?,
            false => found.len(),
        };
    }
    Ok(sum)
}
