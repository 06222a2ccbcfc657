//! The command `list`.

use clap::Args;
use filters::{AdapterDescription, Filter, list_adapters};
use suite::{Error, InputFormat};
use tracer::{SceneListing, list_scenes};

use super::try_filters::try_filters;
use crate::arguments::{AdapterArgs, RootArgs};
use crate::output::{print, print_json, print_note};
use crate::selection::{is_pattern, load_filters, match_names, suggest_names};
use crate::tables::{details_text, filter_json, filters_text, inputs_text, scenes_text};

#[derive(Debug, Args)]
pub struct ListArgs {
    /// Things to list: scenes, filters, inputs, adapters, or names or patterns of scenes and filters, which are shown in detail
    /// [default: scenes and filters].
    #[arg(value_name = "WHAT")]
    pub what: Vec<String>,
    /// Filters to list in detail: names, folders or patterns; repeatable, or separated by commas. A filter of your own is tried
    /// out with every preset and at both ends of every range.
    #[arg(
        long = "filter",
        visible_alias = "filters",
        value_delimiter = ',',
        value_name = "FILTERS"
    )]
    pub filters: Vec<String>,
    #[command(flatten)]
    pub root: RootArgs,
    #[command(flatten)]
    pub adapter: AdapterArgs,
    /// Print JSON.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

/// Scenes and filters to list.
#[derive(Default)]
struct Listing {
    scenes: Vec<SceneListing>,
    filters: Vec<Filter>,
}

/// Prints scenes and filters: in brief, or those that are named in detail.
pub fn execute(args: &ListArgs) -> Result<(), Error> {
    if args.what == ["adapters"] {
        return print_adapters();
    }
    if args.what == ["inputs"] {
        let kinds = InputFormat::kinds();
        return match args.json {
            true => print_json(&kinds),
            false => print(&inputs_text(&kinds)),
        };
    }
    let is_brief = args.filters.is_empty()
        && args
            .what
            .iter()
            .all(|what| ["scenes", "filters"].contains(&what.as_str()));
    let listing = match is_brief {
        true => list_all(args)?,
        false => list_named(args)?,
    };
    let Listing { scenes, filters } = &listing;
    if args.json {
        return print_json(&serde_json::json!({
            "scenes": scenes,
            "filters": filters.iter().map(filter_json).collect::<Vec<_>>(),
        }));
    }
    if !is_brief {
        return print(&details_text(scenes, filters));
    }
    let mut text = String::new();
    if !scenes.is_empty() {
        text += &scenes_text(scenes);
    }
    if !filters.is_empty() {
        text += &filters_text(filters);
    }
    print(&(text + "details: shuttertruth list NAME\n"))
}

/// Lists all scenes, all filters, or both.
fn list_all(args: &ListArgs) -> Result<Listing, Error> {
    let wants = |what: &str| args.what.is_empty() || args.what.iter().any(|own| own == what);
    let mut listing = Listing::default();
    if args.what.is_empty() && !args.root.scenes_dir.is_dir() {
        let folder = &args.root.scenes_dir;
        print_note(&format!(
            "no scenes: there is no folder {folder}; --scenes-dir names another one"
        ));
    } else if wants("scenes") {
        listing.scenes = list_scenes(&args.root.scenes_dir)?;
    }
    if wants("filters") {
        listing.filters = builtin_filters()?;
    }
    Ok(listing)
}

/// Lists the scenes and filters that are named. Tries out filters of the user's own.
fn list_named(args: &ListArgs) -> Result<Listing, Error> {
    let builtin = Filter::builtin_names();
    // Built-in filters can be listed where there are no scenes.
    let needs_scenes = args.what.iter().any(|what| !builtin.contains(what));
    let scenes = match needs_scenes && args.root.scenes_dir.is_dir() {
        true => list_scenes(&args.root.scenes_dir)?,
        false => Vec::new(),
    };
    let mut listing = Listing::default();
    for what in &args.what {
        find_named(what, &scenes, &mut listing)?;
    }
    for name in &args.filters {
        listing.filters.extend(load_filters(name)?);
    }
    let own: Vec<Filter> = (listing.filters.iter())
        .filter(|filter| !builtin.contains(&filter.name))
        .cloned()
        .collect();
    try_filters(&own, args.adapter.adapter.as_deref())?;
    Ok(listing)
}

/// Adds the scenes and filters that a name or a pattern means.
fn find_named(what: &str, scenes: &[SceneListing], listing: &mut Listing) -> Result<(), Error> {
    let filters = Filter::builtin_names();
    let scene_names: Vec<String> = scenes.iter().map(|scene| scene.name.clone()).collect();
    let known: Vec<String> = scene_names.iter().chain(&filters).cloned().collect();
    let names = match what {
        "scenes" => scene_names,
        "filters" => filters.clone(),
        _ if is_pattern(what) => match_names("list", what, &known)?,
        _ => vec![what.to_owned()],
    };
    if names.is_empty() || !names.iter().all(|name| known.contains(name)) {
        let suggestion = suggest_names(what, &known);
        refuse!(
            "list: no scene and no filter \"{what}\"; {suggestion} A filter of your own is listed by --filter FOLDER"
        );
    }
    let named = scenes.iter().filter(|scene| names.contains(&scene.name));
    listing.scenes.extend(named.cloned());
    for name in names.iter().filter(|name| filters.contains(name)) {
        listing.filters.push(Filter::builtin(name)?);
    }
    Ok(())
}

fn builtin_filters() -> Result<Vec<Filter>, Error> {
    let names = Filter::builtin_names();
    let filters = names.iter().map(|name| Filter::builtin(name));
    Ok(filters.collect::<Result<_, _>>()?)
}

/// Prints one adapter a line, numbered as `--adapter` takes them.
fn print_adapters() -> Result<(), Error> {
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
