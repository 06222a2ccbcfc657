//! Presets that were made for another picture width.

use std::fs;

use filters::Value;
use suite::Case;
use tests::filter_folder::one_kernel;

use crate::sandbox::{Sandbox, assert_done, split, stdout};

/// Manifest of a box blur. Its parameter is a radius in pixels, for pictures four times as wide as the bench's.
const MANIFEST: &str = r#"
name = "mine"
summary = "Averages pixels to the right."
alignment = "trailing"

[[parameter]]
name = "radius"
kind = "integer"
default = 16
range = [1, 64]
unit = "pixels"
doc = "More costs more."

[[preset]]
name = "engine"
doc = "As an engine has it."
reference_width = 256

[[pass]]
entry = "work"
"#;

const BODY: &str = "
    var sum = vec4<f32>(0.0);
    for (var i = 0; i < parameters.radius; i++) {
        sum += bilinear(color, centre(pixel) + vec2<f32>(f32(i), 0.0));
    }
    textureStore(output, pixel, sum / f32(parameters.radius));
";

fn set_up() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.write_filter("mine", MANIFEST, &one_kernel("radius: i32", BODY));
    sandbox
}

/// Runs the filter and returns its case.
fn measure_case(sandbox: &Sandbox, more: &[&str]) -> Case {
    assert_done(&sandbox.run(&[&["--filter", "mine"], more].concat()));
    let mut cases = sandbox.read_run().cases.into_iter();
    cases.find(|case| case.filter == "mine").unwrap()
}

#[test]
fn a_run_scales_a_preset_to_its_width_and_reports_it() {
    let sandbox = set_up();
    let scaled = measure_case(&sandbox, &[]);
    assert_eq!(scaled.parameters["radius"], Value::Integer(4));
    assert_eq!(scaled.reference_width, Some(256));

    // The first case was kept. This is a different case, so it must not be read back.
    let written = measure_case(&sandbox, &["--as-written"]);
    assert_eq!(written.parameters["radius"], Value::Integer(16));
    assert_eq!(written.reference_width, None);
    let flip = |case: &Case| serde_json::to_string(&case.scores.moving).unwrap();
    assert_ne!(flip(&written), flip(&scaled));

    let set = measure_case(&sandbox, &["--set", "mine.radius=16"]);
    assert_eq!(set.parameters["radius"], Value::Integer(16));
    assert_eq!(set.reference_width, Some(256));
    assert_eq!(flip(&set), flip(&written));
    assert_eq!(flip(&measure_case(&sandbox, &[])), flip(&scaled));
}

#[test]
fn a_small_frame_scales_a_preset_to_its_own_width() {
    let sandbox = set_up();
    let words = split("--filter mine --input scale=50_blur_first,50_upscale_first");
    assert_done(&sandbox.run(&words));
    let cases = sandbox.read_run().cases;
    let radius = |name: &str| {
        let case = cases.iter().find(|case| case.name() == name);
        case.expect("it was measured").parameters["radius"].clone()
    };
    assert_eq!(radius("mine:engine"), Value::Integer(4));
    assert_eq!(
        radius("mine:engine scale=50_upscale_first"),
        Value::Integer(4)
    );
    assert_eq!(radius("mine:engine scale=50_blur_first"), Value::Integer(2));
}

#[test]
fn a_guard_band_is_not_part_of_the_width() {
    let sandbox = set_up();
    let case = measure_case(&sandbox, &["--guard-band", "32"]);
    assert_eq!(case.parameters["radius"], Value::Integer(4));

    let words = split("engine blur --filter ./mine --frame out/plate/frame.exr --out");
    let blur = |out: &str, more: &[&str]| {
        sandbox.execute(&[&words[..], &[out], more].concat());
        let file = frame::read_exr(&sandbox.path(out)).unwrap();
        file.color("").unwrap()
    };
    let scaled = blur("scaled.exr", &[]);
    assert_eq!(
        scaled,
        blur("set.exr", &["--set", "mine.radius=4", "--as-written"])
    );
    assert_ne!(scaled, blur("written.exr", &["--as-written"]));
}

#[test]
fn every_command_that_runs_filters_scales_presets_unless_told_not_to() {
    let sandbox = set_up();
    let json = |words: &[&str]| -> serde_json::Value {
        serde_json::from_str(&sandbox.execute(words)).unwrap()
    };
    let bench_words = split("bench --filters ./mine --size 64x32 --json --quiet");
    let radius = |more: &[&str]| {
        let done = json(&[&bench_words[..], more].concat());
        let mut cases = done["cases"].as_array().unwrap().iter();
        let case = cases.find(|case| case["filter"] == "mine").unwrap().clone();
        (
            case["parameters"]["radius"].clone(),
            case["reference_width"].clone(),
        )
    };
    assert_eq!(radius(&[]), (4.into(), 256.into()));
    assert_eq!(
        radius(&["--as-written"]),
        (16.into(), serde_json::Value::Null)
    );

    // The preset's own radius is 4 pixels here, and 16 as written.
    let evaluate = |params: &str, more: &[&str]| {
        fs::write(sandbox.path("params.json"), params).unwrap();
        let words = split(
            "tune evaluate --quiet --filter ./mine --objective flip --size 64x32 --samples-per-pixel 16 --out tuned \
             --params params.json",
        );
        json(&[&words[..], more].concat())["scenes"]["plate"]["flip"].clone()
    };
    let (scaled, written) = (evaluate("{}", &[]), evaluate("{}", &["--as-written"]));
    assert_ne!(scaled, written);
    assert_eq!(scaled, evaluate("{\"radius\": 4}", &["--as-written"]));
    assert_eq!(written, evaluate("{\"radius\": 16}", &[]));
}

