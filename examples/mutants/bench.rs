//! Bench of the mutants: scenes with their limits, and the verdicts on a filter's mutants.

use std::fs;

use cli::{Programs, select_filters, select_scenes};
use filters::{Convention, Gpu};
use frame::{Frame, Image, Region, Size, Truth, regions};
use judge::{Bounds, Level, Outcome, SceneBounds, judge_scores, read_bounds};
use measure::{Case, Error, FilterChoice, RunPlan, measure_scenes, read_finished_picture};
use metrics::Measured;
use scene::Scene;
use tempfile::TempDir;
use tests::filter_folder::{copy_changed_filter, shipped_filter};
use tracer::RenderSettings;

use crate::mutant::Mutant;

const SCENES: [&str; 5] = ["fan", "railing", "two_spheres", "roll", "crossing"];
/// Columns and rows of the pictures, those of the shipped limits.
const SIZE: Size = Size::new(160, 90);
const SAMPLES_PER_PIXEL: u32 = 64;
/// Mutants of each operator and filter, at most.
const PER_OPERATOR: usize = 6;
/// Upper limit on the seconds of a mutant's pass. A shipped one takes less than one.
const TIME_LIMIT: f64 = 5.0;
/// Preset of the filter without a change.
const UNCHANGED: &str = "unchanged";

/// A mutant, and what its pictures and the limits show.
#[derive(Default)]
pub struct Verdict {
    pub operator: &'static str,
    pub description: String,
    /// False if the kernel does not end or leaves pixels unwritten: `check` fails without any
    /// limit.
    pub has_picture: bool,
    /// Largest change of a picture, in noise floors of the truth; 0 if all are equal.
    pub change: f64,
    /// Scene with the largest change.
    pub scene: String,
    /// Squared error over what moves there, divided by the unchanged filter's.
    pub error: f64,
    /// True if a required limit broke.
    pub is_killed: bool,
}

pub struct Bench {
    scenes: Vec<(Scene, SceneBounds)>,
    render: RenderSettings,
    gpu: Gpu,
    folder: TempDir,
}

impl Bench {
    pub fn open() -> Result<Self, Error> {
        let scenes = select_scenes(tests::scenes(), &SCENES.map(str::to_owned))?.into_iter();
        let with_bounds = scenes.map(|choice| {
            let bounds = read_bounds(tests::scenes(), &choice.folder, Some(SIZE))?;
            Ok((choice.scene, bounds.at(SIZE)))
        });
        Ok(Self {
            scenes: with_bounds.collect::<Result<_, Error>>()?,
            render: tests::settings(SIZE.into(), SAMPLES_PER_PIXEL),
            gpu: tests::open_gpu(),
            folder: tempfile::tempdir().expect("temporary folders can be made"),
        })
    }

    /// Judges the mutants of a preset that naga accepts.
    pub fn judge_mutants(&mut self, filter: &str, preset: &str) -> Result<Vec<Verdict>, Error> {
        let path = shipped_filter(filter).join(filter).with_extension("wgsl");
        let kernels = fs::read_to_string(path).expect("a shipped filter can be read");
        let mut filters = vec![select(filter, preset, UNCHANGED)?];
        let mut verdicts = Vec::new();
        for mutant in Mutant::choose(&kernels, PER_OPERATOR) {
            let name = preset_of(verdicts.len());
            let copy = self.folder.path().join(&name).join(filter);
            copy_changed_filter(filter, &copy, |text| mutant.apply(text));
            if let Ok(mut choice) = select(&copy.display().to_string(), preset, &name) {
                choice.filter.time_limit = TIME_LIMIT;
                filters.push(choice);
                verdicts.push(Verdict {
                    operator: mutant.operator,
                    description: mutant.describe(&kernels),
                    has_picture: true,
                    ..Verdict::default()
                });
            }
        }
        for (scene, bounds) in self.scenes.clone() {
            eprintln!("{filter} on {}: {} mutants", scene.id, filters.len() - 1);
            let limits = bounds.of(filter, preset);
            let cases = self.measure(&scene, &filters)?;
            let folder = self.folder.path().join("out").join(scene.id.to_string());
            let truth = format!("truth_{}.exr", filters[0].filter.alignment);
            let truth = Truth::read(&folder.join(truth))?;
            self.judge(&cases, &limits, &truth, &mut verdicts)?;
            // A filter without a picture is not tried again.
            filters.retain(|choice| cases.iter().any(|case| case.preset == choice.preset));
        }
        Ok(verdicts)
    }

