//! Cases in a browser: picture pairs, links, blinking, zoom, the first screen, and paper.

use std::path::Path;

use crate::browser::Browser;
use crate::sandbox::split;
use crate::{Check, make_page, measure, open_case, open_page, press, run_checks, settle};

/// Returns the picture in a pane, as a data address.
fn canvas(browser: &mut Browser, place: &str) -> String {
    browser.text(&format!("$('[data-place={place}] canvas').toDataURL()"))
}

fn pick(browser: &mut Browser, side: &str, picture: &str) {
    browser.value(&format!(
        "(() => {{ const menu = $('[name={side}]'); menu.value = '{picture}'; \
         menu.dispatchEvent(new Event('change')); }})()"
    ));
    settle(browser);
}

#[test]
fn the_viewer_shows_what_keys_pointer_and_links_ask_for() {
    let sandbox = measure("identity,velocity_gather:fine,jump_flood:paper,bevy:high");
    let checks: [Check; 9] = [
        any_filter_can_be_compared_with_any_other,
        a_link_opens_the_same_view,
        blink_goes_on_until_it_is_stopped,
        wheel_and_worst_place_zoom_and_the_zoom_is_shown,
        divider_and_keys_change_the_shown_pictures,
        headings_sort_both_ways,
        rows_of_one_shutter_stay_together_when_headings_sort,
        score_and_picture_are_on_the_first_screen,
        printed_pages_show_both_pictures_whole,
    ];
    let page = make_page(&sandbox);
    run_checks(&mut open_page(&page), &page, &checks);
}

fn any_filter_can_be_compared_with_any_other(browser: &mut Browser, page: &Path) {
    open_case(browser, page, "plate/identity:default");
    let identity = canvas(browser, "under");
    open_case(browser, page, "plate/velocity_gather:fine");
    let gathered = canvas(browser, "under");
    assert!(identity != gathered);
    // The case of a third filter shows both, left and right.
    open_case(browser, page, "plate/jump_flood:paper");
    pick(browser, "left", "identity:default");
    pick(browser, "right", "velocity_gather:fine");
    assert_eq!(canvas(browser, "over"), identity);
    assert_eq!(canvas(browser, "under"), gathered);
    let tags = "$$('.stack .tag').map(tag => tag.textContent).join()";
    assert_eq!(browser.text(tags), "velocity_gather:fine,identity:default");
    pick(browser, "right", "identity:default");
    assert_eq!(canvas(browser, "under"), identity);
    // A picture does not differ from itself; the instant differs from the truth.
    press(browser, "5");
    let colors = "(() => { const canvas = $('[data-place=under] canvas'); \
                  const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d'); copy.drawImage(canvas, 0, 0); \
                  return new Set(new Uint32Array(copy.getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size; })()";
    assert_eq!(browser.value(colors), 1);
    pick(browser, "left", "truth");
    assert!(browser.value(colors).as_u64().unwrap() > 1);
    for picture in split("instant scatter_oracle@trailing accumulate:16@trailing flip") {
        pick(browser, "left", picture);
        let shown = browser.text("$('[name=left]').value");
        assert_eq!(shown, picture);
    }
}

fn a_link_opens_the_same_view(browser: &mut Browser, page: &Path) {
    open_case(browser, page, "plate/velocity_gather:fine");
    pick(browser, "left", "identity:default");
    pick(browser, "right", "flip");
    press(browser, "4");
    press(browser, "w");
    browser.until("/&left=identity:default&right=flip&mode=side&zoom=6&at=[0-9]+,[0-9]+$/.test(location.hash)");
    let link = browser.text("location.hash");
    assert!(link.starts_with("#plate/velocity_gather:fine&"), "{link}");
    let views = |browser: &mut Browser| {
        ["left", "right"].map(|place| {
            let transform = format!("$('[data-place={place}]').style.transform");
            (canvas(browser, place), browser.text(&transform))
        })
    };
    let before = views(browser);
    browser.open(page, "");
    open_case(browser, page, &link[1..]);
    let after = views(browser);
    assert_eq!(after[0].0, before[0].0);
    assert_eq!(after[1].0, before[1].0);
    // The address has whole pixels.
    let numbers = |view: &str| -> Vec<f64> {
        let words = view.split(|c: char| !c.is_ascii_digit() && c != '.' && c != '-');
        words.filter_map(|word| word.parse().ok()).collect()
    };
    for (before, after) in numbers(&before[0].1).iter().zip(numbers(&after[0].1)) {
        assert!((before - after).abs() <= 1.0, "{before} {after}");
    }
}

fn blink_goes_on_until_it_is_stopped(browser: &mut Browser, page: &Path) {
    open_case(browser, page, "plate/velocity_gather:fine");
    let swapped = "document.getElementById('viewer').hasAttribute('data-swapped')";
    // Faster than for a person.
    browser
        .value("const usual = setInterval; setInterval = (swap, wait) => usual(swap, wait / 20)");
    press(browser, "b");
    browser.until(swapped);
    browser.until(&format!("!{swapped}"));
    browser.until(swapped);
    press(browser, "b");
    let stands = browser.value(swapped);
    browser.until("new Promise(done => setTimeout(() => done(true), 100))");
    assert_eq!(browser.value(swapped), stands);
    press(browser, "b");
    let now = browser.value(swapped);
    assert_ne!(now, stands, "a stopped blink changes by hand");
}

