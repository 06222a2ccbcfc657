//! Costs of filters, summed up from the times of their runs.

use filters::PassTime;

use super::turns::Times;
use super::{CaseCost, CopyCost, GROWTH_FROM, PassCost, REACHES, Spread};
use crate::filter_choice::FilterChoice;

/// Sums up the runs of one filter preset.
pub fn case_cost(
    choice: &FilterChoice,
    runs: &[Times],
    baseline: &[f64],
    pixels: f64,
    copy: &CopyCost,
) -> CaseCost {
    let seconds = Spread::of(runs.iter().map(|run| total_seconds(run)));
    let bytes: u64 = runs[0].iter().map(|pass| pass.bytes).sum();
    let bytes_per_second = bytes as f64 / seconds.median;
    CaseCost {
        filter: choice.filter.name.clone(),
        preset: choice.preset.clone(),
        parameters: choice.settings.values.clone(),
        reference_width: choice.settings.reference_width,
        seconds,
        ratio: Spread::of(
            runs.iter()
                .zip(baseline)
                .map(|(run, base)| total_seconds(run) / base),
        ),
        bytes_per_pixel: bytes as f64 / pixels,
        bytes_per_second,
        part_of_copy: bytes_per_second / copy.bytes_per_second,
        passes: pass_costs(runs, pixels),
    }
}

/// Sums up the runs of each pass, whose iterations follow one another.
pub fn pass_costs(runs: &[Times], pixels: f64) -> Vec<PassCost> {
    let mut start = 0;
    let passes = runs[0].chunk_by(|a, b| a.entry == b.entry);
    passes
        .map(|iterations| {
            let range = start..start + iterations.len();
            start = range.end;
            let bytes: u64 = iterations.iter().map(|pass| pass.bytes).sum();
            PassCost {
                entry: iterations[0].entry.clone(),
                iterations: iterations.len(),
                seconds: Spread::of(runs.iter().map(|run| total_seconds(&run[range.clone()]))),
                bytes_per_pixel: bytes as f64 / pixels,
            }
        })
        .collect()
}

/// Divides the time at the longest reach by that at [`GROWTH_FROM`], round by round.
pub fn growth(runs: &[Option<Vec<Times>>; REACHES.len()]) -> Option<Spread> {
    let from = REACHES.iter().position(|pixels| *pixels == GROWTH_FROM);
    let from = runs[from.expect("growth starts at one of the reaches")].as_ref()?;
    let to = runs.last().and_then(Option::as_ref)?;
    Some(Spread::of(
        to.iter()
            .zip(from)
            .map(|(to, from)| total_seconds(to) / total_seconds(from)),
    ))
}

/// Adds up the seconds of passes.
pub fn total_seconds(passes: &[PassTime]) -> f64 {
    passes.iter().map(|pass| pass.seconds).sum()
}
