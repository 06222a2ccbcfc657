//! A case before it is measured.

use filters::{AdapterDescription, Settings};
use frame::Alignment;
use serde::Serialize;

use super::plan::RunPlan;
use crate::filter_choice::FilterChoice;
use crate::identity::{CaseId, ReferencePicture};
use crate::inputs::input_format::InputFormat;
use crate::render::ingested_scene::IngestedScene;
use crate::render::run_scene::RunScene;
use crate::{LADDER, hash_inputs};

/// Numbers of sub-frames in the accumulations that filters are compared with, rungs of the ladder.
const SUBFRAMES: [u32; 4] = [4, 8, 16, 64];

/// A picture to make of a scene, and the truth to measure it against.
pub(crate) struct PlannedCase<'a> {
    /// Identity.
    pub id: CaseId,
    /// Maker of the picture.
    pub source: PictureSource<'a>,
}

/// A maker of pictures: a filter, or a reference to compare filters with.
pub(crate) enum PictureSource<'a> {
    /// A reference to compare filters with.
    Reference(ReferencePicture),
    /// A filter, for the picture width at which it gets the frame, and the form of the frame.
    Filter(Box<FilterChoice>, InputFormat),
    /// The engine that drew the frame.
    Engine(&'a IngestedScene),
}

/// Inputs of a picture to compare filters with. The hash of an engine's frame covers the engine's
/// picture.
#[derive(Serialize)]
struct ReferenceInputs<'a> {
    filter: &'a str,
    preset: &'a str,
}

/// Inputs of a filter's picture.
#[derive(Serialize)]
struct FilterInputs<'a> {
    filter: &'a str,
    preset: &'a str,
    settings: &'a Settings,
    input: &'a InputFormat,
    adapter: Option<&'a AdapterDescription>,
    jitter_frames: u32,
}

impl<'a> PlannedCase<'a> {
    /// Lists each alignment's reference pictures, the picture of the scene's engine, then one case
    /// per filter preset and input form. Leaves out filters of an alignment that no truth of the
    /// scene has.
    pub fn all(plan: &RunPlan, scene: RunScene<'a>) -> Vec<Self> {
        assert!(SUBFRAMES.iter().all(|count| LADDER.contains(count)));
        let alignments = scene.alignments(plan.alignments());
        let references = alignments.iter().flat_map(|alignment| {
            let accumulations = scene.accumulations(&SUBFRAMES, *alignment, plan.ladders);
            let accumulations = accumulations
                .into_iter()
                .map(ReferencePicture::Accumulation);
            [ReferencePicture::Identity, ReferencePicture::ScatterOracle]
                .into_iter()
                .chain(accumulations)
                .map(|picture| Self::new(scene, *alignment, PictureSource::Reference(picture)))
        });
        let engine = scene.ingested().filter(|engine| engine.has_picture);
        let engine_case =
            engine.map(|engine| Self::new(scene, engine.alignment, PictureSource::Engine(engine)));
        let is_measured = |choice: &&FilterChoice| {
            let is_left_out = |scene: &IngestedScene| scene.leaves_out(choice).is_some();
            alignments.contains(&choice.filter.alignment)
                && !scene.ingested().is_some_and(is_left_out)
        };
        let picture = plan.render.size();
        let filters = plan.filters.iter().filter(is_measured).flat_map(|choice| {
            plan.inputs.iter().map(move |input| {
                let width = input.scale.blurred_size(picture).width;
                let source = PictureSource::Filter(Box::new(choice.scaled_to(width)), *input);
                Self::new(scene, choice.filter.alignment, source)
            })
        });
        let all = references.chain(engine_case).chain(filters);
        all.filter(|case| plan.part.holds(case.id.is_reference))
            .collect()
    }

    fn new(scene: RunScene, alignment: Alignment, source: PictureSource<'a>) -> Self {
        let (filter, preset) = match &source {
            PictureSource::Reference(picture) => (picture.name(), picture.preset()),
            PictureSource::Filter(choice, _) => (&*choice.filter.name, choice.preset.clone()),
            PictureSource::Engine(scene) => (scene.filter_name(), String::new()),
        };
        let (input, overrides) = match &source {
            PictureSource::Filter(choice, input) => (*input, choice.overrides.clone()),
            _ => Default::default(),
        };
        let id = CaseId {
            scene: scene.id().clone(),
            filter: filter.to_owned(),
            preset,
            is_reference: matches!(source, PictureSource::Reference(_)),
            input,
            overrides,
            alignment,
        };
        Self { id, source }
    }

    /// Hashes all that determines the scores, apart from the program, the scene, its frame and its
    /// truths; none for a filter that is a program, since nothing records what it does.
    pub fn inputs(&self, plan: &RunPlan, adapter: Option<&AdapterDescription>) -> Option<String> {
        let PictureSource::Filter(choice, input) = &self.source else {
            return Some(hash_inputs(&ReferenceInputs {
                filter: &self.id.filter,
                preset: &self.id.preset,
            }));
        };
        let FilterChoice {
            filter,
            preset,
            settings,
            ..
        } = &**choice;
        filter.command.is_none().then(|| {
            hash_inputs(&FilterInputs {
                filter: &filter.content_hash,
                preset,
                settings,
                input,
                adapter,
                jitter_frames: plan.jitter_frames,
            })
        })
    }
}
