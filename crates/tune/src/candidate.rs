//! Candidate of a tuning, ready to blur one scene after another.

use filters::{Blur, Filter, FilterError, Kernels, Settings};
use frame::{Frame, Image, Plane};
use suite::{Monitor, Runner, filter_input, pack_planes, unpack_planes};

/// A filter with the settings to try.
pub struct Candidate<'e, 'a> {
    /// The filter.
    pub filter: &'e Filter,
    /// Its settings.
    pub settings: &'e Settings,
    /// The filter's kernels; none if it is a program.
    pub kernels: Option<&'e Kernels<'a>>,
    /// Monitor that can end a program.
    pub monitor: Monitor,
    /// The filter, ready for pictures of one size; none before the first picture.
    pub runner: Option<((u32, u32), Runner<'a>)>,
}

/// The blurred colour, and the blurred coverage of each object if it was asked for.
pub type Blurred = (Image, Option<Vec<Plane>>);

impl<'a> Candidate<'_, 'a> {
    /// Blurs the frame of a scene; its mattes too if `bleed` is to be measured.
    pub fn blur(&mut self, frame: &Frame, bleed: bool) -> Result<Blurred, FilterError> {
        let size = frame.size();
        if self.runner.as_ref().is_none_or(|(made, _)| *made != size) {
            self.runner = Some((size, self.make_runner(size)?));
        }
        let (_, runner) = self.runner.as_mut().expect("it was just made");
        let mattes = match bleed {
            true => pack_planes(&frame.coverage),
            false => Vec::new(),
        };
        let color: Vec<&Image> = std::iter::once(&frame.color).chain(&mattes).collect();
        let outputs = runner.run(&filter_input(frame, &color))?;
        let mut outputs = outputs
            .iter()
            .map(|output| output.cropped(frame.guard_band));
        let color = outputs.next().expect("a filter blurs the colour");
        let mattes: Vec<Image> = outputs.collect();
        let coverage = bleed.then(|| unpack_planes(&mattes, frame.coverage.len()));
        Ok((color, coverage))
    }

    fn make_runner(&self, size: (u32, u32)) -> Result<Runner<'a>, FilterError> {
        match self.kernels {
            Some(kernels) => {
                let blur = Blur::with_kernels(kernels, self.settings, size.0, size.1)?;
                Ok(Runner::Kernels(Box::new(blur)))
            }
            None => Runner::command(self.filter, self.settings, size, self.monitor),
        }
    }
}
