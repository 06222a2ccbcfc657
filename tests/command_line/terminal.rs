//! Output to terminals, pipes and files.

use std::fs;
use std::io::{BufRead, BufReader};
use std::process::Stdio;

use filters::Filter;
use serde_json::Value;
use tests::text::assert_contains;

use crate::sandbox::{IDENTITY, Sandbox, assert_done, quick_command, split, stderr, stdout};

/// First character of every colour code.
const ESCAPE: char = '\u{1b}';

/// Variables that affect colours.
const VARIABLES: [&str; 4] = ["CI", "NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE"];

/// Makes a sandbox whose scenes have a limit that the identity breaks.
fn make_bounded() -> Sandbox {
    bounded(Sandbox::new())
}

/// Gives the scenes of a sandbox such a limit.
fn bounded(sandbox: Sandbox) -> Sandbox {
    let reason = "it serves a test of the terminal, and has a reason that takes more than one line of eighty columns to say";
    let bounds = format!("[default]\nflip_moving = {{ limit = 0.2, why = \"{reason}\" }}\n");
    sandbox.put("scenes/bounds.toml", bounds);
    sandbox
}

#[track_caller]
fn assert_fits(text: &str) {
    for line in text.lines() {
        // A path may be longer than its line.
        let fits = line.chars().count() <= 80 || line.contains('/');
        assert!(fits, "more than 80 columns: {line}");
    }
}

#[test]
fn output_fits_80_columns() {
    let sandbox = make_bounded();
    sandbox.copy_scene("a_scene_with_a_rather_long_name", |text| {
        text.replace("-1.6", "-0.8")
    });
    fs::remove_dir_all(sandbox.path("scenes/plate")).unwrap();
    let filters = "--filters jump_flood_packed:corrected,identity";
    let check = stdout(&sandbox.check(&split(filters)));
    assert_contains(&check, &["BROKEN flip_moving"]);
    assert_fits(&check);
    // The run reuses the check's renders.
    let run = quick_command("run", "64").join(" ");
    assert_fits(&sandbox.done(&format!("{run} {filters}")));
    fs::rename(sandbox.path("out"), sandbox.path("first")).unwrap();
    let other = format!("{run} --truths first {filters} --set jump_flood_packed.samples=2");
    sandbox.done(&other);
    let compared = sandbox.done("compare first out");
    assert_contains(&compared, &["jump_flood_packed:corrected.samples"]);
    assert_fits(&compared);
    assert_fits(&sandbox.execute(&["list"]));
}

