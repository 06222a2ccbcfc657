//! Limits derived from the scores of several runs.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use frame::Size;
use measure::{Case, Frames, Intervals, Run};
use metrics::{
    Ideal, Interval, LabelMetric, Measured, Metric, ObjectMetric, PERFECT_JOD, ProbeMetric, Score,
    SequenceMetric,
};
use scene::SceneId;

use judge::SceneBounds;
use judge::find_sequence;
use judge::number;

/// Margin, in standard deviations.
const DEVIATIONS: f64 = 3.0;
/// Smallest margin as a fraction of the worst score: rounding and another compiler may change as
/// much.
const LEAST_PART: f64 = 0.05;
/// Factor above the strictest limit that the truth's noise allows, since that varies too.
const ABOVE_STRICTEST: f64 = 1.2;

/// Metrics that react to small changes of a kernel. Only the first has a default bound, and that is
/// loose: a filter that leaves still pixels alone stays far below it. The others have none, since a
/// good filter's scores differ from scene to scene.
const SENSITIVE: [Metric; 4] = [
    Metric::StaticContamination,
    Metric::Probe(ProbeMetric::GatherSpread),
    Metric::Object(ObjectMetric::Deficit),
    Metric::Label(LabelMetric::P95),
];

/// Smallest limit on an error, by its unit: a tenth of a pixel, half a hundredth of a number
/// without a unit. If a score is 0 in every run, its spread says nothing, and another adapter need
/// not agree to the last bit. `static_contamination` compares still pixels with the frame and knows
/// no noise: its limit once came out as 6.5e-9, which is rounding alone.
const LEAST_LIMITS: [(&str, f64); 4] = [
    ("px", 0.1),
    ("white", 1e-5),
    ("brightness", 1e-5),
    ("", 0.005),
];

/// The score that rises to a perfect value.
const JOD: Metric = Metric::Sequence(SequenceMetric::Jod);

/// Scores of several runs, per scene and filter.
#[derive(Default)]
pub struct Calibration {
    /// Score in every run that it applies to, per scene, `filter:preset` and metric.
    scores: BTreeMap<SceneId, BTreeMap<String, BTreeMap<Metric, Vec<Sample>>>>,
    /// Columns and rows of the pictures.
    size: Size,
    /// Frames of the sequences.
    frames: Frames,
}

/// A score of one run.
#[derive(Clone, Copy)]
struct Sample {
    score: Score,
    /// Its interval, if the truth has one.
    interval: Option<Interval>,
}

/// Gathers scores from several runs of the same scenes, size, frames and filters: `metrics`, or
/// [`default_metrics`] and all scores of sequences if none are given.
pub fn calibrate<'a>(
    runs: &[Run],
    bounds: impl Fn(&Case) -> &'a SceneBounds,
    metrics: &[Metric],
) -> Calibration {
    let first = runs.first();
    let mut calibration = Calibration {
        size: first.map_or(Size::default(), |run| run.render.size()),
        frames: first.map_or(Frames::default(), |run| run.frames),
        ..Calibration::default()
    };
    for (run, case) in (runs.iter()).flat_map(|run| run.cases.iter().map(move |case| (run, case))) {
        if case.is_reference || case.input.change().is_some() {
            continue;
        }
        let of_frames = default_metrics(bounds(case), &case.filter, &case.preset);
        let is_wanted = |metric: Metric| match metric {
            _ if !metrics.is_empty() => metrics.contains(&metric),
            Metric::Sequence(_) => true,
            _ => of_frames.contains(&metric),
        };
        let filters = calibration.scores.entry(case.scene.clone()).or_default();
        let scores = filters.entry(case.name()).or_default();
        let mut add = |metric: Metric, measured: Measured, intervals: &Intervals| {
            if let Measured::Score(score) = measured
                && is_wanted(metric)
            {
                let interval = intervals.get(&metric).copied();
                let sample = Sample { score, interval };
                scores.entry(metric).or_default().push(sample);
            }
        };
        for metric in Metric::all() {
            add(metric, case.scores.get(metric), &case.intervals);
        }
        if let Some(sequence) = find_sequence(run, case) {
            for metric in SequenceMetric::ALL {
                let measured = sequence.scores.get(metric).clone();
                add(Metric::Sequence(metric), measured, &sequence.intervals);
            }
        }
    }
    calibration
}