fn wheel_and_worst_place_zoom_and_the_zoom_is_shown(browser: &mut Browser, page: &Path) {
    open_case(browser, page, "plate/identity:default");
    let zoom = "$('.zoom').textContent";
    assert_eq!(browser.text(zoom), "1×");
    let [left, top, width, height] = browser.place(".stack");
    browser.turn_wheel(left + width / 3.0, top + height / 2.0, -100.0);
    browser.until(&format!("{zoom} === '1.3×'"));
    press(browser, "w");
    assert_eq!(browser.text(zoom), "6×");
    let worst = browser.text("$('article.open .viewer_place').dataset.worst");
    browser.until(&format!("$('.readout').dataset.pixel === '{worst}'"));
    press(browser, "0");
    assert_eq!(browser.text(zoom), "1×");
    // The read-out floats next to the pointer.
    browser.point(left + width / 2.0, top + height / 2.0);
    browser.until("$('.tip').textContent.includes('identity:default: ')");
    let [x, y, ..] = browser.place(".tip");
    let off = [x - left - width / 2.0, y - top - height / 2.0];
    assert!(off.iter().all(|off| off.abs() < 40.0), "{x} {y}");
}

fn divider_and_keys_change_the_shown_pictures(browser: &mut Browser, page: &Path) {
    const STAGE: &str = ".stage";
    open_case(browser, page, "plate/velocity_gather:fine");
    let first = browser.picture(STAGE);
    assert!(first == browser.picture(STAGE), "nothing was pressed");

    let [left, top, width, height] = browser.place(".stack");
    let [middle, row] = [left + width / 2.0, top + height / 2.0];
    browser.drag([middle, row], [left + 0.9 * width, row]);
    let split_at = browser.value("$('[name=split]').value");
    assert_eq!(split_at, "90");
    let mut seen = vec![first, browser.picture(STAGE)];
    for key in split("3 4 1 a m m e 5 1 + [ w ArrowRight x") {
        if key == "ArrowRight" {
            browser.value("$('.stack').focus()");
        }
        press(browser, key);
        let now = browser.picture(STAGE);
        assert!(seen.last() != Some(&now), "{key} changes nothing");
        seen.push(now);
    }
    press(browser, "?");
    assert_eq!(browser.value("document.getElementById('keys').open"), true);
    browser.value("document.getElementById('keys').close()");

    browser.value("location.hash = '#overview'");
    browser.until("$('#overview').checkVisibility()");
    assert!(!browser.shows("#viewer"));
}

fn headings_sort_both_ways(browser: &mut Browser, _: &Path) {
    let column = |browser: &mut Browser, press: bool| -> Vec<f64> {
        if press {
            browser
                .value("$$('.sortable')[0].tHead.rows[0].cells[1].querySelector('button').click()");
        }
        let values = browser.value(
            "[...$('.sortable tbody:not(.group)').rows].map(row => Number(row.cells[1].dataset.value))",
        );
        serde_json::from_value(values).unwrap()
    };
    let before = column(browser, false);
    assert!(before.is_sorted(), "the best comes first: {before:?}");
    let rising = column(browser, true);
    assert_eq!(rising, before);
    let falling = column(browser, true);
    assert!(falling.iter().rev().is_sorted(), "{falling:?}");
}

fn rows_of_one_shutter_stay_together_when_headings_sort(browser: &mut Browser, _: &Path) {
    let names = |browser: &mut Browser| {
        let rows = browser.text(
            "[...$('.sortable').tBodies].map(group => [...group.rows].map(row => \
             row.cells[0].textContent).sort().join(', ')).join('; ')",
        );
        rows.split("; ").map(str::to_owned).collect::<Vec<_>>()
    };
    let before = names(browser);
    assert_eq!(before.len(), 4, "{before:?}");
    let headings = [&before[0], &before[2]];
    assert_eq!(headings, ["trailing shutter", "centred shutter"]);
    assert!(before[1].contains("velocity_gather:fine") && before[3].contains("bevy:high"));
    browser.value("$('.sortable').tHead.rows[0].cells[1].querySelector('button').click()");
    assert_eq!(names(browser), before);
}

fn score_and_picture_are_on_the_first_screen(browser: &mut Browser, page: &Path) {
    for (width, height) in [(1440, 900), (800, 600), (390, 844)] {
        browser.resize(width, height);
        open_case(browser, page, "plate/velocity_gather:fine");
        let [_, score, ..] = browser.place("article.open .score");
        let [_, top, _, tall] = browser.place(".stack");
        let [_, controls, ..] = browser.place("#viewer .toolbar");
        assert!(
            score < top && top + tall <= f64::from(height),
            "{width}x{height}: {top} {tall}"
        );
        assert!(tall >= f64::from(height) / 5.0, "{width}x{height}: {tall}");
        // A narrow screen has the picture first.
        assert_eq!(controls > top, width == 390, "{width}x{height}");
    }
}

fn printed_pages_show_both_pictures_whole(browser: &mut Browser, page: &Path) {
    browser.resize(1000, 900);
    open_case(browser, page, "plate/velocity_gather:fine&zoom=8&at=10,10");
    browser.print();
    let [over, under] =
        ["over", "under"].map(|place| browser.place(&format!("[data-place={place}] canvas")));
    let [_, _, width, height] = over;
    assert!((width / height - 2.0).abs() < 0.01, "{width}x{height}");
    assert!(
        width > 300.0 && over[0] + width <= under[0] && (over[1] - under[1]).abs() < 1.0,
        "{over:?} {under:?}"
    );
    assert_eq!(under[2..], over[2..]);
    let clip = browser.text("getComputedStyle($('.over')).clipPath");
    assert_eq!(clip, "none");
    assert!(!browser.shows("#viewer .toolbar"));
}
