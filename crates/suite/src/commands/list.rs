//! `shuttertruth list` and `--list-adapters`

use std::path::Path;

use filters::{Filter, Parameter, Preset, list_adapters};
use suite::Error;
use tracer::{SceneListing, list_scenes};

use crate::cli::ListArgs;

/// Prints scenes, filters, parameters and presets.
pub fn execute(args: &ListArgs) -> Result<(), Error> {
    let scenes = list_scenes(&args.scenes_dir)?;
    let mut filters = Filter::builtin_names()
        .iter()
        .map(|name| Filter::builtin(name))
        .collect::<Result<Vec<_>, _>>()?;
    for folder in &args.filter {
        filters.push(Filter::load(Path::new(folder))?);
    }
    if args.json {
        let listing = serde_json::json!({
            "scenes": scenes.iter().map(scene_json).collect::<Vec<_>>(),
            "filters": filters.iter().map(filter_json).collect::<Vec<_>>(),
        });
        println!(
            "{}",
            serde_json::to_string_pretty(&listing).expect("listings are plain data")
        );
    } else {
        println!("scenes\n");
        scenes.iter().for_each(print_scene);
        println!("filters\n");
        filters.iter().for_each(print_filter);
    }
    Ok(())
}

/// Prints one adapter a line, numbered as `--adapter` takes them.
pub fn adapters() -> Result<(), Error> {
    for (number, adapter) in list_adapters().iter().enumerate() {
        println!(
            "{number}: {} ({}, {}, {})",
            adapter.name, adapter.backend, adapter.driver, adapter.kind
        );
    }
    Ok(())
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
            "tunable": parameter.tunable,
            "doc": parameter.doc,
        })
    };
    let preset = |preset: &Preset| serde_json::json!({ "name": preset.name, "doc": preset.doc, "values": preset.values });
    serde_json::json!({
        "name": filter.name,
        "summary": filter.summary,
        "source": filter.source,
        "alignment": filter.alignment.name(),
        "parameters": filter.parameters.iter().map(parameter).collect::<Vec<_>>(),
        "presets": filter.presets.iter().map(preset).collect::<Vec<_>>(),
    })
}

fn print_scene(scene: &SceneListing) {
    let family = serde_json::to_value(scene.family).expect("a family is a word");
    println!(
        "  {}  ({})",
        scene.name,
        family.as_str().unwrap_or_default()
    );
    println!("    {}", scene.exposes);
    if !scene.variants.is_empty() {
        println!("    variants: {}", scene.variants.join(" "));
    }
    println!();
}

fn print_filter(filter: &Filter) {
    println!("  {}  (shutter: {})", filter.name, filter.alignment);
    println!("    {}", filter.summary);
    println!("    cannot: {}", filter.cannot);
    for preset in &filter.presets {
        println!("    :{}  {}", preset.name, preset.doc);
    }
    for parameter in &filter.parameters {
        println!(
            "    .{} = {} ({})",
            parameter.name,
            parameter.default,
            parameter.kind.allowed()
        );
        println!("        {}", parameter.doc);
    }
    println!();
}
