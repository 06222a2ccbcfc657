//! A result in a JSON file, printed as a table or as JSON.

use std::path::PathBuf;

use store::printable_path;
use suite::Error;

use crate::output::print;

/// A result, for people and for machines.
pub struct CommandResult {
    /// The result as a table.
    pub table: String,
    /// The result as JSON.
    pub json: String,
    /// File that holds the JSON.
    pub path: PathBuf,
}

impl CommandResult {
    /// Prints the table and names the file; or prints the JSON.
    pub fn print(&self, as_json: bool) -> Result<(), Error> {
        let Self { table, json, path } = self;
        match as_json {
            true => print(&format!("{json}\n")),
            false => print(&format!("{table}\nwritten: {}\n", printable_path(path))),
        }
    }
}
