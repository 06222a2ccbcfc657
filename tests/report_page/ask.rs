//! The page that asks people, from its keys to the scale of the answers.

use std::time::{Duration, Instant};

use serde_json::{Value, json};
use study::{Clip, Question, ShownPair, Study, draw_session};
use tests::text::assert_contains;

use crate::browser::{Browser, address_of};
use crate::sandbox::Sandbox;

const FILTERS: &str = "jump_flood:paper,velocity_gather:fine,identity";

/// Number of a clip on the page.
fn code(clip: Clip) -> i64 {
    match clip {
        Clip::Filter(filter) => filter as i64,
        Clip::Truth => -1,
        Clip::Sharp => -2,
    }
}

fn plain(pair: &ShownPair) -> Value {
    json!([pair.shutter, pair.scene, code(pair.left), code(pair.right)])
}

/// Waits until a question can be answered.
fn wait(browser: &mut Browser, question: usize) {
    browser.until(&format!(
        "document.body.dataset.asked === '{question}' && document.body.dataset.ready === 'true'"
    ));
}

/// Returns the key of an attentive person who prefers filters of smaller numbers.
fn key(pair: &ShownPair) -> &'static str {
    let rank = |clip| match code(clip) {
        -2 => 100,
        rank => rank,
    };
    match rank(pair.left) - rank(pair.right) {
        ..0 => "ArrowLeft",
        0 => "ArrowDown",
        1.. => "ArrowRight",
    }
}

/// Reads the session stored in the browser.
fn kept(browser: &mut Browser) -> Value {
    let text = browser.text("localStorage.getItem(localStorage.key(0))");
    serde_json::from_str(&text).unwrap()
}

/// Makes a page that asks; returns its study.
fn ask(sandbox: &Sandbox, more: &[&str]) -> Study {
    let words = ["people", "ask", "out", "--json"];
    let written = sandbox.execute(&[&words, more].concat());
    let written: Value = serde_json::from_str(&written).unwrap();
    serde_json::from_value(written["study"].clone()).unwrap()
}

#[test]
fn answers_by_keys_survive_a_reload_and_become_a_scale() {
    let sandbox = Sandbox::new();
    sandbox.measure(&format!("--filters {FILTERS} --frames 3 --fps 5"));
    let study = ask(&sandbox, &["--out", "a page"]);
    let page = sandbox.path("a page/index.html");
    let mut browser = Browser::new(1280, 800);
    browser.save_to(&sandbox.path("saved"));
    browser.open(&page, "");
    let start = browser.text("document.getElementById('start').innerText");
    assert_contains(&start, &["There are 5 questions", "no difference"]);
    assert!(!start.contains("jump_flood"), "{start}");
    browser.press("Tab");
    browser.click("#begin");
    wait(&mut browser, 0);
    let seed = kept(&mut browser)["seed"].as_u64().unwrap();
    let pairs = draw_session(&study, Question::Truth, seed);
    assert_eq!(pairs.len(), 5);

    // Three clips in step: a canvas shows the frame's picture, at a whole number of pixels.
    for frame in ["1", "2", "0"] {
        browser.until(&format!("document.body.dataset.frame === '{frame}'"));
    }
    let sizes = browser.value(
        "$$('#stage canvas').map(own => [own.width, own.getBoundingClientRect().width / own.width])",
    );
    // As many as fit 800 pixels with two rows of 32, and words around them.
    let zoom = sizes[0][1].as_u64().expect("it is a whole number");
    assert!((6..=9).contains(&zoom), "{sizes}");
    assert_eq!(sizes, json!([[64, zoom], [64, zoom], [64, zoom]]));
    let shown = browser.text("document.getElementById('asking').innerText");
    let parts = ["Which looks more like the truth?", "question 1 of 5"];
    assert_contains(&shown, &parts);
    let mut names = study.shutters[0].filters.iter();
    assert!(!names.any(|name| shown.contains(name)), "{shown}");

    for (index, pair) in pairs.iter().enumerate().take(2) {
        wait(&mut browser, index);
        browser.press("r");
        browser.press(key(pair));
        // Too early to be an answer.
        browser.press("ArrowLeft");
    }
    wait(&mut browser, 2);
    assert_eq!(kept(&mut browser)["answers"].as_array().unwrap().len(), 2);
    browser.open(&page, "");
    let verdict = browser.read("#verdict");
    assert_eq!(verdict, "Stopped");
    browser.click("#resume");
    for (index, pair) in pairs.iter().enumerate().skip(2) {
        wait(&mut browser, index);
        if index == 3 {
            browser.press("Escape");
            let given = browser.read("#given");
            assert_contains(&given, &["3 of 5"]);
            browser.click("#resume");
            wait(&mut browser, index);
        }
        browser.press(key(pair));
    }
    browser.until("document.getElementById('verdict').textContent === 'Thank you'");
    browser.click("#save");
    let name = format!("saved/answers_{seed}.json");
    let start = Instant::now();
    while !sandbox.path(&name).is_file() {
        assert!(start.elapsed().as_secs() < 20, "nothing was saved");
        std::thread::sleep(Duration::from_millis(20));
    }
    let file: Value = sandbox.read_json(&name);
    assert_eq!(file["display"]["viewport"], json!([1280, 800]));
    assert_eq!(file["answers"][0]["zoom"], zoom);
    let printed = sandbox.execute(&["people", "preferences", &name, "--run", "out", "--json"]);
    let printed: Value = serde_json::from_str(&printed).unwrap();
    let question = &printed["questions"][0];
    assert_eq!(question["sessions"][0]["failed_checks"], 0);
    let filters = question["scales"][0]["filters"].as_array().unwrap();
    let order: Vec<&Value> = filters.iter().map(|own| &own["filter"]).collect();
    assert_eq!(order, study.shutters[0].filters.iter().collect::<Vec<_>>());
    let scores = question["scales"][0]["scores"].as_array().unwrap();
    assert!(scores.iter().any(|own| own["score"] == "jod"), "{scores:?}");

    browser.value("confirm = () => true; document.getElementById('fresh').click()");
    assert_eq!(browser.value("localStorage.length"), 0);
    assert!(browser.shows("#begin"));
    assert_eq!(browser.complaints(), [""; 0]);
    let folder = address_of(page.parent().unwrap());
    let requests = browser.requests();
    assert!(requests.len() > 5);
    for request in requests {
        let is_own = request.starts_with(&format!("{folder}/")) || request.starts_with("blob:");
        assert!(is_own, "{request}");
    }
}

