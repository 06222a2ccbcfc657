//! Replicates of a trailing and a centred truth, rendered together.

use std::ops::Range;
use std::path::Path;

use frame::Alignment;
use store::scene_folder;
use tracer::{RenderSettings, Scene};

use super::memory::check_memory;
use super::replicates::{ReplicateFiles, render_replicate};
use crate::{Error, Monitor};

const SHARED: [Alignment; 2] = [Alignment::Trailing, Alignment::Centred];

/// Renders those replicates that a trailing and a centred truth both lack, and writes them to `out`; does nothing unless
/// `alignments` holds both.
///
/// Where the two shutters overlap their samples are traced once. Both truths together take three quarters of the time of one
/// after the other, and have the same bytes.
pub fn render_shared(
    scene: &Scene,
    settings: &RenderSettings,
    alignments: &[Alignment],
    indices: Range<u32>,
    out: &Path,
    monitor: Monitor,
) -> Result<(), Error> {
    if !SHARED.iter().all(|shared| alignments.contains(shared)) {
        return Ok(());
    }
    let folder = scene_folder(out, scene);
    let files =
        SHARED.map(|alignment| ReplicateFiles::new(folder.clone(), scene, settings, alignment));
    if files.iter().any(|files| files.has_truth(indices.end)) {
        return Ok(());
    }
    for alignment in SHARED {
        settings.check_truth(scene, alignment)?;
    }
    // Each pair is written before the next is traced.
    check_memory(scene, settings, SHARED.len() as u32)?;
    let mut tracer = None;
    for index in indices {
        if files.iter().all(|files| files.read(index).is_none()) {
            render_replicate(&files, index, scene, settings, &mut tracer, monitor)?;
        }
    }
    Ok(())
}
