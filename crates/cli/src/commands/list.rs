//! The command `list`.

use std::path::{Path, PathBuf};
use terminal::refuse;

use clap::Args;
use filters::{AdapterDescription, Filter, FilterError, Limits, list_adapters, try_out};
use measure::{Error, InputFormat, open_adapter};
use scene::{SceneListing, list_scenes, load_scene};
use tracer::find_coincident_surfaces;

use super::copy::copy_scenes;
use super::listing::{details_text, filter_json, filters_text, inputs_text, scenes_text};
use terminal::arguments::{AdapterArgs, RootArgs, filter_names, listed_names};
use terminal::output::{Text, make_monitor, print, print_json, print_note, print_scene_notes};
use terminal::selection::{is_pattern, load_filters, match_names, suggest_names};
use terminal::settings::Settings;

#[derive(Debug, Args)]
pub struct ListArgs {
    /// Things to list: scenes, filters, inputs, adapters, or names or patterns of scenes and
    /// filters, which are shown in detail [default: scenes and filters].
    #[arg(value_name = "WHAT", value_parser = listed_names(), hide_possible_values = true)]
    pub what: Vec<String>,
    /// Filters to list in detail: names, folders or patterns; repeatable, or separated by commas. A
    /// filter of your own is tried out with every preset and at both ends of every range.
    #[arg(
        long = "filter",
        visible_alias = "filters",
        value_delimiter = ',',
        value_name = "FILTERS",
        value_parser = filter_names(),
        hide_possible_values = true
    )]
    pub filters: Vec<String>,
    /// Copy the named built-in scenes, or all, and bounds.toml into this folder. Nothing is
    /// overwritten.
    #[arg(long, value_name = "DIR", conflicts_with_all = ["filters", "json"])]
    pub copy_to: Option<PathBuf>,
    #[command(flatten)]
    pub root: RootArgs,
    #[command(flatten)]
    pub adapter: AdapterArgs,
    /// Print JSON.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

/// Prints scenes and filters in brief, or the named ones in detail.
pub fn execute(args: &ListArgs, settings: &Settings) -> Result<(), Error> {
    if let Some(folder) = &args.copy_to {
        return copy_scenes(&args.what, folder);
    }
    if args.what == ["adapters"] {
        return print(adapters_text());
    }
    if args.what == ["inputs"] {
        let kinds = InputFormat::kinds();
        return if args.json {
            print_json(&kinds)
        } else {
            print(inputs_text(&kinds))
        };
    }
    let is_brief = args.filters.is_empty()
        && (args.what.iter()).all(|what| what == "scenes" || what == "filters");
    let (scenes, filters) = find_named(args)?;
    if !is_brief {
        scenes.iter().try_for_each(print_notes)?;
    }
    if args.json {
        return print_json(&serde_json::json!({
            "scenes": scenes,
            "filters": filters.iter().map(filter_json).collect::<Vec<_>>(),
        }));
    }
    if !is_brief {
        return print(details_text(&scenes, &filters));
    }
    let mut text = Text::default();
    if !scenes.is_empty() {
        text += scenes_text(&scenes);
    }
    if !filters.is_empty() {
        text += filters_text(&filters);
    }
    let settings = settings
        .all_text()
        .map(|text| format!("settings: {text}\n"));
    print(text + settings.unwrap_or_default() + "details: shuttertruth list NAME\n")
}

/// Tries out the filter in a folder, and prints its details.
pub fn list_filter(folder: &Path) -> Result<(), Error> {
    let filter = Filter::load(folder)?;
    try_filters(&[&filter], None)?;
    print(details_text(&[], &[filter]))
}

/// Writes what is worth knowing about a scene and its variants: what the loader left out, and
/// surfaces in one place.
fn print_notes(listing: &SceneListing) -> Result<(), Error> {
    let variants = listing
        .variants
        .iter()
        .map(|variant| Some(variant.as_str()));
    for variant in std::iter::once(None).chain(variants) {
        let scene = load_scene(listing.folder.clone(), variant)?;
        print_scene_notes([&scene]);
        for note in find_coincident_surfaces(&scene)? {
            print_note(&note);
        }
    }
    Ok(())
}

