//! Cases in a browser: picture pairs, links, blinking, zoom, the first screen, and paper.

use crate::browser::Browser;
use crate::sandbox::{Sandbox, assert_done};
use crate::{make_page, open_case, press, settle};

/// Makes a run of two filters with one shutter, and its page.
fn set_up() -> (Sandbox, std::path::PathBuf) {
    let sandbox = Sandbox::new();
    assert_done(&sandbox.run(&[
        "--filters",
        "identity,velocity_gather:fine,jump_flood:paper",
    ]));
    let page = make_page(&sandbox);
    (sandbox, page)
}

/// Returns the picture in a pane, as a data address.
fn canvas(browser: &mut Browser, place: &str) -> String {
    browser.text(&format!(
        "document.querySelector('[data-place={place}] canvas').toDataURL()"
    ))
}

fn pick(browser: &mut Browser, side: &str, picture: &str) {
    browser.value(&format!(
        "(() => {{ const menu = document.querySelector('[name={side}]'); menu.value = '{picture}'; \
         menu.dispatchEvent(new Event('change')); }})()"
    ));
    settle(browser);
}

#[test]
fn any_filter_can_be_compared_with_any_other() {
    let (_bench, page) = set_up();
    let mut browser = Browser::new(1280, 900);
    open_case(&mut browser, &page, "plate/identity:default");
    let own = canvas(&mut browser, "under");
    open_case(&mut browser, &page, "plate/velocity_gather:fine");
    let gathered = canvas(&mut browser, "under");
    assert!(own != gathered);
    // The case of a third filter shows both, left and right.
    open_case(&mut browser, &page, "plate/jump_flood:paper");
    pick(&mut browser, "left", "identity:default");
    pick(&mut browser, "right", "velocity_gather:fine");
    assert_eq!(canvas(&mut browser, "over"), own);
    assert_eq!(canvas(&mut browser, "under"), gathered);
    let tags = "[...document.querySelectorAll('.stack .tag')].map(tag => tag.textContent).join()";
    assert_eq!(browser.text(tags), "velocity_gather:fine,identity:default");
    pick(&mut browser, "right", "identity:default");
    let same = canvas(&mut browser, "under");
    assert_eq!(same, own);
    // A picture does not differ from itself; the instant differs from the truth.
    press(&mut browser, "5");
    let colors = "(() => { const own = document.querySelector('[data-place=under] canvas'); \
                  const copy = new OffscreenCanvas(own.width, own.height).getContext('2d'); copy.drawImage(own, 0, 0); \
                  return new Set(new Uint32Array(copy.getImageData(0, 0, own.width, own.height).data.buffer)).size; })()";
    assert_eq!(browser.value(colors), 1);
    pick(&mut browser, "left", "truth");
    assert!(browser.value(colors).as_u64().unwrap() > 1);
    for picture in [
        "instant",
        "scatter_oracle@trailing",
        "accumulate:16@trailing",
        "flip",
    ] {
        pick(&mut browser, "left", picture);
        let shown = browser.text("document.querySelector('[name=left]').value");
        assert_eq!(shown, picture);
    }
    assert_eq!(browser.complaints(), [""; 0]);
}

#[test]
fn a_link_opens_the_same_view() {
    let (_bench, page) = set_up();
    let mut browser = Browser::new(1280, 900);
    open_case(&mut browser, &page, "plate/velocity_gather:fine");
    pick(&mut browser, "left", "identity:default");
    pick(&mut browser, "right", "flip");
    press(&mut browser, "4");
    press(&mut browser, "w");
    browser.until("/&left=identity:default&right=flip&mode=side&zoom=6&at=[0-9]+,[0-9]+$/.test(location.hash)");
    let link = browser.text("location.hash");
    assert!(link.starts_with("#plate/velocity_gather:fine&"), "{link}");
    let views = |browser: &mut Browser| {
        ["left", "right"].map(|place| {
            let transform =
                format!("document.querySelector('[data-place={place}]').style.transform");
            (canvas(browser, place), browser.text(&transform))
        })
    };
    let before = views(&mut browser);
    browser.open(&page, "");
    open_case(&mut browser, &page, &link[1..]);
    let after = views(&mut browser);
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
    assert_eq!(browser.complaints(), [""; 0]);
}

