//! Files of a truth and of its replicates.

use std::ops::Range;

use crate::{Error, RenderFile};
use frame::{Alignment, Replicate, Truth, read_attribute, truth_hash};
use rayon::prelude::*;
use tracer::TruthTracer;

use super::rendering::Rendering;

/// Replicates that are read at once. Each needs the memory of one more picture meanwhile, which the
/// bound of memory counts.
const READ_TOGETHER: usize = 4;

/// The tracers of a scene's truths, by their alignments. Each is made for its first replicate, and
/// keeps its pilot and its supports.
#[derive(Default)]
pub(super) struct Tracers<'a>(Vec<(Vec<Alignment>, TruthTracer<'a>)>);

/// The files of one truth, and the hash of their inputs.
pub(crate) struct TruthFiles<'a> {
    rendering: Rendering<'a>,
    alignment: Alignment,
    /// Content hash that every replicate must have.
    hash: String,
}

impl<'a> Rendering<'a> {
    /// Names the files of a truth.
    pub(crate) fn files(&self, alignment: Alignment) -> TruthFiles<'a> {
        TruthFiles {
            rendering: *self,
            alignment,
            hash: self.content_hash(RenderFile::Replicate(alignment, 0)),
        }
    }

    /// Renders and writes the replicates that a trailing and a centred truth both lack; does
    /// nothing unless `alignments` contains both.
    ///
    /// Samples are traced once where the two shutters overlap. Both truths together need three
    /// quarters of the time of rendering one after the other, and have the same bytes.
    pub fn shared(&self, alignments: &[Alignment], indices: Range<u32>) -> Result<(), Error> {
        self.share(alignments, indices, &mut Tracers::default())
    }

    /// Does the work of [`Rendering::shared`].
    pub(super) fn share(
        &self,
        alignments: &[Alignment],
        indices: Range<u32>,
        tracers: &mut Tracers<'a>,
    ) -> Result<(), Error> {
        const SHARED: [Alignment; 2] = [Alignment::Trailing, Alignment::Centred];
        if !SHARED.iter().all(|shared| alignments.contains(shared)) {
            return Ok(());
        }
        let files = SHARED.map(|alignment| self.files(alignment));
        if files.iter().any(|files| files.has_truth(indices.end)) {
            return Ok(());
        }
        for alignment in SHARED {
            self.check_truth(alignment)?;
        }
        // Each pair is written before the next is traced.
        self.check_memory(SHARED.len() as u32)?;
        for index in indices {
            if !files.iter().any(|files| files.has_replicate(index)) {
                render_replicate(&files, index, tracers)?;
            }
        }
        Ok(())
    }
}

impl<'a> TruthFiles<'a> {
    /// Reads the truth; none if the file is missing, broken or made from other inputs.
    pub fn read_truth(&self) -> Option<Truth> {
        let count = self.rendering.settings.replicates;
        let path = self.rendering.path(RenderFile::Truth(self.alignment));
        let truth = (self.has_truth(count)).then(|| Truth::read(&path))?;
        let hash = truth_hash(&self.hash, count);
        (truth.ok()).filter(|truth| self.rendering.is_made(&truth.provenance, &hash))
    }

    /// Averages the replicates, and renders missing ones.
    pub(super) fn average(&self, tracers: &mut Tracers<'a>) -> Result<Truth, Error> {
        let count = self.rendering.settings.replicates;
        self.rendering.check_memory(count)?;
        Ok(Truth::of(&self.replicates_by(0..count, tracers)?)?)
    }

    /// Writes the truth.
    pub fn write(&self, truth: &Truth) -> Result<(), Error> {
        Ok(truth.write(&self.rendering.path(RenderFile::Truth(self.alignment)))?)
    }

    /// Returns replicates by their indices. Reads existing ones; renders the others and writes each
    /// as soon as it is complete. Replaces a file that is broken or was made from other inputs.
    pub fn replicates(&self, indices: Range<u32>) -> Result<Vec<Replicate>, Error> {
        self.replicates_by(indices, &mut Tracers::default())
    }

    fn replicates_by(
        &self,
        indices: Range<u32>,
        tracers: &mut Tracers<'a>,
    ) -> Result<Vec<Replicate>, Error> {
        self.rendering.check_truth(self.alignment)?;
        let files = std::slice::from_ref(self);
        let indices: Vec<u32> = indices.collect();
        let mut replicates = Vec::with_capacity(indices.len());
        for together in indices.chunks(READ_TOGETHER) {
            let read = together.par_iter().map(|&index| self.read(index));
            for (&index, replicate) in together.iter().zip(read.collect::<Vec<_>>()) {
                replicates.push(match replicate {
                    Some(replicate) => replicate,
                    None => render_replicate(files, index, tracers)?.remove(0),
                });
            }
        }
        Ok(replicates)
    }

    /// Returns whether the header of the truth's file names this many of these replicates.
    fn has_truth(&self, replicates: u32) -> bool {
        let file = RenderFile::Truth(self.alignment);
        self.is_of(file, &truth_hash(&self.hash, replicates))
    }

    /// Returns whether the header of a replicate's file names these inputs.
    fn has_replicate(&self, index: u32) -> bool {
        let file = RenderFile::Replicate(self.alignment, index);
        self.is_of(file, &self.hash)
    }

    /// Returns whether a file's header has this content hash.
    fn is_of(&self, file: RenderFile, hash: &str) -> bool {
        read_attribute(&self.rendering.path(file), "content_hash").as_deref() == Some(hash)
    }

    /// Reads a replicate; none if it is missing, broken or made from other inputs.
    fn read(&self, index: u32) -> Option<Replicate> {
        let file = RenderFile::Replicate(self.alignment, index);
        let replicate = Replicate::read(&self.rendering.path(file)).ok()?;
        let is_made = self.rendering.is_made(&replicate.provenance, &self.hash);
        (is_made && replicate.index == index).then_some(replicate)
    }
}

impl<'a> Tracers<'a> {
    /// Returns the tracer of some truths of the rendering's scene, size, seed and samples per
    /// replicate.
    fn of(
        &mut self,
        rendering: &Rendering<'a>,
        alignments: &[Alignment],
    ) -> Result<&TruthTracer<'a>, Error> {
        let Self(tracers) = self;
        let at = match tracers.iter().position(|(of, _)| of == alignments) {
            Some(at) => at,
            None => {
                let scene = rendering.traced(RenderFile::Truth(alignments[0]))?;
                let made = TruthTracer::new(scene, &rendering.settings, alignments)?;
                tracers.push((alignments.to_vec(), made));
                tracers.len() - 1
            }
        };
        Ok(&tracers[at].1)
    }
}

/// Traces one replicate of each of several truths of a scene together, and writes each to its file.
fn render_replicate<'a>(
    files: &[TruthFiles<'a>],
    index: u32,
    tracers: &mut Tracers<'a>,
) -> Result<Vec<Replicate>, Error> {
    let alignments: Vec<Alignment> = files.iter().map(|files| files.alignment).collect();
    let names: Vec<&str> = alignments
        .iter()
        .map(|alignment| alignment.name())
        .collect();
    let rendering = files[0].rendering;
    let tracer = tracers.of(&rendering, &alignments)?;
    let names = names.join(" and ");
    let label = format!("{} {names}, replicate {index}", rendering.scene.id());
    let replicates = (rendering.monitor).watch(&label, |watch| tracer.trace(index, watch))?;
    replicates.par_iter().try_for_each(|replicate| {
        let file = RenderFile::Replicate(replicate.alignment, index);
        replicate.write(&rendering.path(file))
    })?;
    Ok(replicates)
}