/// Lists the named scenes and filters, or all. Tries out the user's own filters.
fn find_named(args: &ListArgs) -> Result<(Vec<SceneListing>, Vec<Filter>), Error> {
    let builtin = Filter::builtin_names();
    let asked = if args.what.is_empty() && args.filters.is_empty() {
        vec!["scenes".to_owned(), "filters".to_owned()]
    } else {
        args.what.clone()
    };
    let folder = &args.root.scenes_dir;
    // Built-in filters can be listed without any scenes.
    let needs_scenes = asked
        .iter()
        .any(|what| what != "filters" && !builtin.contains(what));
    let known_scenes = match needs_scenes {
        true if folder.is_dir() || args.what.iter().any(|what| what == "scenes") => {
            list_scenes(folder)?
        }
        true if args.what.is_empty() => {
            print_note(&format!(
                "no scenes: there is no folder {folder}; --scenes-dir names another one"
            ));
            Vec::new()
        }
        _ => Vec::new(),
    };
    let scene_names: Vec<String> = known_scenes
        .iter()
        .map(|listing| listing.name.clone())
        .collect();
    let known = [&scene_names[..], &builtin].concat();
    let (mut scenes, mut filters) = (Vec::new(), Vec::new());
    for what in &asked {
        let names = match what.as_str() {
            "scenes" => scene_names.clone(),
            "filters" => builtin.clone(),
            _ if is_pattern(what) => match_names("list", what, &known)?,
            _ if known.contains(what) => vec![what.clone()],
            _ => Vec::new(),
        };
        if names.is_empty() && what != "scenes" {
            let suggestion = suggest_names(what, &known);
            refuse!(
                "list: no scene and no filter \"{what}\"; {suggestion} A filter of your own is listed by --filter FOLDER"
            );
        }
        let named = known_scenes
            .iter()
            .filter(|listing| names.contains(&listing.name));
        scenes.extend(named.cloned());
        for name in names.iter().filter(|name| builtin.contains(name)) {
            filters.push(Filter::builtin(name)?);
        }
    }
    for name in &args.filters {
        filters.extend(load_filters(name)?);
    }
    let is_users = |filter: &&Filter| !builtin.contains(&filter.name);
    let user_filters: Vec<&Filter> = filters.iter().filter(is_users).collect();
    try_filters(&user_filters, args.adapter.adapter.as_deref())?;
    Ok((scenes, filters))
}

/// Lists one adapter per line, numbered as for `--adapter`.
fn adapters_text() -> String {
    let line = |(number, adapter): (usize, &AdapterDescription)| {
        format!(
            "{number}: {} ({}, {}, {})\n",
            adapter.name, adapter.backend, adapter.driver, adapter.kind
        )
    };
    list_adapters().iter().enumerate().map(line).collect()
}

/// Checks kernels against the adapter's limits, and runs them with every preset and at both ends of
/// every range. Without an adapter, checks them against the lowest common limits, and says so.
fn try_filters(filters: &[&Filter], adapter: Option<&str>) -> Result<(), Error> {
    let have_kernels = filters.iter().any(|filter| filter.command.is_none());
    if !have_kernels && adapter.is_none() {
        return Ok(());
    }
    let gpu = match open_adapter(adapter, make_monitor().without_progress()) {
        Err(FilterError::NoAdapter) => None,
        gpu => Some(gpu?),
    };
    for filter in filters {
        gpu.as_ref()
            .map_or_else(Limits::lowest, Limits::of)
            .check(filter)?;
        if let Some(gpu) = &gpu {
            try_out(gpu, filter)?;
        }
    }
    if gpu.is_none() {
        print_note(
            "no GPU adapter was found: kernels were held to the lowest common limits, and no preset or range was tried",
        );
    }
    for filter in filters {
        for note in filter.list_notes() {
            print_note(&note);
        }
        if let Err(error) = Limits::lowest().check(filter) {
            print_note(&format!("other adapters may refuse this filter: {error}"));
        }
    }
    Ok(())
}
