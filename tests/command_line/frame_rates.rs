//! Scenes at other frame rates, with a shutter in frames or in time.

use std::collections::BTreeSet;
use std::fs;

use frame::Image;
use measure::{Case, Run, ShutterRule};
use metrics::{Metric, SequenceMetric};
use scene::{FrameRate, SceneId};
use tests::filter_folder::{write_manifest, write_script};
use tests::root;
use tests::text::{assert_contains, squeeze};

use crate::sandbox::{Sandbox, split};

/// The plate is at 60 frames per second, with an exposure of half a frame: 1/120 s.
const RATES: &str = "--filters identity --frame-rate 24,60 --shutter-time 1/120";

#[track_caller]
fn find<'a>(cases: &'a [Case], scene: &str, name: &str) -> &'a Case {
    let mut all = cases.iter();
    let case = all.find(|case| case.scene == scene && case.name() == name && !case.is_reference);
    case.unwrap_or_else(|| panic!("no {scene} {name}"))
}

fn read_output(sandbox: &Sandbox, case: &Case) -> Image {
    sandbox.read_color(&format!("out/{}/output.exr", case.folder.display()))
}

#[test]
#[ignore = "prove: every scene at every rate"]
fn a_run_takes_every_scene_at_every_rate_and_keeps_it() {
    let sandbox = Sandbox::two_scenes();
    let printed = sandbox.measure(RATES);
    let cases = sandbox.read_filter_cases();
    let rates = [
        ("", 0.5),
        ("@24fps", 0.5),
        ("@24fps_1-120s", 0.2),
        ("@60fps_1-120s", 0.5),
    ];
    let due = rates.map(|(rate, exposure)| {
        ["plate", "slow"].map(|scene| (format!("{scene}{rate}").parse().unwrap(), exposure))
    });
    let actual = cases.iter().map(|case| (case.scene.clone(), case.exposure));
    assert_eq!(actual.collect::<Vec<(SceneId, f64)>>(), due.concat());
    for case in &cases {
        let json = serde_json::to_value(case).unwrap();
        let rate = case.scene.rate.map(|rate| rate.per_second);
        assert_eq!(case.rate, case.scene.rate);
        assert_eq!(json["rate"]["per_second"].as_f64(), rate, "{}", case.scene);
    }
    let run = sandbox.read_run();
    let alone = Sandbox::two_scenes();
    let plain = alone.measure("--filters identity");
    assert_holds(&run, &alone.read_run());
    let head = |text: &str| text.lines().take(4).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(head(&printed), head(&plain));
    assert!(!plain.contains("frame rate"), "{plain}");
    assert_rows_of_rates(&printed);
    assert_kept(&sandbox, &run);
}

/// Compares a run with one without rates: at the file's rate, and with an equally long shutter, the
/// numbers are the same.
fn assert_holds(run: &Run, whole: &Run) {
    for case in &whole.cases {
        for rate in [None, FrameRate::in_word("60fps_1-120s")] {
            let mut scene = case.scene.clone();
            scene.rate = rate;
            let id = |case: &Case| (case.name(), case.is_reference);
            let mut all = run.cases.iter();
            let actual =
                all.find(|candidate| candidate.scene == scene && id(candidate) == id(case));
            let [actual, case] = [actual.unwrap(), case].map(|case| &case.scores);
            let text = |scores| serde_json::to_string(scores).unwrap();
            assert_eq!(text(actual), text(case), "{scene}");
        }
    }
    let written = run.overall.iter().filter(|mean| mean.rate.is_none());
    assert_eq!(written.cloned().collect::<Vec<_>>(), whole.overall);
    // Skill applies at some rates only: the shutter must be open long enough that the oracle gains
    // more than noise.
    let [all, one] = [run, whole].map(|run| {
        let metrics = run.overall.iter().map(|mean| mean.metric);
        let skills = metrics.filter(|metric| matches!(metric, Metric::Skill(_)));
        run.overall.len() - skills.count()
    });
    assert_eq!(all, 4 * one);
}

