//! Answers that are refused.

use std::fs;

use study::{AnswerFile, Question, Study};
use tests::text::read_rows;

use super::{FILTERS, answer, prefer_first, preferences, write_answers};
use crate::sandbox::{Sandbox, assert_refused};

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
    for (change, parts) in read_rows(
        r#"
        /format 2 => answers_0.json: has format 2; allowed: 1
        /seed 4 => answer 1 of 8 is about | the seed 4 shows
        /seed 1152921504606846976 => allowed: 0 to 9007199254740991
        /answers [] => 0 answers; allowed: 1 to 8
        /answers/0/milliseconds -1.0 => answer 1 of 8 took -1 milliseconds
        /study/shutters/0/filters ["identity:default"] => its page has this many filters
        /study/shutters/0/telling_scenes [7] => differs from the sharp frame"#,
    ) {
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
