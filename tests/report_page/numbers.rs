//! Numbers of the pictures: the read-out of a pixel against the files.

use std::fs;

use frame::{ExrFile, Frame, read_exr};
use measure::Case;
use metrics::flip_ldr;

use crate::browser::{Browser, address_of};
use crate::sandbox::Sandbox;
use crate::{make_page, make_page_within, measured_two, open_case};

/// Returns the read-out's rows by layer, each with its texts.
pub fn read_out(browser: &mut Browser, x: u32, y: u32) -> serde_json::Value {
    browser.until(&format!("$('.readout').dataset.pixel === '{x},{y}'"));
    browser.value(
        "Object.fromEntries($$('.readout tr:not([hidden])').map(row => \
         [row.dataset.layer, [...row.cells].slice(1).map(cell => cell.textContent).filter(text => text)]))",
    )
}

/// Returns the read-out's channels of each layer.
fn channels(files: &[ExrFile; 4]) -> Vec<(&'static str, &ExrFile, Vec<&'static str>)> {
    let [truth, output, frame, errors] = files;
    let color = || vec!["R", "G", "B"];
    vec![
        ("truth", truth, color()),
        ("unknowable", truth, vec!["unknowable"]),
        ("output", output, color()),
        ("instant", frame, color()),
        ("velocity", frame, vec!["velocity.X", "velocity.Y"]),
        ("flip", errors, vec!["flip"]),
        ("label_tv", errors, vec!["label_tv"]),
        ("signed", output, color()),
    ]
}

/// Reads the files of a case: truth, output, frame, errors.
fn files_of(sandbox: &Sandbox, case: &Case) -> [ExrFile; 4] {
    let folder = sandbox.path("out").join(&case.folder);
    let scene = sandbox.path("out").join(case.scene.folder());
    let mut files = [
        scene.join(format!("truth_{}.exr", case.alignment)),
        folder.join("output.exr"),
        scene.join("frame.exr"),
        folder.join("errors.exr"),
    ]
    .map(|path| read_exr(&path).unwrap());
    let [truth, output] = [0, 1].map(|at: usize| files[at].color("").unwrap());
    let frame = Frame::read(&scene.join("frame.exr")).unwrap();
    files[3].push_plane("flip", &flip_ldr(&truth, &output, &frame.display.into()));
    files
}

/// Largest relative error of a number: half a step of a half is 1/2048, and three digits round by
/// 1/200 at most.
const PART: f32 = 0.006;

/// Compares a read-out with the files. A half below 6e-5 has fewer digits, and no picture shows
/// such small values.
#[track_caller]
fn assert_near(shown: &serde_json::Value, files: &[ExrFile; 4], x: u32, y: u32) {
    for (layer, file, names) in channels(files) {
        for (index, name) in names.into_iter().enumerate() {
            let text = shown[layer][index].as_str().unwrap();
            let value: f32 = text.parse().unwrap();
            let [truth, output, ..] = files;
            let at = |file: &ExrFile, name| *file.plane(name).unwrap().at(x, y);
            let due = match layer {
                "signed" => at(output, name) - at(truth, name),
                _ => at(file, name),
            };
            // Differences have the error of both colours, which are below 1 here.
            let allowed = match layer {
                "signed" => 2.0 * PART,
                _ => PART * due.abs() + 1e-6,
            };
            assert!(
                (value - due).abs() <= allowed,
                "{layer} {name} at ({x}, {y}): {text}, the file has {due:?}"
            );
        }
    }
}

/// Points at pixels of a case, where the read-outs show the OpenEXR files' values with three
/// digits.
fn assert_read_outs(browser: &mut Browser, files: &[ExrFile; 4]) {
    let [left, top, width, _] = browser.place(".stack");
    let scale = width / 64.0;
    let check = |browser: &mut Browser, x: u32, y: u32| {
        let shown = read_out(browser, x, y);
        assert_near(&shown, files, x, y);
        // The plate is 4 m away.
        let depth = &shown["depth"][0];
        assert!(depth == "4" || depth == "no surface", "{depth}");
    };
    for (x, y) in [(20_u32, 15_u32), (30, 17), (3, 2)] {
        let at = [x, y].map(|pixel| scale * (f64::from(pixel) + 0.5));
        browser.point(left + at[0], top + at[1]);
        check(browser, x, y);
    }
    browser.value("$('.stack').focus()");
    browser.press("ArrowRight");
    browser.press("ArrowDown");
    check(browser, 4, 3);
    let spoken = browser.read(".spoken");
    let due = "x 4, y 3, background; Truth 0.2 0.2 0.2";
    assert!(spoken.starts_with(due), "{spoken}");
}

#[test]
fn numbers_and_tables_in_a_page_or_beside_it_are_those_of_the_files() {
    let sandbox = measured_two();
    let cases = sandbox.read_filter_cases();
    let mut all = cases.iter();
    let case = all.find(|case| case.name() == "velocity_gather:fine");
    let files = files_of(&sandbox, case.unwrap());
    let whole = make_page(&sandbox);
    let mut browser = Browser::new(1280, 900);
    let article = "$$('article.open > :not(.viewer_place)').map((part) => part.textContent).join()";
    open_case(&mut browser, &whole, "plate/velocity_gather:fine");
    let words = browser.text(article);
    assert!(words.contains("flip_moving"), "{words}");
    assert_read_outs(&mut browser, &files);

    let page = make_page_within(&sandbox, 0);
    let [numbers, tables] =
        ["scene_0.js", "tables_0.js"].map(|name| sandbox.path("page/a report_files").join(name));
    let mut browser = Browser::new(1280, 900);
    open_case(&mut browser, &page, "plate/velocity_gather:fine");
    assert_eq!(browser.text(article), words);
    assert_read_outs(&mut browser, &files);
    browser.press("k");
    browser.until("$('article.open h2').textContent === 'plate / identity:default'");
    assert_eq!(browser.complaints(), [""; 0]);
    let due = [&page, &tables, &numbers].map(|path| address_of(path));
    assert_eq!(browser.requests(), due);

    let open = |browser: &mut Browser| {
        browser.open(&page, "");
        browser.open(&page, "#plate/velocity_gather:fine");
    };
    fs::write(&tables, "shuttertruth.arrived(\"tables_0\", {});\n").unwrap();
    open(&mut browser);
    browser.until(&format!(
        "{article}.includes('tables_0.js is of another run')"
    ));
    fs::remove_file(&tables).unwrap();
    fs::remove_file(&numbers).unwrap();
    open(&mut browser);
    browser.until(&format!("{article}.includes('tables_0.js is missing')"));
    browser.until("$('.hint').textContent.includes('scene_0.js is missing')");
}
