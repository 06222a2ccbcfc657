//! Journal of a tuning: a file with one line per trial, written before the next trial begins.

use std::fs::{File, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use frame::FileError;
use measure::{Error, read_text};
use serde::Serialize;
use serde_json::Value;

use crate::trial::{JOURNAL_FORMAT, JournalHeader, Trial};

/// Characters of a setting in an error.
const MAX_SHOWN: usize = 80;

/// A journal that can be appended to.
pub struct Journal {
    path: PathBuf,
    file: File,
    /// Trials so far.
    pub trials: Vec<Trial>,
}

impl Journal {
    /// Opens the journal at `path`, or begins it. Cuts off a line that a killed process left
    /// half-written: its trial is run again. Refuses another command's journal.
    pub fn open(path: &Path, header: &JournalHeader) -> Result<Self, Error> {
        let fail = |action, source| FileError::io(path, action, source);
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(|error| fail("write", error))?;
        }
        // Read before it is opened for writing: a FIFO would block, and /dev/zero never ends.
        let text = if path.exists() {
            read_text(path)?
        } else {
            String::new()
        };
        let mut options = OpenOptions::new();
        let mut file = (options.write(true).create(true).truncate(false))
            .open(path)
            .map_err(|error| fail("write", error))?;
        let whole = text.rfind('\n').map_or(0, |end| end + 1);
        // Nothing is cut off before the file is known to be this command's.
        match text[..whole].lines().next() {
            Some(line) => check_header(path, line, header)?,
            None if line_of(header).starts_with(&text) => {}
            None => return Err(journal_error(path, 0, "is no journal of a tuning")),
        }
        file.set_len(whole as u64)
            .and_then(|()| file.seek(SeekFrom::End(0)))
            .map_err(|error| fail("write", error))?;
        let mut journal = Self {
            path: path.to_owned(),
            file,
            trials: Vec::new(),
        };
        let mut lines = text[..whole].lines();
        if lines.next().is_none() {
            journal.write(header)?;
        }
        journal.trials = parse_trials(path, lines, header)?;
        Ok(journal)
    }

    /// Writes a trial to the disk.
    pub fn append(&mut self, trial: Trial) -> Result<(), Error> {
        self.write(&trial)?;
        self.trials.push(trial);
        Ok(())
    }

    fn write(&mut self, line: &impl Serialize) -> Result<(), Error> {
        let text = line_of(line);
        let written = (self.file.write_all(text.as_bytes())).and_then(|()| self.file.sync_data());
        written.map_err(|source: io::Error| {
            Error::Refused(format!(
                "{}: cannot be written: {source}; its {} whole trials are safe: make room and run the same command again, \
                 which goes on after them",
                self.path.display(),
                self.trials.len()
            ))
        })
    }
}

/// Reads the complete lines of the journal at `path`: the last line of a running tuning may be
/// half-written. None without any.
pub fn read_journal(path: &Path) -> Result<Option<(JournalHeader, Vec<Trial>)>, Error> {
    if !path.exists() {
        return Ok(None);
    }
    let text = read_text(path)?;
    let whole = text.rfind('\n').map_or(0, |end| end + 1);
    let mut lines = text[..whole].lines();
    let Some(first) = lines.next() else {
        return Ok(None);
    };
    let header: JournalHeader = serde_json::from_str(first)
        .map_err(|error| journal_error(path, 0, &format!("is no journal of a tuning: {error}")))?;
    if header.format != JOURNAL_FORMAT {
        let reason = format!("has format {}; allowed: {JOURNAL_FORMAT}", header.format);
        return Err(journal_error(path, 0, &reason));
    }
    let trials = parse_trials(path, lines, &header)?;
    Ok(Some((header, trials)))
}