/// Lists the metrics to limit for a filter preset if none are named: those that the scene bounds,
/// and those that react to changes of a kernel which the bounds let pass.
pub fn default_metrics(bounds: &SceneBounds, filter: &str, preset: &str) -> Vec<Metric> {
    let bounded = bounds.of(filter, preset).into_keys();
    let metrics: BTreeSet<Metric> = bounded.chain(SENSITIVE).collect();
    metrics.into_iter().collect()
}

/// Proposes a limit from the scores of one metric, with its reason in one line. It is the worst
/// value in any interval, as a check demands, plus a margin: three standard deviations between
/// runs, or a twentieth of the worst score if that is more. It is at least 1.2 times as far from
/// perfect as the strictest limit that the truth's noise allows, and at least one of
/// [`LEAST_LIMITS`]. It is rounded to two digits, away from perfect. Parts of JOD are parts of its
/// distance from 10.
fn propose(metric: Metric, samples: &[Sample]) -> (f64, String) {
    let ideal = metric.ideal();
    let worst_of = |values: &[f64]| values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let badness: Vec<f64> = (samples.iter())
        .map(|sample| ideal.badness(sample.score.value))
        .collect();
    let reached: Vec<f64> = (samples.iter().zip(&badness))
        .map(|(sample, badness)| match &sample.interval {
            Some(interval) => ideal.badness_within(interval).1.max(*badness),
            None => *badness,
        })
        .collect();
    let worst = worst_of(&badness);
    let deviation = standard_deviation(&badness);
    let size = match metric {
        JOD => PERFECT_JOD + worst,
        _ => worst.abs(),
    };
    let margin = (DEVIATIONS * deviation).max(LEAST_PART * size);
    let far = worst_of(&reached) + margin;
    let bearable = (samples.iter()).map(|sample| metric.strictest_bound(sample.score.floor));
    let limit = match ideal {
        Ideal::Highest => {
            let strictest = bearable.fold(f64::INFINITY, f64::min);
            let bearable = match metric {
                JOD => PERFECT_JOD - ABOVE_STRICTEST * (PERFECT_JOD - strictest),
                _ => strictest / ABOVE_STRICTEST,
            };
            round_away((-far).min(bearable), f64::floor)
        }
        Ideal::Lowest | Ideal::Target(_) => {
            let bearable = bearable.fold(0.0, f64::max) * ABOVE_STRICTEST;
            let least = (LEAST_LIMITS.iter()).find(|(unit, _)| *unit == metric.unit());
            let least = least.map_or(0.0, |(_, limit)| *limit);
            round_away(far.max(bearable).max(least), f64::ceil)
        }
    };
    let (value, away) = match ideal {
        Ideal::Highest => (-worst, String::new()),
        Ideal::Lowest => (worst, String::new()),
        Ideal::Target(target) => (worst, format!(" from {target}")),
    };
    let why = format!(
        "measured {}{away} at worst, with {} between {} runs; calibrate's margin",
        number(value),
        number(deviation),
        samples.len()
    );
    (limit, why)
}

/// Returns the standard deviation of at least one value; 0 for one value.
fn standard_deviation(values: &[f64]) -> f64 {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    (squares / (count - 1.0).max(1.0)).sqrt()
}

/// Rounds to two significant digits, with `rounding` for the last one.
fn round_away(value: f64, rounding: fn(f64) -> f64) -> f64 {
    if value == 0.0 {
        return 0.0;
    }
    let digits = 1 - value.abs().log10().floor() as i32;
    let rounded = rounding(value * 10f64.powi(digits));
    // By way of text, so that 0.12 is not 0.12000000000000001.
    (format!("{rounded}e{}", -digits).parse()).expect("a number as text is a number")
}

