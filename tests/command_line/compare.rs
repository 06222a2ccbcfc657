//! `compare`: two runs side by side, changes told from noise.

use std::fs;

use serde_json::Value;

use crate::sandbox::{Sandbox, assert_done, assert_refused, quick_command, stdout};

const GATHER: [&str; 2] = ["--filters", "identity,velocity_gather:fine"];

/// Makes a sandbox with a run in `out`, and the same run with `more` in `other`.
fn two_runs(more: &[&str]) -> Sandbox {
    let sandbox = Sandbox::new();
    assert_done(&sandbox.run(&GATHER));
    assert_done(&run_into(
        &sandbox,
        "other",
        "16",
        &[&GATHER, more].concat(),
    ));
    sandbox
}

fn run_into(
    sandbox: &Sandbox,
    out: &str,
    samples_per_pixel: &str,
    more: &[&str],
) -> std::process::Output {
    let mut words = quick_command("run", samples_per_pixel);
    words[3] = out;
    sandbox.shuttertruth(&[&words, more].concat())
}

/// Does the same at half the size.
fn smaller_run_into(sandbox: &Sandbox, out: &str, more: &[&str]) -> std::process::Output {
    let mut words = quick_command("run", "16");
    (words[3], words[5]) = (out, "32x16");
    sandbox.shuttertruth(&[&words, more].concat())
}

fn compare(sandbox: &Sandbox) -> Value {
    serde_json::from_str(&sandbox.execute(&["compare", "out/run.json", "other", "--json"])).unwrap()
}

fn changes<'a>(compared: &'a Value, filter: &str) -> Vec<&'a Value> {
    let all = compared["changes"].as_array().unwrap();
    all.iter()
        .filter(|change| change["filter"] == filter)
        .collect()
}

#[test]
fn a_run_compared_with_itself_shows_no_change() {
    let sandbox = two_runs(&[]);
    let compared = compare(&sandbox);
    let all = compared["changes"].as_array().unwrap();
    // Six references and two filters, each with at least FLIP, PSNR and label TV.
    assert!(all.len() >= 24, "{}", all.len());
    for change in all {
        assert_eq!(change["kind"], "same", "{change}");
        assert_eq!(change["worse"], 0.0);
    }
    for key in ["settings", "only_in_first", "only_in_second"] {
        assert_eq!(compared[key].as_array().unwrap().len(), 0, "{key}");
    }
    let table = stdout(&sandbox.shuttertruth(&["compare", "out", "other"]));
    assert!(
        table.contains("nothing changed of: identity:default, velocity_gather:fine"),
        "{table}"
    );
    assert!(
        table.contains("0 worse, 0 better, 0 within margin, 0 within noise"),
        "{table}"
    );
}

#[test]
fn compare_names_a_changed_parameter_and_gives_intervals() {
    let sandbox = two_runs(&["--set", "velocity_gather.samples=2"]);
    let compared = compare(&sandbox);
    let settings = compared["settings"].as_array().unwrap();
    assert_eq!(settings.len(), 1, "{settings:?}");
    assert_eq!(settings[0]["name"], "velocity_gather:fine.samples");
    assert_eq!(settings[0]["second"], "2");
    for change in changes(&compared, "identity:default") {
        assert_eq!(change["kind"], "same", "{change}");
    }
    let run = |out: &str| -> suite::Run {
        serde_json::from_slice(&fs::read(sandbox.path(out).join("run.json")).unwrap()).unwrap()
    };
    let score = |run: &suite::Run| {
        let case = run
            .cases
            .iter()
            .find(|case| case.filter == "velocity_gather")
            .unwrap();
        case.scores
            .get("flip_moving".parse().unwrap())
            .value()
            .unwrap()
    };
    let (first, second) = (score(&run("out")), score(&run("other")));
    let own = changes(&compared, "velocity_gather:fine");
    let flip = own
        .iter()
        .find(|change| change["metric"] == "flip_moving")
        .unwrap();
    assert_eq!(flip["first"], first);
    assert_eq!(flip["second"], second);
    assert_eq!(flip["worse"], second - first);
    // Two taps instead of many leave gaps that noise cannot explain.
    assert_eq!(flip["kind"], "worse", "{flip}");
    assert_eq!(flip["basis"], "replicates");
    let ends = flip["interval"].as_array().unwrap();
    let [low, high] = [0, 1].map(|end| ends[end].as_f64().unwrap());
    assert!(
        0.0 < low && low < second - first && second - first < high,
        "{flip}"
    );
    // Noise that both scores share cancels: each score's floor is wider than the interval of the difference.
    let case = run("out")
        .cases
        .into_iter()
        .find(|case| case.filter == "velocity_gather")
        .unwrap();
    let metrics::Measured::Score(score) = case.scores.get("flip_moving".parse().unwrap()) else {
        panic!("the metric applies");
    };
    assert!(
        high - low < 2.0 * score.floor,
        "{low} {high} {}",
        score.floor
    );
}

