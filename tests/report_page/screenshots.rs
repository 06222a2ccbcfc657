//! Pictures of pages as users see them, on three widths, in light and dark, and in print: `cargo
//! run --package shuttertruth --example report_screenshots -- FOLDER out/report.html
//! 'out/report.html#fan/bevy:high'`.

#[expect(dead_code, reason = "the tests of pages need more of it")]
mod browser;

use std::fs;
use std::path::{Path, PathBuf};

use browser::Browser;

/// Screens in pixels: a monitor, a small window, a phone.
const SCREENS: [(u32, u32); 3] = [(1440, 900), (800, 900), (390, 844)];
/// Upper limit on the height of a picture, in screens.
const SCREENFULS: f64 = 3.0;

fn main() {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().map(PathBuf::from);
    let folder = folder.expect("a folder for the pictures, then pages");
    fs::create_dir_all(&folder).expect("a folder that can be written");
    for page in arguments {
        let (path, part) = match page.split_once('#') {
            Some((path, part)) => (path, format!("#{part}")),
            None => (page.as_str(), String::new()),
        };
        let path = Path::new(path).canonicalize().expect("a page at that path");
        show(&path, &part, &folder);
    }
}

/// Takes every picture of one page.
fn show(page: &Path, part: &str, folder: &Path) {
    let stem = page.file_stem().unwrap_or_default().to_string_lossy();
    let name = format!("{stem}{part}").replace(|letter: char| !letter.is_alphanumeric(), "_");
    for (width, height) in SCREENS {
        let mut browser = Browser::new(width, height);
        for scheme in ["light", "dark"] {
            browser.prefer(scheme);
            browser.open(page, part);
            browser.until("!$('#viewer:not([hidden])') || $('#viewer').dataset.drawn === $('#viewer').dataset.asked");
            browser
                .value("new Promise(done => requestAnimationFrame(() => setTimeout(done, 300)))");
            let most = SCREENFULS * f64::from(height);
            let file = folder.join(format!("{name}_{width}_{scheme}.png"));
            fs::write(&file, browser.picture_of_page(most)).expect("a picture that can be written");
            println!("{}", file.display());
        }
        if width == SCREENS[0].0 {
            browser.prefer("light");
            let file = folder.join(format!("{name}.pdf"));
            fs::write(&file, browser.paper()).expect("a file that can be written");
            println!("{}", file.display());
        }
    }
}
