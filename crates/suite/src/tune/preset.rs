//! The choice as a preset of filter.toml.

use filters::{Parameter, Tuned, Value};

use super::Tuning;
use crate::RenderSettings;

/// A `[[preset]]` called `tuned`, with how it was found and the values that differ from the parameters' defaults.
pub fn preset_text(tuning: &Tuning, render: &RenderSettings, parameters: &[Parameter]) -> String {
    let journal = &tuning.journal;
    let tuned = Tuned {
        by: journal.program.clone(),
        from: journal.start.clone(),
        seed: journal.seed,
        trials: tuning.trials,
        size: [render.width, render.height],
        samples_per_pixel: render.samples_per_pixel,
        scenes: (journal.scenes.iter())
            .map(|(scene, _)| scene.clone())
            .collect(),
    };
    let mut text = format!(
        "[[preset]]\nname = \"tuned\"\ndoc = \"{}'s values, tuned for a smaller error.\"\n[preset.tuned]\n{}[preset.values]\n",
        journal.start,
        toml::to_string(&tuned).expect("a provenance is plain data")
    );
    for parameter in parameters {
        let value = &tuning.values[&parameter.name];
        if *value != parameter.default {
            text += &match value {
                Value::Integer(value) => format!("{} = {value}\n", parameter.name),
                Value::Real(value) => format!("{} = {value:?}\n", parameter.name),
                Value::Choice(value) => format!("{} = \"{value}\"\n", parameter.name),
            };
        }
    }
    text
}
