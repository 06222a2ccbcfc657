//! `tune`: the search, the journal, the results and the refusals.

mod found;
mod journal;
mod refusals;

use std::fs;

use tune::{Trial, Tuning};

use crate::sandbox::{MTL, OBJ, SCENE, Sandbox, split};

/// Scenes: name, distance that the plate moves in one frame in metres, and family.
const SCENES: [(&str, &str, &str); 7] = [
    ("a", "-1.6", "translation"),
    ("b", "-1.2", "camera"),
    ("c", "0.9", "thin"),
    ("d", "1.3", "translation"),
    ("e", "-0.8", "camera"),
    ("f", "1.8", "thin"),
    ("g", "-2.0", "translation"),
];

/// Makes a sandbox with scenes a to g.
fn set_up() -> Sandbox {
    let sandbox = Sandbox::new();
    for (name, way, family) in SCENES {
        let scene = SCENE
            .replace("translation = [-1.6,", &format!("translation = [{way},"))
            .replace("\"translation\"", &format!("\"{family}\""));
        let folder = sandbox.path("scenes").join(name);
        fs::create_dir_all(&folder).unwrap();
        for (file, text) in [
            ("scene.toml", scene.as_str()),
            ("plate.obj", OBJ),
            ("plate.mtl", MTL),
        ] {
            fs::write(folder.join(file), text).unwrap();
        }
    }
    sandbox
}

/// Tuning of five parameters on six scenes, by scores that do not depend on a clock.
const TUNE: &str = "tune search --quiet --filter jump_flood --from paper \
    --vary samples=2..16,probes,match_threshold,jitter,foreground_extent --objective flip,bleed \
    --scenes a,b,c,d,e,f,g --size 64x32 --samples-per-pixel 16 --budget";

fn tuning_words<'w>(out: &'w str, budget: &'w str, more: &[&'w str]) -> Vec<&'w str> {
    [&split(TUNE)[..], &[budget, "--out", out], more].concat()
}

fn read_journal(sandbox: &Sandbox, out: &str) -> String {
    fs::read_to_string(sandbox.path(out).join("journal.jsonl")).unwrap()
}

fn parse_trials(journal: &str) -> Vec<Trial> {
    let lines = journal.lines().skip(1);
    lines
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

fn read_tuning(sandbox: &Sandbox, out: &str) -> Tuning {
    sandbox.read_json(&format!("{out}/tune.json"))
}
