//! The rendering of one scene: each file is rendered once, and later read back.

use std::path::{Path, PathBuf};

use filters::{EXCLUSION, Filter};
use frame::{
    Alignment, Frame, Picture, TracedFrame, read_attribute, read_frame_replicates, write_small_exr,
};
use scene::Scene;
use store::{RenderFile, refuse_scene, scene_folder};
use tracer::{PixelGrid, RenderSettings};

use super::exclusion::{FilterFrame, draw_exclusion};
use super::memory::check_memory;
use super::velocities::add_further_velocities;
use crate::{Error, Monitor};

/// A scene, its render settings, and the run's folder for its files.
#[derive(Clone, Copy)]
pub struct Rendering<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Settings of its frame and its truths: what stands still has the same samples in both.
    pub settings: RenderSettings,
    /// Folder of the run.
    pub out: &'a Path,
    /// Shows progress.
    pub monitor: Monitor,
}

impl Rendering<'_> {
    /// Renders the frame, or reads it from its file if its inputs are the same.
    pub fn frame(&self) -> Result<Frame, Error> {
        refuse_scene(&scene_folder(self.out, self.scene))?;
        let hash = tracer::frame_hash(self.scene, &self.settings);
        if let Ok(frame) = Frame::read(&self.path(RenderFile::Frame))
            && frame.provenance.is_rendered_of(&hash)
        {
            return Ok(frame);
        }
        Ok(self.trace_frame()?.frame)
    }

    /// Reads the replicates of the frame; renders it if its file lacks them, is broken or was made
    /// from other inputs.
    pub fn frame_replicates(&self) -> Result<Vec<Picture>, Error> {
        let path = self.path(RenderFile::Frame);
        let hash = tracer::frame_hash(self.scene, &self.settings);
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
        let settings = self.settings;
        settings.check_frame(self.scene)?;
        self.check_memory(self.settings.replicates)?;
        let label = format!("{} frame", self.scene.id);
        let grid = PixelGrid::of_picture(settings.width, settings.height);
        let traced = (self.monitor).watch(&label, |watch| {
            tracer::trace_frame_part(self.scene, &settings, &grid, None, watch)
        })?;
        assert_eq!(
            traced.frame.provenance.content_hash,
            tracer::frame_hash(self.scene, &settings),
            "{label}: the hash must not depend on the render"
        );
        traced.write(&self.path(RenderFile::Frame))?;
        Ok(traced)
    }

    /// Renders the frame as [`Rendering::frame`] does, with the velocities that few filters read,
    /// which its file need not have.
    pub fn frame_with_further_velocities(&self) -> Result<Frame, Error> {
        let settings = self.settings;
        let grid = PixelGrid::of_picture(settings.width, settings.height);
        add_further_velocities(self.frame()?, self.scene, &settings, &grid)
    }

    /// Renders the frame with what a filter reads.
    pub fn frame_for(&self, filter: &Filter) -> Result<FilterFrame, Error> {
        let frame = if filter.reads_further_velocities() {
            self.frame_with_further_velocities()?
        } else {
            self.frame()?
        };
        let reads = filter.further_inputs().contains(&EXCLUSION);
        let exclusion = reads.then(|| draw_exclusion(&frame, self.scene));
        Ok(FilterFrame { frame, exclusion })
    }

    /// Renders the frame with all that filters may read, and writes all of it to its file.
    pub fn write_further_inputs(&self) -> Result<(), Error> {
        let replicates = self.frame_replicates()?;
        let frame = self.frame_with_further_velocities()?;
        let exclusion = draw_exclusion(&frame, self.scene);
        let mut file = TracedFrame { frame, replicates }.to_exr();
        file.push_plane(EXCLUSION, &exclusion);
        Ok(write_small_exr(&self.path(RenderFile::Frame), file)?)
    }

    /// Names a file of the scene.
    pub(super) fn path(&self, file: RenderFile) -> PathBuf {
        scene_folder(self.out, self.scene).join(file.path())
    }

    /// Refuses a truth that the scene cannot have with these settings.
    pub(super) fn check_truth(&self, alignment: Alignment) -> Result<(), Error> {
        Ok(self.settings.check_truth(self.scene, alignment).map(drop)?)
    }

    /// Refuses to hold a number of replicates together if memory does not suffice.
    pub(super) fn check_memory(&self, replicates: u32) -> Result<(), Error> {
        check_memory(self.scene, &self.settings, replicates)
    }
}
