//! What a score says, in one line.

use metrics::{FrozenMetric, ImageMetric, Metric, ObjectMetric, ProbeMetric, Region, SkillMetric};

/// One line for a reader who has not met the score; `crates/metrics/README.md` has the formulas.
pub fn meaning(metric: Metric) -> String {
    match metric {
        Metric::Image(metric, region) => format!("{}, {}", of_image(metric), place(region)),
        Metric::Object(metric) => of_object(metric).to_owned(),
        Metric::Frozen(metric) => of_frozen(metric).to_owned(),
        Metric::Probe(metric) => of_probe(metric).to_owned(),
        Metric::Skill(metric) => format!(
            "share of the way from no blur, 0, to the one-frame oracle, 1, by {}",
            of_skill(metric)
        ),
        other => of_whole(other).to_owned(),
    }
}

fn of_whole(metric: Metric) -> &'static str {
    match metric {
        Metric::LabelTotalVariation => "share of the shutter given to the wrong object",
        Metric::LabelTotalVariationP95 => "the same: what 19 of 20 moving pixels do not exceed",
        Metric::OccluderContamination => "the same on the worst object that stands still",
        Metric::StaticContamination => "what the filter changes where nothing moves",
        Metric::EquivalentSubframes => {
            "as good as averaging that many sub-frames, by squared error"
        }
        Metric::EquivalentSubframesFlip => {
            "as good as averaging that many sub-frames, by visible difference"
        }
        Metric::EquivalentSubframesLabel => {
            "as good as averaging that many sub-frames, by whose time it is"
        }
        _ => unreachable!("the others have lines of their own"),
    }
}

fn of_image(metric: ImageMetric) -> &'static str {
    match metric {
        ImageMetric::Mse => "squared error of colour",
        ImageMetric::Psnr => "signal to noise ratio of colour",
        ImageMetric::Relmse => "squared error of colour relative to the truth",
        ImageMetric::Mae => "absolute error of colour",
        ImageMetric::Smape => "absolute error of colour relative to both pictures",
        ImageMetric::Flip => "visible difference",
        ImageMetric::FlipWeightedMedian => {
            "visible difference up to which half of all visible difference lies"
        }
        ImageMetric::FlipP95 => "visible difference that 19 of 20 pixels do not exceed",
        ImageMetric::FlipP99 => "visible difference that 99 of 100 pixels do not exceed",
        ImageMetric::FlipHdr => "visible difference at the exposure that shows most of it",
        ImageMetric::Ssim => "likeness of structure",
    }
}

fn place(region: Region) -> &'static str {
    match region {
        Region::Moving => "where anything moves",
        Region::Support => "where anything moves, without the margin",
        Region::Still => "where nothing moves",
        Region::Full => "over the whole picture",
        Region::Knowable => "where the instant shows all that the shutter saw",
        Region::Unknowable => "where the instant hides what the shutter saw",
    }
}

fn of_object(metric: ObjectMetric) -> &'static str {
    match metric {
        ObjectMetric::BleedLateral => "mover spilled beside where it ever was",
        ObjectMetric::BleedLeading => "mover spilled ahead of where it ever was",
        ObjectMetric::BleedTrailing => "mover spilled behind where it ever was",
        ObjectMetric::LateralGrowth => "how far the silhouette grew sideways",
        ObjectMetric::RowGain => {
            "how much more of the mover its own rows hold, as pixels of silhouette"
        }
        ObjectMetric::RowLoss => {
            "how much less of the mover rows along the motion hold, as pixels of silhouette"
        }
        ObjectMetric::Misplacement => "how far the smear's mass lies off along the motion",
        ObjectMetric::Centroid => "how far the smear's centre of mass lies ahead; 0 is right",
        ObjectMetric::Extent => "length of the smear to the true length; 1 is right",
        ObjectMetric::TvExcess => "steps, ripples and grain along the smear; 0 is right",
        ObjectMetric::Hole => "how much shows through where the mover hides all; 0 is right",
        ObjectMetric::Deficit => "part of the mover's mass that is missing where it should be",
        ObjectMetric::Energy => "the mover's mass to its true mass; 1 is right",
        ObjectMetric::LabelTotalVariation => "share of the mover's time given to something else",
        ObjectMetric::GradientError => "edges of the mover's matte that are too sharp or too soft",
    }
}

fn of_frozen(metric: FrozenMetric) -> &'static str {
    match metric {
        FrozenMetric::Mse => "squared error but for shadows, lights and reflections that move",
        FrozenMetric::Flip => {
            "visible difference but for shadows, lights and reflections that move"
        }
        FrozenMetric::Shading => {
            "what shadows, lights and reflections that move cost any filter of one frame"
        }
    }
}

fn of_probe(metric: ProbeMetric) -> &'static str {
    match metric {
        ProbeMetric::Unity => "how far the weights of any pixel are from adding up to 1",
        ProbeMetric::GatherOffset => "how far from the right place the filter gathers",
        ProbeMetric::GatherSpread => "how much too widely or too narrowly it gathers",
    }
}

fn of_skill(metric: SkillMetric) -> &'static str {
    match metric {
        SkillMetric::Mse => "squared error",
        SkillMetric::Flip => "visible difference",
        SkillMetric::LabelTotalVariation => "share given to the wrong object",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_metric_has_a_line_of_its_own() {
        let all: Vec<String> = Metric::all().into_iter().map(meaning).collect();
        for (index, line) in all.iter().enumerate() {
            assert!(!all[..index].contains(line), "two metrics mean \"{line}\"");
        }
    }
}
