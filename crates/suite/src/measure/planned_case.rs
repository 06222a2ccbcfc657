//! A case before it is measured.

use std::path::{Path, PathBuf};

use filters::AdapterDescription;
use frame::Alignment;
use tracer::Scene;

use super::plan::RunPlan;
use crate::filter::choice::FilterChoice;
use crate::filter::input_format::InputFormat;
use crate::render::ladders::LADDER;
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
}

impl<'a> PlannedCase<'a> {
    /// Lists the reference pictures of each alignment, then one case per filter preset and form of its input.
    pub fn all(plan: &'a RunPlan, filters: &'a [FilterChoice]) -> Vec<Self> {
        debug_assert!(SUBFRAMES.iter().all(|count| LADDER.contains(count)));
        let references = plan.alignments().into_iter().flat_map(|alignment| {
            let accumulations = SUBFRAMES.map(PictureSource::Accumulation);
            [PictureSource::Identity, PictureSource::ScatterOracle]
                .into_iter()
                .chain(accumulations)
                .map(move |source| Self { alignment, source })
        });
        let filters = filters.iter().flat_map(|choice| {
            plan.inputs.iter().map(|input| Self {
                alignment: choice.filter.alignment,
                source: PictureSource::Filter(choice, *input),
            })
        });
        references.chain(filters).collect()
    }

    /// Tells whether the picture is a reference, and not made by a filter.
    pub fn is_reference(&self) -> bool {
        !matches!(self.source, PictureSource::Filter(..))
    }

    /// Returns the name of the filter, or of the reference.
    pub fn filter(&self) -> &str {
        match self.source {
            PictureSource::Identity => IDENTITY,
            PictureSource::ScatterOracle => SCATTER_ORACLE,
            PictureSource::Accumulation(_) => ACCUMULATE,
            PictureSource::Filter(choice, _) => &choice.filter.name,
        }
    }

    /// Returns the preset that the parameters started from; of an accumulation the number of sub-frames.
    pub fn preset(&self) -> String {
        match self.source {
            PictureSource::Identity | PictureSource::ScatterOracle => String::new(),
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
    pub fn folder(&self, scene: &Scene) -> PathBuf {
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
        Path::new(&scene.name).join(parts.join("_"))
    }

    /// Writes out all that determines the scores, beside the program, the scene, its frame and its truths; none for a filter that
    /// is a program, because nothing records what that does.
    pub fn inputs(&self, plan: &RunPlan, adapter: Option<&AdapterDescription>) -> Option<String> {
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
