//! The scene `sliding_panel` with a larger panel that faces its motion, at any speed.

use frame::{Alignment, Frame, Plane, Raster};
use glam::{DQuat, DVec2, DVec3};
use tests::kernels::Steady;
use tests::ramp::Ramp;
use tests::{half_plane, unwatched};
use tracer::{Key, Motion, RenderSettings, Scene, load_scene, trace_frame, trace_truth};

pub const WIDTH: u32 = 256;
pub const HEIGHT: u32 = 144;
/// Metres per pixel: the scene shows 3.6 m from top to bottom.
const METRES_PER_PIXEL: f64 = 3.6 / HEIGHT as f64;
/// Factor on the panel of 0.8 m, which makes it longer than the longest trail by a band on either side.
const SCALE: f64 = 3.4;
/// Distance from the panel's middle to its edges, in pixels.
pub const HALF_PANEL: f64 = 0.5 * 0.8 * SCALE / METRES_PER_PIXEL;
/// Half the width, in pixels, of the band that edges are measured along.
pub const HALF_BAND: f64 = 16.0;
/// Half the width of the tent, in pixels. The rows of pixels in a tilted band are up to 0.7 apart; a narrower tent would resolve them.
const TENT: f64 = 2.0;

/// A moving panel at the middle of the picture.
pub struct Shot {
    /// Speed, in pixels per frame.
    pub speed: f64,
    /// Angle of the motion in degrees: 0 to the right, 90 upwards.
    pub degrees: f64,
    /// Exposure, in frames.
    pub exposure: f64,
    pub frame: Frame,
    /// White behind the panel's middle and black ahead of it, as if painted on the panel and on everything beyond.
    pub painted: Plane,
    /// The painted edge, and the light along the panel's motion at the instant.
    pub painted_ramp: Ramp,
    pub matte_profile: Vec<(f64, f64)>,
    /// Index of the panel among the objects.
    panel: usize,
    scene: Scene,
}

impl Shot {
    pub fn new(speed: f64, degrees: f64, exposure: f64) -> Self {
        let folder = tests::scenes().join("sliding_panel");
        let mut scene = load_scene(&folder, None).unwrap();
        let turned = DQuat::from_rotation_z(degrees.to_radians());
        let step = turned * DVec3::X * speed * METRES_PER_PIXEL;
        let mut objects = scene.objects.iter_mut();
        let panel = objects.find(|object| object.name == "panel");
        let panel = panel.expect("the scene has a panel");
        let key = |time: f64| Key {
            time,
            translation: time * step,
            orientation: turned,
            scale: DVec3::new(SCALE, SCALE, 1.0),
            ..Key::REST
        };
        panel.motion = Motion {
            keys: vec![key(-1.0), key(1.0)],
            ..Motion::default()
        };
        let direction = direction(degrees);
        let painted = Raster::from_fn(WIDTH, HEIGHT, |x, y| {
            let pixel = DVec2::new(f64::from(x), f64::from(y));
            half_plane::area(pixel, direction, direction.dot(middle())) as f32
        });
        let frame = trace_frame(&scene, &render_settings(4, exposure), &unwatched).unwrap();
        let panel = frame.objects.iter().position(|name| name == "panel");
        let panel = panel.expect("the frame lists the panel");
        Self {
            speed,
            degrees,
            exposure,
            painted_ramp: Ramp::of(&measure_profile(&painted, direction, speed)),
            painted,
            matte_profile: measure_profile(&frame.coverage[panel], direction, speed),
            frame,
            panel,
            scene,
        }
    }

    pub fn direction(&self) -> DVec2 {
        direction(self.degrees)
    }

    /// Returns the distance from the middle of the picture to its border along the motion, in pixels.
    pub fn to_border(&self) -> f64 {
        let [across, down] = self.direction().to_array().map(f64::abs);
        (middle().x / across).min(middle().y / down)
    }

    pub fn steady(&self) -> Steady {
        Steady {
            velocity: (self.speed * self.direction()).to_array(),
            exposure: self.exposure,
            size: [WIDTH, HEIGHT],
        }
    }

    /// Returns the part of each pixel that the panel covers at the instant.
    pub fn matte(&self) -> &Plane {
        &self.frame.coverage[self.panel]
    }

    /// Returns the part of each pixel that the panel covers while the shutter is open.
    pub fn true_matte(&self, alignment: Alignment) -> Plane {
        let settings = render_settings(32, self.exposure);
        let truth = trace_truth(&self.scene, &settings, alignment, &unwatched).unwrap();
        let [first, second] = truth.halves.map(|half| half.coverage[self.panel].clone());
        first.zip(&second, |a, b| 0.5 * (a + b))
    }

    pub fn profile(&self, plane: &Plane) -> Vec<(f64, f64)> {
        measure_profile(plane, self.direction(), self.speed)
    }
}

/// Returns the direction of a motion, +y down.
fn direction(degrees: f64) -> DVec2 {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    DVec2::new(cosine, -sine)
}

/// Measures the brightness along the motion, at every whole pixel from the panel's middle: the mean over a band, smoothed by a tent.
fn measure_profile(plane: &Plane, direction: DVec2, speed: f64) -> Vec<(f64, f64)> {
    let reach = (HALF_PANEL + speed + 16.0).ceil() as i32;
    let mut sums = vec![(0.0, 0.0); (2 * reach + 1) as usize];
    for (index, value) in plane.pixels.iter().enumerate() {
        let (x, y) = (index as u32 % WIDTH, index as u32 / WIDTH);
        let from_middle = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5) - middle();
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

fn render_settings(samples_per_pixel: u32, exposure: f64) -> RenderSettings {
    RenderSettings {
        width: WIDTH,
        height: HEIGHT,
        exposure: Some(exposure),
        samples_per_pixel,
        replicates: 2,
        ..RenderSettings::default()
    }
}

fn middle() -> DVec2 {
    0.5 * DVec2::new(f64::from(WIDTH), f64::from(HEIGHT))
}
