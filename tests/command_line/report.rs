//! The page of a finished run.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use crate::bench::{Bench, assert_done, assert_refused, files_below, stdout};

const WORDS: [&str; 4] = ["report", "out/run.json", "--html", "page/report.html"];

/// Makes the page of the bench's last run.
fn reported(bench: &Bench) -> String {
    let output = bench.shuttertruth(&WORDS);
    assert_done(&output);
    assert!(stdout(&output).contains("written: page/report.html ("));
    fs::read_to_string(bench.path("page/report.html")).unwrap()
}

/// What stands between two texts, each time.
fn between<'a>(page: &'a str, before: &str, after: &str) -> Vec<&'a str> {
    let rests = page.split(before).skip(1);
    rests
        .map(|rest| rest.split_once(after).expect("an end").0)
        .collect()
}

/// The pictures of a page, by their numbers.
fn pictures(page: &str) -> Vec<Vec<u8>> {
    let store = between(
        page,
        "<script id=\"pictures\" type=\"application/json\">",
        "</script>",
    );
    let addresses: Vec<String> = serde_json::from_str(store[0]).unwrap();
    (addresses.iter())
        .map(|address| {
            let text = address.strip_prefix("data:image/png;base64,").unwrap();
            STANDARD.decode(text).unwrap()
        })
        .collect()
}

/// The part of a page that shows one score of all cases.
fn panel<'a>(page: &'a str, metric: &str) -> &'a str {
    let (_, rest) = page
        .split_once(&format!("data-metric=\"{metric}\""))
        .unwrap();
    rest.split("data-metric=").next().unwrap()
}

/// The part of a page that shows a case, by the case's number.
fn article(page: &str, case: usize) -> &str {
    between(
        page,
        &format!("<article class=\"case\" id=\"case-{case}\""),
        "</article>",
    )[0]
}

#[test]
fn a_page_shows_the_scores_and_means_of_the_run() {
    let bench = Bench::new();
    bench.copy_scene("slow", |text| text.replace("-1.6", "-0.8"));
    assert_done(&bench.run(&["--filters", "identity,velocity_gather:fine"]));
    let page = reported(&bench);
    let run = bench.measured();
    for (index, case) in run.cases.iter().enumerate() {
        for (metric, digits) in [("flip_moving", 3), ("bleed_lateral", 2), ("psnr_moving", 1)] {
            let value = case.scores.get(metric.parse().unwrap()).value().unwrap();
            let cell = format!("href=\"#case-{index}\">{value:.digits$}</a>");
            assert_eq!(
                panel(&page, metric).matches(&cell).count(),
                1,
                "{metric}: {cell}"
            );
        }
        let count = &case.scores.equivalent_subframes.mse;
        let count = count.to_string().replace('<', "&lt;").replace('>', "&gt;");
        let cell = format!("href=\"#case-{index}\">{count}</a>");
        assert!(panel(&page, "n_eq").contains(&cell), "{cell}");
        let article = article(&page, index);
        assert!(article.contains(&format!("{} / {}", case.scene, case.name())));
        assert!(article.contains("nothing: it serves the tests"));
        assert!(article.contains(&case.truth_hash));
    }
    let ranking = between(&page, "aria-label=\"Ranking by FLIP\"", "</table>")[0];
    let mut means: Vec<_> = (run.overall.iter())
        .filter(|mean| mean.metric == "flip_moving")
        .collect();
    means.sort_by(|a, b| a.mean.total_cmp(&b.mean));
    assert_eq!(means.len(), 7, "five bars and two filters");
    let mut rest = ranking;
    for mean in means {
        let [low, high] = mean.interval;
        let cells = format!("<td>{:.3}</td><td>{low:.3}–{high:.3}</td>", mean.mean);
        // Each behind the one before.
        rest = rest.split_once(&cells).expect(&cells).1;
    }
    for words in [&run.program, "--samples-per-pixel 16", "seed 1"] {
        assert!(page.contains(words), "{words}");
    }
}