impl Calibration {
    /// Lists the scenes that have scores.
    pub fn scenes(&self) -> impl Iterator<Item = &SceneId> {
        self.scores.keys()
    }

    /// Formats the proposed bounds of one scene as its bounds.toml.
    pub fn toml(&self, scene: &SceneId) -> String {
        let size = self.size.sides();
        let mut text = String::new();
        for (filter, metrics) in self.scores.get(scene).into_iter().flatten() {
            let _ = writeln!(text, "[filter.\"{filter}\"]");
            for (metric, samples) in metrics {
                let length = self.length(*metric);
                let (limit, why) = propose(*metric, samples);
                let _ = writeln!(
                    text,
                    "{metric} = {{ limit = {limit:?}, {length}size = {size:?}, why = \"{why}\" }}"
                );
            }
            text += "\n";
        }
        text
    }

    /// Formats the keys of a limit that name its frames; empty for a score of single frames.
    fn length(&self, metric: Metric) -> String {
        let Frames { count, per_second } = self.frames;
        match metric {
            Metric::Sequence(metric) if metric.depends_on_rate() => {
                format!("frames = {count}, fps = {per_second:?}, ")
            }
            Metric::Sequence(_) => format!("frames = {count}, "),
            _ => String::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limit(metric: &str, values: &[f64], floor: f64) -> f64 {
        let sample = |value: &f64| Sample {
            score: Score {
                value: *value,
                floor,
            },
            interval: None,
        };
        let samples: Vec<Sample> = values.iter().map(sample).collect();
        propose(metric.parse().unwrap(), &samples).0
    }

    #[test]
    fn a_limit_is_the_worst_score_and_a_margin() {
        // Standard deviation 0.01: 0.12 + 0.03.
        assert_eq!(limit("flip_moving", &[0.1, 0.11, 0.12], 0.0), 0.15);
        // A twentieth is more: 0.12 * 1.05 = 0.126, rounded up.
        assert_eq!(limit("flip_moving", &[0.12, 0.12], 0.0), 0.13);
        // The ideal is 1: 0.2 * 1.05.
        assert_eq!(limit("extent", &[0.8, 0.8], 0.0), 0.21);
        // Higher is better: 30 dB less a twentieth, rounded down.
        assert_eq!(limit("psnr_moving", &[30.0, 30.0], 80.0), 28.0);
        assert_eq!(limit("n_eq", &[4.0, 5.0], 64.0), 1.8);
        // A twentieth of the 2 JOD from perfect: 8 - 0.1.
        assert_eq!(limit("jod", &[8.0, 8.0], 9.9), 7.9);
        assert_eq!(limit("flicker", &[0.002, 0.002], 0.0), 0.0021);
    }

    #[test]
    fn a_limit_is_never_stricter_than_the_noise_allows() {
        // 1.2 times three floors.
        assert_eq!(limit("flip_moving", &[0.0, 0.0], 0.01), 0.036);
        assert_eq!(limit("n_eq", &[60.0, 60.0], 36.0), 10.0);
        // 1.2 times three times the 0.5 JOD that the noise costs, below 10.
        assert_eq!(limit("jod", &[9.9, 9.9], 9.5), 8.2);
    }

    #[test]
    fn a_limit_leaves_room_for_the_interval() {
        let sample = Sample {
            score: Score {
                value: 0.8,
                floor: 0.0,
            },
            interval: Some(Interval {
                low: 0.75,
                high: 0.85,
                center: 0.8,
                standard_error: 0.02,
            }),
        };
        // 0.25 from 1, and a twentieth of 0.2.
        let (limit, _) = propose("extent".parse().unwrap(), &[sample, sample]);
        assert_eq!(limit, 0.26);
    }

    #[test]
    fn a_perfect_score_leaves_some_room() {
        assert_eq!(limit("bleed_leading", &[0.0, 0.0], 0.0), 0.1);
        assert_eq!(limit("label_tv", &[0.0, 0.0], 0.0), 0.005);
        assert_eq!(limit("static_contamination", &[6.2e-9, 6.2e-9], 0.0), 1e-5);
    }
}
