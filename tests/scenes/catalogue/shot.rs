//! A scene of the catalogue, small: what filters make of it, and what that scores.

use std::cell::OnceCell;
use std::path::Path;

use filters::{Blur, Filter, Gpu, Input};
use frame::{Alignment, Frame, Image, Picture, Truth};
use metrics::{Metric, Reference, Scores};
use tests::unwatched;
use tracer::{FrameSettings, Scene, TruthSettings, load_scene, trace_frame, trace_truth};

/// How a shot is taken.
#[derive(Clone, Copy)]
pub struct Take {
    pub width: u32,
    pub height: u32,
    /// Of the frame, and of the truth over its two replicates.
    pub samples_per_pixel: u32,
    pub sky_velocity: bool,
    /// Pixels by which the frame reaches beyond the picture on every side.
    pub guard_band: u32,
}

impl Default for Take {
    fn default() -> Self {
        Self {
            width: 160,
            height: 90,
            samples_per_pixel: 32,
            sky_velocity: true,
            guard_band: 0,
        }
    }
}

/// A frame, and the truths that were asked for.
pub struct Shot {
    pub frame: Frame,
    scene: Scene,
    take: Take,
    gpu: Gpu,
    truths: [OnceCell<Truth>; 2],
}

impl Shot {
    /// Of `scene` or `scene@variant`.
    pub fn of(name: &str) -> Self {
        Self::taken(name, Take::default())
    }

    pub fn taken(name: &str, take: Take) -> Self {
        let (name, variant) = match name.split_once('@') {
            Some((name, variant)) => (name, Some(variant)),
            None => (name, None),
        };
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../scenes")
            .join(name);
        let scene = load_scene(&folder, variant).unwrap_or_else(|error| panic!("{error}"));
        let settings = FrameSettings {
            width: take.width,
            height: take.height,
            exposure: scene.exposure,
            sky_velocity: take.sky_velocity,
            guard_band: take.guard_band,
            samples_per_pixel: take.samples_per_pixel,
            ..FrameSettings::default()
        };
        Self {
            frame: trace_frame(&scene, &settings, &unwatched).unwrap(),
            scene,
            take,
            gpu: Gpu::new(None).expect("these tests run filters"),
            truths: Default::default(),
        }
    }

    /// Over the shutter of an alignment, trailing or centred.
    pub fn truth(&self, alignment: Alignment) -> &Truth {
        let place = match alignment {
            Alignment::Trailing => 0,
            Alignment::Centred => 1,
            Alignment::Leading => panic!("no filter's shutter leads"),
        };
        self.truths[place].get_or_init(|| {
            let settings = TruthSettings {
                width: self.take.width,
                height: self.take.height,
                exposure: self.scene.exposure,
                alignment,
                samples_per_pixel: self.take.samples_per_pixel,
                replicates: 2,
                seed: 1,
            };
            trace_truth(&self.scene, &settings, &unwatched).unwrap()
        })
    }

    /// What a filter, `name:preset`, makes of colour and mattes.
    pub fn blurred(&self, filter: &str) -> Picture {
        let mattes: Vec<Image> = (self.frame.coverage.iter())
            .map(|matte| matte.map(|part| [*part; 3]))
            .collect();
        let colors: Vec<&Image> = [&self.frame.color].into_iter().chain(&mattes).collect();
        let (filter, preset) = chosen(filter);
        let mut outputs = self.run(&filter, &preset, &colors).into_iter();
        Picture {
            color: outputs.next().expect("an output per colour"),
            coverage: outputs.map(|matte| matte.map(|pixel| pixel[0])).collect(),
        }
    }

    /// What a filter makes of these colours in the place of the frame's own, without the guard band.
    pub fn run(&self, filter: &Filter, preset: &str, colors: &[&Image]) -> Vec<Image> {
        let settings = filter.settings(Some(preset)).unwrap();
        let (width, height) = self.frame.size();
        let mut blur = Blur::new(&self.gpu, filter, &settings, width, height).unwrap();
        let input = Input {
            color: colors,
            velocity: &self.frame.velocity,
            depth: &self.frame.depth,
            reprojection: Some(
                self.frame
                    .reprojection
                    .moved(f64::from(self.take.guard_band)),
            ),
            exposure: self.frame.exposure,
            frame_index: 0,
        };
        let outputs = blur.run(&input).unwrap();
        outputs
            .iter()
            .map(|output| output.cropped(self.take.guard_band))
            .collect()
    }

    pub fn measured(&self, picture: &Picture, alignment: Alignment) -> Scores {
        let truth = self.truth(alignment);
        let viewing = suite::viewing(&self.scene);
        let frame = self.frame.cropped();
        let reference = Reference::new(&frame, truth, None, &viewing).unwrap();
        reference.measure(picture).unwrap().scores
    }

    /// A filter's scores against the shutter that it declares.
    pub fn scores(&self, filter: &str) -> Scores {
        let alignment = chosen(filter).0.alignment;
        self.measured(&self.blurred(filter), alignment)
    }

    /// One of them.
    pub fn score(&self, filter: &str, metric: &str) -> f64 {
        value(&self.scores(filter), metric)
    }

    /// The part of the error of doing nothing that a filter leaves, against the shutter that it declares.
    pub fn left_by(&self, filter: &str, metric: &str) -> f64 {
        let frame = self.frame.cropped();
        let nothing = Picture {
            color: frame.color,
            coverage: frame.coverage,
        };
        let nothing = self.measured(&nothing, chosen(filter).0.alignment);
        self.score(filter, metric) / value(&nothing, metric)
    }

    /// How much of an object a filter gives to others, against the shutter that it declares.
    pub fn object_label_tv(&self, filter: &str, object: &str) -> f64 {
        let scores = self.scores(filter);
        let found = scores.objects.iter().find(|scores| scores.object == object);
        let found = found.unwrap_or_else(|| panic!("there is no object {object}"));
        found.label_total_variation.value().expect("it is seen")
    }

    /// Mean over the pixels that `weight` counts of the unbiased squared error of a filter's colour, in radiance: the
    /// truth's halves are independent.
    pub fn error_over(&self, filter: &str, weight: impl Fn(u32, u32) -> f64) -> f64 {
        let output = self.blurred(filter).color;
        let [a, b] = &self.truth(chosen(filter).0.alignment).halves;
        let (mut sum, mut total) = (0.0, 0.0);
        for y in 0..output.height {
            for x in 0..output.width {
                let [output, a, b] = [&output, &a.color, &b.color].map(|image| image.at(x, y));
                let product = |c: usize| f64::from((output[c] - a[c]) * (output[c] - b[c]));
                let weight = weight(x, y);
                sum += weight * (product(0) + product(1) + product(2)) / 3.0;
                total += weight;
            }
        }
        assert!(total > 0.0, "some pixels count");
        sum / total
    }
}

/// A metric's value; the test fails where it does not apply.
pub fn value(scores: &Scores, metric: &str) -> f64 {
    let parsed: Metric = metric.parse().unwrap();
    let found = scores.get(parsed);
    found
        .value()
        .unwrap_or_else(|| panic!("{metric} does not apply: {found:?}"))
}

/// A built-in filter and the preset's name.
pub fn chosen(filter: &str) -> (Filter, String) {
    let (name, preset) = filter.split_once(':').expect("name:preset");
    (Filter::builtin(name).unwrap(), preset.to_owned())
}
