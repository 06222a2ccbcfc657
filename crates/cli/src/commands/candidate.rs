//! A candidate of `tune search`, `tune evaluate` and `tune serve`: its filter, and the rendered scenes that it is scored on.

use filters::Gpu;
use judge::SceneBounds;
use store::{Claim, Sharing, claim};
use suite::{Error, FilterChoice, estimate_case_seconds, estimate_render_seconds, open_gpu};
use tracer::{RenderSettings, Scene};
use tune::{RenderedScene, render_scenes};

use super::expected::print_expected_time;
use super::render_settings::make_render_settings;
use super::run_plan::load_scenes;
use crate::arguments::{CandidateArgs, SceneArgs};
use crate::output::{count_text, make_monitor};
use crate::selection::select_filters;

/// Selects the filter with the preset to start from, for pictures of the size that is asked for.
pub fn select_candidate(args: &CandidateArgs) -> Result<FilterChoice, Error> {
    let names = [args.filter.clone()];
    let choice =
        select_filters(&names, args.from.as_deref(), &[], args.programs.programs())?.remove(0);
    Ok(choice.as_written(args.as_written).scaled_to(args.size.0))
}

/// Loads the scenes that candidates are scored on, with their bounds for pictures of the size that is asked for.
pub fn load_candidate_scenes(args: &CandidateArgs) -> Result<Vec<(Scene, SceneBounds)>, Error> {
    load_scenes(
        &args.scenes.root.scenes_dir,
        &args.scenes.names()?,
        Some(args.size),
    )
}

/// Makes the settings that scenes are rendered by.
pub fn candidate_render_settings(args: &CandidateArgs) -> Result<RenderSettings, Error> {
    make_render_settings(
        &args.scenes,
        args.size,
        RenderSettings::default().replicates,
    )
}

/// Opens the adapter, where the filter needs one.
pub fn open_candidate_gpu(
    choice: &FilterChoice,
    args: &CandidateArgs,
) -> Result<Option<Gpu>, Error> {
    let adapter = args.adapter.adapter.as_deref();
    Ok(open_gpu(
        std::slice::from_ref(choice),
        adapter,
        make_monitor(),
    )?)
}

/// Prints the expected time of scoring a number of candidates on scenes that are not rendered yet. Scoring ends after `limit`
/// seconds.
pub fn print_expected_scoring(
    scenes: &[(Scene, SceneBounds)],
    render: &RenderSettings,
    candidates: usize,
    limit: f64,
) {
    let count = scenes.len() as f64;
    let rendering = count * estimate_render_seconds(render, 1);
    let scoring = candidates as f64 * count * estimate_case_seconds(render);
    let candidates = count_text(candidates, "candidate", "candidates");
    let scenes = count_text(scenes.len(), "scene", "scenes");
    print_expected_time(
        rendering + scoring.min(limit),
        &format!("{candidates} on {scenes}"),
    );
}

/// Claims the folder for files, and renders the frames and truths of the scenes into it, or reads them back.
pub fn claim_and_render(
    scenes: &[(Scene, SceneBounds)],
    choice: &FilterChoice,
    args: &CandidateArgs,
    sharing: Sharing,
) -> Result<(Claim, Vec<RenderedScene>), Error> {
    let SceneArgs { out, .. } = &args.scenes;
    let settings = candidate_render_settings(args)?;
    let claimed = claim(out, scenes.iter().map(|(scene, _)| scene), sharing)?;
    let alignment = choice.filter.alignment;
    let rendered = render_scenes(scenes, alignment, &settings, out, make_monitor())?;
    Ok((claimed, rendered))
}
