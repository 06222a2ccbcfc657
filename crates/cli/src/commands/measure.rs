//! Plans from the command line, and run.json from runs: shared by `run`, `check` and `calibrate`.

use std::path::{Path, PathBuf};

use crate::selection::{select_filters, select_scenes};
use filters::AdapterDescription;
use suite::{
    Claim, Error, FEWEST_REPLICATES, FilterChoice, Finding, InputFormat, Judgement, RenderSettings,
    Run, RunBounds, RunPlan, SceneBounds, Sharing, claim, read_bounds,
};

use tracer::Scene;

use super::{render_settings, tell_notes};
use crate::arguments::MeasureArgs;
use crate::output::progress::monitor;

/// Loads scenes with their bounds, and filters; renders nothing. Scores are to have no intervals.
pub fn plan(args: &MeasureArgs, out: PathBuf) -> Result<(RunPlan, RunBounds), Error> {
    let scenes = scenes(&args.scenes.scenes_dir, &args.scenes.scenes)?;
    let bounds = (scenes.iter())
        .map(|(scene, bounds)| (scene.name.clone(), bounds.clone()))
        .collect();
    let filters = filters(args)?;
    let usual = RenderSettings::default();
    let size = args.size.unwrap_or((usual.width, usual.height));
    let plan = RunPlan {
        scenes: scenes.into_iter().map(|(scene, _)| scene).collect(),
        filters,
        inputs: InputFormat::one_by_one(&args.velocity_format, &args.depth_format, &args.border),
        jitter_frames: args.jitter_frames,
        render: render_settings(&args.scenes, size, args.replicates)?,
        out,
        intervals: false,
        no_cache: args.no_cache,
        monitor: monitor(args.scenes.quiet),
    };
    Ok((plan, bounds))
}

/// Claims the folder of a run for this process alone.
pub fn claim_out(plan: &RunPlan) -> Result<Claim, Error> {
    claim(&plan.out, &plan.scenes, Sharing::Alone)
}

/// Scenes with their bounds, of the folder `root`; all of it where there are no words.
pub fn scenes(root: &Path, words: &[String]) -> Result<Vec<(Scene, SceneBounds)>, Error> {
    let choices = select_scenes(root, words)?;
    tell_notes(choices.iter().map(|choice| &choice.scene));
    (choices.into_iter())
        .map(|choice| {
            let bounds = read_bounds(root, &choice.folder)?;
            Ok((choice.scene, bounds))
        })
        .collect()
}

fn filters(args: &MeasureArgs) -> Result<Vec<FilterChoice>, Error> {
    let folders = args.filter.iter().map(|folder| Path::new(".").join(folder));
    let words: Vec<String> = (args.filters.iter().cloned())
        .chain(folders.map(|folder| folder.display().to_string()))
        .collect();
    let filters = select_filters(
        &words,
        args.preset.as_deref(),
        &args.set,
        args.programs.programs(),
    )?;
    Ok((filters.into_iter())
        .map(|choice| choice.as_written(args.as_written))
        .collect())
}

/// Refuses truths that allow no intervals.
pub fn check_replicates(replicates: u32) -> Result<(), Error> {
    match replicates {
        FEWEST_REPLICATES.. => Ok(()),
        few => Err(Error::Usage(format!(
            "--replicates {few}: {FEWEST_REPLICATES} or more are needed to tell how sure a score is"
        ))),
    }
}

/// Writes `run.json` and returns what stands in it.
pub fn write_run(run: &Run, out: &Path) -> Result<String, Error> {
    let json = serde_json::to_string_pretty(run).expect("a run is plain data");
    frame::write_atomically(&out.join("run.json"), json.as_bytes())?;
    Ok(json)
}

/// Writes `run.json` and the findings about it; returns what stands in `run.json`.
pub fn write_judged(run: &Run, findings: &[Finding], out: &Path) -> Result<String, Error> {
    let json = write_run(run, out)?;
    Judgement::new(out, findings.to_vec())?.write(out)?;
    Ok(json)
}

/// `llvmpipe (LLVM 19), vulkan`
pub fn adapter_line(adapter: &Option<AdapterDescription>) -> String {
    match adapter {
        Some(adapter) => format!("{}, {}", adapter.name, adapter.backend),
        None => "none, every filter is a command".to_owned(),
    }
}
