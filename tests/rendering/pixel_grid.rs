//! Frames on other pixels than the picture's own: moved by a part of a pixel, or fewer.

use frame::{ColorSampling, Frame, VelocityKind};
use glam::{DVec3, Vec3};
use scene::{Background, Key, Scene, SizeError};
use tracer::{
    PixelGrid, PointMotion, RenderSettings, TraceError, frame_hash, trace_frame_part,
    trace_motion_on,
};

use crate::renders::*;

const WIDTH: u32 = 36;
const HEIGHT: u32 = 24;

fn settings(size: [u32; 2]) -> RenderSettings {
    let mut settings = settings_with(size, 4, VelocityKind::PreviousFrame);
    settings.options.color = ColorSampling::Point;
    settings.replicates = 1;
    settings
}

/// Makes a glowing sphere that drifts in front of a camera that drifts the other way.
fn drifting_sphere() -> Scene {
    let mut scene = empty_scene("sphere");
    scene.background = Background::Constant(Vec3::splat(0.25));
    let motion = drift(DVec3::new(0.2, 0.1, -3.5), DVec3::new(0.3, -0.1, 0.2));
    add(&mut scene, icosphere(1.0, 3), glowing(1.0), motion);
    scene.camera.motion = through([key(-1.0, DVec3::new(0.1, 0.0, 0.0)), Key::REST]);
    scene
}

fn render_on(size: [u32; 2], offset: [f64; 2]) -> Frame {
    let grid = PixelGrid {
        size: size.into(),
        offset,
    };
    let settings = settings([WIDTH, HEIGHT]);
    let traced = trace_frame_part(&drifting_sphere(), &settings, &grid, None, &unwatched);
    traced.expect("allowed").frame
}

#[test]
fn a_grid_that_is_off_by_whole_pixels_shows_what_lies_beside() {
    let unmoved = render_on([WIDTH, HEIGHT], [0.0; 2]);
    let settings = settings([WIDTH, HEIGHT]);
    let plain = render_frame(&drifting_sphere(), &settings);
    assert_eq!(unmoved, plain);
    let hash = frame_hash(&drifting_sphere(), &settings);
    assert_eq!(unmoved.provenance.content_hash, hash);
    let moved = render_on([WIDTH, HEIGHT], [2.0, -1.0]);
    assert_ne!(
        moved.provenance.content_hash,
        unmoved.provenance.content_hash
    );
    for (x, y) in (1..HEIGHT).flat_map(|y| (0..WIDTH - 2).map(move |x| (x, y))) {
        let (beside, above) = (x + 2, y - 1);
        assert_eq!(moved.color.at(x, y), unmoved.color.at(beside, above));
        assert_eq!(moved.velocity.at(x, y), unmoved.velocity.at(beside, above));
        assert_eq!(moved.depth.at(x, y), unmoved.depth.at(beside, above));
        assert_eq!(
            moved.object_id.at(x, y),
            unmoved.object_id.at(beside, above)
        );
    }
    // Half a pixel changes the silhouette, and layers rendered alone equal the frame's.
    let half = render_on([WIDTH, HEIGHT], [0.5, 0.5]);
    assert_ne!(half.object_id, unmoved.object_id);
    let mut grid = PixelGrid::of_picture(WIDTH, HEIGHT);
    grid.offset = [0.5, 0.5];
    let scene = drifting_sphere();
    let points = trace_motion_on(&scene, &settings, &PointMotion::RIGHT, &grid).expect("allowed");
    assert_eq!(points.velocity, half.velocity);
    assert_eq!(points.depth, half.depth);
}

