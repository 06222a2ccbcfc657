//! Every built-in filter.

use filters::{Filter, Settings};

/// Returns every built-in filter with every preset.
pub fn every_preset() -> Vec<(Filter, Settings)> {
    let mut presets = Vec::new();
    for name in Filter::builtin_names() {
        let filter = Filter::builtin(&name).expect("built-in filters are checked");
        for preset in &filter.presets {
            let settings = filter.settings(Some(&preset.name)).expect("it is listed");
            presets.push((filter.clone(), settings));
        }
    }
    presets
}

/// Returns the sum of the weights of a preset's taps: 1 unless the original makes pictures
/// brighter.
pub fn gain(filter: &Filter, settings: &Settings) -> f32 {
    match (filter.name.as_str(), settings.preset.as_str()) {
        // three.js adds 17 colours and divides by 16.
        ("three", "default") => 17.0 / 16.0,
        _ => 1.0,
    }
}

/// Names a preset for messages of tests.
pub fn preset_name(filter: &Filter, settings: &Settings) -> String {
    format!("{} with preset {}", filter.name, settings.preset)
}
