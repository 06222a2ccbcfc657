//! The export of a scene: its document, and the files in its folder.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use frame::write_atomically;
use measure::Error;
use scene::{Location, Parent, Scene};
use serde_json::json;

use crate::capture::description::CAPTURE_FILE;
use crate::export::animation::Channels;
use crate::export::document::{Document, widen};
use crate::export::light::{SKY, SUN_EXTENSION, push_sun, sun_light, write_sky};
use crate::export::manifest::{MANIFEST, Manifest};
use crate::export::material::push_material;
use crate::export::mesh::push_mesh;
use crate::export::textures::Textures;
use crate::export::timeline::Timeline;
use crate::files::write_json;

/// Nearest visible depth, in metres: glTF requires one, the tracer has none.
const NEAR: f64 = 0.01;

/// Exports a scene to a folder, which is created if missing. `origin` is the folder that the scene
/// was loaded from, or one next to it, and `program` names the writer. The manifest lists the times
/// of so many `subframes`.
///
/// Node 0 is the camera, node `id` the object with this id, and the last one the sun, if there is
/// one. The animation plays 24 frames per second; [`Timeline`] contains the time of the instant.
pub fn export_gltf(
    scene: &Scene,
    origin: &Location,
    program: &str,
    folder: &Path,
    subframes: u32,
) -> Result<Manifest, Error> {
    let timeline = Timeline::of(scene);
    refuse_zoom(scene, &timeline)?;
    let mut document = Document::default();
    let mut textures = Textures::new(scene, origin, folder);
    for material in &scene.materials {
        push_material(&mut document, &mut textures, material)?;
    }
    push_nodes(&mut document, scene, &timeline)?;
    let mut roots = list_children(scene, Parent::World);
    roots.insert(0, 0);
    roots.extend(scene.sun.map(|sun| push_sun(&mut document, &sun)));
    let lights = scene
        .sun
        .map(|sun| json!({ SUN_EXTENSION: { "lights": [sun_light(&sun)] } }));
    let fields = json!({
        "asset": { "generator": program, "version": "2.0" },
        "extensions": lights,
        "extensionsUsed": list_extensions(&document, scene),
        "scene": 0,
        "scenes": [{ "name": scene.id.to_string(), "nodes": roots }],
    });
    document.write(fields, folder)?;
    write_sky(&scene.background, &folder.join(SKY))?;
    let manifest = Manifest::of(scene, program, &timeline, subframes);
    write_json(&folder.join(MANIFEST), &manifest)?;
    let template = manifest.capture_template();
    write_atomically(&folder.join(CAPTURE_FILE), template.as_bytes())?;
    Ok(manifest)
}

/// Refuses a field of view that changes within the animation.
fn refuse_zoom(scene: &Scene, timeline: &Timeline) -> Result<(), Error> {
    let times = timeline.cut(scene.camera.vertical_fov.iter().map(|(time, _)| *time));
    let angle = scene.camera.vertical_fov_at(0.0);
    let is_other = |time: &f64| (scene.camera.vertical_fov_at(*time) - angle).abs() > 1e-9;
    if times.iter().any(is_other) {
        Err(Error::Refused(format!(
            "scene {}: the camera's field of view changes between frames {} and {}, which glTF 2.0 cannot animate; \
             export a scene or variant with one field of view",
            scene.id, -timeline.reach, timeline.reach
        )))
    } else {
        Ok(())
    }
}

/// Adds the camera and all objects, with their motions.
fn push_nodes(document: &mut Document, scene: &Scene, timeline: &Timeline) -> Result<(), Error> {
    let meshes = push_meshes(document, scene);
    let camera = json!({
        "name": "camera",
        "perspective": {
            "aspectRatio": widen(scene.width as f32 / scene.height as f32),
            "yfov": widen(scene.camera.vertical_fov_at(0.0) as f32),
            "znear": NEAR,
        },
        "type": "perspective",
    });
    let children = |parent| Some(list_children(scene, parent)).filter(|list| !list.is_empty());
    let node = json!({
        "camera": document.push("cameras", camera),
        "children": children(Parent::Camera),
        "name": "camera",
    });
    let mut channels = Channels::new(document, timeline);
    let refuse =
        |what: &str, reason| Error::Refused(format!("scene {}: {what} {reason}", scene.id));
    (channels.push_node(node, &scene.camera.motion))
        .map_err(|reason| refuse("the camera", reason))?;
    for (index, (object, mesh)) in scene.objects.iter().zip(meshes).enumerate() {
        let node = json!({
            "children": children(Parent::Object(index)),
            "mesh": mesh,
            "name": object.name,
        });
        let node = (channels.push_node(node, &object.motion))
            .map_err(|reason| refuse(&format!("object \"{}\"", object.name), reason))?;
        let shapes = &scene.meshes[object.mesh].shapes;
        if shapes.len() > 1 {
            channels.add_shapes(node, shapes);
        }
    }
    channels.finish();
    Ok(())
}

/// Lists the nodes of the objects that move with a parent.
fn list_children(scene: &Scene, parent: Parent) -> Vec<usize> {
    let nodes = scene.objects.iter().zip(1..);
    nodes
        .filter(|(object, _)| object.parent == parent)
        .map(|(_, node)| node)
        .collect()
}

/// Adds the mesh of each object. Objects with the same mesh and materials share it.
fn push_meshes(document: &mut Document, scene: &Scene) -> Vec<usize> {
    let mut meshes: BTreeMap<(usize, &[usize]), usize> = BTreeMap::new();
    let objects = scene.objects.iter().map(|object| {
        let mesh = &scene.meshes[object.mesh];
        let key = (object.mesh, object.materials.as_slice());
        *(meshes.entry(key))
            .or_insert_with(|| push_mesh(document, &object.name, mesh, &object.materials))
    });
    objects.collect()
}

/// Lists the extensions that the document uses. None is required: a reader that lacks one shows
/// different light or gloss.
fn list_extensions(document: &Document, scene: &Scene) -> Option<BTreeSet<String>> {
    let materials = document.list("materials").iter();
    let extensions = materials.filter_map(|material| material["extensions"].as_object());
    let mut used: BTreeSet<String> = extensions
        .flat_map(|extensions| extensions.keys().cloned())
        .collect();
    used.extend(scene.sun.map(|_| SUN_EXTENSION.to_owned()));
    (!used.is_empty()).then_some(used)
}
