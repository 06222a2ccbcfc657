//! Live cases: filters that the page itself runs, in a real browser, against the program.

use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};

use bench::Bench;
use frame::{Image, Raster};
use measure::Case;
use metrics::Metric;
use serde_json::{Value, json};
use tests::filter_folder::copy_folder;
use tests::text::assert_contains;

use crate::browser::Browser;
use crate::sandbox::{SCENE, Sandbox};
use crate::{make_page, open_case};

/// Place of the open case's panel.
pub const LIVE: &str = "document.querySelector('article.open .live')";

/// Largest difference of a pixel, and of a score of FLIP, between the browser's shader compiler and
/// the program's.
const APART: f32 = 1e-3;
/// Part of the pixels that may differ by more: a tap that falls on the border of two texels.
const APART_PIXELS: f32 = 1e-3;

/// Opens the panel of a case. Waits for its first picture, or the reason why there is none.
pub fn open_panel(browser: &mut Browser, page: &Path, case: &str) {
    open_case(browser, page, case);
    browser.click("article.open .live button");
    browser.until(&format!(
        "{LIVE}.dataset.version === '1' || !['Loading ..', ''].includes({LIVE}.querySelector('.said').textContent)"
    ));
}

/// Serves the folder of a page at 127.0.0.1, where a browser loads files by other rules; returns
/// the page's address.
fn serve(page: &Path) -> PathBuf {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap();
    let folder = page.parent().unwrap().to_owned();
    // A browser may open a connection and not use it.
    let answer = |mut stream: TcpStream, folder: PathBuf| {
        let mut first = String::new();
        BufReader::new(&stream).read_line(&mut first)?;
        let path = first.split(' ').nth(1).unwrap_or("/");
        let path = folder.join(path[1..].replace("%20", " "));
        let is_script = path.extension().is_some_and(|ending| ending == "js");
        let kind = ["text/html", "text/javascript"][usize::from(is_script)];
        let body = fs::read(path)?;
        let head = format!(
            "HTTP/1.1 200 OK\r\nContent-Type: {kind}\r\nContent-Length: {}\r\nConnection: close\r\n\r\n",
            body.len()
        );
        stream.write_all(&[head.into_bytes(), body].concat())
    };
    std::thread::spawn(move || {
        for stream in listener.incoming().flatten() {
            let folder = folder.clone();
            std::thread::spawn(move || answer(stream, folder));
        }
    });
    let name = page.file_name().unwrap().to_str().unwrap();
    PathBuf::from(format!("http://{address}/{name}"))
}

/// Changes the panel by a script, and waits for the next picture.
fn change(browser: &mut Browser, script: &str) {
    let version = browser.text(&format!("{LIVE}.dataset.version"));
    browser.value(script);
    browser.until(&format!("{LIVE}.dataset.version !== '{version}'"));
}

/// Reads a score of the picture, from its data.
fn read_score(browser: &mut Browser, name: &str) -> f64 {
    let text = browser.text(&format!("{LIVE}.dataset.{name}"));
    text.parse().unwrap()
}

/// Reads the live picture.
fn read_picture(browser: &mut Browser, (width, height): (u32, u32)) -> Image {
    let planes = browser.value(
        "window.shuttertruth.planes([-1, -2, -3]).then(planes => planes.map(plane => [...plane]))",
    );
    let part = |at: usize| -> Vec<f32> { serde_json::from_value(planes[at].clone()).unwrap() };
    let [red, green, blue] = [0, 1, 2].map(part);
    Raster::from_fn(width, height, |x, y| {
        let at = (y * width + x) as usize;
        [red[at], green[at], blue[at]]
    })
}

/// Finds the largest difference of each pixel.
fn find_apart(live: &Image, stored: &Image) -> Vec<f32> {
    let pairs = live.pixels.iter().zip(&stored.pixels);
    let differ = |(live, stored): (&[f32; 3], &[f32; 3])| {
        let parts = live.iter().zip(stored).map(|(a, b)| (a - b).abs());
        parts.fold(0.0, f32::max)
    };
    pairs.map(differ).collect()
}

