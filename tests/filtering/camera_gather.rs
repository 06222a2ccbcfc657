//! The blur without a velocity buffer, against the gather that gets only the camera's velocity.

use filters::{Blur, Filter, Gpu, Input};
use frame::{Frame, FrameOptions, Image, VelocityKind};
use glam::{DQuat, DVec3, Vec3};
use tests::shapes::*;
use tests::{open_gpu, unwatched};
use tracer::{Background, Key, Motion, RenderSettings, Scene, trace_frame};

/// Makes a scene in which a camera flies, turns and zooms past a slanted wall before a sky, and one panel moves by
/// itself.
fn flight() -> Scene {
    let mut scene = empty_scene("flight");
    scene.background = Background::Gradient {
        ground: Vec3::splat(0.1),
        horizon: Vec3::splat(1.0),
        zenith: Vec3::splat(0.3),
    };
    let slanted = Motion::still(Key {
        translation: DVec3::new(-2.0, 0.0, -5.0),
        orientation: DQuat::from_rotation_y(0.7),
        ..Key::REST
    });
    add(&mut scene, rectangle(4.0, 3.0), glowing(0.7), slanted);
    let at = DVec3::new(1.0, 0.0, -3.0);
    add(
        &mut scene,
        rectangle(0.5, 0.5),
        glowing(2.0),
        drift(at, DVec3::Y),
    );
    let key = |time: f64| Key {
        time,
        translation: DVec3::new(0.3, 0.1, -0.4) * time,
        orientation: DQuat::from_rotation_y(0.1 * time),
        ..Key::REST
    };
    scene.camera.motion = Motion {
        keys: vec![key(-1.0), key(1.0)],
        ..Motion::default()
    };
    scene.camera.vertical_fov = vec![(-1.0, 1.0), (1.0, 1.1)];
    scene
}

/// Renders a frame of the flight, with the velocity that the camera alone gives.
pub fn render_frame(guard_band: u32) -> Frame {
    let settings = RenderSettings {
        width: 96,
        height: 54,
        exposure: Some(0.75),
        options: FrameOptions {
            velocity: VelocityKind::CameraOnly,
            ..FrameOptions::default()
        },
        guard_band,
        samples_per_pixel: 16,
        ..RenderSettings::default()
    };
    trace_frame(&flight(), &settings, &unwatched).expect("settings are allowed")
}

fn blur_frame(gpu: &Gpu, filter: &str, preset: &str, frame: &Frame) -> Image {
    let filter = Filter::builtin(filter).unwrap();
    let settings = filter.settings(Some(preset)).unwrap();
    let (width, height) = frame.size();
    let mut blur = Blur::new(gpu, &filter, &settings, width, height).unwrap();
    let input = Input {
        color: &[&frame.color],
        velocity: &frame.velocity,
        depth: &frame.depth,
        reprojection: Some(frame.reprojection.moved(f64::from(frame.guard_band))),
        camera: frame.camera,
        exposure: frame.exposure,
        frames_per_second: frame.frames_per_second,
        frame_index: 0,
    };
    blur.run(&input).unwrap().remove(0)
}

#[test]
fn depth_and_the_previous_camera_give_the_camera_s_velocity() {
    let gpu = open_gpu();
    for guard_band in [0, 7] {
        let frame = render_frame(guard_band);
        let speeds = frame.velocity.pixels.iter().map(|v| v[0].hypot(v[1]));
        let fastest = speeds.fold(0.0, f32::max);
        assert!(
            fastest > 5.0,
            "the camera moves: {fastest} pixels per frame"
        );
        // Both take the same eight taps.
        let rebuilt = blur_frame(&gpu, "camera_gather", "default", &frame);
        let given = blur_frame(&gpu, "velocity_gather", "coarse", &frame);
        let differences = rebuilt.pixels.iter().zip(&given.pixels);
        let worst = differences
            .map(|(a, b)| (a[0] - b[0]).abs())
            .fold(0.0, f32::max);
        // Positions in 32 bits err by 1e-5 pixels, and neighbouring pixels differ by up to 2.
        assert!(worst < 1e-3, "with a band of {guard_band}: {worst}");
        let moved = rebuilt.pixels.iter().zip(&frame.color.pixels);
        let changed = moved.filter(|(a, b)| (a[0] - b[0]).abs() > 0.01).count();
        assert!(changed > 100, "only {changed} pixels are blurred");
    }
}

#[test]
fn a_frame_without_the_camera_s_motion_is_refused() {
    let gpu = open_gpu();
    let frame = render_frame(0);
    let filter = Filter::builtin("camera_gather").unwrap();
    let settings = filter.settings(None).unwrap();
    let (width, height) = frame.size();
    let mut blur = Blur::new(&gpu, &filter, &settings, width, height).unwrap();
    let input = Input {
        color: &[&frame.color],
        velocity: &frame.velocity,
        depth: &frame.depth,
        reprojection: None,
        camera: None,
        exposure: frame.exposure,
        frames_per_second: frame.frames_per_second,
        frame_index: 0,
    };
    let error = blur.run(&input).unwrap_err().to_string();
    assert!(
        error.contains("does not say how the camera moved"),
        "{error}"
    );
}
