//! Ingested scenes in the plan of a run: what an engine fixed, and their bounds.

use std::collections::BTreeMap;
use std::path::Path;

use frame::FrameOptions;
use judge::{BOUNDS_FILE, BoundsFile, SceneBounds, read_bounds_file};
use measure::{Error, FilterChoice, IngestedScene, engine_name};
use terminal::arguments::SceneArgs;
use terminal::output::{count_text, print_note};
use terminal::refuse;

/// Refuses options for frame and shutter: an engine fixed both.
pub fn refuse_render_options(args: &SceneArgs, scene: &IngestedScene) -> Result<(), Error> {
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

/// Leaves out filters that cannot run on ingested scenes, and says so. If scenes are rendered too,
/// those filters run on these.
pub fn leave_out_filters(
    mut filters: Vec<FilterChoice>,
    scenes: &[IngestedScene],
    alone: bool,
) -> Result<Vec<FilterChoice>, Error> {
    for scene in scenes {
        let mut reasons = BTreeMap::new();
        for reason in filters.iter().filter_map(|choice| scene.leaves_out(choice)) {
            *reasons.entry(reason).or_insert(0) += 1;
        }
        for (reason, count) in reasons {
            let presets = count_text(count, "preset", "presets");
            print_note(&format!("{}: leaves out {presets} {reason}", scene.id));
        }
    }
    let Some(first) = scenes.first().filter(|_| alone) else {
        return Ok(filters);
    };
    filters.retain(|choice| {
        scenes
            .iter()
            .any(|scene| scene.leaves_out(choice).is_none())
    });
    if filters.is_empty() {
        refuse!(
            "--filter: no filter is left that {} can be measured with; allowed: filters with a {} shutter that need no \
             camera motion and no other input that the capture does not have",
            first.id,
            first.alignment
        )
    } else {
        Ok(filters)
    }
}

/// Reads the bounds next to an engine's scene; our scenes' bounds were measured on our own frames.
pub fn read_ingested_bounds(folder: &Path) -> Result<SceneBounds, Error> {
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
