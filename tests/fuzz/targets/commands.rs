//! Files read by commands of the program, from `commands.toml`.

use std::collections::BTreeMap;
use std::fs;
use std::sync::LazyLock;

use serde::Deserialize;

use super::program::run_line;
use crate::place::Place;

/// A file that an input replaces, and the commands that read it.
#[derive(Deserialize)]
struct Reading {
    file: String,
    commands: Vec<String>,
}

static READINGS: LazyLock<BTreeMap<String, Vec<Reading>>> = LazyLock::new(|| {
    toml::from_str(include_str!("../commands.toml")).expect("a table of commands")
});

/// Returns the files of the fixture that inputs replace.
pub fn replaced(place: &Place) -> Vec<Vec<u8>> {
    let files = READINGS[place.target].iter().map(|reading| &reading.file);
    let contents = files.map(|file| fs::read(place.fixture.join(file)));
    contents.filter_map(Result::ok).collect()
}

/// Runs the commands that read one of the target's files.
pub fn read(place: &mut Place, input: &[u8]) -> Option<()> {
    let readings = &READINGS[place.target];
    let Reading { file, commands } = &readings[input.len() % readings.len()];
    run(place, file, input, commands)
}

/// Writes an input in place of a file, and runs commands up to one that refuses it.
pub fn run(place: &mut Place, file: &str, input: &[u8], commands: &[String]) -> Option<()> {
    for entry in fs::read_dir(&place.fixture).unwrap() {
        place.copy(&entry.unwrap().file_name().to_string_lossy());
    }
    let original = fs::read(place.fixture.join(file)).ok();
    let mut read = Some(());
    for line in commands {
        let path = place.write(file, input);
        let line = line.replace("FIXTURE", &place.fixture.to_string_lossy());
        read = read.filter(|()| run_line(place, &line) <= 1);
        match &original {
            Some(original) => fs::write(path, original).unwrap(),
            None => fs::remove_file(path).unwrap(),
        }
        let _ = fs::remove_dir_all(place.folder.join("new"));
    }
    let is_whole = original.as_deref() == Some(input);
    assert!(read.is_some() || !is_whole, "{file} is refused");
    read
}
