//! Kept replicates: resumed, shared between processes and merged, always with the same bytes.

use std::fs;
use std::path::Path;
use std::process::{Child, Stdio};
use std::time::Duration;

use frame::{read_exr, write_exr};
use tests::text::assert_contains;

use crate::sandbox::{OBJ, Sandbox, assert_done, assert_refused, files_below, split, stdout};

/// Returns the words of a `render` of the plate into `out`.
fn render<'a>(out: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    let words = [
        "truths",
        "render",
        "--quiet",
        "--samples-per-pixel",
        "64",
        "--out",
        out,
    ];
    [&words[..], more].concat()
}

fn spawn(sandbox: &Sandbox, words: &[&str]) -> Child {
    let mut command = sandbox.command(words);
    command.stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().unwrap()
}

/// Reads the names and bytes of all files that a render leaves in a folder.
fn contents(folder: &Path) -> Vec<(String, Vec<u8>)> {
    files_below(folder)
        .into_iter()
        .map(|path| {
            let name = path.strip_prefix(folder).unwrap().display().to_string();
            (name, fs::read(path).unwrap())
        })
        .filter(|(name, _)| !name.contains(".tmp")) // what a killed process was writing
        .collect()
}

#[track_caller]
fn assert_same(sandbox: &Sandbox, one: &str, other: &str) {
    let [one, other] = [one, other].map(|folder| contents(&sandbox.path(folder)));
    let names = |files: &[(String, Vec<u8>)]| -> Vec<String> {
        files.iter().map(|(name, _)| name.clone()).collect()
    };
    assert_eq!(names(&one), names(&other));
    for ((name, one), (_, other)) in one.iter().zip(&other) {
        assert!(one == other, "{name} differs");
    }
}

#[test]
fn merged_parts_of_several_processes_equal_the_bytes_of_one() {
    let sandbox = Sandbox::new();
    sandbox.execute(&render("whole", &[]));
    let parts = [("a", "0..3"), ("b", "3..4"), ("c", "4..8")];
    let children: Vec<Child> = parts
        .map(|(out, part)| spawn(&sandbox, &render(out, &["--replicates", part])))
        .into();
    for mut child in children {
        assert!(child.wait().unwrap().success());
    }
    let merged = sandbox.shuttertruth(&["truths", "merge", "c", "a", "b", "--out", "joined"]);
    assert_done(&merged);
    assert_eq!(
        stdout(&merged),
        "joined/plate/truth_trailing.exr (8 replicates)\n"
    );
    assert_same(&sandbox, "whole", "joined");
}

#[test]
fn several_processes_can_render_into_one_folder() {
    let sandbox = Sandbox::new();
    sandbox.execute(&render("whole", &[]));
    let children: Vec<Child> = ["0..3", "2..5", "5..8", "0..8"]
        .map(|part| spawn(&sandbox, &render("shared", &["--replicates", part])))
        .into();
    for mut child in children {
        assert!(child.wait().unwrap().success());
    }
    sandbox.execute(&["truths", "merge", "shared", "--out", "shared"]);
    assert_same(&sandbox, "whole", "shared");
}

#[test]
fn a_killed_render_resumes_to_the_same_bytes() {
    let sandbox = Sandbox::new();
    let many = ["--samples-per-pixel", "32768", "--threads", "1"];
    let words =
        |out: &'static str| [&["truths", "render", "--quiet", "--out", out][..], &many].concat();
    sandbox.execute(&words("whole"));
    let replicate = |index: u32| {
        sandbox.path(&format!(
            "killed/plate/truth_trailing/replicate_{index:03}.exr"
        ))
    };
    // Each process is killed as soon as it has kept one more replicate.
    for index in [0, 1, 5] {
        let mut child = spawn(&sandbox, &words("killed"));
        while !replicate(index).exists() {
            assert!(
                child.try_wait().unwrap().is_none(),
                "the render ended before it could be killed"
            );
            std::thread::sleep(Duration::from_millis(1));
        }
        child.kill().unwrap();
        child.wait().unwrap();
        assert!(!sandbox.path("killed/plate/truth_trailing.exr").exists());
    }
    let kept = fs::metadata(replicate(1)).unwrap().modified().unwrap();
    sandbox.execute(&words("killed"));
    assert_eq!(
        fs::metadata(replicate(1)).unwrap().modified().unwrap(),
        kept,
        "a replicate that was whole was rendered again"
    );
    assert_same(&sandbox, "whole", "killed");
}

