//! A scene ready to measure pictures of it.

use std::collections::BTreeMap;

use filters::{Command, FilterError, Gpu};
use frame::{Frame, Ladder, Picture, Truth, Vectors};
use metrics::{Jitter, MeasureError, Measurement, Metric, ProbeScores, Reference};
use tracer::Scene;

use crate::case::Case;
use crate::run::Plan;
use crate::run::dilated::dilated;
use crate::run::filter_choice::FilterChoice;
use crate::run::pictures::write_case;
use crate::run::probe::{Blurred, blurred, noise};
use crate::run::subject::{Maker, Subject};
use crate::{Error, InputFormat, Intervals, Runner, intervals};

/// Blurs of a mixture may differ from mixtures of blurs by this part of what the blur changes, which is far above rounding.
const MOST_NONLINEARITY: f64 = 1e-3;

/// One scene and the truth of one alignment.
pub(crate) struct Workbench<'a> {
    pub plan: &'a Plan,
    pub gpu: Option<&'a Gpu>,
    pub scene: &'a Scene,
    pub frame: &'a Frame,
    /// The frame in the forms in which filters get it.
    pub stored: &'a [(InputFormat, Frame)],
    pub truth: &'a Truth,
    pub ladder: &'a Ladder,
    pub reference: &'a Reference<'a>,
    /// What the one-frame oracle makes of the frame.
    pub oracle: &'a Picture,
    /// The truth that every case is compared with, unless it is this one.
    pub common: Option<&'a Reference<'a>>,
    /// The truths that all replicates but a pair each make, where scores are to have intervals.
    pub without: Option<&'a [Reference<'a>]>,
}

/// A picture, and what was found out about it.
struct Found {
    picture: Picture,
    measurement: Measurement,
    nonlinearity: Option<f64>,
    jitter: Option<Jitter>,
    intervals: Option<Intervals>,
    dilated: Option<Vectors>,
}

