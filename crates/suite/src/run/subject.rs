//! Subject of a case, known before anything is measured.

use std::path::{Path, PathBuf};

use filters::AdapterDescription;
use frame::Alignment;
use tracer::Scene;

use crate::case::{ACCUMULATE, IDENTITY, SCATTER_ORACLE};
use crate::run::Plan;
use crate::run::filter_choice::FilterChoice;
use crate::{InputFormat, LADDER};

/// Accumulations that are shown beside the filters, rungs of the ladder.
const SUBFRAMES: [u32; 4] = [4, 8, 16, 64];

/// A picture to be made of a scene, and the truth that it is measured against.
pub(crate) struct Subject<'a> {
    /// Of the truth.
    pub alignment: Alignment,
    /// What makes the picture.
    pub maker: Maker<'a>,
}

/// What makes a picture.
#[derive(Clone, Copy)]
pub(crate) enum Maker<'a> {
    /// The frame as it is: a bar to measure filters by.
    Identity,
    /// The best that the frame allows: another.
    ScatterOracle,
    /// The mean of so many sub-frames: a third.
    Accumulation(u32),
    /// A filter that gets the frame in some form.
    Filter(&'a FilterChoice, InputFormat),
}

impl<'a> Subject<'a> {
    /// Per alignment the bars, then one per filter preset and form of its input.
    pub fn all(plan: &'a Plan, filters: &'a [FilterChoice]) -> Vec<Self> {
        debug_assert!(SUBFRAMES.iter().all(|count| LADDER.contains(count)));
        let bars = plan.alignments().into_iter().flat_map(|alignment| {
            let accumulations = SUBFRAMES.map(Maker::Accumulation);
            [Maker::Identity, Maker::ScatterOracle]
                .into_iter()
                .chain(accumulations)
                .map(move |maker| Self { alignment, maker })
        });
        let filters = filters.iter().flat_map(|choice| {
            plan.inputs.iter().map(|input| Self {
                alignment: choice.filter.alignment,
                maker: Maker::Filter(choice, *input),
            })
        });
        bars.chain(filters).collect()
    }

    /// Whether it is a bar to measure filters by, and no filter.
    pub fn is_bar(&self) -> bool {
        !matches!(self.maker, Maker::Filter(..))
    }

    /// Name of the filter, or of the bar.
    pub fn filter(&self) -> &str {
        match self.maker {
            Maker::Identity => IDENTITY,
            Maker::ScatterOracle => SCATTER_ORACLE,
            Maker::Accumulation(_) => ACCUMULATE,
            Maker::Filter(choice, _) => &choice.filter.name,
        }
    }

    /// The preset that the parameters started from; of an accumulation the number of sub-frames.
    pub fn preset(&self) -> String {
        match self.maker {
            Maker::Identity | Maker::ScatterOracle => String::new(),
            Maker::Accumulation(subframes) => subframes.to_string(),
            Maker::Filter(choice, _) => choice.preset.clone(),
        }
    }

    /// How messages call it: `jump_flood:paper`, and behind that what is not as usual.
    pub fn name(&self) -> String {
        let overrides = match self.maker {
            Maker::Filter(choice, _) => choice.overrides_text(),
            _ => String::new(),
        };
        self.name_with(&overrides)
    }

    /// The same without its overrides.
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

    /// The form in which a filter gets the frame.
    pub fn input(&self) -> InputFormat {
        match self.maker {
            Maker::Filter(_, input) => input,
            _ => InputFormat::default(),
        }
    }

    /// Folder of its pictures, relative to `run.json`. A bar may be made for several alignments.
    pub fn folder(&self, scene: &Scene) -> PathBuf {
        let mut parts = vec![self.filter().to_owned(), self.preset()];
        if self.is_bar() {
            parts.push(self.alignment.name().to_owned());
        }
        if let Maker::Filter(choice, _) = self.maker {
            let changes = choice.overrides.iter();
            parts.extend(changes.map(|(parameter, value)| format!("{parameter}_{value}")));
        }
        parts.extend(self.input().change().map(|change| change.replace('=', "_")));
        parts.retain(|part| !part.is_empty());
        Path::new(&scene.name).join(parts.join("_"))
    }

    /// All that determines what is measured of it, beside the program, the scene, its frame and its truths; none where that
    /// cannot be known: what the program does that a filter runs.
    pub fn inputs(&self, plan: &Plan, adapter: Option<&AdapterDescription>) -> Option<String> {
        let Maker::Filter(choice, input) = self.maker else {
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
