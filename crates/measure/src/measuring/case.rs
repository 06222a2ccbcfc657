//! Measurement of one case.

use std::collections::BTreeMap;

use filters::{Convention, FilterError};
use frame::{Accumulation, Frame, Ladder, Picture, Size, Vectors};
use metrics::{
    ColorReference, ImageScores, Jitter, MeasureError, Measurement, Metric, ProbeScores, Reference,
    Smear, measure_smear,
};
use tracer::Defocus;

use super::dilated_velocity::read_dilated_velocity;
use super::pictures::{PARTS_FILE, write_case, write_parts};
use super::planned_case::{PictureSource, PlannedCase};
use super::probes::{
    FilterOutput, FilteredFrame, Runners, blur_noise_frames, blur_picture, blur_with_probes,
};
use super::references::TruthReferences;
use super::scene::SceneContext;
use super::stored_frames::StoredFrame;
use crate::Error;
use crate::filter_choice::FilterChoice;
use crate::identity::ReferencePicture;
use crate::inputs::depth_of_field::DepthOfField;
use crate::inputs::input_format::InputFormat;
use crate::render::exclusion::FilterFrame;
use crate::render::ingested_scene::{IngestedScene, NO_VELOCITY};
use crate::render::run_scene::RunScene;
use crate::run::case::{Case, Intervals};
use crate::runner::Runner;
use crate::stats::intervals::intervals;

/// Upper limit on the difference between the blur of a mixture and the mixture of the blurs,
/// relative to the blur's change; far above rounding.
const MAX_NONLINEARITY: f64 = 1e-3;

const NO_MATTES: &str =
    "an engine's picture does not say which share of a pixel it gives to each object";
const OTHER_SHUTTER: &str = "the engine drew no truth of the run's common shutter";

/// Everything needed to measure the cases of one scene and one shutter.
pub(crate) struct CaseContext<'a> {
    pub scene: &'a SceneContext<'a>,
    pub frame: &'a Frame,
    /// The frame without its guard band.
    pub cropped: &'a Frame,
    /// The frame in the forms that filters get.
    pub stored_frames: &'a [StoredFrame],
    /// Pass after filters that run before depth of field; none if no case has one.
    pub depth_of_field: Option<&'a Defocus>,
    pub references: &'a TruthReferences<'a>,
    /// Reads the rung of a number of sub-frames, as a ladder of one rung.
    pub read_rung: &'a dyn Fn(u32) -> Result<Ladder, Error>,
    /// Truth that every case is compared with.
    pub common: CommonTruth<'a>,
}

/// The truth of a run's common shutter, which all cases are compared with.
#[derive(Clone, Copy)]
pub(crate) enum CommonTruth<'a> {
    /// The case's own truth.
    Own,
    /// Another one.
    Other(&'a ColorReference),
    /// None: an engine drew only another shutter.
    Missing,
}

/// A picture with its measurements.
struct MeasuredPicture {
    picture: Picture,
    measurement: Measurement,
    nonlinearity: Option<f64>,
    jitter: Option<Jitter>,
    smear: Option<Smear>,
    intervals: Intervals,
    dilated_velocity: Option<Vectors>,
    /// Pictures of parts of the frame's replicates.
    parts: Vec<Picture>,
}

impl MeasuredPicture {
    /// Joins a picture that none of our filters made with its measurement.
    fn new(picture: Picture, measurement: Measurement) -> Self {
        Self {
            picture,
            measurement,
            nonlinearity: None,
            jitter: None,
            smear: None,
            intervals: Intervals::new(),
            dilated_velocity: None,
            parts: Vec::new(),
        }
    }
}