/// Checks that each rate has a row, with the score of doing nothing.
fn assert_rows_of_rates(printed: &str) {
    assert!(printed.contains("frame rate"), "{printed}");
    let flip = |rate: &str| -> f64 {
        let mut rows = printed.lines().map(split);
        let row = rows.find(|words| words.join(" ").starts_with(&format!("{rate} ")));
        let row = row.unwrap_or_else(|| panic!("no {rate}: {printed}"));
        row.last().unwrap().parse().unwrap()
    };
    assert_eq!(flip("as written"), flip("60fps_1-120s"));
    assert!(flip("24fps") > flip("as written"));
    // A shutter in time sees as much motion at every rate.
    let [slow, fast] = ["24fps_1-120s", "60fps_1-120s"].map(flip);
    assert!((slow - fast).abs() < 0.02, "{slow} {fast}");
}

/// Repeats a run: its rates are read back, stay in a narrower run, compare, and are on its page.
fn assert_kept(sandbox: &Sandbox, first: &Run) {
    let scenes = ["plate", "plate@24fps", "plate@60fps_1-120s"];
    let truths = scenes.map(|scene| format!("out/{scene}/truth_trailing.exr"));
    let written = || truths.each_ref().map(|truth| sandbox.written(truth));
    let before = written();
    sandbox.measure(RATES);
    let ids = |run: &Run| -> Vec<_> { run.cases.iter().map(|case| case.id.clone()).collect() };
    assert_eq!(ids(&sandbox.read_run()), ids(first));
    // A scene is named with its rate.
    sandbox.measure("--filters identity --scenes plate@24fps");
    assert_eq!(sandbox.read_filter_cases().len(), 8);
    assert_eq!(written(), before);
    let compared = sandbox.done("compare out out --html compared.html");
    let parts = [
        "nothing changed of: identity:default 24fps, identity:default, identity:default 24fps_1-120s",
        "0 worse, 0 better, 0 within margin, 0 within noise",
    ];
    assert_contains(&squeeze(&compared), &parts);
    let page = sandbox.text("out/report.html");
    assert!(page.contains("plate@60fps_1-120s"));
}

/// Returns the mean absolute difference of two pictures.
fn mean_difference(a: &Image, b: &Image) -> f32 {
    let pairs = a.pixels.iter().flatten().zip(b.pixels.iter().flatten());
    pairs.map(|(a, b)| (a - b).abs()).sum::<f32>() / (3 * a.pixels.len()) as f32
}

/// A scene, a rule of the shutter, and the scene that looks the same by the right rule.
const RULED: [(&str, &str, &str); 13] = [
    ("plate", "in_frames", "plate"),
    ("plate", "in_time", "plate"),
    ("plate", "in_time_capped", "plate"),
    ("plate", "share_falls", "plate"),
    ("plate@24fps", "in_frames", "plate@24fps"),
    ("plate@24fps", "in_time", "plate@24fps_1-120s"),
    ("plate@24fps", "in_time_capped", "plate@24fps_1-120s"),
    ("plate@24fps", "share_falls", "plate@24fps_1-19.2s"),
    ("plate@144fps", "in_time", "plate@144fps_1-120s"),
    ("plate@144fps", "in_time_capped", "plate@144fps"),
    ("plate@144fps_1-120s", "in_frames", "plate@144fps"),
    ("plate@144fps_1-120s", "in_time", "plate@144fps_1-120s"),
    ("plate@24fps_1-19.2s", "in_frames", "plate@24fps"),
];

#[test]
#[ignore = "prove: a second look at frame rates"]
fn a_rule_of_the_shutter_is_the_blur_of_another_exposure() {
    let sandbox = Sandbox::new();
    let rules = "--input rule=right,in_frames,in_time,in_time_capped,share_falls";
    let words = "--filters velocity_gather:fine --frame-rate 24,144 --shutter-time 1/120,1/19.2";
    sandbox.measure(&format!("{words} {rules}"));
    let cases = sandbox.read_filter_cases();
    assert_eq!(cases.len(), 7 * 5);
    let name = "velocity_gather:fine";
    let output = |scene: &str, rule: &str| {
        let name = match rule {
            "right" => name.to_owned(),
            rule => format!("{name} rule={rule}"),
        };
        read_output(&sandbox, find(&cases, scene, &name))
    };
    // Frames of 24 and 144 per second show the plate at the same place: only the length of the blur
    // differs.
    let [right, wrong] = ["right", "in_frames"].map(|rule| output("plate@144fps_1-120s", rule));
    let wrong = mean_difference(&right, &wrong);
    for (scene, rule, same) in RULED {
        let [ruled, other] = [output(scene, rule), output(same, "right")];
        // Samples are chosen for the time that the shutter is open, so that the frames' noise
        // differs.
        let difference = mean_difference(&ruled, &other);
        assert!(
            difference < 0.1 * wrong,
            "{scene} rule={rule} is not {same}: {difference} of {wrong}"
        );
    }
    let case = find(&cases, "plate@24fps", &format!("{name} rule=share_falls"));
    assert_eq!(case.input.rule, ShutterRule::ShareFalls);
    // The truth stays the scene's.
    let plain = find(&cases, "plate@24fps", name);
    assert_eq!(case.truth_hash, plain.truth_hash);
    assert_eq!(case.exposure, plain.exposure);
}

