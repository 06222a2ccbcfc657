//! Kept replicates: resumed and added to, always with the same bytes.

use std::fs;
use std::path::Path;
use std::process::{Child, Stdio};

use frame::{read_exr, write_exr};
use tests::text::assert_contains;

use crate::child::wait_until;
use crate::sandbox::*;

/// Returns the words of a `render` of the plate into `out`.
pub fn render<'a>(out: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    let words = split("truths render --quiet --samples-per-pixel 64 --out");
    [&words[..], &[out], more].concat()
}

/// Renders a part of the replicates into `out`.
pub fn render_part(sandbox: &Sandbox, out: &str, part: &str) {
    sandbox.execute(&render(out, &["--replicates", part]));
}

pub fn spawn(sandbox: &Sandbox, words: &[&str]) -> Child {
    let mut command = sandbox.command(words);
    command.stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().unwrap()
}

/// Makes a sandbox with one process's render in `out`.
pub fn rendered() -> Sandbox {
    Sandbox::once(|sandbox| drop(sandbox.execute(&render("out", &[]))))
}

#[track_caller]
pub fn assert_whole(sandbox: &Sandbox, out: &str) {
    let whole = read_below(&rendered().path("out"));
    assert_same_files(&whole, &read_below(&sandbox.path(out)));
}

#[test]
fn a_killed_render_resumes_to_the_same_bytes() {
    let sandbox = Sandbox::new();
    let render = "truths render --quiet --samples-per-pixel 512 --threads 1 --out";
    sandbox.done(&format!("{render} whole"));
    let killed = format!("{render} killed");
    let truth = sandbox.path("killed/plate/truth_trailing");
    let replicate = |index: u32| truth.join(format!("replicate_{index:03}.exr"));
    // Each process is killed as soon as it has kept one more replicate.
    for index in [0, 2] {
        let mut child = spawn(&sandbox, &split(&killed));
        wait_until(&mut child, || replicate(index).exists());
        child.kill().unwrap();
        child.wait().unwrap();
        assert!(!truth.with_extension("exr").exists());
    }
    let written = || sandbox.written("killed/plate/truth_trailing/replicate_001.exr");
    let kept = written();
    sandbox.done(&killed);
    assert_eq!(written(), kept, "a whole replicate was rendered again");
    let [whole, mut killed] = ["whole", "killed"].map(|out| read_below(&sandbox.path(out)));
    // A killed process's unfinished file.
    killed.retain(|(name, _)| !name.to_string_lossy().contains(".tmp"));
    assert_same_files(&whole, &killed);
}

/// Rewrites a truth or a replicate like older versions.
pub fn remove_support(path: &Path) {
    let mut file = read_exr(path).unwrap();
    let written = file.channels.len();
    (file.channels).retain(|channel| !channel.name.starts_with("support."));
    assert!(file.channels.len() < written, "it has a support");
    write_exr(path, &file).unwrap();
}

#[test]
fn files_of_an_older_version_are_made_again() {
    let sandbox = rendered();
    let is_truth = |path: &Path| path.to_string_lossy().contains("truth_");
    let mut files = files_below(&sandbox.path("out"));
    files.retain(|path| is_truth(path));
    files.iter().for_each(|path| remove_support(path));
    sandbox.execute(&render("out", &[]));
    assert_whole(&sandbox, "out");
}

#[test]
fn more_replicates_reuse_the_kept_ones() {
    let sandbox = Sandbox::new();
    render_part(&sandbox, "out", "4");
    let written = || sandbox.written("out/plate/truth_trailing/replicate_000.exr");
    let before = written();
    render_part(&sandbox, "out", "8");
    assert_eq!(written(), before);
    assert_whole(&sandbox, "out");
}

#[test]
fn a_noise_target_adds_replicates_until_it_is_reached_or_reports_a_failure() {
    let sandbox = Sandbox::new();
    let number = |text: &str, before: &str| -> f64 {
        let after = text.split(before).nth(1).unwrap();
        let number = after.split([',', ' ', '\n']).next();
        number.unwrap().parse().unwrap()
    };
    let first = sandbox.execute(&render("out", &["--replicates", "2"]));
    let target = number(&first, "moving ") / 2.0;
    let until = format!("--alignments trailing,centred --replicates 2 --noise {target}");
    let text = sandbox.execute(&render("both", &split(&until)));
    // Each truth has the same bytes as a render of its number of replicates. The same command again
    // prints the same.
    for alignment in ["trailing", "centred"] {
        let label = format!("{alignment}: ");
        let line = text
            .lines()
            .find(|line| line.contains(&label))
            .expect(&text);
        assert!(number(line, "moving ") <= target, "{line}");
        // Half the noise needs four times the replicates, and the floor is an estimate.
        let count = number(line, &label);
        assert!((6.0..=14.0).contains(&count), "{line}");
        let alone = format!("--replicates {count} --alignments {alignment}");
        sandbox.execute(&render(alignment, &split(&alone)));
        let truth =
            |out| fs::read(sandbox.path(&format!("{out}/plate/truth_{alignment}.exr"))).unwrap();
        assert!(truth("both") == truth(alignment), "{alignment}");
    }
    assert_eq!(sandbox.execute(&render("both", &split(&until))), text);

    let more = split("--replicates 2 --noise 1e-9 --most-replicates 5");
    let short = sandbox.shuttertruth(&render("short", &more));
    assert_eq!(short.status.code(), Some(4));
    let parts = [
        "plate trailing",
        "moving",
        "4 replicates",
        "--most-replicates",
        "--samples-per-pixel",
    ];
    assert_contains(&stderr(&short), &parts);
    assert!(sandbox.path("short/plate/truth_trailing.exr").is_file());
}