/// Counts the part of the pixels that differ by more than [`APART`].
fn count_apart(apart: &[f32]) -> f32 {
    let count = apart.iter().filter(|apart| **apart > APART).count();
    count as f32 / apart.len() as f32
}

/// Presets, or filters, that magnify the last bits of a number, in which adapters differ; each with
/// what it does.
const MAGNIFYING: [(&str, &str); 2] = [
    ("dagor:", "rounds the direction of motion to seven bits"),
    ("mcguire:motion_blur_demo", "has sines of large numbers"),
];

/// Differences of the open panel from a case.
#[derive(Debug)]
struct Differences {
    /// Largest difference of a pixel.
    pixel: f32,
    /// Part of the pixels that differ by more than [`APART`].
    share: f32,
    flip: f64,
    psnr: f64,
}

impl Differences {
    /// Returns whether the page shows the same picture and scores as the program. 0.05 dB are 1 %
    /// of the squared error: the page's truth has three digits.
    fn are_small(&self, name: &str) -> bool {
        if MAGNIFYING.iter().any(|(start, _)| name.starts_with(start)) {
            // At most 4.1 % of the pixels differed on five scenes, and FLIP by 0.0082.
            return self.share <= 0.05 && self.flip <= 0.01;
        }
        self.share <= APART_PIXELS && self.flip <= f64::from(APART) && self.psnr <= 0.05
    }
}

/// Compares the open panel's picture and scores with those of a case.
fn compare(browser: &mut Browser, sandbox: &Sandbox, out: &str, case: &Case) -> Differences {
    let stored = sandbox.read_color(&format!("{out}/{}/output.exr", case.folder.display()));
    let live = read_picture(browser, (stored.width, stored.height));
    let apart = find_apart(&live, &stored);
    let mut score = |metric, name| {
        let stored = case.measured(metric).value().unwrap();
        (read_score(browser, name) - stored).abs()
    };
    Differences {
        pixel: apart.iter().copied().fold(0.0, f32::max),
        share: count_apart(&apart),
        flip: score(Metric::FLIP, "flip"),
        psnr: score(Metric::PSNR, "psnr"),
    }
}

/// Finds a case by its name, `kino:default`.
fn find_case(sandbox: &Sandbox, name: &str) -> Case {
    let mut cases = sandbox.read_filter_cases().into_iter();
    cases.find(|case| case.name() == name).unwrap()
}

/// Measures filters that a page runs.
fn measure_live(sandbox: &Sandbox) {
    // Passes with textures of tiles; exchanged textures; the mask; an include; a vertex stage, a
    // sampler, halves and velocity in another unit.
    let held =
        "[object.held]\nmesh = \"plate.obj\"\nparent = \"camera\"\ntranslation = [0, -0.6, -2]\n";
    sandbox.write("scene.toml", &format!("{SCENE}\n{held}"));
    let body = "textureStore(output, pixel, textureLoad(color, pixel, 0) * (1.0 - textureLoad(exclusion, pixel, 0).x));";
    sandbox.write_kernel("masked", "", &["exclusion"], body);
    for name in ["unreal", "bevy"] {
        let folder = tests::root().join("examples/first_blur").join(name);
        copy_folder(&folder, &sandbox.path(&format!("{name}_blur")));
    }
    sandbox
        .measure("--filters kino:default,jump_flood:corrected,./masked,./unreal_blur,./bevy_blur");
}

#[test]
fn a_page_runs_filters_as_the_program_does() {
    let sandbox = Sandbox::once(measure_live);
    let page = make_page(&sandbox);
    let mut browser = Browser::new(1280, 900);
    for case in sandbox.read_filter_cases() {
        open_panel(&mut browser, &page, &format!("plate/{}", case.name()));
        let differences = compare(&mut browser, &sandbox, "out", &case);
        assert!(
            differences.are_small(&case.name()),
            "{}: {differences:?}",
            case.name()
        );
    }
    the_times_of_a_page_are_a_bench_of_the_program(&mut browser, &sandbox);
    a_translated_shader_can_be_changed_and_saved(&mut browser, &sandbox);
    // Left, it leaves nothing behind.
    browser.press("k");
    browser.until("!document.querySelector('.trying') && document.querySelector('[name=left]').value === 'truth'");
    assert_eq!(browser.complaints(), [""; 0]);
}

