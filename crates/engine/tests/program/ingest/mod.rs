//! `ingest`: an engine's pictures, measured like our own scenes.

pub mod capture;
mod forms;
mod picture;
mod refusals;

use std::fs;

use capture::Capture;
use frame::{FAR_DEPTH, Frame, Truth, VelocityKind};
use measure::{Case, Run};
use metrics::{Measured, Metric};
use tests::text::assert_contains;

use crate::sandbox::{SCENE, Sandbox, split, stderr, stdout};

/// Name of the scene in every table.
const NAME: &str = "mine@Test_Engine_1.2";
const OUT: &str = "out/engine/mine";

fn ingest(sandbox: &Sandbox) -> String {
    sandbox.done("engine ingest capture --quiet -o out/engine/mine")
}

/// Relative error of a half float, and of a few roundings of single ones.
const HALF: f32 = 1.01 / 2048.0;

#[test]
fn a_capture_in_another_convention_comes_back_as_our_own_frame() {
    let sandbox = Sandbox::new();
    sandbox.write("scene.toml", &SCENE.replace("-1.6, 0, 0", "-1.6, 0.8, 0"));
    let capture = Capture::new(&sandbox);
    ingest(&sandbox);
    let ours = &capture.frame;
    let frame = Frame::read(&sandbox.path(OUT).join("frame.exr")).unwrap();
    assert_eq!(frame.size(), ours.size());
    assert_eq!(frame.exposure, capture::EXPOSURE);
    assert_eq!(frame.options.velocity, VelocityKind::PreviousFrame);
    assert_eq!(frame.provenance.engine.as_deref(), Some("Test Engine 1.2"));
    assert_eq!(frame.provenance.traversal, "none", "no ray was traced");
    let near = |actual: f32, due: f32| (actual - due).abs() <= HALF * due.abs();
    for (actual, due) in frame.color.pixels.iter().zip(&ours.color.pixels) {
        assert!(std::iter::zip(actual, due).all(|(actual, due)| near(*actual, *due)));
    }
    for (actual, due) in frame.velocity.pixels.iter().zip(&ours.velocity.pixels) {
        let is_near = near(actual[0], due[0]) && near(actual[1], due[1]);
        assert!(is_near, "{actual:?} {due:?}");
    }
    let mut motions = frame.velocity.pixels.iter();
    let moves = motions.any(|motion| motion[0] > 9.0 && motion[1] > 4.0);
    assert!(moves, "the plate moves to the right and down");
    for (actual, due) in frame.depth.pixels.iter().zip(&ours.depth.pixels) {
        assert!(near(*actual, *due), "{actual} {due}");
    }
    assert!(frame.depth.pixels.contains(&FAR_DEPTH), "a background");
}

#[test]
fn the_mean_of_sub_frames_is_our_truth_within_its_limit() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox).with_subframes(16);
    let told = ingest(&sandbox);
    let parts = [
        "drawn by Test Engine 1.2",
        "mean of 16 sub-frames, trailing shutter, open for 0.5 frames; not path traced",
        "0.58 px between two sub-frames",
        "equivalent sub-frames are told up to 4",
        "advice: 20 sub-frames would have steps of half a pixel",
        "next: shuttertruth run plate,./out/engine/mine",
    ];
    assert_contains(&told, &parts);
    sandbox.done("truths render --quiet --scenes plate --size 96x54 --samples-per-pixel 64");
    let read = |path: &str| Truth::read(&sandbox.path(path)).unwrap();
    let engines = read("out/engine/mine/truth_trailing.exr");
    let ours = read("out/plate/truth_trailing.exr");
    assert_eq!(engines.provenance.samples_per_pixel, 16, "sub-frames");
    assert_eq!(engines.shutter, ours.shutter);
    // No still pixel counts as moving, and few moving ones are missed: the two round the edge's
    // path differently.
    let marks = (engines.support.moving.pixels.iter()).zip(&ours.support.moving.pixels);
    let different = marks.filter(|(one, other)| one != other).count();
    let moving = ours
        .support
        .moving
        .pixels
        .iter()
        .filter(|moves| **moves)
        .count();
    assert!(different * 10 < moving, "{different} of {moving}");
    // The smear's ramp rises by the plate's contrast over 9.3 px. Sub-frames are 0.58 px apart, so
    // a pixel is off by at most half of that step; noise of 64 samples and half floats come on top.
    let [engines, ours] = [engines.mean().color, ours.mean().color];
    for (at, (one, other)) in engines.pixels.iter().zip(&ours.pixels).enumerate() {
        let difference = (one[0] - other[0]).abs();
        let most = 0.5 * 0.58 / 9.3 * 0.5 + 0.02;
        assert!(difference < most, "pixel {at}: {difference}");
    }
}

/// Finds a filter's case, on the plate or on the engine's picture.
fn find<'a>(run: &'a Run, scene: &str, filter: &str) -> &'a Case {
    let mut cases = run.cases.iter();
    let case = cases.find(|case| case.scene == scene && case.filter == filter);
    case.unwrap_or_else(|| panic!("no {scene} / {filter}"))
}

