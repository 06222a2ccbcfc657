//! Scenes at other frame rates, with a shutter in frames or in time.

use frame::{Image, read_exr};
use metrics::Metric;
use suite::{Case, ShutterRule};
use tests::filter_folder::{one_kernel_without_parameters, write_manifest, write_script};
use tracer::{FrameRate, SceneId};

use crate::sandbox::{IDENTITY, Sandbox, assert_done, assert_refused, split, stdout};

/// Rates and shutters of most tests. The plate is at 60 frames per second, with an exposure of half a frame: 1/120 s.
const RATES: &str = "--frame-rate 24,60,144 --shutter-time 1/120";

fn names(cases: &[Case]) -> Vec<String> {
    let names = cases
        .iter()
        .map(|case| format!("{} {}", case.scene, case.name()));
    names.collect()
}

#[track_caller]
fn find<'a>(cases: &'a [Case], scene: &str, name: &str) -> &'a Case {
    let mut own = cases.iter();
    let own = own.find(|case| case.scene == scene && case.name() == name && !case.is_reference);
    own.unwrap_or_else(|| panic!("no {scene} {name} among {:?}", names(cases)))
}

fn read_output(sandbox: &Sandbox, case: &Case) -> Image {
    let file = sandbox.path("out").join(&case.folder).join("output.exr");
    read_exr(&file).unwrap().color("").unwrap()
}

#[test]
fn a_run_takes_every_scene_at_every_rate() {
    let sandbox = Sandbox::two_scenes();
    let output = sandbox.run(&[&IDENTITY[..], &split(RATES)].concat());
    assert_done(&output);
    let cases = sandbox.read_filter_cases();
    let expected = [
        "plate",
        "slow",
        "plate@24fps",
        "slow@24fps",
        "plate@144fps",
        "slow@144fps",
        "plate@24fps_1-120s",
        "slow@24fps_1-120s",
        "plate@60fps_1-120s",
        "slow@60fps_1-120s",
        "plate@144fps_1-120s",
        "slow@144fps_1-120s",
    ];
    let scenes: Vec<String> = cases.iter().map(|case| case.scene.to_string()).collect();
    assert_eq!(scenes, expected);
    for (scene, exposure) in [
        ("plate", 0.5),
        ("plate@24fps", 0.5),
        ("plate@144fps", 0.5),
        ("plate@24fps_1-120s", 0.2),
        ("plate@60fps_1-120s", 0.5),
        ("plate@144fps_1-120s", 1.2),
    ] {
        let case = find(&cases, scene, "identity:default");
        assert_eq!(case.exposure, exposure, "{scene}");
        let id: SceneId = scene.parse().unwrap();
        assert_eq!(case.rate, id.rate);
        let json = serde_json::to_value(case).unwrap();
        let rate = case.rate.map(|rate| rate.per_second);
        assert_eq!(json["rate"]["per_second"].as_f64(), rate, "{scene}");
    }

    // The rate of the file, and a shutter as long as there, give the numbers of a run without the options.
    let alone = Sandbox::two_scenes();
    assert_done(&alone.run(&IDENTITY));
    let whole = alone.read_run();
    let run = sandbox.read_run();
    for case in &whole.cases {
        for rate in [None, FrameRate::in_word("60fps_1-120s")] {
            let scene = SceneId {
                rate,
                ..case.scene.clone()
            };
            let mut own = run.cases.iter();
            let own = own.find(|own| {
                (&own.scene, own.name(), own.is_reference)
                    == (&scene, case.name(), case.is_reference)
            });
            let [own, case] = [own.unwrap(), case].map(|case| &case.scores);
            let text = |scores| serde_json::to_string(scores).unwrap();
            assert_eq!(text(own), text(case), "{scene}");
        }
    }
    let means = |run: &suite::Run| -> Vec<suite::Overall> {
        let written = run.overall.iter().filter(|mean| mean.rate.is_none());
        written.cloned().collect()
    };
    assert_eq!(means(&run), whole.overall);
    // Skill applies at some rates only: where the shutter is open for long enough that the oracle gains more than noise.
    let count = |run: &suite::Run| {
        let means = run.overall.iter();
        means
            .filter(|mean| !matches!(mean.metric, Metric::Skill(_)))
            .count()
    };
    assert_eq!(count(&run), 6 * count(&whole));
    let head = |text: &str| text.lines().take(4).map(str::to_owned).collect::<Vec<_>>();
    let printed = stdout(&output);
    let own = stdout(&alone.run(&IDENTITY));
    assert_eq!(head(&printed), head(&own));

    // Each rate has a row, with what doing nothing scores.
    assert!(printed.contains("frame rate"), "{printed}");
    let flip = |rate: &str| {
        let row = printed
            .lines()
            .find(|line| line.trim_start().starts_with(&format!("{rate} ")));
        let row = row.unwrap_or_else(|| panic!("no {rate}: {printed}"));
        row.split_whitespace()
            .last()
            .unwrap()
            .parse::<f64>()
            .unwrap()
    };
    assert_eq!(flip("as written"), flip("60fps_1-120s"));
    assert!(flip("24fps") > flip("as written") && flip("as written") > flip("144fps"));
    // A shutter in time sees as much motion at every rate.
    let [slow, fast] = ["24fps_1-120s", "144fps_1-120s"].map(flip);
    assert!((slow - fast).abs() < 0.02, "{slow} {fast}");
    assert!(!own.contains("frame rate"), "{own}");
}

