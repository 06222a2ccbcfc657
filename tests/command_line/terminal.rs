//! Output to terminals, pipes and files.

use std::fs;
use std::io::{BufRead, BufReader};
use std::process::Stdio;

use crate::sandbox::{IDENTITY, Sandbox, assert_done, quick_command, stderr, stdout};

/// First character of every colour code.
const ESCAPE: char = '\u{1b}';

/// Makes a sandbox whose scenes have a limit that the identity breaks.
fn make_bounded() -> Sandbox {
    let sandbox = Sandbox::new();
    fs::write(
        sandbox.path("scenes/bounds.toml"),
        "[default]\nflip_moving = { limit = 0.2, why = \"it serves a test of the terminal, and has a reason that takes \
         more than one line of eighty columns to say\" }\n",
    )
    .unwrap();
    sandbox
}

#[track_caller]
fn assert_fits(text: &str) {
    for line in text.lines() {
        let columns = line.chars().count();
        // A path may be longer than its line.
        assert!(
            columns <= 80 || line.contains('/'),
            "{columns} columns: {line}"
        );
    }
}

#[test]
fn output_fits_80_columns() {
    let sandbox = make_bounded();
    sandbox.copy_scene("a_scene_with_a_rather_long_name", |text| {
        text.replace("-1.6", "-0.8")
    });
    let filters = ["--filters", "jump_flood_packed:corrected,identity"];
    let run = sandbox.run(&filters);
    assert_done(&run);
    assert_fits(&stdout(&run));
    let check = stdout(&sandbox.check(&filters));
    assert!(check.contains("BROKEN flip_moving"), "{check}");
    assert_fits(&check);
    fs::rename(sandbox.path("out"), sandbox.path("first")).unwrap();
    let check = sandbox.check(&[&filters[..], &["--set", "jump_flood_packed.samples=2"]].concat());
    assert_eq!(check.status.code(), Some(1), "{}", stderr(&check));
    let compared = sandbox.shuttertruth(&["compare", "first", "out"]);
    assert_done(&compared);
    assert!(stdout(&compared).contains("jump_flood_packed:corrected.samples"));
    assert_fits(&stdout(&compared));
    let list = sandbox.shuttertruth(&["list"]);
    assert_done(&list);
    assert_fits(&stdout(&list));
}