/// Reads a filter's score, on the engine's picture and on the plate.
fn read_scores(run: &Run, filter: &str, metric: &str) -> [f64; 2] {
    let metric: Metric = metric.parse().unwrap();
    [NAME, "plate"].map(|scene| {
        let scores = &find(run, scene, filter).scores;
        scores.get(metric).value().unwrap()
    })
}

#[track_caller]
fn assert_absent(case: &Case, metric: &str, why: &str) {
    let score = case.scores.get(metric.parse().unwrap());
    let is_due = matches!(&score, Measured::NotApplicable { reason } if reason.contains(why));
    assert!(is_due, "{metric}: {score:?}");
}

#[test]
fn a_run_on_a_capture_scores_near_our_own_scene_and_ranks_the_engine() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox).with_subframes(32);
    ingest(&sandbox);
    let words = "run --quiet --scenes plate,out/engine/mine --samples-per-pixel 64 --filter identity,jump_flood:paper \
                 --input velocity=float32";
    let printed = sandbox.done(words);
    assert_contains(&printed, &["Test_Engine_1.2"]);
    // This table has the filters that blur both frames, and the engine's blur of its own frame.
    let twins = printed.split("whose frames").nth(1).unwrap();
    let row = |name: &str| -> Vec<&str> {
        let mut lines = twins.lines().map(|line| line.split_whitespace());
        let row = lines.find(|words| words.clone().next() == Some(name));
        row.unwrap_or_else(|| panic!("{name}: {printed}")).collect()
    };
    assert_eq!(row("ours"), ["ours", "Test_Engine_1.2"]);
    assert_eq!(row("Test_Engine_1.2")[1], "n/a");
    let mut cells = row("jump_flood:paper").into_iter().skip(1);
    assert!(cells.all(|cell| cell < row("[identity]")[1]));
    // The filter is scaled; the engine's picture has no filter.toml to name a width in.
    assert!(!printed.contains("reference_width"), "{printed}");
    let run = sandbox.read_run();
    let scaled = find(&run, NAME, "jump_flood").reference_width;
    assert!(scaled.is_some_and(|width| width != 96), "{scaled:?}");
    assert_eq!(run.render.size().to_string(), "96x54");
    for filter in ["identity", "jump_flood", "scatter_oracle"] {
        let [engines, ours] = read_scores(&run, filter, "flip_moving");
        // The truths differ by strobing of 0.29 px, and the regions by the pixels at their borders.
        let ratio = engines / ours;
        assert!((ratio - 1.0).abs() < 0.15, "{filter}: {engines} {ours}");
    }
    let case = find(&run, NAME, "Test_Engine_1.2");
    assert!(!case.is_reference && case.preset.is_empty());
    assert_eq!(case.name(), "Test_Engine_1.2");
    let drawn = case.drawn.as_ref().unwrap();
    assert_eq!(drawn.engine, "Test Engine 1.2");
    assert_eq!(drawn.subframes, 32);
    assert_eq!(drawn.scene, Some("plate".parse().unwrap()));
    assert!(find(&run, "plate", "identity").drawn.is_none());
    // Scores that an engine's pictures do not allow are absent, not zero.
    let metrics = "label_tv bleed_lateral lateral_growth energy flip_frozen flip_knowable flip_unknowable gather_offset";
    for metric in split(metrics) {
        let case = find(&run, NAME, "jump_flood");
        assert_absent(case, metric, "an engine's sub-frames");
    }
    let cases = run.cases.iter();
    let ladder = cases.filter(|case| case.scene == NAME && case.filter == "accumulate");
    // 32 sub-frames allow no more rungs.
    assert!(ladder.map(|case| &case.preset).eq(["1", "4", "8"]));
    // The second run reads it back.
    let again = sandbox.done(words);
    assert_contains(&again, &["cases: 17, 17 of them read back"]);
}

#[test]
fn a_capture_without_velocity_has_the_scores_of_colour_and_says_what_is_left_out() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox).add_subframes(8, true);
    for name in ["velocity.exr", "depth.exr", "engine.toml"] {
        fs::remove_file(capture.path(name)).unwrap();
    }
    let told = ingest(&sandbox);
    let parts = [
        "left out: filters that read velocity or depth: the capture has no velocity and no depth",
        "left out: bleed, growth, loss",
        "mean of 8 sub-frames",
    ];
    assert_contains(&told, &parts);
    assert!(
        !told.contains("no velocity reaches them") && !told.contains("0.00 px"),
        "{told}"
    );
    let words =
        "run --scenes out/engine/mine --samples-per-pixel 64 --jitter-frames 0 --out out --filter";
    let output = sandbox.shuttertruth(&split(&format!("{words} identity,jump_flood:paper")));
    assert_contains(
        &stderr(&output),
        &["leaves out 1 preset because the capture does not have velocity"],
    );
    let run = sandbox.read_run();
    let engine = find(&run, NAME, "Test_Engine_1.2");
    for case in [engine, find(&run, NAME, "identity")] {
        assert!(case.scores.get(Metric::FLIP).value().unwrap() > 0.0);
        for metric in split("bleed_lateral lateral_growth extent centroid") {
            assert_absent(case, metric, "the capture has no velocity");
        }
        let contamination = case.scores.get(Metric::OccluderContamination);
        assert_eq!(
            contamination.value(),
            None,
            "nobody knows what stands still"
        );
        assert!(case.smear.is_none());
    }
    sandbox.refuse(&format!("{words} jump_flood:paper"), &["no filter is left"]);
    let scene = "out/engine/mine";
    let line = format!(
        "score --truth {scene}/truth_trailing.exr --frame {scene}/frame.exr --image {scene}/frame.exr"
    );
    assert_contains(
        &sandbox.done(&line),
        &["extent", "the capture has no velocity"],
    );
    sandbox.refuse(
        "engine audit capture",
        &["velocity.exr: there is no such file"],
    );
    // Without sub-frames nothing is left to measure.
    fs::remove_dir_all(capture.path("subframes")).unwrap();
    sandbox.refuse(
        "engine ingest capture -o out/engine/mine",
        &["velocity.exr: there is no such file", "save that buffer"],
    );
}

