//! Checks of a plan, before anything is rendered.

use crate::{Error, refuse_long_names};
use frame::Alignment;
use tracer::check_next_frame;

use super::plan::RunPlan;
use super::planned_case::PlannedCase;
use crate::run::sequence::{Frames, MAX_FRAMES};
use crate::stats::parts::MIN_REPLICATES;

impl RunPlan {
    /// Refuses settings that a scene cannot be rendered with, and names that no folder can have,
    /// before anything is rendered.
    pub fn check(&self) -> Result<(), Error> {
        self.check_frames()?;
        let replicates = self.render.replicates;
        if self.intervals && replicates < MIN_REPLICATES {
            return Err(Error::Refused(format!(
                "found {replicates} replicates of the truth; confidence intervals need {MIN_REPLICATES} or more"
            )));
        }
        for scene in self.all_scenes() {
            for case in PlannedCase::all(self, scene) {
                refuse_long_names(&case.id.folder())?;
            }
        }
        for scene in &self.scenes {
            for frame in 0..self.frames.count {
                let scene = &scene.at_frame(frame);
                self.render.check_frame(scene)?;
                if self.reads_further_velocities() {
                    check_next_frame(scene)?;
                }
                for alignment in self.traced_alignments(frame) {
                    self.render.check_truth(scene, alignment)?;
                }
            }
        }
        for scene in &self.ingested {
            scene.check_truth()?;
            scene.check_size(self.render.size())?;
        }
        for input in &self.inputs {
            let has_scenes = self.ingested.is_empty();
            input.check(self.render.options.velocity, has_scenes)?;
            for scene in &self.scenes {
                input.depth_of_field.check(scene)?;
            }
        }
        Ok(())
    }

    /// Lists the alignments of traced shutters. Trailing and centred truths share their numbers of
    /// samples, since a pilot looks at both. The first frame is defined at all times.
    fn traced_alignments(&self, frame: u32) -> Vec<Alignment> {
        let mut alignments = self.alignments();
        let shares = alignments.contains(&Alignment::Trailing);
        if frame > 0 && shares && !alignments.contains(&Alignment::Centred) {
            alignments.push(Alignment::Centred);
        }
        alignments
    }

    /// Refuses zero or too many frames, and several frames of an engine's scene.
    fn check_frames(&self) -> Result<(), Error> {
        let Frames { count, per_second } = self.frames;
        if !(1..=MAX_FRAMES).contains(&count) {
            return Err(Error::Refused(format!(
                "found {count} frames; allowed: 1 to {MAX_FRAMES}"
            )));
        }
        if !(per_second.is_finite() && per_second > 0.0) {
            return Err(Error::Refused(format!(
                "found {per_second} frames per second; allowed: a number above 0, such as 60"
            )));
        }
        match self.ingested.first() {
            Some(scene) if count > 1 => Err(Error::Refused(format!(
                "{}: an engine drew one frame, and {count} are asked for; leave it out of a sequence",
                scene.id
            ))),
            _ => Ok(()),
        }
    }
}
