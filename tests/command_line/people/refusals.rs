//! Answers that are refused.

use std::fs;

use serde_json::json;
use study::{AnswerFile, Question};

use super::{FILTERS, answer, make_study, prefer_first, preferences, write_answers};
use crate::sandbox::{Sandbox, assert_done, assert_refused};

#[test]
fn answers_that_no_page_of_this_run_asked_for_are_refused() {
    let sandbox = Sandbox::new();
    let study = make_study(&sandbox, &[]);
    let session = |seed| answer(&study, Question::Truth, seed, |pair, _| prefer_first(pair));
    let refuse = |files: &[AnswerFile], parts: &[&str]| {
        let names = write_answers(&sandbox, files);
        assert_refused(&sandbox.shuttertruth(&preferences(&names, &[])), 2, parts);
    };
    let changed = |change: fn(&mut AnswerFile)| {
        let mut file = session(3);
        change(&mut file);
        file
    };
    refuse(
        &[session(1), session(1)],
        &[
            "answers_1.json: has the seed 1 of answers_0.json",
            "counts once",
        ],
    );
    refuse(
        &[changed(|file| file.format = 2)],
        &["answers_0.json: has format 2; allowed: 1"],
    );
    refuse(
        &[changed(|file| file.seed = 4)],
        &["answer 1 of 8 is about", "the seed 4 shows"],
    );
    refuse(
        &[changed(|file| {
            let own = &mut file.answers[4];
            std::mem::swap(&mut own.left, &mut own.right);
            // A check of one clip looks the same from both sides.
            own.scene.name = "plate".to_owned() + if own.left == own.right { "s" } else { "" };
        })],
        &["answer 5 of 8 is about"],
    );
    refuse(
        &[changed(|file| file.answers.push(file.answers[0].clone()))],
        &["9 answers; allowed: 1 to 8"],
    );
    refuse(
        &[changed(|file| file.answers.clear())],
        &["0 answers; allowed: 1 to 8"],
    );
    refuse(
        &[changed(|file| file.answers[0].milliseconds = -1.0)],
        &["answer 1 of 8 took -1 milliseconds"],
    );
    refuse(
        &[changed(|file| file.seed = 1 << 60)],
        &["allowed: 0 to 9007199254740991"],
    );
    refuse(
        &[
            session(1),
            changed(|file| file.study.pictures = "0".to_owned()),
        ],
        &["answers_1.json: answers about other pictures than answers_0.json: the pictures differ"],
    );
    refuse(
        &[changed(|file| file.study.shutters[0].filters.truncate(1))],
        &["its page has this many filters"],
    );
    refuse(
        &[changed(|file| {
            file.study.shutters[0].blurred_scenes = vec![7]
        })],
        &["differs from the sharp frame"],
    );
    // One answer is no scale.
    refuse(
        &[changed(|file| file.answers.truncate(1))],
        &["no scale of the trailing shutter exists", " | "],
    );

    let refuse_text = |text: &str, parts: &[&str]| {
        fs::write(sandbox.path("answers_0.json"), text).unwrap();
        assert_refused(
            &sandbox.shuttertruth(&["people", "preferences", "answers_0.json"]),
            2,
            parts,
        );
    };
    let text = serde_json::to_string(&session(3)).unwrap();
    refuse_text("{}", &["is no file of answers: it has no format"]);
    refuse_text(&text[..200], &["is no file of answers"]);
    refuse_text(
        &text.replacen("\"seed\"", "\"name\":\"A. Person\",\"seed\"", 1),
        &["unknown field `name`"],
    );
    refuse_text(
        &text.replacen("\"left\"", "\"neither\\n::error::\"", 1),
        &["unknown field `neither", "| ::error::`"],
    );
    refuse_text(
        &json!({"format": 1}).to_string(),
        &["is no file of answers", "missing field"],
    );

    // Another run: another seed makes other truths, a filter that changed makes other pictures.
    let names = write_answers(&sandbox, &[session(1)]);
    let with_run = preferences(&names, &["--run", "out"]);
    assert_done(&sandbox.shuttertruth(&with_run));
    let output = sandbox.path("out/plate/identity_default/output.png");
    let before = fs::read(&output).unwrap();
    fs::copy(sandbox.path("out/plate/truth_trailing.png"), &output).unwrap();
    assert_refused(
        &sandbox.shuttertruth(&with_run),
        2,
        &["another run: the pictures differ"],
    );
    fs::write(&output, before).unwrap();
    assert_done(&sandbox.shuttertruth(&with_run));
    assert_done(&sandbox.run(&["--filters", FILTERS, "--seed", "2"]));
    assert_refused(
        &sandbox.shuttertruth(&with_run),
        2,
        &["another run: the truths differ"],
    );
    assert_done(&sandbox.run(&["--filters", "identity", "--no-cache"]));
    assert_refused(
        &sandbox.shuttertruth(&with_run),
        2,
        &["is not the run", "fits nothing"],
    );
}
