//! The page of a finished run, with its other pages and layers.

mod bounds;
mod layers;
mod page;

use crate::sandbox::Sandbox;

pub const REPORT: &str = "report out/run.json --html page/report.html";

/// Makes the page of the bench's last run.
pub fn make_page(sandbox: &Sandbox) -> String {
    let printed = sandbox.done(REPORT);
    assert!(printed.contains("written: page/report.html ("), "{printed}");
    sandbox.text("page/report.html")
}

/// Finds every text between two texts.
pub fn between<'a>(page: &'a str, before: &str, after: &str) -> Vec<&'a str> {
    let rests = page.split(before).skip(1);
    rests
        .map(|rest| rest.split_once(after).expect("an end").0)
        .collect()
}

/// Reads the planes of a page's scenes.
fn planes(page: &str) -> Vec<Vec<String>> {
    let start = "<script type=\"application/json\" data-scene=\"";
    let texts = between(page, start, "</script>");
    (texts.into_iter())
        .map(|text| serde_json::from_str(text.split_once('>').unwrap().1).unwrap())
        .collect()
}

/// Finds the part of a page with one score of all cases.
fn panel<'a>(page: &'a str, metric: &str) -> &'a str {
    let (_, rest) = page
        .split_once(&format!("data-metric=\"{metric}\""))
        .unwrap();
    rest.split("data-metric=").next().unwrap()
}

/// Returns the address of a case: `plate/bevy:high`, `plate/identity@trailing`.
fn address(case: &measure::Case) -> String {
    let reference = if case.is_reference {
        format!("@{}", case.alignment)
    } else {
        String::new()
    };
    format!("{}/{}{reference}", case.scene, case.name())
}

/// Finds the part of a page with a case.
fn find_article<'a>(page: &'a str, case: &measure::Case) -> &'a str {
    let start = format!("<article class=\"case\" id=\"{}\"", address(case));
    between(page, &start, "</article>")[0]
}

/// Returns the only case of a filter.
fn filter_case(sandbox: &Sandbox) -> measure::Case {
    sandbox.read_filter_cases().remove(0)
}
