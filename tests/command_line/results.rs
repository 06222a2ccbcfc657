//! Kept results: files of scores, and the page that is made from them.

#[path = "../../examples/results/filter_page.rs"]
mod filter_page;
#[path = "../../examples/results/page.rs"]
mod page;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use judge::Results;
use metrics::Metric;
use suite::Run;
use tests::filter_folder::copy_changed_filter;
use tests::text::assert_contains;
use tracer::{SceneId, Seal};

use self::filter_page::{picture_name, results_filter_pages};
use self::page::{main_results, results_page};
use crate::sandbox::Sandbox;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../results")
}

#[test]
fn the_page_of_results_is_made_from_the_files_beside_it() {
    let results = Results::read_all(&folder()).unwrap();
    for own in &results {
        let name = own.file_name();
        let text = fs::read_to_string(folder().join(&name)).unwrap();
        assert!(text == own.text(), "{name} was edited");
    }
    assert!(results.iter().any(|own| own.seal.is_some()));
    let page = fs::read_to_string(folder().join("README.md")).unwrap();
    assert!(
        page == results_page(&results).unwrap(),
        "results/README.md is not what its files say; write it: cargo run -p cli --example results"
    );
}

#[test]
fn the_page_of_every_filter_is_made_from_the_results_and_shows_its_worst_picture() {
    let results = Results::read_all(&folder()).unwrap();
    let pages = results_filter_pages(&results);
    for (name, text) in &pages {
        let page = fs::read_to_string(folder().join(name)).unwrap();
        assert!(
            page == *text,
            "results/{name} is not what the files say; write it: cargo run -p cli --example results"
        );
    }
    let main = main_results(&results).unwrap();
    let filters: BTreeSet<&str> = main.scores.iter().map(|own| own.filter.as_str()).collect();
    let worst = filters.iter().map(|filter| main.worst_of(filter).unwrap());
    let due: BTreeSet<String> = worst.map(picture_name).collect();
    let names = |folder: &Path| -> BTreeSet<String> {
        let files = fs::read_dir(folder).unwrap();
        files
            .map(|file| file.unwrap().file_name().into_string().unwrap())
            .collect()
    };
    assert_eq!(names(&folder().join("pictures")), due);
    let due = pages.into_keys().chain(["README.md".to_owned()]);
    let found = names(&folder())
        .into_iter()
        .filter(|name| name.ends_with(".md"));
    assert_eq!(found.collect::<BTreeSet<_>>(), due.collect());
}

const FILTERS: &str = "--filters identity,velocity_gather:fine,velocity_gather:coarse";

/// Measures three filters on two scenes, or on some of them.
fn run(more: &str) -> Run {
    let sandbox = Sandbox::two_scenes();
    sandbox.measure(&format!("{FILTERS} {more}"));
    sandbox.read_run()
}

#[test]
fn costs_of_a_bench_stand_beside_the_scores_of_their_presets() {
    let sandbox = Sandbox::new();
    sandbox.measure(FILTERS);
    let mut results = Results::from_runs(&[sandbox.read_run()]).unwrap();
    sandbox.done("bench --size 64x32 --filters velocity_gather:fine --out out");
    let costs = report::read_bench(&sandbox.path("out")).unwrap().unwrap();
    results.add_costs(&costs).unwrap();
    let name = "velocity_gather:fine";
    assert_eq!(results.costs.keys().collect::<Vec<_>>(), [name]);
    let page = results_page(&[results.clone()]).unwrap();
    let mut rows = page.lines();
    let row = rows.find(|line| line.contains(&format!("`{name}`")));
    let ratio = format!("| {:.2} ", results.costs[name].median);
    assert_contains(row.unwrap(), &[&ratio]);
    let read: Results = serde_json::from_str(&results.text()).unwrap();
    assert_eq!(read, results);

    results.size = [320, 180];
    let error = results.add_costs(&costs).unwrap_err().to_string();
    assert_contains(&error, &["the bench timed 64x32 on"]);
}

