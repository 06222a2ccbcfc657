//! GPU time of a candidate relative to the start of the tuning.

use filters::{Blur, FilterError, Gpu, Input, Settings};
use frame::Frame;
use suite::FilterChoice;

/// Rounds of one candidate and the start in turn; odd, so that the median is one of them.
const ROUNDS: usize = 5;

/// Comparison of GPU times on one frame.
pub struct Stopwatch<'a> {
    /// Adapter that the filter runs on.
    pub gpu: &'a Gpu,
    /// The filter, with the values whose cost is 1.
    pub choice: &'a FilterChoice,
    /// Input of the filter.
    pub frame: &'a Frame,
}

impl Stopwatch<'_> {
    /// Times candidate and start in turns, all passes of each, and returns the median ratio over the rounds. Runs one round
    /// before them that does not count.
    pub fn measure_ratio(&self, settings: &Settings) -> Result<f64, FilterError> {
        let (width, height) = self.frame.size();
        let blur = |settings| Blur::new(self.gpu, &self.choice.filter, settings, width, height);
        let input = Input {
            color: &[&self.frame.color],
            velocity: &self.frame.velocity,
            depth: &self.frame.depth,
            reprojection: Some(self.frame.reprojection),
            camera: self.frame.camera,
            exposure: self.frame.exposure,
            frames_per_second: self.frame.frames_per_second,
            frame_index: 0,
        };
        let (mut start, mut candidate) = (blur(&self.choice.settings)?, blur(settings)?);
        let (start, candidate) = (start.load(&input)?, candidate.load(&input)?);
        let mut ratios = Vec::new();
        for round in 0..=ROUNDS {
            let [before, own] = [&start, &candidate].map(|it| {
                let passes = it.time()?;
                Ok::<f64, FilterError>(passes.iter().map(|pass| pass.seconds).sum())
            });
            let ratio = own? / before?;
            ratios.extend((round > 0).then_some(ratio));
        }
        ratios.sort_by(f64::total_cmp);
        Ok(ratios[ROUNDS / 2])
    }
}
