//! Draws an exported scene in Bevy, and writes a capture: colour, velocity, depth and object ids of the instant, Bevy's motion blur of
//! it, and sub-frames.
//!
//!     shuttertruth engine export fan@unlit --gltf out/gltf
//!     cargo run -- out/gltf/fan@unlit captures/fan 160 90

mod files;
mod readout;

use std::path::{Path, PathBuf};

use bevy::asset::RenderAssetUsages;
use bevy::camera::{Exposure, Hdr, RenderTarget};
use bevy::core_pipeline::prepass::{DepthPrepass, MotionVectorPrepass};
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::gltf::Gltf;
use bevy::light::Skybox;
use bevy::post_process::motion_blur::MotionBlur;
use bevy::prelude::*;
use bevy::render::RenderPlugin;
use bevy::render::pipelined_rendering::PipelinedRenderingPlugin;
use bevy::render::render_resource::{Extent3d, TextureDimension, TextureFormat, TextureUsages};
use serde_json::Value;

use files::{box_filter, write_description, write_exr};
use readout::{Pixels, ReadoutPlugin, read};

/// A sub-frame's pixel is the mean of a square of this many pixels.
const FINE: u32 = 4;

/// A loaded scene, whose time is set by hand.
struct Stage {
    app: App,
    camera: Entity,
    clips: Vec<AnimationNodeIndex>,
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [folder, out, width, height] = &words[..] else {
        panic!("usage: shuttertruth-bevy SCENE_FOLDER CAPTURE_FOLDER WIDTH HEIGHT");
    };
    let size =
        [width, height].map(|side| side.parse().expect("WIDTH and HEIGHT are whole numbers"));
    let (folder, out) = (
        Path::new(folder).canonicalize().expect("an exported scene"),
        PathBuf::from(out),
    );
    std::fs::create_dir_all(out.join("subframes")).unwrap();
    let manifest: Value =
        serde_json::from_slice(&std::fs::read(folder.join("manifest.json")).unwrap()).unwrap();
    let seconds = |key: &str| manifest[key].as_f64().unwrap() as f32;
    let mut stage = Stage::load(&folder);

    // Vectors at the pixels' centres.
    stage.set_camera(size, Msaa::Off);
    stage.draw(seconds("previous"));
    let vectors = stage.draw(seconds("instant"));
    write_exr(
        &out.join("velocity.exr"),
        size,
        &["velocity.X", "velocity.Y"],
        |p| vec![vectors.velocity[p][0], vectors.velocity[p][1]],
    );
    write_exr(&out.join("depth.exr"), size, &["Z"], |p| {
        vec![vectors.depth[p]]
    });

    // Bevy's defaults: four samples per pixel, half a frame of exposure.
    stage.set_camera(size, Msaa::Sample4);
    stage.draw(seconds("previous"));
    let sharp = stage.draw(seconds("instant"));
    stage.set_blur(MotionBlur::default());
    stage.draw(seconds("previous"));
    let blurred = stage.draw(seconds("instant"));
    stage
        .app
        .world_mut()
        .entity_mut(stage.camera)
        .remove::<MotionBlur>();
    for (name, picture) in [("color", sharp), ("blurred", blurred)] {
        write_exr(
            &out.join(format!("{name}.exr")),
            size,
            &["R", "G", "B"],
            |p| picture.color[p].to_vec(),
        );
    }

    let fine = size.map(|side| side * FINE);
    stage.set_camera(fine, Msaa::Off);
    let times = manifest["subframes"]["centred"].as_array().unwrap();
    for (number, time) in times.iter().enumerate() {
        let picture = box_filter(&stage.draw(time.as_f64().unwrap() as f32).color, size, FINE);
        write_exr(
            &out.join(format!("subframes/{number:04}.exr")),
            size,
            &["R", "G", "B"],
            |p| picture[p].to_vec(),
        );
    }

    stage.set_camera(size, Msaa::Off);
    stage.paint_ids(&manifest["objects"]);
    let ids = stage.draw(seconds("instant"));
    write_exr(&out.join("object.exr"), size, &["object"], |p| {
        vec![ids.color[p][0].round()]
    });
    write_description(&out, &manifest, times.len(), stage.near());
}

