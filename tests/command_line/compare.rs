//! `compare`: two runs side by side, with changes separated from noise.

use std::fs;

use serde_json::{Value, json};
use tests::text::assert_contains;

use crate::sandbox::Sandbox;

const GATHER: &str = "--filters identity,velocity_gather:fine";
const SCRIPT: &str = "<script>alert(1)";

/// Makes a sandbox with a run of two scenes in `out`, and the same run with two taps in `other`.
fn two_runs() -> Sandbox {
    Sandbox::once(|sandbox| {
        sandbox.copy_scene(SCRIPT, |text| text.replace("-1.6", "-0.8"));
        sandbox.measure(GATHER);
        let two_taps = format!("{GATHER} --set velocity_gather.samples=2");
        sandbox.measure_into("other", &two_taps);
    })
}

fn compare(sandbox: &Sandbox, other: &str) -> Value {
    let text = sandbox.done(&format!("compare out/run.json {other} --json"));
    serde_json::from_str(&text).unwrap()
}

/// Finds the change of a filter's FLIP on the plate.
fn find_flip(compared: &Value) -> &Value {
    let is_own = |change: &&Value| {
        let id = ["scene", "filter", "metric"].map(|key| &change[key]);
        id == ["plate", "velocity_gather:fine", "flip_moving"]
    };
    let mut changes = compared["changes"].as_array().unwrap().iter();
    changes.find(is_own).unwrap()
}

#[test]
fn a_run_compared_with_itself_shows_no_change() {
    let sandbox = two_runs();
    let compared = compare(&sandbox, "out");
    let all = compared["changes"].as_array().unwrap();
    // Two filters on two scenes, each with at least FLIP, PSNR and label TV.
    assert!(all.len() >= 12, "{}", all.len());
    for change in all {
        assert_eq!(change["kind"], "same", "{change}");
        assert_eq!(change["worse"], 0.0);
    }
    for key in ["settings", "only_in_first", "only_in_second"] {
        assert_eq!(compared[key], json!([]), "{key}");
    }
    let parts = [
        "nothing changed of: identity:default, velocity_gather:fine",
        "0 worse, 0 better, 0 within margin, 0 within noise",
    ];
    assert_contains(&sandbox.done("compare out out"), &parts);
}

#[test]
fn compare_names_a_changed_parameter_and_gives_intervals() {
    let sandbox = two_runs();
    let compared = compare(&sandbox, "other");
    let [setting] = &compared["settings"].as_array().unwrap()[..] else {
        panic!("one setting differs: {compared}");
    };
    assert_eq!(setting["name"], "velocity_gather:fine.samples");
    assert_eq!(setting["second"], "2");
    let changes = compared["changes"].as_array().unwrap().iter();
    for change in changes.filter(|change| change["filter"] == "identity:default") {
        assert_eq!(change["kind"], "same", "{change}");
    }
    let [first, second] = ["out", "other"].map(|out| {
        let run: measure::Run = sandbox.read_json(&format!("{out}/run.json"));
        let mut cases = run.cases.into_iter();
        let case = cases.find(|case| case.filter == "velocity_gather" && case.scene == "plate");
        case.unwrap().scores.moving.flip
    });
    let values = [&first, &second].map(|score| score.value().unwrap());
    let worse = values[1] - values[0];
    let flip = find_flip(&compared);
    let actual = ["first", "second", "worse"].map(|key| flip[key].as_f64().unwrap());
    assert_eq!(actual, [values[0], values[1], worse]);
    // Two taps instead of many leave gaps that noise cannot explain.
    assert_eq!([&flip["kind"], &flip["basis"]], ["worse", "replicates"]);
    let [low, high] = [0, 1].map(|end| flip["interval"][end].as_f64().unwrap());
    assert!(0.0 < low && low < worse && worse < high, "{flip}");
    // Noise that both scores share cancels: each score's floor is wider than the interval of the
    // difference.
    let metrics::Measured::Score(score) = first else {
        panic!("the metric applies");
    };
    assert!(high - low < 2.0 * score.floor, "{flip} {score:?}");
}

