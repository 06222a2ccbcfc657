//! The site that `make site` builds: its links, and its pages in a browser.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use walkdir::WalkDir;

use crate::browser::{Browser, address_of};
use crate::live::{LIVE, open_panel};

/// Screens in pixels: a monitor, a small window, a phone.
const SCREENS: [(u32, u32); 3] = [(1440, 900), (800, 900), (390, 844)];

/// Lists the pages below a folder.
fn find_pages(folder: &Path) -> Vec<PathBuf> {
    let files = WalkDir::new(folder).sort_by_file_name().into_iter();
    let paths = files.map(|entry| entry.unwrap().into_path());
    let is_page = |path: &PathBuf| path.extension().is_some_and(|end| end == "html");
    paths.filter(is_page).collect()
}

/// Finds the values of an attribute in the tags of a page.
fn attributes<'t>(text: &'t str, name: &str) -> Vec<&'t str> {
    let tags = text.split('<').skip(1);
    let tags = tags.filter_map(|rest| rest.split('>').next());
    let start = format!(" {name}=\"");
    let values = tags.filter_map(|tag| tag.split_once(&start));
    values
        .filter_map(|(_, rest)| rest.split('"').next())
        .collect()
}

/// Lists the links of all pages below a folder that lead to no file, or to no place on its page;
/// counts all links.
fn find_dead_links(folder: &Path) -> (Vec<String>, usize) {
    let read = |path: PathBuf| {
        (
            path.canonicalize().unwrap(),
            fs::read_to_string(&path).unwrap(),
        )
    };
    let pages: BTreeMap<_, _> = find_pages(folder).into_iter().map(read).collect();
    let places: BTreeMap<&PathBuf, BTreeSet<&str>> = pages
        .iter()
        .map(|(path, text)| (path, attributes(text, "id").into_iter().collect()))
        .collect();
    let (mut dead, mut count) = (Vec::new(), 0);
    for (page, text) in &pages {
        for link in ["href", "src"].map(|name| attributes(text, name)).concat() {
            if link.contains("://") || link.starts_with("data:") {
                continue;
            }
            count += 1;
            let (file, place) = link.split_once('#').unwrap_or((link, ""));
            let target = match file {
                "" => Ok(page.clone()),
                file => page.parent().unwrap().join(file).canonicalize(),
            };
            let leads = target.is_ok_and(|target| {
                let has_place = || places.get(&target).is_none_or(|ids| ids.contains(place));
                target.is_file() && (place.is_empty() || has_place())
            });
            if !leads {
                dead.push(format!("{}: {link}", page.display()));
            }
        }
    }
    (dead, count)
}

#[test]
fn dead_links_are_found() {
    let folder = tempfile::tempdir().unwrap();
    let put = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    put(
        "a.html",
        "<h1 id=\"top\"><a href=\"b.html#here\"><a href=\"#top\"><p>&lt;a href=\"text\"&gt; <a class=\"x\" href=\"https://a.b/c\">",
    );
    put("b.html", "<p id=\"here\"><img src=\"c.png\">");
    put("c.png", "");
    assert_eq!(find_dead_links(folder.path()), (Vec::new(), 3));
    put(
        "b.html",
        "<p id=\"there\"><a href=\"d.html\"><img alt=\"\" src=\"missing.png\"><a href=\".\">",
    );
    let (dead, _) = find_dead_links(folder.path());
    let complaints: Vec<&str> = dead
        .iter()
        .map(|complaint| complaint.rsplit('/').next().unwrap())
        .collect();
    let due = [
        "a.html: b.html#here",
        "b.html: d.html",
        "b.html: .",
        "b.html: missing.png",
    ];
    assert_eq!(complaints, due);
}

#[test]
#[ignore = "prove: every page of the site, which `make site` builds"]
fn the_site_opens_on_every_screen_without_complaint() {
    let site = Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("site");
    assert!(site.is_dir(), "no site there; make site");
    let (dead, count) = find_dead_links(&site);
    assert_eq!(dead, [""; 0]);
    assert!(count > 1000, "only {count} links were found");
    let first = site.join("index.html");
    let mut browser = Browser::new(1440, 900);
    browser.open(&first, "");
    let start = address_of(&site);
    let size = |url: &String| {
        let name = url.strip_prefix(&start).expect("a file of the site");
        fs::metadata(site.join(name.trim_start_matches('/')))
            .unwrap()
            .len()
    };
    let loaded: BTreeSet<String> = browser.requests().into_iter().collect();
    let bytes: u64 = loaded.iter().map(size).sum();
    assert!(
        loaded.len() > 5 && bytes < 1_000_000,
        "{bytes} bytes: {loaded:?}"
    );
    println!("the first page loads {bytes} bytes");
    for entry in fs::read_dir(site.join("live/report_files")).unwrap() {
        let file = entry.unwrap();
        let is_scene = file.file_name().to_str().unwrap().starts_with("live_scene");
        assert!(
            !is_scene || file.metadata().unwrap().len() < 2_000_000,
            "{file:?}"
        );
    }
    let mut folders = BTreeSet::new();
    for page in find_pages(&site) {
        // Most pages of a folder are alike: the first opens on every screen, the others on the
        // narrowest.
        let is_first = folders.insert(page.parent().map(Path::to_owned));
        let is_own = page.ends_with("index.html") || page.ends_with("report.html");
        for (width, height) in &SCREENS[if is_first || is_own { 0 } else { 2 }..] {
            browser.resize(*width, *height);
            for scheme in ["dark", "light"] {
                browser.prefer(scheme);
                browser.open(&page, "");
                let wide = browser.value("document.documentElement.scrollWidth");
                let is_narrow = wide.as_u64() <= Some((*width).into());
                assert!(is_narrow, "{}: {wide} of {width} pixels", page.display());
            }
        }
        assert_eq!(browser.complaints(), [""; 0], "{}", page.display());
    }
    the_tables_sort(&mut browser, &site);
    the_search_finds(&mut browser, &first);
    let live = site.join("live/report.html");
    open_panel(&mut browser, &live, "fan/kino:default");
    assert_eq!(browser.text(&format!("{LIVE}.dataset.version")), "1");
    assert_eq!(browser.complaints(), [""; 0]);
}

fn the_tables_sort(browser: &mut Browser, site: &Path) {
    browser.open(&site.join("results/README.html"), "");
    // The tables are the engines', and one per shutter.
    let table = "$$('.sortable')[1]";
    let mut press = |title: &str| {
        let heading = format!(
            "[...{table}.tHead.rows[0].cells].find(cell => cell.textContent === '{title}')"
        );
        browser.value(&format!("{heading}.firstChild.click()"));
        browser.text(&format!(
            "{heading}.ariaSort + ': ' + {table}.tBodies[0].rows[0].cells[1].textContent"
        ))
    };
    assert_eq!(press("FLIP (95 % CI)"), "ascending: jimenez:slides_2014");
    assert_eq!(press("FLIP (95 % CI)"), "descending: three:default");
    assert_eq!(press("preset"), "ascending: babylon_screen:default");
    assert_eq!(press("preset"), "descending: vort:default");
}

fn the_search_finds(browser: &mut Browser, page: &Path) {
    browser.open(page, "?search=vignette");
    browser.until(
        "$$('#mdbook-searchresults li').some(result => result.textContent.includes('Dagor'))",
    );
}