#[test]
fn results_of_two_runs_are_those_of_one() {
    // A run keeps the cases of earlier ones in its folder, so that each has its own.
    let [plate, slow] = ["plate", "slow"].map(|scene| run(&format!("--scenes {scene}")));
    let whole = Results::from_runs(&[run("")]).unwrap();
    let joined = Results::from_runs(&[plate.clone(), slow]).unwrap();
    assert_eq!(joined, whole);
    let named = ["plate", "slow"].map(|name| SceneId::new(name, None));
    assert_eq!(whole.scenes(), named.each_ref());
    assert_eq!(whole.scores.len(), 6);

    let case = plate.cases.iter().find(|case| !case.is_reference).unwrap();
    let flip = case.estimate(Metric::FLIP).unwrap();
    let kept = whole.scores[0].score(Metric::FLIP).unwrap();
    assert!((kept / flip - 1.0).abs() < 1e-3, "{kept} {flip}");

    let refused = |runs: &[Run]| Results::from_runs(runs).unwrap_err().to_string();
    let twice = refused(&[plate.clone(), plate.clone()]);
    assert_contains(&twice, &["plate / identity:default is in two runs"]);
    let sealed = run("--scenes slow --seal 3");
    let mixed = refused(&[plate, sealed.clone()]);
    assert_contains(&mixed, &["slow@seal3: seal: 3, and the first run has none"]);
    let sealed = Results::from_runs(&[sealed]).unwrap();
    assert_eq!(sealed.seal, Some(3));
    assert_eq!(sealed.scenes(), [&SceneId::new("slow", None)]);
    let name = sealed.file_name();
    assert!(name.ends_with("_seal3.json"), "{name}");

    // A filter that was measured later joins those of its scene.
    let mut part = whole.clone();
    (part.scores).retain(|own| own.scene != "plate" || own.name != "velocity_gather:coarse");
    assert_eq!(part.scores.len(), 5);
    // Its own score takes the place of an older one.
    part.scores[0].floor = 9.0;
    part.update(whole.clone()).unwrap();
    assert_eq!(part, whole);
    let mut other = whole.clone();
    other.samples_per_pixel = 4096;
    let refused = part.update(other).unwrap_err().to_string();
    assert_contains(&refused, &["with 4096 samples per pixel cannot go into"]);

    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("kept.json");
    fs::write(&path, whole.text()).unwrap();
    assert_eq!(Results::read(&path).unwrap(), whole);
    let later = whole.text().replace("\"format\": 2", "\"format\": 9");
    fs::write(&path, later).unwrap();
    let refused = Results::read(&path).unwrap_err().to_string();
    assert_contains(&refused, &["kept.json: has format 9; allowed: 2"]);
}

/// Writes the filter `learnt`: a gather along the velocity that the plate has, whatever the velocity buffer says.
fn write_learnt_filter(sandbox: &Sandbox) {
    let folder = sandbox.path("learnt");
    copy_changed_filter("velocity_gather", &folder, |kernels| {
        let read = "textureLoad(velocity, pixel, 0).xy";
        assert!(kernels.contains(read));
        // 1.6 m of a picture that is 4.62 m and 32 pixels high.
        kernels.replace(read, &format!("(vec2(11.09, 0.0) + 0.0 * {read})"))
    });
    let [from, to] =
        ["velocity_gather", "learnt"].map(|name| folder.join(name).with_extension("wgsl"));
    fs::rename(from, to).unwrap();
    let manifest = folder.join("filter.toml");
    let text = fs::read_to_string(&manifest).unwrap();
    fs::write(manifest, text.replace("velocity_gather", "learnt")).unwrap();
}

#[test]
fn a_filter_that_was_fitted_to_the_scenes_falls_on_sealed_ones() {
    let sandbox = Sandbox::new();
    let names = ["plate", "dim", "bright"];
    for (name, light) in [("dim", "0.1, 0.1, 0.1"), ("bright", "0.6, 0.6, 0.6")] {
        sandbox.copy_scene(name, |text| text.replace("0.2, 0.2, 0.2", light));
    }
    write_learnt_filter(&sandbox);
    // One that lets all of the plates move the other way.
    let turns_round = |seed: u64| {
        let turned = |name: &&str| {
            let seal = Seal::new(seed, name);
            seal.mirrored != seal.reversed
        };
        names.iter().all(turned)
    };
    let seed = (0..).find(|seed| turns_round(*seed)).unwrap();
    let ranks = |more: &str| -> Vec<String> {
        let filters = "--no-cache --filters velocity_gather:fine,learnt:fine";
        sandbox.measure(&format!("{filters} {more}"));
        let results = Results::from_runs(&[sandbox.read_run()]).unwrap();
        assert_eq!(results.scenes().len(), names.len());
        let ranking = results.ranking(None).remove(0);
        ranking.into_iter().map(|ranked| ranked.name).collect()
    };
    assert_eq!(ranks(""), ["learnt:fine", "velocity_gather:fine"]);
    let sealed = ranks(&format!("--seal {seed}"));
    assert_eq!(sealed, ["velocity_gather:fine", "learnt:fine"]);
}