    /// Measures filters on a scene as `check` does. A kernel without an end stops all; then each
    /// half of the filters runs alone.
    fn measure(&mut self, scene: &Scene, filters: &[FilterChoice]) -> Result<Vec<Case>, Error> {
        let plan = RunPlan {
            scenes: vec![scene.clone()],
            filters: filters.to_vec(),
            render: self.render,
            out: self.folder.path().join("out"),
            intervals: true,
            // Equivalent sub-frames are not limited.
            ladders: false,
            ..RunPlan::default()
        };
        match measure_scenes(&plan, Some(&self.gpu), Vec::new()) {
            Ok(run) => Ok(run.cases),
            Err(Error::Filter(_)) => {
                // The adapter is still busy with the kernel.
                self.gpu = tests::open_gpu();
                if filters.len() == 1 {
                    return Ok(Vec::new());
                }
                let (left, right) = filters.split_at(filters.len() / 2);
                Ok([self.measure(scene, left)?, self.measure(scene, right)?].concat())
            }
            Err(error) => Err(error),
        }
    }

    /// Adds a scene's cases to the verdicts.
    fn judge(
        &self,
        cases: &[Case],
        limits: &Bounds,
        truth: &Truth,
        verdicts: &mut [Verdict],
    ) -> Result<(), Error> {
        let read_picture = |case: &Case| -> Result<Image, Error> {
            let folder = self.folder.path().join("out").join(&case.folder);
            let frame = Frame::read(&folder.with_file_name("frame.exr"))?;
            let path = folder.join("output.exr");
            Ok(read_finished_picture(&path, &Convention::default(), &frame, truth)?.color)
        };
        let find = |preset: &str| cases.iter().find(|case| case.preset == preset);
        let sound = find(UNCHANGED).expect("the unchanged filter was measured");
        assert!(!breaks(sound, limits), "no limit breaks without a change");
        let sound_picture = read_picture(sound)?;
        for (number, verdict) in verdicts.iter_mut().enumerate() {
            let Some(case) = find(&preset_of(number)) else {
                verdict.has_picture = false;
                continue;
            };
            verdict.is_killed |= breaks(case, limits);
            let change = measure_change(&sound_picture, &read_picture(case)?, truth);
            if change > verdict.change {
                verdict.change = change;
                verdict.scene = case.scene.to_string();
                verdict.error = squared_error(case) / squared_error(sound);
            }
        }
        Ok(())
    }
}

/// Loads a filter's preset, and gives the preset another name.
fn select(filter: &str, preset: &str, name: &str) -> Result<FilterChoice, Error> {
    let selected = format!("{filter}:{preset}");
    let mut choices = select_filters(&[selected], None, &[], Programs::Refused)?;
    name.clone_into(&mut choices[0].preset);
    Ok(choices.remove(0))
}

fn preset_of(mutant: usize) -> String {
    format!("mutant_{mutant}")
}

fn breaks(case: &Case, limits: &Bounds) -> bool {
    let judged = judge_scores(&case.scores, Some(&case.intervals), limits);
    (judged.iter())
        .any(|score| score.outcome == Outcome::Broken && score.bound.level == Level::Required)
}

fn squared_error(case: &Case) -> f64 {
    let metric = "mse_moving".parse().expect("it is a metric");
    match case.scores.get(metric) {
        Measured::Score(score) => score.value,
        Measured::NotApplicable { .. } => f64::NAN,
    }
}

/// Measures the difference of two pictures: root mean square over what moves or over all, in noise
/// floors of the truth there.
fn measure_change(a: &Image, b: &Image, truth: &Truth) -> f64 {
    let squares = a.zip(b, |a, b| {
        let square = |c: usize| (f64::from(a[c]) - f64::from(b[c])).powi(2);
        (square(0) + square(1) + square(2)) / 3.0
    });
    let regions = regions(truth);
    let mut largest: f64 = 0.0;
    for (region, floor) in truth.noise_floors() {
        if [Region::Moving, Region::Full].contains(&region) {
            let inside = regions.select(region, &squares);
            let mean = inside.iter().sum::<f64>() / inside.len() as f64;
            largest = largest.max(mean.sqrt() / floor);
        }
    }
    largest
}
