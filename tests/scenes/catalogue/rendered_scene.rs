//! Small renders of a scene of the catalogue, with the outputs and scores of filters.

use std::cell::{OnceCell, RefCell};
use std::collections::BTreeMap;

use filters::{Blur, Filter};
use frame::{Alignment, Frame, Image, Picture, Size, Truth};
use metrics::{Metric, Reference, Scores, scatter_oracle};
use scene::Scene;
use tests::picture::frame_input;
use tests::{shared_gpu, unwatched};
use tracer::{RenderSettings, trace_frame, trace_truth};

use crate::load_shipped;

/// Settings of a small frame and its truths. A truth's two replicates together have as many samples
/// as the frame.
pub fn small_settings() -> RenderSettings {
    tests::settings_of([160, 90], 32, 2)
}

/// Name of the reference that knows what each object does.
const ORACLE: &str = "scatter_oracle";

/// Frame of a scene, and truths that are rendered when needed.
pub struct RenderedScene {
    pub frame: Frame,
    scene: Scene,
    settings: RenderSettings,
    truths: [OnceCell<Truth>; 2],
    /// Scores of filters that were asked for, by filter.
    scores: RefCell<BTreeMap<String, Scores>>,
}

impl RenderedScene {
    /// Renders `scene` or `scene@variant`.
    pub fn new(name: &str) -> Self {
        Self::with_settings(name, small_settings())
    }

    pub fn with_settings(name: &str, settings: RenderSettings) -> Self {
        let scene = load_shipped(name);
        Self {
            frame: trace_frame(&scene, &settings, &unwatched).unwrap(),
            scene,
            settings,
            truths: Default::default(),
            scores: Default::default(),
        }
    }

    /// Returns the truth of an alignment, trailing or centred; renders it the first time.
    pub fn truth(&self, alignment: Alignment) -> &Truth {
        let index = match alignment {
            Alignment::Trailing => 0,
            Alignment::Centred => 1,
            Alignment::Leading => panic!("no filter's shutter leads"),
        };
        self.truths[index].get_or_init(|| {
            trace_truth(&self.scene, &self.settings, alignment, &unwatched).unwrap()
        })
    }

    /// Blurs colour and mattes with a filter, `name:preset`.
    pub fn blur(&self, filter: &str) -> Picture {
        let mattes: Vec<Image> = (self.frame.coverage.iter())
            .map(|matte| matte.map(|part| [*part; 3]))
            .collect();
        let colors: Vec<&Image> = [&self.frame.color].into_iter().chain(&mattes).collect();
        let (filter, preset) = find_preset(filter);
        let mut outputs = self.run_filter(&filter, &preset, &colors).into_iter();
        Picture {
            color: outputs.next().expect("an output per colour"),
            coverage: outputs.map(|matte| matte.map(|pixel| pixel[0])).collect(),
        }
    }

    /// Runs a filter on colours in place of the frame's own, and crops the guard band.
    pub fn run_filter(&self, filter: &Filter, preset: &str, colors: &[&Image]) -> Vec<Image> {
        let settings = filter.settings(Some(preset)).unwrap();
        let Size { width, height } = self.frame.size();
        let mut blur = Blur::new(shared_gpu(), filter, &settings, width, height).unwrap();
        let outputs = blur.run(&frame_input(&self.frame, colors)).unwrap();
        let cropped = |output: &Image| output.cropped(self.frame.guard_band);
        outputs.iter().map(cropped).collect()
    }

    /// Scores a picture against the truth of an alignment.
    pub fn measure(&self, picture: &Picture, alignment: Alignment) -> Scores {
        let frame = self.frame.cropped();
        let (truth, viewing) = (self.truth(alignment), self.scene.display.into());
        let reference = Reference::new(&frame, truth, None, &viewing).unwrap();
        reference.measure(picture).unwrap().scores
    }

    /// Scores a filter, or the reference `scatter_oracle`, against the truth of its shutter, once.
    fn measure_filter(&self, filter: &str) -> Scores {
        if let Some(scores) = self.scores.borrow().get(filter) {
            return scores.clone();
        }
        let alignment = alignment_of(filter);
        let picture = if filter == ORACLE {
            let truth = self.truth(alignment);
            scatter_oracle(&self.frame, truth.shutter, &truth.shutter_profile)
        } else {
            self.blur(filter)
        };
        let scores = self.measure(&picture, alignment);
        let mut measured = self.scores.borrow_mut();
        measured.insert(filter.to_owned(), scores.clone());
        scores
    }

    /// Returns a score of a filter, or of the reference `scatter_oracle`, against the truth of its
    /// shutter: a metric, `object.metric`, or `left:metric`, the metric relative to the identity's.
    pub fn score(&self, filter: &str, score: &str) -> f64 {
        let scores = self.measure_filter(filter);
        if let Some(metric) = score.strip_prefix("left:") {
            let identity = self.frame.cropped().picture();
            let nothing = self.measure(&identity, alignment_of(filter));
            return value(&scores, metric) / value(&nothing, metric);
        }
        let Some((object, metric)) = score.split_once('.') else {
            return value(&scores, score);
        };
        let object_scores = scores.objects.iter().find(|scores| scores.object == object);
        let object_scores = object_scores.unwrap_or_else(|| panic!("there is no object {object}"));
        let score = match metric {
            "label_tv" => &object_scores.label_total_variation,
            "deficit" => &object_scores.deficit,
            "row_gain" => &object_scores.row_gain,
            other => panic!("{other} is asked of no object here"),
        };
        let number = score.value();
        number.unwrap_or_else(|| panic!("{metric} of {object}: {score:?}"))
    }

    /// Returns the mean squared error of a filter's radiance over the pixels that count, unbiased
    /// since the truth's halves are independent.
    pub fn squared_error(&self, filter: &str, counts: impl Fn(u32, u32) -> bool) -> f64 {
        let output = self.blur(filter).color;
        let [a, b] = &self.truth(find_preset(filter).0.alignment).halves;
        let all = (0..output.height).flat_map(|y| (0..output.width).map(move |x| (x, y)));
        let pixels: Vec<(u32, u32)> = all.filter(|(x, y)| counts(*x, *y)).collect();
        assert!(!pixels.is_empty(), "some pixels count");
        let error = |(x, y): &(u32, u32)| {
            let [output, a, b] = [&output, &a.color, &b.color].map(|image| image.at(*x, *y));
            let product = |c: usize| f64::from((output[c] - a[c]) * (output[c] - b[c]));
            (product(0) + product(1) + product(2)) / 3.0
        };
        pixels.iter().map(error).sum::<f64>() / pixels.len() as f64
    }
}

/// Returns a metric's value; fails the test if it does not apply.
pub fn value(scores: &Scores, metric: &str) -> f64 {
    let parsed: Metric = metric.parse().unwrap();
    let measured = scores.get(parsed);
    let value = measured.value();
    value.unwrap_or_else(|| panic!("{metric} does not apply: {measured:?}"))
}

/// Returns the alignment of the shutter that a filter or the oracle shows.
fn alignment_of(filter: &str) -> Alignment {
    if filter == ORACLE {
        Alignment::Centred
    } else {
        find_preset(filter).0.alignment
    }
}

/// Finds a built-in filter, and returns it with the preset's name.
pub fn find_preset(filter: &str) -> (Filter, String) {
    let (name, preset) = filter.split_once(':').expect("name:preset");
    (Filter::builtin(name).unwrap(), preset.to_owned())
}