#[test]
fn blink_goes_on_until_it_is_stopped() {
    let (_bench, page) = set_up();
    let mut browser = Browser::new(1280, 900);
    open_case(&mut browser, &page, "plate/velocity_gather:fine");
    let swapped = "document.getElementById('viewer').hasAttribute('data-swapped')";
    press(&mut browser, "b");
    browser.until(swapped);
    browser.until(&format!("!{swapped}"));
    browser.until(swapped);
    press(&mut browser, "b");
    let stands = browser.value(swapped);
    browser.until("new Promise(done => setTimeout(() => done(true), 1600))");
    assert_eq!(browser.value(swapped), stands);
    press(&mut browser, "b");
    assert_ne!(
        browser.value(swapped),
        stands,
        "a stopped blink changes by hand"
    );
    assert_eq!(browser.complaints(), [""; 0]);
}

#[test]
fn wheel_and_worst_place_zoom_and_the_zoom_is_shown() {
    let (_bench, page) = set_up();
    let mut browser = Browser::new(1280, 900);
    open_case(&mut browser, &page, "plate/identity:default");
    let zoom = "document.querySelector('.zoom').textContent";
    assert_eq!(browser.text(zoom), "1×");
    let [left, top, width, height] = browser.place(".stack");
    browser.turn_wheel(left + width / 3.0, top + height / 2.0, -100.0);
    browser.until(&format!("{zoom} === '1.3×'"));
    press(&mut browser, "w");
    assert_eq!(browser.text(zoom), "6×");
    let worst = browser.text("document.querySelector('article.open .viewer_place').dataset.worst");
    browser.until(&format!(
        "document.querySelector('.readout').dataset.pixel === '{worst}'"
    ));
    press(&mut browser, "0");
    assert_eq!(browser.text(zoom), "1×");
    // The read-out floats beside the pointer.
    browser.point(left + width / 2.0, top + height / 2.0);
    browser.until("document.querySelector('.tip').textContent.includes('identity:default: ')");
    let [x, y, ..] = browser.place(".tip");
    assert!(
        (x - left - width / 2.0).abs() < 40.0 && (y - top - height / 2.0).abs() < 40.0,
        "{x} {y}"
    );
    assert_eq!(browser.complaints(), [""; 0]);
}

#[test]
fn score_and_picture_are_on_the_first_screen() {
    let (_bench, page) = set_up();
    let mut browser = Browser::new(1440, 900);
    for (width, height) in [(1440, 900), (800, 600), (390, 844)] {
        browser.resize(width, height);
        open_case(&mut browser, &page, "plate/velocity_gather:fine");
        let [_, score, ..] = browser.place("article.open .score");
        let [_, top, _, tall] = browser.place(".stack");
        let [_, controls, ..] = browser.place("#viewer .toolbar");
        assert!(
            score < top && top + tall <= f64::from(height),
            "{width}x{height}: {top} {tall}"
        );
        assert!(tall >= f64::from(height) / 5.0, "{width}x{height}: {tall}");
        assert_eq!(
            controls > top,
            width == 390,
            "a narrow screen has the picture first"
        );
    }
}

#[test]
fn printed_pages_show_both_pictures_whole() {
    let (_bench, page) = set_up();
    let mut browser = Browser::new(1000, 900);
    open_case(
        &mut browser,
        &page,
        "plate/velocity_gather:fine&zoom=8&at=10,10",
    );
    browser.print();
    let [over, under] =
        ["over", "under"].map(|place| browser.place(&format!("[data-place={place}] canvas")));
    let [_, _, width, height] = over;
    assert!(
        (width / height - 2.0).abs() < 0.01,
        "64x32 pixels: {width}x{height}"
    );
    assert!(
        width > 300.0 && over[0] + width <= under[0] && (over[1] - under[1]).abs() < 1.0,
        "{over:?} {under:?}"
    );
    assert_eq!(under[2..], over[2..]);
    let clip = browser.text("getComputedStyle(document.querySelector('.over')).clipPath");
    assert_eq!(clip, "none");
    assert_eq!(
        browser.value("document.querySelector('#viewer .toolbar').checkVisibility()"),
        false
    );
}

#[test]
fn an_address_that_names_another_section_is_left_alone() {
    let sandbox = Sandbox::two_scenes();
    assert_done(&sandbox.run(&["--filters", "identity"]));
    let page = make_page(&sandbox);
    let mut browser = Browser::new(1280, 900);
    open_case(&mut browser, &page, "plate/identity:default");
    // As between a click on a link and the event that follows it.
    browser.value("window.shuttertruth.note(); history.pushState(null, '', '#overview')");
    browser.value("new Promise(done => setTimeout(done, 400))");
    assert_eq!(browser.text("location.hash"), "#overview");
}
