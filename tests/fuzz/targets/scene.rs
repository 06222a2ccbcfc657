//! Scene folders: scene.toml, OBJ, MTL and textures.

use std::fs;
use std::ops::ControlFlow;
use std::path::PathBuf;

use engine::{ImportPlan, Motions, Up, import};
use frame::{Alignment, FrameOptions, Image, VelocityKind};
use tracer::{RenderSettings, Scene, list_scenes, load_scene, trace_frame, trace_truth};

use super::none;
use crate::place::Place;
use crate::seeds::{Seed, read_shipped};
use crate::target::{Shape, Target};
use crate::{huge, tokens};

/// scene.toml.
pub static SCENE: Target = Target {
    name: "scene",
    share: 3_500,
    batch: 500,
    shape: Shape::Text,
    tokens: tokens::SCENE,
    seeds: |_| {
        let mut seeds: Vec<Seed> = read_shipped("scenes", "scene.toml")
            .iter()
            .map(at_home)
            .collect();
        seeds.extend([
            Seed::Made(huge::objects_at_one_pose),
            Seed::Made(huge::chain_of_parents),
            Seed::Made(huge::many_variants),
            Seed::Made(huge::many_keys),
            Seed::Made(huge::deep_toml),
            Seed::Made(huge::long_key),
        ]);
        seeds
    },
    run: |place, input| {
        write(place, "scene.toml", input);
        drop(load(place));
    },
};

/// OBJ.
pub static OBJ: Target = Target {
    name: "obj",
    share: 1_500,
    batch: 500,
    shape: Shape::Text,
    tokens: tokens::MODEL,
    seeds: |_| {
        vec![
            Seed::Made(huge::identical_faces),
            Seed::Made(huge::identical_lights),
            Seed::Made(huge::coincident_triangles),
            Seed::Made(huge::faces_without_area),
            Seed::Made(huge::face_of_many_corners),
            Seed::Made(huge::line_without_end),
        ]
    },
    run: |place, input| {
        write(place, "mesh.obj", input);
        if let Some(scene) = load(place) {
            // Builds the tree and traces a few rays.
            render(&scene);
        }
    },
};

/// MTL.
pub static MTL: Target = Target {
    name: "mtl",
    share: 1_500,
    batch: 500,
    shape: Shape::Text,
    tokens: tokens::MODEL,
    seeds: |_| Vec::new(),
    run: |place, input| {
        write(place, "mesh.mtl", input);
        drop(load(place));
    },
};

/// OBJ files that `import` turns into scenes.
pub static IMPORT: Target = Target {
    name: "import",
    share: 400,
    batch: 250,
    shape: Shape::Text,
    tokens: tokens::MODEL,
    seeds: |_| read_shipped("tests/fuzz/corpus/obj", ""),
    run: |place, input| {
        let folder = write(place, "mesh.obj", input);
        let out = place.folder.join("imported");
        let plan = ImportPlan {
            model: folder.join("mesh.obj"),
            out: out.clone(),
            up: Up::Y,
            plain: input.len() % 2 == 0,
            motions: Motions {
                spin: Some(20.0),
                ..Motions::default()
            },
            exposure: 0.5,
        };
        drop(import(&plan));
        let _ = fs::remove_dir_all(out);
    },
};

/// Scenes that are rendered if they load.
pub static RENDER: Target = Target {
    name: "render",
    share: 800,
    batch: 100,
    shape: Shape::Text,
    tokens: tokens::SCENE,
    seeds: |_| Vec::new(),
    run: |place, input| {
        write(place, "scene.toml", input);
        if let Some(scene) = load(place) {
            render(&scene);
        }
    },
};

/// PNG and JPEG.
pub static TEXTURE: Target = Target {
    name: "texture",
    share: 1_500,
    batch: 500,
    shape: Shape::Picture,
    tokens: none(),
    seeds: |_| {
        vec![
            Seed::Made(huge::png_bomb),
            Seed::Made(huge::png_that_boasts),
            Seed::Made(huge::png_with_packed_text),
        ]
    },
    run: |place, input| {
        write(place, "dots.png", input);
        drop(load(place));
    },
};

/// Changes a shipped scene to use the only mesh that is there.
fn at_home(seed: &Seed) -> Seed {
    let Seed::Bytes(text) = seed else {
        unreachable!("a file is bytes");
    };
    let text = String::from_utf8_lossy(text);
    let lines = text.lines().filter(|line| !line.starts_with("group"));
    let lines = lines.map(|line| match line.split_once("mesh = \"") {
        Some((before, after)) => {
            let rest = after.split_once('"').map_or("", |(_, rest)| rest);
            format!("{before}mesh = \"mesh.obj\"{rest}\n")
        }
        None => format!("{line}\n"),
    });
    Seed::Bytes(lines.collect::<String>().into_bytes())
}

/// Writes one file of a scene folder whose other files are valid, and returns the folder.
fn write(place: &Place, name: &str, input: &[u8]) -> PathBuf {
    let folder = place.folder.join("scenes/square");
    if !folder.exists() {
        for (name, content) in [
            (
                "scene.toml",
                include_bytes!("../corpus/render/square").as_slice(),
            ),
            ("mesh.obj", include_bytes!("../corpus/obj/square")),
            ("mesh.mtl", include_bytes!("../corpus/mtl/square")),
            ("dots.png", include_bytes!("../corpus/texture/dots.png")),
            ("sky.hdr", include_bytes!("../corpus/sky_hdr/sky.hdr")),
        ] {
            place.write(&format!("scenes/square/{name}"), content);
        }
    }
    place.write(&format!("scenes/square/{name}"), input);
    folder
}

/// Loads as `list` does and then as `run` does: the scene, then its first variants.
fn load(place: &Place) -> Option<Scene> {
    let listings = list_scenes(place.folder.join("scenes")).ok()?;
    let listing = listings.first()?;
    for variant in listing.variants.iter().take(2) {
        drop(load_scene(&listing.folder, Some(variant)));
    }
    load_scene(&listing.folder, None).ok()
}

/// Renders a frame and a truth of a few pixels, which must be finite.
fn render(scene: &Scene) {
    let watch = &|_| ControlFlow::Continue(());
    let settings = RenderSettings {
        width: 8,
        height: 8,
        options: FrameOptions {
            velocity: VelocityKind::PreviousFrame,
            ..FrameOptions::default()
        },
        samples_per_pixel: 8,
        replicates: 2,
        ..RenderSettings::default()
    };
    if let Ok(frame) = trace_frame(scene, &settings, watch) {
        check("frame", &frame.color);
    }
    if let Ok(truth) = trace_truth(scene, &settings, Alignment::Centred, watch) {
        check("truth", &truth.mean().color);
    }
}

fn check(what: &str, image: &Image) {
    let finite = image.pixels.as_flattened().iter().all(|it| it.is_finite());
    assert!(finite, "a {what} without a word that is not finite");
}
