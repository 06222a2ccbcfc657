//! Files that `tune` leaves in its folder.

use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use store::read_text;
use suite::Error;
use tune::{JOURNAL_FORMAT, JournalHeader, Sensitivity, TUNE_FORMAT, Trial, Tuning};

/// Contents of tune.json, journal.jsonl and sensitivity.json; at least one is there.
#[derive(Clone, Debug)]
pub struct TuneFolder {
    /// The folder.
    pub path: PathBuf,
    /// Outcome; none of a tuning that is not finished, or of a study of sensitivity alone.
    pub tuning: Option<Tuning>,
    /// The journal's first line.
    pub header: Option<JournalHeader>,
    /// All whole lines of the journal behind it.
    pub trials: Vec<Trial>,
    /// Result of `sensitivity`.
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

/// Reads a text; none where there is no such file.
fn text(path: &Path) -> Result<Option<String>, Error> {
    if !path.exists() {
        return Ok(None);
    }
    Ok(Some(read_text(path)?))
}

fn json<T: DeserializeOwned>(path: &Path) -> Result<Option<T>, Error> {
    let parsed = text(path)?.map(|text| parse(&text, &path.display().to_string()));
    parsed.transpose()
}

fn parse<T: DeserializeOwned>(text: &str, place: &str) -> Result<T, Error> {
    serde_json::from_str(text).map_err(|error| {
        Error::Usage(format!(
            "{place}: not of this program: {error}; `shuttertruth tune search` writes it anew into another folder"
        ))
    })
}

/// Reads the whole lines: the last one may be half written while a tuning goes on.
fn journal(path: &Path) -> Result<(Option<JournalHeader>, Vec<Trial>), Error> {
    let Some(text) = text(path)? else {
        return Ok((None, Vec::new()));
    };
    let whole = text.rfind('\n').map_or(0, |end| end + 1);
    let mut lines = text[..whole].lines().zip(1..);
    let Some((first, _)) = lines.next() else {
        return Ok((None, Vec::new()));
    };
    let header: JournalHeader = parse(first, &format!("{}:1", path.display()))?;
    check_format(path, header.format, JOURNAL_FORMAT)?;
    let trial = |(line, number): (&str, usize)| {
        let place = format!("{}:{number}", path.display());
        let trial: Trial = parse(line, &place)?;
        // The header is the first line.
        match trial.check(&header, number - 2) {
            Ok(()) => Ok(trial),
            Err(reason) => Err(Error::Usage(format!(
                "{place}: {reason}; `shuttertruth tune search` writes it anew into another folder"
            ))),
        }
    };
    let trials = lines.map(trial).collect::<Result<_, Error>>()?;
    Ok((Some(header), trials))
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