#[test]
fn a_page_holds_every_picture_once_and_fetches_nothing() {
    let bench = Bench::new();
    assert_done(&bench.run(&["--filters", "identity,velocity_gather:fine"]));
    let page = reported(&bench);
    let pictures = pictures(&page);
    let once: BTreeSet<&Vec<u8>> = pictures.iter().collect();
    assert_eq!(once.len(), pictures.len(), "a picture stands there twice");
    let files: BTreeSet<Vec<u8>> = (files_below(&bench.path("out")).iter())
        .filter(|path| path.extension().is_some_and(|ending| ending == "png"))
        .map(|path| fs::read(path).unwrap())
        .collect();
    assert_eq!(once, files.iter().collect());

    for (index, case) in bench.measured().cases.iter().enumerate() {
        let layers = between(article(&page, index), "data-layers=\"", "\"")[0];
        let file = |name: &str| match name {
            "instant" => Path::new(&case.scene).join("frame.png"),
            "velocity" => Path::new(&case.scene).join("velocity.png"),
            "truth" => Path::new(&case.scene).join("truth_trailing.png"),
            own => case.folder.join(format!("{own}.png")),
        };
        let pairs: Vec<(&str, &str)> = (layers.split(' '))
            .map(|pair| pair.split_once(':').unwrap())
            .collect();
        assert_eq!(pairs.len(), 7, "{layers}");
        for (name, number) in pairs {
            let bytes = fs::read(bench.path("out").join(file(name))).unwrap();
            assert!(
                pictures[number.parse::<usize>().unwrap()] == bytes,
                "{} shows another picture as {name}",
                case.name()
            );
        }
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
    for words in ["http://", "https://", "@import", "url(", "fetch("] {
        assert!(!page.contains(words), "{words}");
    }
}

#[test]
fn the_same_run_makes_the_same_page() {
    let bench = Bench::new();
    assert_done(&bench.run(&["--filters", "identity"]));
    assert!(reported(&bench) == reported(&bench));
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
    let page = reported(&bench);
    assert!(page.contains("<h2 tabindex=\"-1\">&lt;script&gt;alert(1) / identity:default</h2>"));
    assert!(page.contains("This scene exposes: &lt;img src=x onerror=alert(2)&gt; &amp; it"));
    assert!(!page.contains("<script>alert") && !page.contains("<img src=x"));
    // Four scripts and the pictures are the page's own.
    assert_eq!(page.matches("<script").count(), 5);
}

#[test]
fn a_broken_bound_is_shown_with_its_place_and_its_picture() {
    let bench = Bench::new();
    bench.write(
        "bounds.toml",
        "[default]\n\
         flip_moving = { limit = 0.2, why = \"it <i>serves</i> a test\" }\n\
         label_tv = { limit = 0.9, why = \"it serves a test, too\" }\n",
    );
    let output = bench.check(&["--filters", "identity"]);
    assert_eq!(output.status.code(), Some(1), "{}", stdout(&output));
    let page = reported(&bench);
    let run = bench.measured();
    let index = run.cases.iter().position(|case| !case.bar).unwrap();
    let case = &run.cases[index];

    assert!(page.contains("2 bounds: 1 kept, 1 broken, 0 inconclusive"));
    let flip = case.scores.moving.flip.value().unwrap();
    // A limit's half again is half of the strongest colour.
    let strength = 100.0 * (flip / 0.2 - 1.0);
    let cell = format!(
        "<td class=\"broken required\" style=\"--strength:{strength:.0}%\" data-value=\"{flip}\">\
         <a href=\"#case-{index}\"><span class=\"sign\" aria-hidden=\"true\">✗</span>{flip:.3}\
         <span class=\"unseen\">, broken, required limit 0.2000</span></a>"
    );
    assert!(page.contains(&cell), "{cell}");
    let failures = between(&page, "<details class=\"failures\"", "</details>")[0];
    assert!(failures.contains("plate / identity:default"));

    let article = article(&page, index);
    let worst = case.verdicts[0].worst.as_ref().unwrap();
    for words in [
        "1 of 2 kept.",
        "BROKEN flip_moving 0.2",
        "scenes/plate/bounds.toml:2: it &lt;i&gt;serves&lt;/i&gt; a test",
        "the wrong blur <strong>no_blur</strong>, 0 % off",
        &format!("Worst at ({}, {}) of flip.", worst.x, worst.y),
    ] {
        assert!(
            article.contains(words),
            "\"{words}\" is missing from:\n{article}"
        );
    }
    let shown = between(article, "<img data-picture=\"", "\"");
    assert_eq!(shown.len(), 1, "what is kept needs no picture");
    let crop = fs::read(bench.path("out").join(&worst.picture)).unwrap();
    assert!(pictures(&page)[shown[0].parse::<usize>().unwrap()] == crop);
}

#[test]
fn what_is_no_run_or_lacks_its_pictures_is_refused() {
    let bench = Bench::new();
    fs::create_dir(bench.path("out")).unwrap();
    let refused = |parts: &[&str]| {
        assert_refused(&bench.shuttertruth(&WORDS), 2, parts);
        assert!(!bench.path("page").exists());
    };
    refused(&["out/run.json", "read"]);
    fs::write(bench.path("out/run.json"), "{}").unwrap();
    refused(&["out/run.json: no run of this program", "`shuttertruth run`"]);
    assert_done(&bench.run(&["--filters", "identity"]));
    let picture = bench.path("out/plate/identity_default/flip.png");
    fs::write(&picture, "no picture").unwrap();
    refused(&[
        "out/plate/identity_default/flip.png: is no PNG",
        "run the case again",
    ]);
    fs::remove_file(&picture).unwrap();
    refused(&["out/plate/identity_default/flip.png", "read"]);

    let text = fs::read_to_string(bench.path("out/run.json")).unwrap();
    let mut run: serde_json::Value = serde_json::from_str(&text).unwrap();
    run["cases"] = serde_json::json!([]);
    fs::write(bench.path("out/run.json"), run.to_string()).unwrap();
    refused(&["the run has no cases"]);
}
