//! The export of a scene: its document, and the files beside it.

use std::collections::BTreeMap;
use std::path::Path;

use frame::write_atomically;
use gltf_json::camera::{Perspective, Type as CameraType};
use gltf_json::scene::{Node, Scene as GltfScene};
use gltf_json::validation::{Checked, USize64};
use gltf_json::{Asset, Buffer, Camera, Index, Material, Mesh};
use tracer::{Location, Parent, Scene};

use crate::animation::Channels;
use crate::buffer::{BUFFER, Document};
use crate::error::ExportError;
use crate::light::{SKY, push_sun, write_sky};
use crate::manifest::{MANIFEST, Manifest};
use crate::material::push_material;
use crate::mesh::push_mesh;
use crate::motion::Tracks;
use crate::textures::Textures;
use crate::timeline::Timeline;

/// Name of the document.
const DOCUMENT: &str = "scene.gltf";
/// Nearest depth that a camera shows, in metres: glTF asks for one, the tracer has none.
const NEAR: f32 = 0.01;

/// Exports a scene to a folder, which is made if it is not there. `origin` is the folder that the scene was loaded from, or one
/// beside it, and `program` names the writer.
///
/// Node 0 is the camera, node `id` the object with this id, and the last one the sun, if there is one. The animation plays
/// 24 frames per second; [`Timeline`] says where the instant is.
pub fn export_gltf(
    scene: &Scene,
    origin: &Location,
    program: &str,
    folder: &Path,
) -> Result<Manifest, ExportError> {
    let timeline = Timeline::of(scene);
    refuse_zoom(scene, &timeline)?;
    let mut document = Document::default();
    document.root.asset = Asset {
        generator: Some(program.to_owned()),
        version: "2.0".to_owned(),
        ..Asset::default()
    };
    let materials = push_materials(&mut document, scene, origin, folder)?;
    let mut channels = Channels::default();
    let mut roots = push_nodes(&mut document, &mut channels, scene, &materials, &timeline);
    channels.finish(&mut document);
    if let Some(sun) = &scene.sun {
        roots.push(push_sun(&mut document, sun));
    }
    document.root.scene = Some(Index::new(0));
    document.root.push(GltfScene {
        extensions: None,
        extras: None,
        name: Some(scene.id.to_string()),
        nodes: roots,
    });
    document.root.extensions_used = list_extensions(&document);
    document.root.push(Buffer {
        byte_length: USize64::from(document.bytes.len()),
        name: None,
        uri: Some(BUFFER.to_owned()),
        extensions: None,
        extras: None,
    });
    write_atomically(&folder.join(BUFFER), &document.bytes)?;
    let text =
        serde_json::to_vec_pretty(&document.root).expect("a document has no maps with odd keys");
    write_atomically(&folder.join(DOCUMENT), &text)?;
    write_sky(&scene.background, &folder.join(SKY))?;
    let manifest = Manifest::of(scene, program, &timeline);
    let text = serde_json::to_vec_pretty(&manifest).expect("a manifest has no maps with odd keys");
    write_atomically(&folder.join(MANIFEST), &text)?;
    Ok(manifest)
}

/// Refuses a field of view that changes within the animation.
fn refuse_zoom(scene: &Scene, timeline: &Timeline) -> Result<(), ExportError> {
    let times = timeline.cut(scene.camera.vertical_fov.iter().map(|(time, _)| *time));
    let own = scene.camera.vertical_fov_at(0.0);
    let is_other = |time: &f64| (scene.camera.vertical_fov_at(*time) - own).abs() > 1e-9;
    match times.iter().any(is_other) {
        true => Err(ExportError::FieldOfView {
            scene: scene.id.to_string(),
            from: -timeline.reach,
            to: timeline.reach,
        }),
        false => Ok(()),
    }
}

fn push_materials(
    document: &mut Document,
    scene: &Scene,
    origin: &Location,
    folder: &Path,
) -> Result<Vec<Index<Material>>, ExportError> {
    let mut textures = Textures::new(scene, origin, folder);
    (scene.materials.iter())
        .map(|material| push_material(document, &mut textures, material))
        .collect()
}

