//! Listings of scenes and filters, in brief and in detail, and names of adapters.

use filters::{Filter, Parameter, Preset, Unit};
use measure::InputKind;
use scene::SceneListing;

use terminal::output::{Text, heading, push_wrapped};

/// Lists scenes, one short paragraph each.
pub fn scenes_text(scenes: &[SceneListing]) -> Text {
    let mut text = heading("scenes") + "\n";
    for scene in scenes {
        push_wrapped(&mut text, 2, format!("{}: {}", scene.name, scene.exposes));
    }
    text
}

/// Lists filters, one short paragraph each.
pub fn filters_text(filters: &[Filter]) -> Text {
    let mut text = heading("filters") + "\n";
    for filter in filters {
        let presets = filter.presets.iter().map(|preset| preset.name.as_str());
        let line = format!(
            "{}: {}. Shutter: {}; presets: {}",
            filter.name,
            filter.summary.trim_end_matches('.'),
            filter.alignment,
            presets.collect::<Vec<_>>().join(", ")
        );
        push_wrapped(&mut text, 2, line);
    }
    text
}

/// Lists kinds of input with their forms; the first form of each is the full one.
pub fn inputs_text(kinds: &[InputKind]) -> Text {
    let mut text = Text::default();
    for kind in kinds {
        let line = heading(kind.name) + format!(": {}", kind.help);
        push_wrapped(&mut text, 0, line);
        for form in &kind.forms {
            push_wrapped(&mut text, 2, format!("{}: {}", form.name, form.help));
        }
    }
    text
}

/// Describes scenes and filters in detail.
pub fn details_text(scenes: &[SceneListing], filters: &[Filter]) -> Text {
    let mut text = Text::default();
    for scene in scenes {
        push_scene(&mut text, scene);
        text += "\n";
    }
    for filter in filters {
        push_filter(&mut text, filter);
        text += "\n";
    }
    text
}

/// Describes a filter as JSON.
pub fn filter_json(filter: &Filter) -> serde_json::Value {
    let parameter = |parameter: &Parameter| {
        serde_json::json!({
            "name": parameter.name,
            "default": parameter.default,
            "allowed": parameter.kind.allowed(),
            "unit": parameter.unit,
            "tunable": parameter.tunable,
            "doc": parameter.doc,
        })
    };
    serde_json::json!({
        "name": filter.name,
        "summary": filter.summary,
        "source": filter.source,
        "reach": filter.reach,
        "cannot": filter.cannot,
        "mirror_symmetric": filter.mirror_symmetric,
        "alignment": filter.alignment.name(),
        "command": filter.command.as_ref().map(|command| &command.words),
        "environment": filter.command.as_ref().map(|command| &command.environment),
        "compilers": filter.list_compilers(),
        "parameters": filter.parameters.iter().map(parameter).collect::<Vec<_>>(),
        "presets": filter.presets,
    })
}

fn push_scene(text: &mut Text, scene: &SceneListing) {
    let family = scene.family.name();
    push_wrapped(text, 2, format!("{}  ({family})", scene.name));
    push_wrapped(text, 4, &scene.exposes);
    if !scene.variants.is_empty() {
        push_wrapped(text, 4, format!("variants: {}", scene.variants.join(" ")));
    }
}

fn push_filter(text: &mut Text, filter: &Filter) {
    let title = format!("{}  (shutter: {})", filter.name, filter.alignment);
    push_wrapped(text, 2, title);
    push_wrapped(text, 4, &filter.summary);
    for (label, said) in [
        ("source", &filter.source),
        ("reach", &filter.reach),
        ("cannot", &filter.cannot),
    ] {
        if !said.is_empty() {
            push_wrapped(text, 4, format!("{label}: {said}"));
        }
    }
    if filter.mirror_symmetric {
        push_wrapped(text, 4, "a mirrored frame gives the mirrored output");
    }
    for line in filter.list_compilers() {
        push_wrapped(text, 4, line);
    }
    if let Some(command) = &filter.command {
        push_wrapped(text, 4, format!("runs: {}", command.words.join(" ")));
        if !command.environment.is_empty() {
            let names = command.environment.join(" ");
            push_wrapped(text, 4, format!("environment: {names}"));
        }
    }
    for preset in &filter.presets {
        push_preset(text, preset);
    }
    for parameter in &filter.parameters {
        let unit = parameter.unit.map_or("", |Unit::Pixels| " pixels");
        let Parameter { name, default, .. } = parameter;
        let allowed = parameter.kind.allowed();
        push_wrapped(text, 4, format!(".{name} = {default}{unit} ({allowed})"));
        push_wrapped(text, 8, &parameter.doc);
    }
}

/// Describes a preset: its source, and where it differs from that source.
fn push_preset(text: &mut Text, preset: &Preset) {
    push_wrapped(text, 4, format!(":{}  {}", preset.name, preset.doc));
    let mut line = |words: String| push_wrapped(text, 8, words);
    if let Some(source) = &preset.source {
        if let Some(code) = &source.code {
            line(format!("source: {code}"));
        }
        if let Some(publication) = &source.publication {
            line(format!("published: {publication}"));
        }
        for difference in &source.differs {
            line(format!("differs: {difference}"));
        }
    }
    if let Some(width) = preset.reference_width {
        line(format!("made for pictures {width} pixels wide"));
    }
}
