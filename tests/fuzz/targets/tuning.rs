//! Files that `tune` writes and reads again.

use std::fs;

use report::{TuneFolder, tuning_page};
use tune::Journal;

use super::run_json::of;
use crate::seeds::Seed;
use crate::target::{Shape, Target};
use crate::{huge, tokens};

/// journal.jsonl.
pub static JOURNAL: Target = Target {
    name: "journal",
    share: 700,
    batch: 400,
    shape: Shape::Text,
    tokens: tokens::JSON,
    seeds: |place| {
        vec![
            of(place, "tuned/journal.jsonl"),
            Seed::Made(huge::deep_json),
        ]
    },
    run: |place, input| {
        let folder = place.copy("tuned");
        place.write("tuned/journal.jsonl", input);
        show(&folder);
        // The same command again, which continues the journal.
        let header = TuneFolder::read(&place.fixture.join("tuned"))
            .unwrap()
            .header
            .expect("a tuning has a journal");
        let copy = place.write("again/journal.jsonl", input);
        drop(Journal::open(&copy, &header));
    },
};

/// tune.json and sensitivity.json.
pub static TUNE: Target = Target {
    name: "tune_json",
    share: 450,
    batch: 250,
    shape: Shape::Text,
    tokens: tokens::JSON,
    seeds: |place| {
        vec![
            of(place, "tuned/tune.json"),
            of(place, "study/sensitivity.json"),
            Seed::Made(huge::deep_json),
        ]
    },
    run: |place, input| {
        let folder = place.copy("tuned");
        let study = place.copy("study");
        place.write("tuned/tune.json", input);
        show(&folder);
        place.write("study/sensitivity.json", input);
        show(&study);
        let _ = fs::remove_file(folder.join("journal.jsonl"));
        show(&folder);
        let journal = place.fixture.join("tuned/journal.jsonl");
        fs::copy(journal, folder.join("journal.jsonl")).unwrap();
    },
};

fn show(folder: &std::path::Path) {
    if let Ok(folder) = TuneFolder::read(folder) {
        drop(tuning_page(&folder));
    }
}
