//! Formats in which an engine stores the input of its motion blur, and its policy at the border.

use clap::ValueEnum;
use frame::{FAR_DEPTH, Frame, Plane, Raster, Vectors};
use half::f16;
use serde::{Deserialize, Serialize};

/// Near plane that reversed depth is reckoned with, in metres.
const NEAR: f64 = 0.1;
/// Tile, and longest half-velocity, of McGuire et al. 2012, in pixels.
const TILE: f64 = 20.0;
/// Longest half-velocity of KinoMotion, as a part of the picture's height.
const KINO_RADIUS: f64 = 0.05;
/// Widest border that is filled up, in pixels.
const WIDEST: u32 = 256;

/// How screen motion is stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[value(rename_all = "snake_case")]
#[serde(rename_all = "snake_case")]
pub enum VelocityFormat {
    /// 32-bit floats of pixels.
    #[default]
    Float32,
    /// 16-bit floats of pixels.
    Float16,
    /// Twice 8 bits, linear: 0.5 + 0.5 x, where 1 is the whole way from the centre to the border. Standing still is none of the
    /// values.
    Linear8,
    /// Three times 8 bits: the unit direction, linear, and the square root of the length, where 1 is the way from the
    /// centre to the border.
    PolarSqrt8,
    /// Twice 10 bits of half the smear, linear up to a twentieth of the picture's height, as KinoMotion packs it.
    Kino10,
    /// Half the smear, no longer than a tile of 20 pixels and no shorter than half a pixel (McGuire et al. 2012).
    TileClamped,
}

/// How depth is stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[value(rename_all = "snake_case")]
#[serde(rename_all = "snake_case")]
pub enum DepthFormat {
    /// Metres as 32-bit floats.
    #[default]
    Float32,
    /// Metres as 16-bit floats.
    Float16,
    /// Near plane / depth in 24 bits; the near plane at 0.1 m.
    Reversed24,
    /// Near plane / depth as 32-bit floats.
    Reversed32,
}

/// What lies beyond the border of what the filter reads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[value(rename_all = "snake_case")]
#[serde(rename_all = "snake_case")]
pub enum Border {
    /// What the filter itself makes of it.
    #[default]
    Leave,
    /// The outermost pixels again, as far as the longest smear reaches.
    Clamp,
}

/// The form in which a filter gets its frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct InputFormat {
    /// Of the velocity buffer.
    pub velocity: VelocityFormat,
    /// Of the depth buffer.
    pub depth: DepthFormat,
    /// Beyond the picture.
    pub border: Border,
}

impl InputFormat {
    /// The full form, and then each of the others alone: what each costs is told by what it changes.
    pub fn one_by_one(
        velocities: &[VelocityFormat],
        depths: &[DepthFormat],
        borders: &[Border],
    ) -> Vec<Self> {
        let full = Self::default();
        let mut formats = vec![full];
        formats.extend(velocities.iter().map(|&velocity| Self { velocity, ..full }));
        formats.extend(depths.iter().map(|&depth| Self { depth, ..full }));
        formats.extend(borders.iter().map(|&border| Self { border, ..full }));
        let mut once = Vec::new();
        for format in formats {
            if !once.contains(&format) {
                once.push(format);
            }
        }
        once
    }

    /// What differs from the full form, as the command line says it: `velocity=float16`; none for the full form.
    pub fn change(&self) -> Option<String> {
        let word = |value: &dyn Fn() -> Option<clap::builder::PossibleValue>| {
            let value = value().expect("every form has a name");
            value.get_name().to_owned()
        };
        let full = Self::default();
        let mut changes = Vec::new();
        if self.velocity != full.velocity {
            changes.push(format!(
                "velocity={}",
                word(&|| self.velocity.to_possible_value())
            ));
        }
        if self.depth != full.depth {
            changes.push(format!(
                "depth={}",
                word(&|| self.depth.to_possible_value())
            ));
        }
        if self.border != full.border {
            changes.push(format!(
                "border={}",
                word(&|| self.border.to_possible_value())
            ));
        }
        (!changes.is_empty()).then(|| changes.join(","))
    }

    /// The frame as it comes out of these buffers. A border that is filled up becomes a part of the guard band.
    pub fn of(&self, frame: &Frame) -> Frame {
        let stored = Frame {
            velocity: self.velocity.of(frame),
            depth: self.depth.of(&frame.depth),
            ..frame.clone()
        };
        match self.border {
            Border::Leave => stored,
            Border::Clamp => {
                let margin = longest_smear(frame).ceil().min(f64::from(WIDEST)) as u32;
                widened(&stored, margin)
            }
        }
    }
}

