//! Bounds on the page of a finished run.

use metrics::Metric;

use super::{between, filter_case, find_article, make_page};
use crate::sandbox::{Sandbox, assert_done, quick_command, stdout};

#[test]
fn a_broken_bound_is_shown_with_its_place_and_its_picture() {
    let sandbox = Sandbox::new();
    sandbox.write(
        "bounds.toml",
        "[default]\n\
         flip_moving = { limit = 0.2, why = \"it <i>serves</i> a test\" }\n\
         label_tv = { limit = 0.9, why = \"it serves a test, too\" }\n",
    );
    let output = sandbox.check(&["--filters", "identity"]);
    assert_eq!(output.status.code(), Some(1), "{}", stdout(&output));
    let page = make_page(&sandbox);
    let case = filter_case(&sandbox);

    assert!(page.contains("2 required bounds: 1 broken, 0 too noisy to decide."));
    // The estimate without the truth's noise, with its interval.
    let interval = &case.intervals[&Metric::FLIP];
    let flip = interval.center;
    let cell = format!(
        "<td class=\"required\" data-value=\"{flip}\"><a class=\"case\" href=\"#plate/identity:default\">\
         <span class=\"sign\" aria-hidden=\"true\">✗</span>{flip:.3}\
         <span class=\"unseen\">, 95 % CI {} to {}",
        judge::number(interval.low),
        judge::number(interval.high)
    );
    assert!(page.contains(&cell), "{cell}");
    assert!(page.contains("<span class=\"unseen\">, broken, required limit 0.2000</span></a>"));
    let failures = between(&page, "<details class=\"failures\"", "</details>")[0];
    assert!(failures.contains("plate / identity:default"));

    let article = find_article(&page, &case);
    let findings = sandbox.read_findings();
    let worst = findings[0].worst.as_ref().unwrap();
    for words in [
        "1 of 2 required bounds met.",
        "BROKEN flip_moving 0.2",
        "scenes/plate/bounds.toml:2: it &lt;i&gt;serves&lt;/i&gt; a test",
        "the wrong blur <strong>no_blur</strong>: they differ by 0 %",
        &format!("Worst at ({}, {}) of flip.", worst.x, worst.y),
    ] {
        assert!(
            article.contains(words),
            "\"{words}\" is missing from:\n{article}"
        );
    }
    let crop = format!(
        "<figure class=\"crop\" data-x=\"{}\" data-y=\"{}\"",
        worst.x, worst.y
    );
    assert_eq!(article.matches(&crop).count(), 1);
    assert_eq!(
        article.matches("<figure class=\"crop\"").count(),
        1,
        "what is kept needs no picture"
    );
}

#[test]
fn a_report_finds_the_worst_place_if_the_run_did_not() {
    let sandbox = Sandbox::new();
    sandbox.write_bound(0.2);
    let output = sandbox.check(&["--filters", "identity"]);
    assert_eq!(output.status.code(), Some(1));
    let page = make_page(&sandbox);
    let checked = between(
        find_article(&page, &filter_case(&sandbox)),
        "<figure class=\"crop\" ",
        " data-map",
    )[0]
    .to_owned();
    let words = [&quick_command("run", "64")[..], &["--filters", "identity"]].concat();
    assert_done(&sandbox.shuttertruth(&words));
    let page = make_page(&sandbox);
    let article = find_article(&page, &filter_case(&sandbox));
    assert_eq!(
        between(article, "<figure class=\"crop\" ", " data-map")[0],
        checked
    );
    assert!(article.contains("No known failure pattern matched (only <code>check</code> looks"));
    // Nothing that a run breaks fails: it is a target.
    assert!(article.contains("0 of 1 target met; targets fail nothing."));
    for words in ["class=\"outcome\"", "FAIL", "Why it failed", "BROKEN"] {
        assert!(!page.contains(words), "{words}");
    }
}
