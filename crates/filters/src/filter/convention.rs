//! Conventions of engines: units of velocity and depth, and formats of their textures.

use serde::{Deserialize, Serialize};

use crate::Format;

/// Form in which a shader expects its textures. The default is that of frames: velocity in pixels per frame, +x right, +y down,
/// and depth in metres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Convention {
    /// Unit of velocity.
    pub velocity: VelocityUnit,
    /// Direction of its +y.
    pub velocity_y: VerticalDirection,
    /// Order of the two places that it is the difference of.
    pub velocity_sign: VelocitySign,
    /// Time in which a surface moves that far.
    pub velocity_per: VelocityTime,
    /// Frame rate, for velocity per second.
    pub frames_per_second: Option<f64>,
    /// Factor on velocity after all that; 1 if left out.
    pub velocity_scale: Option<f64>,
    /// Format of the velocity texture; `rg32float` if left out.
    pub velocity_format: Option<Format>,
    /// Meaning of depth.
    pub depth: DepthKind,
    /// Distance of the near plane in metres.
    pub near: Option<f64>,
    /// Distance of the far plane in metres; infinite if left out.
    pub far: Option<f64>,
    /// Format of the depth texture; `r32float` if left out.
    pub depth_format: Option<Format>,
    /// Factor on colour, such as a pre-exposure; the output is divided by it. 1 if left out.
    pub color_scale: Option<f64>,
    /// Format of the colour texture; `rgba32float` if left out.
    pub color_format: Option<Format>,
    /// Format of the output of a fragment shader; `rgba32float` if left out.
    pub output_format: Option<Format>,
}

/// Unit of velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VelocityUnit {
    /// Pixels.
    #[default]
    Pixels,
    /// Texture coordinates: 1 is the width or the height of the picture.
    Uv,
    /// Normalised device coordinates: 2 is the width or the height.
    Ndc,
}

/// Direction of +y.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VerticalDirection {
    /// Towards the bottom of the picture.
    #[default]
    Down,
    /// Towards its top.
    Up,
}

/// Sign of velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VelocitySign {
    /// Towards the place where the surface moves to.
    #[default]
    CurrentMinusPrevious,
    /// Towards the place where it came from.
    PreviousMinusCurrent,
}

/// Time that velocity is over.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VelocityTime {
    /// One frame.
    #[default]
    Frame,
    /// The time that the shutter is open.
    Shutter,
    /// One second.
    Second,
}

/// Meaning of depth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DepthKind {
    /// Distance along the view axis in metres.
    #[default]
    Linear,
    /// 0 at the near plane and 1 at the far plane, as a depth buffer has it.
    Forward,
    /// 1 at the near plane and 0 at the far plane.
    Reversed,
}

impl Convention {
    /// Refuses numbers that make no sense, and keys that miss others.
    pub(crate) fn check(&self) -> Result<(), String> {
        let positive = [
            ("frames_per_second", self.frames_per_second),
            ("near", self.near),
            ("far", self.far),
            ("color_scale", self.color_scale),
        ];
        for (name, value) in positive {
            if let Some(value) = value.filter(|value| !(value.is_finite() && *value > 0.0)) {
                return Err(format!(
                    "{name} = {value}; allowed: a finite number above 0"
                ));
            }
        }
        if let Some(scale) = self
            .velocity_scale
            .filter(|it| !it.is_finite() || *it == 0.0)
        {
            return Err(format!(
                "velocity_scale = {scale}; allowed: a finite number other than 0"
            ));
        }
        if self.velocity_per == VelocityTime::Second && self.frames_per_second.is_none() {
            return Err("velocity_per = \"second\" needs frames_per_second".into());
        }
        match (self.depth, self.near, self.far) {
            (DepthKind::Linear, None, None) => {}
            (DepthKind::Linear, ..) => {
                return Err("near and far are for depth = \"forward\" or \"reversed\"".into());
            }
            (_, None, _) => return Err("depth of a depth buffer needs near, in metres".into()),
            (_, Some(near), Some(far)) if far <= near => {
                return Err(format!("far = {far} is not beyond near = {near}"));
            }
            _ => {}
        }
        let formats = [
            ("color_format", self.color_format, 4),
            ("velocity_format", self.velocity_format, 2),
            ("depth_format", self.depth_format, 1),
            ("output_format", self.output_format, 4),
        ];
        for (name, format, components) in formats {
            let Some(format) = format else { continue };
            let fits = format.components() == components
                || name == "velocity_format" && format.components() == 4;
            if !fits || !format.is_float() {
                return Err(format!(
                    "{name} = \"{}\" does not hold {components} floats; allowed: a format of 16-bit or 32-bit floats with \
                     {components}{}",
                    format.name(),
                    if name == "velocity_format" {
                        " or 4"
                    } else {
                        ""
                    }
                ));
            }
        }
        Ok(())
    }

