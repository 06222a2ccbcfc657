//! Sentences about what each engine does wrong.

use tests::kernels::{Steady, place_taps};

use super::lengths::Setting;
use super::{HALF_FRAME, Preset, camera_trail, kino_window, shipped, short, unheld, word};
use crate::results::engines::{Engine, list_engines};

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

/// Lists the parts of an engine's sentence about the length of its smear.
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

/// Lists the parts of an engine's sentence about taps, weights and cuts.
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
