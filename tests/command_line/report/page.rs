//! The page of a finished run.

use std::collections::BTreeSet;
use std::fs;

use metrics::Metric;
use tests::text::assert_contains;

use super::{REPORT, address, between, find_article, make_page, panel, planes};
use crate::sandbox::{Sandbox, assert_done, split};

/// Makes a sandbox with a run of three filters on two scenes.
fn measured() -> Sandbox {
    Sandbox::once(|sandbox| {
        sandbox.add_slow_scene();
        sandbox.measure("--filters identity,velocity_gather:fine,jump_flood:corrected");
    })
}

#[test]
fn a_page_shows_the_scores_and_means_of_the_run() {
    let sandbox = measured();
    let page = make_page(&sandbox);
    let again = make_page(&sandbox);
    assert!(again == page, "the same run makes another page");
    let run = sandbox.read_run();
    for case in &run.cases {
        let link = format!("href=\"#{}\"", address(case));
        for (metric, digits) in [("flip_moving", 3), ("row_loss", 2), ("psnr_moving", 1)] {
            let value = case.scores.get(metric.parse().unwrap()).value().unwrap();
            let cell = format!("{link}>{value:.digits$}</a>");
            let count = panel(&page, metric).matches(&cell).count();
            assert_eq!(count, 1, "{metric}: {cell}");
        }
        let count = case.scores.equivalent_subframes.mse.to_string();
        let count = count.replace('<', "&lt;").replace('>', "&gt;");
        assert_contains(panel(&page, "n_eq"), &[&format!("{link}>{count}</a>")]);
    }
    // The rows follow each other in the order of their means.
    let mut rest = between(&page, "aria-label=\"FLIP of every case\"", "</table>")[0];
    let mut means: Vec<_> = run.overall.iter().collect();
    means.retain(|mean| mean.metric == Metric::FLIP);
    means.sort_by(|a, b| a.mean.total_cmp(&b.mean));
    assert_eq!(means.len(), 10, "seven references and three filters");
    for summary in means {
        let (mean, [low, high]) = (summary.mean, summary.interval);
        let interval = format!("<td class=\"note\">{low:.3} to {high:.3}</td>");
        let cells = format!("data-value=\"{mean}\">{mean:.3}</td>{interval}");
        rest = rest.split_once(&cells).expect(&cells).1;
    }
    assert_contains(&page, &[&run.program, "--samples-per-pixel 16", "seed 1"]);
}

#[test]
fn every_case_has_an_article_with_its_layers() {
    let sandbox = measured();
    let page = make_page(&sandbox);
    let scenes = planes(&page);
    assert_eq!(scenes.len(), 2, "one list per scene");
    for names in &scenes {
        let once: BTreeSet<&String> = names.iter().collect();
        assert_eq!(once.len(), names.len(), "a plane stands there twice");
    }
    let run = sandbox.read_run();
    for case in &run.cases {
        let article = find_article(&page, case);
        let title = format!("{} / {}", case.scene, case.name());
        let exposes = "nothing: it serves the tests";
        assert_contains(article, &[&title, exposes, &case.truth_hash]);
        let layers = between(article, "data-layers=\"", "\"")[0];
        let scene: usize = between(article, "data-scene=\"", "\"")[0].parse().unwrap();
        let pairs = layers.split(' ').map(|pair| pair.split_once(':').unwrap());
        for plane in pairs.clone().flat_map(|(_, planes)| planes.split(',')) {
            let plane: usize = plane.parse().unwrap();
            assert!(plane < scenes[scene].len(), "{layers}");
        }
        let names: Vec<&str> = pairs.map(|(name, _)| name).collect();
        let mut due = split(
            "truth output instant flip signed bleed label_tv unknowable velocity depth objects",
        );
        if case.filter == "jump_flood" {
            due.insert(10, "dilated");
        }
        assert_eq!(names, due, "{}", case.name());
    }
}

#[test]
fn the_page_of_a_check_ranks_as_the_terminal_does() {
    let sandbox = Sandbox::two_scenes();
    sandbox.write_bound(0.9);
    sandbox.copy_bound("slow");
    let filters = "identity,velocity_gather:fine,mcguire:paper,bevy:high";
    assert_done(&sandbox.check(&["--filters", filters]));
    let page = make_page(&sandbox);
    let run = sandbox.read_run();
    let table = panel(&page, "flip_moving");
    let terminal = cli::ranking_text(&run).plain();
    let ranking = judge::rank_for_summary(&run.cases).concat();
    for ranked in ranking.iter().filter(|ranked| ranked.is_ranked()) {
        let cells: Vec<f64> = (run.cases.iter().filter(|case| case.name() == ranked.name))
            .map(|case| {
                let link = format!("href=\"#{}\"", address(case));
                let (before, _) = table.split_once(&link).expect(&link);
                let (_, value) = before.rsplit_once("data-value=\"").unwrap();
                let shown: f64 = value.split('"').next().unwrap().parse().unwrap();
                // The truth's noise is in the measured score, and no longer in the estimate.
                assert_ne!(Some(shown), case.scores.moving.flip.value(), "{link}");
                shown
            })
            .collect();
        assert_eq!(cells.len(), 2, "two scenes");
        assert!((ranked.mean - (cells[0] + cells[1]) / 2.0).abs() < 1e-12);
        let ([low, high], mean) = (ranked.interval.unwrap(), ranked.mean);
        let on_page = format!("{mean:.3}</td><td class=\"note\">{low:.3} to {high:.3}</td>");
        assert_contains(table, &[&on_page]);
        let mut rows = terminal.lines();
        let row = rows.find(|line| line.contains(&ranked.name)).unwrap();
        let cells = [format!("{mean:.3}"), format!("{low:.3} to {high:.3}")];
        assert_contains(row, &[&cells[0], &cells[1]]);
    }
    // Both name the same best filters, and the same ties.
    let best = between(&page, "<ul class=\"winners\">", "</ul>")[0];
    for group in judge::rank_for_summary(&run.cases) {
        let mut first = group.iter().filter(|entry| entry.may_be_best());
        let best_name = &first.next().unwrap().name;
        let name = format!("shutter: <strong><a href=\"#filter:{best_name}\">{best_name}</a>");
        assert!(best.contains(&name), "{name}: {best}");
        for tie in first {
            assert!(best.contains(&format!(">{}</a> (", tie.name)), "{best}");
        }
    }
}

