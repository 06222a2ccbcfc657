//! `check`: bounds as users see them.

mod calibrated;
mod formats;
mod outcomes;
mod sequences;

use std::process::Output;

use tests::text::{Parts, assert_contains, squeeze};

use crate::sandbox::{Sandbox, split, stderr, stdout};

/// A bound that the identity keeps.
const KEPT: &str = "label_tv = { limit = 0.9, why = \"it serves a test\" }\n";

/// Makes a sandbox whose scene bounds the identity's `flip_moving`, which is about 0.3, with the identity already measured.
fn make_bounded(limit: f64, level: &str) -> Sandbox {
    let sandbox = Sandbox::once(|sandbox| {
        sandbox.write("bounds.toml", &bound("flip_moving", 0.9, "required"));
        check(sandbox, "", 0, "PASS");
    });
    sandbox.write("bounds.toml", &bound("flip_moving", limit, level));
    sandbox
}

fn bound(metric: &str, limit: f64, level: &str) -> String {
    format!(
        "[default]\n\
         {metric} = {{ limit = {limit:?}, why = \"it serves a test\", level = \"{level}\" }}\n"
    )
}

/// Checks the identity.
#[track_caller]
fn check(sandbox: &Sandbox, more: &str, code: i32, parts: &(impl Parts + ?Sized)) -> String {
    let output = sandbox.check(&split(&format!("--filters identity {more}")));
    assert_ends(&output, code, parts)
}

#[track_caller]
fn assert_ends(output: &Output, code: i32, parts: &(impl Parts + ?Sized)) -> String {
    let text = stdout(output);
    assert_eq!(output.status.code(), Some(code), "{text}{}", stderr(output));
    assert_contains(&format!("{text}\n{}", squeeze(&text)), parts);
    text
}

fn json(sandbox: &Sandbox, more: &str) -> serde_json::Value {
    let output = sandbox.check(&split(&format!("--json {more}")));
    serde_json::from_slice(&output.stdout).unwrap()
}