    /// Converts velocity in pixels per frame.
    pub(crate) fn convert_velocity(
        &self,
        pixels: &[[f32; 2]],
        [width, height]: [u32; 2],
        exposure: f64,
    ) -> Vec<f32> {
        let sign = match self.velocity_sign {
            VelocitySign::CurrentMinusPrevious => 1.0,
            VelocitySign::PreviousMinusCurrent => -1.0,
        };
        let time = match self.velocity_per {
            VelocityTime::Frame => 1.0,
            VelocityTime::Shutter => exposure,
            VelocityTime::Second => self.frames_per_second.unwrap_or(1.0),
        };
        let y = match self.velocity_y {
            VerticalDirection::Down => 1.0,
            VerticalDirection::Up => -1.0,
        };
        let unit = match self.velocity {
            VelocityUnit::Pixels => [1.0, 1.0],
            VelocityUnit::Uv => [1.0 / f64::from(width), 1.0 / f64::from(height)],
            VelocityUnit::Ndc => [2.0 / f64::from(width), 2.0 / f64::from(height)],
        };
        let common = sign * time * self.velocity_scale.unwrap_or(1.0);
        let factors = [common * unit[0], common * unit[1] * y];
        let convert = |velocity: &[f32; 2]| {
            let [x, y] = *velocity;
            [
                (f64::from(x) * factors[0]) as f32,
                (f64::from(y) * factors[1]) as f32,
            ]
        };
        pixels.iter().flat_map(convert).collect()
    }

    /// Converts depth in metres.
    pub(crate) fn convert_depth(&self, metres: &[f32]) -> Vec<f32> {
        let near = self.near.unwrap_or(1.0);
        let reversed = |z: f64| match self.far {
            None => near / z,
            Some(far) => near * (far - z) / (z * (far - near)),
        };
        let convert = |z: &f32| match self.depth {
            DepthKind::Linear => *z,
            DepthKind::Reversed => reversed(f64::from(*z)).clamp(0.0, 1.0) as f32,
            DepthKind::Forward => (1.0 - reversed(f64::from(*z))).clamp(0.0, 1.0) as f32,
        };
        metres.iter().map(convert).collect()
    }

    /// Returns the format of a texture that every filter has, but for `output`.
    pub(crate) fn input_format(&self, name: &str) -> Format {
        match name {
            "color" => self.color_format.unwrap_or(Format::Rgba32Float),
            "velocity" => self.velocity_format.unwrap_or(Format::Rg32Float),
            _ => self.depth_format.unwrap_or(Format::R32Float),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn godot_gets_the_way_back_in_texture_coordinates() {
        let godot = Convention {
            velocity: VelocityUnit::Uv,
            velocity_sign: VelocitySign::PreviousMinusCurrent,
            ..Convention::default()
        };
        // A quarter of the width to the right, and an eighth of the height down.
        let converted = godot.convert_velocity(&[[20.0, 5.0]], [80, 40], 0.5);
        assert_eq!(converted, [-0.25, -0.125]);
    }

    #[test]
    fn unreal_gets_twice_that_upwards_per_shutter() {
        let unreal = Convention {
            velocity: VelocityUnit::Ndc,
            velocity_y: VerticalDirection::Up,
            velocity_per: VelocityTime::Shutter,
            ..Convention::default()
        };
        let converted = unreal.convert_velocity(&[[20.0, 5.0]], [80, 40], 0.5);
        assert_eq!(converted, [0.25, -0.125]);
    }

    #[test]
    fn a_depth_buffer_has_its_ends_at_its_planes() {
        let planes = |depth, far| Convention {
            depth,
            near: Some(0.5),
            far,
            ..Convention::default()
        };
        let z = [0.5, 1.0, 8.0, 1e10];
        let forward = planes(DepthKind::Forward, Some(8.0)).convert_depth(&z);
        let reversed = planes(DepthKind::Reversed, Some(8.0)).convert_depth(&z);
        // (8 - 1) / 1 x 0.5 / 7.5.
        assert_eq!(reversed, [1.0, (0.5 * 7.0 / 7.5) as f32, 0.0, 0.0]);
        for (forward, reversed) in forward.iter().zip(&reversed) {
            assert!((forward + reversed - 1.0).abs() < 1e-6);
        }
        let infinite = planes(DepthKind::Reversed, None).convert_depth(&z);
        assert_eq!(infinite, [1.0, 0.5, 0.0625, 5e-11]);
    }

    #[test]
    fn conventions_that_say_too_little_are_refused() {
        let default = Convention::default();
        for (convention, says) in [
            (
                Convention {
                    velocity_per: VelocityTime::Second,
                    ..default
                },
                "frames_per_second",
            ),
            (
                Convention {
                    depth: DepthKind::Reversed,
                    ..default
                },
                "needs near",
            ),
            (
                Convention {
                    near: Some(1.0),
                    ..default
                },
                "are for depth",
            ),
            (
                Convention {
                    color_scale: Some(-1.0),
                    ..default
                },
                "color_scale = -1",
            ),
            (
                Convention {
                    velocity_scale: Some(0.0),
                    ..default
                },
                "velocity_scale = 0",
            ),
            (
                Convention {
                    color_format: Some(Format::Rg32Float),
                    ..default
                },
                "does not hold 4",
            ),
        ] {
            let refusal = convention.check().unwrap_err();
            assert!(refusal.contains(says), "{refusal}");
        }
        assert_eq!(default.check(), Ok(()));
    }
}
