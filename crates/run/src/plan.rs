//! Plans of runs from the command line.

use std::collections::BTreeMap;
use std::path::PathBuf;

use judge::{
    BOUNDS_FILE, Margin, RunBounds, SceneBounds, read_bounds, read_bounds_beside_scenes,
    read_bounds_file,
};
use measure::{Error, FolderLock, IngestedScene, Run, RunPlan, Sharing, lock_folder};
use metrics::Metric;
use tracer::{Location, RenderSettings, Scene, SceneId};

use crate::ingested_scenes::{leave_out_filters, read_ingested_bounds, refuse_render_options};
use crate::kept_truths::check_truths;
use terminal::arguments::{MeasureArgs, RunOptions};
use terminal::output::{make_monitor, print_scene_notes};
use terminal::selection::{select_filters, select_ingested_scenes, select_scenes};

/// Loads scenes with their bounds, and filters; renders nothing, and does not check the plan yet.
/// The plan asks for no intervals.
pub fn make_plan(args: &MeasureArgs, out: PathBuf) -> Result<(RunPlan, RunBounds), Error> {
    let scenes_dir = &args.scenes.root.scenes_dir;
    let (ingested, names) = select_ingested_scenes(scenes_dir, &args.scenes.names()?)?;
    if let Some(scene) = ingested.first() {
        refuse_render_options(&args.scenes, scene)?;
    }
    let scenes = if ingested.is_empty() || !names.is_empty() {
        load_scenes(scenes_dir, &names, args.size)?
    } else {
        Vec::new()
    };
    let mut bounds: RunBounds = (scenes.iter())
        .map(|(scene, bounds)| (scene.id.clone(), bounds.clone()))
        .collect();
    for scene in &ingested {
        bounds.insert(scene.id.clone(), read_ingested_bounds(&scene.folder)?);
    }
    let (preset, programs) = (args.preset.as_deref(), args.programs.programs());
    let filters = select_filters(&args.filters, preset, &args.set, programs)?.into_iter();
    let filters = filters
        .map(|choice| choice.as_written(args.as_written))
        .collect();
    let filters = leave_out_filters(filters, &ingested, scenes.is_empty())?;
    let default = RenderSettings::default();
    let drawn = (ingested.first()).map(|scene| (scene.size[0], scene.size[1]));
    let size = (args.size.or(drawn)).unwrap_or((default.width, default.height));
    let plan = RunPlan {
        scenes: scenes.into_iter().map(|(scene, _)| scene).collect(),
        ingested,
        filters,
        inputs: args.forms.one_by_one(),
        jitter_frames: args.jitter_frames,
        render: args.scenes.render_settings(size, args.replicates),
        out,
        no_cache: args.no_cache,
        truths: args.truths.clone(),
        monitor: make_monitor(),
        ..RunPlan::default()
    };
    if let Some(truths) = &plan.truths {
        check_truths(truths)?;
    }
    Ok((plan, bounds))
}

/// Applies frames, intervals and the common shutter to a plan.
pub fn apply_options(plan: &mut RunPlan, options: &RunOptions) -> Result<(), Error> {
    plan.frames = options.sequence.frames();
    plan.intervals = options.intervals;
    plan.common = options.common;
    plan.check()
}

/// Adds the bounds of a run's scenes, for the run's picture size, from the folder `root`; skips
/// scenes that are not there. Engines' scenes get none of our bounds.
pub fn add_bounds(bounds: &mut RunBounds, run: &Run, root: &Location) -> Result<(), Error> {
    let size = (run.render.width, run.render.height);
    for case in &run.cases {
        if bounds.contains_key(&case.scene) {
            continue;
        }
        let folder = root.join(&case.scene.name);
        let ingested = (folder.on_disk()).filter(|folder| IngestedScene::is_in(folder));
        let scene_bounds = match (case.drawn.is_some(), ingested) {
            (true, Some(folder)) => read_ingested_bounds(folder)?,
            (false, _) if folder.is_dir() => {
                read_scene_bounds(root, &folder, &case.scene, Some(size))?
            }
            _ => continue,
        };
        bounds.insert(case.scene.clone(), scene_bounds.at(size));
    }
    Ok(())
}

/// Locks the folder of a run for this process alone.
pub fn lock_out(plan: &RunPlan) -> Result<FolderLock, Error> {
    lock_folder(&plan.out, &plan.scenes, Sharing::Alone)
}

/// Loads the named scenes of the folder `root`, or all, with their bounds, including those for
/// pictures of `size`.
pub fn load_scenes(
    root: &Location,
    names: &[String],
    size: Option<(u32, u32)>,
) -> Result<Vec<(Scene, SceneBounds)>, Error> {
    let choices = select_scenes(root, names)?;
    print_scene_notes(choices.iter().map(|choice| &choice.scene));
    (choices.into_iter())
        .map(|choice| {
            let bounds = read_scene_bounds(root, &choice.folder, &choice.scene.id, size)?;
            Ok((choice.scene, bounds))
        })
        .collect()
}

/// Reads the bounds of a scene or a variant. A sealed one, or one at another frame rate, gets only
/// the bounds common to all scenes: the scene's own limits were measured at other speeds.
fn read_scene_bounds(
    root: &Location,
    folder: &Location,
    id: &SceneId,
    size: Option<(u32, u32)>,
) -> Result<SceneBounds, Error> {
    if id.seal.is_some() || id.rate.is_some() {
        read_bounds_beside_scenes(root, size)
    } else {
        read_bounds(root, folder, size)
    }
}

/// Margins by the names of metrics.
pub type Margins = BTreeMap<Metric, Margin>;

/// Reads the score differences that matter (margins); none if the folder has no bounds.
pub fn read_margins(root: &Location) -> Result<Margins, Error> {
    let file = root.join(BOUNDS_FILE);
    if file.exists() {
        Ok(read_bounds_file(&file)?.margins)
    } else {
        Ok(BTreeMap::new())
    }
}
