//! Every command of every page, run in the order of the page. `make guides` runs these tests.

mod page;
mod quick;
mod reader;
mod tables;

use std::fs;
use std::time::Instant;

use page::{Step, find_steps};
use quick::shorten;
use reader::Reader;
use tests::root;

use crate::links::find_pages;
use crate::sandbox::{stderr, stdout};

/// Commands that are not run, and why.
const NOT_RUN: [(&str, &str); 45] = [
    (
        "shuttertruth truths render --scenes railing --size 1920x1080 --alignments trailing,centred --noise 0.01 --samples-per-pixel 64 --replicates 2 --out out",
        "takes minutes; a test renders both truths of a plate to a noise",
    ),
    (
        "shuttertruth run --scenes railing@unlit,fan@unlit,crossing@unlit,pan_sky@unlit --filter bevy:default,bevy:msaa,kino:default,jimenez:slides_2014,mcguire:tuned,jump_flood:corrected --velocity previous_frame --jitter-frames 0 --size 160x90 --samples-per-pixel 64 --out out/rates --frame-rate 24,60,144 --shutter-time 1/120,1/48 --input rule=in_frames,in_time,in_time_capped,share_falls",
        "renders truths of nine rates and shutters; a test does so on a plate",
    ),
    (
        "shuttertruth check --scenes fan --filter mcguire:paper --frames 4 --out out/checked_sequence",
        "renders four frames with enough samples for limits; a test does so on a plate",
    ),
    (
        "shuttertruth limits calibrate --scenes fan --filter mcguire:paper --size 160x90 --frames 4 --runs 2 --out out/calibrated_sequence",
        "renders eight frames with enough samples for limits; a test does so on a plate",
    ),
    (
        "shuttertruth run --scenes shallow_focus,shallow_focus@on_ball,shallow_focus@resting --filter identity,bevy:default,bevy:msaa,kino:default,jimenez:slides_2014,mcguire:tuned,jump_flood:corrected --velocity previous_frame --jitter-frames 0 --size 160x90 --input depth_of_field=after --out out/depth_of_field",
        "takes minutes; a test of the catalogue renders these scenes",
    ),
    (
        "shuttertruth run --scenes glasshouse,glasshouse@written,glasshouse@resting,sparks,sparks@written,sparks@opaque --filter bevy:default,bevy:msaa,kino:default,jimenez:slides_2014,mcguire:tuned,jump_flood:corrected --velocity previous_frame --jitter-frames 0 --size 160x90 --samples-per-pixel 64 --out out/translucent",
        "takes minutes; a test of the catalogue renders these scenes",
    ),
    (
        "python3 examples/optuna_tune.py --journal study.log --trials 24 --filter jump_flood --scenes fan --size 320x180 --out tuning",
        "takes minutes; a test runs the script with two workers",
    ),
    (
        "python3 examples/optuna_tune.py --journal study.log --trials 100 --filter jump_flood --scenes fan --out tuning",
        "takes minutes; a test runs the script with two workers",
    ),
    ("pip install snakemake==9.27.1", "installs packages"),
    (
        "pip install snakemake-executor-plugin-slurm==2.8.0",
        "installs packages",
    ),
    ("cargo test --workspace", "runs this test and all others"),
    (
        "cargo install --path crates/cli",
        "compiles the program again",
    ),
    (
        "cargo install --locked --path crates/cli",
        "compiles the program again",
    ),
    (
        "cargo test -p tests --test rendering furnace",
        "a part of `make test`",
    ),
    (
        "cargo test -p cli --test command_line check",
        "a part of `make test`",
    ),
    (
        "cargo test --locked -p cli --test fuzz",
        "a part of `make test`",
    ),
    (
        "cargo test -p tests --test scoring jod_parity",
        "a part of `make test`",
    ),
    (
        "cargo test -p tests --test scoring decoy_matrix -- --nocapture",
        "a part of `make test`",
    ),
    (
        "cargo bench -p shuttertruth-tracer",
        "compiles in release mode",
    ),
    (
        "cargo bench -p shuttertruth-tracer -- truths",
        "compiles in release mode",
    ),
    (
        "cargo install wesl-cli@0.4.0",
        "compiles another program, and installs it",
    ),
    (
        "cargo install wesl-cli@0.4.0 --ignore-rust-version",
        "compiles another program, and installs it",
    ),
    (
        "python3 examples/fidelity/unmodified.py --program shuttertruth --scenes-dir scenes --out out/unmodified",
        "needs shaders that are fetched from other repositories",
    ),
    (
        "python3 examples/threejs/compare.py out/capture/railing out/render/railing",
        "needs a capture, for which three.js is installed",
    ),
    (
        "shuttertruth engine audit out/capture/railing",
        "needs a capture, for which three.js is installed",
    ),
    (
        "shuttertruth engine ingest out/capture/railing",
        "needs a capture, for which three.js is installed",
    ),
    (
        "shuttertruth run --scenes out/engine/railing --filter jimenez:slides_2014,kino,bevy:high",
        "needs a capture, for which three.js is installed",
    ),
    (
        "python3 examples/export/compare.py out/blurred.exr out/render/railing/truth_centred.exr",
        "needs a picture of Blender's",
    ),
    (
        "cargo binstall --manifest-path crates/cli/Cargo.toml cli",
        "fetches a release, of which there is none",
    ),
    (
        "cargo build --release --locked --bin shuttertruth",
        "compiles in release mode",
    ),
    (
        "cargo run -p generator",
        "writes the scenes of the checkout",
    ),
    (
        "cargo run -p cli --example report_opening -- out/report.html",
        "compiles the program again",
    ),
    (
        "cargo run -p cli --example report_screenshots -- pictures out/report.html 'out/report.html#railing/mcguire:paper'",
        "compiles the program again",
    ),
    (
        "cargo run -p cli --example results",
        "compiles the program again",
    ),
    (
        "cargo run -p cli --example results -- out/results_320x180/run.json",
        "compiles the program again",
    ),
    (
        "cargo run -p cli --example regions -- 160x90 64",
        "compiles the program again",
    ),
    (
        "cargo run -p cli --example compare_sizes -- out/160x90/run.json out/run.json",
        "compiles the program again",
    ),
    (
        "cargo run -p cli --example compare_sizes -- results/160x90_llvmpipe.json results/320x180_llvmpipe.json results/1280x720_llvmpipe.json results/1920x1080_llvmpipe.json",
        "compiles the program again",
    ),
    (
        "shuttertruth engine audit out/capture/frame_edge",
        "needs a capture, for which three.js is installed",
    ),
    ("pip install numpy OpenEXR", "installs packages"),
    ("name: motion blur", "a workflow, which GitHub runs"),
    (
        "      - uses: actions/checkout@v4",
        "steps of a workflow, which GitHub runs",
    ),
    (
        "shuttertruth people preferences answers_*.json --run out/people",
        "needs answers of people, and nobody has answered yet",
    ),
    (
        "cargo test -p suite --lib preference_scale",
        "a part of `make test`",
    ),
    (
        "shuttertruth report --gallery",
        "names an option, and is not complete",
    ),
];

