//! A loaded scene, and its time, which is set by hand.

use std::cell::RefCell;
use std::collections::HashMap;
use std::path::Path;
use std::rc::Rc;

use serde_json::Value;
use three_rs::animation::{AnimationMixer, LoopMode, SceneResolver};
use three_rs::loaders::{Gltf, GltfLoader, GltfPrimitive};
use three_rs::nodes::tsl::{equirect_uv, float, position_world_direction, texture_level};
use three_rs::nodes::tsl::{vec2_join, vec3_join};
use three_rs::objects::Background;
use three_rs::{ObjectRef, PerspectiveCamera, Scene};

use crate::files::read_sky;

/// The far plane that three.js gives a camera without one, in metres.
const FAR: f64 = 2e6;

/// Weights of a deforming mesh's shapes.
type Weights = Rc<RefCell<Vec<f64>>>;

pub struct Stage {
    pub scene: Rc<RefCell<Scene>>,
    pub camera: Rc<RefCell<PerspectiveCamera>>,
    deforming: Vec<(ObjectRef, Weights)>,
    mixer: AnimationMixer,
}

impl Stage {
    pub fn load(folder: &Path, manifest: &Value, aspect: f64) -> Self {
        let gltf = GltfLoader::load(folder.join("scene.gltf")).expect("an exported scene");
        name_objects(&gltf, manifest["objects"].as_array().unwrap().len());
        let mut scene = Scene::new();
        scene.add(&gltf.scene);

        // The middle of the sky is towards -Z; three.js expects it towards +X.
        let direction = position_world_direction();
        let turned = vec3_join(vec![direction.z().negate(), direction.y(), direction.x()]);
        let place = equirect_uv(turned);
        let place = vec2_join(vec![place.x(), place.y().one_minus()]);
        let sky = read_sky(&folder.join("sky.exr"));
        scene.background = Some(Background::Node(texture_level(&sky, place, float(0.0))));

        let mut resolver = gltf.scene_resolver();
        let deforming = bind_weights(&gltf, &mut resolver);
        let mut mixer = AnimationMixer::new(Box::new(resolver));
        for clip in &gltf.animations {
            let action = mixer.clip_action(clip, None, None);
            mixer.set_loop(action, LoopMode::Once, 1.0);
            mixer.action_mut(action).clamp_when_finished = true;
            mixer.play(action);
        }
        let camera = read_camera(&gltf, aspect);
        Self {
            scene: Rc::new(RefCell::new(scene)),
            camera: Rc::new(RefCell::new(camera)),
            deforming,
            mixer,
        }
    }

    pub fn set_time(&mut self, seconds: f64) {
        self.mixer.set_time(seconds);
        for (node, weights) in &self.deforming {
            if let Some(mesh) = node.borrow_mut().mesh_mut() {
                mesh.morph_target_influences = weights.borrow().clone();
            }
        }
    }
}

/// Lets the animation set weights of meshes with several materials, and lists meshes with the weights to draw them with. three-rs
/// animates the node of such a mesh, which has no weights, and draws with copies of its own.
fn bind_weights(gltf: &Gltf, resolver: &mut SceneResolver) -> Vec<(ObjectRef, Weights)> {
    let mut shared = HashMap::new();
    let bind = |primitive: &GltfPrimitive| {
        let mesh = &primitive.node;
        let alone = gltf.nodes.iter().any(|node| ObjectRef::ptr_eq(node, mesh));
        let owner = if alone { mesh.clone() } else { mesh.parent()? };
        let weights: &mut Weights = shared
            .entry(owner.borrow().id)
            .or_insert_with(|| primitive.morph_target_influences.clone());
        resolver.add_morph_target_influences(&owner, weights.clone());
        Some((mesh.clone(), weights.clone()))
    };
    let deforming =
        |primitive: &&GltfPrimitive| !primitive.morph_target_influences.borrow().is_empty();
    gltf.primitives
        .iter()
        .filter(deforming)
        .filter_map(bind)
        .collect()
}

/// Makes the camera of the glTF's first node with one, which three-rs's loader leaves out.
fn read_camera(gltf: &Gltf, aspect: f64) -> PerspectiveCamera {
    let nodes = gltf.json["nodes"].as_array().unwrap();
    let number = nodes
        .iter()
        .position(|node| node.get("camera").is_some())
        .expect("a camera");
    let camera = nodes[number]["camera"].as_u64().unwrap() as usize;
    let lens = &gltf.json["cameras"][camera]["perspective"];
    let fov = lens["yfov"].as_f64().unwrap().to_degrees();
    let far = lens["zfar"].as_f64().unwrap_or(FAR);
    let mut camera = PerspectiveCamera::new(fov, aspect, lens["znear"].as_f64().unwrap(), far);
    // The animation moves the node.
    camera.node = gltf.nodes[number].clone();
    camera
}

/// Gives every mesh its object's id, which is its node's number.
fn name_objects(gltf: &Gltf, objects: usize) {
    let number = |object: &ObjectRef| {
        let mut nodes = gltf.nodes.iter();
        nodes.position(|node| ObjectRef::ptr_eq(node, object))
    };
    for primitive in &gltf.primitives {
        let node = &primitive.node;
        let id = number(node).or_else(|| number(&node.parent()?));
        let id = id.filter(|id| *id < objects).unwrap_or(0);
        node.borrow_mut()
            .user_data
            .insert("object".into(), id.into());
    }
}
