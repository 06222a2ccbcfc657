//! What `tune` leaves in its folder.

use std::fs;
use std::path::{Path, PathBuf};

use frame::FileError;
use serde::de::DeserializeOwned;

use crate::{Error, Header, JOURNAL_FORMAT, Sensitivity, TUNE_FORMAT, Trial, Tuning};

/// What is there of tune.json, journal.jsonl and sensitivity.json; at least one is.
#[derive(Clone, Debug)]
pub struct TuneFolder {
    /// The folder.
    pub path: PathBuf,
    /// None of a tuning that is not finished, or of a study of sensitivity alone.
    pub tuning: Option<Tuning>,
    /// The journal's first line.
    pub header: Option<Header>,
    /// All whole lines of the journal behind it.
    pub trials: Vec<Trial>,
    /// Of `tune --morris` or `--sobol`.
    pub sensitivity: Option<Sensitivity>,
}

impl TuneFolder {
    /// Reads a folder that `tune --out` wrote; refuses files of another version, and a folder without any.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let (header, trials) = journal(&path.join("journal.jsonl"))?;
        let tuning: Option<Tuning> = json(&path.join("tune.json"))?;
        if let Some(tuning) = &tuning {
            check_format(&path.join("tune.json"), tuning.format, TUNE_FORMAT)?;
        }
        let folder = Self {
            path: path.to_owned(),
            header,
            trials,
            tuning,
            sensitivity: json(&path.join("sensitivity.json"))?,
        };
        match (&folder.header, &folder.sensitivity) {
            (None, None) => Err(Error::Usage(format!(
                "{}: holds neither a run.json nor a journal.jsonl or sensitivity.json; `shuttertruth run` and `tune` write \
                 such folders",
                path.display()
            ))),
            _ => Ok(folder),
        }
    }
}

/// None where there is no such file.
fn text(path: &Path) -> Result<Option<String>, Error> {
    if !path.is_file() {
        return Ok(None);
    }
    let text = fs::read_to_string(path).map_err(|source| FileError::io(path, "read", source))?;
    Ok(Some(text))
}

fn json<T: DeserializeOwned>(path: &Path) -> Result<Option<T>, Error> {
    let parsed = text(path)?.map(|text| parse(&text, &path.display().to_string()));
    parsed.transpose()
}

fn parse<T: DeserializeOwned>(text: &str, place: &str) -> Result<T, Error> {
    serde_json::from_str(text).map_err(|error| {
        Error::Usage(format!(
            "{place}: not of this program: {error}; `shuttertruth tune` writes it anew in another --out"
        ))
    })
}

/// The whole lines: the last one may be half written while a tuning goes on.
fn journal(path: &Path) -> Result<(Option<Header>, Vec<Trial>), Error> {
    let Some(text) = text(path)? else {
        return Ok((None, Vec::new()));
    };
    let whole = text.rfind('\n').map_or(0, |end| end + 1);
    let mut lines = text[..whole].lines().zip(1..);
    let Some((first, _)) = lines.next() else {
        return Ok((None, Vec::new()));
    };
    let header: Header = parse(first, &format!("{}:1", path.display()))?;
    check_format(path, header.format, JOURNAL_FORMAT)?;
    let trial =
        |(line, number): (&str, usize)| parse(line, &format!("{}:{number}", path.display()));
    Ok((Some(header), lines.map(trial).collect::<Result<_, _>>()?))
}

fn check_format(path: &Path, found: u32, allowed: u32) -> Result<(), Error> {
    match found == allowed {
        true => Ok(()),
        false => Err(Error::Usage(format!(
            "{}: has format {found}; allowed: {allowed}; tune anew with this version",
            path.display()
        ))),
    }
}