/// Things that a command of a page needs: the page, the beginning of the command, and a line of shell that makes them.
const PREPARED: [(&str, &str, &str); 11] = [
    (
        "README.md",
        "shuttertruth engine import",
        "cp scenes/fan/fan.mtl . && cp scenes/fan/fan.obj my_model.obj",
    ),
    ("README.md", "shuttertruth compare", "cp -r out before"),
    (
        "README.md",
        "shuttertruth engine audit",
        "shuttertruth truths render --scenes fan --size 96x54 --samples-per-pixel 16 --velocity previous_frame --out drawn && \
         mkdir my_capture && cd my_capture && echo '[convention]' > engine.toml && for name in color velocity depth; do cp \
         ../drawn/fan/frame.exr $name.exr; done && printf 'engine = \"my engine\"\nscene = \"fan\"\n' > capture.toml",
    ),
    (
        "docs/engine-frames.md",
        "shuttertruth engine ingest",
        // An engine that draws a still picture: a frame file has all channels that a capture needs.
        "shuttertruth truths render --scenes fan --size 96x54 --samples-per-pixel 16 && mkdir -p captures/fan/subframes && \
         cd captures/fan && echo '[convention]' > engine.toml && for name in color velocity depth blurred subframes/0000 \
         subframes/0001 subframes/0002 subframes/0003; do cp ../../out/fan/frame.exr $name.exr; done && printf \
         'engine = \"my engine 1.0\"\\nscene = \"fan\"\\nexposure = 0.5\\nalignment = \"trailing\"\\n' > capture.toml",
    ),
    (
        "README.md",
        "shuttertruth score",
        "cp out/fan/truth_trailing.exr truth.exr && cp out/fan/frame.exr . && cp out/fan/identity_trailing/output.png mine.png",
    ),
    (
        "docs/add-a-filter.md",
        "shuttertruth score",
        "cp out/fan/my_blur_default/output.exr mine.exr",
    ),
    (
        "docs/ci.md",
        "shuttertruth compare",
        "cp -r checked before && cp -r checked after",
    ),
    (
        "docs/truths.md",
        "shuttertruth truths merge",
        "shuttertruth truths render --scenes fan --replicates 1..2 --size 96x54 --samples-per-pixel 16 --out part1",
    ),
    (
        "crates/suite/README.md",
        "shuttertruth check",
        "shuttertruth check --filter mcguire:paper --scenes fan",
    ),
    (
        "scenes/README.md",
        "shuttertruth report",
        "shuttertruth run --scenes fan --size 96x54 --samples-per-pixel 16",
    ),
    (
        "scenes/README.md",
        "shuttertruth engine import",
        "cp scenes/fan/fan.mtl . && cp scenes/fan/fan.obj my_model.obj",
    ),
];