impl Workbench<'_> {
    /// Makes the picture and measures it; writes it and its error maps, and returns the names of the files as well.
    pub fn case(&self, subject: &Subject) -> Result<(Case, Vec<String>), Error> {
        let found = match subject.maker {
            Maker::Identity => self.bar(self.identity())?,
            Maker::ScatterOracle => self.bar(self.oracle.clone())?,
            Maker::Accumulation(subframes) => self.bar(self.accumulation(subframes))?,
            Maker::Filter(choice, input) => self.filter(choice, input)?,
        };
        self.written(subject, found)
    }

    /// The frame as it is.
    fn identity(&self) -> Picture {
        let frame = self.frame.cropped();
        Picture {
            color: frame.color,
            coverage: frame.coverage,
        }
    }

    fn accumulation(&self, subframes: u32) -> Picture {
        let mut rungs = self.ladder.rungs.iter();
        let rung = rungs.find(|rung| rung.subframes == subframes);
        Picture::mean(&rung.expect("bars are rungs of the ladder").halves)
    }

    fn bar(&self, picture: Picture) -> Result<Found, Error> {
        Ok(Found {
            measurement: self.reference.measure(&picture)?,
            picture,
            nonlinearity: None,
            jitter: None,
            intervals: None,
            dilated: None,
        })
    }

    fn filter(&self, choice: &FilterChoice, input: InputFormat) -> Result<Found, Error> {
        let mut stored = self.stored.iter();
        let frame = stored.find(|(format, _)| *format == input);
        let (_, frame) = frame.expect("the frame was stored in every form of the plan");
        let mut runner = Runner::new(self.gpu, choice, frame.size(), self.plan.monitor)?;
        let blurred = blurred(&mut runner, frame).map_err(|error| on_scene(error, self.scene))?;
        let dilated = dilated(&choice.filter, &runner, frame)?;
        let jitter = self.jitter(&mut runner, frame)?;
        let measurement = self.measured(self.reference, &blurred)?;
        Ok(Found {
            intervals: self.intervals(&blurred, &measurement)?,
            nonlinearity: Some(blurred.nonlinearity),
            picture: blurred.picture,
            measurement,
            jitter,
            dilated,
        })
    }

    /// All that a truth says of what came out of a filter.
    fn measured(
        &self,
        reference: &Reference,
        blurred: &Blurred,
    ) -> Result<Measurement, MeasureError> {
        let mut measurement = reference.measure(&blurred.picture)?;
        probe(reference, blurred, &mut measurement);
        Ok(measurement)
    }

    /// The intervals of the scores, where they are asked for.
    fn intervals(
        &self,
        blurred: &Blurred,
        measurement: &Measurement,
    ) -> Result<Option<Intervals>, MeasureError> {
        let Some(without) = self.without else {
            return Ok(None);
        };
        let without = (without.iter())
            .map(|reference| Ok(self.measured(reference, blurred)?.scores))
            .collect::<Result<Vec<_>, MeasureError>>()?;
        let all = Metric::all();
        Ok(Some(intervals(&measurement.scores, &without, all)))
    }

    /// Takes the filter's noise apart; none where it has none, or too few frames are asked for.
    fn jitter(&self, runner: &mut Runner, frame: &Frame) -> Result<Option<Jitter>, Error> {
        if self.plan.jitter_frames < 2 {
            return Ok(None);
        }
        let outputs = noise(runner, frame, self.plan.jitter_frames)
            .map_err(|error| on_scene(error, self.scene))?;
        Ok(outputs
            .filter(|outputs| outputs[1..].iter().any(|output| *output != outputs[0]))
            .and_then(|outputs| self.reference.jitter(&outputs)))
    }

    fn written(&self, subject: &Subject, found: Found) -> Result<(Case, Vec<String>), Error> {
        let Found {
            picture,
            measurement,
            ..
        } = &found;
        let common = match self.common {
            Some(reference) => reference.measure_moving(picture)?,
            None => measurement.scores.moving.clone(),
        };
        let folder = subject.folder(self.scene);
        let files = write_case(
            &self.plan.out.join(&folder),
            self.scene,
            &self.frame.objects,
            (picture, found.dilated.as_ref()),
            measurement,
        )?;
        let choice = match subject.maker {
            Maker::Filter(choice, _) => Some(choice),
            _ => None,
        };
        let command = choice.and_then(|choice| choice.filter.command.as_ref());
        let case = Case {
            scene: self.scene.name.clone(),
            family: self.scene.family,
            exposes: self.scene.exposes.clone(),
            exposure: self.frame.exposure,
            filter: subject.filter().to_owned(),
            preset: subject.preset(),
            bar: subject.is_bar(),
            input: subject.input(),
            parameters: choice.map_or_else(BTreeMap::new, |choice| choice.settings.values.clone()),
            overrides: choice.map_or_else(BTreeMap::new, |choice| choice.overrides.clone()),
            reference_width: choice.and_then(|choice| choice.settings.reference_width),
            command: command.map(Command::words),
            nonlinearity: found.nonlinearity,
            alignment: self.truth.alignment.name().to_owned(),
            truth_hash: self.truth.provenance.content_hash.clone(),
            common,
            jitter: found.jitter,
            intervals: found.intervals.unwrap_or_default(),
            scores: found.measurement.scores,
            folder,
        };
        Ok((case, files))
    }
}

/// Adds the scores of probes, or takes out all that need a filter whose weights do not depend on colour.
fn probe(reference: &Reference, blurred: &Blurred, measurement: &mut Measurement) {
    let scores = &mut measurement.scores;
    if blurred.nonlinearity > MOST_NONLINEARITY {
        let reason = format!(
            "the filter's weights depend on colour: the blur of a mixture differs from the mixture of the blurs by {:.4} \
             of what the blur changes, {MOST_NONLINEARITY} at most allow to tell what it gathers",
            blurred.nonlinearity
        );
        scores.take_out_mattes(&reason);
        scores.probes = ProbeScores::not_applicable(&reason);
        return;
    }
    let probed = reference.measure_probes(&blurred.probes);
    scores.probes = probed.scores;
    measurement.probes = Some(probed.maps);
}

/// A program may fail on one scene and not on another.
fn on_scene(error: FilterError, scene: &Scene) -> FilterError {
    match error {
        FilterError::Command { filter, reason } => FilterError::Command {
            filter: format!("{filter} on {}", scene.name),
            reason,
        },
        other => other,
    }
}