#[test]
fn ids_in_the_sub_frames_bring_the_scores_of_objects() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox).add_subframes(16, true);
    let told = ingest(&sandbox);
    assert!(told.contains("objects: plate\n"), "{told}");
    let words = "run --quiet --scenes plate,out/engine/mine --samples-per-pixel 64 --filter jump_flood:paper \
                 --frame-sampling antialiased";
    sandbox.done(words);
    let run = sandbox.read_run();
    // An id is all or nothing in a pixel, unlike the shares in our frame; sub-frames are 0.58 px
    // apart.
    for (filter, metric, most) in [
        ("identity", "label_tv", 0.03),
        ("scatter_oracle", "label_tv", 0.03),
        ("jump_flood", "label_tv", 0.03),
        ("jump_flood", "bleed_lateral", 0.6),
        ("jump_flood", "centroid", 0.6),
        ("jump_flood", "extent", 0.15),
    ] {
        let [engines, ours] = read_scores(&run, filter, metric);
        let difference = (engines - ours).abs();
        assert!(difference < most, "{filter} {metric}: {engines} {ours}");
    }
    let case = find(&run, NAME, "Test_Engine_1.2");
    assert_absent(case, "bleed_lateral", "an engine's picture does not say");
    sandbox.done("report out --html again.html --exr layers");
}

#[test]
fn an_engine_s_truth_and_picture_are_named_wherever_they_are_scored() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox).with_subframes(8);
    ingest(&sandbox);
    let words = "score --truth out/engine/mine/truth_trailing.exr --frame out/engine/mine/frame.exr --image \
                 out/engine/mine/blurred.exr --ladder out/engine/mine/ladder_trailing";
    let told = sandbox.done(words);
    let truth = "truth: mean of 8 sub-frames that Test Engine 1.2 drew";
    assert_contains(&told, &[truth, "flip"]);
    sandbox.done(
        "run --quiet --scenes plate,out/engine/mine --samples-per-pixel 16 --filter identity",
    );
    let page = sandbox.text("out/report.html");
    let parts = [
        "<td class=\"text\">mean of 8 sub-frames that Test Engine 1.2 drew</td>",
        "traced_truth:",
        "<td class=\"text\">path traced</td>",
        "frame and truth are not ours",
        "&quot;Engine's truth&quot;",
        "Our own, path traced, is <strong>plate</strong>",
    ];
    assert_contains(&page, &parts);
}

#[test]
fn a_check_holds_an_engine_to_the_bounds_beside_its_own_scene() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox).with_subframes(16);
    ingest(&sandbox);
    // Bounds of our plate do not apply to the engine's.
    sandbox.write_bound(0.0001);
    let words = "check --quiet --scenes out/engine/mine --filter identity";
    sandbox.refuse(words, &[NAME, "has no bound", "identity"]);
    let bound = |limit: &str| {
        let text = format!("[default]\nflip_moving = {{ {limit}, why = \"it serves a test\" }}\n");
        fs::write(sandbox.path(OUT).join("bounds.toml"), text).unwrap();
        let output = sandbox.shuttertruth(&split(words));
        let told = stdout(&output) + &stderr(&output);
        (output.status.code(), told)
    };
    // The identity scores about 0.3, and three noise floors are about 0.15.
    let (code, told) = bound("limit = 0.9, level = \"required\"");
    assert_eq!(code, Some(0), "{told}");
    let (code, told) = bound("limit = 0.2, level = \"required\"");
    assert_eq!(code, Some(1), "{told}");
    assert!(!told.contains("95 % CI"), "sub-frames are no samples");
    let finished = sandbox.shuttertruth(&split("check --run out --scenes-dir out/engine"));
    assert_eq!(finished.status.code(), Some(1), "{}", stdout(&finished));
    sandbox.refuse("check --run out", &[NAME, "--scenes-dir"]);
    let (code, told) = bound("limit = 0.001");
    assert_eq!(code, Some(2));
    assert_contains(&told, &["capture more sub-frames than 16"]);
}
