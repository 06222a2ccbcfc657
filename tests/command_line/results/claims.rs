//! Numbers in sentences about engines, against presets' parameters, measured lengths and quoted
//! lines.

use std::fs;

use filters::{Filter, Settings, Value};
use judge::Results;
use metrics::Metric;
use tests::kernels::{Steady, place_taps};
use tests::root;

use super::engines::{Engine, list_engines};
use super::page::main_results;

/// Exposure of a shutter of 180 degrees, in frames.
const HALF_FRAME: f64 = 0.5;

/// A preset with its values.
struct Preset {
    filter: Filter,
    settings: Settings,
}

impl Preset {
    fn new(name: &str) -> Self {
        let (filter, preset) = name.split_once(':').unwrap();
        let filter = Filter::builtin(filter).unwrap();
        let settings = filter.settings(Some(preset)).unwrap();
        Self { filter, settings }
    }

    fn number(&self, parameter: &str) -> f64 {
        match &self.settings.values[parameter] {
            Value::Integer(value) => f64::from(*value),
            Value::Real(value) => *value,
            Value::Choice(value) => panic!("{parameter} is {value}"),
        }
    }

    /// Returns all that the preset says of itself: its text and how it differs from its source.
    fn text(&self) -> String {
        let name = &self.settings.preset;
        let preset = (self.filter.presets.iter()).find(|candidate| candidate.name == *name);
        let preset = preset.unwrap();
        let differs = preset.source.iter().flat_map(|origin| &origin.differs);
        let texts = differs.chain([&preset.doc]);
        texts.cloned().collect::<Vec<_>>().join(" ")
    }
}

/// Reads a value that an engine ships.
fn shipped(engine: &Engine, parameter: &str) -> f64 {
    engine.shipped.values[parameter].parse().unwrap()
}

/// Formats a number with at most two decimals: `0.4`.
fn short(number: f64) -> String {
    format!("{}", (100.0 * number).round() / 100.0)
}

/// Spells a small whole number.
fn word(number: f64) -> &'static str {
    match number as u32 {
        2 => "two",
        8 => "eight",
        10 => "ten",
        _ => panic!("spell {number} here"),
    }
}

/// Returns the numbers of a text, without dates, names and other words that hold digits.
fn numbers(text: &str) -> Vec<f64> {
    let words = text.split(|c: char| !c.is_alphanumeric() && c != '.' && c != '-');
    let words = words.map(|word| word.trim_matches(['.', '-']));
    let plain = words.filter(|word| word.chars().all(|c| c.is_ascii_digit() || c == '.'));
    plain.filter_map(|word| word.parse().ok()).collect()
}

/// Removes each of `phrases` from a text that must have it, and returns the numbers of the rest.
fn unheld(name: &str, text: &str, phrases: &[String]) -> Vec<f64> {
    let mut rest = text.to_owned();
    for phrase in phrases {
        assert!(text.contains(phrase), "{name}: no \"{phrase}\" in: {text}");
        rest = rest.replace(phrase, " ");
    }
    numbers(&rest)
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap()
}

/// Returns the window of Kino in the middle and at the end of a trail, by the line that its finding
/// quotes: `(1.2 - t)`.
fn kino_window() -> [String; 2] {
    let page = read("results/findings/unity-ppv2.md");
    let (before, _) = page.split_once(" - t);`").unwrap();
    let middle: f64 = before.rsplit('(').next().unwrap().parse().unwrap();
    [middle, middle - 1.0].map(short)
}

/// Returns how long the Godot demo's trail is with the least and the most noise, in parts of the
/// motion.
fn demo_trail() -> [String; 2] {
    let steady = Steady {
        velocity: [32.0, 0.0],
        exposure: 1.0,
        size: [1920, 1080],
    };
    [0.0, 1.0].map(|noise| {
        let taps = place_taps("jump_flood", "paper", &steady, noise);
        let taps = taps.iter().filter(|tap| tap.weight > 0.0);
        let ends = taps.map(|tap| tap.offset[0].abs());
        short(ends.fold(0.0, f64::max) / steady.velocity[0])
    })
}

