//! The rules of `docs/limits.md`.

use std::fs;
use std::path::{Path, PathBuf};

use frame::{ExrFile, Raster, write_exr};
use serde::Deserialize;
use serde_json::Value;
use tests::root;
use tests::text::assert_contains;
use walkdir::WalkDir;

use crate::sandbox::*;

const RUN: &str = "run --quiet --filter mine --out new";

#[test]
fn the_page_of_limits_agrees_with_the_constants() {
    let page = fs::read_to_string(root().join("docs/limits.md")).unwrap();
    let sources = Sources::read();
    let mut listed = Vec::new();
    // Each row has one number for all of its constants, or a range with one constant for either
    // end.
    for row in page.lines().filter(|line| line.ends_with("` |")) {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let limits: Vec<f64> = cells[2].split(" to ").map(number).collect();
        let names: Vec<&str> = cells[3].split(", ").collect();
        assert!(limits.len() == 1 || limits.len() == names.len(), "{row}");
        for (name, limit) in names.into_iter().zip(limits.into_iter().cycle()) {
            let name = name.trim_matches('`');
            let (crate_name, name) = name.split_once("::").unwrap_or(("", name));
            assert_eq!(limit, sources.value_of(crate_name, name), "{name}");
            listed.push(name);
        }
    }
    for crate_name in ["scene", "tracer"] {
        let source = format!("crates/{crate_name}/src/limits.rs");
        let source = fs::read_to_string(root().join(source)).unwrap();
        for line in source.lines().filter(|line| line.starts_with("pub const")) {
            let name = line.split([' ', ':']).nth(2).unwrap();
            assert!(listed.contains(&name), "docs/limits.md lacks {name}");
        }
    }
}

/// Sources of all crates, below `crates`.
struct Sources(Vec<(PathBuf, String)>);

impl Sources {
    fn read() -> Self {
        let crates = root().join("crates");
        let paths = WalkDir::new(&crates).into_iter();
        let mut paths: Vec<PathBuf> = paths.map(|entry| entry.unwrap().into_path()).collect();
        paths.retain(|path| path.extension().is_some_and(|extension| extension == "rs"));
        let read = |path: PathBuf| {
            let source = fs::read_to_string(&path).unwrap();
            (path.strip_prefix(&crates).unwrap().to_owned(), source)
        };
        Self(paths.into_iter().map(read).collect())
    }

    /// Finds the value of a constant in the sources of one crate, or of all if its name is empty.
    fn value_of(&self, crate_name: &str, name: &str) -> f64 {
        let declared = format!("const {name}:");
        let mut values = Vec::new();
        for (path, source) in &self.0 {
            if path.starts_with(crate_name) {
                let declarations = source.split(&declared).skip(1);
                values.extend(declarations.map(|text| {
                    let (declaration, _) = text.split_once(';').unwrap();
                    number(declaration.split_once('=').unwrap().1)
                }));
            }
        }
        assert_eq!(values.len(), 1, "{name} is declared once");
        values[0]
    }
}

/// Parses a product of numbers in Rust's notation, a shifted 1, or a number of KiB, MiB or GiB.
fn number(text: &str) -> f64 {
    let text = text.trim().replace(['_', ','], "");
    for (unit, bits) in [(" KiB", 10.0), (" MiB", 20.0), (" GiB", 30.0)] {
        if let Some(count) = text.strip_suffix(unit) {
            return number(count) * f64::exp2(bits);
        }
    }
    if let Some((one, bits)) = text.split_once("<<") {
        return number(one) * number(bits).exp2();
    }
    let factors = text.split('*').map(|part| part.trim().parse::<f64>());
    factors.map(Result::unwrap).product()
}

/// Makes a PNG without rows.
fn png(side: u32) -> Vec<u8> {
    let mut file = Vec::new();
    let encoder = png::Encoder::new(&mut file, side, side);
    let mut writer = encoder.write_header().unwrap();
    writer.write_chunk(png::chunk::IDAT, &[]).unwrap();
    drop(writer);
    file
}

/// Makes an EXR of 16 x 16 pixels whose header claims a larger square.
fn exr(sandbox: &Sandbox, side: u32) -> Vec<u8> {
    let path = sandbox.path("small.exr");
    let mut file = ExrFile::new(16, 16);
    file.push_color("", &Raster::filled(16, 16, [0.5; 3]));
    write_exr(&path, &file).unwrap();
    let mut bytes = fs::read(path).unwrap();
    let last = [(side - 1).to_le_bytes(); 2].concat();
    let rows = side.to_le_bytes().to_vec();
    // After each name: the length of the value, and in a window its first corner.
    for (name, before, numbers) in [
        ("dataWindow\0box2i\0", 12, &last),
        ("displayWindow\0box2i\0", 12, &last),
        ("chunkCount\0int\0", 4, &rows),
    ] {
        let mut parts = bytes.windows(name.len());
        let start = parts.position(|part| part == name.as_bytes()).unwrap();
        bytes[start + name.len() + before..][..numbers.len()].copy_from_slice(numbers);
    }
    bytes
}

fn with_mine() -> Sandbox {
    let sandbox = Sandbox::measured();
    let body = "textureStore(output, pixel, textureLoad(color, pixel, 0));";
    sandbox.write_kernel("mine", "", &[], body);
    sandbox
}

fn use_sky(sandbox: &Sandbox, content: &str) {
    let scene = SCENE.replace("constant = [0.2, 0.2, 0.2]", "image = \"sky.hdr\"");
    sandbox.write("scene.toml", &scene);
    sandbox.write("sky.hdr", content);
}

