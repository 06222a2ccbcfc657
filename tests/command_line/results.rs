//! Kept results: files of scores, and the page made from them.

#[path = "../../examples/results/change.rs"]
mod change;
mod claims;
#[path = "../../examples/results/engines.rs"]
mod engines;
#[path = "../../examples/results/lengths.rs"]
mod lengths;
#[path = "../../examples/results/page.rs"]
mod page;
#[path = "../../examples/results/site.rs"]
mod site;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use bench::Bench;
use filters::Filter;
use frame::Alignment;
use judge::{Agreement, Results, compare_sizes};
use measure::{IDENTITY, Run};
use metrics::Metric;
use scene::{Location, SceneId, Seal, list_scenes};
use tests::filter_folder::copy_changed_filter;
use tests::root;
use tests::text::assert_contains;

use self::engines::{Engine, list_engines};
use self::lengths::Panels;
use self::page::{main_results, picture_name, results_page};
use self::site::{Site, as_html};
use crate::links::find_pages;
use crate::sandbox::Sandbox;

/// Presets that are worse than no blur, the best of them first.
const WORSE: [&str; 1] = ["three:default"];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../results")
}

#[test]
fn the_page_of_results_is_made_from_the_files_beside_it() {
    let results = Results::read_all(&folder()).unwrap();
    for file in &results {
        let name = file.file_name();
        let text = fs::read_to_string(folder().join(&name)).unwrap();
        assert!(text == file.text(), "{name} was edited");
    }
    assert!(results.iter().any(|file| file.seal.is_some()));
    let cards = Bench::read_all(&folder().join("bench")).unwrap();
    let page = fs::read_to_string(folder().join("README.md")).unwrap();
    assert!(
        page == results_page(&results, &cards).unwrap(),
        "results/README.md is not what its files say; write it: cargo run -p shuttertruth --example results"
    );
}

#[test]
fn readers_cards_have_rows_and_names_of_others_are_text_on_the_page_and_on_the_site() {
    let hostile =
        "RTX <img src=x onerror=\"a()\"> `b`|c [d](javascript:e()) ![f](g)\n# h {{#include i}}";
    let mut results = Results::read_all(&folder()).unwrap();
    let mut cards = Bench::read_all(&folder().join("bench")).unwrap();
    // A reader's card, as a browser would have timed it.
    cards.push(Bench {
        scene: Some("fan".to_owned()),
        speed: None,
        ..cards[0].clone()
    });
    let mut reader = cards[0].clone();
    reader.scene = Some(hostile.to_owned());
    (reader.speed, reader.adapter.name) = (None, hostile.to_owned());
    (reader.cases[0].filter, reader.cases[0].preset) = (hostile.to_owned(), hostile.to_owned());
    cards.push(reader);
    // The program's own bench names the card of the times, and a file of results the adapter and a
    // filter.
    cards[0].adapter.name = hostile.to_owned();
    for file in &mut results {
        file.adapter = Some(hostile.to_owned());
        for score in file
            .scores
            .iter_mut()
            .filter(|score| score.name == "kino:default")
        {
            score.name = hostile.to_owned();
        }
    }
    let pages = page::site_pages(&results, &cards).unwrap().into_iter();
    let shown = [results_page(&results, &cards).unwrap()];
    let row = "1920x1080, the scene fan | `babylon:default` | 0.06 |";
    assert_contains(&shown[0], &["## Readers' cards", row]);
    for page in pages.map(|(_, text)| text).chain(shown) {
        for part in [
            "RTX <",
            "](javascript",
            "![f]",
            "`b`",
            "|c [",
            "\n# h",
            "{{#",
        ] {
            assert!(!page.contains(part), "{part}: {page}");
        }
    }
    let shown = as_html("{{#include a}} <b> [c](d)\n``````\n");
    assert_eq!(
        shown,
        "<pre><code class=\"language-text\">&#123;&#123;#include a}} &lt;b&gt; [c&#93;(d)\n``````\n</code></pre>"
    );
}