#[test]
fn rates_are_kept_and_stay_in_the_run() {
    let sandbox = Sandbox::new();
    let words = [&IDENTITY[..], &split("--frame-rate 24,144")].concat();
    assert_done(&sandbox.run(&words));
    let first = sandbox.read_run();
    let written = |scene: &str| {
        let truth = sandbox.path("out").join(scene).join("truth_trailing.exr");
        std::fs::metadata(truth).unwrap().modified().unwrap()
    };
    let before = ["plate", "plate@24fps", "plate@144fps"].map(written);
    let again = sandbox.run(&words);
    assert_done(&again);
    assert_eq!(
        ["plate", "plate@24fps", "plate@144fps"].map(written),
        before
    );
    assert_eq!(names(&sandbox.read_run().cases), names(&first.cases));
    // A narrower run keeps the others, and a scene is named with its rate.
    assert_done(&sandbox.run(&[&IDENTITY[..], &["--scenes", "plate@24fps"]].concat()));
    assert_eq!(sandbox.read_filter_cases().len(), 3);
    assert_eq!(written("plate@24fps"), before[1]);
    // Runs of the same rates compare, and pages show them.
    std::fs::rename(sandbox.path("out"), sandbox.path("first")).unwrap();
    assert_done(&sandbox.run(&words));
    let compared = sandbox.execute(&["compare", "first", "out", "--html", "compared.html"]);
    let compared = compared.split_whitespace().collect::<Vec<_>>().join(" ");
    for part in [
        "nothing changed of: identity:default 24fps, identity:default, identity:default 144fps",
        "0 worse, 0 better, 0 within margin, 0 within noise",
    ] {
        assert!(compared.contains(part), "{compared}");
    }
    let page = std::fs::read_to_string(sandbox.path("out/report.html")).unwrap();
    assert!(page.contains("plate@144fps"));
}

