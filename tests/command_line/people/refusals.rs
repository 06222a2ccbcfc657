//! Answers that are refused.

use std::fs;

use study::{AnswerFile, Question, Study};

use super::{FILTERS, answer, prefer_first, preferences, write_answers};
use crate::sandbox::{Sandbox, assert_refused};

type Change = fn(&mut AnswerFile);

/// Answers that no page of this run asked for are refused.
pub fn assert_answers_are_refused(sandbox: &Sandbox, study: &Study) {
    let session = |seed| answer(study, Question::Truth, seed, |pair, _| prefer_first(pair));
    let refuse = |files: &[AnswerFile], parts: &[&str]| {
        let names = write_answers(sandbox, files);
        assert_refused(&sandbox.shuttertruth(&preferences(&names, &[])), 2, parts);
    };
    let parts = [
        "answers_1.json: has the seed 1 of answers_0.json",
        "counts once",
    ];
    refuse(&[session(1), session(1)], &parts);
    let changed = |change: Change| {
        let mut file = session(3);
        change(&mut file);
        file
    };
    let others = changed(|file| file.study.pictures = "0".to_owned());
    let says =
        "answers_1.json: answers about other pictures than answers_0.json: the pictures differ";
    refuse(&[session(1), others], &[says]);
    let changes: [(Change, &[&str]); 10] = [
        (
            |file| file.format = 2,
            &["answers_0.json: has format 2; allowed: 1"],
        ),
        (
            |file| file.seed = 4,
            &["answer 1 of 8 is about", "the seed 4 shows"],
        ),
        (swap_sides, &["answer 5 of 8 is about"]),
        (
            |file| file.answers.push(file.answers[0].clone()),
            &["9 answers; allowed: 1 to 8"],
        ),
        (|file| file.answers.clear(), &["0 answers; allowed: 1 to 8"]),
        (
            |file| file.answers[0].milliseconds = -1.0,
            &["answer 1 of 8 took -1 milliseconds"],
        ),
        (
            |file| file.seed = 1 << 60,
            &["allowed: 0 to 9007199254740991"],
        ),
        (
            |file| file.study.shutters[0].filters.truncate(1),
            &["its page has this many filters"],
        ),
        (
            |file| file.study.shutters[0].blurred_scenes = vec![7],
            &["differs from the sharp frame"],
        ),
        // One answer is no scale.
        (
            |file| file.answers.truncate(1),
            &["no scale of the trailing shutter exists", " | "],
        ),
    ];
    for (change, parts) in changes {
        refuse(&[changed(change)], parts);
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
            "{\"format\":1}",
            &["is no file of answers", "missing field"],
        ),
    ] {
        fs::write(sandbox.path("answers_0.json"), text).unwrap();
        sandbox.refuse("people preferences answers_0.json", parts);
    }
    assert_runs_are_told_apart(sandbox, &write_answers(sandbox, &[session(1)]));
}

/// Swaps both sides of an answer. A check of one clip looks the same from both sides: it gets another scene.
fn swap_sides(file: &mut AnswerFile) {
    let own = &mut file.answers[4];
    std::mem::swap(&mut own.left, &mut own.right);
    own.scene.name = "plate".to_owned() + if own.left == own.right { "s" } else { "" };
}

/// Another seed makes other truths, a filter that changed makes other pictures.
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
