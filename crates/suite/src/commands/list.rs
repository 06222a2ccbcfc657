//! `shuttertruth list` and `--list-adapters`

use std::path::Path;

use filters::{Filter, list_adapters};
use suite::Error;
use tracer::{SceneListing, list_scenes};

use crate::cli::ListArgs;

/// Prints scenes, filters, parameters and presets.
pub fn execute(args: &ListArgs) -> Result<(), Error> {
    let scenes = list_scenes(&args.scenes_dir)?;
    let mut filters =
        Filter::builtin_names().iter().map(|name| Filter::builtin(name)).collect::<Result<Vec<_>, _>>()?;
    for folder in &args.filter {
        filters.push(Filter::load(Path::new(folder))?);
    }
    if args.json {
        let listing = serde_json::json!({ "scenes": scenes, "filters": filters });
        println!("{}", serde_json::to_string_pretty(&listing).expect("listings are plain data"));
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
        println!("{number}: {} ({}, {}, {})", adapter.name, adapter.backend, adapter.driver, adapter.kind);
    }
    Ok(())
}

fn print_scene(scene: &SceneListing) {
    println!("  {}  ({})", scene.name, scene.family.name());
    println!("    {}", scene.exposes);
    if !scene.variants.is_empty() {
        println!("    variants: {}", scene.variants.join(" "));
    }
    println!();
}

fn print_filter(filter: &Filter) {
    println!("  {}  (shutter: {})", filter.name, filter.alignment);
    println!("    {}", filter.summary);
    println!("    presets: {}", filter.preset_names().join(" "));
    for parameter in &filter.parameters {
        println!("    {} = {} {}", parameter.name, parameter.default_text(), parameter.range_text());
        println!("        {}", parameter.doc);
    }
    println!();
}