#[test]
fn a_tuned_preset_records_the_width_of_its_tuning() {
    let sandbox = set_up();
    // Five scenes that are much alike tell a choice from the start, which blurs too little at their speeds.
    for (name, way) in [
        ("a", "-3.58"),
        ("b", "-3.59"),
        ("c", "-3.6"),
        ("d", "-3.61"),
        ("e", "-3.62"),
    ] {
        sandbox.copy_scene(name, |text| text.replace("-1.6", way));
    }
    let words = split(
        "tune search --quiet --filter ./mine --objective flip --size 64x32 --samples-per-pixel 16 --scenes a,b,c,d,e --budget 12 \
         --out tuned",
    );
    let preset = |more: &[&str]| {
        let _ = fs::remove_dir_all(sandbox.path("tuned"));
        let table = sandbox.execute(&[&words[..], more].concat());
        let preset = fs::read_to_string(sandbox.path("tuned/preset.toml"));
        let values: serde_json::Value = sandbox.read_json("tuned/params.json");
        (preset.expect(&table), values["radius"].to_string())
    };
    let (scaled, radius) = preset(&[]);
    assert!(scaled.contains("reference_width = 64\n"), "{scaled}");
    assert!(
        scaled.contains(&format!("\nradius = {radius}\n")),
        "{scaled}"
    );
    let (written, _) = preset(&["--as-written"]);
    assert!(!written.contains("reference_width"), "{written}");

    // The filter has the preset as soon as it is appended.
    fs::write(
        sandbox.path("mine/filter.toml"),
        format!("{MANIFEST}\n{scaled}"),
    )
    .unwrap();
    let listed = stdout(&sandbox.shuttertruth(&["list", "--filter", "mine"]));
    assert!(
        listed.contains("made for pictures 64 pixels wide"),
        "{listed}"
    );
    assert!(listed.contains(".radius = 16 pixels"), "{listed}");
}

/// Scores of filters that are scaled say little about those that are not.
#[test]
fn a_run_that_mixes_scaled_and_unscaled_filters_says_which_are_which() {
    let sandbox = set_up();
    let note = |filters: &str, more: &[&str]| {
        // A page shows the cases of earlier runs, too.
        _ = fs::remove_dir_all(sandbox.path("out"));
        let words = [&["--filters", filters, "--html", "page.html"], more].concat();
        let output = sandbox.run(&words);
        assert_done(&output);
        let page = fs::read_to_string(sandbox.path("page.html")).unwrap();
        let page = page.replace("&quot;", "\"");
        let squeeze = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        let texts = [stdout(&output), page].map(|text| squeeze(&text));
        let start = "Lengths in pixels are scaled";
        let found = texts.map(|text| {
            let note = text.split_once(start)?.1.split_once("as written.")?.0;
            Some(note.to_owned())
        });
        assert_eq!(found[0], found[1], "terminal and page");
        found[0].clone()
    };
    let manifest = MANIFEST.replace("reference_width = 256\n", "");
    sandbox.write_filter("mine", &manifest, &one_kernel("radius: i32", BODY));
    let filters = "./mine,mcguire:paper,identity";
    let says = " to pictures 64 wide for mcguire:paper, and are as written for mine:engine, whose filter.toml names no \
                reference_width. Give its lengths unit = \"pixels\" and name one, or compare all ";
    for more in [&[][..], &["--table"]] {
        assert_eq!(note(filters, more).as_deref(), Some(says));
    }
    assert_eq!(note(filters, &["--as-written"]), None);
    assert_eq!(note("mcguire:paper,identity", &[]), None);
    // A width of its own, for all presets.
    let own = manifest.replacen("[[parameter]]", "reference_width = 256\n\n[[parameter]]", 1);
    sandbox.write_filter("mine", &own, &one_kernel("radius: i32", BODY));
    assert_eq!(note(filters, &[]), None);
    let cases = sandbox.read_filter_cases();
    let case = cases.iter().find(|case| case.filter == "mine").unwrap();
    assert_eq!(case.parameters["radius"], Value::Integer(4));
    assert_eq!(case.reference_width, Some(256));
}