impl CaseContext<'_> {
    /// Makes the picture, measures it, and writes it with its error maps; also returns the files'
    /// names.
    pub fn measure(&self, planned: &PlannedCase) -> Result<(Case, Vec<String>), Error> {
        let measured = match &planned.source {
            PictureSource::Reference(ReferencePicture::Identity) => {
                self.measure_reference(self.cropped.picture())?
            }
            PictureSource::Reference(ReferencePicture::ScatterOracle) => {
                self.measure_reference(self.references.oracle.clone())?
            }
            PictureSource::Reference(ReferencePicture::Accumulation(subframes)) => {
                self.measure_accumulation(&(self.read_rung)(*subframes)?.rungs[0])?
            }
            PictureSource::Filter(choice, input) => self.measure_filter(choice, *input)?,
            PictureSource::Engine(scene) => self.measure_engine(scene)?,
        };
        self.write(planned, self.without_motion(measured))
    }

    /// Takes out the scores of objects' motion, and the smear, if an engine did not hand it over.
    fn without_motion(&self, mut measured: MeasuredPicture) -> MeasuredPicture {
        if self.scene.scene.lacks_velocity() {
            measured.measurement.scores.take_out_motion(NO_VELOCITY);
            measured.smear = None;
        }
        measured
    }

    fn measure_reference(&self, picture: Picture) -> Result<MeasuredPicture, Error> {
        let measurement = self.references.reference.measure(&picture)?;
        Ok(MeasuredPicture::new(picture, measurement))
    }

    fn measure_accumulation(&self, rung: &Accumulation) -> Result<MeasuredPicture, Error> {
        let picture = rung.picture(&self.references.truth.mean());
        let measurement = self.references.reference.measure_accumulation(rung)?;
        Ok(MeasuredPicture::new(picture, measurement))
    }

    /// Measures the engine's own picture. Its scores have no intervals: an engine's sub-frames are
    /// no random samples.
    fn measure_engine(&self, scene: &IngestedScene) -> Result<MeasuredPicture, Error> {
        let picture = scene.read_picture(self.frame)?;
        let mut measurement = self.references.reference.measure(&picture)?;
        measurement.scores.take_out_mattes(NO_MATTES);
        Ok(MeasuredPicture {
            smear: measure_smear(self.cropped, &picture.color),
            ..MeasuredPicture::new(picture, measurement)
        })
    }

    fn measure_filter(
        &self,
        choice: &FilterChoice,
        input: InputFormat,
    ) -> Result<MeasuredPicture, Error> {
        let mut stored = self.stored_frames.iter();
        let stored = stored.find(|stored| stored.format == input);
        let stored = stored.expect("the frame was stored in every form of the plan");
        let frame = &stored.frame;
        let picture = self.picture_size();
        let mut runners = Runners::new(self.scene.gpu, choice, frame.size())?;
        let pass = self.pass_behind(input);
        let (output, parts) = self
            .blur_stored(stored, &mut runners, pass)
            .map_err(|error| name_scene(error, self.scene.scene))?;
        // A smaller one would not fit into the output's file.
        let dilated_velocity = if input.scale.blurred_size(picture) == picture {
            read_dilated_velocity(&choice.filter, &runners.color, frame)?
        } else {
            None
        };
        let jitter = self.measure_jitter(&mut runners.color, frame, pass)?;
        let (measurement, intervals) = self.measure_with_intervals(&parts, &output.picture, {
            |reference, picture| measure_output(reference, picture, &output)
        })?;
        Ok(MeasuredPicture {
            smear: measure_smear(self.cropped, &output.picture.color),
            intervals,
            nonlinearity: Some(output.nonlinearity),
            picture: output.picture,
            measurement,
            jitter,
            dilated_velocity,
            parts,
        })
    }

    /// Runs the filter on a stored frame, and on each part of its replicates.
    fn blur_stored(
        &self,
        stored: &StoredFrame,
        runners: &mut Runners,
        pass: Option<&Defocus>,
    ) -> Result<(FilterOutput, Vec<Picture>), FilterError> {
        // The first frame has no previous one; it serves as its own.
        let (before, parts_before) = match &stored.before {
            Some(before) => (before, &stored.parts_before),
            None => (&stored.frame, &stored.parts),
        };
        let filtered = FilteredFrame {
            now: &stored.frame,
            before,
            index: self.scene.scene.id().frame,
        };
        let size = self.picture_size();
        let defocused = |picture: Picture| match pass {
            Some(pass) => pass.apply(&picture),
            None => picture,
        };
        let mut output = blur_with_probes(runners, filtered, size)?;
        output.picture = defocused(output.picture);
        let parts = (stored.parts.iter().zip(parts_before))
            .map(|(part, part_before)| {
                let blurred = blur_picture(runners, filtered, [part, part_before], size)?;
                Ok(defocused(blurred))
            })
            .collect::<Result<_, FilterError>>()?;
        Ok((output, parts))
    }

    /// Returns the pass between a filter's output and its measurement; none if the filter comes
    /// last.
    fn pass_behind(&self, input: InputFormat) -> Option<&Defocus> {
        (self.depth_of_field).filter(|_| input.depth_of_field == DepthOfField::After)
    }

    /// Returns the size of the picture.
    fn picture_size(&self) -> Size {
        self.references.truth.size()
    }

    /// Measures a picture, with score intervals from the pictures of `parts` of the frame's
    /// replicates if requested. The counts of equivalent sub-frames have theirs wherever there are
    /// parts.
    fn measure_with_intervals(
        &self,
        parts: &[Picture],
        whole: &Picture,
        measure: impl Fn(&Reference, &Picture) -> Result<Measurement, MeasureError>,
    ) -> Result<(Measurement, Intervals), MeasureError> {
        let reference = &self.references.reference;
        let parts = || self.references.parts.iter().zip(parts);
        let mut measurement = measure(reference, whole)?;
        let scores = &mut measurement.scores;
        if !reference.curves().is_empty() {
            let errors = parts().map(|(reference, part)| {
                let errors = reference.measure_errors(part)?;
                Ok(errors.map(|errors| (reference, errors)))
            });
            let errors: Result<Option<Vec<_>>, MeasureError> = errors.collect();
            let errors = errors?.unwrap_or_default();
            scores.equivalent_subframes = reference.count_subframes(scores, &errors);
        }
        if !self.scene.plan.intervals {
            return Ok((measurement, Intervals::new()));
        }
        let of_parts = parts()
            .map(|(reference, part)| Ok(measure(reference, part)?.scores))
            .collect::<Result<Vec<_>, MeasureError>>()?;
        let intervals = match &self.references.still {
            None => Intervals::new(),
            Some(still) => intervals(scores, &of_parts, still, Metric::all()),
        };
        Ok((measurement, intervals))
    }

    /// Separates the filter's noise from its other errors; none without noise, or for too few
    /// frames.
    fn measure_jitter(
        &self,
        runner: &mut Runner,
        frame: &FilterFrame,
        pass: Option<&Defocus>,
    ) -> Result<Option<Jitter>, Error> {
        if self.scene.plan.jitter_frames < 2 {
            return Ok(None);
        }
        let frames = self.scene.plan.jitter_frames;
        let outputs = blur_noise_frames(runner, frame, frames, self.picture_size())
            .map_err(|error| name_scene(error, self.scene.scene))?;
        let outputs = outputs.map(|outputs| match pass {
            None => outputs,
            Some(pass) => outputs
                .iter()
                .map(|output| pass.apply_to_color(output))
                .collect(),
        });
        Ok(outputs
            .filter(|outputs| outputs[1..].iter().any(|output| *output != outputs[0]))
            .and_then(|outputs| self.references.reference.jitter(&outputs)))
    }

    /// Writes the pictures of a case, and gathers its data.
    fn write(
        &self,
        planned: &PlannedCase,
        measured: MeasuredPicture,
    ) -> Result<(Case, Vec<String>), Error> {
        let MeasuredPicture {
            picture,
            measurement,
            ..
        } = &measured;
        let common = match self.common {
            CommonTruth::Other(reference) => reference.measure(picture)?,
            CommonTruth::Own => measurement.scores.moving.clone(),
            CommonTruth::Missing => ImageScores::not_applicable(OTHER_SHUTTER),
        };
        let folder = planned.id.folder();
        let path = self.scene.plan.out.join(&folder);
        let mut files = write_case(
            &path,
            self.frame,
            picture,
            measured.dilated_velocity.as_ref(),
            measurement,
        )?;
        let plan = self.scene.plan;
        if plan.intervals && !plan.frames.is_one() && !measured.parts.is_empty() {
            write_parts(&path, &measured.parts)?;
            files.push(PARTS_FILE.to_owned());
        }
        let choice = match &planned.source {
            PictureSource::Filter(choice, _) => Some(choice),
            _ => None,
        };
        let command = choice.and_then(|choice| choice.filter.command.as_ref());
        let convention = choice.map(|choice| choice.filter.convention);
        let convention = convention.filter(|convention| *convention != Convention::default());
        let truth = self.references.truth;
        let (family, exposes) = self.scene.scene.describe();
        let case = Case {
            id: planned.id.clone(),
            family,
            exposes,
            drawn: self.scene.scene.drawn(),
            rate: self.scene.scene.id().rate,
            exposure: self.frame.exposure,
            parameters: choice.map_or_else(BTreeMap::new, |choice| choice.settings.values.clone()),
            reference_width: choice.and_then(|choice| choice.settings.reference_width),
            command: command.map(|command| command.words.clone()),
            convention: convention.map(Convention::resolved),
            nonlinearity: measured.nonlinearity,
            truth_hash: truth.provenance.content_hash.clone(),
            common,
            jitter: measured.jitter,
            intervals: measured.intervals,
            scores: measured.measurement.scores,
            smear: measured.smear,
            folder,
        };
        Ok((case, files))
    }
}

