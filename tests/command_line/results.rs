//! Kept results: files of scores, and the page that is made from them.

use std::fs;
use std::path::{Path, PathBuf};

use cli::results_page;
use suite::{Headline, Results, Run};

use crate::bench::{Bench, assert_done};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../results")
}

/// Reads the shipped results with their texts, in the order of their names.
fn shipped() -> Vec<(String, Results)> {
    let mut files: Vec<PathBuf> = (fs::read_dir(folder()).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| {
            path.extension()
                .is_some_and(|extension| extension == "json")
        })
        .collect();
    files.sort();
    (files.iter())
        .map(|path| {
            let results = Results::read(path).unwrap();
            assert_eq!(
                path.file_name().unwrap().to_str().unwrap(),
                results.file_name()
            );
            (fs::read_to_string(path).unwrap(), results)
        })
        .collect()
}

#[test]
fn the_page_of_results_is_made_from_the_files_beside_it() {
    let shipped = shipped();
    for (text, results) in &shipped {
        assert!(
            *text == results.text(),
            "{} was edited",
            results.file_name()
        );
    }
    let results: Vec<Results> = shipped.into_iter().map(|(_, results)| results).collect();
    assert!(results.iter().any(|own| own.seal.is_some()));
    let page = fs::read_to_string(folder().join("README.md")).unwrap();
    assert!(
        page == results_page(&results).unwrap(),
        "results/README.md is not what its files say; write it: cargo run -p cli --example results"
    );
}

fn run(bench: &Bench, more: &[&str]) -> Run {
    let words = [
        "--filters",
        "identity,velocity_gather:fine,velocity_gather:coarse",
    ];
    assert_done(&bench.run(&[&words[..], more].concat()));
    bench.read_run()
}

#[test]
fn results_of_two_runs_are_those_of_one() {
    let bench = Bench::two_scenes();
    let both = run(&bench, &[]);
    let plate = run(&bench, &["--scenes", "plate"]);
    let slow = run(&bench, &["--scenes", "slow"]);
    let whole = Results::from_runs(&[both]).unwrap();
    let joined = Results::from_runs(&[plate.clone(), slow]).unwrap();
    assert_eq!(joined, whole);
    assert_eq!(whole.scenes(), ["plate", "slow"]);
    assert_eq!(whole.scores.len(), 6);

    let case = plate.cases.iter().find(|case| !case.is_reference).unwrap();
    let flip = Headline::FLIP.estimate(case).unwrap();
    let kept = whole.scores[0].score(Headline::FLIP).unwrap();
    assert!((kept / flip - 1.0).abs() < 1e-3, "{kept} {flip}");

    let refused = |runs: &[Run]| Results::from_runs(runs).unwrap_err().to_string();
    let twice = refused(&[plate.clone(), plate.clone()]);
    assert!(
        twice.contains("plate / identity:default is in two runs"),
        "{twice}"
    );
    let sealed = run(&bench, &["--scenes", "slow", "--seal", "3"]);
    let mixed = refused(&[plate, sealed.clone()]);
    assert!(
        mixed.contains("slow@seal3: seal: 3, and the first run has none"),
        "{mixed}"
    );
    let sealed = Results::from_runs(&[sealed]).unwrap();
    assert_eq!((sealed.seal, sealed.scenes()), (Some(3), vec!["slow"]));
    assert!(
        sealed.file_name().ends_with("_seal3.json"),
        "{}",
        sealed.file_name()
    );

    let path = bench.path("kept.json");
    fs::write(&path, whole.text()).unwrap();
    assert_eq!(Results::read(&path).unwrap(), whole);
    fs::write(
        &path,
        whole.text().replace("\"format\": 1", "\"format\": 9"),
    )
    .unwrap();
    let other = Results::read(&path).unwrap_err().to_string();
    assert!(
        other.contains("kept.json: has format 9; allowed: 1"),
        "{other}"
    );
}
