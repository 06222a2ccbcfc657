//! The shutter of a truth, and the alignments that share their samples.

use frame::{Alignment, Shutter};
use scene::Scene;

use crate::error::TraceError;
use crate::film::render::Times;
use crate::film::shutter_sampler::ShutterSampler;
use crate::motion::moving::find_moving_objects;
use crate::settings::RenderSettings;

/// The shutter of one truth.
#[derive(Clone)]
pub(crate) struct AlignedShutter {
    pub alignment: Alignment,
    pub shutter: Shutter,
    sampler: ShutterSampler,
    /// Per object id, true if it moves on screen while the shutter is open.
    pub moving: Vec<bool>,
}

impl AlignedShutter {
    /// Refuses settings with which the scene cannot be rendered.
    pub fn new(
        scene: &Scene,
        settings: &RenderSettings,
        alignment: Alignment,
    ) -> Result<Self, TraceError> {
        let shutter = settings.check_truth(scene, alignment)?;
        Ok(Self {
            alignment,
            shutter,
            sampler: ShutterSampler::new(shutter, &scene.shutter_profile),
            moving: find_moving_objects(scene, scene.shutter_profile.whole(shutter)),
        })
    }

    pub fn times(&self) -> Times<'_> {
        Times::Shutter(&self.sampler)
    }
}

/// Lists the alignments that overlap with this one and are used with it: they share their numbers
/// of samples.
pub(crate) fn list_family(alignment: Alignment) -> &'static [Alignment] {
    match alignment {
        Alignment::Trailing | Alignment::Centred => &[Alignment::Trailing, Alignment::Centred],
        Alignment::Leading => &[Alignment::Leading],
    }
}
