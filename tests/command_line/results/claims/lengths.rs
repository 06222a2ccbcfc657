//! Settings of the length of smears, and shutters that engines state.

use super::{HALF_FRAME, Preset, numbers, read, shipped};
use crate::results::engines::{Engine, list_engines};

/// An engine's setting of length, with the words that pages have for its value.
pub struct Setting {
    shape: &'static str,
    parameter: &'static str,
    /// Value that the engine ships.
    pub shipped: f64,
    /// Words for its value at some exposure, and that value in parts of the exposure.
    words: (&'static str, f64),
    /// Words of the preset for its value at 180 degrees.
    at_180: (&'static str, f64),
}

const SETTINGS: [Setting; 6] = [
    Setting {
        shape: "camera_gather:armory",
        parameter: "intensity",
        shipped: 1.0,
        words: ("The intensity is 2.5 times the exposure", 2.5),
        at_180: ("an intensity of 1.25 for 180 degrees instead of 1.", 1.25),
    },
    Setting {
        shape: "jimenez:o3de",
        parameter: "strength",
        shipped: 5.0,
        words: ("with a strength of half the exposure", 0.5),
        at_180: ("a strength of 0.25 for 180 degrees instead of 5;", 0.25),
    },
    Setting {
        shape: "jimenez:wicked",
        parameter: "strength",
        shipped: 100.0,
        words: ("with a strength of 128 times the exposure", 128.0),
        at_180: ("a strength of 64 for 180 degrees instead of 100.", 64.0),
    },
    Setting {
        shape: "jimenez:kajiya",
        parameter: "strength",
        shipped: 1.0,
        words: (
            "with a motion_blur_scale of 16/7 of the exposure",
            16.0 / 7.0,
        ),
        at_180: (
            "a motion_blur_scale of 8/7 for 180 degrees instead of 1:",
            8.0 / 7.0,
        ),
    },
    Setting {
        shape: "realism_effects:default",
        parameter: "",
        shipped: 1.0,
        words: ("with an intensity of the exposure over 0.6", 1.0 / 0.6),
        at_180: (
            "an intensity of 5/6 for 180 degrees at 60 frames per second instead of 1.",
            5.0 / 6.0,
        ),
    },
    Setting {
        shape: "urp:default",
        parameter: "strength",
        shipped: 1.0,
        words: ("with an intensity of half the exposure", 0.5),
        at_180: ("an intensity of 0.25 for 180 degrees:", 0.25),
    },
];

impl Setting {
    pub fn find(shape: &str) -> Self {
        let mut all = SETTINGS.into_iter();
        all.find(|setting| setting.shape == shape).expect(shape)
    }

    fn engine(&self) -> Engine {
        let mut engines = list_engines().into_iter();
        engines.find(|engine| engine.shape == self.shape).unwrap()
    }

    /// Returns the factors on the motion of a frame: as shipped, and of the preset at an exposure.
    fn factors(&self, exposure: f64) -> [f64; 2] {
        let engine = self.engine();
        // realism-effects has its exposure as its setting.
        let [engine_value, shape] = match self.parameter {
            "" => [1.0, 1.0],
            name => [shipped(&engine, name), Preset::new(self.shape).number(name)],
        };
        [engine_value * engine.shipped.exposure, shape * exposure]
    }

    /// Returns the engine's own value at which it smears like the preset at this exposure.
    pub fn at(&self, exposure: f64) -> f64 {
        let [shipped, shape] = self.factors(exposure);
        self.shipped * shape / shipped
    }
}

#[test]
fn settings_of_length_are_what_the_pages_say() {
    let page = read("docs/fidelity.md");
    for setting in SETTINGS {
        let shape = setting.shape;
        let text = Preset::new(shape).text();
        for ((words, value), exposure, texts) in [
            (setting.words, 1.0, format!("{page} {text}")),
            (setting.at_180, HALF_FRAME, text.clone()),
        ] {
            assert!(texts.contains(words), "{shape}: no \"{words}\"");
            let length = setting.at(exposure);
            assert!(
                (length / value - 1.0).abs() < 1e-9,
                "{shape}: {words}, {length}"
            );
        }
        // Measured lengths have the same ratio, in whole degrees; O3DE's lose whole pixels, and
        // more of the shorter smear.
        let engine = setting.engine();
        let [shipped, at_180] = setting.factors(HALF_FRAME);
        let measured = f64::from(engine.length) / f64::from(engine.at_180);
        let slack = if shape == "jimenez:o3de" { 0.15 } else { 0.015 };
        let off = measured * at_180 / shipped - 1.0;
        assert!(off.abs() < slack, "{shape}: {measured}, {shipped}/{at_180}");
    }
}

#[test]
fn what_engines_say_of_their_length_is_the_exposure_that_they_are_measured_with() {
    let page = read("results/findings/shipped.md");
    for engine in list_engines() {
        let exposure = engine.shipped.exposure;
        let section = page.split_once(&format!("\n## {}\n", engine.name));
        let section = section.unwrap().1.split("\n## ").next().unwrap();
        let prose = section.lines().filter(|line| !line.starts_with('|'));
        let prose = prose.collect::<Vec<_>>().join(" ");
        for text in [&engine.states, &prose] {
            let degrees = text.match_indices(" degrees");
            let degrees = degrees.filter_map(|(at, _)| numbers(&text[..at]).last().copied());
            for degrees in degrees {
                assert_eq!(degrees, 360.0 * exposure, "{}: {text}", engine.name);
            }
            for (before, after) in text.match_indices(" s").map(|(at, _)| text.split_at(at)) {
                let is_time = after[2..].starts_with([',', '.']) || after.len() == 2;
                let second = before.rsplit(' ').next().unwrap().strip_prefix("1/");
                if let Some(second) = second.filter(|_| is_time) {
                    let second: f64 = second.parse().unwrap();
                    let time = exposure / 60.0;
                    assert!(
                        (time * second - 1.0).abs() < 1e-9,
                        "{}: {text}",
                        engine.name
                    );
                }
            }
        }
    }
}
