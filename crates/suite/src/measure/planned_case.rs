//! A case before it is measured.

use std::path::{Path, PathBuf};

use filters::AdapterDescription;
use frame::Alignment;
use store::LADDER;

use super::plan::RunPlan;
use super::run_scene::RunScene;
use crate::engine_scene::EngineScene;
use crate::filter::choice::FilterChoice;
use crate::filter::input_format::InputFormat;
use crate::run::case::{ACCUMULATE, IDENTITY, SCATTER_ORACLE};

/// Sub-frame counts of the accumulations that filters are compared with, rungs of the ladder.
const SUBFRAMES: [u32; 4] = [4, 8, 16, 64];

/// A picture to be made of a scene, and the truth that it is measured against.
pub(crate) struct PlannedCase<'a> {
    /// Alignment of the truth.
    pub alignment: Alignment,
    /// Maker of the picture.
    pub source: PictureSource<'a>,
}

/// A maker of pictures: a filter, or one of the references that filters are compared with.
#[derive(Clone, Copy)]
pub(crate) enum PictureSource<'a> {
    /// The frame as it is.
    Identity,
    /// The one-frame oracle.
    ScatterOracle,
    /// The mean of a number of sub-frames.
    Accumulation(u32),
    /// A filter that gets the frame in some form.
    Filter(&'a FilterChoice, InputFormat),
    /// The engine that drew the frame.
    Engine(&'a EngineScene),
}

impl<'a> PlannedCase<'a> {
    /// Lists the reference pictures of each alignment, the picture of the scene's engine, then one case per filter preset and form
    /// of its input. Filters of another alignment than all of a scene's truths are left out.
    pub fn all(plan: &'a RunPlan, filters: &'a [FilterChoice], scene: RunScene<'a>) -> Vec<Self> {
        debug_assert!(SUBFRAMES.iter().all(|count| LADDER.contains(count)));
        let alignments = scene.alignments(plan.alignments());
        let references = alignments.iter().flat_map(|alignment| {
            let accumulations = scene.accumulations(&SUBFRAMES, *alignment, plan.ladders);
            let accumulations = accumulations.into_iter().map(PictureSource::Accumulation);
            [PictureSource::Identity, PictureSource::ScatterOracle]
                .into_iter()
                .chain(accumulations)
                .map(|source| Self {
                    alignment: *alignment,
                    source,
                })
        });
        let own = match scene {
            RunScene::Drawn(scene) if scene.has_picture => Some(Self {
                alignment: scene.alignment,
                source: PictureSource::Engine(scene),
            }),
            _ => None,
        };
        let is_measured = |choice: &&FilterChoice| {
            alignments.contains(&choice.filter.alignment)
                && !(scene.drawn().is_some() && choice.filter.reads_camera())
        };
        let filters = filters.iter().filter(is_measured).flat_map(|choice| {
            plan.inputs.iter().map(|input| Self {
                alignment: choice.filter.alignment,
                source: PictureSource::Filter(choice, *input),
            })
        });
        let all = references.chain(own).chain(filters);
        all.filter(|case| plan.part.holds(case.is_reference()))
            .collect()
    }

    /// Tells whether the picture is a reference, and not made by a filter.
    pub fn is_reference(&self) -> bool {
        !matches!(
            self.source,
            PictureSource::Filter(..) | PictureSource::Engine(_)
        )
    }

    /// Returns the name of the filter, the reference or the engine.
    pub fn filter(&self) -> &str {
        match self.source {
            PictureSource::Identity => IDENTITY,
            PictureSource::ScatterOracle => SCATTER_ORACLE,
            PictureSource::Accumulation(_) => ACCUMULATE,
            PictureSource::Filter(choice, _) => &choice.filter.name,
            PictureSource::Engine(scene) => scene.filter_name(),
        }
    }

    /// Returns the preset that the parameters started from; of an accumulation the number of sub-frames.
    pub fn preset(&self) -> String {
        match self.source {
            PictureSource::Identity | PictureSource::ScatterOracle | PictureSource::Engine(_) => {
                String::new()
            }
            PictureSource::Accumulation(subframes) => subframes.to_string(),
            PictureSource::Filter(choice, _) => choice.preset.clone(),
        }
    }

    /// Names the case as messages do: `jump_flood:paper`, followed by what is not as usual.
    pub fn name(&self) -> String {
        let overrides = match self.source {
            PictureSource::Filter(choice, _) => choice.overrides_text(),
            _ => String::new(),
        };
        self.name_with(&overrides)
    }

    /// Names the case without its overrides.
    pub fn preset_name(&self) -> String {
        self.name_with("")
    }

    fn name_with(&self, overrides: &str) -> String {
        let mut name = match self.preset().as_str() {
            "" => self.filter().to_owned(),
            preset => format!("{}:{preset}", self.filter()),
        };
        name += overrides;
        name.extend(self.input().change().map(|change| format!(" {change}")));
        name
    }

    /// Returns the form in which a filter gets the frame.
    pub fn input(&self) -> InputFormat {
        match self.source {
            PictureSource::Filter(_, input) => input,
            _ => InputFormat::default(),
        }
    }

    /// Names the folder of the pictures, relative to `run.json`. References have one per alignment.
    pub fn folder(&self, scene: RunScene) -> PathBuf {
        let mut parts = vec![self.filter().to_owned(), self.preset()];
        if self.is_reference() {
            parts.push(self.alignment.name().to_owned());
        }
        if let PictureSource::Filter(choice, _) = self.source {
            let overrides = choice.overrides.iter();
            parts.extend(overrides.map(|(parameter, value)| format!("{parameter}_{value}")));
        }
        parts.extend(self.input().change().map(|change| change.replace('=', "_")));
        parts.retain(|part| !part.is_empty());
        Path::new(scene.name()).join(parts.join("_"))
    }

    /// Writes out all that determines the scores, beside the program, the scene, its frame and its truths; none for a filter that
    /// is a program, because nothing records what that does.
    pub fn inputs(&self, plan: &RunPlan, adapter: Option<&AdapterDescription>) -> Option<String> {
        // The hash of an engine's frame covers the engine's picture.
        let PictureSource::Filter(choice, input) = self.source else {
            return Some(format!("{} {}", self.filter(), self.preset()));
        };
        let FilterChoice {
            filter,
            preset,
            settings,
            ..
        } = choice;
        // A filter holds the text of its kernels.
        filter.command.is_none().then(|| {
            format!(
                "{:?}",
                (
                    (filter, preset, settings, input, adapter),
                    plan.jitter_frames,
                )
            )
        })
    }
}
