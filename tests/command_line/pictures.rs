//! Pictures of the pages: each is in the recipe of `make pictures`, and shows what the pages and
//! the results say.

#[expect(dead_code, reason = "`make pictures` needs more of it")]
#[path = "../../examples/pictures/recipe.rs"]
mod recipe;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use judge::{ResultScores, Results};
use metrics::Metric;
use recipe::{Picture, PictureRun, RECORD, Recipe, hash, is_picture, read_record};
use tests::root;
use walkdir::WalkDir;

use crate::links::find_pages;

/// Folders of pictures. Other pictures are textures of scenes.
const FOLDERS: [&str; 2] = ["docs", "results"];

/// Lists the pages that show each picture, by its path in the repository.
fn list_shown() -> BTreeMap<String, String> {
    let mut shown: BTreeMap<String, String> = BTreeMap::new();
    let top = root().canonicalize().unwrap();
    for page in find_pages(&top) {
        let text = fs::read_to_string(&page).unwrap();
        for rest in text.split("](").skip(1) {
            let target = rest.split([')', '#']).next().unwrap();
            let path = page.parent().unwrap().join(target);
            let path = path.canonicalize().unwrap_or_default();
            let Ok(path) = path.strip_prefix(&top) else {
                continue;
            };
            if is_picture(path) && FOLDERS.iter().any(|folder| path.starts_with(folder)) {
                *shown.entry(path.display().to_string()).or_default() += &text;
            }
        }
    }
    shown
}

/// Finds the run that makes a picture.
fn find_run<'a>(recipe: &'a Recipe, path: &str) -> Option<&'a PictureRun> {
    let is_own = |own: &Picture| match own.folder {
        Some(_) => Path::new(path).parent() == Some(Path::new(&own.file)),
        None => own.file == path,
    };
    let mut runs = recipe.run.iter();
    runs.find(|run| run.picture.iter().any(is_own))
}

#[test]
fn every_picture_is_in_the_recipe_and_on_a_page() {
    let top = root().canonicalize().unwrap();
    let files = FOLDERS.map(|folder| WalkDir::new(top.join(folder)));
    let files = files
        .into_iter()
        .flatten()
        .map(|file| file.unwrap().into_path());
    let files: BTreeSet<String> = files
        .filter(|path| is_picture(path))
        .map(|path| path.strip_prefix(&top).unwrap().display().to_string())
        .collect();
    let shown: BTreeSet<String> = list_shown().into_keys().collect();
    let odd: Vec<&String> = files.symmetric_difference(&shown).collect();
    assert!(
        odd.is_empty(),
        "pictures on no page, or without a file: {odd:#?}"
    );

    let recipe = Recipe::read();
    let mut known: BTreeSet<String> = read_record(&top).into_keys().collect();
    for path in &known {
        let run = find_run(&recipe, path);
        assert!(
            run.is_some(),
            "{RECORD}: no run of pictures.toml makes {path}"
        );
    }
    known.extend(recipe.by_hand.into_iter().map(|picture| picture.file));
    let odd: Vec<&String> = files.symmetric_difference(&known).collect();
    assert!(
        odd.is_empty(),
        "neither in {RECORD} nor by_hand in pictures.toml, or without a file: {odd:#?}"
    );
}

/// Scores of the results by scene and preset, such as `fan / bevy:high`.
type Scores = BTreeMap<String, f64>;

/// Half of a picture's last digit, and of the last digit of the results.
const ROUNDING: f64 = 0.000_506;

/// Lists the scores of a picture that are not those of the results, or, for cases without results,
/// on no page of the picture.
fn find_stale(lines: &[String], pages: &str, results: &Scores) -> Vec<String> {
    let is_said = |line: &&String| {
        let Some((case, score)) = line.rsplit_once(' ') else {
            return true;
        };
        if let Some(kept) = results.get(case) {
            return (score.parse::<f64>()).is_ok_and(|score| (score - kept).abs() < ROUNDING);
        }
        if line.starts_with("Shutter ") {
            return pages.contains(*line);
        }
        let Some((_, preset)) = case.split_once(" / ") else {
            return true;
        };
        let is_score = |word: &str| word.trim_end_matches('!') == score;
        let in_row = |row: &str| row.contains(preset) && row.split(' ').any(is_score);
        // The name of a case is also the heading of its screen.
        score.parse::<f64>().is_err() || pages.lines().any(in_row)
    };
    lines
        .iter()
        .filter(|line| !is_said(line))
        .cloned()
        .collect()
}