#[test]
fn a_rule_of_the_shutter_is_the_blur_of_another_exposure() {
    let sandbox = Sandbox::new();
    let rules = "--input rule=right,in_frames,in_time,in_time_capped,share_falls";
    let words = format!(
        "--filters velocity_gather:fine --frame-rate 24,144 --shutter-time 1/120,1/19.2 {rules}"
    );
    assert_done(&sandbox.run(&split(&words)));
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
    for (scene, rule, same) in [
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
    ] {
        let [own, other] = [output(scene, rule), output(same, "right")];
        assert!(own == other, "{scene} rule={rule} is not {same}");
    }
    // Frames of 24 and 144 per second show the plate at the same place: only the length of the blur differs.
    let [right, wrong] = ["right", "in_frames"].map(|it| output("plate@144fps_1-120s", it));
    assert!(right != wrong);
    let case = find(&cases, "plate@24fps", &format!("{name} rule=share_falls"));
    assert_eq!(case.input.rule, ShutterRule::ShareFalls);
    // The truth stays that of the scene.
    let plain = find(&cases, "plate@24fps", name);
    assert_eq!(case.truth_hash, plain.truth_hash);
    assert_eq!(case.exposure, plain.exposure);
}

#[test]
fn filters_know_the_rate() {
    let sandbox = Sandbox::new();
    let manifest = |name: &str, more: &str| {
        format!(
            "name = \"{name}\"\nsummary = \"It serves a test.\"\nalignment = \"trailing\"\n{more}\n[[pass]]\nentry = \"work\"\n"
        )
    };
    let rate = "textureStore(output, pixel, vec4<f32>(frame.frames_per_second, frame.exposure, 0.0, 1.0));";
    sandbox.write_filter(
        "knows",
        &manifest("knows", ""),
        &one_kernel_without_parameters(rate),
    );
    let convention = |per: &str| format!("[convention]\nframes_per_second = 60\n{per}\n");
    sandbox.write_filter(
        "says",
        &manifest("says", &convention("")),
        &one_kernel_without_parameters(rate),
    );
    let speed =
        "textureStore(output, pixel, vec4<f32>(textureLoad(velocity, pixel, 0).xy, 0.0, 1.0));";
    let kernel = "@group(0) @binding(4) var velocity: texture_2d<f32>;\n".to_owned()
        + &one_kernel_without_parameters(speed);
    sandbox.write_filter(
        "speed",
        &manifest("speed", &convention("velocity_per = \"second\"")),
        &kernel,
    );
    let bound = "#version 450
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f, set = 0, binding = 0) uniform writeonly image2D output_image;
layout(push_constant, std430) uniform Params { float rate; float time; } params;
void main() { imageStore(output_image, ivec2(gl_GlobalInvocationID.xy), vec4(params.rate, params.time, 0.0, 1.0)); }
";
    sandbox.write_filter("bound", "", "");
    std::fs::write(
        sandbox.path("bound/bound.glsl"),
        format!("#[compute]\n{bound}"),
    )
    .unwrap();
    std::fs::write(
        sandbox.path("bound/filter.toml"),
        "name = \"bound\"\nsummary = \"It serves a test.\"\nalignment = \"trailing\"\n\
         [convention]\nframes_per_second = 60\n[[pass]]\nshader = \"bound.glsl\"\n\
         [[pass.binding]]\nbinding = 0\ntexture = \"output\"\n\
         [[pass.binding]]\npush_constants = true\nvalues = { rate = \"frames_per_second\", time = \"delta_time\" }\n",
    )
    .unwrap();
    std::fs::remove_file(sandbox.path("bound/bound.wgsl")).unwrap();
    write_manifest(
        &sandbox.path("program"),
        "program",
        "command = [\"./blur.sh\", \"{frame}\", \"{out}\", \"{frames_per_second}\"]",
    );
    write_script(
        &sandbox.path("program/blur.sh"),
        "echo $3 >> rates.txt; cp $1 $2",
    );
    assert_done(&sandbox.run(&split(
        "--filters ./knows,./says,./speed,./bound,./program --allow-commands --frame-rate 24,144 --jitter-frames 0",
    )));
    let cases = sandbox.read_filter_cases();
    let middle = |scene: &str, name: &str| {
        *read_output(&sandbox, find(&cases, scene, &format!("{name}:default"))).at(32, 16)
    };
    for (scene, rate) in [
        ("plate", 60.0),
        ("plate@24fps", 24.0),
        ("plate@144fps", 144.0),
    ] {
        for name in ["knows", "says"] {
            assert_eq!(middle(scene, name), [rate, 0.5, 0.0], "{scene} {name}");
        }
        assert_eq!(middle(scene, "bound"), [rate, 1.0 / rate, 0.0], "{scene}");
        // Pixels per second are the same at every rate.
        let [speed, plain] = [scene, "plate"].map(|scene| middle(scene, "speed")[0]);
        assert!(
            plain > 500.0 && (speed - plain).abs() < 1e-2,
            "{speed} {plain}"
        );
    }
    let told = std::fs::read_to_string(sandbox.path("program/rates.txt")).unwrap();
    let told: std::collections::BTreeSet<&str> = told.lines().collect();
    assert_eq!(told.into_iter().collect::<Vec<_>>(), ["144", "24", "60"]);
}