impl VelocityFormat {
    fn of(self, frame: &Frame) -> Vectors {
        let picture = [frame.color.width, frame.color.height]
            .map(|side| f64::from(side - 2 * frame.guard_band));
        let half_smear = 0.5 * frame.exposure;
        frame.velocity.map(|velocity| {
            let stored = velocity.map(f64::from);
            match self {
                VelocityFormat::Float32 => *velocity,
                VelocityFormat::Float16 => velocity.map(|part| f16::from_f32(part).to_f32()),
                VelocityFormat::Linear8 => linear8(stored, picture),
                VelocityFormat::PolarSqrt8 => polar_sqrt8(stored, picture),
                VelocityFormat::Kino10 => {
                    let radius = KINO_RADIUS * picture[1];
                    kino10(stored.map(|part| part * half_smear), radius)
                        .map(|part| (part / half_smear) as f32)
                }
                VelocityFormat::TileClamped => tile_clamped(stored.map(|part| part * half_smear))
                    .map(|part| (part / half_smear) as f32),
            }
        })
    }
}

impl DepthFormat {
    fn of(self, depth: &Plane) -> Plane {
        depth.map(|&depth| match self {
            DepthFormat::Float32 => depth,
            // The background is told apart by being far, and stays so.
            _ if depth == FAR_DEPTH => depth,
            DepthFormat::Float16 => f16::from_f32(depth).to_f32().min(f16::MAX.to_f32()),
            DepthFormat::Reversed24 => {
                let stored = unorm(NEAR / f64::from(depth), 24);
                if stored > 0.0 {
                    (NEAR / stored) as f32
                } else {
                    FAR_DEPTH
                }
            }
            DepthFormat::Reversed32 => {
                let stored = (NEAR / f64::from(depth)) as f32;
                (NEAR / f64::from(stored)) as f32
            }
        })
    }
}

/// A number in [0, 1] in so many bits.
fn unorm(value: f64, bits: u32) -> f64 {
    let steps = f64::from((1_u32 << bits) - 1);
    (value.clamp(0.0, 1.0) * steps).round() / steps
}

fn linear8(velocity: [f64; 2], picture: [f64; 2]) -> [f32; 2] {
    [0, 1].map(|axis| {
        let to_border = 0.5 * picture[axis];
        let stored = unorm(0.5 + 0.5 * velocity[axis] / to_border, 8);
        ((2.0 * stored - 1.0) * to_border) as f32
    })
}

fn polar_sqrt8(velocity: [f64; 2], picture: [f64; 2]) -> [f32; 2] {
    let parts = [0, 1].map(|axis| velocity[axis] / (0.5 * picture[axis]));
    let length = parts[0].hypot(parts[1]);
    if length == 0.0 {
        return [0.0; 2];
    }
    let stored = unorm(length.sqrt(), 8).powi(2);
    [0, 1].map(|axis| {
        let direction = 2.0 * unorm(0.5 + 0.5 * parts[axis] / length, 8) - 1.0;
        (direction * stored * 0.5 * picture[axis]) as f32
    })
}

fn kino10(half: [f64; 2], radius: f64) -> [f64; 2] {
    let length = half[0].hypot(half[1]);
    let shortened = (radius / length).min(1.0);
    half.map(|part| {
        let unit = if length > 0.0 {
            part * shortened / radius
        } else {
            0.0
        };
        // 512 of 1023 stands for 0, so that what stands still does.
        let stored = (512.0 + 511.0 * unit).round();
        (stored - 512.0) / 511.0 * radius
    })
}

fn tile_clamped(half: [f64; 2]) -> [f64; 2] {
    let length = half[0].hypot(half[1]);
    if length == 0.0 {
        return half;
    }
    half.map(|part| part / length * length.clamp(0.5, TILE))
}

/// Pixels that the fastest pixel covers while the shutter is open.
fn longest_smear(frame: &Frame) -> f64 {
    let speeds = frame.velocity.pixels.iter().map(|v| v[0].hypot(v[1]));
    f64::from(speeds.fold(0.0, f32::max)) * frame.exposure
}