#[test]
fn terminal_and_page_show_the_same_numbers() {
    let sandbox = two_runs();
    let table = sandbox.done("compare out other --html page.html");
    let page = sandbox.text("page.html");
    // Cells of the page, between bars.
    let texts = page.split('<').filter_map(|part| part.split_once('>'));
    let texts = texts.map(|(_, text)| text).filter(|text| !text.is_empty());
    let cells = texts.collect::<Vec<_>>().join("|");
    let mut count = 0;
    for row in table.lines().filter(|line| line.contains(" to ")) {
        let row_cells = row.split("  ").map(str::trim);
        let row_cells = row_cells.filter(|cell| !cell.is_empty()).skip(1);
        let row_cells = row_cells.collect::<Vec<_>>().join("|");
        assert_eq!(row_cells.matches('|').count(), 3, "{row}");
        assert!(
            cells.contains(&row_cells),
            "the page lacks {row_cells}\n{table}"
        );
        count += 1;
    }
    // Means, and the scores of two scenes, at least FLIP, skill and PSNR each.
    assert!(count >= 9, "{table}");
    for mean in compare(&sandbox, "other")["means"].as_array().unwrap() {
        let [first, second, worse] =
            ["first", "second", "worse"].map(|key| mean[key].as_f64().unwrap());
        let sign = match mean["metric"].as_str().unwrap() {
            "psnr_moving" | "skill_flip" => -1.0,
            "flip_moving" => 1.0,
            // Other metrics change by their distance from an ideal value.
            _ => continue,
        };
        assert!((sign * (second - first) - worse).abs() < 1e-9, "{mean}");
    }
}

#[test]
fn floors_decide_if_replicates_are_missing_and_the_output_says_so() {
    let sandbox = two_runs();
    for out in ["out", "other"] {
        fs::remove_dir_all(sandbox.path(out).join("plate/truth_trailing")).unwrap();
    }
    let compared = compare(&sandbox, "other");
    let flip = find_flip(&compared);
    assert_eq!(flip["basis"], "floor");
    assert!(flip["interval"].is_null());
    let table = sandbox.done("compare out other");
    assert_contains(&table, &["told from noise by their floors alone"]);
}

#[test]
fn cases_of_only_one_run_are_named_and_runs_without_a_common_ground_are_refused() {
    let sandbox = Sandbox::measured();
    sandbox.measure_into("more", GATHER);
    let compared = compare(&sandbox, "more");
    assert_eq!(compared["only_in_first"], json!([]));
    let only = "plate / velocity_gather:fine";
    assert_eq!(compared["only_in_second"], json!([only]));
    let table = sandbox.done("compare out more");
    let listed = format!("only in more/run.json:\n  {only}\n");
    assert_contains(&table, &[&listed]);

    /// Folders to compare with, and parts of the message.
    const INCOMPARABLE: [(&str, &[&str]); 5] = [
        (
            "small",
            &["small/run.json", "32x16", "64x32", "at the other's size"],
        ),
        (
            "fine",
            &[
                "fine/run.json",
                "truth of plate (trailing)",
                "same samples per pixel",
            ],
        ),
        ("slow", &["no case in common", "plate there and slow here"]),
        ("damaged", &["damaged/run.json", "no run of this program"]),
        ("nowhere", &["nowhere", "cannot read"]),
    ];

    sandbox.add_slow_scene();
    let run = "run --quiet --filters identity --scenes";
    for line in [
        "plate --size 32x16 --samples-per-pixel 16 --out small",
        "plate --size 64x32 --samples-per-pixel 32 --out fine",
        "slow --size 64x32 --samples-per-pixel 16 --out slow",
    ] {
        sandbox.done(&format!("{run} {line}"));
    }
    fs::create_dir(sandbox.path("damaged")).unwrap();
    sandbox.put("damaged/run.json", "{}");
    sandbox.refuse_each("compare out", &INCOMPARABLE);
}

#[test]
fn the_page_shows_both_pictures_and_both_runs_and_names_as_text() {
    let sandbox = two_runs();
    let command = "compare out other --html page.html";
    assert_contains(&sandbox.done(command), &["written: page.html ("]);
    let read = || sandbox.text("page.html");
    let text = read();
    let address = |name: &str| {
        use base64::Engine;
        let bytes = fs::read(sandbox.path(name)).unwrap();
        let engine = base64::engine::general_purpose::STANDARD;
        format!("src=\"data:image/png;base64,{}\"", engine.encode(bytes))
    };
    let other = "other/plate/velocity_gather_fine_samples_2/output.png";
    let pictures = "out/plate/velocity_gather_fine/output.png out/plate/truth_trailing.png";
    for name in pictures.split(' ').chain([other]) {
        assert_eq!(text.matches(&address(name)).count(), 1, "{name}");
    }
    let parts = [
        "plate / velocity_gather:fine",
        "--out other",
        "default-src 'none'",
        "&lt;script&gt;alert(1)",
    ];
    assert_contains(&text, &parts);
    assert_contains(&text, &[" worse</td>"]);
    for words in [SCRIPT, "http:", "https:"] {
        assert!(!text.contains(words), "{words}");
    }
    sandbox.done(command);
    assert_eq!(read(), text, "the same runs make another page");
}
