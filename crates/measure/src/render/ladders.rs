//! Ladders of sub-frame accumulations.

use std::cell::OnceCell;
use std::path::PathBuf;

use crate::{Error, LADDER, RenderFile, SHARP};
use frame::{Accumulation, Alignment, Frame, Ladder, Truth, read_attribute};
use metrics::Sharp;
use tracer::LadderTracer;

use super::rendering::Rendering;

/// Returns the sharp picture of the middle of a truth's shutter: the frame if that is its instant,
/// or else the rung [`SHARP`] from `read`. `frame` has no guard band.
pub fn sharp_picture<E>(
    frame: &Frame,
    truth: &Truth,
    read: impl FnOnce() -> Result<Accumulation, E>,
) -> Result<Sharp, E> {
    match truth.alignment {
        Alignment::Centred => Ok(Sharp::Frame(frame.picture())),
        _ => Ok(Sharp::Accumulation(read()?)),
    }
}

/// The ladder of one truth, with a file for each rung: together the rungs would need more memory
/// than all else in measuring.
pub struct LadderFiles<'a> {
    rendering: Rendering<'a>,
    truth: &'a Truth,
    /// Hash of the inputs.
    hash: String,
    /// Made for the first rendered rung.
    tracer: OnceCell<LadderTracer<'a>>,
}

impl<'a> Rendering<'a> {
    /// Names a truth's ladder; the truth was rendered with these settings.
    pub fn ladder(&self, truth: &'a Truth) -> LadderFiles<'a> {
        LadderFiles {
            rendering: *self,
            hash: self.content_hash(RenderFile::Rung(truth.alignment, SHARP)),
            truth,
            tracer: OnceCell::new(),
        }
    }
}

impl<'a> LadderFiles<'a> {
    /// Renders some of the rungs and writes them, except those with files of the same inputs.
    pub fn ensure(&self, rungs: &[u32]) -> Result<(), Error> {
        for subframes in rungs {
            let hash = read_attribute(&self.path(*subframes), "content_hash");
            if hash.as_ref() != Some(&self.hash) {
                self.render(*subframes)?;
            }
        }
        Ok(())
    }

    /// Reads one rung; renders it if it is missing, broken or made from other inputs.
    pub fn read_or_render(&self, subframes: u32) -> Result<Ladder, Error> {
        let path = self.path(subframes);
        if let Ok(ladder) = Ladder::read_rung(&path, subframes)
            && self.rendering.is_made(&ladder.provenance, &self.hash)
        {
            return Ok(ladder);
        }
        self.render(subframes)?;
        Ok(Ladder::read_rung(&path, subframes)?)
    }

    fn path(&self, subframes: u32) -> PathBuf {
        (self.rendering).path(RenderFile::Rung(self.truth.alignment, subframes))
    }

    fn render(&self, subframes: u32) -> Result<(), Error> {
        let label = format!(
            "{} {subframes} sub-frames, {}",
            self.rendering.scene.id(),
            self.truth.alignment
        );
        let rung = (self.rendering.monitor).watch(&label, |watch| {
            Ok::<_, Error>(self.tracer()?.trace(subframes, watch)?)
        })?;
        assert_eq!(
            rung.provenance.content_hash, self.hash,
            "{label}: the hash must not depend on the render"
        );
        Ok(rung.write(&self.path(subframes))?)
    }

    fn tracer(&self) -> Result<&LadderTracer<'a>, Error> {
        if self.tracer.get().is_none() {
            let settings = &self.rendering.settings;
            let file = RenderFile::Rung(self.truth.alignment, SHARP);
            let scene = self.rendering.traced(file)?;
            let made = LadderTracer::new(scene, settings, self.truth, &LADDER)?;
            // It was empty, and no other thread can see it.
            let _ = self.tracer.set(made);
        }
        Ok(self.tracer.get().expect("it was made"))
    }
}
