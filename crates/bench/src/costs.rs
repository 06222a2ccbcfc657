//! Costs of filters, summarised from the times of their runs.

use filters::PassTime;

use super::{CaseCost, CopyCost, PassCost, Spread};
use measure::FilterChoice;

/// Times of every dispatch of one run of a filter.
pub type Times = Vec<PassTime>;

/// Summarises the runs of one filter preset.
pub fn case_cost(
    choice: &FilterChoice,
    runs: &[Times],
    baseline: &[Times],
    pixels: f64,
    copy: &CopyCost,
) -> CaseCost {
    let seconds = spread(runs);
    let bytes = count_bytes(&runs[0]) as f64;
    let bytes_per_second = bytes / seconds.median;
    CaseCost {
        filter: choice.filter.name.clone(),
        preset: choice.preset.clone(),
        parameters: choice.settings.values.clone(),
        reference_width: choice.settings.reference_width,
        seconds,
        ratio: Some(ratio(runs, baseline)),
        bytes_per_pixel: Some(bytes / pixels),
        bytes_per_second: Some(bytes_per_second),
        part_of_copy: Some(bytes_per_second / copy.bytes_per_second),
        passes: pass_costs(runs, pixels),
    }
}

/// Summarises the runs of each pass, with its iterations in sequence.
pub fn pass_costs(runs: &[Times], pixels: f64) -> Vec<PassCost> {
    let mut start = 0;
    let passes = runs[0].chunk_by(|a, b| a.entry == b.entry);
    passes
        .map(|iterations| {
            let range = start..start + iterations.len();
            start = range.end;
            PassCost {
                entry: iterations[0].entry.clone(),
                iterations: iterations.len(),
                seconds: Spread::of(runs.iter().map(|run| total_seconds(&run[range.clone()]))),
                bytes_per_pixel: Some(count_bytes(iterations) as f64 / pixels),
            }
        })
        .collect()
}

/// Measures the spread of the time of all passes.
pub fn spread(runs: &[Times]) -> Spread {
    Spread::of(runs.iter().map(|run| total_seconds(run)))
}

/// Divides times by base times, round by round.
pub fn ratio(runs: &[Times], base: &[Times]) -> Spread {
    let pairs = runs.iter().zip(base);
    Spread::of(pairs.map(|(run, base)| total_seconds(run) / total_seconds(base)))
}

fn count_bytes(passes: &[PassTime]) -> u64 {
    passes.iter().map(|pass| pass.bytes).sum()
}

fn total_seconds(passes: &[PassTime]) -> f64 {
    passes.iter().map(|pass| pass.seconds).sum()
}
