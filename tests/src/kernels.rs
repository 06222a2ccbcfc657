//! Taps of every filter on a surface that moves evenly, in closed form, from the published
//! descriptions.
//!
//! All taps are on one surface there, so a filter consists only of the positions and weights of its
//! taps.

mod babylon;
mod dagor;
mod gathers;
mod godot;
mod jimenez;
mod kino;
mod tiles;

pub use babylon::babylon_trail;
pub use gathers::{jump_flood_trail, three_trail};
pub use tiles::{cone, cylinder, half_velocity};

use crate::ramp::Ramp;
use crate::vector::{direction, dot, scaled};

/// Even motion, with the exposure and the size of the picture.
#[derive(Clone, Copy, Debug)]
pub struct Steady {
    /// Motion, in pixels per frame, +x right, +y down.
    pub velocity: [f64; 2],
    /// Exposure, in frames.
    pub exposure: f64,
    /// Width and height, in pixels.
    pub size: [u32; 2],
}

/// A pixel in an average.
#[derive(Clone, Copy, Debug)]
pub struct Tap {
    /// Offset from the averaged pixel, in pixels.
    pub offset: [f64; 2],
    /// Weight.
    pub weight: f64,
}

impl Steady {
    /// Returns the motion while the shutter is open, in pixels.
    pub fn trail(&self) -> [f64; 2] {
        scaled(self.velocity, self.exposure)
    }

    fn size(&self) -> [f64; 2] {
        self.size.map(f64::from)
    }
}

/// Predicts a filter preset's ramp of an edge across the motion; its middle is relative to the
/// edge.
pub fn expected_ramp(filter: &str, preset: &str, steady: &Steady) -> Ramp {
    // Noise is uniform in [0, 1).
    let steps = 1000;
    let averages = (0..steps).map(|step| {
        let noise = (f64::from(step) + 0.5) / f64::from(steps);
        let taps = place_taps(filter, preset, steady, noise);
        let total: f64 = taps.iter().map(|tap| tap.weight).sum();
        // A tap at an offset brings the edge here from there: the ramp is on the other side.
        taps.into_iter()
            .map(move |tap| (-along_motion(steady, tap.offset), tap.weight / total))
    });
    Ramp::spread(averages.flatten())
}

/// Returns true for a preset that sees the motion of the camera alone.
pub fn sees_camera_only(filter: &str, preset: &str) -> bool {
    matches!(
        (filter, preset),
        ("camera_gather" | "babylon_screen", _) | ("urp", "camera_only")
    )
}

/// Returns the taps of one pixel with this noise value in [0, 1).
pub fn place_taps(filter: &str, preset: &str, steady: &Steady, noise: f64) -> Vec<Tap> {
    match filter {
        "identity" => vec![tap_here(1.0)],
        "velocity_gather" | "camera_gather" => gathers::plain(preset, steady),
        // The packed flood paints the same pixels.
        "jump_flood" | "jump_flood_packed" => gathers::jump_flood(preset, steady, noise),
        "bevy" => gathers::bevy(preset, steady, noise),
        "blender" => gathers::blender(preset, steady, noise),
        "babylon" => babylon::by_object(steady),
        "babylon_screen" => babylon::by_camera(steady),
        "three" => gathers::three(preset, steady),
        "centred_gather" => gathers::centred(preset, steady),
        "realism_effects" => gathers::realism_effects(steady, noise),
        "jimenez" => jimenez::place_taps(preset, steady, noise),
        "kino" => kino::place_taps(preset, steady, noise),
        "urp" => gathers::urp(preset, steady, noise),
        "vort" => gathers::vort(steady, noise),
        "dagor" => dagor::place_taps(preset, steady, noise),
        "godot" => godot::place_taps(preset, steady, noise),
        "mcguire" => tiles::mcguire(preset, steady, noise),
        "guertin" => tiles::guertin(steady, noise),
        _ => panic!("say here what {filter} averages"),
    }
}

/// Returns the part of an offset along the motion, in pixels.
pub fn along_motion(steady: &Steady, offset: [f64; 2]) -> f64 {
    dot(offset, direction(steady.velocity, [1.0, 0.0]))
}

/// Makes a tap on the pixel itself.
fn tap_here(weight: f64) -> Tap {
    tap([0.0, 0.0], weight)
}

fn tap(offset: [f64; 2], weight: f64) -> Tap {
    Tap { offset, weight }
}

/// Splits a tap between pixels into the four around it.
fn bilinear(offset: [f64; 2], weight: f64) -> [Tap; 4] {
    let low = offset.map(f64::floor);
    let part = [offset[0] - low[0], offset[1] - low[1]];
    [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|corner| {
        let share = |axis: usize| match corner[axis] {
            0.0 => 1.0 - part[axis],
            _ => part[axis],
        };
        let offset = [low[0] + corner[0], low[1] + corner[1]];
        tap(offset, weight * share(0) * share(1))
    })
}

fn nearest(offset: f64) -> f64 {
    (offset + 0.5).floor()
}

/// Makes a tap of weight 1 on the nearest pixel.
fn nearest_tap(offset: [f64; 2]) -> Tap {
    tap(offset.map(nearest), 1.0)
}

/// Makes taps of equal weight at these parts of a trail, read between pixels.
fn on_trail(trail: [f64; 2], parts: impl IntoIterator<Item = f64>) -> Vec<Tap> {
    let taps = parts.into_iter().map(|part| scaled(trail, part));
    taps.flat_map(|offset| bilinear(offset, 1.0)).collect()
}

/// Makes taps of equal weight at the nearest pixels to these parts of a trail.
fn at_pixels(trail: [f64; 2], parts: impl Iterator<Item = f64>) -> Vec<Tap> {
    parts.map(|part| nearest_tap(scaled(trail, part))).collect()
}