/// Lists the pages, by their paths in the repository, with what their readers do.
fn read_pages() -> Vec<(String, Vec<Step>)> {
    let pages = find_pages(&root()).into_iter().map(|path| {
        let name = path.strip_prefix(root()).unwrap().display().to_string();
        (name, find_steps(&fs::read_to_string(path).unwrap()))
    });
    pages.filter(|(_, steps)| !steps.is_empty()).collect()
}

/// Finds the line of shell that makes what a command needs.
fn find_prepared(page: &str, command: &str) -> Option<&'static str> {
    let mut all = PREPARED.iter();
    let found = all.find(|(of, beginning, _)| *of == page && command.starts_with(beginning));
    found.map(|(_, _, line)| *line)
}

fn is_left_out(command: &str) -> bool {
    NOT_RUN.iter().any(|(left_out, _)| *left_out == command)
}

#[test]
fn every_exception_is_a_command_of_a_page() {
    let pages = read_pages();
    let commands: Vec<(&str, &str)> = (pages.iter())
        .flat_map(|(page, steps)| steps.iter().map(move |step| (page.as_str(), step)))
        .filter_map(|(page, step)| match step {
            Step::Run(command) => Some((page, command.as_str())),
            Step::Write { .. } => None,
        })
        .collect();
    assert!(
        commands.len() > 60,
        "only {} commands were found",
        commands.len()
    );
    for (left_out, _) in NOT_RUN {
        let shown = commands.iter().any(|(_, command)| *command == left_out);
        assert!(shown, "no page shows the exception \"{left_out}\"");
    }
    for (beginning, _) in quick::REPLACED {
        let shown = (commands.iter()).any(|(_, command)| command.starts_with(beginning));
        assert!(shown, "no page shows a command \"{beginning} ..\"");
    }
    for (page, beginning, _) in PREPARED {
        let shown =
            (commands.iter()).any(|(of, command)| *of == page && command.starts_with(beginning));
        assert!(shown, "{page} has no command \"{beginning} ..\"");
    }
}

/// Runs a command; returns what is wrong with its end.
fn find_failure(reader: &Reader, page: &str, command: &str) -> Option<String> {
    let start = Instant::now();
    let output = reader.run(command);
    let seconds = start.elapsed().as_secs_f64();
    eprintln!("{seconds:6.1} s  {page}: {command}");
    let said = || format!("{}{}", stdout(&output), stderr(&output));
    let ended = || {
        format!(
            "{page}: {command}\nends with {}:\n{}",
            output.status,
            said()
        )
    };
    (!output.status.success()).then(ended)
}

#[test]
#[ignore = "takes many minutes: `make guides` runs it"]
fn every_command_of_the_pages_ends_with_exit_code_0() {
    let mut failed = Vec::new();
    for (page, steps) in read_pages() {
        let reader = Reader::new();
        for step in steps {
            match step {
                Step::Write { path, text } => reader.write(&path, &text),
                Step::Run(command) if is_left_out(&command) => {}
                Step::Run(command) => {
                    if let Some(line) = find_prepared(&page, &command) {
                        failed.extend(find_failure(&reader, &page, line));
                    }
                    failed.extend(find_failure(&reader, &page, &shorten(&command)));
                }
            }
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}