/// Parses the lines after the first, one trial each.
fn parse_trials<'a>(
    path: &Path,
    lines: impl Iterator<Item = &'a str>,
    header: &JournalHeader,
) -> Result<Vec<Trial>, Error> {
    let parse = |(number, line): (usize, &str)| {
        let trial: Result<Trial, String> =
            serde_json::from_str(line).map_err(|error| format!("is no trial: {error}"));
        let checked = trial.and_then(|trial| trial.check(header, number).map(|()| trial));
        checked.map_err(|reason| journal_error(path, number + 1, &reason))
    };
    lines.enumerate().map(parse).collect()
}

/// Returns a line of a journal, or of the results on held-out scenes, with its end.
pub fn line_of(content: &impl Serialize) -> String {
    serde_json::to_string(content).expect("a line is plain data") + "\n"
}

/// Makes the error about a line of a journal; the first line has index 0.
pub fn journal_error(path: &Path, index: usize, reason: &str) -> Error {
    Error::Refused(format!(
        "{}:{}: {reason}; choose another output folder, or delete the file to begin anew",
        path.display(),
        index + 1
    ))
}

/// Refuses a header that differs from the expected one; names the first differing setting, and how
/// to continue the journal.
fn check_header(path: &Path, line: &str, expected: &JournalHeader) -> Result<(), Error> {
    let header: Value = serde_json::from_str(line)
        .map_err(|error| journal_error(path, 0, &format!("is no journal of a tuning: {error}")))?;
    let expected = serde_json::to_value(expected).expect("a header is plain data");
    let fields = expected.as_object().expect("a header is a table");
    let mut names: Vec<&String> = fields.keys().collect();
    // The search's first points follow from all other settings.
    names.sort_by_key(|name| *name == "design");
    let Some(name) = names
        .into_iter()
        .find(|name| header[*name] != fields[*name])
    else {
        return Ok(());
    };
    let (value, expected) = first_difference(&header[name], &fields[name]);
    let way_out = match name.as_str() {
        "seed" => format!("; to go on with it, search with the seed {value}"),
        _ => "; to go on with it, run the command that began it".to_owned(),
    };
    let reason = format!(
        "it was begun with another {name}: found {value}, this command has {expected}{way_out}"
    );
    Err(journal_error(path, 0, &reason))
}

/// Finds the first differing part of two values, as short texts.
fn first_difference(value: &Value, expected: &Value) -> (String, String) {
    let inner = match (value, expected) {
        (Value::Array(one), Value::Array(other)) if one.len() == other.len() => {
            let mut pairs = one.iter().zip(other);
            let differs = pairs.find(|(one, other)| one != other);
            differs.map(|(one, other)| first_difference(one, other))
        }
        (Value::Object(one), Value::Object(other)) if one.keys().eq(other.keys()) => {
            let mut pairs = one.iter().zip(other.values());
            let differs = pairs.find(|((_, one), other)| one != other);
            differs.map(|((name, one), other)| {
                let (one, other) = first_difference(one, other);
                (format!("{name} {one}"), format!("{name} {other}"))
            })
        }
        _ => None,
    };
    inner.unwrap_or_else(|| (short_text(value), short_text(expected)))
}

/// Formats a value, shortened to fit a line.
fn short_text(value: &Value) -> String {
    let text = value.to_string();
    match text.char_indices().nth(MAX_SHOWN) {
        None => text,
        Some((end, _)) => format!("{}...", &text[..end]),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn the_first_difference_is_short_and_names_its_place() {
        let texts = |value, expected| first_difference(&value, &expected);
        let pair = |one: &str, other: &str| (one.to_owned(), other.to_owned());
        assert_eq!(texts(json!(1), json!(2)), pair("1", "2"));
        assert_eq!(
            texts(
                json!([[0.1, 0.2], [0.3, 0.4]]),
                json!([[0.1, 0.2], [0.3, 0.5]])
            ),
            pair("0.4", "0.5")
        );
        assert_eq!(
            texts(json!({"a": 1, "taps": 2}), json!({"a": 1, "taps": 3})),
            pair("taps 2", "taps 3")
        );
        let (text, _) = texts(json!(vec![1; 5000]), json!([]));
        assert!(text.ends_with("...") && text.len() < 100, "{text}");
    }
}
