//! File of bounds, `bounds.toml`.

use std::collections::BTreeMap;
use std::path::PathBuf;

use frame::Size;
use measure::{Error, SIDES, printable, printable_path, read_text};
use metrics::Metric;
use scene::Location;
use serde::Deserialize;
use toml::Spanned;

use crate::bounds::{Bound, Bounds, Length, Level};

/// Contents of a bounds.toml.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BoundsFile {
    /// Path of the file.
    pub path: PathBuf,
    /// Bounds for every filter.
    pub default: Bounds,
    /// Bounds for one filter, by its name, or one preset of it, by `filter:preset`.
    pub filters: BTreeMap<String, FilterBounds>,
    /// Margins by score.
    pub margins: BTreeMap<Metric, Margin>,
}

impl BoundsFile {
    /// Lists the bounds for every filter, then those for single ones.
    pub(super) fn tables_mut(&mut self) -> impl Iterator<Item = &mut Bounds> {
        let filters = self.filters.values_mut().map(|table| &mut table.bounds);
        std::iter::once(&mut self.default).chain(filters)
    }
}

/// Bounds of a filter, or of one preset of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilterBounds {
    /// File and line.
    pub place: String,
    /// Bounds by score.
    pub bounds: Bounds,
}

/// Amount by which a score may be worse than the baseline's, in its unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Margin {
    /// Width of the margin, 0 or more.
    pub width: f64,
    /// File and line.
    pub place: String,
}

type Tables<T> = BTreeMap<Spanned<String>, T>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Contents {
    #[serde(default)]
    default: Tables<Entry>,
    #[serde(default)]
    filter: Tables<Tables<Entry>>,
    #[serde(default)]
    margin: Tables<f64>,
}

#[derive(Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "a bound is a table: { limit = 0.1, why = \"what was measured\", level = \"required\" or \"report\" }"
)]
struct Entry {
    limit: f64,
    size: Option<(u32, u32)>,
    frames: Option<u32>,
    fps: Option<f64>,
    why: Option<String>,
    #[serde(default)]
    level: Level,
}

/// Reads a bounds.toml. [`check_names`](super::check_names) checks that its filters exist.
pub fn read_bounds_file(file: impl Into<Location>) -> Result<BoundsFile, Error> {
    let file = file.into();
    let text = read_text(&file)?;
    let path = printable_path(&file.path);
    let place = |offset: usize| format!("{path}:{}", text[..offset].matches('\n').count() + 1);
    let contents: Contents = toml::from_str(&text).map_err(|error| {
        let place = error.span().map_or(path.clone(), |span| place(span.start));
        Error::Refused(format!("{place}: {}", error.message()))
    })?;
    let read_bounds = |entries| read_entries(entries, &place, read_bound);
    let filters = (contents.filter.into_iter())
        .map(|(name, entries)| {
            let table = FilterBounds {
                place: place(name.span().start),
                bounds: read_bounds(entries)?,
            };
            Ok((name.into_inner(), table))
        })
        .collect::<Result<_, Error>>()?;
    Ok(BoundsFile {
        path: file.path,
        default: read_bounds(contents.default)?,
        filters,
        margins: read_entries(contents.margin, &place, read_margin)?,
    })
}

/// Reads the name of a score, its entry and its place.
type ReadEntry<T, U> = fn(&str, T, String) -> Result<(Metric, U), String>;

/// Reads a table of entries by score.
fn read_entries<T, U>(
    entries: Tables<T>,
    place: &dyn Fn(usize) -> String,
    read: ReadEntry<T, U>,
) -> Result<BTreeMap<Metric, U>, Error> {
    (entries.into_iter())
        .map(|(name, entry)| {
            let place = place(name.span().start);
            read(name.get_ref(), entry, place.clone())
                .map_err(|reason| Error::Refused(format!("{place}: {reason}")))
        })
        .collect()
}

fn read_bound(name: &str, entry: Entry, place: String) -> Result<(Metric, Bound), String> {
    let metric = Metric::parse_bounded(name)?;
    let limit = entry.limit;
    if !limit.is_finite() {
        return Err(format!(
            "{metric}: limit = {limit}; allowed: a finite number"
        ));
    }
    if let Some((width, height)) = entry.size
        && ![width, height].iter().all(|side| SIDES.contains(side))
    {
        return Err(format!(
            "{metric}: size = [{width}, {height}]; allowed: columns and rows from {} to {}",
            SIDES.start(),
            SIDES.end()
        ));
    }
    let length = Length::check(metric, entry.frames, entry.fps)?;
    let why = entry.why.unwrap_or_default();
    if printable(&why) != why {
        return Err(format!(
            "{metric}: why = \"{}\"; allowed: one line of text without control characters",
            printable(&why)
        ));
    }
    if why.trim().is_empty() {
        return Err(format!(
            "{metric}: has no why; needed: one line on what was measured, why = \"..\""
        ));
    }
    let bound = Bound {
        limit,
        size: entry.size.map(Size::from),
        length,
        why,
        level: entry.level,
        place,
    };
    Ok((metric, bound))
}

fn read_margin(name: &str, width: f64, place: String) -> Result<(Metric, Margin), String> {
    let metric: Metric = name.parse()?;
    if !Metric::all().contains(&metric) {
        return Err(format!(
            "margin of {metric}: baselines hold scores of single frames only; give it a limit instead"
        ));
    }
    if width.is_finite() && width >= 0.0 {
        Ok((metric, Margin { width, place }))
    } else {
        Err(format!("margin of {metric} is {width}; allowed: 0 or more"))
    }
}
