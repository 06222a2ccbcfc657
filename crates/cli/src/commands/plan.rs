//! Plans of runs from the command line.

use std::path::{Path, PathBuf};

use suite::{
    Claim, Error, FEWEST_REPLICATES, FilterChoice, InputFormat, RunBounds, RunPlan, SceneBounds,
    Sharing, claim, read_bounds,
};
use tracer::{RenderSettings, Scene};

use super::render_settings::make_render_settings;
use crate::arguments::MeasureArgs;
use crate::output::print::print_scene_notes;
use crate::output::progress::make_monitor;
use crate::selection::{select_filters, select_scenes};

/// Loads scenes with their bounds, and filters; renders nothing. Scores are to have no intervals.
pub fn make_plan(args: &MeasureArgs, out: PathBuf) -> Result<(RunPlan, RunBounds), Error> {
    let scenes = load_scenes(&args.scenes.scenes_dir, &args.scenes.scenes)?;
    let bounds = (scenes.iter())
        .map(|(scene, bounds)| (scene.name.clone(), bounds.clone()))
        .collect();
    let filters = load_filters(args)?;
    let default = RenderSettings::default();
    let size = args.size.unwrap_or((default.width, default.height));
    let plan = RunPlan {
        scenes: scenes.into_iter().map(|(scene, _)| scene).collect(),
        filters,
        inputs: InputFormat::one_by_one(&args.velocity_format, &args.depth_format, &args.border),
        jitter_frames: args.jitter_frames,
        render: make_render_settings(&args.scenes, size, args.replicates)?,
        out,
        intervals: false,
        no_cache: args.no_cache,
        common: None,
        monitor: make_monitor(),
    };
    plan.check()?;
    Ok((plan, bounds))
}

/// Claims the folder of a run for this process alone.
pub fn claim_out(plan: &RunPlan) -> Result<Claim, Error> {
    claim(&plan.out, &plan.scenes, Sharing::Alone)
}

/// Loads the named scenes of the folder `root` with their bounds; all of it where none is named.
pub fn load_scenes(root: &Path, names: &[String]) -> Result<Vec<(Scene, SceneBounds)>, Error> {
    let choices = select_scenes(root, names)?;
    print_scene_notes(choices.iter().map(|choice| &choice.scene));
    (choices.into_iter())
        .map(|choice| {
            let bounds = read_bounds(root, &choice.folder)?;
            Ok((choice.scene, bounds))
        })
        .collect()
}

/// Names the folder of a scene, which may be a variant, below the folder of scenes.
pub fn scene_folder_below(root: &Path, scene: &str) -> PathBuf {
    root.join(scene.split_once('@').map_or(scene, |(name, _)| name))
}

/// Reads the bounds of a scene for pictures of one size; none where there is no such folder.
pub fn read_bounds_at(
    root: &Path,
    folder: &Path,
    size: (u32, u32),
) -> Result<Option<SceneBounds>, Error> {
    match folder.is_dir() {
        true => Ok(Some(read_bounds(root, folder)?.at(size))),
        false => Ok(None),
    }
}

fn load_filters(args: &MeasureArgs) -> Result<Vec<FilterChoice>, Error> {
    let filters = select_filters(
        &args.filters,
        args.preset.as_deref(),
        &args.set,
        args.programs.programs(),
    )?;
    Ok((filters.into_iter())
        .map(|choice| choice.as_written(args.as_written))
        .collect())
}

/// Refuses truths with too few replicates for intervals.
pub fn check_replicates_for_intervals(replicates: u32) -> Result<(), Error> {
    match replicates {
        FEWEST_REPLICATES.. => Ok(()),
        few => Err(Error::Usage(format!(
            "--replicates {few}: {FEWEST_REPLICATES} or more are needed to tell how sure a score is"
        ))),
    }
}
