//! Results of commands: as files, as tables or JSON, and as exit codes.

use std::path::Path;

use measure::{Error, printable_path};
use serde::Serialize;

use crate::output::{Text, print};

/// How a command that did its work ended.
pub enum Ending {
    /// Without anything more to report.
    Done,
    /// A check failed or is undecided, and has printed that.
    Failed(Error),
}

/// Writes a result to a file as JSON, and returns the JSON.
pub fn write_json(path: &Path, result: &impl Serialize) -> Result<String, Error> {
    let json = serde_json::to_string_pretty(result).expect("a result is plain data");
    frame::write_atomically(path, json.as_bytes())?;
    Ok(json)
}

/// Writes a result to a file as JSON; then prints the JSON, or its table and the file's name.
pub fn write_result(
    path: &Path,
    result: &impl Serialize,
    table: impl Into<Text>,
    as_json: bool,
) -> Result<(), Error> {
    let json = write_json(path, result)?;
    if as_json {
        print(format!("{json}\n"))
    } else {
        print(table.into() + format!("\nwritten: {}\n", printable_path(path)))
    }
}
