//! Plans of runs from the command line.

use std::collections::BTreeMap;
use std::path::PathBuf;

use judge::{BOUNDS_FILE, Margin, RunBounds, read_bounds_file};
use measure::{Error, FolderLock, IngestedScene, Run, RunPlan, Sharing, lock_folder};
use metrics::Metric;
use scene::Location;
use tracer::RenderSettings;

use crate::ingested_scenes::{leave_out_filters, read_ingested_bounds, refuse_render_options};
use crate::kept_truths::check_truths;
use crate::noise::choose_noise;
use terminal::arguments::{MeasureArgs, RunOptions};
use terminal::output::make_monitor;
use terminal::selection::{load_scenes, read_scene_bounds, select_filters, select_ingested_scenes};

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
        .map(|known| (known.scene.id.clone(), known.bounds.clone()))
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
    let drawn = ingested.first().map(|scene| scene.size);
    let size = args.size.or(drawn).unwrap_or(default.size());
    let plan = RunPlan {
        scenes: scenes.into_iter().map(|known| known.scene).collect(),
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
    let noise = choose_noise(args, &plan.scenes)?;
    Ok((RunPlan { noise, ..plan }, bounds))
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
    let size = run.render.size();
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
