//! Frames as engines have them: velocity from only the camera, colour at pixel centres, a still sky, a guard band.

use frame::{ColorSampling, Frame, FrameOptions, VelocityKind};
use glam::{DQuat, DVec3, Vec3};
use tests::shapes::*;
use tests::unwatched;
use tracer::{
    Background, Interpolation, Key, Motion, RenderSettings, Scene, TraceError, trace_frame,
};

const SIZE: [u32; 2] = [36, 24];

fn frame_settings() -> RenderSettings {
    RenderSettings {
        width: SIZE[0],
        height: SIZE[1],
        samples_per_pixel: 4,
        ..RenderSettings::default()
    }
}

/// Takes a kind of motion for the velocity buffer.
fn with_velocity(velocity: VelocityKind) -> RenderSettings {
    RenderSettings {
        options: FrameOptions {
            velocity,
            ..FrameOptions::default()
        },
        ..frame_settings()
    }
}

fn render_frame(scene: &Scene, settings: &RenderSettings) -> Frame {
    trace_frame(scene, settings, &unwatched).expect("allowed")
}

/// Makes two glowing spheres under a grey sky; the far one drifts if `moving`.
fn spheres_scene(moving: bool) -> Scene {
    let mut scene = empty_scene("spheres");
    scene.background = Background::Constant(Vec3::splat(0.25));
    let velocity = if moving {
        DVec3::new(0.3, -0.1, 0.2)
    } else {
        DVec3::ZERO
    };
    add(
        &mut scene,
        icosphere(1.0, 3),
        glowing(0.5),
        Motion::still(Key {
            translation: DVec3::new(-0.8, 0.3, -3.0),
            ..Key::REST
        }),
    );
    add(
        &mut scene,
        icosphere(1.0, 3),
        glowing(1.0),
        drift(DVec3::new(1.5, 0.2, -5.0), velocity),
    );
    scene
}

/// Moves and turns the camera at once.
fn move_camera(mut scene: Scene) -> Scene {
    let key = |time, translation, angle| Key {
        time,
        translation,
        orientation: DQuat::from_rotation_y(angle),
        ..Key::REST
    };
    let turn = tracer::Turn {
        axis: DVec3::Y,
        angle: 0.05,
    };
    scene.camera.motion = Motion {
        keys: vec![
            Key {
                turn,
                ..key(-1.0, DVec3::new(-0.2, 0.1, 0.3), -0.05)
            },
            key(0.0, DVec3::ZERO, 0.0),
        ],
        interpolation: Interpolation::Linear,
    };
    scene
}

#[test]
fn the_camera_explains_all_motion_in_a_still_world() {
    let scene = move_camera(spheres_scene(false));
    let whole = render_frame(&scene, &with_velocity(VelocityKind::PreviousFrame));
    let rebuilt = render_frame(&scene, &with_velocity(VelocityKind::CameraOnly));
    let moved = whole
        .velocity
        .pixels
        .iter()
        .map(|v| v[0].hypot(v[1]))
        .fold(0.0, f32::max);
    assert!(moved > 1.0, "the camera moves the picture");
    for (whole, rebuilt) in whole.velocity.pixels.iter().zip(&rebuilt.velocity.pixels) {
        let off = (whole[0] - rebuilt[0]).hypot(whole[1] - rebuilt[1]);
        // Depth in 32-bit floats is exact to 6e-8, and velocities of a few pixels are exact to 2e-7 pixels.
        assert!(off < 2e-6, "{whole:?} {rebuilt:?}");
    }
}

#[test]
fn moving_objects_stand_still_in_the_camera_s_velocity() {
    let rebuilt = render_frame(
        &spheres_scene(true),
        &with_velocity(VelocityKind::CameraOnly),
    );
    let known = render_frame(&spheres_scene(true), &frame_settings());
    assert!(known.velocity.pixels.iter().any(|v| v[0] > 0.5));
    for v in &rebuilt.velocity.pixels {
        // Rounding of depth, unprojected and projected again.
        assert!(v[0].hypot(v[1]) < 1e-6, "{v:?}");
    }
}

