//! Presets that were made for another picture width.

use std::fs;

use filters::Value;
use measure::Case;
use serde_json::Value as Json;
use tests::filter_folder::one_kernel;
use tests::text::assert_contains;

use crate::sandbox::{Sandbox, assert_done, split, stdout};

/// Manifest of a box blur. Its parameter is a radius in pixels, for pictures four times as wide as
/// the sandbox's.
const MANIFEST: &str = include_str!("../fixtures/filters/box_blur.toml");
const BODY: &str = include_str!("../fixtures/filters/box_blur.wgsl");

fn set_up() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.write_filter("mine", MANIFEST, &one_kernel("radius: i32", BODY));
    sandbox
}

/// Runs the filter and returns its case.
fn measure_case(sandbox: &Sandbox, more: &str) -> Case {
    sandbox.measure(&format!("--filter mine {more}"));
    let mut cases = sandbox.read_run().cases.into_iter();
    cases.find(|case| case.filter == "mine").unwrap()
}

#[test]
fn a_run_scales_a_preset_to_its_width_and_reports_it() {
    let sandbox = set_up();
    let measure = |more: &str, radius: i32, width: Option<u32>| {
        let case = measure_case(&sandbox, more);
        assert_eq!(case.parameters["radius"], Value::Integer(radius), "{more}");
        assert_eq!(case.reference_width, width, "{more}");
        serde_json::to_string(&case.scores.moving).unwrap()
    };
    let scaled = measure("", 4, Some(256));
    // The first case was kept. With lengths as written the case is another, so the kept one must
    // not be read back.
    let written = measure("--as-written", 16, None);
    assert_ne!(written, scaled);
    assert_eq!(measure("--set mine.radius=16", 16, Some(256)), written);
    assert_eq!(measure("", 4, Some(256)), scaled);

    // A smaller frame has its own width; a guard band is not part of the width.
    sandbox.measure("--filter mine --input scale=50_blur_first,50_upscale_first");
    let cases = sandbox.read_run().cases;
    for (form, radius) in [
        ("", 4),
        (" scale=50_upscale_first", 4),
        (" scale=50_blur_first", 2),
    ] {
        let mut all = cases.iter();
        let case = all.find(|case| case.name() == format!("mine:engine{form}"));
        let value = &case.expect("it was measured").parameters["radius"];
        assert_eq!(*value, Value::Integer(radius), "{form}");
    }
    fs::remove_dir_all(sandbox.path("out")).unwrap();
    measure("--guard-band 32", 4, Some(256));

    let blur = |more: &str| {
        let words = "engine blur --filter ./mine --frame out/plate/frame.exr --out b.exr";
        sandbox.done(&format!("{words} {more}"));
        sandbox.read_color("b.exr")
    };
    let scaled = blur("");
    assert_eq!(scaled, blur("--set mine.radius=4 --as-written"));
    assert_ne!(scaled, blur("--as-written"));
}

#[test]
fn tuning_scales_presets_unless_told_not_to() {
    let sandbox = set_up();
    let json = |line: &str| -> Json { serde_json::from_str(&sandbox.done(line)).unwrap() };
    // The preset's own radius is 4 pixels here, and 16 as written.
    let evaluate = |params: &str, more: &str| {
        sandbox.put("params.json", params);
        let words = "tune evaluate --quiet --filter ./mine --objective flip --size 64x32 --samples-per-pixel 16 --out tuned";
        json(&format!("{words} --params params.json {more}"))["scenes"]["plate"]["flip"].clone()
    };
    let (scaled, written) = (evaluate("{}", ""), evaluate("{}", "--as-written"));
    assert_ne!(scaled, written);
    assert_eq!(scaled, evaluate("{\"radius\": 4}", "--as-written"));
    assert_eq!(written, evaluate("{\"radius\": 16}", ""));
}

#[test]
fn a_tuned_preset_records_the_width_of_its_tuning() {
    let sandbox = set_up();
    // Five scenes that are much alike distinguish a choice from the start, which blurs too little
    // at their speeds.
    for (name, way) in ["a", "b", "c", "d", "e"].iter().zip(358..) {
        let way = format!("-{:.2}", f64::from(way) / 100.0);
        sandbox.copy_scene(name, |text| text.replace("-1.6", &way));
    }
    let preset = |more: &str| {
        _ = fs::remove_dir_all(sandbox.path("tuned"));
        let words = "tune search --quiet --filter ./mine --objective flip --size 64x32 --samples-per-pixel 16 --out tuned";
        let table = sandbox.done(&format!("{words} --scenes a,b,c,d,e --budget 12 {more}"));
        let preset = fs::read_to_string(sandbox.path("tuned/preset.toml")).expect(&table);
        let values: Json = sandbox.read_json("tuned/params.json");
        (preset, values["radius"].to_string())
    };
    let (scaled, radius) = preset("");
    let parts = ["reference_width = 64\n", &format!("\nradius = {radius}\n")];
    assert_contains(&scaled, &parts);
    let (written, _) = preset("--as-written");
    assert!(!written.contains("reference_width"), "{written}");

    // The filter has the preset once it is appended.
    let appended = format!("{MANIFEST}\n{scaled}");
    sandbox.put("mine/filter.toml", appended);
    let listed = sandbox.done("list --filter mine");
    let parts = ["made for pictures 64 pixels wide", ".radius = 16 pixels"];
    assert_contains(&listed, &parts);
}

/// Scores of scaled filters say little about others.
#[test]
fn a_run_that_mixes_scaled_and_unscaled_filters_says_which_are_which() {
    let sandbox = set_up();
    let note = |filters: &str, more: &[&str]| {
        // A page shows the cases of earlier runs, too.
        _ = fs::remove_file(sandbox.path("out/run.json"));
        let quick = ["--jitter-frames", "0", "--html", "page.html", "--filters"];
        let words = [&quick[..], &[filters], more].concat();
        let output = sandbox.run(&words);
        assert_done(&output);
        let page = sandbox.text("page.html");
        let notes = [stdout(&output), page.replace("&quot;", "\"")].map(|text| {
            let text = split(&text).join(" ");
            let start = text.split_once("Lengths in pixels are scaled")?.1;
            Some(start.split_once("as written.")?.0.to_owned())
        });
        assert_eq!(notes[0], notes[1], "terminal and page");
        notes[0].clone()
    };
    let manifest = MANIFEST.replace("reference_width = 256\n", "");
    let write = |manifest: &str| {
        sandbox.write_filter("mine", manifest, &one_kernel("radius: i32", BODY));
    };
    write(&manifest);
    let filters = "./mine,mcguire:paper,identity";
    let says = " to pictures 64 wide for mcguire:paper, and are as written for mine:engine, whose filter.toml names no \
                reference_width. Give its lengths unit = \"pixels\" and name one, or compare all ";
    for more in [&[][..], &["--table"]] {
        assert_eq!(note(filters, more).as_deref(), Some(says));
    }
    assert_eq!(note(filters, &["--as-written"]), None);
    assert_eq!(note("mcguire:paper,identity", &[]), None);
    // A manifest can have a width for all of its presets.
    write(&manifest.replacen("[[parameter]]", "reference_width = 256\n\n[[parameter]]", 1));
    assert_eq!(note(filters, &[]), None);
    let cases = sandbox.read_filter_cases();
    let case = cases.iter().find(|case| case.filter == "mine").unwrap();
    assert_eq!(case.parameters["radius"], Value::Integer(4));
    assert_eq!(case.reference_width, Some(256));
}
