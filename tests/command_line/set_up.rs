//! Version, completions and manual pages.

use std::fs;
use std::process::Command;

use tests::root;

use crate::sandbox::{Sandbox, stdout};

/// Lists the commands, as on the page of commands: `tune search`.
fn list_commands() -> Vec<String> {
    let page = fs::read_to_string(root().join("docs/commands.md")).unwrap();
    let lines = page.lines();
    let headings = lines.filter_map(|line| line.strip_prefix("## shuttertruth "));
    headings.map(str::to_owned).collect()
}

#[test]
fn the_version_says_which_source_and_which_target() {
    let version = Sandbox::new().execute(&["--version"]);
    let begin = concat!("shuttertruth ", env!("CARGO_PKG_VERSION"), " (");
    let rest = version.trim_end().strip_prefix(begin).expect(&version);
    let (source, target) = rest.trim_end_matches(')').split_once(", ").unwrap();
    let known = ["development build", "unknown commit: built without git"];
    let is_known = known.contains(&source) || source.starts_with("commit ");
    assert!(is_known, "{version}");
    assert!(target.contains(std::env::consts::ARCH), "{version}");
    assert!(target.contains(std::env::consts::OS), "{version}");
}

#[test]
fn completions_know_every_command_in_every_shell() {
    let sandbox = Sandbox::new();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = sandbox.execute(&["completions", shell]);
        for command in list_commands() {
            let word = command.rsplit(' ').next().unwrap();
            assert!(script.contains(word), "{shell} does not complete {command}");
        }
        assert!(script.contains("scenes-dir"), "{shell} knows no options");
    }
    sandbox.refuse("completions csh", &["csh", "zsh"]);
}

#[cfg(unix)]
#[test]
fn bash_completes_commands_scenes_and_filters() {
    let sandbox = Sandbox::new();
    let completions = sandbox.done("completions bash");
    sandbox.put("completions", completions);
    for (words, completed) in [
        ("compl", "completions"),
        ("run rail", "railing"),
        ("check rail", "railing"),
        ("run fan two_s", "two_spheres"),
        ("run --filter mcg", "mcguire"),
        ("tune search --filter kin", "kino"),
        ("list rail", "railing"),
        ("list mcg", "mcguire"),
    ] {
        let all: Vec<&str> = words.split(' ').collect();
        let (word, before) = (all[all.len() - 1], all.get(all.len().wrapping_sub(2)));
        let script = format!(
            "source completions; COMP_WORDS=(shuttertruth {words}); COMP_CWORD={}; \
             _shuttertruth shuttertruth {word} {}; echo \"${{COMPREPLY[@]}}\"",
            all.len(),
            before.unwrap_or(&"shuttertruth")
        );
        let mut bash = Command::new("bash");
        bash.current_dir(sandbox.path("")).args(["-c", &script]);
        let printed = stdout(&bash.output().unwrap());
        assert_eq!(printed.trim_end(), completed, "{words}");
    }
}

#[test]
fn the_manual_has_a_page_for_every_command() {
    let sandbox = Sandbox::new();
    sandbox.execute(&["man", "--out", "pages"]);
    let read = |name: &str| {
        let page = format!("pages/{}.1", name.replace(' ', "-"));
        sandbox.text(&page)
    };
    for command in list_commands() {
        let name = format!("shuttertruth {command}");
        // In manual pages a hyphen has a backslash.
        let escaped = name.replace(' ', "\\-");
        let (parent, _) = name.rsplit_once(' ').unwrap();
        let link = format!("{escaped}(1)");
        assert!(read(parent).contains(&link), "no page leads to {command}");
        let page = read(&name);
        assert!(page.contains(&format!("{escaped} \\- ")), "{page}");
    }
    assert!(read("shuttertruth run").contains("samples\\-per\\-pixel"));
}
