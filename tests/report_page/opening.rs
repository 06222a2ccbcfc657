//! Opening time of a report: `cargo run --package shuttertruth --example report_opening -- out/report.html`.

#[expect(dead_code, reason = "the tests of pages need more of it")]
mod browser;

use std::path::PathBuf;
use std::time::{Duration, Instant};

use browser::Browser;

/// Number of times that the page is opened.
const REPEATS: usize = 7;

fn main() {
    let page = std::env::args().nth(1).map(PathBuf::from);
    let page = page.expect("the path of a report");
    let page = page.canonicalize().expect("a report at that path");
    let mut browser = Browser::new(1440, 900);
    let mut times: Vec<Duration> = (0..REPEATS)
        .map(|_| time_opening(&mut browser, &page))
        .collect();
    times.sort();
    let [least, median, most] = [0, REPEATS / 2, REPEATS - 1].map(|at| times[at].as_secs_f64());
    let bytes = page.metadata().expect("its size").len();
    let elements = browser.value("$$('*').length");
    println!(
        "opened in {median:.2} s ({least:.2} to {most:.2} s, {REPEATS} times): {:.1} MB, {elements} elements",
        bytes as f64 / 1e6
    );
}

/// Opens the page and waits until it is drawn and its scripts have run.
fn time_opening(browser: &mut Browser, page: &std::path::Path) -> Duration {
    let start = Instant::now();
    browser.open(page, "");
    browser.until("document.documentElement.classList.contains('scripted')");
    browser.value("new Promise(done => requestAnimationFrame(() => setTimeout(done)))");
    start.elapsed()
}
