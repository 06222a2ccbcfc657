//! Records of earlier measurements: case.json and frame.json, with valid seals.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use serde::Serialize;
use serde_json::Value;
use suite::Case;

use super::command_line::shuttertruth;
use crate::fixture::{RENDER, files};
use crate::place::Place;
use crate::seeds::Seed;
use crate::target::{Shape, Target};
use crate::tokens;

/// Records that the same `run` reads back.
pub static TARGET: Target = Target {
    name: "records",
    share: 50,
    batch: 25,
    shape: Shape::Text,
    tokens: tokens::JSON,
    seeds: |place| {
        let out = place.fixture.join("out");
        let records = [files(&out, "case.json"), files(&out, "frame.json")].concat();
        let seeds = records
            .iter()
            .map(|path| Seed::Bytes(fs::read(path).unwrap()));
        seeds.collect()
    },
    run: |place, input| {
        place.copy("scenes");
        place.copy_again("out");
        fs::write(record(place, input), add_seal(input)).unwrap();
        let filters = ["--filters", "velocity_gather:departure,mcguire:paper"];
        let words = [&["run"], &RENDER[..], &filters, &["--out", "out"]].concat();
        shuttertruth(place, &words);
    },
};

/// Returns the path of a record of this kind.
fn record(place: &Place, input: &[u8]) -> PathBuf {
    let is_frame = input.windows(9).any(|it| it == b"frame.exr");
    let end = match is_frame {
        true => "frame.json",
        false => "case.json",
    };
    let found = files(&place.folder.join("out"), end);
    found.first().expect("a run leaves records").clone()
}

/// Gives a record a valid seal; leaves anything else unchanged.
fn add_seal(input: &[u8]) -> Vec<u8> {
    let Ok(mut record) = serde_json::from_slice::<Value>(input) else {
        return input.to_vec();
    };
    let parts = (
        record["inputs"].as_str().map(str::to_owned),
        serde_json::from_value::<BTreeMap<String, String>>(record["files"].clone()),
    );
    let (Some(inputs), Ok(files)) = parts else {
        return input.to_vec();
    };
    let seal = match serde_json::from_value::<Case>(record["made"].clone()) {
        Ok(case) => seal(&inputs, &files, &case),
        Err(_) => seal(&inputs, &files, &()),
    };
    if let Some(table) = record.as_object_mut() {
        table.insert("seal".to_owned(), seal.into());
    }
    serde_json::to_vec(&record).expect("JSON stays JSON")
}

/// Computes the seal as the program does.
fn seal(inputs: &str, files: &BTreeMap<String, String>, made: &impl Serialize) -> String {
    let bytes = serde_json::to_vec(&(inputs, files, made)).expect("records are plain data");
    blake3::hash(&bytes).to_hex().to_string()
}
