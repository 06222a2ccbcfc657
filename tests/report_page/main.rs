//! Reports in a real browser: pictures, pointer and keys.

#[expect(dead_code, reason = "the pictures of pages need more of it")]
mod browser;
mod cases;
mod live;
mod live_data;
mod numbers;
mod other_pages;
mod overview;
#[path = "../command_line/sandbox.rs"]
#[expect(dead_code, reason = "the tests of the command line need more of it")]
mod sandbox;
mod site;

use std::path::{Path, PathBuf};

use browser::{Browser, address_of};
use numbers::read_out;
use report::{LARGEST_PAGE, RunReport, write_report};
use sandbox::{Sandbox, split};
use tests::text::assert_contains;

/// Makes the page of the sandbox's last run; returns its path.
fn make_page(sandbox: &Sandbox) -> PathBuf {
    make_page_within(sandbox, LARGEST_PAGE)
}

fn make_page_within(sandbox: &Sandbox, largest: usize) -> PathBuf {
    let html = sandbox.path("page/a report.html");
    let (run, findings) = (sandbox.read_run(), sandbox.read_findings());
    let out = sandbox.path("out");
    let verdict = judge::Judgement::read(&run, &out).unwrap().unwrap().verdict;
    let report = RunReport {
        run: &run,
        folder: &out,
        findings: &findings,
        verdict: verdict.as_ref(),
        additions: &[bench::add_costs(&run, &out).unwrap()],
        largest,
    };
    write_report(&report, &html).unwrap();
    html
}

/// Opens a page in a window of a usual size.
fn open_page(page: &Path) -> Browser {
    let mut browser = Browser::new(1280, 900);
    browser.open(page, "");
    browser
}

/// A check of a page just opened, in a window of a usual size or of the last check's.
type Check = fn(&mut Browser, &Path);

/// Opens a page for each check, and expects no complaints from it.
fn run_checks(browser: &mut Browser, page: &Path, checks: &[Check]) {
    for check in checks {
        browser.open(page, "");
        check(browser, page);
    }
    assert_eq!(browser.complaints(), [""; 0]);
}

/// Opens a case by its address, `plate/bevy:high`, and waits for its pictures.
fn open_case(browser: &mut Browser, page: &Path, case: &str) {
    browser.open(page, &format!("#{case}"));
    settle(browser);
}

/// Waits until the last request is drawn.
fn settle(browser: &mut Browser) {
    browser.until("document.getElementById('viewer').dataset.drawn === document.getElementById('viewer').dataset.asked");
}

fn press(browser: &mut Browser, key: &str) {
    browser.press(key);
    settle(browser);
}

/// Measures filters on the plate.
fn measure(filters: &str) -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.measure(&format!("--filters {filters}"));
    sandbox
}

/// Makes a sandbox with a run of two filters, which several tests make pages of.
fn measured_two() -> Sandbox {
    Sandbox::once(|sandbox| drop(sandbox.measure("--filters identity,velocity_gather:fine")))
}

#[test]
fn a_page_opens_without_complaint_and_asks_for_nothing_else() {
    let sandbox = Sandbox::two_scenes();
    sandbox.measure("--filters identity,velocity_gather:fine");
    let page = make_page(&sandbox);
    let mut browser = open_page(&page);
    for case in sandbox.read_run().cases {
        let reference = if case.is_reference { "@trailing" } else { "" };
        let address = format!("{}/{}{reference}", case.scene, case.name());
        browser.value(&format!("location.hash = '#{address}'"));
        browser.until(&format!(
            "!!document.getElementById('{address}').querySelector('#viewer')"
        ));
        // The key steps through the case's own pictures, those of seven other filters, and the
        // case's maps. Cases of accumulations are alike, and so are those of both scenes.
        let is_further = case.filter == "accumulate" && case.preset != "16";
        let is_alike = case.scene == "slow" || is_further;
        for _ in 0..if is_alike { 2 } else { 18 } {
            press(&mut browser, "m");
        }
    }
    assert_eq!(browser.complaints(), [""; 0]);
    assert_eq!(browser.requests(), [address_of(&page)]);
    let checks: [Check; 2] = [
        every_key_that_the_page_lists_works,
        an_address_that_names_another_section_is_left_alone,
    ];
    run_checks(&mut browser, &page, &checks);
    // The test notices errors: it causes one itself.
    browser.value("console.error('heard')");
    assert_eq!(browser.complaints().len(), 1);
    browser
        .value("document.head.append(Object.assign(new Image(), {src: 'https://example.org/'}))");
    browser.until("new Promise(done => setTimeout(() => done(true), 200))");
    assert!(browser.complaints().len() > 1, "the page may fetch nothing");
}

