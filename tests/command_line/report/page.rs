//! The page of a finished run.

use std::collections::BTreeSet;
use std::fs;

use metrics::Metric;

use super::{WORDS, address, between, find_article, make_page, panel, planes};
use crate::sandbox::{Sandbox, assert_done, assert_refused, split};

#[test]
fn a_page_shows_the_scores_and_means_of_the_run() {
    let sandbox = Sandbox::two_scenes();
    assert_done(&sandbox.run(&["--filters", "identity,velocity_gather:fine"]));
    let page = make_page(&sandbox);
    let run = sandbox.read_run();
    for case in &run.cases {
        let link = format!("href=\"#{}\"", address(case));
        for (metric, digits) in [("flip_moving", 3), ("row_loss", 2), ("psnr_moving", 1)] {
            let value = case.scores.get(metric.parse().unwrap()).value().unwrap();
            let cell = format!("{link}>{value:.digits$}</a>");
            assert_eq!(
                panel(&page, metric).matches(&cell).count(),
                1,
                "{metric}: {cell}"
            );
        }
        let count = &case.scores.equivalent_subframes.mse;
        let count = count.to_string().replace('<', "&lt;").replace('>', "&gt;");
        let cell = format!("{link}>{count}</a>");
        assert!(panel(&page, "n_eq").contains(&cell), "{cell}");
        let article = find_article(&page, case);
        assert!(article.contains(&format!("{} / {}", case.scene, case.name())));
        assert!(article.contains("nothing: it serves the tests"));
        assert!(article.contains(&case.truth_hash));
    }
    let ranking = between(&page, "aria-label=\"FLIP of every case\"", "</table>")[0];
    let mut means: Vec<_> = (run.overall.iter())
        .filter(|mean| mean.metric == Metric::FLIP)
        .collect();
    means.sort_by(|a, b| a.mean.total_cmp(&b.mean));
    assert_eq!(means.len(), 9, "seven references and two filters");
    let mut rest = ranking;
    for mean in means {
        let [low, high] = mean.interval;
        let cells = format!(
            "data-value=\"{}\">{:.3}</td><td class=\"note\">{low:.3} to {high:.3}</td>",
            mean.mean, mean.mean
        );
        // Each follows the one before.
        rest = rest.split_once(&cells).expect(&cells).1;
    }
    for words in [&run.program, "--samples-per-pixel 16", "seed 1"] {
        assert!(page.contains(words), "{words}");
    }
}

#[test]
fn the_page_of_a_check_ranks_as_the_terminal_does() {
    let sandbox = Sandbox::two_scenes();
    let bounds = "[default]\nflip_moving = { limit = 0.9, why = \"it serves a test\" }\n";
    fs::write(sandbox.path("scenes/bounds.toml"), bounds).unwrap();
    let filters = "identity,velocity_gather:fine,mcguire:paper,bevy:high";
    assert_done(&sandbox.check(&["--filters", filters]));
    let page = make_page(&sandbox);
    let run = sandbox.read_run();
    let table = panel(&page, "flip_moving");
    let terminal = cli::ranking_text(&run.cases);
    for ranked in judge::rank_for_summary(&run.cases).concat() {
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
        let [first, second] = cells[..] else {
            panic!("two scenes have {} scores", cells.len())
        };
        assert!((ranked.mean - (first + second) / 2.0).abs() < 1e-12);
        let ([low, high], mean) = (ranked.interval.unwrap(), ranked.mean);
        let on_page = format!("{mean:.3}</td><td class=\"note\">{low:.3} to {high:.3}</td>");
        assert!(table.contains(&on_page), "{on_page}");
        let row = (terminal.lines()).find(|line| line.contains(&ranked.name));
        let row = row.expect(&ranked.name);
        for text in [format!("{mean:.3}"), format!("{low:.3} to {high:.3}")] {
            assert!(row.contains(&text), "{text}: {row}");
        }
    }
    // Both name the same best filters, and the same ties.
    let best = between(&page, "<ul class=\"winners\">", "</ul>")[0];
    for group in judge::rank_for_summary(&run.cases) {
        let name = format!(
            "shutter: <strong><a href=\"#filter:{0}\">{0}</a>",
            group[0].name
        );
        assert!(best.contains(&name), "{name}: {best}");
        for tie in group[1..].iter().filter(|own| own.ranks[0] == 1) {
            assert!(best.contains(&format!(">{}</a> (", tie.name)), "{best}");
        }
    }
}