#[test]
fn movers_show_through_walls_without_a_depth_test() {
    let mut scene = drifting_sphere();
    scene.camera.motion = through([Key::REST]);
    let free = render_frame(&scene, &settings([WIDTH, HEIGHT]));
    // A still wall in front of the left half of the picture.
    let wall = placed(DVec3::new(-2.0, 0.0, -1.0));
    add(&mut scene, rectangle(4.0, 4.0), glowing(0.5), wall);
    let trace = |motion| {
        let grid = PixelGrid::of_picture(WIDTH, HEIGHT);
        trace_motion_on(&scene, &settings([WIDTH, HEIGHT]), &motion, &grid).expect("allowed")
    };
    let (right, through) = (trace(PointMotion::RIGHT), trace(PointMotion::THROUGH_WALLS));
    let mut shown = 0;
    for (x, y) in (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y))) {
        let is_sphere = *free.object_id.at(x, y) == 1;
        assert_eq!(*through.object_id.at(x, y) == 1, is_sphere, "({x}, {y})");
        let is_hidden = is_sphere && *right.object_id.at(x, y) == 2;
        shown += usize::from(is_hidden);
        let [through, right] = [&through, &right].map(|frame| *frame.velocity.at(x, y));
        assert_eq!(through == right, !is_hidden, "({x}, {y})");
        assert!(!is_hidden || right == [0.0; 2], "({x}, {y})");
    }
    assert!(shown > 10, "{shown} pixels of the sphere are hidden");
}

#[test]
fn a_grid_of_half_the_size_is_the_picture_at_half_the_size() {
    let half = render_on([WIDTH / 2, HEIGHT / 2], [0.0; 2]);
    let rendered = render_frame(&drifting_sphere(), &settings([WIDTH / 2, HEIGHT / 2]));
    assert_eq!(half.color, rendered.color);
    assert_eq!(half.depth, rendered.depth);
    assert_eq!(half.camera, rendered.camera);
    let fastest = rendered.velocity.pixels.iter().map(|v| v[0].hypot(v[1]));
    assert!(fastest.fold(0.0, f32::max) > 0.3, "the sphere moves");
    for (half, rendered) in half.velocity.pixels.iter().zip(&rendered.velocity.pixels) {
        let off = (half[0] - rendered[0]).hypot(half[1] - rendered[1]);
        // Rounding of 64-bit positions to 32-bit velocities of a few pixels.
        assert!(off < 1e-6, "{half:?} {rendered:?}");
    }
    let pairs = [&half, &rendered].map(|frame| frame.reprojection.place([7.5, 3.5], 4.0).unwrap());
    for axis in 0..2 {
        assert!((pairs[0][axis] - pairs[1][axis]).abs() < 1e-9, "{pairs:?}");
    }
}

#[test]
fn pixels_that_are_not_square_cover_the_whole_picture() {
    // 36 x 24 at two thirds is 24 x 16; 24 x 12 squeezes it.
    let squeezed = render_on([24, 12], [0.0; 2]);
    let whole = render_on([24, 24], [0.0; 2]);
    for (x, y) in (0..12).flat_map(|y| (0..24).map(move |x| (x, y))) {
        let rows = [2 * y, 2 * y + 1].map(|row| *whole.object_id.at(x, row));
        let id = *squeezed.object_id.at(x, y);
        assert!(rows[0] != rows[1] || id == rows[0], "at {x}, {y}");
        if id == rows[0] && id == rows[1] {
            let rows = [2 * y, 2 * y + 1].map(|row| whole.velocity.at(x, row));
            let middle = [0, 1].map(|axis| 0.5 * (rows[0][axis] + rows[1][axis]));
            let velocity = squeezed.velocity.at(x, y);
            // The squeezed picture's pixels are twice as high.
            let off = [velocity[0] - middle[0], velocity[1] - 0.5 * middle[1]];
            let is_near = off.iter().all(|axis| axis.abs() < 0.03);
            assert!(is_near, "{velocity:?} {middle:?}");
        }
    }
}

#[test]
fn a_grid_without_pixels_is_refused() {
    let grid = PixelGrid::of_picture(0, 4);
    let settings = settings([WIDTH, HEIGHT]);
    let refused = trace_frame_part(&drifting_sphere(), &settings, &grid, None, &unwatched);
    assert!(matches!(
        refused,
        Err(TraceError::Size(SizeError { width: 0, .. }))
    ));
}