/// Clicks a button of the panel that saves a file; returns the file's path.
fn save(browser: &mut Browser, sandbox: &Sandbox, button: &str, file: &str) -> PathBuf {
    browser.save_to(&sandbox.path(""));
    browser.value(&format!(
        "[...document.querySelectorAll('.live button')].find(one => one.textContent === '{button}').click()"
    ));
    let path = sandbox.path(file);
    // The browser reserves the name by an empty file, and renames the whole one to it.
    while fs::metadata(&path).map_or(0, |metadata| metadata.len()) == 0 {
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    path
}

fn a_translated_shader_can_be_changed_and_saved(browser: &mut Browser, sandbox: &Sandbox) {
    let before = read_score(browser, "flip");
    change(browser, &edit("+ 0.5f", "+ 0.25f"));
    let tried = read_score(browser, "flip");
    assert_ne!(tried, before);
    let zip = save(browser, sandbox, "Download filter", "bevy_blur.zip");
    unpack(&fs::read(zip).unwrap(), &sandbox.path("saved"));
    sandbox.measure_into("again", "--filters ./saved/bevy_blur:tried");
    let run: measure::Run = sandbox.read_json("again/run.json");
    let case = run.cases.iter().find(|case| case.preset == "tried");
    let score = case.unwrap().measured(Metric::FLIP).value().unwrap();
    assert!((score - tried).abs() <= f64::from(APART), "{score} {tried}");
}

/// Writes a script that replaces a part of the shader in the panel.
fn edit(from: &str, to: &str) -> String {
    let [from, to] = [from, to].map(|text| json!(text));
    let shader = format!("{LIVE}.querySelector('textarea')");
    format!(
        "{shader}.value = {shader}.value.replace({from}, {to}); {shader}.dispatchEvent(new Event('input'))"
    )
}

fn the_times_of_a_page_are_a_bench_of_the_program(browser: &mut Browser, sandbox: &Sandbox) {
    let path = save(browser, sandbox, "Download bench.json", "bench.json");
    let mut bench = Bench::read(&path).unwrap();
    assert_eq!((bench.width, bench.height, bench.rounds), (64, 32, 64));
    assert_eq!(bench.scene.as_deref(), Some("plate"));
    assert_eq!(bench.cases.len(), 1);
    let case = &bench.cases[0];
    let shipped = find_case(sandbox, "bevy_blur:default");
    assert_eq!(case.preset, shipped.preset);
    assert_eq!(case.parameters, shipped.parameters);
    assert_eq!(case.passes.len(), 1);
    assert!(case.seconds.lower_quartile > 0.0, "{case:?}");
    let kept = sandbox.path("kept");
    let refused = bench.clone().keep(&kept).unwrap_err().to_string();
    assert_contains(&refused, &["is a processor; only times of graphics cards"]);
    // Times of another preset join those of the first.
    bench.adapter.kind = "other".to_owned();
    bench.adapter.name = "A Card (R)".to_owned();
    let first = bench.clone().keep(&kept).unwrap();
    assert!(first.ends_with("64x32_a_card_r_plate.json"), "{first:?}");
    bench.cases[0].preset = "later".to_owned();
    bench.clone().keep(&kept).unwrap();
    assert_eq!(bench.clone().keep(&kept).unwrap(), first);
    let presets = Bench::read(&first).unwrap().cases.into_iter();
    let presets: Vec<String> = presets.map(|case| case.preset).collect();
    assert_eq!(presets, [shipped.preset.clone(), "later".to_owned()]);
    bench.rounds = 20;
    let refused = bench.clone().keep(&kept).unwrap_err().to_string();
    assert_contains(
        &refused,
        &["holds times of 64 rounds on the scene plate", "not of 20"],
    );
    bench.format = 9;
    fs::write(&path, json!(bench).to_string()).unwrap();
    let refused = Bench::read(&path).unwrap_err().to_string();
    assert_contains(&refused, &["bench.json: has format 9; allowed: 1"]);
}

#[test]
#[ignore = "prove: parameters and frames that a reader changes; each test run compares what a page runs at first"]
fn what_a_reader_changes_is_what_the_program_measures() {
    let sandbox = Sandbox::new();
    sandbox.measure("--filters kino:default");
    let page = make_page(&sandbox);
    sandbox.measure_into("moved", "--filters kino:default --set kino.samples=4");
    let mut browser = Browser::new(1280, 900);
    open_panel(&mut browser, &serve(&page), "plate/kino:default");
    let field = format!("{LIVE}.querySelector('[type=number][aria-label^=\"samples\"]')");
    change(
        &mut browser,
        &format!("{field}.value = 4; {field}.dispatchEvent(new Event('change'))"),
    );
    let run: measure::Run = sandbox.read_json("moved/run.json");
    let moved = run.cases.iter().find(|case| case.filter == "kino");
    let differences = compare(&mut browser, &sandbox, "moved", moved.unwrap());
    assert!(differences.are_small("kino"), "{differences:?}");

    let before = read_score(&mut browser, "flip");
    browser.value(&edit("WINDOW - along", "WINDOW - alone"));
    browser.until(&format!("!!{LIVE}.querySelector('.errors button')"));
    let line = browser.text(&format!("{LIVE}.querySelector('pre .broken').textContent"));
    let kernels = fs::read_to_string(tests::root().join("shaders/kino/kino.wgsl")).unwrap();
    let is_changed = |text: &str| text.contains("WINDOW - along");
    let number = 1 + kernels.lines().position(is_changed).unwrap();
    assert_eq!(line.trim(), number.to_string());
    assert_eq!(read_score(&mut browser, "flip"), before);
    change(&mut browser, &edit("WINDOW - alone", "WINDOW + along"));
    let tried = read_score(&mut browser, "flip");
    assert_ne!(tried, before);

    let zip = save(&mut browser, &sandbox, "Download filter", "kino.zip");
    unpack(&fs::read(&zip).unwrap(), &sandbox.path(""));
    sandbox.measure("--filters ./kino:tried");
    let score = find_case(&sandbox, "kino:tried")
        .measured(Metric::FLIP)
        .value();
    assert!((score.unwrap() - tried).abs() <= f64::from(APART));
    assert_eq!(browser.complaints(), [""; 0]);
}

/// Unpacks a zip file of stored files.
fn unpack(mut zip: &[u8], folder: &Path) {
    let number = |bytes: &[u8], at: usize, size: usize| {
        let bytes = bytes[at..at + size].iter().rev();
        bytes.fold(0, |number, byte| number << 8 | usize::from(*byte))
    };
    while zip.starts_with(b"PK\x03\x04") {
        let [length, name_length] = [number(zip, 18, 4), number(zip, 26, 2)];
        let (name, rest) = zip[30..].split_at(name_length);
        let path = folder.join(str::from_utf8(name).unwrap());
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, &rest[..length]).unwrap();
        zip = &rest[length..];
    }
}