/// Returns the smear of Armory's mode Camera as shipped, in frames: from the pixel to the last of
/// its taps.
fn camera_trail(engine: &Engine) -> f64 {
    let taps = Preset::new(&engine.shape).number("samples");
    shipped(engine, "intensity") * (taps - 1.0) / taps
}

/// Lists the parts of an engine's sentence that hold its numbers, as the preset and its lengths
/// have them.
fn phrases(engine: &Engine) -> Vec<String> {
    let preset = Preset::new(&engine.shape);
    [
        length_phrases(engine, &preset),
        tap_phrases(engine, &preset),
    ]
    .concat()
}

/// Lists the parts of its sentence about the length of its smear.
fn length_phrases(engine: &Engine, preset: &Preset) -> Vec<String> {
    let number = |parameter: &str| preset.number(parameter);
    let at_180 = |setting: &Setting| format!("180 degrees are {}", short(setting.at(HALF_FRAME)));
    match engine.shape.as_str() {
        "camera_gather:armory" => {
            vec![format!(
                "over {} of the camera's",
                short(camera_trail(engine))
            )]
        }
        "centred_gather:armory" => {
            let longer = f64::from(engine.length) / (360.0 * engine.shipped.exposure);
            let taps = word(number("samples"));
            vec![format!("{taps} taps"), format!("{} times", short(longer))]
        }
        "jimenez:o3de" => {
            let strength = shipped(engine, "strength");
            let frames = word(2.0 * number("extent") * strength * engine.shipped.exposure);
            vec![
                format!("strength of {strength} smears over {frames} frames"),
                at_180(&Setting::find(&engine.shape)),
            ]
        }
        "urp:default" | "urp:camera_only" => {
            let frames = word(shipped(engine, "strength") * engine.shipped.exposure);
            let setting = Setting::find("urp:default");
            vec![
                format!(
                    "intensity of {} smears over {frames} frames",
                    setting.shipped
                ),
                at_180(&setting),
            ]
        }
        "jump_flood:paper" => vec![format!("by {}", demo_trail().join(" to "))],
        "realism_effects:default" => vec![format!("{} degrees as shipped", engine.length)],
        _ => Vec::new(),
    }
}

/// Lists the parts of its sentence about taps, weights and cuts.
fn tap_phrases(engine: &Engine, preset: &Preset) -> Vec<String> {
    let number = |parameter: &str| preset.number(parameter);
    match engine.shape.as_str() {
        "centred_gather:spartan_2024" => vec![format!("first of {} taps", number("samples"))],
        "three:default" => {
            let samples = number("samples");
            vec![format!(
                "{} colours and divides by {samples}",
                samples + 1.0
            )]
        }
        "babylon:default" => {
            let width = preset.settings.reference_width.unwrap();
            vec![format!(
                "{} pixels in a picture {width} wide",
                number("samples")
            )]
        }
        "bevy:msaa" => vec![format!("{} taps", word(2.0 * number("samples")))],
        "kino:default" | "kino:ppv2" => {
            let [middle, end] = kino_window();
            vec![
                format!("from {middle} at the pixel to {end} at the ends"),
                format!("at {} % of the rows", 2.0 * number("radius_percent")),
            ]
        }
        "dagor:default" => {
            let left = (1.0 - number("vignette")).powi(2);
            vec![
                format!("to {} of their length", short(left)),
                "a vignette of 0".to_owned(),
            ]
        }
        "godot:addon" => {
            let tiles = word(number("trail_tiles"));
            vec![format!("{tiles} tiles of {} pixels", number("tile_size"))]
        }
        "mcguire:g3d" => {
            // The number is in the filter's own text, whose claim `filtering calibration` measures.
            let text = &preset.filter.cannot;
            let grows = text.split_once("grows on each side").unwrap().1;
            let grows = grows.split_once("(g3d ").unwrap().1;
            let grows = grows.split_once(',').unwrap().0;
            vec![
                format!("gains {grows} of its trail"),
                format!("m_cameraMotionInfluence = {}", number("camera_influence")),
            ]
        }
        _ => Vec::new(),
    }
}