fn every_key_that_the_page_lists_works(browser: &mut Browser, page: &Path) {
    open_case(browser, page, "plate/identity:default");
    let state = "[location.hash.split('&')[0], document.documentElement.dataset.theme, document.getElementById('viewer').dataset.mode, \
                 ...['left', 'right', 'split'].map(name => $(`[name=${name}]`).value), \
                 $('[name=exposure]:checked').value, $('.zoom').textContent, \
                 $('.readout').dataset.pixel, document.getElementById('viewer').hidden].join()";
    let is_open = "($('article.open')?.id ?? 'overview') === location.hash.slice(1).split('&')[0]";
    let mut before = browser.text(state);
    for key in split(
        "3 4 5 1 a A m M x w - + = 0 e [ ] PageUp PageDown ArrowRight ArrowLeft ArrowDown ArrowUp t j k l h 2 o",
    ) {
        if key == "PageUp" {
            // Side by side it was hidden.
            browser.value("$('.stack').focus()");
        }
        browser.press(key);
        // A key pressed while another case is about to open is lost.
        let change = format!("{state} !== {}", serde_json::json!(before));
        browser.until(&format!("{change} && {is_open}"));
        before = browser.text(state);
    }
    // A filter's own page leads back, too.
    browser.click(".winners a");
    browser.until("location.hash.startsWith('#filter:')");
    browser.press("o");
    browser.until("document.getElementById('overview').checkVisibility()");
}

fn an_address_that_names_another_section_is_left_alone(browser: &mut Browser, page: &Path) {
    open_case(browser, page, "plate/identity:default");
    // The page is in the state between a click on a link and the event that follows.
    browser.value("window.shuttertruth.note(); history.pushState(null, '', '#overview')");
    browser.value("new Promise(done => setTimeout(done, 300))");
    assert_eq!(browser.text("location.hash"), "#overview");
}

#[test]
fn a_broken_bound_is_seen_with_its_place_and_its_pictures() {
    let sandbox = Sandbox::new();
    sandbox.write_bound(0.2);
    let output = sandbox.check(&["--filters", "identity"]);
    assert_eq!(output.status.code(), Some(1));
    let mut browser = open_page(&make_page(&sandbox));
    let outcome = browser.text("$('.outcome').innerText");
    let due = "FAIL: a required bound is broken. 1 required bound: 1 broken";
    assert!(outcome.starts_with(due), "{outcome}");
    browser.click(".failures a");
    browser.until("location.hash === '#plate/identity:default'");
    settle(&mut browser);
    let section = browser.text("$('article.open .verdicts').innerText");
    let parts = [
        "Why it failed",
        "BROKEN flip_moving 0.2",
        "it serves a test",
        "no_blur",
        "95 % CI",
        "noise floor",
    ];
    assert_contains(&section, &parts);
    // Truth, output and error are drawn, and no two of them are equal.
    let canvas = |at: usize| format!("$$('article.open .crop canvas')[{at}].toDataURL()");
    let [truth, output, error] = [0, 1, 2].map(canvas);
    browser.until(&format!(
        "new Set([{truth}, {output}, {error}, (() => {{ const canvas = $('article.open .crop canvas'); \
         return Object.assign(document.createElement('canvas'), {{width: canvas.width, height: canvas.height}}).toDataURL(); }})()]).size === 4"
    ));
    let worst = sandbox.read_findings()[0].worst.clone().unwrap();
    browser.click("article.open button.place");
    read_out(&mut browser, worst.x, worst.y);
    assert!(browser.shows(".stack .mark"));
    assert_eq!(browser.complaints(), [""; 0]);
}

#[cfg(unix)] // Elsewhere no folder has such a name.
#[test]
fn a_scene_name_with_a_script_is_shown_as_text() {
    const NAME: &str = "<script>alert(1)";
    let sandbox = Sandbox::new();
    sandbox.copy_scene(NAME, |text| {
        text.replace("nothing: it serves", "<img src=x onerror=alert(2)> & it's")
    });
    sandbox.measure(&format!("--filters identity --scenes {NAME}"));
    let page = make_page(&sandbox);
    let mut browser = Browser::new(1280, 900);
    let case = "~3cscript~3ealert~281~29/identity:default";
    open_case(&mut browser, &page, case);
    let title = browser.read("article.open h2");
    assert_eq!(title, "<script>alert(1) / identity:default");
    let title = browser.text("document.title");
    let due = "<script>alert(1) / identity:default - Shuttertruth";
    assert_eq!(title, due);
    let images = "[...document.images].filter(image => image.src.startsWith('data:')).length === document.images.length";
    assert_eq!(browser.value(images), true);
    assert_eq!(browser.complaints(), [""; 0]);
}
