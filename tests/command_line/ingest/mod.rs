//! `ingest`: what an engine drew, measured as our own scenes are.

pub mod capture;
mod picture;
mod refusals;
mod use_of_folders;

use std::fs;

use capture::{Capture, SIZE};
use frame::{FAR_DEPTH, Frame, Truth, VelocityKind};
use metrics::{Measured, Metric};

use crate::sandbox::{SCENE, Sandbox, assert_done, assert_refused, split, stdout};

/// Name of the scene in every table.
const NAME: &str = "mine@Test_Engine_1.2";
const OUT: &str = "out/engine/mine";

fn ingest(sandbox: &Sandbox) -> String {
    sandbox.execute(&split("engine ingest capture --quiet -o out/engine/mine"))
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
    let near = |found: f32, due: f32| (found - due).abs() <= HALF * due.abs();
    for (found, due) in frame.color.pixels.iter().zip(&ours.color.pixels) {
        assert!(std::iter::zip(found, due).all(|(found, due)| near(*found, *due)));
    }
    for (found, due) in frame.velocity.pixels.iter().zip(&ours.velocity.pixels) {
        assert!(
            near(found[0], due[0]) && near(found[1], due[1]),
            "{found:?} {due:?}"
        );
    }
    let mut motions = frame.velocity.pixels.iter();
    let moves = motions.any(|motion| motion[0] > 9.0 && motion[1] > 4.0);
    assert!(moves, "the plate moves to the right and down");
    for (found, due) in frame.depth.pixels.iter().zip(&ours.depth.pixels) {
        assert!(near(*found, *due), "{found} {due}");
    }
    assert!(frame.depth.pixels.contains(&FAR_DEPTH), "a background");
}

#[test]
fn the_mean_of_sub_frames_is_our_truth_within_its_limit() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox).with_subframes(16);
    let told = ingest(&sandbox);
    for words in [
        "drawn by Test Engine 1.2",
        "mean of 16 sub-frames, trailing shutter, open for 0.5 frames; not path traced",
        "0.58 px between two sub-frames",
        "equivalent sub-frames are told up to 4",
        "advice: 20 sub-frames would have steps of half a pixel",
        "next: shuttertruth run --scenes plate,./out/engine/mine",
    ] {
        assert!(told.contains(words), "{words}\n{told}");
    }
    sandbox.execute(&split(
        "truths render --quiet --scenes plate --size 96x54 --samples-per-pixel 256",
    ));
    let read = |path: &str| Truth::read(&sandbox.path(path)).unwrap();
    let engines = read("out/engine/mine/truth_trailing.exr");
    let ours = read("out/plate/truth_trailing.exr");
    assert_eq!(engines.provenance.samples_per_pixel, 16, "sub-frames");
    assert_eq!(engines.shutter, ours.shutter);
    // Nothing is seen to move that does not, and little that moves is missed: the two round the edge's way differently.
    let marks = (engines.support.moving.pixels.iter()).zip(&ours.support.moving.pixels);
    let different = marks.filter(|(one, other)| one != other).count();
    let moving = ours.support.moving.pixels.iter().filter(|it| **it).count();
    assert!(different * 10 < moving, "{different} of {moving}");
    // The smear's ramp rises by the plate's contrast over 9.3 px. Sub-frames lie 0.58 px apart, so that a pixel is at most half
    // of that step off; noise of 64 samples and half floats come on top.
    let [engines, ours] = [engines.mean().color, ours.mean().color];
    for (at, (one, other)) in engines.pixels.iter().zip(&ours.pixels).enumerate() {
        let difference = (one[0] - other[0]).abs();
        assert!(
            difference < 0.5 * 0.58 / 9.3 * 0.5 + 0.02,
            "pixel {at}: {difference}"
        );
    }
}

