//! The command `sensitivity`.

use suite::{Effort, Error, Sharing, Space, evaluator, sensitivity};

use super::candidate::{open_candidate_gpu, render_shots, select_candidate};
use super::plan::load_scenes;
use super::result::CommandResult;
use crate::arguments::SensitivityArgs;
use crate::output::progress::make_monitor;
use crate::tables::sensitivity::sensitivity_table;

/// Studies the parameters of a filter, writes `sensitivity.json`, prints the table.
pub fn execute(args: &SensitivityArgs) -> Result<(), Error> {
    let candidate = &args.candidate;
    let choice = select_candidate(candidate)?;
    let effort = Effort {
        rows: args.rows,
        ..Effort::default()
    };
    let space = Space::new(&choice.filter, choice.settings.clone(), &args.vary)?;
    let scenes = load_scenes(&candidate.scenes.scenes_dir, &candidate.scenes.scenes)?;
    let gpu = open_candidate_gpu(&choice, candidate)?;
    let (_claim, shots) = render_shots(&scenes, &choice, candidate, Sharing::Alone)?;
    let monitor = make_monitor();
    let mut scorer = evaluator(&shots, &choice, gpu.as_ref(), false, monitor)?;
    let label = format!("parameters of {}", choice.filter.name);
    let found = monitor.watch(&label, |watch| {
        sensitivity(&mut scorer, &space, effort, args.search_seed, watch)
    })?;
    let json = serde_json::to_string_pretty(&found).expect("a study is plain data");
    let path = candidate.scenes.out.join("sensitivity.json");
    frame::write_atomically(&path, json.as_bytes())?;
    let table = sensitivity_table(&found);
    CommandResult { table, json, path }.print(args.json)
}
