//! Numbers behind the pictures: the read-out of a pixel against the files.

use std::fs;

use frame::{ExrFile, read_exr};
use suite::Case;

use crate::browser::{Browser, address_of};
use crate::sandbox::{Sandbox, assert_done};
use crate::{case_of, make_page, make_page_within, open_case};

/// Returns the read-out's rows by layer, each with its texts.
pub fn read_out(browser: &mut Browser, x: u32, y: u32) -> serde_json::Value {
    browser.until(&format!(
        "document.querySelector('.readout').dataset.pixel === '{x},{y}'"
    ));
    browser.value(
        "Object.fromEntries([...document.querySelectorAll('.readout tr:not([hidden])')].map(row => \
         [row.dataset.layer, [...row.cells].slice(1).map(cell => cell.textContent).filter(text => text)]))",
    )
}

/// Returns the channels that the read-out shows of each layer.
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
    let own = sandbox.path("out").join(&case.folder);
    let scene = sandbox.path("out").join(case.scene.folder());
    [
        scene.join(format!("truth_{}.exr", case.alignment)),
        own.join("output.exr"),
        scene.join("frame.exr"),
        own.join("errors.exr"),
    ]
    .map(|path| read_exr(&path).unwrap())
}

/// Largest relative error of a number: half a step of a half is 1/2048, and three digits round by 1/200 at most.
const PART: f32 = 0.006;

/// Compares a read-out with the files. A half below 6e-5 has fewer digits, and no picture shows such small values.
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

#[test]
fn the_read_out_shows_the_values_of_the_openexr_files_in_three_digits() {
    let sandbox = Sandbox::new();
    assert_done(&sandbox.run(&["--filters", "velocity_gather:fine"]));
    let page = make_page(&sandbox);
    let case = case_of(&sandbox, "velocity_gather:fine");
    let files = files_of(&sandbox, &case);
    let mut browser = Browser::new(1280, 900);
    open_case(&mut browser, &page, "plate/velocity_gather:fine");
    let [left, top, width, _] = browser.place(".stack");
    let scale = width / 64.0;
    let check = |browser: &mut Browser, x: u32, y: u32| {
        let shown = read_out(browser, x, y);
        assert_near(&shown, &files, x, y);
        let depth = &shown["depth"][0];
        assert!(
            depth == "4" || depth == "no surface",
            "the plate stands 4 m away: {depth}"
        );
    };
    for (x, y) in [(20_u32, 15_u32), (30, 17), (3, 2)] {
        let at = [x, y].map(|pixel| scale * (f64::from(pixel) + 0.5));
        browser.point(left + at[0], top + at[1]);
        check(&mut browser, x, y);
    }
    browser.value("document.querySelector('.stack').focus()");
    browser.press("ArrowRight");
    browser.press("ArrowDown");
    check(&mut browser, 4, 3);
    let spoken = browser.text("document.querySelector('.spoken').textContent");
    assert!(
        spoken.starts_with("x 4, y 3, background; Truth 0.2 0.2 0.2"),
        "{spoken}"
    );
}

#[test]
fn numbers_and_tables_beside_the_page_are_found() {
    let sandbox = Sandbox::new();
    assert_done(&sandbox.run(&["--filters", "identity,velocity_gather:fine"]));
    let whole = make_page(&sandbox);
    let mut browser = Browser::new(1280, 900);
    let article = "[...document.querySelectorAll('article.open > :not(.viewer_place)')].map((own) => own.textContent).join()";
    open_case(&mut browser, &whole, "plate/velocity_gather:fine");
    let words = browser.text(article);
    assert!(words.contains("flip_moving"), "{words}");

    let page = make_page_within(&sandbox, 0);
    let [numbers, tables] =
        ["scene_0.js", "tables_0.js"].map(|name| sandbox.path("page/a report_files").join(name));
    let mut browser = Browser::new(1280, 900);
    open_case(&mut browser, &page, "plate/velocity_gather:fine");
    assert_eq!(browser.text(article), words);
    let [left, top, width, _] = browser.place(".stack");
    browser.point(left + 20.5 * width / 64.0, top + 15.5 * width / 64.0);
    let shown = read_out(&mut browser, 20, 15);
    let files = files_of(&sandbox, &case_of(&sandbox, "velocity_gather:fine"));
    assert_near(&shown, &files, 20, 15);
    browser.press("k");
    browser.until(
        "document.querySelector('article.open h2').textContent === 'plate / identity:default'",
    );
    assert_eq!(browser.complaints(), [""; 0]);
    let due = [&page, &tables, &numbers].map(|path| address_of(path));
    assert_eq!(browser.requests(), due);

    fs::write(&tables, "shuttertruth.arrived(\"tables_0\", {});\n").unwrap();
    browser.open(&page, "");
    browser.open(&page, "#plate/velocity_gather:fine");
    browser.until(&format!(
        "{article}.includes('tables_0.js is of another run')"
    ));
    fs::remove_file(&tables).unwrap();
    fs::remove_file(&numbers).unwrap();
    browser.open(&page, "");
    browser.open(&page, "#plate/velocity_gather:fine");
    browser.until(&format!("{article}.includes('tables_0.js is missing')"));
    browser.until("document.querySelector('.hint').textContent.includes('scene_0.js is missing')");
}