#[test]
fn the_page_draws_the_sessions_that_the_program_expects() {
    let sandbox = Sandbox::new();
    sandbox.add_slow_scene();
    let more = "velocity_gather:coarse,bevy:high,kino,three:corrected";
    sandbox.measure(&format!("--filters {FILTERS},{more}"));
    let study = ask(&sandbox, &["--question", "better", "--pairs", "13"]);
    assert_eq!(study.shutters.len(), 2);
    let mut browser = Browser::new(390, 700);
    browser.open(&sandbox.path("out/ask/index.html"), "");
    for most_pairs in [7, 13, 20, 1000] {
        let mut study = study.clone();
        study.most_pairs = most_pairs;
        let text = serde_json::to_string(&study).unwrap();
        for (question, seeds) in [
            (Question::Truth, 0..20),
            (Question::Better, (1 << 53) - 10..(1 << 53)),
        ] {
            let name = question.name();
            let (first, count) = (seeds.start, seeds.end - seeds.start);
            let found = browser.value(&format!(
                "[...Array({count}).keys()].map(at => drawSession({text}, '{name}', {first} + at).map(own => [own.shutter, own.scene, own.left, own.right]))"
            ));
            let draw = |seed| -> Vec<Value> {
                let pairs = draw_session(&study, question, seed);
                pairs.iter().map(plain).collect()
            };
            let due: Vec<Vec<Value>> = seeds.map(draw).collect();
            assert_eq!(found, json!(due), "{most_pairs} {name}");
        }
    }

    // A page with one question asks that, and shows no truth. In too small a window it says so, and accepts no answer.
    assert_eq!(browser.value("document.documentElement.scrollWidth"), 390);
    browser.click("#begin");
    wait(&mut browser, 0);
    assert!(!browser.shows("#truth"));
    browser.resize(100, 700);
    browser.until("document.getElementById('misfit').checkVisibility()");
    let misfit = browser.read("#misfit");
    assert_contains(&misfit, &["128 x 32"]);
    browser.press("ArrowLeft");
    assert_eq!(kept(&mut browser)["answers"], json!([]));
    browser.resize(390, 700);
    browser.until("!document.getElementById('misfit').checkVisibility()");
    browser.press("ArrowLeft");
    wait(&mut browser, 1);
    assert_eq!(kept(&mut browser)["answers"][0]["choice"], "left");
    assert_eq!(browser.complaints(), [""; 0]);
}
