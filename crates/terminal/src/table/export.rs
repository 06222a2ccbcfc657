//! Tables for other programs: CSV and Markdown, in files or printed.

use std::path::{Path, PathBuf};

use clap::Args;
use measure::Error;

use crate::output::print;

/// Other forms of a command's table.
#[derive(Debug, Args)]
#[command(next_help_heading = "Output")]
pub struct TableArgs {
    /// Write all numbers as CSV, one row per case, change or pass; `-` prints them instead of the
    /// table.
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Write the table as Markdown; `-` prints it instead of the table.
    #[arg(long, value_name = "FILE")]
    pub markdown: Option<PathBuf>,
}

impl TableArgs {
    /// Writes the requested forms. Returns whether one was printed.
    pub fn write(
        &self,
        csv: impl FnOnce() -> String,
        markdown: impl FnOnce() -> String,
    ) -> Result<bool, Error> {
        let csv = write_form(self.csv.as_deref(), csv)?;
        Ok(write_form(self.markdown.as_deref(), markdown)? || csv)
    }
}

/// Writes a form to a file, or prints it. Returns whether it was printed.
fn write_form(path: Option<&Path>, text: impl FnOnce() -> String) -> Result<bool, Error> {
    match path {
        None => Ok(false),
        Some(path) if path == Path::new("-") => print(text()).map(|()| true),
        Some(path) => {
            frame::write_atomically(path, text().as_bytes())?;
            Ok(false)
        }
    }
}

/// Makes a table of CSV, as RFC 4180 has it.
pub fn csv_table(titles: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let line = |cells: Vec<String>| {
        let cells: Vec<String> = cells.iter().map(|cell| csv_cell(cell)).collect();
        cells.join(",") + "\n"
    };
    let titles = titles.iter().map(|title| (*title).to_owned()).collect();
    let rows = rows.into_iter().map(line);
    std::iter::once(line(titles)).chain(rows).collect()
}

/// Writes a number for CSV; empty if there is none.
pub fn csv_number(value: Option<f64>) -> String {
    value.map_or(String::new(), |value| value.to_string())
}

fn csv_cell(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

#[test]
fn cells_with_separators_are_quoted() {
    let row = ["a", "b,c", "say \"d\"", "e\nf", ""].map(str::to_owned);
    let text = csv_table(&["1", "2", "3", "4", "5"], [row.to_vec()]);
    let due = "1,2,3,4,5\na,\"b,c\",\"say \"\"d\"\"\",\"e\nf\",\n";
    assert_eq!(text, due);
}