/// A row of texts.toml.
#[derive(Deserialize)]
struct Text {
    file: String,
    before: String,
    #[serde(default)]
    insert: String,
    #[serde(default)]
    repeat: String,
    #[serde(default)]
    count: usize,
    message: Vec<String>,
}

#[derive(Deserialize)]
struct Texts {
    text: Vec<Text>,
}

#[test]
fn text_beyond_a_limit_is_refused_with_its_file() {
    let texts: Texts = toml::from_str(include_str!("texts.toml")).unwrap();
    for text in texts.text {
        let repeat = |at: usize| text.repeat.replace("{}", &at.to_string());
        let pieces: String = (0..text.count).map(repeat).collect();
        let more = format!("{}{pieces}{}", text.insert, text.before);
        let sandbox = with_mine();
        sandbox.edit(&text.file, &text.before, &more);
        sandbox.refuse(RUN, &text.message);
    }
}

#[test]
fn pictures_and_records_beyond_a_limit_are_refused_before_allocation() {
    let sandbox = with_mine();
    let sky = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 30000 +X 60000\n";
    use_sky(&sandbox, sky);
    sandbox.refuse(RUN, &["scene.toml:12:", "1800000000 texels; allowed: 1 to"]);
    sandbox.write("scene.toml", SCENE);
    let textured = format!("{MTL}map_Kd large.png\n");
    sandbox.write("plate.mtl", &textured);
    let corners = OBJ.replace("usemtl", "vt 0 0\nusemtl");
    let corners = corners.replace("f 1 2 3", "f 1/1 2/1 3/1");
    sandbox.write("plate.obj", &corners.replace("f 1 3 4", "f 1/1 3/1 4/1"));
    sandbox.put("scenes/plate/large.png", png(10_000));
    let parts = [
        "large.png is 10000 x 10000",
        "100000000 texels; allowed: 1 to 67108864",
    ];
    sandbox.refuse(RUN, &parts);
    sandbox.write("plate.mtl", MTL);
    // A sparse file takes no disk space.
    let file = fs::File::create(sandbox.path("scenes/plate/plate.obj")).unwrap();
    file.set_len(scene::limits::LARGEST_MESH_FILE + 1).unwrap();
    sandbox.refuse(RUN, &["scene.toml:15: mesh", "at most 2147483648 are read"]);

    let refuse_score = |name: &str, bytes: Vec<u8>, claim: &str| {
        sandbox.put(name, bytes);
        let score = "score --truth out/plate/truth_trailing.exr --frame out/plate/frame.exr";
        sandbox.refuse(&format!("{score} --image {name}"), &[name, claim]);
    };
    let claim = "claims 20000x20000 pixels; allowed: up to 33554432";
    refuse_score("a.png", png(20_000), claim);
    let claim = "claims 100000x100000 pixels; allowed: 1 to 16384";
    refuse_score("a.exr", exr(&sandbox, 100_000), claim);
    let claim = "3221225472 bytes in memory, in a file of";
    refuse_score("a.exr", exr(&sandbox, 16_384), claim);
    let mut run: Value = sandbox.read_json("out/run.json");
    run["replicates"] = 4_000_000_000_u64.into();
    sandbox.put("out/run.json", run.to_string());
    let parts = ["out/run.json", "4000000000 replicates; allowed: 1 to 4096"];
    sandbox.refuse("report out --html page.html", &parts);
}

/// The test hangs if a file is opened after all.
#[cfg(unix)]
#[test]
fn folders_devices_fifos_and_sockets_are_refused_unopened() {
    use std::os::unix::{fs::symlink, net::UnixListener};

    let bind = |path: &Path| drop(UnixListener::bind(path).unwrap());
    type Make = fn(&Path);
    let kinds: [(Make, &str); 4] = [
        (make_fifo, "is a FIFO"),
        (|path| symlink("/dev/zero", path).unwrap(), "is a device"),
        (bind, "is a socket"),
        (|path| fs::create_dir(path).unwrap(), "is a folder"),
    ];
    let scene = ["scene.toml", "plate.obj", "plate.mtl", "sky.hdr"];
    let scene = scene.map(|name| format!("scenes/plate/{name}"));
    for (make, kind) in kinds {
        for name in scene.iter().map(String::as_str).chain(["mine/filter.toml"]) {
            let sandbox = with_mine();
            if name.ends_with("sky.hdr") {
                use_sky(&sandbox, "");
            }
            fs::remove_file(sandbox.path(name)).unwrap();
            make(&sandbox.path(name));
            sandbox.refuse(RUN, &[name, kind, "regular file"]);
        }
    }
}

#[test]
fn control_characters_in_names_are_never_printed() {
    let sandbox = Sandbox::measured();
    let run = sandbox.text("out/run.json");
    let planted = run.replace("\"identity\"", "\"a\\n::error::b\\u001b[2J\"");
    sandbox.put("out/run.json", planted);
    let table = sandbox.done("compare out out");
    assert_contains(&table, &["a\\n::error::b\\u001b[2J"]);
    let name = "a\n::error::b\u{1b}[2J";
    let output = sandbox.shuttertruth(&["run", "--out", "o", "--scenes-dir", name]);
    assert_refused(&output, 2, &["::error::b"]);
    for text in [table, stderr(&output)] {
        let obeyed = |letter: char| letter.is_control() && letter != '\n';
        assert!(!text.contains(obeyed), "{text:?}");
        let is_command = |line: &str| line.trim_start().starts_with("::");
        assert!(!text.lines().any(is_command), "{text}");
    }
}
