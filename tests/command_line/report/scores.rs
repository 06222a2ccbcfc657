//! Scores, rankings and pictures on the page.

use std::collections::BTreeSet;

use super::{find_article, find_between, make_page};
use crate::bench::{Bench, assert_done};

/// The numbers of a page's scenes, as JSON.
fn read_shelves(page: &str) -> Vec<serde_json::Value> {
    let texts = find_between(
        page,
        "<script type=\"application/json\" data-scene=\"",
        "</script>",
    );
    (texts.into_iter())
        .map(|text| serde_json::from_str(text.split_once('>').unwrap().1).unwrap())
        .collect()
}

/// The part of a page that shows one score of all cases.
fn find_panel<'a>(page: &'a str, metric: &str) -> &'a str {
    let (_, rest) = page
        .split_once(&format!("data-metric=\"{metric}\""))
        .unwrap();
    rest.split("data-metric=").next().unwrap()
}

#[test]
fn a_page_shows_the_scores_and_means_of_the_run() {
    let bench = Bench::new();
    bench.copy_scene("slow", |text| text.replace("-1.6", "-0.8"));
    assert_done(&bench.run(&["--filters", "identity,velocity_gather:fine"]));
    let page = make_page(&bench);
    let run = bench.measured();
    for (index, case) in run.cases.iter().enumerate() {
        for (metric, digits) in [("flip_moving", 3), ("row_loss", 2), ("psnr_moving", 1)] {
            let value = case.scores.get(metric.parse().unwrap()).value().unwrap();
            let cell = format!("href=\"#case-{index}\">{value:.digits$}</a>");
            assert_eq!(
                find_panel(&page, metric).matches(&cell).count(),
                1,
                "{metric}: {cell}"
            );
        }
        let count = &case.scores.equivalent_subframes.mse;
        let count = count.to_string().replace('<', "&lt;").replace('>', "&gt;");
        let cell = format!("href=\"#case-{index}\">{count}</a>");
        assert!(find_panel(&page, "n_eq").contains(&cell), "{cell}");
        let article = find_article(&page, index);
        assert!(article.contains(&format!("{} / {}", case.scene, case.name())));
        assert!(article.contains("nothing: it serves the tests"));
        assert!(article.contains(&case.truth_hash));
    }
    let ranking = find_between(&page, "aria-label=\"Ranking by FLIP\"", "</table>")[0];
    let mut means: Vec<_> = (run.overall.iter())
        .filter(|mean| mean.metric == "flip_moving")
        .collect();
    means.sort_by(|a, b| a.mean.total_cmp(&b.mean));
    assert_eq!(means.len(), 8, "six bars and two filters");
    let mut rest = ranking;
    for mean in means {
        let [low, high] = mean.interval;
        let cells = format!("<td>{:.3}</td><td>{low:.3} to {high:.3}</td>", mean.mean);
        // Each behind the one before.
        rest = rest.split_once(&cells).expect(&cells).1;
    }
    for words in [&run.program, "--samples-per-pixel 16", "seed 1"] {
        assert!(page.contains(words), "{words}");
    }
}

#[test]
fn a_ranking_by_flip_has_a_group_per_shutter_and_one_by_skill_has_all_in_one() {
    let bench = Bench::new();
    // A slow scene of few samples has no skill: what the oracle gains there is noise.
    bench.copy_scene("fast", |text| text.replace("-1.6, 0, 0", "-3.2, 0, 0"));
    assert_done(&bench.run(&["--filters", "velocity_gather:fine,bevy:high"]));
    let page = make_page(&bench);
    let ranking = |title: &str| {
        let label = format!("aria-label=\"Ranking by {title}\"");
        find_between(&page, &label, "</table>")[0]
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
        assert_eq!(across.matches("identity").count(), 2, "{across}");
    }
}

#[test]
fn a_page_holds_every_plane_once_and_fetches_nothing() {
    let bench = Bench::new();
    bench.copy_scene("slow", |text| text.replace("-1.6", "-0.8"));
    assert_done(&bench.run(&["--filters", "identity,jump_flood:paper"]));
    let page = make_page(&bench);
    let shelves = read_shelves(&page);
    assert_eq!(shelves.len(), 2, "one per scene");
    for shelf in &shelves {
        let planes: Vec<&str> = (shelf["planes"].as_array().unwrap().iter())
            .map(|plane| plane.as_str().unwrap())
            .collect();
        let once: BTreeSet<(&str, String)> =
            (planes.iter().zip(shelf["bases"].as_array().unwrap()))
                .map(|(plane, base)| (*plane, base.to_string()))
                .collect();
        assert_eq!(once.len(), planes.len(), "a plane stands there twice");
    }
    for (index, case) in bench.measured().cases.iter().enumerate() {
        let article = find_article(&page, index);
        let layers = find_between(article, "data-layers=\"", "\"")[0];
        let scene: usize = find_between(article, "data-scene=\"", "\"")[0]
            .parse()
            .unwrap();
        let mut names = Vec::new();
        for pair in layers.split(' ') {
            let (name, planes) = pair.split_once(':').unwrap();
            names.push(name);
            for plane in planes.split(',') {
                let plane: usize = plane.parse().unwrap();
                assert!(shelves[scene]["planes"][plane].is_string(), "{pair}");
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
        for address in find_between(&page, attribute, "\"") {
            assert!(
                address.starts_with('#') || address.starts_with("data:"),
                "{address}"
            );
        }
    }
    for words in ["http://", "https://", "@import", "url(", "fetch("] {
        assert!(!page.contains(words), "{words}");
    }
}

#[test]
fn the_same_run_makes_the_same_page() {
    let bench = Bench::new();
    assert_done(&bench.run(&["--filters", "identity"]));
    assert!(make_page(&bench) == make_page(&bench));
}

#[cfg(unix)] // Elsewhere no folder has such a name.
#[test]
fn a_scene_called_script_is_shown_and_not_run() {
    const NAME: &str = "<script>alert(1)";
    let bench = Bench::new();
    bench.copy_scene(NAME, |text| {
        text.replace("nothing: it serves", "<img src=x onerror=alert(2)> & it's")
    });
    let words = ["--filters", "identity", "--scenes", NAME];
    assert_done(&bench.run(&words));
    let page = make_page(&bench);
    assert!(page.contains("<h2 tabindex=\"-1\">&lt;script&gt;alert(1) / identity:default</h2>"));
    assert!(page.contains("This scene exposes: &lt;img src=x onerror=alert(2)&gt; &amp; it"));
    assert!(!page.contains("<script>alert") && !page.contains("<img src=x"));
    // Seven scripts, the colours and the numbers of one scene are the page's own.
    assert_eq!(page.matches("<script").count(), 9);
}

#[test]
fn a_run_keeps_what_the_jump_flood_dilated() {
    let bench = Bench::new();
    assert_done(&bench.run(&["--filters", "jump_flood:corrected"]));
    let case = &bench.measured_filters()[0];
    let output = frame::read_exr(&bench.path("out").join(&case.folder).join("output.exr")).unwrap();
    let frame = frame::Frame::read(&bench.path("out/plate/frame.exr")).unwrap();
    let [x, y] = ["dilated.X", "dilated.Y"].map(|name| output.plane(name).unwrap());
    let motion = *frame.velocity.at(32, 16);
    assert!(motion[0] > 5.0, "the plate moves to the right: {motion:?}");
    // On the plate and a pixel behind it the plate's own velocity; nothing far ahead, and none above it.
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