#[test]
fn files_of_older_versions_are_rendered_again_and_never_merged() {
    let sandbox = Sandbox::new();
    for out in ["whole", "old"] {
        sandbox.execute(&render(out, &[]));
    }
    let truths = files_below(&sandbox.path("old"))
        .into_iter()
        .filter(|path| {
            let name = path.file_name().unwrap().to_string_lossy();
            name.starts_with("truth_") || name.starts_with("replicate_")
        });
    for path in truths {
        let mut file = read_exr(&path).unwrap();
        let written = file.channels.len();
        (file.channels).retain(|channel| !channel.name.starts_with("support."));
        assert!(
            file.channels.len() < written,
            "{} has a support",
            path.display()
        );
        write_exr(&path, &file).unwrap();
    }
    assert_refused(
        &sandbox.shuttertruth(&["truths", "merge", "old", "--out", "joined"]),
        2,
        &[
            "replicate_000.exr: holds no support",
            "make it anew with `shuttertruth truths render`",
        ],
    );
    sandbox.execute(&render("old", &[]));
    assert_same(&sandbox, "whole", "old");
}

#[test]
fn a_broken_replicate_is_rendered_again() {
    let sandbox = Sandbox::new();
    sandbox.execute(&render("whole", &[]));
    sandbox.execute(&render("out", &["--replicates", "0..4"]));
    let replicate = sandbox.path("out/plate/truth_trailing/replicate_002.exr");
    let bytes = fs::read(&replicate).unwrap();
    fs::write(&replicate, &bytes[..bytes.len() / 2]).unwrap();
    let stray = sandbox.path("out/plate/truth_trailing/replicate_001.exr");
    fs::copy(
        sandbox.path("out/plate/truth_trailing/replicate_000.exr"),
        stray,
    )
    .unwrap();
    sandbox.execute(&render("out", &[]));
    assert_same(&sandbox, "whole", "out");
}

/// Flips one bit of a file's pixels, far behind its header.
fn flip_a_bit(path: &Path) {
    let mut bytes = fs::read(path).unwrap();
    let middle = bytes.len() * 3 / 4;
    bytes[middle] ^= 1;
    fs::write(path, bytes).unwrap();
}

#[test]
fn a_flipped_bit_in_a_replicate_never_reaches_a_truth() {
    let sandbox = Sandbox::new();
    sandbox.execute(&render("whole", &[]));
    sandbox.execute(&render("out", &["--replicates", "0..7"]));
    sandbox.execute(&render("rest", &["--replicates", "7..8"]));
    flip_a_bit(&sandbox.path("out/plate/truth_trailing/replicate_002.exr"));
    let merged = sandbox.shuttertruth(&["truths", "merge", "out", "rest", "--out", "joined"]);
    assert_refused(&merged, 2, &["out/plate/truth_trailing/replicate_002.exr"]);
    assert!(!sandbox.path("joined").exists());
    sandbox.execute(&render("out", &[]));
    assert_same(&sandbox, "whole", "out");
    // A damaged truth is made again, too.
    flip_a_bit(&sandbox.path("out/plate/truth_trailing.exr"));
    sandbox.execute(&render("out", &[]));
    assert_same(&sandbox, "whole", "out");
}

#[test]
fn a_changed_byte_in_a_mesh_renders_again() {
    let sandbox = Sandbox::new();
    sandbox.execute(&render("out", &[]));
    sandbox.write("plate.obj", &OBJ.replace("v -0.5 -0.5 0", "v -0.6 -0.5 0"));
    sandbox.execute(&render("out", &[]));
    sandbox.execute(&render("fresh", &[]));
    assert_same(&sandbox, "fresh", "out");
}

#[test]
fn more_replicates_reuse_the_kept_ones() {
    let sandbox = Sandbox::new();
    sandbox.execute(&render("out", &["--replicates", "4"]));
    let first = sandbox.path("out/plate/truth_trailing/replicate_000.exr");
    let before = fs::metadata(&first).unwrap().modified().unwrap();
    sandbox.execute(&render("out", &["--replicates", "8"]));
    assert_eq!(fs::metadata(&first).unwrap().modified().unwrap(), before);
    sandbox.execute(&render("whole", &[]));
    assert_same(&sandbox, "whole", "out");
}

