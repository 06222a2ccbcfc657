//! The seven packages of the design: each is a dependency, and used for its task.

use std::fs;
use std::path::Path;

use toml::Table;

use crate::uses::strip;
use crate::{rust_files, sources};

/// A package of the design.
struct Package {
    name: &'static str,
    /// Sources that use it, below `crates/`.
    place: &'static str,
    /// Code that does the task with it there.
    code: &'static [&'static str],
    /// True if no other source may use it.
    is_alone: bool,
}

const PACKAGES: [Package; 7] = [
    Package {
        name: "wgpu",
        place: "filters/src",
        code: &[
            "wgpu::Instance::new(",
            ".create_compute_pipeline(",
            ".dispatch_workgroups(",
        ],
        is_alone: true,
    },
    Package {
        name: "glam",
        place: "tracer/src",
        code: &["use glam::"],
        is_alone: false,
    },
    Package {
        name: "tobj",
        place: "scene/src/load",
        code: &["tobj::load_obj_buf(", "tobj::load_mtl_buf("],
        is_alone: true,
    },
    Package {
        name: "obvhs",
        place: "bvh/src",
        code: &["PlocBuilder::new().build(", "ReinsertionOptimizer"],
        is_alone: true,
    },
    Package {
        name: "rayon",
        place: "tracer/src/film",
        code: &["use rayon::prelude::*", ".par_chunks("],
        is_alone: false,
    },
    Package {
        name: "exr",
        place: "frame/src/exr",
        code: &[
            "exr::prelude::read()",
            "exr::prelude::Image::from_layer(",
            ".write()",
        ],
        is_alone: false,
    },
    Package {
        name: "image",
        place: "frame/src",
        code: &["DynamicImage::from_decoder(", ".write_with_encoder("],
        is_alone: false,
    },
];

#[test]
fn each_package_of_the_design_does_its_task() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let workspace = read_manifest(&root.join("Cargo.toml"));
    let versions = workspace["workspace"]["dependencies"]
        .as_table()
        .expect("a table");
    let crates = root.join("crates");
    for Package {
        name,
        place,
        code,
        is_alone,
    } in PACKAGES
    {
        assert!(versions.contains_key(name), "Cargo.toml lacks {name}");
        let (owner, _) = place.split_once('/').expect("sources are in src");
        let manifest = read_manifest(&crates.join(owner).join("Cargo.toml"));
        let dependencies = manifest["dependencies"].as_table().expect("a table");
        assert!(
            dependencies.contains_key(name),
            "{owner} does not depend on {name}"
        );
        let text = read_sources(&crates.join(place));
        for code in code {
            assert!(
                text.contains(code),
                "nothing in {place} does {code} with {name}"
            );
        }
        if is_alone {
            assert_alone(name, &crates.join(place));
        }
    }
}

/// Checks that a package is used in one place only.
fn assert_alone(name: &str, place: &Path) {
    for file in sources().iter().flat_map(|folder| rust_files(folder)) {
        let text = strip(&fs::read_to_string(&file).expect("sources are text"));
        let mut words = text.split(|c: char| !c.is_alphanumeric() && c != '_' && c != ':');
        let uses = words.any(|word| word.starts_with(&format!("{name}::")));
        let file = file.canonicalize().expect("it is there");
        let place = place.canonicalize().expect("it is there");
        assert!(
            !uses || file.starts_with(place),
            "{} uses {name}",
            file.display()
        );
    }
}

/// Reads the code of all files in a folder, without comments and tests.
fn read_sources(folder: &Path) -> String {
    let files = rust_files(folder).into_iter();
    let texts = files.map(|file| strip(&fs::read_to_string(file).expect("sources are text")));
    texts.collect()
}

fn read_manifest(path: &Path) -> Table {
    let text = fs::read_to_string(path).expect("a manifest is text");
    text.parse().expect("a manifest is TOML")
}