/// Writes filters that show their frame rate, and a program that logs it.
fn write_filters(sandbox: &Sandbox) {
    let sixty = "[convention]\nframes_per_second = 60";
    let rate = "textureStore(output, pixel, vec4<f32>(frame.frames_per_second, frame.exposure, 0.0, 1.0));";
    let speed =
        "textureStore(output, pixel, vec4<f32>(textureLoad(velocity, pixel, 0).xy, 0.0, 1.0));";
    sandbox.write_kernel("knows", "", &[], rate);
    sandbox.write_kernel("says", sixty, &[], rate);
    let per_second = format!("{sixty}\nvelocity_per = \"second\"");
    sandbox.write_kernel("speed", &per_second, &["velocity"], speed);
    let bound = sandbox.path("rate");
    fs::create_dir(&bound).unwrap();
    for (name, fixture) in [("filter.toml", "rate.toml"), ("rate.glsl", "rate.glsl")] {
        let fixture = root().join("tests/fixtures/filters").join(fixture);
        fs::copy(fixture, bound.join(name)).unwrap();
    }
    let command = "command = [\"./blur.sh\", \"{frame}\", \"{out}\", \"{frames_per_second}\"]";
    write_manifest(&sandbox.path("program"), "program", command);
    let script = "echo $3 >> rates.txt; cp $1 $2";
    write_script(&sandbox.path("program/blur.sh"), script);
}

#[test]
fn filters_know_the_rate() {
    let sandbox = Sandbox::new();
    write_filters(&sandbox);
    let words = "--filters ./knows,./says,./speed,./rate,./program --allow-commands";
    sandbox.measure(&format!("{words} --frame-rate 24 --jitter-frames 0"));
    let cases = sandbox.read_filter_cases();
    let middle = |scene: &str, name: &str| {
        *read_output(&sandbox, find(&cases, scene, &format!("{name}:default"))).at(32, 16)
    };
    for (scene, rate) in [("plate", 60.0), ("plate@24fps", 24.0)] {
        for name in ["knows", "says"] {
            assert_eq!(middle(scene, name), [rate, 0.5, 0.0], "{scene} {name}");
        }
        assert_eq!(middle(scene, "rate"), [rate, 1.0 / rate, 0.0], "{scene}");
        // Pixels per second are the same at every rate.
        let [speed, plain] = [scene, "plate"].map(|scene| middle(scene, "speed")[0]);
        assert!(plain > 500.0, "{plain}");
        assert!((speed - plain).abs() < 1e-2, "{speed} {plain}");
    }
    let told = sandbox.text("program/rates.txt");
    let told: BTreeSet<&str> = told.lines().collect();
    assert_eq!(told.into_iter().collect::<Vec<_>>(), ["24", "60"]);
}

/// `finished_sequence` shows one sequence at two rates.
#[test]
#[ignore = "prove: sequences at other frame rates"]
fn a_sequence_is_shown_at_its_rate() {
    let sandbox = Sandbox::new();
    let words = "--frames 2 --frame-rate 24 --scenes plate --filters identity --fps";
    sandbox.measure(&format!("{words} 60"));
    let jod = |sandbox: &Sandbox, scene: &str| {
        let run = sandbox.read_run();
        let mut all = run.sequences.iter();
        let sequence =
            all.find(|sequence| sequence.scene == scene && sequence.name == "identity:default");
        let scores = &sequence.expect("it has a sequence").scores;
        scores.get(SequenceMetric::Jod).value().unwrap()
    };
    let [written, slow] = ["plate", "plate@24fps"].map(|scene| jod(&sandbox, scene));
    // The rate of the scenes' files does not affect scenes at another rate.
    sandbox.measure(&format!("{words} 30"));
    assert_ne!(jod(&sandbox, "plate"), written);
    assert_eq!(jod(&sandbox, "plate@24fps"), slow);
}