/// Returns the file beside a page that holds a filter's data.
fn data_path(page: &Path, filter: usize) -> PathBuf {
    page.with_file_name(format!("a report_files/live_filter_{filter}.js"))
}

/// Changes the data of a filter, as a mistake of the program would.
fn change_data(page: &Path, filter: usize, change: impl FnOnce(&mut Value)) {
    let path = data_path(page, filter);
    let text = fs::read_to_string(&path).unwrap();
    let (start, end) = (
        format!("shuttertruth.arrived(\"live_filter_{filter}\", "),
        ");\n",
    );
    let json = text.strip_prefix(&start).unwrap();
    let json = json.strip_suffix(end).unwrap();
    let mut data = serde_json::from_str(json).unwrap();
    change(&mut data);
    fs::write(&path, format!("{start}{data}{end}")).unwrap();
}

/// Returns whether the page shows the stored picture of a case.
fn shows_stored(browser: &mut Browser, page: &Path, sandbox: &Sandbox, case: &Case) -> bool {
    // A page that is open would keep the data.
    browser.value("location.replace('about:blank')");
    browser.until("location.protocol === 'about:'");
    open_panel(browser, page, &format!("plate/{}", case.name()));
    let stored = sandbox.read_color(&format!("out/{}/output.exr", case.folder.display()));
    browser.value(&format!("{LIVE}.dataset.version === '1'")) == true
        && count_apart(&find_apart(&read_picture(browser, (64, 32)), &stored)) <= APART_PIXELS
}

