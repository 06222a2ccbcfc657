//! Scenes on disk: the built-in ones, the documented format, and what is refused.

use std::path::{Path, PathBuf};

use glam::{DVec2, DVec3};
use tracer::{Scene, list_scenes, load_scene};

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes")
}

/// Where a camera that stands still sees a world point, in pixels.
fn project(scene: &Scene, point: DVec3, time: f64) -> DVec2 {
    let seen = scene
        .camera
        .motion
        .at(time)
        .inverse()
        .transform_point3(point);
    let focal = f64::from(scene.height) / 2.0 / (scene.camera.vertical_fov[0].1 / 2.0).tan();
    let middle = DVec2::new(f64::from(scene.width), f64::from(scene.height)) / 2.0;
    middle + focal * DVec2::new(seen.x, -seen.y) / -seen.z
}

/// Left, top, right and bottom of an object in the picture, in pixels.
fn bounds(scene: &Scene, object: usize, time: f64) -> [DVec2; 2] {
    let to_world = scene.object_to_world(object, time);
    let mesh = &scene.meshes[scene.objects[object].mesh];
    let mut bounds = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    for position in &mesh.positions {
        let pixel = project(scene, to_world.transform_point3(position.as_dvec3()), time);
        bounds = [bounds[0].min(pixel), bounds[1].max(pixel)];
    }
    bounds
}

#[test]
fn print_bounds() {
    for listing in list_scenes(&scenes()).unwrap() {
        let scene = load_scene(&listing.folder, None).unwrap_or_else(|e| panic!("{e}"));
        println!("{} {:?} {}", listing.name, listing.variants, scene.hash);
        for (i, o) in scene.objects.iter().enumerate() {
            let m = &scene.meshes[o.mesh];
            println!(
                "  {} tris {} mats {}",
                o.name,
                m.triangles.len(),
                o.materials.len()
            );
            for t in [-0.5, 0.0, 0.5] {
                let b = bounds(&scene, i, t);
                println!("    {t}: {:.1} .. {:.1}", b[0], b[1]);
            }
        }
        for v in &listing.variants {
            load_scene(&listing.folder, Some(v)).unwrap_or_else(|e| panic!("{e}"));
        }
    }
}
