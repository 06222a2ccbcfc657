//! `tune`: the search, the journal, the results and the refusals.

mod found;
mod journal;
mod refusals;

use std::fs;

use tune::{Trial, Tuning};

use crate::sandbox::Sandbox;

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
        sandbox.copy_scene(name, |text| {
            let exposes = text.replace("nothing:", "a copy:");
            let moved = exposes.replace("translation = [-1.6,", &format!("translation = [{way},"));
            moved.replace("\"translation\"", &format!("\"{family}\""))
        });
    }
    sandbox
}

/// Tuning of five parameters by scores that do not depend on a clock.
const TUNE: &str = "tune search --quiet --filter jump_flood --from paper \
    --vary samples=2..16,probes,match_threshold,jitter,foreground_extent --objective flip,bleed \
    --size 64x32 --samples-per-pixel 16";

/// Words for two scenes, or for more.
const ON_TWO: &str = "--scenes a,b";
const ON_SEVEN: &str = "--scenes a,b,c,d,e,f,g";

/// Tunes in a folder; returns the output.
#[track_caller]
fn tune(sandbox: &Sandbox, out: &str, more: &str) -> String {
    sandbox.done(&format!("{TUNE} --out {out} {more}"))
}

fn read_journal(sandbox: &Sandbox, out: &str) -> String {
    fs::read_to_string(sandbox.path(out).join("journal.jsonl")).unwrap()
}

fn read_trials(sandbox: &Sandbox) -> Vec<Trial> {
    let journal = read_journal(sandbox, "out");
    let trials = journal.lines().skip(1).map(serde_json::from_str);
    trials.collect::<Result<_, _>>().unwrap()
}

fn read_tuning(sandbox: &Sandbox) -> Tuning {
    sandbox.read_json("out/tune.json")
}
