//! Every built-in filter.

use filters::{Filter, Settings};

/// Returns every built-in filter with every preset.
pub fn every_preset() -> Vec<(Filter, Settings)> {
    let filters = Filter::builtin_names()
        .into_iter()
        .map(|name| Filter::builtin(&name).expect("built-in filters are checked"));
    filters
        .flat_map(|filter| {
            let settings: Vec<Settings> = filter
                .presets
                .iter()
                .map(|preset| filter.settings(Some(&preset.name)).expect("it is listed"))
                .collect();
            settings
                .into_iter()
                .map(move |settings| (filter.clone(), settings))
        })
        .collect()
}

/// Returns the sum of the weights of a preset's taps: 1 unless the original makes pictures brighter.
pub fn gain(filter: &Filter, settings: &Settings) -> f32 {
    match (filter.name.as_str(), settings.preset.as_str()) {
        // three.js adds 17 colours and divides by 16.
        ("three", "default") => 17.0 / 16.0,
        _ => 1.0,
    }
}

/// Names a preset as messages of tests do.
pub fn preset_name(filter: &Filter, settings: &Settings) -> String {
    format!("{} with preset {}", filter.name, settings.preset)
}
