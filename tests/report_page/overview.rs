//! The overview in a browser: the search for rows, the preview of a worst place, and sections of
//! filters.

use std::path::Path;

use tests::text::assert_contains;

use crate::browser::Browser;
use crate::{Check, make_page, measured_two, open_page, run_checks};

/// Returns the names in the visible rows.
fn rows(browser: &mut Browser) -> String {
    browser.text(
        "$$('.panel:not([hidden]) tbody:not(.group) tr:not([hidden])').map(row => \
         row.cells[0].textContent).join()",
    )
}

#[test]
fn the_search_filters_rows_and_references_show_on_request() {
    const FILTERS: [&str; 2] = ["--filters", "identity,velocity_gather:fine"];
    let sandbox = measured_two();
    let errors = sandbox.read_filter_cases().into_iter();
    let errors = errors.map(|case| case.scores.moving.flip.value().unwrap());
    sandbox.write_bound(errors.sum::<f64>() / 2.0);
    let output = sandbox.check(&FILTERS);
    assert_eq!(output.status.code(), Some(1), "one is beyond the mean");
    let browser = &mut open_page(&make_page(&sandbox));
    assert_eq!(rows(browser), "velocity_gather:fine,identity:default");
    let mut show = |change: &str| {
        browser.value(&format!(
            "(() => {{ const tools = document.getElementById('tables'); const at = (one) => tools.querySelector(one); \
             {change}; tools.dispatchEvent(new Event('input')); }})()"
        ));
        let shown = rows(browser);
        let mut names: Vec<_> = shown.split(',').map(str::to_owned).collect();
        names.sort();
        names.join(" ")
    };
    let failing = show("at('[name=failing]').checked = true");
    assert_eq!(failing, "identity:default");
    show("at('[name=failing]').checked = false");
    let shown = show("at('[name=search]').value = 'Gather'");
    assert_eq!(shown, "velocity_gather:fine");
    let all = show("at('[name=search]').value = ''; at('[name=references]').checked = true");
    // A check has no accumulations except the one that skill is counted from.
    let due = "accumulate:1 identity identity:default scatter_oracle velocity_gather:fine";
    assert_eq!(all, due);
    show("at('[value=psnr_moving]').checked = true");
    let title = browser.text("$('.panel:not([hidden])').dataset.metric");
    assert_eq!(title, "psnr_moving");
    // The thumbnail of the truth is above its column, whichever score is shown.
    browser.until("$('.panel:not([hidden]) th.scene img').naturalWidth === 64");
    assert_eq!(browser.complaints(), [""; 0]);
}

#[test]
fn the_overview_leads_to_tables_filters_and_cases() {
    let sandbox = measured_two();
    let checks: [Check; 5] = [
        a_link_opens_the_same_table,
        a_cell_shows_its_worst_place_and_a_name_leads_to_the_filter,
        only_the_table_that_is_seen_is_parsed_until_somebody_prints,
        tables_have_captions_and_pictures_have_words,
        everything_fits_a_narrow_screen,
    ];
    let page = make_page(&sandbox);
    run_checks(&mut open_page(&page), &page, &checks);
}

fn a_link_opens_the_same_table(browser: &mut Browser, page: &Path) {
    assert_eq!(browser.text("location.hash"), "");
    browser.value(
        "(() => { const tools = document.getElementById('tables'); tools.querySelector('[value=row_loss]').checked = true; \
         tools.querySelector('[name=search]').value = 'y_g & 100%+'; tools.dispatchEvent(new Event('input')); })()",
    );
    browser.until("location.hash === '#overview&metric=row_loss&search=y_g%20%26%20100%25%2B'");
    assert_eq!(rows(browser), "");
    let nothing = "$('.nothing').checkVisibility()";
    assert_eq!(browser.value(nothing), true);
    browser.value(
        "(() => { const search = $('[name=search]'); search.value = 'y_g'; \
         search.dispatchEvent(new Event('input', {bubbles: true})); })()",
    );
    browser.until("location.hash === '#overview&metric=row_loss&search=y_g'");
    let link = browser.text("location.hash");
    let seen = "[$('.panel:not([hidden])').dataset.metric, $('[name=search]').value].join()";
    browser.value("document.wasSeen = true; location.reload()");
    browser.until("!document.wasSeen && document.readyState === 'complete'");
    browser.until(&format!("{seen} === 'row_loss,y_g'"));
    assert_eq!(rows(browser), "velocity_gather:fine");
    browser.open(page, "");
    assert_eq!(browser.text(seen), "flip_moving,");
    browser.open(page, &link);
    browser.until(&format!("{seen} === 'row_loss,y_g'"));
    assert_eq!(rows(browser), "velocity_gather:fine");
    // Going back from a case keeps them.
    browser.value("location.hash = '#plate/identity:default'");
    browser.until("!document.getElementById('viewer').hidden");
    browser.press("o");
    browser.until("location.hash === '#overview&metric=row_loss&search=y_g'");
    assert_eq!(rows(browser), "velocity_gather:fine");
}

