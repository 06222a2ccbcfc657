//! Why a bound is not kept: where the picture is worst, and what it is like.

use std::path::Path;
use std::str::FromStr;
use std::sync::OnceLock;

use frame::{FileError, Frame, Ladder, Picture, Truth};
use metrics::{MeasureError, Measurement, Metric, Reference, Regions, Scores};
use tracer::Scene;

use crate::decoys::{Decoys, Resemblance};
use crate::worst::{Worst, worst_block, write_crop};

/// One scene and the truth of one alignment, ready to show what is wrong with pictures.
pub(crate) struct Witness<'a> {
    frame: &'a Frame,
    truth: &'a Truth,
    ladder: &'a Ladder,
    /// The display exposure of pictures, in stops.
    stops: f32,
    /// Made when the first bound is not kept.
    decoys: OnceLock<Decoys>,
}

impl<'a> Witness<'a> {
    /// `frame` is without guard band.
    pub fn new(scene: &Scene, frame: &'a Frame, truth: &'a Truth, ladder: &'a Ladder) -> Self {
        Self {
            frame,
            truth,
            ladder,
            stops: scene.display.stops,
            decoys: OnceLock::new(),
        }
    }

    /// Finds where the error of a metric, by its name, is largest, and writes a picture of it into `folder`, the case's below
    /// `out`.
    pub fn worst(
        &self,
        metric: &str,
        (output, measurement): (&Picture, &Measurement),
        regions: &Regions,
        (out, folder): (&Path, &Path),
    ) -> Result<Worst, FileError> {
        let metric = Metric::from_str(metric).expect("a verdict is about a metric");
        let searched = metric.row().map;
        let map = (measurement.map(searched)).expect("a metric that applies was measured");
        let (x, y) = worst_block(metric, map, regions);
        let picture = folder.join(format!("worst_{metric}.png"));
        let panels = [&self.truth.mean().color, &output.color];
        write_crop(&out.join(&picture), (x, y), panels, map, self.stops)?;
        Ok(Worst {
            x,
            y,
            map: searched.name().to_owned(),
            picture,
        })
    }

    /// The wrong blur that these scores, against `reference`, are most like.
    pub fn resemblance(
        &self,
        reference: &Reference,
        scores: &Scores,
    ) -> Result<Option<Resemblance>, MeasureError> {
        let decoys = match self.decoys.get() {
            Some(decoys) => decoys,
            None => {
                let made = Decoys::new(self.frame, self.truth, self.ladder, reference)?;
                self.decoys.get_or_init(|| made)
            }
        };
        Ok(decoys.nearest(scores))
    }
}
