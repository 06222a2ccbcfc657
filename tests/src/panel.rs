//! The scene `sliding_panel` with a larger panel that faces its motion, at any speed.

use frame::{Alignment, Frame, Plane, Raster};
use glam::{DQuat, DVec2, DVec3};
use scene::{Key, Motion, Scene, load_scene};
use tracer::{RenderSettings, trace_frame, trace_truth};

use crate::kernels::Steady;
use crate::ramp::Ramp;
use crate::{half_plane, unwatched};

/// Height in metres of what the scene shows.
const VIEW: f64 = 3.6;
/// Factor on the panel of 0.8 m, which makes it longer than the longest trail by a band on either
/// side.
const SCALE: f64 = 3.4;
/// Side of the scene's panel, in metres.
const PANEL: f64 = 0.8;
/// Half the width, in pixels, of the band that edges are measured along.
pub const HALF_BAND: f64 = 16.0;
/// Half the width of the tent, in pixels. The rows of pixels in a tilted band are up to 0.7 apart;
/// a narrower tent would resolve them.
const TENT: f64 = 2.0;

/// Size of pictures of a shot, unless another is given.
pub const SMALL: [u32; 2] = [256, 144];

/// The thing that moves in a shot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mover {
    /// The panel, before a still camera.
    Panel,
    /// The camera, in the opposite direction: the panel moves alike in the picture, and the wall
    /// behind it moves too, but less.
    Camera,
}

/// A moving panel at the middle of the picture.
pub struct Shot {
    /// Width and height, in pixels.
    pub size: [u32; 2],
    /// Speed, in pixels per frame.
    pub speed: f64,
    /// Angle of the motion in degrees: 0 to the right, 90 upwards.
    pub degrees: f64,
    /// Exposure, in frames.
    pub exposure: f64,
    /// The scene at the instant.
    pub frame: Frame,
    /// White behind the panel's middle and black ahead of it, as if painted on the panel and on
    /// everything beyond.
    pub painted: Plane,
    /// The painted edge.
    pub painted_ramp: Ramp,
    /// The light of the panel's matte along its motion at the instant.
    pub matte_profile: Vec<(f64, f64)>,
    /// Index of the panel among the objects.
    panel: usize,
    scene: Scene,
}

impl Shot {
    /// Traces a small shot of a panel that moves by `speed` pixels per frame towards `degrees`.
    pub fn new(speed: f64, degrees: f64, exposure: f64) -> Self {
        Self::of(Mover::Panel, SMALL, [speed, degrees, exposure])
    }

    /// Traces a shot of this size with a speed in pixels per frame, an angle in degrees, and an
    /// exposure in frames.
    pub fn of(mover: Mover, size: [u32; 2], motion: [f64; 3]) -> Self {
        Self::trace(mover, size, 4, motion)
    }

    /// Traces a shot for its motion and depth, which pixel centres have: with a sample of colour,
    /// in half the time.
    pub fn of_motion(mover: Mover, size: [u32; 2], motion: [f64; 3]) -> Self {
        Self::trace(mover, size, 1, motion)
    }

    fn trace(
        mover: Mover,
        size: [u32; 2],
        samples_per_pixel: u32,
        [speed, degrees, exposure]: [f64; 3],
    ) -> Self {
        let scene = moving_scene(mover, speed * VIEW / f64::from(size[1]), degrees);
        let (direction, middle) = (direction(degrees), middle(size));
        let painted = Raster::from_fn(size[0], size[1], |x, y| {
            let pixel = DVec2::new(f64::from(x), f64::from(y));
            half_plane::area(pixel, direction, direction.dot(middle)) as f32
        });
        let settings = RenderSettings {
            replicates: 1,
            ..render_settings(size, samples_per_pixel, exposure)
        };
        let frame = trace_frame(&scene, &settings, &unwatched).unwrap();
        let panel = frame.objects.iter().position(|name| name == "panel");
        let panel = panel.expect("the frame lists the panel");
        let reach = reach_of(size, speed);
        Self {
            size,
            speed,
            degrees,
            exposure,
            painted_ramp: Ramp::of(&measure_profile(&painted, direction, reach)),
            painted,
            matte_profile: measure_profile(&frame.coverage[panel], direction, reach),
            frame,
            panel,
            scene,
        }
    }

    /// Returns the distance from the panel's middle to its edges, in pixels.
    pub fn half_panel(&self) -> f64 {
        half_panel(self.size)
    }

    /// Returns the direction of the motion, +y down.
    pub fn direction(&self) -> DVec2 {
        direction(self.degrees)
    }

    /// Returns the distance from the middle of the picture to its border along the motion, in
    /// pixels.
    pub fn to_border(&self) -> f64 {
        let [across, down] = self.direction().to_array().map(f64::abs);
        let middle = middle(self.size);
        (middle.x / across).min(middle.y / down)
    }

