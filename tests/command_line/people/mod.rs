//! Questions to people, the scale of their answers, and answers that are refused.

use std::fs;

use serde_json::Value;
use study::{
    Answer, AnswerFile, Chosen, Clip, DisplayFacts, Question, SHARP_CLIP, ShownPair, Study,
    TRUTH_CLIP, draw_session,
};
use tests::text::{assert_contains, squeeze};

use crate::sandbox::{
    Sandbox, assert_refused, assert_same_files, files_below, read_below, read_table, split,
};

/// Filters of the trailing shutter, from the best to the worst.
const FILTERS: &str = "jump_flood:paper,velocity_gather:fine,identity";

/// Makes a run of three filters on two scenes, and the page that asks about it; returns the study.
fn make_study(sandbox: &Sandbox, more: &str) -> Study {
    sandbox.add_slow_scene();
    sandbox.measure(&format!("--filters {FILTERS} --jitter-frames 0 {more}"));
    let written = sandbox.done("people ask out --out page --json");
    let written: Value = serde_json::from_str(&written).unwrap();
    assert_eq!(written["page"], "page/index.html");
    serde_json::from_value(written["study"].clone()).unwrap()
}

/// Makes the answers of a session with a person who chooses by a rule.
fn answer(
    study: &Study,
    question: Question,
    seed: u64,
    choose: impl Fn(&ShownPair, usize) -> Chosen,
) -> AnswerFile {
    let shown = draw_session(study, question, seed);
    let answers = shown.iter().enumerate().map(|(index, pair)| {
        let shutter = &study.shutters[pair.shutter];
        let name = |clip: Clip| match clip {
            Clip::Filter(filter) => shutter.filters[filter].clone(),
            Clip::Truth => TRUTH_CLIP.to_owned(),
            Clip::Sharp => SHARP_CLIP.to_owned(),
        };
        Answer {
            scene: study.scenes[pair.scene].clone(),
            alignment: shutter.alignment,
            left: name(pair.left),
            right: name(pair.right),
            choice: choose(pair, index),
            milliseconds: 1500.0,
            zoom: 2,
        }
    });
    AnswerFile {
        format: 1,
        program: suite::PROGRAM.to_owned(),
        study: study.clone(),
        question,
        seed,
        display: DisplayFacts {
            device_pixel_ratio: 1.0,
            viewport: [1280.0, 800.0],
        },
        answers: answers.collect(),
    }
}

/// An attentive person who prefers filters of smaller numbers.
fn prefer_first(pair: &ShownPair) -> Chosen {
    let rank = |clip| match clip {
        Clip::Truth => -1,
        Clip::Filter(filter) => filter as i32,
        Clip::Sharp => 100,
    };
    match rank(pair.left) - rank(pair.right) {
        ..0 => Chosen::Left,
        0 => Chosen::Neither,
        1.. => Chosen::Right,
    }
}

/// Writes files of answers; returns the words that name them.
fn write_answers(sandbox: &Sandbox, files: &[AnswerFile]) -> Vec<String> {
    let write = |(index, file): (usize, &AnswerFile)| {
        let name = format!("answers_{index}.json");
        sandbox.put(&name, serde_json::to_string(file).unwrap());
        name
    };
    files.iter().enumerate().map(write).collect()
}

