//! A scene ready to measure pictures of it.

use std::collections::BTreeMap;
use std::path::Path;

use filters::{Command, FilterError, Gpu, Value};
use frame::{Frame, Ladder, Picture, Truth};
use metrics::{Jitter, MeasureError, Measurement, Metric, ProbeScores, Reference};
use tracer::Scene;

use crate::bounds::{Bounds, SceneBounds};
use crate::case::{ACCUMULATE, Case, SCATTER_ORACLE};
use crate::pictures::write_case;
use crate::probe::{Blurred, blurred, noise};
use crate::run::Plan;
use crate::scatter_oracle::scatter_oracle;
use crate::selection::FilterChoice;
use crate::witness::Witness;
use crate::{Error, InputFormat, Intervals, Runner, Verdict, intervals, judge};

/// Accumulations that are shown beside the filters.
const SUBFRAMES: [u32; 4] = [4, 8, 16, 64];

/// Blurs of a mixture may differ from mixtures of blurs by this part of what the blur changes, which is far above rounding.
const MOST_NONLINEARITY: f64 = 1e-3;

/// One scene and the truth of one alignment.
pub(crate) struct Workbench<'a> {
    pub plan: &'a Plan,
    pub scene: &'a Scene,
    pub bounds: &'a SceneBounds,
    pub truth: &'a Truth,
    pub ladder: &'a Ladder,
    pub reference: &'a Reference<'a>,
    /// The truth that every case is compared with, unless it is this one.
    pub common: Option<&'a Reference<'a>>,
    /// The truths that all replicates but a pair each make, where scores are to have intervals.
    pub without: Option<&'a [Reference<'a>]>,
    /// Where bounds that are not kept are to have evidence.
    pub witness: Option<&'a Witness<'a>>,
}

impl Workbench<'_> {
    /// What filters are measured by: the best that the frame allows, and averages of sub-frames.
    pub fn bars(&self, frame: &Frame) -> Result<Vec<Case>, Error> {
        let oracle = scatter_oracle(frame, self.truth.shutter, &self.truth.shutter_profile);
        let oracle = oracle.cropped(frame.guard_band);
        let mut bars = vec![self.bar(frame, SCATTER_ORACLE, "", &oracle)?];
        let rungs = self.ladder.rungs.iter();
        for rung in rungs.filter(|rung| SUBFRAMES.contains(&rung.subframes)) {
            let mean = Picture::mean(&rung.halves);
            bars.push(self.bar(frame, ACCUMULATE, &rung.subframes.to_string(), &mean)?);
        }
        Ok(bars)
    }

    /// Runs a filter on a frame of this form.
    pub fn filter(
        &self,
        gpu: Option<&Gpu>,
        choice: &FilterChoice,
        input: InputFormat,
        frame: &Frame,
    ) -> Result<Case, Error> {
        let mut runner = Runner::new(gpu, choice, frame.size())?;
        let blurred = blurred(&mut runner, frame).map_err(|error| on_scene(error, self.scene))?;
        let jitter = self.jitter(&mut runner, frame)?;
        let measurement = self.measured(self.reference, &blurred)?;
        let subject = Subject {
            filter: choice.filter.name.clone(),
            preset: choice.preset.clone(),
            bar: false,
            input,
            parameters: choice.settings.values.clone(),
            command: choice.filter.command.as_ref().map(Command::words),
            nonlinearity: Some(blurred.nonlinearity),
            jitter,
            intervals: self.intervals(&blurred, &measurement)?,
        };
        self.case(frame, &blurred.picture, measurement, subject)
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

    fn bar(
        &self,
        frame: &Frame,
        name: &str,
        preset: &str,
        output: &Picture,
    ) -> Result<Case, Error> {
        let subject = Subject {
            filter: name.to_owned(),
            preset: preset.to_owned(),
            bar: true,
            ..Subject::default()
        };
        self.case(frame, output, self.reference.measure(output)?, subject)
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

    /// Writes a measured picture and its error maps.
    fn case(
        &self,
        frame: &Frame,
        output: &Picture,
        measurement: Measurement,
        subject: Subject,
    ) -> Result<Case, Error> {
        let common = match self.common {
            Some(reference) => reference.measure_moving(output)?,
            None => measurement.scores.moving.clone(),
        };
        let folder = Path::new(&self.scene.name).join(subject.folder(self.truth));
        let files = self.plan.out.join(&folder);
        write_case(&files, self.scene, &frame.objects, output, &measurement)?;
        let bounds = match subject.bar {
            true => Bounds::new(),
            false => self.bounds.of(&subject.filter, &subject.preset),
        };
        let mut verdicts = judge(&measurement.scores, subject.intervals.as_ref(), &bounds);
        let resembles = match self.witness {
            Some(witness) if verdicts.iter().any(Verdict::is_notable) => {
                for verdict in verdicts.iter_mut().filter(|verdict| verdict.is_notable()) {
                    let regions = &self.reference.regions;
                    let place = (self.plan.out.as_path(), folder.as_path());
                    let found = (output, &measurement);
                    verdict.worst = Some(witness.worst(&verdict.metric, found, regions, place)?);
                }
                witness.resemblance(self.reference, &measurement.scores)?
            }
            _ => None,
        };
        Ok(Case {
            scene: self.scene.name.clone(),
            family: self.scene.family,
            exposes: self.scene.exposes.clone(),
            exposure: frame.exposure,
            filter: subject.filter,
            preset: subject.preset,
            bar: subject.bar,
            input: subject.input,
            parameters: subject.parameters,
            command: subject.command,
            nonlinearity: subject.nonlinearity,
            alignment: self.truth.alignment.name().to_owned(),
            truth_hash: self.truth.provenance.content_hash.clone(),
            common,
            jitter: subject.jitter,
            verdicts,
            intervals: subject.intervals.unwrap_or_default(),
            resembles,
            scores: measurement.scores,
            folder,
        })
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

/// What made a picture.
#[derive(Default)]
struct Subject {
    filter: String,
    preset: String,
    bar: bool,
    input: InputFormat,
    parameters: BTreeMap<String, Value>,
    command: Option<Vec<String>>,
    nonlinearity: Option<f64>,
    jitter: Option<Jitter>,
    intervals: Option<Intervals>,
}

impl Subject {
    /// Name of the folder of its pictures. A bar may be made for several alignments.
    fn folder(&self, truth: &Truth) -> String {
        let mut parts = vec![self.filter.clone(), self.preset.clone()];
        if self.bar {
            parts.push(truth.alignment.name().to_owned());
        }
        parts.extend(self.input.change().map(|change| change.replace('=', "_")));
        parts.retain(|part| !part.is_empty());
        parts.join("_")
    }
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