#[test]
fn every_picture_shows_the_scores_of_the_results_or_of_its_page() {
    let results = Results::read(&root().join("results/320x180_llvmpipe.json")).unwrap();
    let score = |own: &ResultScores| {
        let flip = own.score(Metric::FLIP)?;
        Some((format!("{} / {}", own.scene, own.name), flip))
    };
    let results: Scores = results.scores.iter().filter_map(score).collect();
    let (recipe, pages) = (Recipe::read(), list_shown());
    let mut wrong = String::new();
    for (path, shown) in &read_record(&root()) {
        let bytes = fs::read(root().join(path)).unwrap_or_default();
        if hash(&bytes) != shown.hash {
            wrong += &format!("{path}: not the picture of {RECORD}\n");
        }
        // More samples have other scores.
        let commands = find_run(&recipe, path).map(|run| run.commands.concat());
        let is_alike = commands.is_some_and(|own| own.contains("--samples-per-pixel 64"));
        let none = Scores::new();
        let own = if is_alike { &results } else { &none };
        for line in find_stale(&shown.text, &pages[path], own) {
            wrong += &format!("{path}: {line}\n");
        }
    }
    assert!(wrong.is_empty(), "make these again: make pictures\n{wrong}");

    let pages = "| `bevy:high` | 0.250 |";
    let older = [
        "bevy / bevy:high 0.260",
        "fan / bevy:high 0.250",
        "Shutter a",
    ];
    let older = older.map(str::to_owned);
    assert_eq!(find_stale(&older, pages, &results), older);
}

/// Lists what a picture of the report shows otherwise than the ranking of the readme.
fn find_other_ranking(lines: &[String], readme: &str) -> Vec<String> {
    let ranking = readme.split("    mean over 5 scenes").nth(1).unwrap();
    let ranking = ranking.split("references").next().unwrap();
    // A long name has a line of its own.
    let words: Vec<&str> = ranking.split_whitespace().collect();
    let mut wrong = Vec::new();
    let mut ranked = Vec::new();
    for row in words.windows(7) {
        if let [preset, mean, _, _, low, "to", high] = *row {
            let mut rows = lines
                .iter()
                .filter(|line| line.starts_with(&format!("{preset} ")));
            let row = format!("{preset} {mean} {low} to {high} ");
            wrong.extend(rows.find(|line| !line.starts_with(&row)).cloned());
            ranked.push(row);
        }
    }
    let first = lines
        .iter()
        .skip_while(|line| *line != "centred shutter")
        .nth(1);
    if !first.is_some_and(|line| line.starts_with(&ranked[0])) {
        wrong.push(format!("{first:?} is first"));
    }
    let count = readme.split("--table shows all ").nth(1).unwrap();
    let count = format!(
        "5 scenes, {} filter presets.",
        count.split_whitespace().next().unwrap()
    );
    if !lines.iter().any(|line| line.starts_with(&count)) {
        wrong.push(format!("no \"{count}\""));
    }
    wrong
}

#[test]
fn the_picture_of_the_report_has_the_ranking_of_the_readme() {
    let record = read_record(&root());
    let lines = &record["docs/report.png"].text;
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let wrong = find_other_ranking(lines, &readme);
    assert!(
        wrong.is_empty(),
        "make it again: make pictures RUNS=report\n{wrong:#?}"
    );
    let changed = lines.iter().map(|line| line.replace(" 0.0", " 0.9"));
    let changed: Vec<String> = changed
        .map(|line| line.replace("5 scenes", "4 scenes"))
        .collect();
    let wrong = find_other_ranking(&changed, &readme);
    assert!(wrong.len() > 4, "{wrong:#?}");
}
