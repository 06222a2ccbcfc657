//! Rendered files of a scene, for finding those that need not be rendered again.

use std::path::Path;

use crate::{RenderFile, RenderPath, Wanted};
use frame::Alignment;

use super::ladders::{ladder_hash, needed_rungs};
use super::rendering::Rendering;

/// Lists a truth, its replicates, and the rungs of its ladder that measuring needs: all if ladders
/// are requested.
pub(crate) fn truth_files(
    alignment: Alignment,
    replicates: u32,
    ladders: bool,
) -> impl Iterator<Item = RenderFile> {
    let replicates = (0..replicates).map(move |index| RenderFile::Replicate(alignment, index));
    let rungs = needed_rungs(alignment, ladders).iter();
    let rungs = rungs.map(move |rung| RenderFile::Rung(alignment, *rung));
    std::iter::once(RenderFile::Truth(alignment))
        .chain(replicates)
        .chain(rungs)
}

impl Rendering<'_> {
    /// Lists the scene's frame, and each alignment's [`truth_files`], with the hashes of their
    /// inputs.
    pub(crate) fn list_wanted(&self, alignments: &[Alignment], ladders: bool) -> Vec<Wanted> {
        let (scene, settings) = (self.scene, &self.settings);
        let wanted = |file, hash: &str| Wanted {
            path: RenderPath {
                scene: scene.id.clone(),
                file,
            },
            hash: hash.to_owned(),
        };
        let frame = tracer::frame_hash(scene, settings);
        let mut files = vec![wanted(RenderFile::Frame, &frame)];
        for &alignment in alignments {
            let truth = tracer::truth_hash(scene, settings, alignment);
            let replicate = tracer::replicate_hash(scene, settings, alignment);
            let ladder = ladder_hash(scene, settings, alignment);
            let truth_files = truth_files(alignment, settings.replicates, ladders);
            files.extend(truth_files.map(|file| match file {
                RenderFile::Replicate(..) => wanted(file, &replicate),
                RenderFile::Rung(..) => wanted(file, &ladder),
                RenderFile::Frame | RenderFile::Truth(_) => wanted(file, &truth),
            }));
        }
        files
    }

    /// Lists the frame and the truths that all given folders lack. Headers of files decide: for
    /// each truth, those of its own file, its last replicate and its last rung.
    pub(crate) fn find_missing(
        &self,
        alignments: &[Alignment],
        ladders: bool,
        folders: &[&Path],
    ) -> Vec<RenderFile> {
        let lacks = |file: &Wanted| !folders.iter().any(|folder| file.is_in(folder));
        self.list_wanted(alignments, ladders)
            .chunk_by(|one, next| one.path.file.alignment() == next.path.file.alignment())
            .filter(|group| lacks(&group[0]) || group.last().is_some_and(lacks))
            .map(|group| group[0].path.file)
            .collect()
    }
}