#[test]
fn terminal_and_page_show_the_same_numbers() {
    let sandbox = Sandbox::two_scenes();
    assert_done(&sandbox.run(&GATHER));
    let more = [&GATHER[..], &["--set", "velocity_gather.samples=2"]].concat();
    assert_done(&run_into(&sandbox, "other", "16", &more));
    let words = ["compare", "out", "other", "--html", "page.html"];
    let table = sandbox.execute(&words);
    let page = fs::read_to_string(sandbox.path("page.html")).unwrap();
    // Cells of the page, between bars.
    let cells: Vec<&str> = (page.split('<'))
        .filter_map(|part| part.split_once('>'))
        .map(|(_, text)| text)
        .filter(|text| !text.is_empty())
        .collect();
    let cells = cells.join("|");
    let mut found = 0;
    for row in table.lines().filter(|line| line.contains(" to ")) {
        let mut own = row
            .split("  ")
            .map(str::trim)
            .filter(|cell| !cell.is_empty());
        let metric = own.next().unwrap();
        let own = own.collect::<Vec<_>>().join("|");
        assert!(own.matches('|').count() == 3, "{row}");
        assert!(
            cells.contains(&own),
            "{metric}: the page lacks {own}\n{table}"
        );
        found += 1;
    }
    // Means, and the scores of two scenes, at least FLIP, skill and PSNR each.
    assert!(found >= 9, "{table}");
    let compared = compare(&sandbox);
    for mean in compared["means"].as_array().unwrap() {
        let [first, second, worse] =
            ["first", "second", "worse"].map(|key| mean[key].as_f64().unwrap());
        let sign = match mean["metric"].as_str().unwrap() {
            "psnr_moving" | "skill_flip" => -1.0,
            "flip_moving" => 1.0,
            // Others change by their distance from an ideal value.
            _ => continue,
        };
        assert!((sign * (second - first) - worse).abs() < 1e-9, "{mean}");
    }
}

#[test]
fn floors_decide_if_replicates_are_missing_and_the_output_says_so() {
    let sandbox = two_runs(&["--set", "velocity_gather.samples=2"]);
    for out in ["out", "other"] {
        fs::remove_dir_all(sandbox.path(out).join("plate/truth_trailing")).unwrap();
    }
    let compared = compare(&sandbox);
    let own = changes(&compared, "velocity_gather:fine");
    let flip = own
        .iter()
        .find(|change| change["metric"] == "flip_moving")
        .unwrap();
    assert_eq!(flip["basis"], "floor");
    assert_eq!(flip["interval"], Value::Null);
    let table = stdout(&sandbox.shuttertruth(&["compare", "out", "other"]));
    assert!(
        table.contains("told from noise by their floors alone"),
        "{table}"
    );
}