/// Adds the camera and all objects, with their motions; returns the nodes that have no parent.
fn push_nodes(
    document: &mut Document,
    channels: &mut Channels,
    scene: &Scene,
    materials: &[Index<Material>],
    timeline: &Timeline,
) -> Vec<Index<Node>> {
    let camera = push_camera(document, scene);
    let nodes: Vec<Index<Node>> = push_objects(document, scene, materials);
    channels.add_motion(
        document,
        camera,
        &Tracks::of(&scene.camera.motion, timeline),
        timeline,
    );
    let mut roots = vec![camera];
    for (object, node) in scene.objects.iter().zip(&nodes) {
        channels.add_motion(
            document,
            *node,
            &Tracks::of(&object.motion, timeline),
            timeline,
        );
        let mesh = &scene.meshes[object.mesh];
        if mesh.shapes.len() > 1 {
            channels.add_shapes(document, *node, &mesh.shapes, timeline);
        }
        let parent = match object.parent {
            Parent::World => {
                roots.push(*node);
                continue;
            }
            Parent::Camera => camera,
            Parent::Object(index) => nodes[index],
        };
        let children = &mut document.root.nodes[parent.value()].children;
        children.get_or_insert_default().push(*node);
    }
    roots
}

fn push_camera(document: &mut Document, scene: &Scene) -> Index<Node> {
    let camera = document.root.push(Camera {
        name: Some("camera".to_owned()),
        orthographic: None,
        perspective: Some(Perspective {
            aspect_ratio: Some(scene.width as f32 / scene.height as f32),
            yfov: scene.camera.vertical_fov_at(0.0) as f32,
            zfar: None,
            znear: NEAR,
            extensions: None,
            extras: None,
        }),
        type_: Checked::Valid(CameraType::Perspective),
        extensions: None,
        extras: None,
    });
    document.root.push(Node {
        camera: Some(camera),
        name: Some("camera".to_owned()),
        ..Node::default()
    })
}

/// Adds a node per object. Objects of one mesh and the same materials share it.
fn push_objects(
    document: &mut Document,
    scene: &Scene,
    materials: &[Index<Material>],
) -> Vec<Index<Node>> {
    let mut meshes: BTreeMap<(usize, &[usize]), Index<Mesh>> = BTreeMap::new();
    (scene.objects.iter())
        .map(|object| {
            let key = (object.mesh, object.materials.as_slice());
            let mesh = *meshes.entry(key).or_insert_with(|| {
                let own: Vec<_> = object
                    .materials
                    .iter()
                    .map(|index| materials[*index])
                    .collect();
                push_mesh(document, &object.name, &scene.meshes[object.mesh], &own)
            });
            document.root.push(Node {
                mesh: Some(mesh),
                name: Some(object.name.clone()),
                ..Node::default()
            })
        })
        .collect()
}

/// Lists the extensions that the document uses. None is required: a reader that lacks one shows another light or gloss.
fn list_extensions(document: &Document) -> Vec<String> {
    let has = |is_used: fn(&gltf_json::extensions::material::Material) -> bool| {
        let mut own = document
            .root
            .materials
            .iter()
            .filter_map(|own| own.extensions.as_ref());
        own.any(is_used)
    };
    let used = [
        ("KHR_lights_punctual", document.root.extensions.is_some()),
        (
            "KHR_materials_emissive_strength",
            has(|own| own.emissive_strength.is_some()),
        ),
        ("KHR_materials_ior", has(|own| own.ior.is_some())),
        ("KHR_materials_specular", has(|own| own.specular.is_some())),
        (
            "KHR_materials_transmission",
            has(|own| own.transmission.is_some()),
        ),
    ];
    (used.into_iter())
        .filter(|(_, is_used)| *is_used)
        .map(|(name, _)| name.to_owned())
        .collect()
}