/// Compares the lengths of smears with those of engines.toml: of engines whose lengths depend on
/// the size of the picture, which are slow, or of all others.
fn check_lengths(of_full_size: bool) {
    let panels = Panels::new();
    let mut wrong = Vec::new();
    let engines = list_engines().into_iter();
    for engine in engines.filter(|engine| engine.shipped.full_size == of_full_size) {
        let kept = [engine.length, engine.at_180].map(f64::from);
        let measure = |factor| {
            let lengths = panels.measure(&engine, factor);
            [lengths.shipped, lengths.at_180]
        };
        let now = measure(1.0);
        println!("{}: {now:.1?}", engine.name);
        // Lengths are rounded to degrees, and adapters round floats.
        let is_kept = |length: f64, kept: f64| (length - kept).abs() <= (0.01 * kept).max(1.0);
        for (kept, now) in kept.into_iter().zip(now) {
            if !is_kept(now, kept) {
                let name = &engine.name;
                wrong.push(format!("{name}: {now:.1}, and engines.toml says {kept}"));
            }
        }
        // Small pictures are fast, and show that a tenth more is noticed.
        if !of_full_size {
            let more = measure(1.1).into_iter().zip(kept);
            for (more, kept) in more {
                let name = &engine.name;
                assert!(!is_kept(more, kept), "{name}: {more} passes for {kept}");
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
#[ignore = "prove: a claim of the results, measured anew"]
fn an_engine_s_smear_is_as_long_as_the_page_says_and_a_tenth_more_is_another_length() {
    check_lengths(false);
}

#[test]
#[ignore = "prove: engines whose smear depends on the size of the picture, at 1920x1080"]
fn every_engine_s_smear_in_a_large_picture_is_as_long_as_the_page_says() {
    check_lengths(true);
}

#[test]
fn the_pictures_show_what_each_engine_ships_at_its_worst() {
    let results = Results::read_all(&folder()).unwrap();
    let main = main_results(&results).unwrap();
    let worst = |engine: Engine| main.worst_of(&engine.shape).map(picture_name).unwrap();
    let due: BTreeSet<String> = list_engines().into_iter().map(worst).collect();
    let files = fs::read_dir(folder().join("pictures")).unwrap();
    let actual = files.map(|file| file.unwrap().file_name().into_string().unwrap());
    assert_eq!(actual.collect::<BTreeSet<_>>(), due);
}

#[test]
fn the_gallery_has_the_scores_of_the_results() {
    let results = Results::read_all(&folder()).unwrap();
    let main = main_results(&results).unwrap();
    let gallery = fs::read_to_string(root().join("docs/gallery/README.md")).unwrap();
    let mut shown = 0;
    for section in gallery.split("\n## ").skip(1) {
        let scene = section.lines().next().unwrap();
        // Every second part is between back quotes: a preset, followed by its score.
        let captions = section.lines().filter(|line| line.starts_with("Shutter "));
        let parts: Vec<&str> = captions.flat_map(|line| line.split('`').skip(1)).collect();
        for pair in parts.chunks_exact(2) {
            let [preset, after] = [pair[0], pair[1].trim_start()];
            let score = main
                .scores
                .iter()
                .find(|score| score.scene == scene && score.name == preset);
            let flip = score
                .unwrap_or_else(|| panic!("{scene}: {preset}"))
                .score(Metric::FLIP);
            let kept = Metric::FLIP.number(flip.unwrap());
            assert!(
                after.starts_with(&kept),
                "{scene}: {preset} has {kept}, not {after}"
            );
            shown += 1;
        }
    }
    assert_eq!(shown, 4 * main.scenes().len());
}

#[test]
fn the_site_has_every_guide_and_a_page_for_every_engine() {
    let site = Site::collect(&root(), &["fan"]).unwrap();
    let guides = ["docs", "results"].map(|folder| find_pages(&root().join(folder)));
    let guides = guides.concat();
    let guides = guides.iter().map(|path| path.strip_prefix(root()).unwrap());
    let engines = list_engines().into_iter();
    let engines = engines.map(|engine| Path::new("results").join(engine.page_name()));
    for page in guides.map(Path::to_owned).chain(engines) {
        let link = format!("]({})", page.display());
        assert!(site.pages["SUMMARY.md"].contains(&link), "no entry: {link}");
    }
    let results = &site.pages["results/README.md"];
    let none = results
        .lines()
        .filter(|line| line.contains("`identity:default`, no blur"));
    assert_eq!(none.count(), 2);
    let folder = tempfile::tempdir().unwrap();
    site.write(&root(), folder.path()).unwrap();
    assert!(folder.path().join("src/docs/report.png").is_file());
}

#[test]
fn the_commands_of_the_page_measure_what_its_tables_have() {
    let results = Results::read_all(&folder()).unwrap();
    let mut presets = BTreeSet::new();
    for filter in Filter::builtin_names() {
        let shipped = Filter::builtin(&filter).unwrap().presets;
        presets.extend((shipped.iter()).map(|preset| format!("{filter}:{}", preset.name)));
    }
    let scenes = list_scenes(Location::of_bundle(&catalogue::SCENES)).unwrap();
    let main = main_results(&results).unwrap();
    let sealed = results.iter().find(|file| file.seal == Some(1)).unwrap();
    // Neither command names scenes or filters, so that both take all.
    for file in [main, sealed] {
        let names: BTreeSet<String> = file.scores.iter().map(|score| score.name.clone()).collect();
        assert_eq!(names, presets);
        let own_scenes = file.scenes().into_iter().map(SceneId::to_string);
        let due = scenes.iter().map(|scene| scene.name.clone());
        assert_eq!(own_scenes.collect::<BTreeSet<_>>(), due.collect());
        assert_eq!(file.scores.len(), presets.len() * scenes.len());
    }
}

#[test]
fn doing_nothing_is_ranked_in_both_shutters() {
    let results = Results::read_all(&folder()).unwrap();
    for group in main_results(&results).unwrap().ranking() {
        let none = group.iter().find(|entry| entry.filter == IDENTITY).unwrap();
        let worse = group.iter().filter(|entry| entry.mean > none.mean);
        let worse: Vec<&str> = worse.map(|entry| entry.name.as_str()).collect();
        match none.alignment {
            Alignment::Centred => assert_eq!(worse, WORSE),
            _ => assert!(worse.is_empty(), "{worse:?}"),
        }
    }
    // Without a filter of a centred shutter there is no score against one.
    let trailing = Results::from_runs(&[whole_run()]).unwrap();
    assert_eq!(trailing.ranking().len(), 1);
}

#[test]
fn the_study_of_picture_sizes_has_the_numbers_of_the_kept_results() {
    let read = |size: &str| Results::read(&folder().join(format!("{size}_llvmpipe.json"))).unwrap();
    let all = ["160x90", "320x180", "1280x720", "1920x1080"].map(read);
    let compared = compare_sizes(&all.each_ref(), Metric::FLIP).unwrap();
    let row = |name: &str, cells: Vec<String>| format!("| {name} | {} |", cells.join(" | "));
    let pairs = |name: &str, count: fn(&Agreement) -> usize| {
        let sum = |size: usize| -> usize {
            (compared.iter().map(|group| count(&group.agreement[size]))).sum()
        };
        row(name, (0..4).map(|size| sum(size).to_string()).collect())
    };
    let mut printed = vec![
        pairs("separated here and at 1920x1080, same order", |agreement| {
            agreement.alike
        }),
        pairs("separated in both, reversed", |agreement| {
            agreement.reversed.len()
        }),
        pairs("separated at 1920x1080 only", |agreement| {
            agreement.only_at_largest
        }),
    ];
    for filter in compared.iter().flat_map(|group| &group.filters) {
        let means = filter.means.iter();
        let cells = means.map(|mean| Metric::FLIP.number(mean.mean));
        printed.push(row(&format!("`{}`", filter.name), cells.collect()));
    }
    let page = fs::read_to_string(folder().join("studies/picture-sizes.md")).unwrap();
    let is_row = |line: &&str| line.starts_with("| `") || line.starts_with("| separated");
    let rows: Vec<&str> = page.lines().filter(is_row).collect();
    assert!(rows.len() > 10, "only {rows:?}");
    for row in rows {
        assert!(
            printed.iter().any(|line| line == row),
            "{row}: {printed:#?}"
        );
    }
}

const FILTERS: &str = "--filters identity,velocity_gather:fine,velocity_gather:coarse";

/// Measures three filters on two scenes, or on some of them.
fn run(more: &str) -> Run {
    let sandbox = Sandbox::two_scenes();
    sandbox.measure(&format!("{FILTERS} {more}"));
    sandbox.read_run()
}

/// Returns the run of all scenes, which is measured once for all tests.
fn whole_run() -> Run {
    static RUN: OnceLock<Run> = OnceLock::new();
    RUN.get_or_init(|| run("")).clone()
}

#[test]
fn results_of_two_runs_are_those_of_one() {
    // A run keeps the cases of earlier ones in its folder, so each has its own.
    let [plate, slow] = ["plate", "slow"].map(|scene| run(&format!("--scenes {scene}")));
    let whole = Results::from_runs(&[whole_run()]).unwrap();
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

    // A filter that was measured later joins the others of its scene.
    let mut part = whole.clone();
    (part.scores).retain(|score| score.scene != "plate" || score.name != "velocity_gather:coarse");
    assert_eq!(part.scores.len(), 5);
    // A newer score replaces the older one of the same filter and scene.
    part.scores[0].floor = 9.0;
    part.update(whole.clone()).unwrap();
    assert_eq!(part, whole);
    let mut other = whole.clone();
    other.samples_per_pixel = 4096;
    let refused = part.update(other).unwrap_err().to_string();
    assert_contains(&refused, &["with 4096 samples per pixel cannot go into"]);
    let mut other = whole.clone();
    other.common_alignment = Alignment::Centred;
    let refused = part.update(other).unwrap_err().to_string();
    assert_contains(
        &refused,
        &["is against a centred shutter", "against a trailing one"],
    );

    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("kept.json");
    fs::write(&path, whole.text()).unwrap();
    assert_eq!(Results::read(&path).unwrap(), whole);
    let later = whole.text().replace("\"format\": 3", "\"format\": 9");
    fs::write(&path, later).unwrap();
    let refused = Results::read(&path).unwrap_err().to_string();
    assert_contains(&refused, &["kept.json: has format 9; allowed: 3"]);
}

/// Writes the filter `learnt`: a gather along the plate's true velocity, ignoring the velocity
/// buffer.
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
#[ignore = "prove: a study of the results, measured anew"]
fn a_filter_that_was_fitted_to_the_scenes_falls_on_sealed_ones() {
    let sandbox = Sandbox::new();
    let names = ["plate", "dim", "bright"];
    for (name, light) in [("dim", "0.1, 0.1, 0.1"), ("bright", "0.6, 0.6, 0.6")] {
        sandbox.copy_scene(name, |text| text.replace("0.2, 0.2, 0.2", light));
    }
    write_learnt_filter(&sandbox);
    // The seed turns the motion of all plates round.
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
        let ranking = results.ranking().remove(0);
        ranking.into_iter().map(|ranked| ranked.name).collect()
    };
    assert_eq!(ranks(""), ["learnt:fine", "velocity_gather:fine"]);
    let sealed = ranks(&format!("--seal {seed}"));
    assert_eq!(sealed, ["velocity_gather:fine", "learnt:fine"]);
}
