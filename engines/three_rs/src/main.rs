//! Draws an exported scene in three-rs, and writes a capture: colour, velocity, depth and object ids of the instant, three-rs's
//! motion blur of it, and sub-frames.
//!
//!     shuttertruth engine export fan@unlit --gltf out/gltf
//!     cargo run -- out/gltf/fan@unlit captures/fan 160 90

mod files;
mod pictures;
mod stage;

use std::path::Path;

use serde_json::Value;
use three_rs::nodes::display::motion_blur;
use three_rs::nodes::tsl::{float, output_property, user_data, vec4_join};
use three_rs::nodes::velocity::velocity;
use three_rs::nodes::{Type, mrt};
use three_rs::{Renderer, RendererParameters, pass};

use files::{write_description, write_exr};
use pictures::{COLOR_SAMPLES, Picture, average_squares, draw_frame, split_depth};
use stage::Stage;

/// Taps of the blur, as the example of three-rs has it.
const BLUR_SAMPLES: i32 = 16;
const RGB: [&str; 3] = ["R", "G", "B"];

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [folder, out, width, height] = &words[..] else {
        panic!("usage: shuttertruth-three-rs SCENE_FOLDER CAPTURE_FOLDER WIDTH HEIGHT");
    };
    let [width, height] =
        [width, height].map(|side| side.parse().expect("WIDTH and HEIGHT are whole numbers"));
    let size: (u32, u32) = (width, height);
    let (folder, out) = (Path::new(folder), Path::new(out));
    std::fs::create_dir_all(out.join("subframes")).unwrap();
    let manifest = std::fs::read(folder.join("manifest.json")).expect("an exported scene");
    let manifest: Value = serde_json::from_slice(&manifest).unwrap();
    let number = |key: &str| manifest[key].as_f64().unwrap();

    let mut renderer = Renderer::new(RendererParameters::default()).expect("a graphics driver");
    renderer.set_pixel_ratio(1.0);
    renderer.set_size(width.into(), height.into());
    println!("{:?}", renderer.adapter_info());
    let mut stage = Stage::load(folder, &manifest, f64::from(width) / f64::from(height));

    let gbuffer = pass(stage.scene.clone(), stage.camera.clone());
    gbuffer.set_mrt(mrt(vec![
        ("output", output_property()),
        ("velocity", velocity()),
    ]));
    // A pass of its own, without the sky: three-rs panics if something without an object reads user data.
    let objects = pass(stage.scene.clone(), stage.camera.clone());
    let id = || user_data("object", Type::F32);
    objects.set_mrt(mrt(vec![(
        "output",
        vec4_join(vec![id(), id(), id(), float(1.0)]),
    )]));
    let fine = pass(stage.scene.clone(), stage.camera.clone());
    fine.set_resolution_scale(COLOR_SAMPLES.into());

    let motion = gbuffer.texture_node("velocity");
    let color = Picture::new(size, average_squares(&fine, size));
    let vectors = Picture::new(size, motion.clone());
    let ids = Picture::new(size, objects.texture_node("output"));
    let depth = Picture::new(size, split_depth(gbuffer.texture_node("depth")));
    // The blur adds `velocity` to texture coordinates. These span 1 over the picture and velocity spans 2, so this is the length
    // of the exposure.
    let amount = number("exposure") / 2.0;
    let sharp = color.target.texture();
    let blur = |scale: f64| {
        let velocity = motion.mul(float(scale));
        Picture::new(size, motion_blur(&sharp, velocity, BLUR_SAMPLES))
    };
    let (blurred, blurred_default) = (blur(amount), blur(1.0));

    let all = [&color, &vectors, &depth, &blurred, &blurred_default];
    for key in ["previous", "instant"] {
        stage.set_time(number(key));
        draw_frame(&mut renderer, &all);
    }
    let write = |name: &str, channels: &[&str], pixels: &[[f32; 4]]| {
        write_exr(&out.join(format!("{name}.exr")), size, channels, pixels);
    };
    write("color", &RGB, &color.read(&mut renderer));
    write("blurred", &RGB, &blurred.read(&mut renderer));
    write(
        "blurred_default",
        &RGB,
        &blurred_default.read(&mut renderer),
    );
    write(
        "velocity",
        &["velocity.X", "velocity.Y"],
        &vectors.read(&mut renderer),
    );
    write("depth", &["Z"], &depth.read_depth(&mut renderer));

    let times = manifest["subframes"]["centred"].as_array().unwrap();
    for (at, time) in times.iter().enumerate() {
        stage.set_time(time.as_f64().unwrap());
        draw_frame(&mut renderer, &[&color]);
        write(
            &format!("subframes/{at:04}"),
            &RGB,
            &color.read(&mut renderer),
        );
    }
    stage.set_time(number("instant"));
    stage.scene.borrow_mut().background = None;
    draw_frame(&mut renderer, &[&ids]);
    let ids = ids.read(&mut renderer).into_iter();
    let ids: Vec<_> = ids.map(|pixel| pixel.map(f32::round)).collect();
    write("object", &["object"], &ids);
    let camera = stage.camera.borrow();
    write_description(out, &manifest, times.len(), camera.near, camera.far);
}