#[test]
fn every_number_of_a_mistake_is_the_preset_s_or_measured() {
    let mut held = 0;
    for engine in list_engines() {
        let phrases = phrases(&engine);
        let rest = unheld(&engine.name, &engine.wrong, &phrases);
        assert!(rest.is_empty(), "{}: nothing holds {rest:?}", engine.name);
        held += phrases.len();
    }
    assert!(held > 20, "only {held} phrases");
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

/// An engine's setting of length, with the words that pages have for its value.
struct Setting {
    shape: &'static str,
    parameter: &'static str,
    /// Value that the engine ships.
    shipped: f64,
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
    fn find(shape: &str) -> Self {
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
    fn at(&self, exposure: f64) -> f64 {
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
fn eevee_is_scored_by_a_mean_of_its_samples_which_is_better_than_one() {
    let engines = list_engines();
    let eevee = engines.iter().find(|engine| engine.name.contains("EEVEE"));
    let eevee = eevee.unwrap();
    let mean = Preset::new(&eevee.shape);
    let [draws, one] = [&mean, &Preset::new("blender:eevee")].map(|preset| preset.number("draws"));
    assert_eq!(one, 1.0);
    let phrase = format!("the mean of {draws} of its 64 samples");
    assert!(mean.text().contains(&phrase), "{}", mean.text());
    assert!(eevee.name.ends_with("64 samples"), "{}", eevee.name);
    let results = Results::read_all(&root().join("results")).unwrap();
    let main = main_results(&results).unwrap();
    for scene in main.scenes() {
        let [mean, one] = [&*eevee.shape, "blender:eevee"].map(|name| {
            let mut scores = main.scores.iter();
            let score = scores.find(|score| score.scene == *scene && score.name == name);
            score.unwrap().score(Metric::FLIP).unwrap()
        });
        // One sample is certainly truer than the mean on no scene.
        assert!(mean < one + 0.001, "{scene}: {mean}, one sample {one}");
    }
}

/// Lists those of results/findings/dagor.md.
fn dagor_phrases() -> Vec<String> {
    let number = |preset: &str, parameter: &str| Preset::new(preset).number(parameter);
    let vignette = number("dagor:default", "vignette");
    let left = short((1.0 - vignette).powi(2));
    let longest = number("dagor:default", "longest");
    let twice = 2.0 * longest;
    let pair = format!("`vignette=0.0, longest={twice:.1}`");
    assert!(read("results/changes/dagor_default.md").contains(&pair));
    vec![
        format!("(1 - {vignette})² = {left}"),
        format!("up to {twice} pixels instead of {longest}"),
    ]
}

/// Lists those of results/findings/godot.md.
fn godot_phrases() -> Vec<String> {
    let number = |preset: &str, parameter: &str| Preset::new(preset).number(parameter);
    let tile = number("godot:addon", "tile_size");
    let tiles = number("godot:addon", "trail_tiles");
    let [most, fits] = [127.0, (127.0 / tiles).floor()];
    let own = number("godot:engine", "tile_size");
    assert_eq!(number("godot:engine", "trail_tiles"), 1.0);
    vec![
        format!("after {} tiles of {tile} pixels", word(tiles)),
        format!("no larger than {tiles} tiles"),
        format!("A tile has {tile} pixels"),
        format!("up to {most} either way"),
        format!("Two tiles of {fits} pixels, {} in all", tiles * fits),
        "8 bits".to_owned(),
        format!("one tile of {own} pixels"),
    ]
}

/// Lists the parts of a finding that hold numbers which no quoted line has.
fn finding_phrases(page: &str) -> Vec<String> {
    let engines = list_engines();
    let find = |shape: &str| engines.iter().find(|engine| engine.shape == shape).unwrap();
    let number = |preset: &str, parameter: &str| Preset::new(preset).number(parameter);
    // Device coordinates go from -1 to 1, and texture coordinates from 0 to 1.
    let wide = "2 wide".to_owned();
    match page {
        "armory" => {
            let trail = short(camera_trail(find("camera_gather:armory")));
            vec![format!("{trail} of the motion"), wide]
        }
        "dagor" => dagor_phrases(),
        "godot" => godot_phrases(),
        "unity-ppv2" => {
            let [middle, end] = kino_window();
            let percent = number("kino:ppv2", "radius_percent");
            vec![
                format!("from {middle} in the middle of the trail to {end} at its ends"),
                format!(
                    "at {percent} % of the rows, and the whole trail at {} %",
                    2.0 * percent
                ),
            ]
        }
        "unity-urp" => {
            let setting = Setting::find("urp:default");
            let half = short(setting.at(HALF_FRAME));
            let clamp = number("urp:camera_only", "longest_camera_motion");
            let preset = Preset::new("urp:default").text();
            assert!(preset.contains("by default 0,"), "{preset}");
            vec![
                format!("clamp of camera motion at {clamp}"),
                "intensity of 0,".to_owned(),
                format!("intensity of {} smears over two", setting.shipped),
                format!("intensity of {half} is a shutter of 180 degrees"),
                wide,
                "1 wide".to_owned(),
            ]
        }
        _ => panic!("say here what holds the numbers of {page}"),
    }
}

/// Returns a page's prose in one line, without places of links, code and tables; and the numbers of
/// its quoted lines.
fn prose(page: &str) -> (String, Vec<f64>) {
    let (quoted, prose): (Vec<_>, Vec<_>) = page
        .lines()
        .filter(|line| !line.starts_with("    ") && !line.starts_with("| line of"))
        .partition(|line| line.starts_with('|'));
    let is_gap = |c: char| !c.is_ascii_digit() && c != '.';
    let quoted = quoted.join(" ");
    let quoted = quoted.split(is_gap).filter_map(|word| word.parse().ok());
    let mut text = String::new();
    for part in prose.join(" ").split("](") {
        let after = part.split_once(')').filter(|_| !text.is_empty());
        text += after.map_or(part, |(_, after)| after);
    }
    let plain = text.split('`').step_by(2).collect::<Vec<_>>().join(" ");
    (plain, quoted.collect())
}

#[test]
fn every_number_of_a_finding_is_the_preset_s_or_in_a_quoted_line() {
    let named: std::collections::BTreeSet<String> = list_engines()
        .into_iter()
        .filter_map(|engine| engine.finding)
        .collect();
    assert!(named.len() > 4);
    for name in named {
        let page = read(&format!("results/findings/{name}.md"));
        let (prose, quoted) = prose(&page);
        let rest = unheld(&name, &prose, &finding_phrases(&name));
        let rest: Vec<f64> = (rest.into_iter())
            .filter(|number| !quoted.contains(number))
            .collect();
        assert!(rest.is_empty(), "{name}: nothing holds {rest:?}: {prose}");
    }
}

/// Returns the verdict of a preset's search in results/changes, if there is one.
fn verdict(shape: &str) -> Option<String> {
    let path = format!("results/changes/{}.md", shape.replace(':', "_"));
    let page = fs::read_to_string(root().join(path)).ok()?;
    let lines = page.lines();
    let mut verdicts = lines.filter_map(|line| line.strip_prefix("smallest change: "));
    Some(verdicts.next().unwrap().to_owned())
}

#[test]
fn an_engine_has_the_change_of_its_search_and_no_defect_only_if_there_is_none() {
    let mut searched = 0;
    for engine in list_engines() {
        let verdict = verdict(&engine.shape);
        let is_none = verdict
            .as_ref()
            .is_some_and(|text| text.starts_with("none"));
        let change = engine
            .change
            .as_ref()
            .map(|change| format!("`{}`", change.set));
        assert_eq!(
            change,
            verdict.filter(|_| !is_none),
            "{}: its search found another change",
            engine.name
        );
        if engine.wrong == "No defect was found that can be measured." {
            assert!(is_none, "{}: a search found a change", engine.name);
        }
        searched += 1;
    }
    let pages = fs::read_dir(root().join("results/changes")).unwrap();
    assert!(searched >= pages.count());
}