#[test]
fn a_run_on_a_capture_scores_near_our_own_scene_and_ranks_the_engine() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox).with_subframes(32);
    ingest(&sandbox);
    let words = "run --quiet --scenes plate,out/engine/mine --samples-per-pixel 64 --filter identity,jump_flood:paper \
                 --input velocity=float32";
    let printed = sandbox.execute(&split(words));
    assert!(printed.contains("Test_Engine_1.2"), "{printed}");
    let run = sandbox.read_run();
    assert_eq!(format!("{}x{}", run.render.width, run.render.height), SIZE);
    let case = |scene: &str, filter: &str| {
        let mut cases = run.cases.iter();
        let found = cases.find(|case| case.scene == scene && case.filter == filter);
        found.unwrap_or_else(|| panic!("no {scene} / {filter}"))
    };
    let score = |scene: &str, filter: &str, metric: &str| {
        let metric: Metric = metric.parse().unwrap();
        case(scene, filter).scores.get(metric)
    };
    for filter in ["identity", "jump_flood", "scatter_oracle"] {
        let [engines, ours] = [NAME, "plate"].map(|scene| score(scene, filter, "flip_moving"));
        let [engines, ours] = [engines, ours].map(|score| score.value().unwrap());
        // The truths differ by strobing of 0.29 px, and the regions by the pixels at their borders.
        assert!(
            (engines / ours - 1.0).abs() < 0.15,
            "{filter}: {engines} {ours}"
        );
    }
    let own = case(NAME, "Test_Engine_1.2");
    assert!(!own.is_reference && own.preset.is_empty());
    assert_eq!(own.name(), "Test_Engine_1.2");
    let drawn = own.drawn.as_ref().unwrap();
    assert_eq!(
        (drawn.engine.as_str(), drawn.subframes),
        ("Test Engine 1.2", 32)
    );
    assert_eq!(drawn.scene, Some("plate".parse().unwrap()));
    assert!(case("plate", "identity").drawn.is_none());
    // What an engine's pictures do not tell is absent, and not zero.
    for metric in [
        "label_tv",
        "bleed_lateral",
        "lateral_growth",
        "energy",
        "flip_frozen",
        "flip_knowable",
        "flip_unknowable",
        "gather_offset",
    ] {
        let found = score(NAME, "jump_flood", metric);
        let Measured::NotApplicable { reason } = found else {
            panic!("{metric}: {found:?}");
        };
        assert!(
            reason.contains("an engine's sub-frames"),
            "{metric}: {reason}"
        );
    }
    let accumulations: Vec<_> = (run.cases.iter())
        .filter(|case| case.scene == NAME && case.filter == "accumulate")
        .map(|case| case.preset.as_str())
        .collect();
    assert_eq!(
        accumulations,
        ["1", "4", "8"],
        "the truth tells no more of 32 sub-frames"
    );
    // The same again is read back.
    let again = sandbox.execute(&split(words));
    assert!(again.contains("cases: 17, 17 of them read back"), "{again}");
    sandbox.execute(&split("report out --html again.html --exr layers"));
}

#[test]
fn ids_in_the_sub_frames_bring_the_scores_of_objects() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox).with_subframes_and_ids(16);
    let told = ingest(&sandbox);
    assert!(told.contains("objects: plate\n"), "{told}");
    let words = "run --quiet --scenes plate,out/engine/mine --samples-per-pixel 64 --filter jump_flood:paper \
                 --frame-sampling antialiased";
    sandbox.execute(&split(words));
    let run = sandbox.read_run();
    let score = |scene: &str, filter: &str, metric: &str| {
        let mut cases = run.cases.iter();
        let found = cases.find(|case| case.scene == scene && case.filter == filter);
        let metric: Metric = metric.parse().unwrap();
        found.unwrap().scores.get(metric).value().unwrap()
    };
    // An id is all or nothing in a pixel, where our frame has shares; sub-frames lie 0.58 px apart.
    for (filter, metric, most) in [
        ("identity", "label_tv", 0.03),
        ("scatter_oracle", "label_tv", 0.03),
        ("jump_flood", "label_tv", 0.03),
        ("jump_flood", "bleed_lateral", 0.6),
        ("jump_flood", "centroid", 0.6),
        ("jump_flood", "extent", 0.15),
    ] {
        let [engines, ours] = [NAME, "plate"].map(|scene| score(scene, filter, metric));
        assert!(
            (engines - ours).abs() < most,
            "{filter} {metric}: {engines} {ours}"
        );
    }
    let own = run
        .cases
        .iter()
        .find(|case| case.filter == "Test_Engine_1.2")
        .unwrap();
    let Measured::NotApplicable { reason } = own.scores.get("bleed_lateral".parse().unwrap())
    else {
        panic!("the engine's own picture has no mattes");
    };
    assert!(
        reason.contains("an engine's picture does not say"),
        "{reason}"
    );
    sandbox.execute(&split("report out --html again.html --exr layers"));
}

