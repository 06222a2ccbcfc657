//! Judgement of a finished run: each bounded score against its limit.

mod bounds;
mod compare;
mod decoys;
mod evidence;
mod few_scenes;
mod finding;
mod groups;
mod judged_score;
mod judgement;
mod numbers;
mod outcome;
mod ranking;
mod results;
mod worst;

use std::collections::BTreeMap;

pub use bounds::{
    BOUNDS_FILE, Bound, BoundedScene, Bounds, BoundsFile, FilterBounds, Length, Level, Margin,
    SceneBounds, bound_subframes, check_lengths, check_names, read_bounds,
    read_bounds_beside_scenes, read_bounds_file, require_bounds, size_for_bounds,
};
pub use compare::{
    Agreement, Basis, Change, ChangeKind, FilterAtSizes, MeanChange, Pair, Reversal, RunComparison,
    SettingChange, SizeComparison, compare_runs, compare_sizes, pair_cases, rank_changes,
    score_change,
};
pub use decoys::{Decoys, Resemblance, make_wrong_pictures};
pub use evidence::add_evidence;
pub use few_scenes::few_scenes_text;
pub use finding::{Finding, MAX_SAMPLES, settling_samples};
use judged_score::judge_sequence;
pub use judged_score::{JudgedScore, judge_scores};
pub use judgement::{JUDGEMENT_FILE, Judgement, Verdict};
use measure::{Case, Run, Sequence};
pub use numbers::{number, round_to_digits};
pub use outcome::{Decision, Outcome};
pub use ranking::filters::{
    MAX_RANKED, RANK_RULE, RankedFilter, list_summarized, rank_for_summary, rank_presets,
};
pub use ranking::lag::{lag_text, mean_lag};
pub use ranking::no_blur::no_gain_text;
pub use ranking::separation::inseparable_text;
pub use ranking::sequence_ranking::{RANKED_BY, RankedSequence, rank_sequences, rank_sequences_on};
pub use ranking::side_effects::{SIDE_EFFECTS_RULE, SideEffects};
pub use results::{ResultScores, Results};
use scene::SceneId;
pub use worst::{BLOCK, CROP, Worst, worst_block};

/// The bounds of a run's scenes.
pub type RunBounds = BTreeMap<SceneId, SceneBounds>;

/// Compares every bounded score of a run with its limit: one finding per filter, scene and bound,
/// in the order of the run's cases, each followed by its sequence's findings. References have no
/// bounds. Pure: reads nothing, writes nothing.
pub fn judge(run: &Run, bounds: &RunBounds) -> Vec<Finding> {
    let filters = run.cases.iter().filter(|case| !case.is_reference);
    filters
        .flat_map(|case| {
            let bounds = (bounds.get(&case.scene))
                .map(|bounds| bounds.of(&case.filter, &case.preset))
                .unwrap_or_default();
            // A run with intervals has some in every case.
            let intervals = (!case.intervals.is_empty()).then_some(&case.intervals);
            let sequence = find_sequence(run, case);
            let mut judged = judge_scores(&case.scores, intervals, &bounds);
            judged.extend(judge_sequence(sequence, run.frames, &bounds));
            (judged.into_iter()).map(move |judged| Finding::new(run, case, sequence, judged))
        })
        .collect()
}

/// Finds the sequence that starts with a case.
pub fn find_sequence<'a>(run: &'a Run, case: &Case) -> Option<&'a Sequence> {
    run.sequences.iter().find(|sequence| sequence.is_of(case))
}
