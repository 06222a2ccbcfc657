//! Estimate of the memory that a render takes, before it begins.

use std::fs;

use tracer::{RenderSettings, Scene};

use crate::Error;

/// Memory of the program without any picture, in bytes.
const PROGRAM: u64 = 80 << 20;
/// Bytes per pixel of a truth, beside its replicates and coverages. This number and the next ones are measured slopes of the largest
/// resident size of `render` and `run`, between 512x512 and 1024x1024 pixels and between 6 and 11 coverages.
const PER_PIXEL: u64 = 400;
/// Bytes per pixel and coverage.
const PER_COVERAGE: u64 = 27;
/// Bytes per pixel and replicate: its colour, its reference to the instant, and its support.
const PER_REPLICATE: u64 = 55;
/// Bytes per pixel, replicate and coverage.
const PER_REPLICATE_COVERAGE: u64 = 3;
/// Bytes per pixel of a frame's guard band.
const PER_BAND_PIXEL: u64 = 300;
/// Bytes per pixel of the guard band and coverage.
const PER_BAND_COVERAGE: u64 = 30;
/// Bytes per triangle of a scene while its trees are built.
const PER_TRIANGLE: u64 = 600;
/// Bytes per object and thread: its pose now and at the instant.
const PER_POSE: u64 = 500;

/// Memory of measuring without any picture, in bytes.
const MEASURING: u64 = 136 << 20;
/// Bytes per pixel of a frame, of the truth that filters are measured by, and of the case that is measured, beside their coverages,
/// for any number of replicates.
const PER_MEASURED_PIXEL: u64 = 780;
/// Bytes per such pixel and coverage.
const PER_MEASURED_COVERAGE: u64 = 43;
/// Bytes per pixel of the colours of a further truth.
const PER_FURTHER_TRUTH: u64 = 330;
/// Bytes per pixel of a further form of the frame, beside its coverages: what its rasters hold.
const PER_FURTHER_FORM: u64 = 32;
/// Bytes per such pixel and coverage.
const PER_FURTHER_FORM_COVERAGE: u64 = 4;

/// Refuses to render a frame, and a truth of a number of replicates, where memory does not suffice. Refuses nothing where the
/// system does not tell what is free.
pub(crate) fn check_memory(
    scene: &Scene,
    settings: &RenderSettings,
    replicates: u32,
) -> Result<(), Error> {
    refuse_beyond_free(
        scene,
        settings,
        rendering_memory(scene, settings, replicates),
    )
}

/// Refuses to measure filters on a scene where memory does not suffice to render or to measure it.
pub(crate) fn check_measuring_memory(
    scene: &Scene,
    settings: &RenderSettings,
    truths: usize,
    forms: usize,
) -> Result<(), Error> {
    let needed = measuring_memory(scene, settings, truths, forms);
    refuse_beyond_free(scene, settings, needed)
}

/// Estimates the bytes that it takes to render a scene and to measure filters against a number of its truths, each on a number of forms
/// of the frame.
pub(crate) fn measuring_memory(
    scene: &Scene,
    settings: &RenderSettings,
    truths: usize,
    forms: usize,
) -> u64 {
    let pixels = u64::from(settings.width) * u64::from(settings.height);
    let coverages = count_coverages(scene);
    let further_truths = PER_FURTHER_TRUTH * truths.saturating_sub(1) as u64;
    let form = PER_FURTHER_FORM + PER_FURTHER_FORM_COVERAGE * coverages;
    let further_forms = form * forms.saturating_sub(1) as u64;
    let further = further_truths + further_forms;
    let pixel = PER_MEASURED_PIXEL + PER_MEASURED_COVERAGE * coverages + further;
    let measuring = MEASURING.saturating_add(pixels.saturating_mul(pixel));
    measuring.max(rendering_memory(scene, settings, settings.replicates))
}

fn refuse_beyond_free(scene: &Scene, settings: &RenderSettings, needed: u64) -> Result<(), Error> {
    match free() {
        Some(free) if free < needed => Err(Error::Usage(format!(
            "scene {}: needs about {} for {}x{} pixels of color and {} coverages, {} are free; choose a smaller size, \
             fewer replicates or a scene of fewer objects, or free memory",
            scene.id,
            gibibytes(needed),
            settings.width,
            settings.height,
            count_coverages(scene),
            gibibytes(free),
        ))),
        _ => Ok(()),
    }
}