#[test]
fn only_terminals_get_colours_and_no_color_disables_them() {
    let sandbox = make_bounded();
    let with = |variables: &[(&str, &str)], more: &[&str]| {
        let words = quick_command("check", "64");
        let mut command = sandbox.command(&[&words[..], &IDENTITY, more].concat());
        for name in ["CI", "NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE"] {
            command.env_remove(name);
        }
        command.envs(variables.iter().copied());
        stdout(&command.output().unwrap())
    };
    let plain = with(&[], &[]);
    assert!(
        plain.contains("BROKEN") && !plain.contains(ESCAPE),
        "{plain:?}"
    );
    let forced = with(&[("CLICOLOR_FORCE", "1")], &[]);
    assert!(forced.contains(ESCAPE), "{forced:?}");
    let refused = with(&[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1")], &[]);
    assert_eq!(refused, plain);
    let json = with(&[("CLICOLOR_FORCE", "1")], &["--json"]);
    assert!(!json.contains(ESCAPE), "{json:?}");
}

/// The program gets a terminal from `script`, which is part of every Debian (util-linux).
#[cfg(target_os = "linux")]
#[test]
fn a_terminal_shows_progress_and_respects_no_color() {
    let sandbox = make_bounded();
    sandbox.add_slow_scene();
    // One replicate takes longer than the interval at which progress bars are redrawn.
    let words = quick_command("check", "2048");
    let words: Vec<&str> = words
        .into_iter()
        .filter(|word| *word != "--quiet")
        .collect();
    let on_terminal = |out: &str, no_color: bool| {
        let line = [&[env!("CARGO_BIN_EXE_shuttertruth")], &words[..], &IDENTITY].concat();
        let line = line.join(" ").replace("--out out", &format!("--out {out}"));
        let mut command = std::process::Command::new("script");
        command.args(["--quiet", "--return", "--command", &line, "/dev/null"]);
        command.current_dir(sandbox.path(".")).env("TERM", "xterm");
        for name in ["CI", "NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE"] {
            command.env_remove(name);
        }
        if no_color {
            command.env("NO_COLOR", "1");
        }
        let output = command.output().expect("script, of util-linux");
        assert_eq!(output.status.code(), Some(1), "{}", stdout(&output));
        stdout(&output)
    };
    // The code before the word is bold and red.
    let coloured = on_terminal("out", false);
    assert!(
        coloured.contains("\u{1b}[1m\u{1b}[31mBROKEN"),
        "{coloured:?}"
    );
    for label in [
        "2 scenes in all",
        "plate trailing, replicate ",
        "plate blurs and scores",
    ] {
        assert!(
            coloured.contains(label),
            "{label} is missing from {coloured:?}"
        );
    }
    assert!(coloured.contains(" left"), "{coloured:?}");
    let plain = on_terminal("other", true);
    assert!(
        plain.contains("BROKEN") && !plain.contains("[31m"),
        "{plain:?}"
    );
}

#[test]
fn a_short_run_prints_nothing_on_standard_error_without_a_terminal() {
    let sandbox = Sandbox::new();
    let words = quick_command("run", "16");
    let words: Vec<&str> = words
        .into_iter()
        .filter(|word| *word != "--quiet")
        .collect();
    let output = sandbox.shuttertruth(&[&words[..], &IDENTITY].concat());
    assert_done(&output);
    assert_eq!(stderr(&output), "");
}

#[test]
fn json_output_has_no_other_text() {
    let sandbox = make_bounded();
    let run = quick_command("run", "16");
    let run = [&run[..], &IDENTITY, &["--html", "page.html"]].concat();
    let check = quick_command("check", "64");
    let check = [&check[..], &IDENTITY, &["--html", "page.html"]].concat();
    let candidate = "--quiet --filter jump_flood --objective flip --size 64x32 --samples-per-pixel 16 --out tuned";
    let candidate: Vec<&str> = candidate.split(' ').collect();
    for (words, key) in [
        (run, "cases"),
        (check, "findings"),
        (vec!["compare", "out", "out"], "changes"),
        (vec!["report", "out", "--html", "page.html"], ""),
        (vec!["list"], "scenes"),
        (
            [
                &["tune", "search"],
                &candidate[..],
                &["--vary", "samples", "--budget", "2"],
            ]
            .concat(),
            "front",
        ),
        (
            [
                &["tune", "sensitivity"],
                &candidate[..],
                &["--vary", "samples", "--rows", "2"],
            ]
            .concat(),
            "parameters",
        ),
        (
            [&["tune", "compare", "paper", "corrected"], &candidate[..]].concat(),
            "flip",
        ),
    ] {
        let output = sandbox
            .command(&[&words[..], &["--json"]].concat())
            .env_remove("CI")
            .output()
            .unwrap();
        let text = stdout(&output);
        let value: serde_json::Value = serde_json::from_str(&text)
            .unwrap_or_else(|error| panic!("{words:?}: {error}: {text}{}", stderr(&output)));
        match key {
            "" => assert!(value[0]["bytes"].as_u64().unwrap() > 0, "{value}"),
            key => assert!(!value[key].is_null(), "{words:?}: {key}"),
        }
    }
}

#[test]
fn colours_can_be_forced_and_disabled() {
    let sandbox = Sandbox::new();
    let list = |color: &str| stdout(&sandbox.shuttertruth(&["list", "--color", color]));
    assert!(list("always").contains('\u{1b}'));
    assert!(!list("never").contains('\u{1b}'));
}

#[test]
fn long_work_is_announced() {
    let sandbox = Sandbox::new();
    let mut child = sandbox
        .command(&["run", "--samples-per-pixel", "8192", "--size", "320x180"])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let lines = BufReader::new(child.stderr.take().unwrap()).lines();
    let expected = lines
        .map_while(Result::ok)
        .find(|line| line.starts_with("expected: about "));
    child.kill().unwrap();
    child.wait().unwrap();
    let expected = expected.expect("the time is announced before anything is rendered");
    for words in [" min on ", "MB in out", "GB of memory", "cases"] {
        assert!(expected.contains(words), "{expected}");
    }
}

#[cfg(unix)]
#[test]
fn driver_messages_are_hidden_unless_requested_and_files_follow_the_umask() {
    use std::os::unix::fs::PermissionsExt;

    let sandbox = Sandbox::new();
    let words = [&quick_command("run", "16")[..], &["--filters", "identity"]].concat();
    let output = sandbox
        .command(&words)
        .env_remove("XDG_RUNTIME_DIR")
        .output()
        .unwrap();
    assert_done(&output);
    assert_eq!(stderr(&output), "");
    let verbose = [&words[..], &["-v"]].concat();
    let output = sandbox
        .command(&verbose)
        .env_remove("XDG_RUNTIME_DIR")
        .output()
        .unwrap();
    assert_done(&output);
    let probe = sandbox.path("probe");
    fs::write(&probe, "").unwrap();
    let mode = |path: &std::path::Path| fs::metadata(path).unwrap().permissions().mode();
    for file in [
        "run.json",
        "report.html",
        "plate/frame.exr",
        "plate/frame.png",
    ] {
        assert_eq!(
            mode(&sandbox.path("out").join(file)),
            mode(&probe),
            "{file}"
        );
    }
}
