//! Prose of the findings.

use std::collections::BTreeSet;

use super::lengths::Setting;
use super::{HALF_FRAME, Preset, camera_trail, kino_window, read, short, unheld, word};
use crate::results::engines::list_engines;

/// Lists the parts of results/findings/dagor.md that hold numbers.
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

/// Lists the parts of results/findings/godot.md that hold numbers.
fn godot_phrases() -> Vec<String> {
    let number = |preset: &str, parameter: &str| Preset::new(preset).number(parameter);
    let tile = number("godot:addon", "tile_size");
    let tiles = number("godot:addon", "trail_tiles");
    let [most, fits] = [127.0, (127.0 / tiles).floor()];
    let engine_tile = number("godot:engine", "tile_size");
    assert_eq!(number("godot:engine", "trail_tiles"), 1.0);
    vec![
        format!("after {} tiles of {tile} pixels", word(tiles)),
        format!("no larger than {tiles} tiles"),
        format!("A tile has {tile} pixels"),
        format!("up to {most} either way"),
        format!("Two tiles of {fits} pixels, {} in all", tiles * fits),
        "8 bits".to_owned(),
        format!("one tile of {engine_tile} pixels"),
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
    let named: BTreeSet<String> = list_engines()
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