/// Counts channels of coverage: one for the background and one per object.
fn count_coverages(scene: &Scene) -> u64 {
    scene.objects.len() as u64 + 1
}

/// Estimates the largest resident size of a render, in bytes.
fn rendering_memory(scene: &Scene, settings: &RenderSettings, replicates: u32) -> u64 {
    let area = |band: u32| {
        let side = |side: u32| u64::from(side) + 2 * u64::from(band);
        side(settings.width).saturating_mul(side(settings.height))
    };
    let pixels = area(0);
    let band = area(settings.guard_band) - pixels;
    let coverages = count_coverages(scene);
    let replicate = PER_REPLICATE + PER_REPLICATE_COVERAGE * coverages;
    let pixel =
        PER_PIXEL + PER_COVERAGE * coverages + u64::from(replicates).saturating_mul(replicate);
    let band_pixel = PER_BAND_PIXEL + PER_BAND_COVERAGE * coverages;
    let triangles: usize = scene.meshes.iter().map(|mesh| mesh.triangles.len()).sum();
    let threads = rayon::current_num_threads() as u64;
    [
        pixels.saturating_mul(pixel),
        band.saturating_mul(band_pixel),
        triangles as u64 * PER_TRIANGLE,
        threads * coverages * PER_POSE,
    ]
    .into_iter()
    .fold(PROGRAM, u64::saturating_add)
}

/// `1.2 GiB`
fn gibibytes(bytes: u64) -> String {
    format!("{:.1} GiB", bytes as f64 / f64::from(1 << 30))
}

/// Returns the bytes that this process may still take: the least that the system, its control group and its own limit allow.
fn free() -> Option<u64> {
    if !cfg!(target_os = "linux") {
        return None;
    }
    [free_in_system(), free_in_group(), free_in_process()]
        .into_iter()
        .flatten()
        .min()
}

/// Reads the memory that the system has left.
fn free_in_system() -> Option<u64> {
    let text = fs::read_to_string("/proc/meminfo").ok()?;
    Some(entry(&text, "MemAvailable:")? << 10)
}

/// Reads what the control group of the process leaves (cgroup v2); where a container hides the path to it, what the topmost visible
/// group leaves.
fn free_in_group() -> Option<u64> {
    let groups = fs::read_to_string("/proc/self/cgroup").unwrap_or_default();
    let own = groups.lines().find_map(|line| line.strip_prefix("0::/"));
    let folders = [
        format!("/sys/fs/cgroup/{}", own.unwrap_or_default()),
        "/sys/fs/cgroup".into(),
    ];
    let left = folders.iter().filter_map(|folder| {
        let read = |name: &str| fs::read_to_string(format!("{folder}/{name}")).ok();
        // "max" is no number: no limit.
        let most: u64 = read("memory.max")?.trim().parse().ok()?;
        let used: u64 = read("memory.current")?.trim().parse().ok()?;
        let cached = entry(&read("memory.stat")?, "inactive_file").unwrap_or(0);
        Some(most.saturating_sub(used.saturating_sub(cached)))
    });
    left.min()
}

/// Reads what `ulimit -v` leaves.
fn free_in_process() -> Option<u64> {
    let limits = fs::read_to_string("/proc/self/limits").ok()?;
    let most = entry(&limits, "Max address space")?;
    let used = entry(&fs::read_to_string("/proc/self/status").ok()?, "VmSize:")? << 10;
    Some(most.saturating_sub(used))
}

/// Reads the first number after a name at the beginning of a line; none where there is another word.
fn entry(text: &str, name: &str) -> Option<u64> {
    let rest = text.lines().find_map(|line| line.strip_prefix(name))?;
    rest.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_found_behind_their_names_and_no_limit_is_none() {
        let limits =
            "Limit   Soft Limit  Hard Limit  Units\nMax address space    1200  unlimited   bytes\n";
        assert_eq!(entry(limits, "Max address space"), Some(1200));
        assert_eq!(
            entry(
                "Max address space  unlimited unlimited",
                "Max address space"
            ),
            None
        );
        assert_eq!(
            entry("MemTotal: 5 kB\nMemAvailable:    77 kB\n", "MemAvailable:"),
            Some(77)
        );
    }
}