impl Stage {
    /// Loads the scene, its camera and its sky.
    fn load(folder: &Path) -> Self {
        let mut app = App::new();
        let assets = AssetPlugin {
            file_path: folder.display().to_string(),
            ..default()
        };
        let render = RenderPlugin {
            synchronous_pipeline_compilation: true,
            ..default()
        };
        app.add_plugins((
            DefaultPlugins
                .set(assets)
                .set(render)
                .disable::<PipelinedRenderingPlugin>(),
            ReadoutPlugin,
        ));
        app.insert_resource(GlobalAmbientLight::NONE);
        app.finish();
        app.cleanup();
        let server = app.world().resource::<AssetServer>().clone();
        let gltf: Handle<Gltf> = server.load("scene.gltf");
        let wait = |app: &mut App, ready: &dyn Fn(&mut World) -> bool| {
            for _ in 0..10_000 {
                app.update();
                if ready(app.world_mut()) {
                    return;
                }
                std::thread::sleep(std::time::Duration::from_millis(1));
            }
            panic!("the scene does not load");
        };
        wait(&mut app, &|world| {
            world
                .resource::<AssetServer>()
                .is_loaded_with_dependencies(&gltf)
        });
        let loaded = app.world().resource::<Assets<Gltf>>().get(&gltf).unwrap();
        let (scene, clips) = (loaded.scenes[0].clone(), loaded.animations.clone());
        app.world_mut().spawn(WorldAssetRoot(scene));
        wait(&mut app, &|world| {
            world
                .query_filtered::<(), With<Camera3d>>()
                .iter(world)
                .count()
                > 0
        });

        let (graph, clips) = AnimationGraph::from_clips(clips);
        let graph = app
            .world_mut()
            .resource_mut::<Assets<AnimationGraph>>()
            .add(graph);
        let sky = app
            .world_mut()
            .resource_mut::<Assets<Image>>()
            .add(files::read_sky(&folder.join("sky.exr")));
        let world = app.world_mut();
        let camera = world
            .query_filtered::<Entity, With<Camera3d>>()
            .single(world)
            .unwrap();
        // Exposure times brightness is 1: radiance stays as it is.
        let exposure = Exposure {
            ev100: -1.2_f32.log2(),
        };
        let skybox = Skybox {
            image: Some(sky),
            brightness: 1.0,
            ..default()
        };
        world.entity_mut(camera).insert((
            Hdr,
            Tonemapping::None,
            DepthPrepass,
            MotionVectorPrepass,
            exposure,
            skybox,
        ));
        let players: Vec<Entity> = world
            .query_filtered::<Entity, With<AnimationPlayer>>()
            .iter(world)
            .collect();
        for player in players {
            world
                .entity_mut(player)
                .insert(AnimationGraphHandle(graph.clone()));
        }
        Self { app, camera, clips }
    }

    fn set_camera(&mut self, [width, height]: [u32; 2], msaa: Msaa) {
        let size = Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        };
        let mut image = Image::new_uninit(
            size,
            TextureDimension::D2,
            TextureFormat::Rgba16Float,
            RenderAssetUsages::RENDER_WORLD,
        );
        image.texture_descriptor.usage |= TextureUsages::RENDER_ATTACHMENT;
        let target: RenderTarget = self
            .app
            .world_mut()
            .resource_mut::<Assets<Image>>()
            .add(image)
            .into();
        self.app
            .world_mut()
            .entity_mut(self.camera)
            .insert((target, msaa));
        self.settle();
    }

    /// Lets what is new reach the renderer.
    fn settle(&mut self) {
        for _ in 0..3 {
            self.app.update();
        }
    }

    fn set_blur(&mut self, blur: MotionBlur) {
        self.app.world_mut().entity_mut(self.camera).insert(blur);
    }

    /// Draws a time of the animation. Bevy's velocity is the motion since the drawing before.
    fn draw(&mut self, seconds: f32) -> Pixels {
        let world = self.app.world_mut();
        for mut player in world.query::<&mut AnimationPlayer>().iter_mut(world) {
            for clip in &self.clips {
                player.play(*clip).pause().seek_to(seconds);
            }
        }
        self.app.update();
        read(&mut self.app)
    }

    /// Paints every object with its number in the manifest.
    fn paint_ids(&mut self, objects: &Value) {
        let names: Vec<&str> = objects
            .as_array()
            .unwrap()
            .iter()
            .map(|name| name.as_str().unwrap())
            .collect();
        let world = self.app.world_mut();
        let meshes: Vec<Entity> = world
            .query_filtered::<Entity, With<Mesh3d>>()
            .iter(world)
            .collect();
        for mesh in meshes {
            let mut node = Some(mesh);
            let id = std::iter::from_fn(|| {
                let at = node?;
                node = world.get::<ChildOf>(at).map(|child| child.parent());
                Some(
                    world
                        .get::<Name>(at)
                        .and_then(|name| names.iter().position(|object| *object == name.as_str()))
                        .unwrap_or(0),
                )
            });
            let id = id.into_iter().find(|id| *id > 0).unwrap_or(0);
            let base_color = Color::linear_rgb(id as f32, 0.0, 0.0);
            let paint = StandardMaterial {
                base_color,
                unlit: true,
                double_sided: true,
                cull_mode: None,
                ..default()
            };
            let paint = world.resource_mut::<Assets<StandardMaterial>>().add(paint);
            world.entity_mut(mesh).insert(MeshMaterial3d(paint));
        }
        world.entity_mut(self.camera).remove::<Skybox>();
        world.get_mut::<Camera>(self.camera).unwrap().clear_color = Color::BLACK.into();
        self.settle();
    }

    /// Distance of the near plane, in metres.
    fn near(&self) -> f32 {
        match self.app.world().get::<Projection>(self.camera).unwrap() {
            Projection::Perspective(lens) => lens.near,
            _ => panic!("exported cameras are perspective ones"),
        }
    }
}
