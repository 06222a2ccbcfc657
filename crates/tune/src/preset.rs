//! Choice of a tuning as a preset of filter.toml.

use filters::TuningRecord;

use crate::options::TuneOptions;
use crate::tuning::Tuning;

/// Formats a `[[preset]]` called `tuned`, with a record of the tuning and the values that differ
/// from the parameters' defaults. Values in pixels that were scaled to the width of the scenes are
/// for that width.
pub fn tuned_preset_toml(tuning: &Tuning, options: &TuneOptions) -> String {
    let render = &options.render;
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
    let width = match options.space.start.reference_width {
        Some(_) => format!("reference_width = {}\n", render.width),
        None => String::new(),
    };
    let mut text = format!(
        "[[preset]]\nname = \"tuned\"\ndoc = \"{}'s values, tuned for a smaller error.\"\n{width}[preset.tuned]\n{}[preset.values]\n",
        journal.start,
        toml::to_string(&tuned).expect("a record is plain data")
    );
    for parameter in &options.choice.filter.parameters {
        let value = &tuning.values[&parameter.name];
        if *value != parameter.default {
            let value = toml::Value::try_from(value).expect("a value is plain data");
            text += &format!("{} = {value}\n", parameter.name);
        }
    }
    text
}