#[test]
fn incomplete_parts_are_refused() {
    let sandbox = Sandbox::new();
    for (out, more) in [
        ("start", &["--replicates", "0..3"][..]),
        ("gap", &["--replicates", "5..8"]),
        ("other", &["--replicates", "0..4", "--seed", "2"]),
    ] {
        sandbox.execute(&render(out, more));
    }
    fs::create_dir(sandbox.path("empty")).unwrap();
    for (parts, complaint) in [
        (
            &["start", "gap"][..],
            &["3, 4", "replicates 3..4", "plate/truth_trailing"][..],
        ),
        (&["start"], &["replicates 3 are missing", "truth of 4"]),
        (
            &["start", "other"],
            &["start/plate/frame.exr", "other/plate/frame.exr", "differ"],
        ),
        (
            &["start", "empty"],
            &[
                "empty",
                "holds no replicates",
                "a part A..B of the replicates",
            ],
        ),
        (&["nowhere"], &["nowhere", "cannot read"]),
    ] {
        let refused =
            sandbox.shuttertruth(&[&["truths", "merge", "--out", "joined"][..], parts].concat());
        assert_refused(&refused, 2, complaint);
        assert!(
            !sandbox.path("joined").exists(),
            "a refused merge leaves nothing"
        );
    }
    // Replicates of two truths, whose files never share a name.
    sandbox.execute(&render("rest", &["--replicates", "3..4", "--seed", "2"]));
    let refused = sandbox.shuttertruth(&["truths", "merge", "start", "rest", "--out", "joined"]);
    assert_refused(
        &refused,
        2,
        &["replicate 3", "other inputs", "content hash"],
    );
    assert!(!sandbox.path("joined").exists());
}

#[test]
fn a_noise_target_adds_replicates_until_it_is_reached_or_reports_a_failure() {
    let sandbox = Sandbox::new();
    let first = stdout(&sandbox.shuttertruth(&render("out", &["--replicates", "2"])));
    let floor = |text: &str| -> f64 {
        let after = text.split("moving ").nth(1).unwrap();
        after.split([',', '\n']).next().unwrap().parse().unwrap()
    };
    let target = floor(&first) / 2.0;
    let words = format!("{target}");
    let reached = sandbox.shuttertruth(&render("out", &["--replicates", "2", "--noise", &words]));
    assert_done(&reached);
    assert!(floor(&stdout(&reached)) <= target, "{}", stdout(&reached));
    let replicates = |text: &str, alignment: &str| -> u32 {
        let after = text.split(&format!("{alignment}: ")).nth(1).unwrap();
        after.split(' ').next().unwrap().parse().unwrap()
    };
    let count = replicates(&stdout(&reached), "trailing");
    // Half the noise takes four times the replicates, and the floor is an estimate.
    assert!((6..=14).contains(&count), "{}", stdout(&reached));

    // Each truth has the bytes that a render of its number of replicates has. The same command again says the same.
    let both = ["--alignments", "trailing,centred"];
    let until = [&both[..], &["--replicates", "2", "--noise", &words]].concat();
    let text = stdout(&sandbox.shuttertruth(&render("both", &until)));
    for alignment in ["trailing", "centred"] {
        let count = replicates(&text, alignment).to_string();
        let alone = ["--replicates", &count, "--alignments", alignment];
        assert_done(&sandbox.shuttertruth(&render(alignment, &alone)));
        let truth = format!("plate/truth_{alignment}.exr");
        let [one, other] =
            ["both", alignment].map(|out| fs::read(sandbox.path(out).join(&truth)).unwrap());
        assert!(one == other, "{truth} differs");
    }
    assert_eq!(stdout(&sandbox.shuttertruth(&render("both", &until))), text);

    let more = split("--replicates 2 --noise 1e-9 --most-replicates 5");
    let short = sandbox.shuttertruth(&render("short", &more));
    assert_eq!(short.status.code(), Some(4));
    let message = String::from_utf8(short.stderr.clone()).unwrap();
    assert_contains(
        &message,
        &[
            "plate trailing",
            "moving",
            "4 replicates",
            "--most-replicates",
            "--samples-per-pixel",
        ],
    );
    assert!(sandbox.path("short/plate/truth_trailing.exr").is_file());
}
