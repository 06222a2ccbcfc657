//! Frames in engines' forms: velocity from only the camera, colour at pixel centres, a still sky, a
//! guard band.

use frame::{ColorSampling, VelocityKind};
use glam::{DQuat, DVec3, Vec3};
use scene::{Background, Key, Scene, SizeError, Turn};
use tracer::{TraceError, trace_frame};

use crate::renders::*;

const SIZE: [u32; 2] = [36, 24];

/// Makes two glowing spheres under a grey sky; the far one drifts.
fn spheres_scene() -> Scene {
    let mut scene = empty_scene("spheres");
    scene.background = Background::Constant(Vec3::splat(0.25));
    let still = placed(DVec3::new(-0.8, 0.3, -3.0));
    add(&mut scene, icosphere(1.0, 3), glowing(0.5), still);
    let moving = drift(DVec3::new(1.5, 0.2, -5.0), DVec3::new(0.3, -0.1, 0.2));
    add(&mut scene, icosphere(1.0, 3), glowing(1.0), moving);
    scene
}

/// Moves and turns the camera at once.
fn move_camera(mut scene: Scene) -> Scene {
    let before = Key {
        orientation: DQuat::from_rotation_y(-0.05),
        turn: Turn {
            axis: DVec3::Y,
            angle: 0.05,
        },
        ..key(-1.0, DVec3::new(-0.2, 0.1, 0.3))
    };
    scene.camera.motion = through([before, Key::REST]);
    scene
}

fn speed(velocity: &[f32; 2]) -> f32 {
    velocity[0].hypot(velocity[1])
}

#[test]
fn the_camera_explains_all_motion_in_a_still_world() {
    let mut scene = move_camera(spheres_scene());
    scene.objects[1].motion.keys.truncate(1);
    let [whole, rebuilt] = [VelocityKind::PreviousFrame, VelocityKind::CameraOnly]
        .map(|kind| render_frame(&scene, &settings_with(SIZE, 4, kind)).velocity);
    let moved = whole.pixels.iter().map(speed).fold(0.0, f32::max);
    assert!(moved > 1.0, "the camera moves the picture");
    for (whole, rebuilt) in whole.pixels.iter().zip(&rebuilt.pixels) {
        let off = [whole[0] - rebuilt[0], whole[1] - rebuilt[1]];
        // Depth in 32-bit floats is exact to 6e-8, and velocities of a few pixels are exact to 2e-7
        // pixels.
        assert!(speed(&off) < 2e-6, "{whole:?} {rebuilt:?}");
    }
}

#[test]
fn moving_objects_stand_still_in_the_camera_s_velocity() {
    let scene = spheres_scene();
    let known = render_frame(&scene, &settings(SIZE, 4));
    assert!(known.velocity.pixels.iter().any(|v| v[0] > 0.5));
    let rebuilt = render_frame(&scene, &settings_with(SIZE, 4, VelocityKind::CameraOnly));
    // Rounding of depth, unprojected and projected again.
    assert!(rebuilt.velocity.pixels.iter().all(|v| speed(v) < 1e-6));
}

#[test]
fn point_sampled_colour_is_that_of_the_pixel_centre() {
    let mut at_centres = settings(SIZE, 4);
    at_centres.options.color = ColorSampling::Point;
    let frame = render_frame(&spheres_scene(), &at_centres);
    let radiance = [0.25, 0.5, 1.0];
    for (pixel, id) in frame.object_id.pixels.iter().enumerate() {
        assert_eq!(frame.color.pixels[pixel], [radiance[*id as usize]; 3]);
        for (object, coverage) in frame.coverage.iter().enumerate() {
            let expected = f32::from(object == *id as usize);
            assert_eq!(coverage.pixels[pixel], expected);
        }
    }
    let filtered = render_frame(&spheres_scene(), &settings(SIZE, 4));
    let mut colors = filtered.color.pixels.iter();
    assert!(colors.any(|color| !radiance.contains(&color[0])));
}

#[test]
fn a_sky_without_velocity_is_still_and_the_rest_is_unchanged() {
    let scene = move_camera(spheres_scene());
    let with = render_frame(&scene, &settings(SIZE, 4));
    let mut still_sky = settings(SIZE, 4);
    still_sky.options.sky_velocity = false;
    let without = render_frame(&scene, &still_sky);
    assert_eq!(with.color, without.color);
    let pairs = with.velocity.pixels.iter().zip(without.velocity.pixels);
    for ((with, without), id) in pairs.zip(&with.object_id.pixels) {
        assert_eq!(*with == without, *id != 0);
        assert!(*id != 0 || without == [0.0; 2]);
    }
}

#[test]
fn a_frame_inside_its_guard_band_equals_the_bare_frame() {
    let scene = move_camera(spheres_scene());
    for velocity in VelocityKind::ALL {
        let settings = settings_with(SIZE, 4, velocity);
        let bare = render_frame(&scene, &settings);
        let mut padded = settings;
        padded.guard_band = 5;
        let padded = render_frame(&scene, &padded);
        assert_eq!(padded.size(), [SIZE[0] + 10, SIZE[1] + 10].into());
        let mut cropped = padded.cropped();
        cropped.provenance = bare.provenance.clone();
        assert_eq!(cropped, bare, "{velocity}");
    }
}

#[test]
fn the_guard_band_equals_a_wider_view() {
    let band = 6;
    let mut scene = move_camera(spheres_scene());
    let mut padded = settings(SIZE, 4);
    padded.guard_band = band;
    let padded = render_frame(&scene, &padded);
    let whole = SIZE.map(|side| side + 2 * band);
    // The tangent of half of 90 degrees, times this.
    let wider = f64::from(whole[1]) / f64::from(SIZE[1]);
    scene.camera.vertical_fov = vec![(0.0, 2.0 * wider.atan())];
    let wider = render_frame(&scene, &settings(whole, 4));
    assert_eq!(padded.object_id, wider.object_id);
    for pixel in 0..padded.depth.pixels.len() {
        let [a, b] = [&padded, &wider].map(|frame| frame.velocity.pixels[pixel]);
        // Difference quotients round to about 1e-6 pixels.
        assert!(speed(&[a[0] - b[0], a[1] - b[1]]) < 1e-4);
        let [a, b] = [&padded, &wider].map(|frame| frame.depth.pixels[pixel]);
        assert!((a - b).abs() <= 1e-6 * a);
    }
}

#[test]
fn a_guard_band_that_is_too_wide_is_refused() {
    let mut settings = settings(SIZE, 4);
    settings.guard_band = 9000;
    let refused = trace_frame(&spheres_scene(), &settings, &unwatched);
    let is_size = matches!(
        refused,
        Err(TraceError::Size(SizeError { width: 18036, .. }))
    );
    assert!(is_size, "{refused:?}");
}