fn a_cell_shows_its_worst_place_and_a_name_leads_to_the_filter(browser: &mut Browser, _: &Path) {
    let [x, y, width, height] = browser.place(".panel tbody:not(.group) tr:not([hidden]) a.case");
    browser.point(x + width / 2.0, y + height / 2.0);
    browser.until("!$('.peek').hidden");
    let different = "new Set($$('.peek canvas').map(canvas => canvas.toDataURL())).size";
    assert_eq!(browser.value(different), 3);
    browser.click(".winners a");
    browser.until("location.hash === '#filter:velocity_gather:fine'");
    assert!(!browser.shows("#overview"));
    let text = browser.text("$('article.open').innerText");
    let parts = [
        "velocity_gather:fine",
        "published",
        "limits",
        "Parameters",
        "Scenes, the weakest first",
        "plate",
    ];
    assert_contains(&text, &parts);
    browser.click("article.open a.scene");
    browser.until("location.hash.startsWith('#plate/velocity_gather:fine')");
    browser.until("document.getElementById('viewer').checkVisibility()");
}

fn only_the_table_that_is_seen_is_parsed_until_somebody_prints(browser: &mut Browser, _: &Path) {
    let tables = "$$('.panel table').length";
    assert_eq!(browser.value(tables), 1);
    browser.click("[name=metric][value=psnr_moving]");
    browser.until(&format!("{tables} === 2"));
    let sorted = "$('.panel:not([hidden]) thead th[aria-sort]') !== null";
    browser.click(".panel:not([hidden]) thead th:nth-child(2) button");
    assert_eq!(browser.value(sorted), true);
    browser.paper();
    let panels = browser.value("$$('.panel').length");
    assert_eq!(browser.value(tables), panels);
    assert_eq!(rows(browser), "velocity_gather:fine,identity:default");
}

fn tables_have_captions_and_pictures_have_words(browser: &mut Browser, page: &Path) {
    for part in ["", "#plate/identity:default", "#filter:identity:default"] {
        browser.open(page, part);
        browser.until("document.documentElement.classList.contains('scripted')");
        for (elements, lacks) in [
            ("table", "!element.caption?.textContent.trim()"),
            ("th", "!element.scope"),
            ("img", "!element.hasAttribute('alt')"),
            (
                "canvas",
                "!hidden && element.checkVisibility() && !element.ariaLabel",
            ),
            ("svg", "!hidden && !element.ariaLabel"),
            (
                "button",
                "!element.ariaLabel && !element.textContent.trim()",
            ),
        ] {
            let lacks = lacks.replace("hidden", "element.closest('[aria-hidden=true]')");
            let lacking = browser.text(&format!(
                "$$('{elements}').filter(element => {lacks}).map(element => element.outerHTML.slice(0, 200)).join('; ')"
            ));
            assert_eq!(lacking, "", "{part} {elements}");
        }
    }
}

fn everything_fits_a_narrow_screen(browser: &mut Browser, page: &Path) {
    let width = "document.documentElement.scrollWidth";
    browser.resize(360, 800);
    for part in ["", "#plate/identity:default", "#filter:identity:default"] {
        browser.open(page, part);
        // The page need not be scrolled sideways.
        assert_eq!(browser.value(width), 360, "{part}");
    }
    // The printed overview need not be scrolled either.
    browser.resize(794, 1123);
    browser.print();
    browser.open(page, "");
    assert_eq!(browser.value(width), 794);
}
