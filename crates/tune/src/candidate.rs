//! Candidate of a tuning, ready to blur scenes.

use filters::{Blur, Filter, FilterError, Kernels, Settings};
use frame::{Image, Plane, Size};
use measure::{FilterFrame, Runner, filter_input};
use metrics::{pack_planes, unpack_planes};

/// A filter with settings to try, ready for pictures of one size.
pub struct Candidate<'a> {
    runner: Runner<'a>,
}

/// A blurred scene.
pub struct Blurred {
    /// The colour.
    pub color: Image,
    /// The coverage of each object, if requested.
    pub mattes: Option<Vec<Plane>>,
}

impl<'a> Candidate<'a> {
    /// Makes a candidate for pictures of one size. `kernels` are the filter's, none if it is a
    /// program.
    pub fn new(
        filter: &Filter,
        settings: &Settings,
        kernels: Option<&Kernels<'a>>,
        size: Size,
    ) -> Result<Self, FilterError> {
        let runner = match kernels {
            Some(kernels) => {
                let blur = Blur::with_kernels(kernels, settings, size.width, size.height)?;
                Runner::Kernels(Box::new(blur))
            }
            None => Runner::command(filter, settings, size)?,
        };
        Ok(Self { runner })
    }

    /// Blurs a scene's frame; its mattes too if `bleed` is to be measured.
    pub fn blur(&mut self, frame: &FilterFrame, bleed: bool) -> Result<Blurred, FilterError> {
        let mattes = if bleed {
            pack_planes(&frame.coverage)
        } else {
            Vec::new()
        };
        let color: Vec<&Image> = std::iter::once(&frame.color).chain(&mattes).collect();
        let outputs = self.runner.run(&filter_input(frame, &color))?;
        let mut outputs = outputs
            .iter()
            .map(|output| output.cropped(frame.guard_band));
        let color = outputs.next().expect("a filter blurs the colour");
        let packed: Vec<Image> = outputs.collect();
        let mattes = bleed.then(|| unpack_planes(&packed, frame.coverage.len()));
        Ok(Blurred { color, mattes })
    }
}
