//! Scenes that no trial ran on: looked at when all is decided, and every look is counted.

use std::collections::BTreeMap;
use std::path::Path;

use filters::Value;
use frame::write_atomically;
use serde::{Deserialize, Serialize};

use super::Paired;
use crate::Error;
use crate::json::file::read_text;

/// One look at the sealed scenes: a line of `openings.jsonl`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Opening {
    /// From 1. A set that was opened often is one that was tuned on.
    pub opening: usize,
    /// The values that were compared with the start.
    pub values: BTreeMap<String, Value>,
    /// Pixels per row, rows, samples per pixel.
    pub render: [u32; 3],
    /// Start and choice on the sealed scenes.
    pub paired: Paired,
}

/// All looks so far.
pub fn openings(path: &Path) -> Result<Vec<Opening>, Error> {
    if !path.exists() {
        return Ok(Vec::new());
    }
    let text = read_text(path)?;
    let line = |(index, line): (usize, &str)| {
        serde_json::from_str(line).map_err(|error| {
            Error::Usage(format!(
                "{}:{}: no opening of a sealed set: {error}; choose another --out",
                path.display(),
                index + 1
            ))
        })
    };
    text.lines().enumerate().map(line).collect()
}

/// Records a look. The same values on the same scenes say nothing new and count once.
pub fn record(
    path: &Path,
    values: &BTreeMap<String, Value>,
    render: [u32; 3],
    paired: Paired,
) -> Result<Vec<Opening>, Error> {
    let mut all = openings(path)?;
    let known = all
        .iter()
        .any(|it| it.values == *values && it.render == render && it.paired.scenes == paired.scenes);
    if !known {
        all.push(Opening {
            opening: all.len() + 1,
            values: values.clone(),
            render,
            paired,
        });
        let lines = all
            .iter()
            .map(|it| serde_json::to_string(it).expect("an opening is plain data") + "\n");
        write_atomically(path, lines.collect::<String>().as_bytes())?;
    }
    Ok(all)
}
