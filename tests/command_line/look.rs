//! Looking at results: pages that open, and runs that repeat.

use std::fs;
use std::io::{BufRead, BufReader};
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use tests::filter_folder::{copy_shipped_filter, write_script};

use crate::sandbox::{IDENTITY, Sandbox, assert_done, quick_command, split};

/// Waits until `is_done`; a minute is more than enough.
#[track_caller]
fn wait_for(what: &str, mut is_done: impl FnMut() -> bool) {
    let began = Instant::now();
    while !is_done() {
        assert!(began.elapsed() < Duration::from_secs(60), "no {what}");
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn open_gives_the_page_to_the_browser() {
    let sandbox = Sandbox::measured();
    fs::remove_file(sandbox.path("out/report.html")).unwrap();
    fs::create_dir(sandbox.path("bin")).unwrap();
    write_script(
        &sandbox.path("bin/xdg-open"),
        "echo \"$1\" > opened.tmp; mv opened.tmp opened",
    );
    let path = format!(
        "{}:{}",
        sandbox.path("bin").display(),
        std::env::var("PATH").unwrap()
    );
    let run = [&quick_command("run", "16")[..], &IDENTITY, &["--open"]].concat();
    for (words, page) in [
        (run.clone(), "out/report.html"),
        (run, "out/report.html"),
        (split("compare --open"), "out/compare.html"),
        (
            split("compare out out --html changes.html --open"),
            "changes.html",
        ),
        (split("report --open"), "out/report.html"),
    ] {
        _ = fs::remove_file(sandbox.path("opened"));
        let mut command = sandbox.command(&words);
        assert_done(&command.env("PATH", &path).output().unwrap());
        wait_for("opened page", || sandbox.path("opened").exists());
        assert_eq!(sandbox.text("opened").trim_end(), page);
        assert!(sandbox.path(page).is_file());
    }
}

/// A run that watches a copy of a filter, killed when dropped.
struct Watching(Child);

impl Drop for Watching {
    fn drop(&mut self) {
        _ = self.0.kill();
        _ = self.0.wait();
    }
}

#[test]
fn watch_runs_again_when_a_file_of_the_filter_changes() {
    let sandbox = Sandbox::new();
    copy_shipped_filter("velocity_gather", &sandbox.path("my_blur"));
    let words = split("--filter ./my_blur:fine --watch");
    let mut command = sandbox.command(&[&quick_command("run", "16")[..], &words].concat());
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    let mut watching = Watching(command.spawn().unwrap());
    let mut said = BufReader::new(watching.0.stderr.take().unwrap()).lines();
    let mut next = |part: &str| {
        let line = said.find(|line| line.as_ref().is_ok_and(|line| line.contains(part)));
        assert!(line.is_some(), "the run ended without \"{part}\"");
    };
    let watch = "watching ./my_blur; Ctrl-C ends";
    next("plate: no blur 0.");
    next(watch);
    let first = sandbox.text("out/run.json");
    // A mistake is shown, and does not end the watch.
    let kernel = sandbox.text("my_blur/velocity_gather.wgsl");
    sandbox.put("my_blur/velocity_gather.wgsl", format!("{kernel}\nwrong"));
    next("error: ./my_blur/velocity_gather.wgsl:");
    next(watch);
    assert_eq!(sandbox.text("out/run.json"), first);
    let manifest = sandbox.text("my_blur/filter.toml");
    sandbox.put("my_blur/velocity_gather.wgsl", kernel);
    sandbox.put(
        "my_blur/filter.toml",
        manifest.replacen("summary = \"", "summary = \"Changed: ", 1),
    );
    next(watch);
    assert_eq!(sandbox.text("out/previous/run.json"), first);
}

#[test]
fn watch_needs_a_folder() {
    let sandbox = Sandbox::new();
    let parts = ["--watch", "no filter of the run is a folder", "./my_blur"];
    sandbox.refuse("run --filter identity --watch", &parts);
}
