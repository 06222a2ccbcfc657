//! Numbers behind the pictures: the page's readout of a pixel is what the files hold.

use std::fs;
use std::path::Path;

use frame::{ExrFile, read_exr};
use report::LARGEST_PAGE;
use suite::Case;

use crate::bench::{Bench, assert_done};
use crate::browser::{Browser, address_of};
use crate::{make_page, make_page_within, number_of, open_case};

/// The read-out's rows by the layer, each with its texts.
pub fn read_out(browser: &mut Browser, x: u32, y: u32) -> serde_json::Value {
    browser.until(&format!(
        "document.querySelector('.readout').dataset.pixel === '{x},{y}'"
    ));
    browser.value(
        "Object.fromEntries([...document.querySelectorAll('.readout tr:not([hidden])')].map(row => \
         [row.dataset.layer, [...row.cells].slice(1).map(cell => cell.textContent).filter(text => text)]))",
    )
}

/// Layer by layer the channels that the read-out shows.
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
        ("signed", errors, vec!["signed.R", "signed.G", "signed.B"]),
    ]
}

/// Files of a case: truth, output, frame, errors.
fn files_of(bench: &Bench, case: &Case) -> [ExrFile; 4] {
    let own = bench.path("out").join(&case.folder);
    let scene = bench.path("out").join(&case.scene);
    [
        scene.join(format!("truth_{}.exr", case.alignment)),
        own.join("output.exr"),
        scene.join("frame.exr"),
        own.join("errors.exr"),
    ]
    .map(|path| read_exr(&path).unwrap())
}

#[test]
fn the_read_out_is_the_value_of_the_openexr_files() {
    let bench = Bench::new();
    assert_done(&bench.run(&["--filters", "velocity_gather:fine"]));
    let page = make_page(&bench);
    let number = number_of(&bench, "velocity_gather:fine");
    let case = &bench.measured().cases[number];
    let files = files_of(&bench, case);
    let mut browser = Browser::new(1280, 900);
    open_case(&mut browser, &page, number);
    let [left, top, width, _] = browser.place(".stack");
    let scale = width / 64.0;
    let check = |browser: &mut Browser, x: u32, y: u32| {
        let shown = read_out(browser, x, y);
        for (layer, file, names) in channels(&files) {
            for (index, name) in names.into_iter().enumerate() {
                let text = shown[layer][index].as_str().unwrap();
                let value: f32 = text.parse().unwrap();
                let due = *file.plane(name).unwrap().at(x, y);
                assert!(
                    value == due,
                    "{layer} {name} at ({x}, {y}): {text}, the file has {due:?}"
                );
            }
        }
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

/// Reads out a pixel of a page with rounded numbers, and compares them with the files.
fn assert_near(bench: &Bench, page: &Path, browser: &mut Browser, digits: &Digits) {
    let number = number_of(bench, "velocity_gather:fine");
    let files = files_of(bench, &bench.measured().cases[number]);
    open_case(browser, page, number);
    let [left, top, width, _] = browser.place(".stack");
    browser.point(left + 20.5 * width / 64.0, top + 15.5 * width / 64.0);
    let shown = read_out(browser, 20, 15);
    for (layer, file, names) in channels(&files) {
        let allowed = |due: f32| match layer {
            "flip" | "label_tv" | "unknowable" => 0.5 * digits.step + digits.part * due.abs(),
            // Differences have the error of both colours, which are below 1 here.
            "signed" => 2.0 * digits.part,
            _ => digits.part * due.abs(),
        };
        for (index, name) in names.into_iter().enumerate() {
            let value: f32 = shown[layer][index].as_str().unwrap().parse().unwrap();
            let due = *file.plane(name).unwrap().at(20, 15);
            assert!(
                (value - due).abs() <= allowed(due),
                "{layer} {name}: {value}, the file has {due}"
            );
        }
    }
    assert_eq!(browser.complaints(), [""; 0]);
}

/// Returns how far a number may be from the file's: in parts of it, and for shares half a step more.
struct Digits {
    part: f32,
    step: f32,
}

#[test]
fn numbers_beside_the_page_are_found_and_have_three_digits() {
    let bench = Bench::new();
    assert_done(&bench.run(&["--filters", "velocity_gather:fine"]));
    let page = make_page_within(&bench, 0);
    let beside = bench.path("page/a report_files/scene_0.js");
    assert!(beside.is_file());
    let mut browser = Browser::new(1280, 900);
    // Half a step of a half is 1/2048 of the number, and three digits round by 1/200 at most.
    let digits = Digits {
        part: 0.006,
        step: 1.0 / 256.0,
    };
    assert_near(&bench, &page, &mut browser, &digits);
    assert_eq!(browser.requests(), [address_of(&page), address_of(&beside)]);

    fs::remove_file(&beside).unwrap();
    let number = number_of(&bench, "velocity_gather:fine");
    browser.open(&page, "");
    browser.open(&page, &format!("#case-{number}"));
    browser.until("document.querySelector('.hint').textContent.includes('scene_0.js is missing')");
}

#[test]
fn a_page_that_holds_no_halves_holds_what_a_screen_shows() {
    let bench = Bench::new();
    assert_done(&bench.run(&["--filters", "velocity_gather:fine"]));
    // The least room in which the page holds its numbers: that of the fewest digits.
    let beside = bench.path("page/a report_files");
    let mut room = [0, LARGEST_PAGE];
    while room[1] - room[0] > 64 {
        let middle = (room[0] + room[1]) / 2;
        make_page_within(&bench, middle);
        let fits = !beside.exists();
        room[usize::from(fits)] = middle;
        if !fits {
            fs::remove_dir_all(&beside).unwrap();
        }
    }
    let page = make_page_within(&bench, room[1]);
    let text = fs::read_to_string(&page).unwrap();
    assert!(text.contains("data-precision=\"screen\""));
    assert!(!beside.exists());
    let mut browser = Browser::new(1280, 900);
    // A part in 128, and two digits round by 1/20 at most.
    let digits = Digits {
        part: 0.06,
        step: 1.0 / 64.0,
    };
    assert_near(&bench, &page, &mut browser, &digits);
    assert_eq!(browser.requests(), [address_of(&page)]);
}