/// Measures a filter's picture of a frame or of a part of its replicates, and its probes, which
/// have no noise.
fn measure_output(
    reference: &Reference,
    picture: &Picture,
    output: &FilterOutput,
) -> Result<Measurement, MeasureError> {
    let mut measurement = reference.measure(picture)?;
    add_probes(reference, output, &mut measurement);
    Ok(measurement)
}

/// Adds the scores of probes, or removes those that need a filter with weights independent of
/// colour.
fn add_probes(reference: &Reference, output: &FilterOutput, measurement: &mut Measurement) {
    let scores = &mut measurement.scores;
    if output.nonlinearity > MAX_NONLINEARITY {
        let cause = if output.is_rounded {
            "the filter writes 16-bit floats, and their rounding hides what it gathers; let it write 32-bit floats"
        } else {
            "the filter's weights depend on colour"
        };
        let reason = format!(
            "{cause}: the blur of a mixture differs from the mixture of the blurs by {:.4} of what the blur changes; \
             allowed: at most {MAX_NONLINEARITY}",
            output.nonlinearity
        );
        scores.take_out_mattes(&reason);
        scores.probes = ProbeScores::not_applicable(&reason);
        return;
    }
    let probed = reference.measure_probes(&output.probes);
    scores.probes = probed.scores;
    measurement.probes = Some(probed.maps);
}

/// Adds the scene to a program's error, since the program may fail on only some scenes.
fn name_scene(error: FilterError, scene: RunScene) -> FilterError {
    match error {
        FilterError::Command { filter, reason } => FilterError::Command {
            filter: format!("{filter} on {}", scene.id()),
            reason,
        },
        other => other,
    }
}
