//! The rendering of one scene: each file is rendered once, and later read back.

use std::path::{Path, PathBuf};

use scene::Scene;

use crate::{Error, Monitor, RenderFile, refuse_scene};
use filters::{EXCLUSION, Filter, Layer};
use frame::{
    Alignment, Frame, Picture, Plane, Provenance, TracedFrame, read_attribute,
    read_frame_replicates, write_small_exr,
};
use tracer::{PixelGrid, RenderSettings};

use super::exclusion::{FilterFrame, draw_exclusion};
use super::ingested_scene::refuse_file;
use super::memory::check_memory;
use super::run_scene::RunScene;
use super::velocities::add_further_velocities;

/// A scene, its render settings, and the run's folder for its files.
#[derive(Clone, Copy)]
pub struct Rendering<'a> {
    /// The scene.
    pub scene: RunScene<'a>,
    /// Settings of its frame and its truths: what stands still has the same samples in both.
    pub settings: RenderSettings,
    /// Folder of the run.
    pub out: &'a Path,
    /// Shows progress.
    pub monitor: Monitor,
}

impl<'a> Rendering<'a> {
    /// Renders the frame, or reads it from its file if its inputs are the same.
    pub fn frame(&self) -> Result<Frame, Error> {
        refuse_scene(&self.folder())?;
        let hash = self.content_hash(RenderFile::Frame);
        if let Ok(frame) = Frame::read(&self.path(RenderFile::Frame))
            && self.is_made(&frame.provenance, &hash)
        {
            return Ok(frame);
        }
        Ok(self.trace_frame()?.frame)
    }

    /// Reads the replicates of the frame; renders it if its file lacks them, is broken or was made
    /// from other inputs.
    pub fn frame_replicates(&self) -> Result<Vec<Picture>, Error> {
        let path = self.path(RenderFile::Frame);
        let hash = self.content_hash(RenderFile::Frame);
        if read_attribute(&path, "content_hash") == Some(hash)
            && let Ok(replicates) = read_frame_replicates(&path)
            && !replicates.is_empty()
        {
            return Ok(replicates);
        }
        Ok(self.trace_frame()?.replicates)
    }

    /// Renders the frame and writes it with its replicates.
    fn trace_frame(&self) -> Result<TracedFrame, Error> {
        let scene = self.traced(RenderFile::Frame)?;
        let settings = self.settings;
        settings.check_frame(scene)?;
        self.check_memory(self.settings.replicates)?;
        let label = format!("{} frame", scene.id);
        let grid = PixelGrid::of_picture(settings.width, settings.height);
        let traced = (self.monitor).watch(&label, |watch| {
            tracer::trace_frame_part(scene, &settings, &grid, None, watch)
        })?;
        assert_eq!(
            traced.frame.provenance.content_hash,
            self.content_hash(RenderFile::Frame),
            "{label}: the hash must not depend on the render"
        );
        traced.write(&self.path(RenderFile::Frame))?;
        Ok(traced)
    }

    /// Renders the frame as [`Rendering::frame`] does, with the velocities that few filters read,
    /// which its file need not have. An engine's frame has what the engine gave.
    pub fn frame_with_further_velocities(&self) -> Result<Frame, Error> {
        let Some(scene) = self.scene.traced() else {
            return self.frame();
        };
        let settings = self.settings;
        let grid = PixelGrid::of_picture(settings.width, settings.height);
        add_further_velocities(self.frame()?, scene, &settings, &grid)
    }

    /// Renders the frame with what a filter reads.
    pub fn frame_for(&self, filter: &Filter) -> Result<FilterFrame, Error> {
        let frame = if filter.reads_further_velocities() {
            self.frame_with_further_velocities()?
        } else {
            self.frame()?
        };
        let reads = filter.further_inputs().contains(&Layer::Exclusion);
        let exclusion = if reads { self.exclusion(&frame)? } else { None };
        Ok(FilterFrame { frame, exclusion })
    }

    /// Draws the mask of what a blur leaves alone in the scene's frame, whatever its form, or reads
    /// an engine's; none if the engine gave none.
    pub(crate) fn exclusion(&self, frame: &Frame) -> Result<Option<Plane>, Error> {
        match self.scene {
            RunScene::Traced(scene) => Ok(Some(draw_exclusion(frame, scene))),
            RunScene::Ingested(scene) => scene.read_exclusion(frame),
        }
    }

    /// Renders the frame with all that filters may read, and writes all of it to its file.
    pub fn write_further_inputs(&self) -> Result<(), Error> {
        let replicates = self.frame_replicates()?;
        let frame = self.frame_with_further_velocities()?;
        let exclusion = self.exclusion(&frame)?;
        let mut file = TracedFrame { frame, replicates }.to_exr();
        if let Some(exclusion) = exclusion {
            file.push_plane(EXCLUSION, &exclusion);
        }
        Ok(write_small_exr(&self.path(RenderFile::Frame), file)?)
    }

    /// Names the folder of the scene's files.
    pub(crate) fn folder(&self) -> PathBuf {
        self.out.join(self.scene.id().folder())
    }

    /// Returns the scene to trace a missing file of. Refuses an engine's: its files were copied
    /// unless they differ from the ingested ones.
    pub(super) fn traced(&self, file: RenderFile) -> Result<&'a Scene, Error> {
        (self.scene.traced()).ok_or_else(|| refuse_file(&self.path(file)))
    }

    /// Returns the hash of the inputs of a file.
    pub(crate) fn content_hash(&self, file: RenderFile) -> String {
        self.scene.content_hash(file, &self.settings)
    }

    /// Returns whether a file was made from the inputs with this hash. False for a file that
    /// another engine drew, whatever its hash.
    pub(super) fn is_made(&self, file: &Provenance, hash: &str) -> bool {
        file.content_hash == hash && file.engine.as_deref() == self.scene.engine()
    }

    /// Names a file of the scene.
    pub(super) fn path(&self, file: RenderFile) -> PathBuf {
        self.folder().join(file.path())
    }

    /// Refuses a truth that the scene cannot have with these settings.
    pub(super) fn check_truth(&self, alignment: Alignment) -> Result<(), Error> {
        let scene = self.traced(RenderFile::Truth(alignment))?;
        Ok(self.settings.check_truth(scene, alignment).map(drop)?)
    }

    /// Refuses to hold a number of replicates together if memory does not suffice.
    pub(super) fn check_memory(&self, replicates: u32) -> Result<(), Error> {
        (self.scene.traced()).map_or(Ok(()), |scene| {
            check_memory(scene, &self.settings, replicates)
        })
    }
}
