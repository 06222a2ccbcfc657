//! Upper bound on a render's memory before it begins.

use std::fs;

use scene::Scene;
use tracer::RenderSettings;

use crate::Error;

/// Memory of the program without any picture, in bytes.
const PROGRAM: u64 = 136 << 20;
/// Bytes per pixel of a picture without its coverages: fourteen floats for its colour, its samples,
/// and what is known of the instant.
const PER_PIXEL: u64 = 56 + 2;
/// Bytes per pixel of a coverage: a float, and the mask of its support.
const PER_COVERAGE: u64 = 4 + 1;
/// Bytes per triangle of a scene while its trees are built.
const PER_TRIANGLE: u64 = 600;

/// Pictures of a truth in addition to its replicates: its mean, its halves, and the contents of its
/// file. This number and the next ones bound the largest resident sizes of `render` and `run`,
/// measured from 512x512 to 1024x1024 pixels and from 6 to 11 coverages.
const PICTURES_OF_TRUTH: u64 = 7;
/// Pictures of a frame, of the truth that filters are measured by, and of the measured case, for
/// any number of replicates.
const PICTURES_MEASURED: u64 = 14;
/// Pictures of each part of frame and truth, from which intervals leave out replicates: the part's
/// own, and all that is prepared to measure by the part.
const PICTURES_OF_PART: u64 = 10;
/// Pictures of each further truth.
const PICTURES_OF_FURTHER_TRUTH: u64 = 6;

/// Refuses to render a frame and a truth of a number of replicates if that needs more bytes than
/// are free. Refuses nothing if the system does not report free memory.
pub(crate) fn check_memory(
    scene: &Scene,
    settings: &RenderSettings,
    replicates: u32,
) -> Result<(), Error> {
    refuse_beyond_free(scene, settings, count_rendered(replicates))
}

/// Counts the pictures of a truth of this many replicates.
fn count_rendered(replicates: u32) -> u64 {
    PICTURES_OF_TRUTH + u64::from(replicates)
}

/// What a scene is measured with.
#[derive(Clone, Copy)]
pub(crate) struct Measured {
    /// Truths.
    pub truths: usize,
    /// Forms of the frame that filters get.
    pub forms: usize,
    /// Parts of frame and truth that intervals are computed from.
    pub parts: usize,
}

/// Counts the pictures in memory at once while a scene is rendered and filters are measured.
pub(crate) fn count_measured(settings: &RenderSettings, measured: Measured) -> u64 {
    let further = |count: usize| count.saturating_sub(1) as u64;
    let of_truths = PICTURES_OF_FURTHER_TRUTH * further(measured.truths);
    let whole = PICTURES_MEASURED + of_truths + further(measured.forms);
    whole.max(count_rendered(settings.replicates)) + PICTURES_OF_PART * measured.parts as u64
}

/// Bounds the memory of a number of pictures of a scene and of all else, in bytes.
pub(crate) fn bound_memory(scene: &Scene, settings: &RenderSettings, pictures: u64) -> u64 {
    let side = |side: u32| u64::from(side) + 2 * u64::from(settings.guard_band);
    let picture = side(settings.width)
        .saturating_mul(side(settings.height))
        .saturating_mul(PER_PIXEL + PER_COVERAGE * count_coverages(scene));
    let triangles: usize = scene.meshes.iter().map(|mesh| mesh.triangles.len()).sum();
    (PROGRAM + triangles as u64 * PER_TRIANGLE).saturating_add(picture.saturating_mul(pictures))
}

/// Refuses to render or to measure a scene if its pictures need more bytes than are free.
pub(crate) fn refuse_beyond_free(
    scene: &Scene,
    settings: &RenderSettings,
    pictures: u64,
) -> Result<(), Error> {
    let needed = bound_memory(scene, settings, pictures);
    match free() {
        Some(free) if free < needed => Err(Error::Refused(format!(
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

/// `1.2 GiB`
fn gibibytes(bytes: u64) -> String {
    format!("{:.1} GiB", bytes as f64 / f64::from(1 << 30))
}

/// Returns the bytes that this process may still use: the least that the system, its control group
/// and its own limit allow.
fn free() -> Option<u64> {
    if !cfg!(target_os = "linux") {
        return None;
    }
    [free_in_system(), free_in_group(), free_in_process()]
        .into_iter()
        .flatten()
        .min()
}

/// Reads the system's free memory.
fn free_in_system() -> Option<u64> {
    let text = fs::read_to_string("/proc/meminfo").ok()?;
    Some(entry(&text, "MemAvailable:")? << 10)
}

/// Reads the free memory of the process's control group (cgroup v2), or of the topmost visible
/// group if a container hides the path to it.
fn free_in_group() -> Option<u64> {
    let groups = fs::read_to_string("/proc/self/cgroup").unwrap_or_default();
    let group = groups.lines().find_map(|line| line.strip_prefix("0::/"));
    let folders = [
        format!("/sys/fs/cgroup/{}", group.unwrap_or_default()),
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

/// Reads the memory that `ulimit -v` leaves.
fn free_in_process() -> Option<u64> {
    let limits = fs::read_to_string("/proc/self/limits").ok()?;
    let most = entry(&limits, "Max address space")?;
    let used = entry(&fs::read_to_string("/proc/self/status").ok()?, "VmSize:")? << 10;
    Some(most.saturating_sub(used))
}

/// Reads the first number after a name at the beginning of a line; none if another word follows.
fn entry(text: &str, name: &str) -> Option<u64> {
    let rest = text.lines().find_map(|line| line.strip_prefix(name))?;
    rest.split_whitespace().next()?.parse().ok()
}
