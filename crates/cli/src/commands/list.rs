//! The command `list`, and the option `--list-adapters`.

use std::path::Path;

use filters::{
    AdapterDescription, Command, Filter, FilterError, Limits, Parameter, Preset, Unit,
    list_adapters, try_out,
};
use suite::{Error, open_adapter, printable};
use tracer::{SceneListing, list_scenes};

use crate::arguments::ListArgs;
use crate::output::print::{print, print_json, print_note};
use crate::output::progress::make_monitor;
use crate::output::wrap::push_wrapped;

/// Prints scenes, filters, parameters and presets. Tries out filters of the user's own before.
pub fn execute(args: &ListArgs) -> Result<(), Error> {
    let scenes = list_scenes(&args.scenes_dir)?;
    let mut filters = Filter::builtin_names()
        .iter()
        .map(|name| Filter::builtin(name))
        .collect::<Result<Vec<_>, _>>()?;
    let own = (args.filter.iter())
        .map(|folder| Filter::load(Path::new(folder)))
        .collect::<Result<Vec<_>, _>>()?;
    try_filters(&own, args.adapter.adapter.as_deref())?;
    filters.extend(own);
    if args.json {
        let listing = serde_json::json!({
            "scenes": scenes.iter().map(scene_json).collect::<Vec<_>>(),
            "filters": filters.iter().map(filter_json).collect::<Vec<_>>(),
        });
        print_json(&listing)
    } else {
        let scenes: String = scenes.iter().map(scene_text).collect();
        let filters: String = filters.iter().map(filter_text).collect();
        print(&wrap_lines(&format!(
            "scenes\n\n{scenes}filters\n\n{filters}"
        )))
    }
}

/// Holds kernels to the adapter's limits and runs them with every preset and at both ends of every range. Without an adapter,
/// holds them to the lowest common limits, and says so.
fn try_filters(filters: &[Filter], adapter: Option<&str>) -> Result<(), Error> {
    let have_kernels = filters.iter().any(|filter| filter.command.is_none());
    if !have_kernels && adapter.is_none() {
        return Ok(());
    }
    match open_adapter(adapter, make_monitor(true)) {
        Ok(gpu) => {
            let limits = Limits::of(&gpu);
            for filter in filters {
                limits.check(filter)?;
                try_out(&gpu, filter)?;
            }
        }
        Err(FilterError::NoAdapter) => {
            let limits = Limits::lowest();
            for filter in filters {
                limits.check(filter)?;
            }
            print_note(
                "no GPU adapter was found: kernels were held to the lowest common limits, and no preset or range was tried",
            );
        }
        Err(error) => return Err(error.into()),
    }
    for filter in filters {
        if let Err(error) = Limits::lowest().check(filter) {
            print_note(&format!("other adapters may refuse this filter: {error}"));
        }
    }
    Ok(())
}

/// Wraps lines and keeps their indentation.
fn wrap_lines(text: &str) -> String {
    let mut wrapped = String::new();
    for line in text.lines() {
        let words = line.trim_start_matches(' ');
        match words.is_empty() {
            true => wrapped += "\n",
            false => push_wrapped(&mut wrapped, line.len() - words.len(), words),
        }
    }
    wrapped
}

/// Prints one adapter a line, numbered as `--adapter` takes them.
pub fn print_adapters() -> Result<(), Error> {
    let line = |(number, adapter): (usize, &AdapterDescription)| {
        format!(
            "{number}: {} ({}, {}, {})\n",
            adapter.name, adapter.backend, adapter.driver, adapter.kind
        )
    };
    print(
        &list_adapters()
            .iter()
            .enumerate()
            .map(line)
            .collect::<String>(),
    )
}

fn scene_json(scene: &SceneListing) -> serde_json::Value {
    serde_json::json!({
        "name": scene.name,
        "family": scene.family,
        "exposes": scene.exposes,
        "variants": scene.variants,
    })
}

fn filter_json(filter: &Filter) -> serde_json::Value {
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
        None => String::new(),
    };
    format!(
        "  {}  (shutter: {})\n    {}\n    cannot: {}\n{command}{}{}\n",
        filter.name,
        filter.alignment,
        printable(&filter.summary),
        printable(&filter.cannot),
        filter
            .presets
            .iter()
            .map(tuned_preset_toml)
            .collect::<String>(),
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
fn tuned_preset_toml(preset: &Preset) -> String {
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