#[test]
fn a_page_says_which_truth_is_the_engines() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox).with_subframes(8);
    ingest(&sandbox);
    sandbox.execute(&split(
        "run --quiet --scenes plate,out/engine/mine --samples-per-pixel 16 --filter identity",
    ));
    let page = fs::read_to_string(sandbox.path("out/report.html")).unwrap();
    for words in [
        "<td class=\"text\">mean of 8 sub-frames that Test Engine 1.2 drew</td>",
        "<td class=\"text\">path traced</td>",
        "frame and truth are not ours",
        "Ours is that of <strong>plate</strong>, path traced",
        "traced_truth:",
        "&quot;Engine's truth&quot;",
    ] {
        assert!(page.contains(words), "{words}");
    }
}

#[test]
fn the_engines_picture_is_scored_alone_too() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox).with_subframes(8);
    ingest(&sandbox);
    let words = "score --truth out/engine/mine/truth_trailing.exr --frame out/engine/mine/frame.exr --image \
                 out/engine/mine/blurred.exr --ladder out/engine/mine/ladder_trailing";
    let told = sandbox.execute(&split(words));
    assert!(
        told.contains("truth: mean of 8 sub-frames that Test Engine 1.2 drew"),
        "{told}"
    );
    assert!(told.contains("flip"), "{told}");
}

#[test]
fn a_check_holds_an_engine_to_the_bounds_beside_its_own_scene() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox).with_subframes(16);
    ingest(&sandbox);
    // Bounds of our plate say nothing about the engine's.
    sandbox.write_bound(0.0001);
    let words = split("check --quiet --scenes out/engine/mine --filter identity");
    assert_refused(
        &sandbox.shuttertruth(&words),
        2,
        &[NAME, "has no bound", "identity"],
    );
    let bound = |limit: f64| {
        let text = format!(
            "[default]\nflip_moving = {{ limit = {limit:?}, level = \"required\", why = \"it serves a test\" }}\n"
        );
        fs::write(sandbox.path(OUT).join("bounds.toml"), text).unwrap();
        sandbox.shuttertruth(&words)
    };
    // The identity scores about 0.3, and three noise floors are about 0.15.
    assert_done(&bound(0.9));
    let broken = bound(0.2);
    assert_eq!(broken.status.code(), Some(1), "{}", stdout(&broken));
    assert!(
        !stdout(&broken).contains("95 % CI"),
        "sub-frames are no samples"
    );
    let finished = sandbox.shuttertruth(&split("check out --scenes-dir out/engine"));
    assert_eq!(finished.status.code(), Some(1), "{}", stdout(&finished));
    assert_refused(
        &sandbox.shuttertruth(&split("check out")),
        2,
        &[NAME, "--scenes-dir"],
    );
    fs::remove_file(sandbox.path(OUT).join("bounds.toml")).unwrap();
    fs::write(
        sandbox.path(OUT).join("bounds.toml"),
        "[default]\nflip_moving = { limit = 0.001, why = \"it serves a test\" }\n",
    )
    .unwrap();
    let strict = sandbox.shuttertruth(&words);
    assert_eq!(strict.status.code(), Some(2));
    let told = [stdout(&strict), crate::sandbox::stderr(&strict)].concat();
    assert!(told.contains("capture more sub-frames than 16"), "{told}");
}
