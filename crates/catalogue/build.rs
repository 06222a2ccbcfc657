//! Packs the shipped scenes and their bounds into the program, each file separately.

use std::fmt::Write as _;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use flate2::Compression;
use flate2::write::DeflateEncoder;

const SCENES: &str = "../../scenes";

fn main() {
    println!("cargo::rerun-if-changed={SCENES}");
    let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo names the folder"));
    let mut rows = String::from("static FILES: &[Packed] = &[\n");
    for (index, path) in find_files(Path::new(SCENES)).into_iter().enumerate() {
        let bytes = fs::read(&path).expect("a file of a scene can be read");
        let packed = out.join(format!("{index}.deflate"));
        fs::write(&packed, deflate(&bytes)).expect("the build folder can be written");
        let name = path.strip_prefix(SCENES).expect("it lies below the scenes");
        let name = name
            .to_str()
            .expect("its name is Unicode")
            .replace('\\', "/");
        let size = bytes.len();
        writeln!(
            rows,
            "    Packed {{ path: {name:?}, size: {size}, deflated: include_bytes!({packed:?}) }},"
        )
        .expect("text grows");
    }
    rows += "];\n";
    fs::write(out.join("files.rs"), rows).expect("the build folder can be written");
}

/// Lists the bounds of all scenes, and every file of each scene, by path.
fn find_files(root: &Path) -> Vec<PathBuf> {
    let mut paths = Vec::new();
    for folder in list_folder(root) {
        let name = folder.file_name().unwrap_or_default().to_string_lossy();
        if name.starts_with("bounds") && name.ends_with(".toml") {
            paths.push(folder.clone());
        }
        if folder.join("scene.toml").is_file() {
            collect(&folder, &mut paths);
        }
    }
    paths.sort();
    paths
}

fn collect(folder: &Path, paths: &mut Vec<PathBuf>) {
    for path in list_folder(folder) {
        if path.is_dir() {
            collect(&path, paths)
        } else {
            paths.push(path)
        }
    }
}

fn list_folder(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("the folder of scenes can be listed");
    entries
        .map(|entry| entry.expect("an entry can be read").path())
        .collect()
}

fn deflate(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).expect("memory can be written");
    encoder.finish().expect("memory can be written")
}
