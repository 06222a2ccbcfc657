//! Replicates of a trailing and a centred truth, rendered together.

use std::ops::Range;
use std::path::Path;

use frame::Alignment;
use store::scene_folder;
use tracer::{RenderSettings, Scene, TruthTracer};

use super::memory::check_memory;
use super::replicates::ReplicateFiles;
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
    SharedReplicates::new(scene, settings, out).render(alignments, indices, monitor)
}

/// The replicates of a trailing and a centred truth, which may be rendered in several steps: what comes before the first takes as long as
/// many samples do.
pub(super) struct SharedReplicates<'a> {
    scene: &'a Scene,
    settings: RenderSettings,
    files: [ReplicateFiles; 2],
    /// Made for the first replicate that is rendered.
    tracer: Option<TruthTracer<'a>>,
}

impl<'a> SharedReplicates<'a> {
    /// Names the files of the truths that `settings` ask for, whatever their number of replicates.
    pub fn new(scene: &'a Scene, settings: &RenderSettings, out: &Path) -> Self {
        let folder = scene_folder(out, scene);
        Self {
            scene,
            settings: *settings,
            files: SHARED
                .map(|alignment| ReplicateFiles::new(folder.clone(), scene, settings, alignment)),
            tracer: None,
        }
    }

    /// Renders some of them as [`render_shared`] does.
    pub fn render(
        &mut self,
        alignments: &[Alignment],
        indices: Range<u32>,
        monitor: Monitor,
    ) -> Result<(), Error> {
        let is_shared = SHARED.iter().all(|shared| alignments.contains(shared));
        let mut files = self.files.iter();
        if !is_shared || files.any(|files| files.has_truth(indices.end)) {
            return Ok(());
        }
        for alignment in SHARED {
            self.settings.check_truth(self.scene, alignment)?;
        }
        // Each pair is written before the next is traced.
        check_memory(self.scene, &self.settings, SHARED.len() as u32)?;
        for index in indices {
            if (self.files.iter()).any(|files| files.read(index).is_some()) {
                continue;
            }
            let tracer = match &mut self.tracer {
                Some(tracer) => tracer,
                none => none.insert(TruthTracer::new(self.scene, &self.settings, &SHARED)?),
            };
            let label = format!("{} trailing and centred, replicate {index}", self.scene.id);
            let replicates = monitor.watch(&label, |watch| tracer.trace(index, watch))?;
            for (files, replicate) in self.files.iter().zip(replicates) {
                replicate.write(&files.path(index))?;
            }
        }
        Ok(())
    }
}