#[test]
fn only_terminals_get_colours_and_no_color_disables_them() {
    let sandbox = bounded(Sandbox::checked());
    fs::remove_file(sandbox.path("scenes/plate/bounds.toml")).unwrap();
    let with = |variables: &[(&str, &str)], more: &[&str]| {
        let words = quick_command("check", "64");
        let mut command = sandbox.command(&[&words[..], &IDENTITY, more].concat());
        for name in VARIABLES {
            command.env_remove(name);
        }
        command.envs(variables.iter().copied());
        stdout(&command.output().unwrap())
    };
    let plain = with(&[], &[]);
    assert!(plain.contains("BROKEN"), "{plain:?}");
    assert!(!plain.contains(ESCAPE), "{plain:?}");
    let forced = with(&[("CLICOLOR_FORCE", "1")], &[]);
    assert!(forced.contains(ESCAPE), "{forced:?}");
    let refused = with(&[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1")], &[]);
    assert_eq!(refused, plain);
    let json = with(&[("CLICOLOR_FORCE", "1")], &["--json"]);
    assert!(!json.contains(ESCAPE), "{json:?}");
    let list = |color: &str| sandbox.execute(&["list", "--color", color]);
    assert!(list("always").contains(ESCAPE));
    assert!(!list("never").contains(ESCAPE));
}

/// The program gets a terminal from `script`, which is part of every Debian (util-linux).
#[cfg(target_os = "linux")]
#[test]
fn a_terminal_shows_progress_and_respects_no_color() {
    let sandbox = make_bounded();
    sandbox.add_slow_scene();
    let on_terminal = |no_color: bool| {
        // One replicate takes longer than the interval at which progress bars are redrawn.
        let words = "check --out out --size 64x32 --samples-per-pixel 1024 --filters identity";
        let line = format!("{} {words}", env!("CARGO_BIN_EXE_shuttertruth"));
        let mut command = std::process::Command::new("script");
        command.args(["--quiet", "--return", "--command", &line, "/dev/null"]);
        command.current_dir(sandbox.path(".")).env("TERM", "xterm");
        for name in VARIABLES {
            command.env_remove(name);
        }
        if no_color {
            command.env("NO_COLOR", "1");
        }
        let output = command.output().expect("script, of util-linux");
        assert_eq!(output.status.code(), Some(1), "{}", stdout(&output));
        stdout(&output)
    };
    // Bold and red.
    let parts = [
        "\u{1b}[1m\u{1b}[31mBROKEN",
        "2 scenes in all",
        "plate trailing, replicate ",
        "plate blurs and scores",
        " left",
    ];
    assert_contains(&on_terminal(false), &parts);
    let plain = on_terminal(true);
    assert!(plain.contains("BROKEN"), "{plain:?}");
    assert!(!plain.contains("[31m"), "{plain:?}");
}

#[test]
fn json_output_has_no_other_text() {
    let sandbox = bounded(Sandbox::measured());
    let tune = "--quiet --filter jump_flood --objective flip --size 64x32 --samples-per-pixel 16 --out tuned";
    let vary = format!("{tune} --vary samples");
    let run = quick_command("run", "16").join(" ") + " --filter identity --html page.html";
    for (line, key) in [
        (run.clone(), "/cases"),
        (run.replace("run", "check"), "/findings"),
        ("compare out out".to_owned(), "/changes"),
        ("report out --html page.html".to_owned(), "/0/bytes"),
        ("list".to_owned(), "/scenes"),
        (format!("tune search {vary} --budget 2"), "/front"),
        (format!("tune sensitivity {vary} --rows 2"), "/parameters"),
        (format!("tune compare paper corrected {tune}"), "/flip"),
    ] {
        let output = sandbox.outside_ci(&split(&format!("{line} --json")));
        let text = stdout(&output);
        let value: Value = serde_json::from_str(&text)
            .unwrap_or_else(|error| panic!("{line}: {error}: {text}{}", stderr(&output)));
        let entry = value.pointer(key).unwrap_or(&Value::Null);
        assert!(!entry.is_null(), "{line}: {key}");
    }
}

#[test]
fn long_work_is_announced() {
    let sandbox = Sandbox::new();
    let mut run = sandbox.command(&split("run --samples-per-pixel 8192 --size 320x180"));
    run.stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = run.spawn().unwrap();
    let lines = BufReader::new(child.stderr.take().unwrap()).lines();
    let mut lines = lines.map_while(Result::ok);
    let expected = lines.find(|line| line.starts_with("expected: about "));
    child.kill().unwrap();
    child.wait().unwrap();
    let expected = expected.expect("the time is announced before anything is rendered");
    // Without named filters, a run takes all of them. Seven references have a trailing shutter and
    // six a centred one.
    let filters = Filter::builtin_names().into_iter();
    let presets = filters.map(|name| Filter::builtin(&name).unwrap().presets.len());
    let cases = format!("; {} cases", presets.sum::<usize>() + 13);
    let parts = [" min on ", "MB in out", "GB of memory", &cases];
    assert_contains(&expected, &parts);
}

/// Without a terminal, and on drivers that have nothing to say: Mesa complains where no session has
/// set XDG_RUNTIME_DIR.
#[test]
fn a_short_run_prints_nothing_on_standard_error() {
    let sandbox = Sandbox::measured();
    let words = "run --out out --size 64x32 --samples-per-pixel 16 --filters identity";
    let mut run = sandbox.command(&split(words));
    let output = run.env("XDG_RUNTIME_DIR", "/dev/null").output().unwrap();
    assert_done(&output);
    let said = stderr(&output);
    assert!(said.is_empty(), "{said}");
}
