//! Candidates on the command line: a filter, its preset, and the rendered scenes to score it on.

use clap::Args;
use filters::Gpu;
use frame::Size;
use judge::BoundedScene;
use measure::{
    Error, FilterChoice, Sharing, estimate_case_seconds, estimate_render_seconds, lock_folder,
    open_gpu,
};
use terminal::arguments::{AdapterArgs, ProgramArgs, SceneArgs, filter_names, parse_size};
use terminal::expected::print_expected_time;
use terminal::output::{count_text, make_monitor};
use terminal::selection::{load_scenes, select_filters};
use tracer::RenderSettings;

use crate::evaluator::Evaluator;
use crate::target::render_scenes;
use crate::trial::Objective;

/// Choice of a filter, and of the scenes that it is scored on.
#[derive(Debug, Args)]
pub struct CandidateArgs {
    /// Filter: a name or a folder.
    #[arg(help_heading = "Filters", long, value_name = "FILTER", value_parser = filter_names(), hide_possible_values = true)]
    pub filter: String,
    /// Preset to start from [default: the filter's first].
    #[arg(help_heading = "Filters", long, value_name = "PRESET")]
    pub from: Option<String>,
    /// Keep lengths in pixels as the preset has them [default: scale them from the width that the
    /// preset was made for to the picture's].
    #[arg(help_heading = "Filters", long)]
    pub as_written: bool,
    /// Objectives, separated by commas: flip (always), bleed (`bleed_lateral`, neither ahead nor
    /// behind), cost.
    #[arg(help_heading = "Filters", long, value_delimiter = ',', default_value = "flip,bleed,cost", value_name = "OBJECTIVES", value_parser = parse_objective)]
    pub objective: Vec<Objective>,
    /// Picture size in pixels.
    #[arg(help_heading = "Scenes and files", long, value_name = "WxH", default_value = "320x180", value_parser = parse_size)]
    pub size: Size,
    /// Scenes to score it on.
    #[command(flatten)]
    pub scenes: SceneArgs,
    /// Whether the filter may be a program.
    #[command(flatten)]
    pub programs: ProgramArgs,
    /// Adapter that the filter runs on.
    #[command(flatten)]
    pub adapter: AdapterArgs,
}

impl CandidateArgs {
    /// Selects the filter with its start preset, for the requested picture size.
    pub fn select(&self) -> Result<FilterChoice, Error> {
        let names = [self.filter.clone()];
        let preset = self.from.as_deref();
        let choice = select_filters(&names, preset, &[], self.programs.programs())?.remove(0);
        Ok(choice
            .as_written(self.as_written)
            .scaled_to(self.size.width))
    }

    /// Loads the scenes, with their bounds for the requested picture size.
    pub fn load_scenes(&self) -> Result<Vec<BoundedScene>, Error> {
        let SceneArgs { root, .. } = &self.scenes;
        load_scenes(&root.scenes_dir, &self.scenes.names()?, Some(self.size))
    }

    /// Returns the render settings of scenes.
    pub fn render_settings(&self) -> RenderSettings {
        let replicates = RenderSettings::default().replicates;
        self.scenes.render_settings(self.size, replicates)
    }

    /// Opens the adapter, if the filter needs one.
    pub fn open_gpu(&self, choice: &FilterChoice) -> Result<Option<Gpu>, Error> {
        let adapter = self.adapter.adapter.as_deref();
        let filters = std::slice::from_ref(choice);
        Ok(open_gpu(filters, adapter, make_monitor())?)
    }

    /// Prints the expected time, renders or reads the scenes, and scores candidates on them. If the number of candidates is
    /// known, locks the folder meanwhile; otherwise other processes may share it.
    pub fn score<T>(
        &self,
        choice: &FilterChoice,
        bleed: bool,
        candidates: Option<usize>,
        work: impl FnOnce(&mut Evaluator) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let scenes = self.load_scenes()?;
        let gpu = self.open_gpu(choice)?;
        let render = self.render_settings();
        let sharing = match candidates {
            Some(count) => {
                print_expected_scoring(&scenes, &render, count, f64::INFINITY);
                Sharing::Alone
            }
            None => {
                print_expected_scoring(&scenes, &render, 1, f64::INFINITY);
                Sharing::Together
            }
        };
        let SceneArgs { out, .. } = &self.scenes;
        let locked = lock_folder(out, scenes.iter().map(|known| &known.scene), sharing)?;
        let filter = &choice.filter;
        let rendered = render_scenes(&scenes, filter, &render, out, make_monitor())?;
        // A process that shares the folder has finished reading it.
        let _lock = candidates.is_some().then_some(locked);
        let mut evaluator = Evaluator::new(gpu.as_ref(), choice, &rendered, bleed, make_monitor())?;
        work(&mut evaluator)
    }
}

/// Prints the expected time of scoring candidates on scenes that are not rendered yet. Scoring ends
/// after `limit` seconds.
pub fn print_expected_scoring(
    scenes: &[BoundedScene],
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

/// Parses an objective of a search.
fn parse_objective(text: &str) -> Result<Objective, String> {
    let mut all = Objective::ALL.iter().copied();
    let named = all.find(|objective| objective.name() == text);
    named.ok_or_else(|| "allowed: flip, bleed, cost".to_owned())
}
