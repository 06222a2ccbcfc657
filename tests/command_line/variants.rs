//! Kinds of frames that filters get.

use crate::bench::{Bench, assert_done, assert_refused};

/// Two colours that meet two pixels beyond the right border, where the plate is going.
const TWO_COLOURS: &str = "\
mtllib plate.mtl
v -1 -9 0
v 4.9 -9 0
v 4.9 9 0
v -1 9 0
v 12 -9 0
v 12 9 0
usemtl paint
f 1 2 3 4
usemtl other
f 2 5 6 3
";
const PAINTS: &str = "newmtl paint\nKd 0 0 0\nKe 0.7 0.4 0.2\nnewmtl other\nKd 0 0 0\nKe 0 0 1\n";

fn run(bench: &Bench, more: &[&str]) -> suite::Run {
    assert_done(&bench.run(&[&["--filters", "velocity_gather:fine"], more].concat()));
    bench.measured()
}

/// The squared error over the whole picture.
fn error(run: &suite::Run) -> f64 {
    let filter = run.cases.iter().find(|case| !case.is_reference).unwrap();
    let json = serde_json::to_value(&filter.scores).unwrap();
    json["full"]["mse"]["value"]
        .as_f64()
        .unwrap_or_else(|| panic!("{json:#}"))
}

#[test]
fn a_guard_band_takes_the_error_from_the_border() {
    let bench = Bench::new();
    bench.write("plate.obj", TWO_COLOURS);
    bench.write("plate.mtl", PAINTS);
    let bare = run(&bench, &[]);
    let padded = run(&bench, &["--guard-band", "8"]);
    assert_eq!((bare.render.guard_band, padded.render.guard_band), (0, 8));
    assert!(
        error(&padded) < 0.9 * error(&bare),
        "{} with a band, {} without",
        error(&padded),
        error(&bare)
    );
}

#[test]
fn a_run_says_what_its_frames_were() {
    let bench = Bench::new();
    let words = [
        "--velocity",
        "camera_only",
        "--frame-sampling",
        "point",
        "--sky-velocity",
        "off",
    ];
    let run = run(&bench, &words);
    let json = serde_json::to_value(&run).unwrap();
    assert_eq!(
        ["velocity", "color", "sky_velocity"].map(|key| json[key].to_string()),
        ["\"camera_only\"", "\"point\"", "false"]
    );
    let other = self::run(&bench, &[]);
    assert_ne!(
        error(&run),
        error(&other),
        "the plate's own motion is lost to the camera alone"
    );
}

#[test]
fn frames_that_cannot_be_are_refused() {
    let bench = Bench::new();
    for (more, parts) in [
        (
            ["--frame-sampling", "sharp"],
            ["sharp", "antialiased, point"],
        ),
        (["--color", "point"], ["--color", "--frame-sampling point"]),
        (["--sky-velocity", "maybe"], ["maybe", "off"]),
        (["--guard-band", "wide"], ["--guard-band", "wide"]),
        (["--guard-band", "99999"], ["200062x200030", "16384"]),
    ] {
        let refused = bench.run(&[&["--filters", "identity"][..], &more].concat());
        assert_refused(&refused, 2, &parts);
    }
}