#[test]
fn a_sequence_is_shown_at_its_rate() {
    let sandbox = Sandbox::new();
    let words = "--frames 3 --frame-rate 24 --scenes plate --filters identity --fps";
    let run = |fps: &str| assert_done(&sandbox.run(&[&split(words)[..], &[fps]].concat()));
    run("60");
    let jod = |sandbox: &Sandbox, scene: &str| {
        let run = sandbox.read_run();
        let mut own = run.sequences.iter();
        let own = own.find(|own| own.scene == scene && own.name == "identity:default");
        let jod = own
            .expect("it has a sequence")
            .scores
            .get(metrics::SequenceMetric::Jod);
        jod.value().unwrap()
    };
    let [written, slow] = ["plate", "plate@24fps"].map(|scene| jod(&sandbox, scene));
    // The rate of the scenes' files does not touch those at another.
    run("30");
    assert_ne!(jod(&sandbox, "plate"), written);
    assert_eq!(jod(&sandbox, "plate@24fps"), slow);
}

#[test]
fn rates_that_are_none_are_refused() {
    let sandbox = Sandbox::new();
    for (words, code, parts) in [
        ("--frame-rate 0", 2, ["--frame-rate", "1 to 1000"]),
        ("--frame-rate=-24", 2, ["-24", "1 to 1000"]),
        ("--frame-rate nan", 2, ["nan", "1 to 1000"]),
        ("--frame-rate fast", 2, ["fast", "1 to 1000"]),
        ("--frame-rate 1001", 2, ["1001", "1 to 1000"]),
        (
            "--frame-rate 24,144,24",
            2,
            ["--frame-rate: 24", "named twice"],
        ),
        ("--shutter-time 48", 2, ["48", "1/1 to 1/100000"]),
        ("--shutter-time 1/0", 2, ["1/0", "1/1 to 1/100000"]),
        (
            "--shutter-time 1/48,1/48",
            2,
            ["--shutter-time: 1/48", "named twice"],
        ),
        (
            "--shutter-time 1/48 --exposure 1",
            2,
            ["--exposure", "plate@60fps_1-48s"],
        ),
        (
            "--scenes plate@24fps --frame-rate 30",
            2,
            ["plate@24fps", "a frame rate of its own"],
        ),
        (
            "--scenes plate@24fps,plate --frame-rate 24",
            2,
            ["plate@24fps", "a frame rate of its own"],
        ),
        ("--input rule=always", 2, ["always", "in_time_capped"]),
    ] {
        let words = [&["--scenes", "plate"][..], &split(words)].concat();
        let words = match words.iter().filter(|word| **word == "--scenes").count() {
            1 => &words[..],
            _ => &words[2..],
        };
        assert_refused(&sandbox.run(&[&IDENTITY[..], words].concat()), code, &parts);
    }
    assert!(!sandbox.path("out").exists());
}