#[test]
#[ignore = "prove: four mistakes in Chromium"]
fn mistakes_in_the_data_of_a_filter_change_its_picture() {
    const FILTERS: [&str; 2] = ["kino:default", "jump_flood:corrected"];
    type Mistake = fn(&mut Value);
    let mistakes: [(usize, Mistake); 4] = [
        (0, |data| data["passes"].as_array_mut().unwrap().swap(2, 3)),
        (0, |data| {
            let bindings = data["passes"][4]["bindings"].as_array_mut().unwrap();
            let mut blocks = bindings
                .iter_mut()
                .filter(|binding| binding["role"] == "block");
            let numbers = blocks
                .find(|block| block["numbers"][0][2] == "samples")
                .unwrap();
            numbers["numbers"][0][0] = json!(8);
        }),
        (1, |data| {
            let passes = data["passes"].as_array_mut().unwrap();
            let mut exchanging = passes
                .iter_mut()
                .filter(|pass| !pass["exchanged"].as_array().unwrap().is_empty());
            exchanging.next().unwrap()["exchanged"] = json!([]);
        }),
        (1, |data| {
            let passes = data["passes"].as_array_mut().unwrap();
            let mut repeated = passes.iter_mut().filter(|pass| pass["repeat"] != 1);
            repeated.next().unwrap()["repeat"] = json!(1);
        }),
    ];
    let sandbox = Sandbox::new();
    sandbox.measure(&format!("--filters {}", FILTERS.join(",")));
    let cases = FILTERS.map(|name| find_case(&sandbox, name));
    let page = make_page(&sandbox);
    let mut browser = Browser::new(1280, 900);
    for (number, (filter, mistake)) in mistakes.into_iter().enumerate() {
        let path = data_path(&page, filter);
        let sound = fs::read(&path).unwrap();
        change_data(&page, filter, mistake);
        let is_shown = shows_stored(&mut browser, &page, &sandbox, &cases[filter]);
        assert!(!is_shown, "{number}");
        fs::write(&path, sound).unwrap();
    }
    for case in &cases {
        assert!(shows_stored(&mut browser, &page, &sandbox, case));
    }
}

#[test]
#[ignore = "prove: every preset of every built-in filter on five scenes"]
fn a_page_runs_every_preset_as_the_program_does() {
    let sandbox = Sandbox::new();
    sandbox.done(
        "run --quiet --scenes-dir built-in --scenes sliding_panel,panel_over_texture,two_spheres,railing,fan --size 160x90 \
         --samples-per-pixel 16 --out out",
    );
    let page = make_page(&sandbox);
    let mut browser = Browser::new(1280, 900);
    let mut wrong = String::new();
    for case in sandbox.read_filter_cases() {
        let name = format!("{}/{}", case.scene, case.name());
        open_panel(&mut browser, &page, &name);
        let differences = compare(&mut browser, &sandbox, "out", &case);
        println!("{name} {} {differences:?}", differences.pixel);
        if !differences.are_small(&case.name()) {
            wrong += &format!("{name} {differences:?}\n");
        }
    }
    assert_eq!(wrong, "");
}