    /// Returns the panel's motion.
    pub fn steady(&self) -> Steady {
        Steady {
            velocity: (self.speed * self.direction()).to_array(),
            exposure: self.exposure,
            size: self.size,
        }
    }

    /// Returns the part of each pixel that the panel covers at the instant.
    pub fn matte(&self) -> &Plane {
        &self.frame.coverage[self.panel]
    }

    /// Returns the part of each pixel that the panel covers while the shutter is open.
    pub fn true_matte(&self, alignment: Alignment) -> Plane {
        let settings = render_settings(self.size, 32, self.exposure);
        let truth = trace_truth(&self.scene, &settings, alignment, &unwatched).unwrap();
        let [first, second] = truth.halves.map(|half| half.coverage[self.panel].clone());
        first.zip(&second, |a, b| 0.5 * (a + b))
    }

    /// Measures the brightness along the panel's motion, at every whole pixel from its middle.
    pub fn profile(&self, plane: &Plane) -> Vec<(f64, f64)> {
        measure_profile(plane, self.direction(), reach_of(self.size, self.speed))
    }
}

/// Makes the scene with a panel that moves in the picture by `speed` metres per frame.
fn moving_scene(mover: Mover, speed: f64, degrees: f64) -> Scene {
    let mut scene = load_scene(crate::scenes().join("sliding_panel"), None).unwrap();
    let turned = DQuat::from_rotation_z(degrees.to_radians());
    let step = turned * DVec3::X * speed;
    let slide = |motion: &mut Motion, key: Key, step: DVec3| {
        let keys = [-1.0, 1.0].map(|time| Key {
            time,
            translation: key.translation + time * step,
            ..key
        });
        motion.keys = keys.to_vec();
    };
    let mut objects = scene.objects.iter_mut();
    let panel = objects.find(|object| object.name == "panel");
    let panel = panel.expect("the scene has a panel");
    let key = Key {
        orientation: turned,
        scale: DVec3::new(SCALE, SCALE, 1.0),
        ..Key::REST
    };
    let is_still = mover == Mover::Camera;
    panel.motion = Motion::default();
    slide(
        &mut panel.motion,
        key,
        if is_still { DVec3::ZERO } else { step },
    );
    if is_still {
        let camera = &mut scene.camera.motion;
        let key = camera.keys[0];
        slide(camera, key, -step);
    }
    scene
}

/// Returns the distance from the panel's middle to its edges in pictures of a size, in pixels.
fn half_panel([_, height]: [u32; 2]) -> f64 {
    0.5 * PANEL * SCALE * f64::from(height) / VIEW
}

/// Returns how far from the middle a profile is measured, in pixels.
fn reach_of(size: [u32; 2], speed: f64) -> f64 {
    half_panel(size) + speed + 16.0
}

/// Returns the direction of a motion, +y down.
fn direction(degrees: f64) -> DVec2 {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    DVec2::new(cosine, -sine)
}

/// Measures the brightness along the motion, at every whole pixel from the panel's middle: the mean
/// over a band, smoothed by a tent.
fn measure_profile(plane: &Plane, direction: DVec2, reach: f64) -> Vec<(f64, f64)> {
    let reach = reach.ceil() as i32;
    let middle = middle([plane.width, plane.height]);
    let mut sums = vec![(0.0, 0.0); (2 * reach + 1) as usize];
    for (index, value) in plane.pixels.iter().enumerate() {
        let (x, y) = (index as u32 % plane.width, index as u32 / plane.width);
        let from_middle = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5) - middle;
        if direction.perp_dot(from_middle).abs() > HALF_BAND {
            continue;
        }
        let along = direction.dot(from_middle);
        let first = (along - TENT).ceil() as i32;
        let last = (along + TENT).floor() as i32;
        for position in first.max(-reach)..=last.min(reach) {
            let share = TENT - (f64::from(position) - along).abs();
            let sum = &mut sums[(position + reach) as usize];
            *sum = (sum.0 + share, sum.1 + share * f64::from(*value));
        }
    }
    let positions = (-reach..=reach).map(f64::from).zip(sums);
    // Samples beyond the picture are empty.
    positions
        .filter(|(_, (share, _))| *share > HALF_BAND)
        .map(|(position, (share, sum))| (position, sum / share))
        .collect()
}

fn render_settings(size: [u32; 2], samples_per_pixel: u32, exposure: f64) -> RenderSettings {
    RenderSettings {
        exposure: Some(exposure),
        ..crate::settings_of(size, samples_per_pixel, 2)
    }
}

fn middle([width, height]: [u32; 2]) -> DVec2 {
    0.5 * DVec2::new(f64::from(width), f64::from(height))
}
