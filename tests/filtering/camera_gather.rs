//! The blur without a velocity buffer, against the gather with only the camera's velocity.

use filters::Input;
use frame::{FAR_DEPTH, Frame, FrameOptions, Image, Size, VelocityKind};
use glam::{DQuat, DVec3, Vec3};
use scene::{Background, Key, Motion, Scene};
use tests::near::{assert_near, assert_within};
use tests::picture::{frame_input, make_blur};
use tests::shapes::*;
use tests::text::assert_contains;
use tests::unwatched;
use tracer::{RenderSettings, trace_frame};

use crate::reference::{read_clamped, sample_linear};

/// Makes a scene in which a camera flies, turns and zooms past a slanted wall in front of a sky,
/// with one panel that moves by itself.
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
    let rising = drift(DVec3::new(1.0, 0.0, -3.0), DVec3::Y);
    add(&mut scene, rectangle(0.5, 0.5), glowing(2.0), rising);
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

/// Renders a frame of the flight, with only the camera's velocity: several pixels per frame.
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
    let frame = trace_frame(&flight(), &settings, &unwatched).expect("settings are allowed");
    let speeds = frame.velocity.pixels.iter().map(|v| v[0].hypot(v[1]));
    assert_within(speeds.fold(0.0, f32::max), 5.0..);
    frame
}

/// Blurs a frame with a built-in filter, with changes to a preset such as `samples=9`.
pub fn blur_frame(frame: &Frame, filter: &str, preset: Option<&str>, changes: &str) -> Image {
    let mut blur = make_blur(filter, preset, changes, frame.size());
    let outputs = blur.run(&frame_input(frame, &[&frame.color]));
    outputs.unwrap().remove(0)
}

#[test]
fn depth_and_the_previous_camera_give_the_camera_s_velocity() {
    for guard_band in [0, 7] {
        let frame = render_frame(guard_band);
        // Both use the same eight taps.
        let filters = [("camera_gather", "default"), ("velocity_gather", "coarse")];
        let [rebuilt, given] =
            filters.map(|(filter, preset)| blur_frame(&frame, filter, Some(preset), ""));
        let differences = rebuilt.zip(&given, |a, b| (a[0] - b[0]).abs());
        let worst = differences.pixels.into_iter().fold(0.0, f32::max);
        // Positions in 32 bits err by 1e-5 pixels, and neighbouring pixels differ by up to 2.
        assert!(worst < 1e-3, "with a band of {guard_band}: {worst}");
        let moved = rebuilt.pixels.iter().zip(&frame.color.pixels);
        let changed = moved.filter(|(a, b)| (a[0] - b[0]).abs() > 0.01).count();
        assert!(changed > 100, "only {changed} pixels are blurred");
    }
}

#[test]
fn armory_s_mode_camera_equals_its_source_in_64_bits() {
    let frame = render_frame(0);
    let output = blur_frame(&frame, "camera_gather", Some("armory"), "");
    let Size { width, height } = frame.size();
    let size = [width, height].map(f64::from);
    let [mut blurred, mut sky] = [0; 2];
    for (x, y) in (0..width).flat_map(|x| (0..height).map(move |y| (x, y))) {
        let input = f64::from(frame.color.at(x, y)[0]);
        let result = f64::from(output.at(x, y)[0]);
        // motion_blur_pass.frag.glsl at 258a33d, line by line, in texture coordinates from the top
        // left.
        if *frame.depth.at(x, y) == FAR_DEPTH {
            assert_eq!(result, input);
            sky += 1;
            continue;
        }
        let velocity = [0, 1].map(|axis| {
            let device = 2.0 * f64::from(frame.velocity.at(x, y)[axis]) / size[axis];
            device / 40.0 * 2.5 * frame.exposure
        });
        let mut offset = [x, y].map(|part| f64::from(part) + 0.5);
        let mut sum = input;
        for _ in 0..8 {
            offset = [0, 1].map(|axis| offset[axis] + velocity[axis] * size[axis]);
            sum += sample_linear(offset, |x, y| read_clamped(&frame.color, x, y)[0].into());
        }
        // Positions in 32 bits err by 1e-5 pixels, and neighbouring pixels differ by up to 2.
        assert_near(result, sum / 9.0, 1e-3);
        blurred += i32::from((result - input).abs() > 0.01);
    }
    assert!(blurred > 40 && sky > 100, "{blurred} {sky}");
}

