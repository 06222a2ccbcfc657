//! Results on held-out scenes, which no trial uses: evaluated once at the end, and every evaluation
//! is counted.

use std::collections::BTreeMap;
use std::path::Path;

use filters::Value;
use frame::write_atomically;
use measure::{Error, read_text};
use serde::{Deserialize, Serialize};

use crate::comparison::PairedComparison;
use crate::journal::line_of;

/// One comparison of start and choice on the held-out scenes: a line of `openings.jsonl`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeldOutResult {
    /// Number of the evaluation, from 1. Evaluating scenes often amounts to tuning on them.
    #[serde(rename = "opening")]
    pub number: usize,
    /// Values compared with the start.
    pub values: BTreeMap<String, Value>,
    /// Pixels per row, rows, samples per pixel.
    pub render: [u32; 3],
    /// Start and choice on the held-out scenes.
    pub paired: PairedComparison,
}

/// Reads all results so far.
fn read_held_out_results(path: &Path) -> Result<Vec<HeldOutResult>, Error> {
    if !path.exists() {
        return Ok(Vec::new());
    }
    let text = read_text(path)?;
    let line = |(index, line): (usize, &str)| {
        serde_json::from_str(line).map_err(|error| {
            Error::Refused(format!(
                "{}:{}: is no result on held-out scenes: {error}; choose another output folder",
                path.display(),
                index + 1
            ))
        })
    };
    text.lines().enumerate().map(line).collect()
}

/// Adds a result to the file. The same values on the same scenes add no information and count once.
pub fn record_held_out_result(
    path: &Path,
    values: &BTreeMap<String, Value>,
    render: [u32; 3],
    paired: PairedComparison,
) -> Result<Vec<HeldOutResult>, Error> {
    let mut all = read_held_out_results(path)?;
    let known = all.iter().any(|result| {
        result.values == *values && result.render == render && result.paired.scenes == paired.scenes
    });
    if !known {
        all.push(HeldOutResult {
            number: all.len() + 1,
            values: values.clone(),
            render,
            paired,
        });
        let lines: String = all.iter().map(line_of).collect();
        write_atomically(path, lines.as_bytes())?;
    }
    Ok(all)
}
