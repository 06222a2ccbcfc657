//! Plans of runs from the command line.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use terminal::refuse;

use frame::FrameOptions;
use judge::{
    BOUNDS_FILE, BoundsFile, Margin, RunBounds, SceneBounds, read_bounds,
    read_bounds_beside_scenes, read_bounds_file,
};
use metrics::Metric;
use scene::{Location, Scene, SceneId};
use store::{FolderLock, Sharing, lock_folder};
use suite::{EngineScene, Error, FilterChoice, Run, RunPlan, engine_name};
use tracer::RenderSettings;

use super::kept_truths::check_truths;
use crate::arguments::{MeasureArgs, RunOptions, SceneArgs};
use terminal::output::{count_text, make_monitor, print_note, print_scene_notes};
use terminal::selection::{select_engine_scenes, select_filters, select_scenes};

/// Loads scenes with their bounds, and filters; renders nothing, and does not check the plan yet.
/// The plan asks for no intervals.
pub fn make_plan(args: &MeasureArgs, out: PathBuf) -> Result<(RunPlan, RunBounds), Error> {
    let scenes_dir = &args.scenes.root.scenes_dir;
    let (engine_scenes, names) = select_engine_scenes(scenes_dir, &args.scenes.names()?)?;
    if let Some(scene) = engine_scenes.first() {
        refuse_render_options(&args.scenes, scene)?;
    }
    let scenes = if engine_scenes.is_empty() || !names.is_empty() {
        load_scenes(scenes_dir, &names, args.size)?
    } else {
        Vec::new()
    };
    let mut bounds: RunBounds = (scenes.iter())
        .map(|(scene, bounds)| (scene.id.clone(), bounds.clone()))
        .collect();
    for scene in &engine_scenes {
        bounds.insert(scene.id.clone(), read_engine_bounds(&scene.folder)?);
    }
    let (preset, programs) = (args.preset.as_deref(), args.programs.programs());
    let filters = select_filters(&args.filters, preset, &args.set, programs)?.into_iter();
    let filters = filters
        .map(|choice| choice.as_written(args.as_written))
        .collect();
    let filters = leave_out_filters(filters, &engine_scenes, scenes.is_empty())?;
    let default = RenderSettings::default();
    let drawn = (engine_scenes.first()).map(|scene| (scene.size[0], scene.size[1]));
    let size = (args.size.or(drawn)).unwrap_or((default.width, default.height));
    let plan = RunPlan {
        scenes: scenes.into_iter().map(|(scene, _)| scene).collect(),
        engine_scenes,
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

/// Leaves out filters that cannot run on an engine's scenes, and says so. If scenes are rendered
/// too, those filters run on these.
fn leave_out_filters(
    mut filters: Vec<FilterChoice>,
    engine_scenes: &[EngineScene],
    alone: bool,
) -> Result<Vec<FilterChoice>, Error> {
    for scene in engine_scenes {
        let EngineScene { id, alignment, .. } = scene;
        let mut reasons = BTreeMap::new();
        for choice in &filters {
            let reason = match scene.find_lacking(choice) {
                _ if choice.filter.alignment != *alignment => {
                    format!("of another shutter than the {alignment} one that the engine drew")
                }
                Some(lacking) => format!("because the capture does not have {lacking}"),
                None => continue,
            };
            *reasons.entry(reason).or_insert(0) += 1;
        }
        for (reason, count) in reasons {
            let presets = count_text(count, "preset", "presets");
            print_note(&format!("{id}: leaves out {presets} {reason}"));
        }
    }
    if !alone || engine_scenes.is_empty() {
        return Ok(filters);
    }
    filters.retain(|choice| {
        let can_blur = |scene: &EngineScene| {
            scene.alignment == choice.filter.alignment && scene.find_lacking(choice).is_none()
        };
        engine_scenes.iter().any(can_blur)
    });
    if filters.is_empty() {
        refuse!(
            "--filter: no filter is left that {} can be measured with; allowed: filters with a {} shutter that need no \
             camera motion and no other input that the capture does not have",
            engine_scenes[0].id,
            engine_scenes[0].alignment
        )
    } else {
        Ok(filters)
    }
}

/// Refuses options for frame and shutter: an engine fixed both.
fn refuse_render_options(args: &SceneArgs, scene: &EngineScene) -> Result<(), Error> {
    let default = FrameOptions::default();
    let given = [
        ("--frame-rate", !args.rates.frame_rate.is_empty()),
        ("--shutter-time", !args.rates.shutter_time.is_empty()),
        ("--exposure", args.exposure.is_some()),
        ("--velocity", args.velocity != default.velocity),
        ("--frame-sampling", args.frame_sampling != default.color),
        (
            "--sky-velocity",
            args.frame_options().sky_velocity != default.sky_velocity,
        ),
        ("--guard-band", args.guard_band != 0),
    ];
    match given.iter().find(|(_, given)| *given) {
        None => Ok(()),
        Some((option, _)) => refuse!(
            "{option}: {} is as {} drew it, and is not rendered; leave the option out, or leave out the scene",
            scene.id,
            engine_name(&scene.engine)
        ),
    }
}

/// Reads the bounds next to an engine's scene; our scenes' bounds were measured on our own frames.
fn read_engine_bounds(folder: &Path) -> Result<SceneBounds, Error> {
    let path = folder.join(BOUNDS_FILE);
    let files = (path.is_file().then(|| read_bounds_file(&path))).transpose()?;
    files.as_ref().map_or(Ok(()), refuse_sequence_limits)?;
    Ok(SceneBounds {
        files: files.into_iter().collect(),
    })
}

/// Refuses limits on sequences for an engine's scene: it has one frame, and nothing would judge
/// them.
fn refuse_sequence_limits(file: &BoundsFile) -> Result<(), Error> {
    let tables = file.filters.values().map(|table| &table.bounds);
    let mut all = std::iter::once(&file.default).chain(tables).flatten();
    match all.find(|(_, bound)| bound.length.is_some()) {
        None => Ok(()),
        Some((metric, bound)) => refuse!(
            "{}: {metric} is a score of a sequence, and an engine drew one frame here, so that nothing would judge its limit; \
             remove it",
            bound.place
        ),
    }
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
        let drawn = (folder.on_disk()).filter(|folder| EngineScene::is_in(folder));
        let scene_bounds = match (case.drawn.is_some(), drawn) {
            (true, Some(folder)) => read_engine_bounds(folder)?,
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
    Ok(lock_folder(&plan.out, &plan.scenes, Sharing::Alone)?)
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
