//! Bounds on the page, and the evidence for those that are broken.

use tests::text::assert_contains;

use super::{find_article, find_between, make_page};
use crate::bench::{Bench, quick, stdout};

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
    let page = make_page(&bench);
    let run = bench.measured();
    let index = run
        .cases
        .iter()
        .position(|case| !case.is_reference)
        .unwrap();
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
    let failures = find_between(&page, "<details class=\"failures\"", "</details>")[0];
    assert!(failures.contains("plate / identity:default"));

    let article = find_article(&page, index);
    let findings = bench.findings();
    let worst = findings[0].worst.as_ref().unwrap();
    assert_contains(
        &article,
        &[
            "1 of 2 kept.",
            "BROKEN flip_moving 0.2",
            "scenes/plate/bounds.toml:2: it &lt;i&gt;serves&lt;/i&gt; a test",
            "the wrong blur <strong>no_blur</strong>, 0 % off",
            &format!("Worst at ({}, {}) of flip.", worst.x, worst.y),
        ],
    );
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
fn a_run_that_looked_for_no_place_gets_one_in_its_report() {
    let bench = Bench::new();
    bench.write(
        "bounds.toml",
        "[default]\nflip_moving = { limit = 0.2, why = \"it serves a test\" }\n",
    );
    let output = bench.check(&["--filters", "identity"]);
    assert_eq!(output.status.code(), Some(1));
    let page = make_page(&bench);
    let case = |bench: &Bench| {
        bench
            .measured()
            .cases
            .iter()
            .position(|case| !case.is_reference)
            .unwrap()
    };
    let checked = find_between(
        find_article(&page, case(&bench)),
        "<figure class=\"crop\" ",
        " data-map",
    )[0]
    .to_owned();
    let words = [&quick("run", "64")[..], &["--filters", "identity"]].concat();
    bench.done(&words);
    let page = make_page(&bench);
    let article = find_article(&page, case(&bench));
    assert_eq!(
        find_between(article, "<figure class=\"crop\" ", " data-map")[0],
        checked
    );
    assert!(article.contains("No known failure pattern matched (only <code>check</code> looks"));
}
