//! Estimate of the memory that a render takes, before it begins.

use std::fs;

use tracer::{RenderSettings, Scene};

use crate::Error;

/// Memory of the program without any picture, in bytes.
const PROGRAM: u64 = 136 << 20;
/// Bytes per pixel of a picture beside its coverages: fourteen floats for its colour, its samples, and what is known of the instant.
const PER_PIXEL: u64 = 56 + 2;
/// Bytes per pixel of a coverage: a float, and the mask of its support.
const PER_COVERAGE: u64 = 4 + 1;
/// Bytes per triangle of a scene while its trees are built.
const PER_TRIANGLE: u64 = 600;
/// Bytes per object and thread: its pose now and at the instant.
const PER_POSE: u64 = 500;

/// Pictures that a truth takes beside its replicates. This number and the next ones bound the largest resident sizes of `render` and
/// `run` that were measured, from 512x512 to 1024x1024 pixels and from 6 to 11 coverages: its mean, its halves, and what is written of it to a file.
const PICTURES_OF_TRUTH: u64 = 7;
/// Pictures that the guard band of a frame takes.
const PICTURES_OF_BAND: u64 = 6;
/// Pictures of a frame, of the truth that filters are measured by, and of the case that is measured, for any number of replicates.
const PICTURES_MEASURED: u64 = 14;
/// Pictures without coverages that the colours of a further truth take.
const COLORS_OF_FURTHER_TRUTH: u64 = 6;

/// Refuses to render a frame, and a truth of a number of replicates, where memory does not suffice. Refuses nothing where the
/// system does not tell what is free.
pub(crate) fn check_memory(
    scene: &Scene,
    settings: &RenderSettings,
    replicates: u32,
) -> Result<(), Error> {
    let needed = rendering_memory(scene, settings, replicates);
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
    let further_forms = forms.saturating_sub(1) as u64;
    let further_colors = COLORS_OF_FURTHER_TRUTH * truths.saturating_sub(1) as u64;
    let pixel = (PICTURES_MEASURED + further_forms) * per_pixel(scene) + further_colors * PER_PIXEL;
    let measuring = PROGRAM.saturating_add(pixels.saturating_mul(pixel));
    measuring.max(rendering_memory(scene, settings, settings.replicates))
}

/// Refuses to render or to measure a scene if that needs more bytes than are free.
pub(crate) fn refuse_beyond_free(
    scene: &Scene,
    settings: &RenderSettings,
    needed: u64,
) -> Result<(), Error> {
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

/// Bounds the bytes per pixel of one picture with its coverages.
fn per_pixel(scene: &Scene) -> u64 {
    PER_PIXEL + PER_COVERAGE * count_coverages(scene)
}

/// Estimates the largest resident size of a render, in bytes.
fn rendering_memory(scene: &Scene, settings: &RenderSettings, replicates: u32) -> u64 {
    let area = |band: u32| {
        let side = |side: u32| u64::from(side) + 2 * u64::from(band);
        side(settings.width).saturating_mul(side(settings.height))
    };
    let pixels = area(0);
    let band = area(settings.guard_band) - pixels;
    let pictures = PICTURES_OF_TRUTH.saturating_add(u64::from(replicates));
    let triangles: usize = scene.meshes.iter().map(|mesh| mesh.triangles.len()).sum();
    let threads = rayon::current_num_threads() as u64;
    [
        pixels.saturating_mul(pictures.saturating_mul(per_pixel(scene))),
        band.saturating_mul(PICTURES_OF_BAND * per_pixel(scene)),
        triangles as u64 * PER_TRIANGLE,
        threads * count_coverages(scene) * PER_POSE,
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