#[test]
fn cases_of_only_one_run_are_named() {
    let sandbox = Sandbox::new();
    assert_done(&sandbox.run(&["--filters", "identity"]));
    assert_done(&run_into(&sandbox, "other", "16", &GATHER));
    let compared = compare(&sandbox);
    assert_eq!(compared["only_in_first"].as_array().unwrap().len(), 0);
    assert_eq!(
        compared["only_in_second"],
        serde_json::json!(["plate / velocity_gather:fine"])
    );
    let table = stdout(&sandbox.shuttertruth(&["compare", "out", "other"]));
    assert!(
        table.contains("only in other/run.json:\n  plate / velocity_gather:fine\n"),
        "{table}"
    );
}

#[test]
fn runs_without_a_common_ground_are_refused() {
    let sandbox = Sandbox::new();
    let identity = ["--filters", "identity"];
    assert_done(&sandbox.run(&identity));
    let refused = |parts: &[&str]| {
        assert_refused(
            &sandbox.shuttertruth(&["compare", "out", "other"]),
            2,
            parts,
        );
    };
    assert_done(&smaller_run_into(&sandbox, "other", &identity));
    refused(&["other/run.json", "32x16", "64x32", "at the other's size"]);
    fs::remove_dir_all(sandbox.path("other")).unwrap();
    assert_done(&run_into(&sandbox, "other", "32", &identity));
    refused(&[
        "other/run.json",
        "truth of plate (trailing)",
        "same samples per pixel",
    ]);
    fs::remove_dir_all(sandbox.path("other")).unwrap();
    sandbox.add_slow_scene();
    assert_done(&run_into(
        &sandbox,
        "other",
        "16",
        &["--filters", "identity", "--scenes", "slow"],
    ));
    refused(&["no case in common", "plate there and slow here"]);
    fs::write(sandbox.path("other/run.json"), "{}").unwrap();
    refused(&["other/run.json", "no run of this program"]);
    fs::remove_file(sandbox.path("other/run.json")).unwrap();
    refused(&["other/run.json", "cannot read"]);
}

#[test]
fn the_page_shows_both_pictures_and_both_runs() {
    let sandbox = two_runs(&["--set", "velocity_gather.samples=2"]);
    let page = sandbox.path("page.html");
    let words = ["compare", "out", "other", "--html", "page.html"];
    assert!(stdout(&sandbox.shuttertruth(&words)).contains("written: page.html ("));
    let text = fs::read_to_string(&page).unwrap();
    let address = |out: &str, name: &str| {
        use base64::Engine;
        let bytes = fs::read(sandbox.path(out).join("plate").join(name)).unwrap();
        let engine = base64::engine::general_purpose::STANDARD;
        format!("src=\"data:image/png;base64,{}\"", engine.encode(bytes))
    };
    for (out, name) in [
        ("out", "velocity_gather_fine/output.png"),
        ("other", "velocity_gather_fine_samples_2/output.png"),
        ("out", "truth_trailing.png"),
    ] {
        assert_eq!(text.matches(&address(out, name)).count(), 1, "{out} {name}");
    }
    for words in ["plate / velocity_gather:fine", "--out other", " worse</td>"] {
        assert!(text.contains(words), "{words}");
    }
    assert!(
        !text.contains("http:") && !text.contains("https:"),
        "something is fetched"
    );
    assert!(text.contains("default-src 'none'"));
    sandbox.execute(&words);
    assert_eq!(
        fs::read_to_string(&page).unwrap(),
        text,
        "the same runs make another page"
    );
}

#[test]
fn a_scene_name_with_a_script_is_shown_as_text() {
    let sandbox = Sandbox::new();
    sandbox.copy_scene("<script>alert(1)", |text| text.replace("-1.6", "-0.8"));
    assert_done(&sandbox.run(&GATHER));
    let more = [&GATHER[..], &["--set", "velocity_gather.samples=2"]].concat();
    assert_done(&run_into(&sandbox, "other", "16", &more));
    sandbox.execute(&["compare", "out", "other", "--html", "page.html"]);
    let page = fs::read_to_string(sandbox.path("page.html")).unwrap();
    assert!(
        page.contains("&lt;script&gt;alert(1)"),
        "the scene is not shown"
    );
    assert!(
        !page.contains("<script>alert(1)"),
        "the scene's name is a script"
    );
}
