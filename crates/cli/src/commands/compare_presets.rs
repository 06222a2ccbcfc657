//! The command `compare-presets`.

use suite::{Error, Objective, Sharing, compare_paired, evaluator};

use super::candidate::{open_candidate_gpu, render_shots, select_candidate};
use super::plan::load_scenes;
use super::result::CommandResult;
use crate::arguments::ComparePresetsArgs;
use crate::output::progress::make_monitor;
use crate::tables::tuning::paired_table;

/// Scores two presets on every scene, writes `compare.json`, prints the table.
pub fn execute(args: &ComparePresetsArgs) -> Result<(), Error> {
    let candidate = &args.candidate;
    let choice = select_candidate(candidate)?;
    let presets = [&args.first, &args.second];
    let [first, second] = presets.map(|preset| choice.preset_at(preset, candidate.size.0));
    let (first, second) = (first?, second?);
    let scenes = load_scenes(&candidate.scenes.scenes_dir, &candidate.scenes.scenes)?;
    let gpu = open_candidate_gpu(&choice, candidate)?;
    let (_claim, shots) = render_shots(&scenes, &choice, candidate, Sharing::Alone)?;
    let bleed = candidate.objective.contains(&Objective::Bleed);
    let mut scorer = evaluator(&shots, &choice, gpu.as_ref(), bleed, make_monitor())?;
    let paired = compare_paired(&mut scorer, &first, &second)?;
    let json = serde_json::to_string_pretty(&paired).expect("a comparison is plain data");
    let path = candidate.scenes.out.join("compare.json");
    frame::write_atomically(&path, json.as_bytes())?;
    let table = paired_table(&paired, presets.map(String::as_str));
    CommandResult { table, json, path }.print(args.json)
}
