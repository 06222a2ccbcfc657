//! Contents of pages that other crates own.

use std::collections::HashMap;
use std::path::Path;

use maud::Markup;
use measure::{Error, FilterId, Run};

/// Makes contents of the page of a run, whose files are in a folder.
pub type AddToPage = fn(&Run, &Path) -> Result<Addition, Error>;

/// Contents that another crate adds to the page of a run.
pub struct Addition {
    /// Section of the overview, below the tables of scores.
    pub section: Markup,
    /// A number of every filter; none if nothing was measured.
    pub column: Option<FilterColumn>,
}

impl Addition {
    /// Returns all contents as text, by which equal ones are known.
    pub fn text(&self) -> String {
        let mut text = self.section.0.clone();
        if let Some(column) = &self.column {
            let mut numbers: Vec<String> = (column.numbers.iter())
                .map(|(filter, number)| format!("{filter:?} {} {}", number.value, number.text))
                .collect();
            numbers.sort();
            text += &format!("{} {} {}", column.name, column.unit, numbers.join("\n"));
        }
        text
    }
}

/// A number of every filter: a column of the tables of scores, and a line of the filter's section.
pub struct FilterColumn {
    /// Name, which is also the style of the cells: `cost`.
    pub name: &'static str,
    /// Unit: `ms`.
    pub unit: &'static str,
    /// Numbers of the filters that have one.
    pub numbers: HashMap<FilterId, FilterNumber>,
}

/// A number with its text.
pub struct FilterNumber {
    /// Value, by which the tables are sorted.
    pub value: f64,
    /// Text without the unit.
    pub text: String,
}

impl FilterColumn {
    /// Returns the value of a filter; none without a number.
    pub(crate) fn value(&self, filter: &FilterId) -> Option<f64> {
        self.numbers.get(filter).map(|number| number.value)
    }

    /// Returns the text of a filter; `-` without a number.
    pub(crate) fn text(&self, filter: &FilterId) -> &str {
        (self.numbers.get(filter)).map_or("-", |number| &number.text)
    }
}

/// Lists the columns of additions.
pub(crate) fn columns(additions: &[Addition]) -> impl Iterator<Item = &FilterColumn> {
    additions
        .iter()
        .filter_map(|addition| addition.column.as_ref())
}

/// A kind of folder that holds no run and has a page of its own.
pub struct FolderPage {
    /// Name in errors: `tuning`.
    pub kind: &'static str,
    /// Finds the folder that a path leads to; none if it holds another kind of files.
    pub find: fn(&Path) -> Option<&Path>,
    /// Makes the page of the folder.
    pub make: fn(&Path) -> Result<String, Error>,
}