#[test]
fn urp_s_mode_camera_equals_its_source_in_64_bits() {
    let frame = render_frame(0);
    let output = blur_frame(&frame, "urp", Some("camera_only"), "");
    let Size { width, height } = frame.size();
    let size = [width, height].map(f64::from);
    let [mut cut, mut same] = [0; 2];
    for (x, y) in (0..width).flat_map(|x| (0..height).map(move |y| (x, y))) {
        // CameraMotionBlur.shader at 438e586, line by line, with an intensity of half the exposure.
        let device =
            [0, 1].map(|axis| -2.0 * f64::from(frame.velocity.at(x, y)[axis]) / size[axis]);
        let length = device[0].hypot(device[1]);
        let velocity = device.map(|part| 0.5 * frame.exposure * part * length.min(0.05) / length);
        let uv = [x, y].map(|part| f64::from(part) + 0.5);
        let noise = (52.9829189 * (0.06711056 * uv[0] + 0.00583715 * uv[1]).fract()).fract();
        let mut sum = 0.0;
        for (i, sign) in (0..2).flat_map(|i| [(f64::from(i), -1.0), (f64::from(i), 1.0)]) {
            let offset = (i + 0.5 + sign * (noise - 0.5)) / 4.0 * sign;
            let at =
                [0, 1].map(|axis| (uv[axis] + offset * velocity[axis] * size[axis]).floor() as i64);
            sum += f64::from(read_clamped(&frame.color, at[0], at[1])[0]);
        }
        cut += i32::from(length > 0.05);
        same += i32::from((f64::from(output.at(x, y)[0]) - sum / 4.0).abs() < 1e-5);
    }
    // A tap that lies on the border of two pixels reads either.
    let pixels = i32::try_from(width * height).unwrap();
    assert!(cut > 100 && cut < pixels - 100, "{cut} are cut");
    assert!(same >= pixels - 6, "{same} of {pixels}");
}

#[test]
fn half_of_the_camera_s_motion_leaves_movers_their_own() {
    let frame = render_frame(0);
    let [whole, half, none] = ["1", "0.5", "0"].map(|part| {
        let changes = format!("camera_influence={part}");
        blur_frame(&frame, "mcguire", Some("g3d"), &changes)
    });
    let difference = |image: &Image| {
        let differences = image.zip(&frame.color, |a, b| (a[0] - b[0]).abs());
        differences.pixels.iter().sum::<f32>()
    };
    // The velocities of this frame are the camera's alone, so that nothing is left of them.
    assert_eq!(difference(&none), 0.0);
    assert!(difference(&half) > 0.0 && difference(&half) < difference(&whole));
    // Twice the exposure makes up for half the camera's motion.
    let longer = Frame {
        exposure: 2.0 * frame.exposure,
        ..frame
    };
    let doubled = blur_frame(&longer, "mcguire", Some("g3d"), "");
    let differences = doubled.zip(&whole, |a, b| (a[0] - b[0]).abs());
    assert_within(differences.pixels.into_iter().fold(0.0, f32::max), ..0.01);
}

#[test]
fn a_parameter_switches_the_camera_off() {
    let frame = render_frame(0);
    let colors = [&frame.color];
    let input = Input {
        reprojection: None,
        ..frame_input(&frame, &colors)
    };
    for (filter, preset, off) in [
        ("mcguire", "g3d", "camera_influence=1"),
        ("urp", "camera_only", "motion=all"),
    ] {
        let mut needs_it = make_blur(filter, Some(preset), "", frame.size());
        let error = needs_it.run(&input).unwrap_err().to_string();
        assert_contains(
            &error,
            &["does not say how the camera moved", &format!("set {off}")],
        );
        let mut needs_none = make_blur(filter, Some(preset), off, frame.size());
        needs_none.run(&input).unwrap();
    }
}

#[test]
fn a_frame_without_the_camera_s_motion_is_refused() {
    let frame = render_frame(0);
    let mut blur = make_blur("camera_gather", None, "", frame.size());
    let colors = [&frame.color];
    let input = Input {
        reprojection: None,
        ..frame_input(&frame, &colors)
    };
    let error = blur.run(&input).unwrap_err().to_string();
    assert_contains(&error, &["does not say how the camera moved"]);
}
