//! Images of the background: HDR and OpenEXR.

use tracer::load_scene;

use super::none;
use crate::fixture::files;
use crate::huge;
use crate::place::Place;
use crate::seeds::Seed;
use crate::target::{Shape, Target};

/// Radiance HDR.
pub static HDR: Target = Target {
    name: "sky_hdr",
    share: 600,
    batch: 350,
    shape: Shape::Bytes,
    tokens: none(),
    seeds: |_| {
        vec![
            Seed::Made(huge::hdr_that_boasts),
            Seed::Made(huge::hdr_bomb),
        ]
    },
    run: |place, input| load(place, "sky.hdr", input),
};

/// OpenEXR of other programs.
pub static EXR: Target = Target {
    name: "sky_exr",
    share: 600,
    batch: 350,
    shape: Shape::Picture,
    tokens: none(),
    seeds: |place| {
        let mut seeds = vec![Seed::Made(huge::exr_that_boasts)];
        let frames = files(&place.fixture.join("out"), "frame.exr");
        seeds.extend(
            frames
                .iter()
                .map(|path| Seed::Bytes(std::fs::read(path).unwrap())),
        );
        seeds
    },
    run: |place, input| load(place, "sky.exr", input),
};

fn load(place: &Place, name: &str, input: &[u8]) {
    let scene = String::from_utf8_lossy(include_bytes!("../corpus/render/square"));
    let constant = "constant = [0.2, 0.2, 0.2]";
    assert!(scene.contains(constant), "the scene has a background");
    let scene = scene.replace(constant, &format!("image = \"{name}\""));
    place.write("square/scene.toml", scene);
    place.write("square/mesh.obj", include_bytes!("../corpus/obj/square"));
    place.write("square/mesh.mtl", include_bytes!("../corpus/mtl/square"));
    place.write(
        "square/dots.png",
        include_bytes!("../corpus/texture/dots.png"),
    );
    place.write(&format!("square/{name}"), input);
    drop(load_scene(place.folder.join("square"), None));
}