#[test]
fn point_sampled_colour_is_that_of_the_pixel_centre() {
    let frame = render_frame(
        &spheres_scene(true),
        &RenderSettings {
            options: FrameOptions {
                color: ColorSampling::Point,
                ..FrameOptions::default()
            },
            ..frame_settings()
        },
    );
    let radiance = [0.25, 0.5, 1.0];
    for pixel in 0..frame.object_id.pixels.len() {
        let id = frame.object_id.pixels[pixel] as usize;
        assert_eq!(frame.color.pixels[pixel], [radiance[id]; 3]);
        for (object, coverage) in frame.coverage.iter().enumerate() {
            assert_eq!(coverage.pixels[pixel], f32::from(object == id));
        }
    }
    let filtered = render_frame(&spheres_scene(true), &frame_settings());
    assert!(
        filtered
            .color
            .pixels
            .iter()
            .any(|color| !radiance.contains(&color[0]))
    );
}

#[test]
fn a_sky_without_velocity_is_still_and_the_rest_is_unchanged() {
    let scene = move_camera(spheres_scene(true));
    let with = render_frame(&scene, &frame_settings());
    let without = render_frame(
        &scene,
        &RenderSettings {
            options: FrameOptions {
                sky_velocity: false,
                ..FrameOptions::default()
            },
            ..frame_settings()
        },
    );
    for pixel in 0..with.object_id.pixels.len() {
        let (with, without, id) = (
            with.velocity.pixels[pixel],
            without.velocity.pixels[pixel],
            with.object_id.pixels[pixel],
        );
        if id == 0 {
            assert_ne!(with, [0.0, 0.0]);
            assert_eq!(without, [0.0, 0.0]);
        } else {
            assert_eq!(with, without);
        }
    }
    assert_eq!(with.color, without.color);
}

#[test]
fn a_frame_inside_its_guard_band_equals_the_bare_frame() {
    for velocity in VelocityKind::ALL {
        let scene = move_camera(spheres_scene(true));
        let bare = render_frame(&scene, &with_velocity(velocity));
        let padded = render_frame(
            &scene,
            &RenderSettings {
                guard_band: 5,
                ..with_velocity(velocity)
            },
        );
        assert_eq!(padded.size(), (SIZE[0] + 10, SIZE[1] + 10));
        let cropped = padded.cropped();
        assert_eq!(
            Frame {
                provenance: bare.provenance.clone(),
                ..cropped
            },
            bare,
            "{velocity}"
        );
    }
}

#[test]
fn the_guard_band_equals_a_wider_view() {
    let band = 6;
    let scene = move_camera(spheres_scene(true));
    let padded = render_frame(
        &scene,
        &RenderSettings {
            guard_band: band,
            ..frame_settings()
        },
    );
    let [width, height] = SIZE.map(|side| side + 2 * band);
    let mut wider = scene.clone();
    let tangent = f64::from(height) / f64::from(SIZE[1]); // of half of 90 degrees, times this
    wider.camera.vertical_fov = vec![(0.0, 2.0 * tangent.atan())];
    let wider = render_frame(
        &wider,
        &RenderSettings {
            width,
            height,
            ..frame_settings()
        },
    );
    assert_eq!(padded.object_id, wider.object_id);
    for pixel in 0..padded.depth.pixels.len() {
        let [a, b] = [&padded, &wider].map(|frame| frame.velocity.pixels[pixel]);
        // Difference quotients round to about 1e-6 pixels.
        assert!((a[0] - b[0]).hypot(a[1] - b[1]) < 1e-4);
        let [a, b] = [&padded, &wider].map(|frame| frame.depth.pixels[pixel]);
        assert!((a - b).abs() <= 1e-6 * a);
    }
}

#[test]
fn a_guard_band_that_is_too_wide_is_refused() {
    let refused = trace_frame(
        &spheres_scene(false),
        &RenderSettings {
            guard_band: 9000,
            ..frame_settings()
        },
        &unwatched,
    );
    assert!(
        matches!(refused, Err(TraceError::Size { width: 18036, .. })),
        "{refused:?}"
    );
}
