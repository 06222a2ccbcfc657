//! The choice as a preset of filter.toml.

use filters::{TuningRecord, Value};

use super::{TunePlan, Tuning};

/// A `[[preset]]` called `tuned`, with how it was found and the values that differ from the parameters' defaults.
/// Values in pixels that were scaled to the width of the scenes are meant for that width.
pub fn preset_text(tuning: &Tuning, plan: &TunePlan) -> String {
    let render = &plan.render;
    let journal = &tuning.journal;
    let tuned = TuningRecord {
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
    let width = match plan.space.start.reference_width {
        Some(_) => format!("reference_width = {}\n", render.width),
        None => String::new(),
    };
    let mut text = format!(
        "[[preset]]\nname = \"tuned\"\ndoc = \"{}'s values, tuned for a smaller error.\"\n{width}[preset.tuned]\n{}[preset.values]\n",
        journal.start,
        toml::to_string(&tuned).expect("a provenance is plain data")
    );
    for parameter in &plan.choice.filter.parameters {
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
