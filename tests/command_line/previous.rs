//! The run before the last one, for `compare` without arguments.

use tests::text::assert_contains;

use crate::sandbox::{Sandbox, read_below};

const GATHER: &str = "--filters velocity_gather:fine";

#[test]
fn compare_alone_shows_what_the_last_run_changed_with_its_noise_and_pictures() {
    let sandbox = Sandbox::gathered();
    let alone = ["there was one run only", "name two runs"];
    sandbox.refuse("compare", &alone);
    let copy = read_below(&sandbox.path("out"));
    sandbox.write_files("before", &copy);
    sandbox.measure(&format!("{GATHER} --set velocity_gather.samples=2"));
    let changes = sandbox.done("compare --html changes.html");
    assert_contains(
        &changes,
        &["plate / velocity_gather:fine", "flip_moving", "worse"],
    );
    // As exact as with a copy of the whole folder.
    let json = |line: &str| {
        let text = sandbox.done(&format!("compare {line} --json"));
        let mut compared: serde_json::Value = serde_json::from_str(&text).unwrap();
        compared["runs"].take();
        compared
    };
    let compared = json("");
    assert_eq!(compared, json("before out"));
    assert_eq!(compared, json("out/run.json"));
    assert!(
        compared["changes"]
            .to_string()
            .contains("\"basis\":\"replicates\"")
    );
    sandbox.done("compare before out --html copied.html");
    let pictures = |page: &str| sandbox.text(page).matches("data:image/png").count();
    assert!(pictures("changes.html") >= 4);
    assert_eq!(pictures("changes.html"), pictures("copied.html"));
    // The next run moves on.
    sandbox.measure(&format!("{GATHER} --set velocity_gather.samples=2"));
    assert_contains(
        &sandbox.done("compare"),
        &["nothing changed of: velocity_gather:fine"],
    );
}

#[test]
fn a_run_that_did_not_finish_leaves_the_last_finished_one_to_compare_with() {
    let sandbox = Sandbox::measured();
    let finished = sandbox.text("out/run.json");
    sandbox.measure("--filters identity");
    assert_eq!(sandbox.text("out/previous/run.json"), finished);
    assert!(!sandbox.path("out/previous.tmp").exists());
    std::fs::rename(
        sandbox.path("out/previous"),
        sandbox.path("out/previous.tmp"),
    )
    .unwrap();
    sandbox.measure("--filters velocity_gather:fine");
    assert_eq!(sandbox.text("out/previous/run.json"), finished);
}

#[test]
fn a_scene_that_would_share_the_folder_is_refused() {
    let sandbox = Sandbox::new();
    sandbox.copy_scene("previous", |text| text.replace("-1.6", "-0.8"));
    sandbox.refuse(
        "run previous --filter identity",
        &["scenes: previous", "rename"],
    );
}