/// The frame with its outermost pixels repeated on every side.
fn widened(frame: &Frame, margin: u32) -> Frame {
    fn wide<T: Clone>(raster: &Raster<T>, margin: u32) -> Raster<T> {
        let inside = |place: u32, side: u32| place.saturating_sub(margin).min(side - 1);
        let [width, height] = [raster.width, raster.height];
        Raster::from_fn(width + 2 * margin, height + 2 * margin, |x, y| {
            raster.at(inside(x, width), inside(y, height)).clone()
        })
    }
    Frame {
        guard_band: frame.guard_band + margin,
        color: wide(&frame.color, margin),
        velocity: wide(&frame.velocity, margin),
        depth: wide(&frame.depth, margin),
        object_id: wide(&frame.object_id, margin),
        coverage: (frame.coverage.iter())
            .map(|plane| wide(plane, margin))
            .collect(),
        ..frame.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PICTURE: [f64; 2] = [640.0, 360.0];

    #[test]
    fn eight_linear_bits_err_by_half_a_step_and_do_not_know_stillness() {
        let step = 320.0 / 255.0 * 2.0;
        for speed in [-300.0, -3.0, 0.0, 0.7, 40.0] {
            let [x, _] = linear8([speed, 0.0], PICTURE);
            assert!(
                (f64::from(x) - speed).abs() <= 0.5 * step + 1e-4,
                "{x} for {speed}"
            );
        }
        let [x, y] = linear8([0.0, 0.0], PICTURE);
        // 128 of 255 is 1 / 255 too much.
        assert!((x - 320.0 / 255.0).abs() < 1e-4 && (y - 180.0 / 255.0).abs() < 1e-4);
    }

    #[test]
    fn a_square_root_makes_slow_motion_finer() {
        assert_eq!(polar_sqrt8([0.0, 0.0], PICTURE), [0.0, 0.0]);
        let error = |speed: f64| (f64::from(polar_sqrt8([speed, 0.0], PICTURE)[0]) - speed).abs();
        // The step of the square is twice the root times the root's step.
        for speed in [0.1, 1.0, 10.0, 100.0] {
            let root = (speed / 320.0_f64).sqrt();
            let half_step = 320.0 * (2.0 * root + 1.0 / 255.0) * 0.5 / 255.0;
            assert!(
                error(speed) <= half_step + 0.01 * speed,
                "{} at {speed}",
                error(speed)
            );
        }
        assert!(error(1.0) < 0.1 && linear8([1.0, 0.0], PICTURE)[0] > 1.2);
    }

    #[test]
    fn kino_keeps_stillness_and_cuts_at_its_radius() {
        assert_eq!(kino10([0.0, 0.0], 18.0), [0.0, 0.0]);
        let [x, y] = kino10([30.0, -40.0], 18.0);
        assert!((x.hypot(y) - 18.0).abs() < 0.05 && (x / -y - 0.75).abs() < 0.01);
        let [x, _] = kino10([5.0, 0.0], 18.0);
        assert!((x - 5.0).abs() <= 0.5 * 18.0 / 511.0 + 1e-9);
    }

    #[test]
    fn a_tile_bounds_motion_on_both_sides() {
        assert_eq!(tile_clamped([0.0, 0.0]), [0.0, 0.0]);
        assert_eq!(tile_clamped([0.0, -90.0]), [0.0, -20.0]);
        assert_eq!(tile_clamped([0.125, 0.0]), [0.5, 0.0]);
        assert_eq!(tile_clamped([3.0, 4.0]), [3.0, 4.0]);
    }

    #[test]
    fn reversed_depth_is_finest_near_and_background_stays_far() {
        let depths = Raster {
            width: 4,
            height: 1,
            pixels: vec![0.5_f32, 30.0, 900.0, FAR_DEPTH],
        };
        let errors = |format: DepthFormat| -> Vec<f32> {
            let stored = format.of(&depths);
            assert_eq!(stored.pixels[3], FAR_DEPTH);
            let pairs = stored.pixels.iter().zip(&depths.pixels);
            pairs.map(|(a, b)| (a - b).abs()).collect()
        };
        // z^2 / near steps of 2^-24, half of one at most.
        let reversed = errors(DepthFormat::Reversed24);
        for (error, depth) in reversed.iter().zip(&depths.pixels).take(3) {
            assert!(*error <= depth * depth / 0.1 * 0.51 / 16_777_215.0 + depth * 1e-7);
        }
        assert!(reversed[2] > 0.01);
        // Ten bits after the leading one.
        let half = errors(DepthFormat::Float16);
        assert!(half[2] <= 900.0 / 2048.0 && errors(DepthFormat::Reversed32)[2] < 1e-3);
    }

    #[test]
    fn each_form_is_tried_alone_and_once() {
        let formats = InputFormat::one_by_one(
            &[VelocityFormat::Float32, VelocityFormat::Linear8],
            &[DepthFormat::Float16],
            &[Border::Clamp, Border::Leave],
        );
        let changes: Vec<_> = formats.iter().map(|format| format.change()).collect();
        let said = |text: &str| Some(text.to_owned());
        assert_eq!(
            changes,
            [
                None,
                said("velocity=linear8"),
                said("depth=float16"),
                said("border=clamp")
            ]
        );
    }
}