#[test]
fn rankings_by_flip_are_grouped_by_shutter_and_rankings_by_skill_are_not() {
    let sandbox = Sandbox::new();
    // A slow scene of few samples has no skill: the oracle's gain there is noise.
    sandbox.copy_scene("fast", |text| text.replace("-1.6, 0, 0", "-3.2, 0, 0"));
    assert_done(&sandbox.run(&["--filters", "velocity_gather:fine,bevy:high"]));
    let page = make_page(&sandbox);
    let ranking = |title: &str| {
        let label = format!("aria-label=\"{title} of every case\"");
        between(&page, &label, "</table>")[0]
    };
    let by_flip = ranking("FLIP");
    let (trailing, centred) = by_flip.split_once("centred shutter").unwrap();
    assert!(trailing.contains("trailing shutter"));
    for (group, own, other) in [
        (trailing, "velocity_gather:fine", "bevy:high"),
        (centred, "bevy:high", "velocity_gather:fine"),
    ] {
        assert!(group.contains(own) && !group.contains(other), "{group}");
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
fn a_page_holds_every_plane_once_and_fetches_nothing() {
    let sandbox = Sandbox::two_scenes();
    assert_done(&sandbox.run(&["--filters", "identity,jump_flood:paper"]));
    let page = make_page(&sandbox);
    let scenes = planes(&page);
    assert_eq!(scenes.len(), 2, "one list per scene");
    for own in &scenes {
        let once: BTreeSet<&String> = own.iter().collect();
        assert_eq!(once.len(), own.len(), "a plane stands there twice");
    }
    for case in sandbox.read_run().cases {
        let article = find_article(&page, &case);
        let layers = between(article, "data-layers=\"", "\"")[0];
        let scene: usize = between(article, "data-scene=\"", "\"")[0].parse().unwrap();
        let mut names = Vec::new();
        for pair in layers.split(' ') {
            let (name, planes) = pair.split_once(':').unwrap();
            names.push(name);
            for plane in planes.split(',') {
                let plane: usize = plane.parse().unwrap();
                assert!(plane < scenes[scene].len(), "{pair}");
            }
        }
        let mut due = vec![
            "truth",
            "output",
            "instant",
            "flip",
            "signed",
            "bleed",
            "label_tv",
            "unknowable",
            "velocity",
            "depth",
        ];
        if case.filter == "jump_flood" {
            due.push("dilated");
        }
        due.push("objects");
        assert_eq!(names, due, "{}", case.name());
    }

    assert!(page.contains("content=\"default-src 'none'; img-src data:;"));
    for attribute in [" src=\"", " href=\""] {
        for address in between(&page, attribute, "\"") {
            assert!(
                address.starts_with('#') || address.starts_with("data:"),
                "{address}"
            );
        }
    }
    for words in ["@import", "url(", "fetch("] {
        assert!(!page.contains(words), "{words}");
    }
    // An address is text for the reader. It must not begin an attribute or a string of a script.
    for scheme in ["http://", "https://"] {
        for (place, _) in page.match_indices(scheme) {
            let before = &page[..place];
            assert!(
                !before.ends_with(['"', '\'', '=', '(', '`']),
                "{}",
                &before[before.len() - 60..]
            );
        }
    }
}

#[test]
fn the_same_run_makes_the_same_page() {
    let sandbox = Sandbox::new();
    assert_done(&sandbox.run(&["--filters", "identity"]));
    assert!(make_page(&sandbox) == make_page(&sandbox));
}

#[cfg(unix)] // Elsewhere no folder has such a name.
#[test]
fn a_scene_name_with_a_script_is_shown_as_text() {
    const NAME: &str = "<script>alert(1)";
    let sandbox = Sandbox::new();
    sandbox.copy_scene(NAME, |text| {
        text.replace("nothing: it serves", "<img src=x onerror=alert(2)> & it's")
    });
    let words = ["--filters", "identity", "--scenes", NAME];
    assert_done(&sandbox.run(&words));
    let page = make_page(&sandbox);
    assert!(page.contains("<h2 tabindex=\"-1\">&lt;script&gt;alert(1) / <a href="));
    assert!(page.contains("&lt;img src=x onerror=alert(2)&gt; &amp; it"));
    assert!(!page.contains("<script>alert") && !page.contains("<img src=x"));
    // Nine scripts, the colours, the picture kinds and the numbers of one scene belong to the page itself.
    assert_eq!(page.matches("<script").count(), 12);
}

#[test]
fn costs_come_from_the_bench_beside_the_run() {
    let sandbox = Sandbox::new();
    let words = "--filters identity,mcguire:paper --set mcguire.samples=7";
    assert_done(&sandbox.run(&split(words)));
    let without = make_page(&sandbox);
    assert!(without.contains("This run has no bench.json."));
    let words =
        "bench --quiet --filters identity,jump_flood:paper,mcguire:paper --size 64x32 --out out";
    assert_done(&sandbox.shuttertruth(&split(words)));
    let page = make_page(&sandbox);
    let text = fs::read_to_string(sandbox.path("out/bench.json")).unwrap();
    let timed: suite::Bench = serde_json::from_str(&text).unwrap();
    let seconds = timed
        .cases
        .iter()
        .find(|cost| cost.filter == "identity")
        .unwrap()
        .seconds;
    // Every table of scores has one cell for the filter that was both run and timed. Filters that were only timed, or
    // run with other parameters, have none.
    let cell = format!("<td class=\"cost\" data-value=\"{}\">", seconds.median);
    assert_eq!(page.matches(&cell).count(), 9);
    assert_eq!(page.matches("<td class=\"cost\" data-value").count(), 9);
    let costs = between(&page, "<section class=\"costs\">", "</section>")[0];
    for words in [
        "identity:default",
        "copy",
        "256 px",
        "accumulate:64 (trailing)",
        timed.adapter.name.as_str(),
    ] {
        assert!(
            costs.contains(words),
            "\"{words}\" is missing from:\n{costs}"
        );
    }
    fs::write(
        sandbox.path("out/bench.json"),
        text.replace("\"format\": 1", "\"format\": 0"),
    )
    .unwrap();
    let parts = [
        "out/bench.json: has format 0; allowed: 1",
        "`shuttertruth bench`",
    ];
    assert_refused(&sandbox.shuttertruth(&WORDS), 2, &parts);
}

#[test]
fn a_run_keeps_the_jump_flood_s_dilated_map() {
    let sandbox = Sandbox::new();
    assert_done(&sandbox.run(&["--filters", "jump_flood:corrected"]));
    let case = &sandbox.read_filter_cases()[0];
    let output =
        frame::read_exr(&sandbox.path("out").join(&case.folder).join("output.exr")).unwrap();
    let frame = frame::Frame::read(&sandbox.path("out/plate/frame.exr")).unwrap();
    let [x, y] = ["dilated.X", "dilated.Y"].map(|name| output.plane(name).unwrap());
    let motion = *frame.velocity.at(32, 16);
    assert!(motion[0] > 5.0, "the plate moves to the right: {motion:?}");
    // The plate and one pixel behind it hold the plate's own velocity. Pixels far ahead and above hold none.
    let behind = (0..32).find(|x| *frame.object_id.at(*x, 16) == 1).unwrap() - 1;
    for (column, row, due) in [
        (32, 16, motion),
        (behind, 16, motion),
        (60, 16, [0.0; 2]),
        (32, 2, [0.0; 2]),
    ] {
        assert_eq!(
            [*x.at(column, row), *y.at(column, row)],
            due,
            "({column}, {row})"
        );
    }
}

#[test]
fn a_report_refuses_a_file_without_a_run_or_its_pictures() {
    let sandbox = Sandbox::new();
    fs::create_dir(sandbox.path("out")).unwrap();
    let refused = |parts: &[&str]| {
        assert_refused(&sandbox.shuttertruth(&WORDS), 2, parts);
        assert!(!sandbox.path("page").exists());
    };
    refused(&["out/run.json", "read"]);
    fs::write(sandbox.path("out/run.json"), "{}").unwrap();
    refused(&["out/run.json: no run of this program", "`shuttertruth run`"]);
    fs::remove_file(sandbox.path("out/run.json")).unwrap();
    assert_done(&sandbox.run(&["--filters", "identity"]));
    let picture = sandbox.path("out/plate/identity_default/output.exr");
    let other = sandbox.path("out/other.exr");
    fs::copy(&picture, &other).unwrap();
    fs::write(&picture, "no picture").unwrap();
    refused(&["out/plate/identity_default/output.exr"]);
    fs::remove_file(&picture).unwrap();
    refused(&["out/plate/identity_default/output.exr", "read"]);
    let mut small = frame::ExrFile::new(16, 16);
    small.push_color("", &frame::Raster::filled(16, 16, [0.0; 3]));
    frame::write_exr(&picture, &small).unwrap();
    refused(&[
        "out/plate/identity_default/output.exr: has 16x16 pixels, the run's pictures have 64x32",
        "run it again",
    ]);
    fs::rename(&other, &picture).unwrap();

    let text = fs::read_to_string(sandbox.path("out/run.json")).unwrap();
    let mut run: serde_json::Value = serde_json::from_str(&text).unwrap();
    fs::remove_file(sandbox.path("out/judgement.json")).unwrap();
    run["cases"] = serde_json::json!([]);
    fs::write(sandbox.path("out/run.json"), run.to_string()).unwrap();
    refused(&["the run has no cases"]);
}
