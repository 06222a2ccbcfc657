//! Changes of a kernel since a baseline on several scenes.

use serde_json::Value;
use tests::filter_folder::copy_changed_filter;
use tests::text::assert_contains;

use crate::sandbox::*;

/// Makes a sandbox with the plate's scene and four in which the plate passes elsewhere, a gather,
/// and its accepted scores.
fn set_up() -> Sandbox {
    Sandbox::once(|sandbox| {
        for (name, [x, y]) in [
            ("above", [0.0, -1.2]),
            ("below", [0.0, 1.2]),
            ("right", [-1.5, -1.1]),
            ("left", [1.5, 1.1]),
        ] {
            sandbox.copy_scene(name, |text| {
                text.replace("[0, 0, 4]", &format!("[{x}, {y}, 4]"))
                    .replace("look_at = [0, 0, 0]", &format!("look_at = [{x}, {y}, 0]"))
            });
        }
        let margins = "[margin]\nflip_moving = 0.005\nrow_loss = 0.1\n";
        sandbox.put("scenes/bounds.toml", margins);
        write_gather(sandbox, "");
        let words = "run --quiet --out out --samples-per-pixel 64 --size 64x32 --filter ./own:fine";
        sandbox.done(words);
        let accept = "limits accept --out out --reason first";
        assert_done(&sandbox.outside_ci(&split(accept)));
    })
}

/// Writes the gather, with a statement before it blurs a pixel.
fn write_gather(sandbox: &Sandbox, statement: &str) {
    let folder = sandbox.path("own");
    copy_changed_filter("velocity_gather", &folder, |kernels| {
        let start = "    // A running mean";
        assert!(kernels.contains(start));
        kernels.replace(start, &format!("    {statement}\n{start}"))
    });
    std::fs::rename(folder.join("velocity_gather.wgsl"), folder.join("own.wgsl")).unwrap();
    sandbox.edit("own/filter.toml", "\"velocity_gather\"", "\"own\"");
}

/// Leaves the picture sharp in a block of columns and rows.
fn sharp_block([left, top, right, bottom]: [u32; 4]) -> String {
    format!(
        "if all(pixel >= vec2({left}, {top})) && all(pixel < vec2({right}, {bottom})) {{
            textureStore(output, pixel, textureLoad(color, pixel, 0));
            return;
        }}"
    )
}

/// Compares with the baseline; returns the text, and the comparison of a score.
fn compare(sandbox: &Sandbox, code: i32, metric: &str) -> (String, Value) {
    let words = "--filter ./own:fine --baseline base.json";
    let output = sandbox.check(&split(words));
    assert_eq!(output.status.code(), Some(code), "{}", stdout(&output));
    let json = sandbox.check(&split(&format!("{words} --json")));
    let check: Value = serde_json::from_slice(&json.stdout).unwrap();
    let comparisons = check["comparisons"].as_array().unwrap().iter();
    let mut matching = comparisons.filter(|comparison| comparison["metric"] == metric);
    (
        tests::text::squeeze(&stdout(&output)),
        matching.next().unwrap().clone(),
    )
}

#[test]
fn a_block_that_stays_sharp_on_one_scene_of_five_fails_beside_its_bounds_and_names_the_scene() {
    let sandbox = set_up();
    let (text, unchanged) = compare(&sandbox, 0, "flip_moving");
    assert_eq!(unchanged["kind"], "no_worse");
    let due = "2 comparisons with the baseline: 2 no worse";
    assert_contains(&text, &[due, "PASS"]);
    // A corner of the plate, and all of it.
    for block in [[33, 12, 42, 20], [24, 12, 42, 20]] {
        write_gather(&sandbox, &sharp_block(block));
        let (text, flip) = compare(&sandbox, 1, "flip_moving");
        assert_eq!(
            [&flip["kind"], &flip["decided_by"]],
            ["worse", "noise"],
            "{flip}"
        );
        assert_eq!(flip["losses"].as_array().unwrap().len(), 1, "{flip}");
        assert_eq!(flip["losses"][0]["scene"], "plate");
        // The mean over the scenes alone decides nothing.
        let low = flip["bounds"][0].as_f64().unwrap();
        assert!(low < 0.005, "{flip}");
        let due = "certainly worse on plate by";
        let verdict = "FAIL: a score is worse than the baseline's";
        assert_contains(&text, &[due, verdict]);
        assert_page(&sandbox, &verdict.replace("FAIL", "FAIL</strong>"), due);
    }
    assert_counted_apart(&sandbox);
}

/// Checks a failed comparison again, with bounds that the filter keeps or breaks.
fn assert_counted_apart(sandbox: &Sandbox) {
    let words = "--filter ./own:fine --baseline base.json";
    let check = |limit: f64, parts: &[&str]| {
        sandbox.write_bound(limit);
        let output = sandbox.check(&split(words));
        assert_eq!(output.status.code(), Some(1), "{}", stdout(&output));
        let text = tests::text::squeeze(&stdout(&output));
        assert_contains(&text, parts);
        text
    };
    let parts = [
        "1 required bound: 1 met",
        "2 comparisons with the baseline: 1 no worse, 1 worse",
        "FAIL: a score is worse than the baseline's",
    ];
    let text = check(0.9, &parts);
    assert!(!text.contains("bound is broken"), "{text}");
    let due = "FAIL: a required bound is broken, and a score is worse than the baseline's";
    check(0.05, &[due]);
}

/// Checks that the page of a failed check begins with the failure, also when it is made again.
fn assert_page(sandbox: &Sandbox, verdict: &str, line: &str) {
    sandbox.done("report out --html again.html");
    for page in ["out/report.html", "again.html"] {
        let page = sandbox.text(page).replace("&#39;", "'");
        let [fails, praises] = [verdict, "<ul class=\"winners\">"].map(|text| page.find(text));
        assert!(fails.is_some() && fails < praises, "{fails:?} {praises:?}");
        assert!(page.contains(line));
    }
}
