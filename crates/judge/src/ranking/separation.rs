//! Scenes that cannot separate filters: what blur would gain is within the noise.

use frame::Alignment;
use measure::{Case, ReferencePicture, Run};
use metrics::Metric;
use scene::SceneId;

use crate::finding::{MAX_SAMPLES, settling_samples};

/// A scene and shutter on which no filter could be told from no blur.
struct Inseparable {
    scene: SceneId,
    alignment: Alignment,
    /// Samples per pixel at which the best reference picture would be clearly better than no blur;
    /// none if no allowed number is enough.
    samples: Option<u64>,
}

/// Lists the scenes of a run on which the best reference picture is not clearly better than no
/// blur, by the rule of the ranking on one scene. Scenes that an engine drew are left out, because
/// samples would not mend them.
fn list_inseparable(run: &Run) -> Vec<Inseparable> {
    let references = || run.cases.iter().filter(|case| case.is_reference);
    let no_blur = references().filter(|case| {
        case.reference() == Some(ReferencePicture::Identity) && case.drawn.is_none()
    });
    let judged = no_blur.filter_map(|none| {
        let is_beside =
            |case: &&Case| (&case.scene, case.alignment) == (&none.scene, none.alignment);
        let flips = references().filter(is_beside);
        let best = flips.filter_map(|case| case.estimate(Metric::FLIP));
        let best = best.fold(f64::INFINITY, f64::min);
        let gain = none.estimate(Metric::FLIP)? - best;
        let noise = none.floor(Metric::FLIP)?;
        (gain <= noise).then(|| Inseparable {
            scene: none.scene.clone(),
            alignment: none.alignment,
            samples: samples_to_separate(run.render.samples_per_pixel, noise, gain),
        })
    });
    judged.collect()
}

/// Estimates the samples per pixel at which noise is below a gain; none if no allowed number is
/// enough.
fn samples_to_separate(samples_per_pixel: u32, noise: f64, gain: f64) -> Option<u64> {
    if gain <= 0.0 {
        return None;
    }
    let samples = settling_samples(samples_per_pixel, noise, gain);
    (samples < MAX_SAMPLES).then_some(samples)
}

/// Names the scenes that cannot separate filters, with the samples that they need; none if all can.
pub fn inseparable_text(run: &Run) -> Option<String> {
    let scenes = list_inseparable(run);
    let names: Vec<String> = scenes.iter().map(Inseparable::text).collect();
    (!names.is_empty()).then(|| {
        format!(
            "At {} samples per pixel these scenes cannot separate filters, because all that a blur could gain there is within the \
             noise: {}. Raise --samples-per-pixel, or make something move further.",
            run.render.samples_per_pixel,
            names.join("; ")
        )
    })
}

impl Inseparable {
    fn text(&self) -> String {
        let needed = match self.samples {
            Some(samples) => format!("at least {samples} are needed"),
            None => "no number is enough".to_owned(),
        };
        format!("{} ({} shutter: {needed})", self.scene, self.alignment)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_doubled_until_the_noise_is_below_the_gain() {
        for (noise, gain, expected) in [
            (0.02, 0.015, Some(64)),
            (0.02, 0.005, Some(512)),
            (0.02, 0.0, None),
            (0.02, -0.003, None),
            (0.02, 1e-6, None),
        ] {
            assert_eq!(samples_to_separate(32, noise, gain), expected, "{gain}");
        }
    }
}
