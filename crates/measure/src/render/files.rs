//! Rendered files of a scene, for finding those that need not be rendered again.

use std::path::PathBuf;

use crate::SHARP;
use crate::files::render_file::{RenderFile, Wanted};
use frame::Alignment;

use super::rendering::Rendering;

impl Rendering<'_> {
    /// Lists the scene's frame, and each alignment's files, with the hashes of their inputs.
    pub(crate) fn list_wanted(&self, alignments: &[Alignment], ladders: bool) -> Vec<Wanted> {
        let frame = Wanted {
            file: RenderFile::Frame,
            hash: self.content_hash(RenderFile::Frame),
        };
        let mut files = vec![frame];
        for &alignment in alignments {
            files.extend(self.list_truth(alignment, ladders));
        }
        files
    }

    /// Lists a truth, its replicates, and the rungs of its ladder that measuring needs: all if
    /// ladders are requested.
    fn list_truth(&self, alignment: Alignment, ladders: bool) -> Vec<Wanted> {
        let truth = RenderFile::Truth(alignment);
        let [replicate, rung] = [
            RenderFile::Replicate(alignment, 0),
            RenderFile::Rung(alignment, SHARP),
        ]
        .map(|file| self.content_hash(file));
        let mut files = vec![Wanted {
            file: truth,
            hash: self.content_hash(truth),
        }];
        files.extend((0..self.settings.replicates).map(|index| Wanted {
            file: RenderFile::Replicate(alignment, index),
            hash: replicate.clone(),
        }));
        let rungs = self.scene.needed_rungs(alignment, ladders).iter();
        files.extend(rungs.map(|subframes| Wanted {
            file: RenderFile::Rung(alignment, *subframes),
            hash: rung.clone(),
        }));
        files
    }

    /// Lists the frame and the truths that all given folders of the scene lack. Headers of files
    /// decide: for each truth, those of its own file, its last replicate and its last rung.
    pub(crate) fn find_missing(
        &self,
        alignments: &[Alignment],
        ladders: bool,
        folders: &[PathBuf],
    ) -> Vec<RenderFile> {
        let lacks = |file: &Wanted| !folders.iter().any(|folder| file.is_in(folder));
        self.list_wanted(alignments, ladders)
            .chunk_by(|one, next| one.file.alignment() == next.file.alignment())
            .filter(|group| lacks(&group[0]) || group.last().is_some_and(lacks))
            .map(|group| group[0].file)
            .collect()
    }
}