#[test]
fn rankings_by_flip_are_grouped_by_shutter_and_rankings_by_skill_are_not() {
    let sandbox = Sandbox::new();
    // A slow scene of few samples has no skill: the oracle's gain there is noise.
    sandbox.copy_scene("fast", |text| text.replace("-1.6, 0, 0", "-3.2, 0, 0"));
    sandbox.measure("--filters velocity_gather:fine,bevy:high");
    let page = make_page(&sandbox);
    let ranking = |title: &str| {
        let label = format!("aria-label=\"{title} of every case\"");
        between(&page, &label, "</table>")[0]
    };
    let by_flip = ranking("FLIP");
    let (trailing, centred) = by_flip.split_once("centred shutter").unwrap();
    assert!(trailing.contains("trailing shutter"));
    for (group, member, other) in [
        (trailing, "velocity_gather:fine", "bevy:high"),
        (centred, "bevy:high", "velocity_gather:fine"),
    ] {
        assert!(group.contains(member) && !group.contains(other), "{group}");
        for bar in [">identity<", ">scatter_oracle<"] {
            assert_eq!(group.matches(bar).count(), 1, "{bar}: {group}");
        }
    }
    for title in ["Skill", "FLIP*"] {
        let across = ranking(title);
        assert!(!across.contains("shutter</th>"), "{across}");
        for name in ["velocity_gather:fine", "bevy:high"] {
            assert!(across.contains(name), "{name}: {across}");
        }
        assert_eq!(across.matches(">identity <").count(), 2, "{across}");
    }
}

#[test]
fn a_run_keeps_the_jump_flood_s_dilated_map() {
    let sandbox = measured();
    let case = sandbox.path("out/plate/jump_flood_corrected/output.exr");
    let output = frame::read_exr(&case).unwrap();
    let frame = frame::Frame::read(&sandbox.path("out/plate/frame.exr")).unwrap();
    let [x, y] = ["dilated.X", "dilated.Y"].map(|name| output.plane(name).unwrap());
    let motion = *frame.velocity.at(32, 16);
    assert!(motion[0] > 5.0, "the plate moves to the right: {motion:?}");
    // The plate and one pixel behind it have the plate's own velocity. Pixels far ahead and above
    // do not.
    let behind = (0..32).find(|x| *frame.object_id.at(*x, 16) == 1).unwrap() - 1;
    for (column, row, due) in [
        (32, 16, motion),
        (behind, 16, motion),
        (60, 16, [0.0; 2]),
        (32, 2, [0.0; 2]),
    ] {
        let actual = [*x.at(column, row), *y.at(column, row)];
        assert_eq!(actual, due, "({column}, {row})");
    }
}

#[test]
fn a_report_refuses_a_file_without_a_run_or_its_pictures() {
    let sandbox = Sandbox::measured();
    let refuse = |parts: &[&str]| {
        sandbox.refuse(REPORT, parts);
        assert!(!sandbox.path("page").exists());
    };
    let write = |name: &str, bytes: &[u8]| sandbox.put(name, bytes);
    let output = "out/plate/identity_default/output.exr";
    let whole = fs::read(sandbox.path(output)).unwrap();
    write(output, b"no picture");
    refuse(&[output]);
    fs::remove_file(sandbox.path(output)).unwrap();
    refuse(&[output, "read"]);
    let mut small = frame::ExrFile::new(16, 16);
    small.push_color("", &frame::Raster::filled(16, 16, [0.0; 3]));
    frame::write_exr(&sandbox.path(output), &small).unwrap();
    let size = "has 16x16 pixels, the run's pictures have 64x32";
    refuse(&[&format!("{output}: {size}"), "run it again"]);
    write(output, &whole);

    let mut run: serde_json::Value = sandbox.read_json("out/run.json");
    fs::remove_file(sandbox.path("out/judgement.json")).unwrap();
    run["cases"] = serde_json::json!([]);
    write("out/run.json", run.to_string().as_bytes());
    refuse(&["the run has no cases"]);
    write("out/run.json", b"{}");
    refuse(&["out/run.json: no run of this program", "`shuttertruth run`"]);
    fs::remove_file(sandbox.path("out/run.json")).unwrap();
    refuse(&["out/run.json", "read"]);
}
