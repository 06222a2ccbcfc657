//! Pages of a comparison and of a tuning in a browser.

use std::fs;

use frame::{Raster, write_png};

use crate::browser::{Browser, address_of};
use crate::sandbox::Sandbox;
use crate::{open_page, press, settle};

const GATHER: &str = "--filters velocity_gather:fine";

#[test]
fn a_comparison_shows_pictures_first_and_a_change_with_sign_and_word() {
    let sandbox = Sandbox::new();
    sandbox.measure(GATHER);
    fs::rename(sandbox.path("out"), sandbox.path("before")).unwrap();
    sandbox.measure(&format!("{GATHER} --set velocity_gather.samples=2"));
    sandbox.done("compare before out --html page.html");
    let page = sandbox.path("page.html");
    let mut browser = open_page(&page);
    let heading = browser.read("main h2");
    assert_eq!(heading, "What changed most");
    let [_, top, _, height] = browser.place(".pair");
    assert!(top + height < 900.0, "the pictures are on the first screen");
    let before = browser.picture(".pair");
    browser.value(
        "(() => { const input = $('.trio input'); input.value = 5; input.dispatchEvent(new Event('input')); })()",
    );
    assert!(browser.picture(".pair") != before, "the divider moves");
    let changes = browser.text("$$('td.worse').map(cell => cell.textContent).join('; ')");
    assert!(changes.starts_with('+'), "{changes}");
    assert!(changes.contains(" worse"), "{changes}");
    // For scores where higher is better, less is worse and has a minus.
    let psnr = browser.text(
        "$$('.trio ~ .scroll tr').find(row => row.textContent.startsWith('psnr_moving')).cells[3].textContent",
    );
    assert!(psnr.starts_with('-') && psnr.ends_with("worse"), "{psnr}");
    assert_eq!(browser.complaints(), [""; 0]);
    assert_eq!(browser.requests(), [address_of(&page)]);
}

#[test]
fn two_pictures_open_under_the_slider_and_blink_and_show_their_map() {
    let sandbox = Sandbox::new();
    for (name, edge) in [("ref", 20), ("mine", 26)] {
        let picture = Raster::from_fn(48, 32, |x, _| [if x < edge { 0.8 } else { 0.2 }; 3]);
        write_png(&sandbox.path(&format!("{name}.png")), &picture).unwrap();
    }
    sandbox.done("score --reference ref.png --image mine.png --html page.html");
    let page = sandbox.path("page.html");
    let mut browser = open_page(&page);
    settle(&mut browser);
    assert_eq!(browser.read("article h2"), "mine.png against ref.png");
    let chosen =
        "['left', 'right'].map(side => $(`[name=${side}]`).selectedOptions[0].text).join()";
    assert_eq!(browser.text(chosen), "ref.png,mine.png");
    let slide = browser.picture(".stack");
    press(&mut browser, "[");
    assert!(browser.picture(".stack") != slide, "the divider moves");
    press(&mut browser, "2");
    assert_eq!(browser.text("$('#viewer').dataset.mode"), "blink");
    press(&mut browser, "1");
    let maps = ["FLIP", "Signed error"].map(|_| {
        press(&mut browser, "m");
        browser.text("$('[name=right]').selectedOptions[0].text")
    });
    assert_eq!(maps, ["FLIP", "Signed error"]);
    press(&mut browser, "w");
    // The pictures differ in six columns, and no motion or depth is known to read there.
    browser.value("$('.stack').focus()");
    press(&mut browser, "ArrowRight");
    let pixel = browser.read(".readout caption");
    assert!(pixel.starts_with("x 2"), "{pixel}");
    assert_eq!(browser.complaints(), [""; 0]);
    assert_eq!(browser.requests(), [address_of(&page)]);
}

#[test]
fn a_tuning_fits_the_screen_and_marks_unbeaten_candidates() {
    let sandbox = Sandbox::two_scenes();
    let words = "tune search --quiet --filter jump_flood --from paper --vary samples=2..16,jitter --objective flip,bleed --scenes plate,slow \
                 --size 64x32 --samples-per-pixel 16 --budget 8 --out tuned";
    sandbox.done(words);
    sandbox.done("report tuned --html page.html");
    let page = sandbox.path("page.html");
    let mut browser = Browser::new(390, 844);
    browser.open(&page, "");
    assert_eq!(browser.value("document.documentElement.scrollWidth"), 390);
    // No blue mark of the chart has another mark to the left and below, or next to it.
    let beaten = "(() => { const marks = [...$$('.drawings svg')[0].querySelectorAll('circle:not(.ring)')]; \
                  const at = mark => [mark.cx.baseVal.value, -mark.cy.baseVal.value]; \
                  const blue = marks.filter(mark => !mark.classList.contains('faint')); \
                  return [blue.length, blue.filter(mark => marks.some(other => at(other)[0] < at(mark)[0] - 0.05 && at(other)[1] < at(mark)[1] - 0.05)).length]; })()";
    let counts = browser.value(beaten);
    assert!(counts[0].as_u64().unwrap() > 0, "{counts}");
    assert_eq!(counts[1], 0);
    assert_eq!(browser.complaints(), [""; 0]);
}

#[test]
fn a_sequence_plays_in_step_and_goes_frame_by_frame() {
    let sandbox = Sandbox::new();
    sandbox.measure(&format!("{GATHER} --frames 3"));
    let page = sandbox.path("out/sequences.html");
    let mut browser = Browser::new(1280, 900);
    // The last sequence is the filter's.
    let last = sandbox.read_run().sequences.len() - 1;
    browser.open(&page, &format!("#{last}"));
    let loaded = "$$('#pictures img:not([hidden])').every(image => image.complete && image.naturalWidth === 64)";
    browser.until(loaded);
    let addresses = |browser: &mut Browser| {
        browser.text("$$('#pictures img:not([hidden])').map(image => image.src).join(' ')")
    };
    // The first frame has no change.
    assert_eq!(addresses(&mut browser).split(' ').count(), 4);
    browser.press(".");
    browser.until(loaded);
    let second = addresses(&mut browser);
    assert_eq!(second.matches("/plate/0001/").count(), 5, "{second}");
    let picture = "0001/velocity_gather_fine/change.png";
    assert!(second.contains(picture), "{second}");
    let readout = browser.read("#readout");
    assert!(readout.starts_with("frame 1 of 2; error "), "{readout}");
    browser.press(",");
    browser.press(",");
    assert_eq!(browser.text("document.body.dataset.frame"), "2");
    browser.press("[");
    let chosen = browser.value("Number(document.getElementById('sequence').value)");
    assert_eq!(chosen, last as u64 - 1);
    let before = browser.text("document.body.dataset.frame");
    browser.press("3");
    browser.press(" ");
    browser.until(&format!("document.body.dataset.frame !== '{before}'"));
    let play = "document.getElementById('play').textContent";
    assert_eq!(browser.text(play), "Stop");
    browser.press(" ");
    assert_eq!(browser.text(play), "Play");
    assert_eq!(browser.complaints(), [""; 0]);
    assert_eq!(browser.value("document.documentElement.scrollWidth"), 1280);
}
