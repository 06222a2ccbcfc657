//! Listings of scenes and filters, in brief and in detail.

use filters::{Command, Filter, Parameter, Preset, Unit};
use store::printable;
use suite::InputKind;
use tracer::SceneListing;

use crate::output::{heading, push_wrapped, wrap_lines};

/// Lists scenes, one short paragraph each.
pub fn scenes_text(scenes: &[SceneListing]) -> String {
    let mut text = heading("scenes") + "\n";
    for scene in scenes {
        let line = format!("{}: {}", printable(&scene.name), printable(&scene.exposes));
        push_wrapped(&mut text, 2, &line);
    }
    text
}

/// Lists filters, one short paragraph each.
pub fn filters_text(filters: &[Filter]) -> String {
    let mut text = heading("filters") + "\n";
    for filter in filters {
        let presets: Vec<&str> = filter
            .presets
            .iter()
            .map(|preset| preset.name.as_str())
            .collect();
        let line = format!(
            "{}: {}. Shutter: {}; presets: {}",
            filter.name,
            printable(filter.summary.trim_end_matches('.')),
            filter.alignment,
            presets.join(", ")
        );
        push_wrapped(&mut text, 2, &line);
    }
    text
}

/// Lists kinds of input with their forms; the first form of each is the full one.
pub fn inputs_text(kinds: &[InputKind]) -> String {
    let mut text = String::new();
    for kind in kinds {
        push_wrapped(
            &mut text,
            0,
            &format!("{}: {}", heading(kind.name), kind.help),
        );
        for form in &kind.forms {
            push_wrapped(&mut text, 2, &format!("{}: {}", form.name, form.help));
        }
    }
    text
}

/// Describes a kind of input as JSON.
pub fn input_json(kind: &InputKind) -> serde_json::Value {
    let forms = kind.forms.iter();
    let forms = forms.map(|form| serde_json::json!({"name": form.name, "help": form.help}));
    serde_json::json!({
        "name": kind.name,
        "help": kind.help,
        "forms": forms.collect::<Vec<_>>(),
    })
}

/// Describes scenes and filters in detail.
pub fn details_text(scenes: &[SceneListing], filters: &[Filter]) -> String {
    let scenes: String = scenes.iter().map(scene_text).collect();
    let filters: String = filters.iter().map(filter_text).collect();
    wrap_lines(&(scenes + &filters))
}

/// Describes a scene as JSON.
pub fn scene_json(scene: &SceneListing) -> serde_json::Value {
    serde_json::json!({
        "name": scene.name,
        "family": scene.family,
        "exposes": scene.exposes,
        "variants": scene.variants,
    })
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
    let preset = |preset: &Preset| {
        serde_json::json!({
            "name": preset.name,
            "doc": preset.doc,
            "source": preset.source,
            "reference_width": preset.reference_width,
            "values": preset.values,
            "tuned": preset.tuned,
        })
    };
    serde_json::json!({
        "name": filter.name,
        "summary": filter.summary,
        "source": filter.source,
        "alignment": filter.alignment.name(),
        "command": filter.command.as_ref().map(Command::words),
        "environment": filter.command.as_ref().map(|command| &command.environment),
        "compilers": filter.list_compilers(),
        "parameters": filter.parameters.iter().map(parameter).collect::<Vec<_>>(),
        "presets": filter.presets.iter().map(preset).collect::<Vec<_>>(),
    })
}

fn scene_text(scene: &SceneListing) -> String {
    let family = serde_json::to_value(scene.family).expect("a family is a word");
    let mut text = format!(
        "  {}  ({})\n    {}\n",
        printable(&scene.name),
        family.as_str().unwrap_or_default(),
        printable(&scene.exposes)
    );
    if !scene.variants.is_empty() {
        text += &format!("    variants: {}\n", scene.variants.join(" "));
    }
    text + "\n"
}

fn filter_text(filter: &Filter) -> String {
    let parameter = |parameter: &Parameter| {
        format!(
            "    .{} = {}{} ({})\n        {}\n",
            parameter.name,
            parameter.default,
            parameter.unit.map_or("", |Unit::Pixels| " pixels"),
            parameter.kind.allowed(),
            printable(&parameter.doc)
        )
    };
    let command = match &filter.command {
        Some(command) => command_text(command),
        None => {
            let compilers = filter.list_compilers().into_iter();
            let lines = compilers.map(|line| format!("    {}\n", printable(&line)));
            lines.collect()
        }
    };
    format!(
        "  {}  (shutter: {})\n    {}\n    cannot: {}\n{command}{}{}\n",
        filter.name,
        filter.alignment,
        printable(&filter.summary),
        printable(&filter.cannot),
        filter.presets.iter().map(preset_text).collect::<String>(),
        filter.parameters.iter().map(parameter).collect::<String>()
    )
}

/// Describes the program of a filter, and the variables that it wants to see.
fn command_text(command: &Command) -> String {
    let words = command.words().join(" ");
    let mut text = format!("    runs: {}\n", printable(&words));
    if !command.environment.is_empty() {
        let names = command.environment.join(" ");
        text += &format!("    environment: {}\n", printable(&names));
    }
    text
}

/// Describes a preset: its source, and its differences from that.
fn preset_text(preset: &Preset) -> String {
    let mut text = format!("    :{}  {}\n", preset.name, printable(&preset.doc));
    let mut line = |words: String| text += &format!("        {}\n", printable(&words));
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
    text
}