fn preferences<'a>(answers: &'a [String], more: &[&'a str]) -> Vec<&'a str> {
    let answers: Vec<&str> = answers.iter().map(String::as_str).collect();
    [&["people", "preferences"], &answers[..], more].concat()
}

#[test]
fn a_page_has_copies_of_the_pictures_and_refuses_what_people_cannot_compare() {
    let sandbox = Sandbox::new();
    let study = make_study(&sandbox, "--frames 2 --fps 12");
    assert_eq!((study.frames.count, study.frames.per_second), (2, 12.0));
    assert_eq!(study.scenes, ["plate", "slow"]);
    // Two scenes of the sharp frame, the truth and three filters, two frames each, and the page.
    assert_eq!(files_below(&sandbox.path("page")).len(), 2 * 5 * 2 + 1);
    let picture = |path: &str| fs::read(sandbox.path(path)).unwrap();
    for (copy, original) in [
        ("page/pictures/0_0.png", "out/plate/frame.png"),
        ("page/pictures/1_1.png", "out/plate/0001/truth_trailing.png"),
        ("page/pictures/5_1.png", "out/slow/0001/frame.png"),
    ] {
        assert_eq!(picture(copy), picture(original), "{copy}");
    }
    let text = sandbox.done("people ask out --out other --filters jump_flood,ident* --scenes slow");
    let parts = "2 filters of the trailing shutter on 1 scene | every pair once, and 2 checks | 128 pixels | \
        Nobody has answered yet";
    assert_contains(&squeeze(&text), &parts);
    finish_half_a_page(&sandbox);
    sandbox.refuse_table("people ask --out new", "questions");
    assert!(!sandbox.path("new").exists());
    let parts = ["page: holds 2 files or folders", "a new folder"];
    sandbox.refuse("people ask out --out page", &parts);
    fs::remove_file(sandbox.path("out/slow/0001/frame.png")).unwrap();
    let parts = ["slow/0001/frame.png: cannot read"];
    sandbox.refuse("people ask out --out new", &parts);
}

#[test]
fn answers_to_a_page_become_a_scale_beside_the_scores_of_the_run() {
    let sandbox = Sandbox::new();
    let study = make_study(&sandbox, "");
    // Six people choose the better filter, except in one answer of four; the last one always chooses left in checks.
    let people: Vec<AnswerFile> = (0..6)
        .map(|seed| {
            answer(&study, Question::Truth, seed, |pair, index| {
                let choice = prefer_first(pair);
                match (choice, (index + seed as usize).is_multiple_of(4)) {
                    _ if pair.is_check() && seed == 5 => Chosen::Left,
                    (Chosen::Left, true) if !pair.is_check() => Chosen::Right,
                    (Chosen::Right, true) if !pair.is_check() => Chosen::Left,
                    _ => choice,
                }
            })
        })
        .collect();
    let names = write_answers(&sandbox, &people);
    let printed = sandbox.execute(&preferences(&names, &["--run", "out", "--json"]));
    let printed: Value = serde_json::from_str(&printed).unwrap();
    let question = &printed["questions"][0];
    assert_eq!(question["question"], "truth");
    assert_eq!(question["sessions"][0]["failed_checks"], 0);
    assert_eq!(question["sessions"][5]["path"], "answers_5.json");
    assert!(question["sessions"][5]["failed_checks"].as_u64().unwrap() >= 1);
    let scale = &question["scales"][0];
    assert_eq!(scale["comparisons"], 6 * 6);
    assert_eq!(scale["resampled"], "people");
    let filters = scale["filters"].as_array().unwrap();
    let order: Vec<&Value> = filters.iter().map(|own| &own["filter"]).collect();
    let due = "jump_flood:paper velocity_gather:fine identity:default";
    assert_eq!(order, split(due));
    let number = |value: &Value| value.as_f64().unwrap();
    let places: Vec<f64> = filters.iter().map(|own| number(&own["scale"])).collect();
    assert!(places.iter().sum::<f64>().abs() < 1e-9, "{places:?}");
    for (own, place) in filters.iter().zip(&places) {
        let [low, high] = [0, 1].map(|end| number(&own["interval"][end]));
        assert!(low < *place && *place < high, "{own}");
    }
    // Without a mistake the distance would be the prior's.
    let distance = places[0] - places[2];
    assert!((0.3..2.0).contains(&distance), "{distance}");
    let score = |name: &str| {
        let mut all = scale["scores"].as_array().unwrap().iter();
        all.find(|own| own["score"] == name).unwrap().clone()
    };
    // FLIP ranks the filters like these people; `run` measures it.
    assert_eq!(score("flip_moving")["correlation"], 1.0);
    assert!(number(&score("flip_moving")["predicted"]) > 0.6);
    assert_eq!(score("psnr_moving")["correlation"], 1.0);

    let table = sandbox.execute(&preferences(&names, &["--run", "out"]));
    let parts = "Which looks more like the truth? | 6 sessions, 48 answers | answers_5.json | \
        1000 resamples of sessions | people chose alike in | flip_moving +1.00";
    assert_contains(&squeeze(&table), &parts);
    let mut lines = table.lines();
    assert!(lines.all(|line| line.chars().count() <= 80), "{table}");

    // One person who always chooses alike: no sample of people, and only the prior limits the distances.
    let one = answer(&study, Question::Better, 9, |pair, _| prefer_first(pair));
    let names = write_answers(&sandbox, &[one]);
    let table = sandbox.execute(&preferences(&names, &[]));
    let parts = "1 session, 8 answers | fewer than 5 sessions | the prior alone holds | 0 of 2 checks failed";
    assert_contains(&squeeze(&table), &parts);
    assert_answers_are_refused(&sandbox, &study);
}

/// Makes a page where a killed process had begun another one.
fn finish_half_a_page(sandbox: &Sandbox) {
    let half = sandbox.path("half");
    fs::create_dir_all(half.join("pictures")).unwrap();
    fs::write(half.join("pictures/99_0.png"), "of another study").unwrap();
    fs::write(half.join(".shuttertruth-killed.tmp"), "").unwrap();
    let ask = "people ask out --out half";
    let parts = ["half: holds 1 files or folders", "a new folder"];
    sandbox.refuse(ask, &parts);
    fs::write(half.join(".shuttertruth.unfinished"), "").unwrap();
    sandbox.done(ask);
    let [half, page] = ["half", "page"].map(|folder| read_below(&sandbox.path(folder)));
    assert_same_files(&half, &page);
}

type Change = fn(&mut AnswerFile);

/// Checks that answers to questions that no page of this run asked are refused.
pub fn assert_answers_are_refused(sandbox: &Sandbox, study: &Study) {
    let session = |seed| answer(study, Question::Truth, seed, |pair, _| prefer_first(pair));
    let refuse = |files: &[AnswerFile], parts: &[&str]| {
        let names = write_answers(sandbox, files);
        assert_refused(&sandbox.shuttertruth(&preferences(&names, &[])), 2, parts);
    };
    let seed = "answers_1.json: has the seed 1 of answers_0.json";
    refuse(&[session(1), session(1)], &[seed, "counts once"]);
    let changed = |change: Change| {
        let mut file = session(3);
        change(&mut file);
        file
    };
    let others = changed(|file| file.study.pictures = "0".to_owned());
    let about = "answers_1.json: answers about other pictures";
    let says = format!("{about} than answers_0.json: the pictures differ");
    refuse(&[session(1), others], &[&says]);
    let parts = ["answer 5 of 8 is about"];
    refuse(&[changed(swap_sides)], &parts);
    let more = changed(|file| file.answers.push(file.answers[0].clone()));
    refuse(&[more], &["9 answers; allowed: 1 to 8"]);
    let parts = ["no scale of the trailing shutter exists", " | "];
    refuse(&[changed(|file| file.answers.truncate(1))], &parts);
    for (change, parts) in read_table("answers") {
        let mut file = serde_json::to_value(session(3)).unwrap();
        let (pointer, value) = change.split_once(' ').unwrap();
        *file.pointer_mut(pointer).unwrap() = serde_json::from_str(value).unwrap();
        refuse(&[serde_json::from_value(file).unwrap()], &parts);
    }

    let text = serde_json::to_string(&session(3)).unwrap();
    let [named, strange] = [
        ("\"seed\"", "\"name\":\"A. Person\",\"seed\""),
        ("\"left\"", "\"neither\\n::error::\""),
    ]
    .map(|(from, to)| text.replacen(from, to, 1));
    for (text, parts) in [
        ("{}", &["is no file of answers: it has no format"][..]),
        (&text[..200], &["is no file of answers"]),
        (&named, &["unknown field `name`"]),
        (&strange, &["unknown field `neither", "| ::error::`"]),
        (
            r#"{"format":1}"#,
            &["is no file of answers", "missing field"],
        ),
    ] {
        sandbox.put("answers_0.json", text);
        sandbox.refuse("people preferences answers_0.json", parts);
    }
    assert_runs_are_told_apart(sandbox, &write_answers(sandbox, &[session(1)]));
}

/// Swaps both sides of an answer. A check of one clip looks the same from both sides, so it gets another scene.
fn swap_sides(file: &mut AnswerFile) {
    let own = &mut file.answers[4];
    std::mem::swap(&mut own.left, &mut own.right);
    own.scene.name = "plate".to_owned() + if own.left == own.right { "s" } else { "" };
}

/// Another seed makes other truths, a changed filter makes other pictures.
fn assert_runs_are_told_apart(sandbox: &Sandbox, names: &[String]) {
    let with_run = preferences(names, &["--run", "out"]);
    let refuse = |parts: &[&str]| assert_refused(&sandbox.shuttertruth(&with_run), 2, parts);
    sandbox.execute(&with_run);
    let output = sandbox.path("out/plate/identity_default/output.png");
    let before = fs::read(&output).unwrap();
    fs::copy(sandbox.path("out/plate/truth_trailing.png"), &output).unwrap();
    refuse(&["another run: the pictures differ"]);
    fs::write(&output, before).unwrap();
    sandbox.execute(&with_run);
    sandbox.measure(&format!("--filters {FILTERS} --seed 2 --jitter-frames 0"));
    refuse(&["another run: the truths differ"]);
    sandbox.measure("--filters identity --no-cache");
    refuse(&["is not the run", "fits nothing"]);
}
