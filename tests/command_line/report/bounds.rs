//! Bounds on the page of a finished run.

use metrics::Metric;
use tests::text::assert_contains;

use super::{between, filter_case, find_article, make_page};
use crate::sandbox::{IDENTITY, Sandbox, quick_command, stdout};

/// Makes a sandbox with a check that breaks one of two bounds.
fn set_up() -> Sandbox {
    let sandbox = Sandbox::checked();
    sandbox.write(
        "bounds.toml",
        "[default]\n\
         flip_moving = { limit = 0.2, why = \"it <i>serves</i> a test\" }\n\
         label_tv = { limit = 0.9, why = \"it serves a test, too\" }\n",
    );
    let output = sandbox.check(&IDENTITY);
    assert_eq!(output.status.code(), Some(1), "{}", stdout(&output));
    sandbox
}

#[test]
fn a_broken_bound_is_shown_with_its_place_and_its_picture() {
    let sandbox = set_up();
    let page = make_page(&sandbox);
    let case = filter_case(&sandbox);
    // The estimate without the truth's noise, with its interval.
    let interval = &case.intervals[&Metric::FLIP];
    let flip = interval.center;
    let [low, high] = [interval.low, interval.high].map(judge::number);
    let cell = format!(
        "<td class=\"required\" data-value=\"{flip}\">\
         <a class=\"case\" href=\"#plate/identity:default\">\
         <span class=\"sign\" aria-hidden=\"true\">✗</span>{flip:.3}\
         <span class=\"unseen\">, 95 % CI {low} to {high}"
    );
    let parts = [
        "2 required bounds: 1 broken, 0 too noisy to decide.",
        &cell,
        "<span class=\"unseen\">, broken, required limit 0.2000</span></a>",
    ];
    assert_contains(&page, &parts);
    let failures = between(&page, "<details class=\"failures\"", "</details>")[0];
    assert_contains(failures, &["plate / identity:default"]);

    let article = find_article(&page, &case);
    let findings = sandbox.read_findings();
    let worst = findings[0].worst.as_ref().unwrap();
    let (x, y) = (worst.x, worst.y);
    let parts = [
        "1 of 2 required bounds met.",
        "BROKEN flip_moving 0.2",
        "scenes/plate/bounds.toml:2: it &lt;i&gt;serves&lt;/i&gt; a test",
        "the wrong blur <strong>no_blur</strong>: they differ by 0 %",
        &format!("Worst at ({x}, {y}) of flip."),
    ];
    assert_contains(article, &parts);
    let crop = format!("<figure class=\"crop\" data-x=\"{x}\" data-y=\"{y}\"");
    assert_eq!(article.matches(&crop).count(), 1);
    let crops = article.matches("<figure class=\"crop\"").count();
    assert_eq!(crops, 1, "what is kept needs no picture");
}

#[test]
fn a_run_after_a_check_shows_no_bounds() {
    let sandbox = set_up();
    assert_contains(&make_page(&sandbox), &["BROKEN flip_moving 0.2"]);
    sandbox.execute(&[&quick_command("run", "64")[..], &IDENTITY].concat());
    let page = make_page(&sandbox);
    for words in [
        "class=\"outcome\"",
        "FAIL",
        "Why it failed",
        "BROKEN",
        "targets met",
    ] {
        assert!(!page.contains(words), "{words}");
    }
}
