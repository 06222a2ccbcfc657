//! File of bounds, `bounds.toml`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use metrics::Metric;
use serde::Deserialize;
use store::{printable, printable_path, read_text};
use suite::{Error, SIDES};
use toml::Spanned;
use tracer::Location;

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
    /// Margins by their scores.
    pub margins: BTreeMap<Metric, Margin>,
}

/// Bounds of a filter, or of one preset of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilterBounds {
    /// File and line.
    pub place: String,
    /// Bounds by their scores.
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
    let path = file.path.as_path();
    let source = Source { path, text: &text };
    let contents: Contents = toml::from_str(&text)
        .map_err(|error| source.refuse(error.span().map(|span| span.start), error.message()))?;
    let filters = (contents.filter.into_iter())
        .map(|(name, entries)| {
            let table = FilterBounds {
                place: source.place(Some(name.span().start)),
                bounds: source.bounds(entries)?,
            };
            Ok((name.into_inner(), table))
        })
        .collect::<Result<_, Error>>()?;
    Ok(BoundsFile {
        path: path.to_owned(),
        default: source.bounds(contents.default)?,
        filters,
        margins: source.margins(contents.margin)?,
    })
}

/// Text of a file, to find the lines of mistakes.
struct Source<'a> {
    path: &'a Path,
    text: &'a str,
}

impl Source<'_> {
    fn bounds(&self, entries: Tables<Entry>) -> Result<Bounds, Error> {
        (entries.into_iter())
            .map(|(name, entry)| {
                let start = name.span().start;
                let refuse = |reason: &str| self.refuse(Some(start), reason);
                let metric =
                    Metric::parse_bounded(name.get_ref()).map_err(|reason| refuse(&reason))?;
                let Entry {
                    limit,
                    size,
                    frames,
                    fps,
                    why,
                    level,
                } = entry;
                if !limit.is_finite() {
                    return Err(refuse(&format!(
                        "{metric}: limit = {limit}; allowed: a finite number"
                    )));
                }
                if let Some((width, height)) = size
                    && ![width, height].iter().all(|side| SIDES.contains(side))
                {
                    return Err(refuse(&format!(
                        "{metric}: size = [{width}, {height}]; allowed: columns and rows from {} to {}",
                        SIDES.start(),
                        SIDES.end()
                    )));
                }
                let length =
                    Length::check(metric, frames, fps).map_err(|reason| refuse(&reason))?;
                let why = why.unwrap_or_default();
                if printable(&why) != why {
                    return Err(refuse(&format!(
                        "{metric}: why = \"{}\"; allowed: one line of text without control characters",
                        printable(&why)
                    )));
                }
                if why.trim().is_empty() {
                    return Err(refuse(&format!(
                        "{metric}: has no why; needed: one line on what was measured, why = \"..\""
                    )));
                }
                let bound = Bound {
                    limit,
                    size,
                    length,
                    why,
                    level,
                    place: self.place(Some(start)),
                };
                Ok((metric, bound))
            })
            .collect()
    }

    fn margins(&self, entries: Tables<f64>) -> Result<BTreeMap<Metric, Margin>, Error> {
        (entries.into_iter())
            .map(|(name, width)| {
                let start = name.span().start;
                let refuse = |reason: &str| self.refuse(Some(start), reason);
                let metric =
                    Metric::from_str(name.get_ref()).map_err(|reason| refuse(&reason))?;
                if !Metric::all().contains(&metric) {
                    return Err(refuse(&format!(
                        "margin of {metric}: baselines hold scores of single frames only; give it a limit instead"
                    )));
                }
                if !(width.is_finite() && width >= 0.0) {
                    return Err(refuse(&format!(
                        "margin of {metric} is {width}; allowed: 0 or more"
                    )));
                }
                let place = self.place(Some(start));
                Ok((metric, Margin { width, place }))
            })
            .collect()
    }

    fn refuse(&self, offset: Option<usize>, reason: &str) -> Error {
        Error::Usage(format!("{}: {reason}", self.place(offset)))
    }

    /// Formats a place in the file: `scenes/bounds.toml:12`.
    fn place(&self, offset: Option<usize>) -> String {
        let path = printable_path(self.path);
        match offset {
            Some(offset) => {
                let line = self.text[..offset].matches('\n').count() + 1;
                format!("{path}:{line}")
            }
            None => path,
        }
    }
}
