//! Conventions of engines: units of velocity and depth, and formats of their textures.

use serde::{Deserialize, Serialize};

use super::layer::Layer;
use crate::Format;

/// Values of a convention that members of uniform blocks may name.
pub(crate) const CONVENTION_VALUES: [&str; 5] = [
    "frames_per_second",
    "delta_time",
    "near",
    "far",
    "color_scale",
];

/// Form in which an engine has its textures. The default is the form of frames: velocity in pixels
/// per frame, +x right, +y down, and depth in metres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Convention {
    /// Corner of the picture where texels, texture coordinates and `gl_FragCoord` begin; the top
    /// left if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub origin: Option<Origin>,
    /// Unit of velocity.
    pub velocity: VelocityUnit,
    /// Direction of its +y; away from the origin if left out.
    pub velocity_y: Option<VerticalDirection>,
    /// Order of the two places in the difference.
    pub velocity_sign: VelocitySign,
    /// Time in which a surface moves that far.
    pub velocity_per: VelocityTime,
    /// Frame rate, for velocity per second. A frame's own rate takes precedence.
    pub frames_per_second: Option<f64>,
    /// Factor on velocity after these conversions; 1 if left out.
    pub velocity_scale: Option<f64>,
    /// Summand on both components of velocity after the factor; 0 if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub velocity_bias: Option<f64>,
    /// Format of the velocity texture; `rg32float` if left out.
    pub velocity_format: Option<Format>,
    /// Meaning of depth.
    pub depth: DepthKind,
    /// Distance of the near plane in metres.
    pub near: Option<f64>,
    /// Distance of the far plane in metres; infinite if left out. Linear depth of the background
    /// is this distance.
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

/// Corner of the picture with the texel (0, 0).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Origin {
    /// The top left, as in Vulkan, Direct3D, Metal and WebGPU.
    #[default]
    TopLeft,
    /// The bottom left, as in OpenGL.
    BottomLeft,
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
    /// 0 at the near plane and 1 at the far plane, as in a depth buffer.
    Forward,
    /// 1 at the near plane and 0 at the far plane.
    Reversed,
    /// -1 at the near plane and 1 at the far plane, as in OpenGL's normalised device coordinates.
    Ndc,
}

const COLOR_FORMATS: [Format; 5] = [
    Format::Rgba32Float,
    Format::Rgba16Float,
    Format::Rg11b10Ufloat,
    Format::Rgb10a2Unorm,
    Format::Rgba8Unorm,
];
const VELOCITY_FORMATS: [Format; 4] = [
    Format::Rg32Float,
    Format::Rg16Float,
    Format::Rgba32Float,
    Format::Rgba16Float,
];
const DEPTH_FORMATS: [Format; 2] = [Format::R32Float, Format::R16Float];
const OUTPUT_FORMATS: [Format; 2] = [Format::Rgba32Float, Format::Rgba16Float];

impl Convention {
    /// Refuses numbers that make no sense, and keys that lack others.
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
            .filter(|scale| !scale.is_finite() || *scale == 0.0)
        {
            return Err(format!(
                "velocity_scale = {scale}; allowed: a finite number other than 0"
            ));
        }
        if let Some(bias) = self.velocity_bias.filter(|bias| !bias.is_finite()) {
            return Err(format!("velocity_bias = {bias}; allowed: a finite number"));
        }
        if self.velocity_per == VelocityTime::Second && self.frames_per_second.is_none() {
            return Err("velocity_per = \"second\" needs frames_per_second".into());
        }
        match (self.depth, self.near, self.far) {
            (DepthKind::Linear, None, _) => {}
            (DepthKind::Linear, ..) => {
                return Err("near is for depth = \"forward\", \"reversed\" or \"ndc\"".into());
            }
            (_, None, _) => return Err("depth of a depth buffer needs near, in metres".into()),
            (_, Some(near), Some(far)) if far <= near => {
                return Err(format!("far = {far} is not beyond near = {near}"));
            }
            _ => {}
        }
        let formats: [(_, _, &[Format]); 4] = [
            ("color_format", self.color_format, &COLOR_FORMATS),
            ("velocity_format", self.velocity_format, &VELOCITY_FORMATS),
            ("depth_format", self.depth_format, &DEPTH_FORMATS),
            ("output_format", self.output_format, &OUTPUT_FORMATS),
        ];
        for (name, format, allowed) in formats {
            if let Some(format) = format.filter(|format| !allowed.contains(format)) {
                let allowed: Vec<&str> = allowed.iter().map(|format| format.name()).collect();
                return Err(format!(
                    "{name} = \"{}\"; allowed: {}",
                    format.name(),
                    allowed.join(", ")
                ));
            }
        }
        Ok(())
    }

    /// Returns the convention for frames with a rate of their own; unchanged if it names no rate.
    pub(crate) fn at_rate(self, frames_per_second: Option<f64>) -> Self {
        Self {
            frames_per_second: (self.frames_per_second)
                .map(|written| frames_per_second.unwrap_or(written)),
            ..self
        }
    }

    /// Returns the corner with the texel (0, 0).
    pub(crate) fn origin(&self) -> Origin {
        self.origin.unwrap_or_default()
    }

    /// Returns the direction of the velocity's +y.
    pub(crate) fn velocity_y(&self) -> VerticalDirection {
        self.velocity_y.unwrap_or(match self.origin() {
            Origin::TopLeft => VerticalDirection::Down,
            Origin::BottomLeft => VerticalDirection::Up,
        })
    }

    /// Returns a value that members of uniform blocks may name; none if the convention does not
    /// have it.
    pub(crate) fn value(&self, name: &str) -> Option<f64> {
        match name {
            "frames_per_second" => self.frames_per_second,
            "delta_time" => self.frames_per_second.map(|rate| 1.0 / rate),
            "near" => self.near,
            "far" => self.far,
            "color_scale" => Some(self.color_scale.unwrap_or(1.0)),
            _ => None,
        }
    }

    /// Fills in what was left out, so that the record is complete. `far` stays empty without a far
    /// plane.
    pub fn resolved(self) -> Self {
        Self {
            velocity_y: Some(self.velocity_y()),
            velocity_scale: self.velocity_scale.or(Some(1.0)),
            velocity_format: Some(self.format_of(Layer::Velocity)),
            depth_format: Some(self.format_of(Layer::Depth)),
            color_scale: self.color_scale.or(Some(1.0)),
            color_format: Some(self.format_of(Layer::Color)),
            ..self
        }
    }

    /// Returns the format of a layer's texture.
    pub(crate) fn format_of(&self, layer: Layer) -> Format {
        match layer {
            Layer::Color => self.color_format.unwrap_or(Format::Rgba32Float),
            Layer::Velocity | Layer::VelocityNext => {
                self.velocity_format.unwrap_or(Format::Rg32Float)
            }
            Layer::VelocityZ | Layer::Exclusion => Format::R32Float,
            Layer::Depth => self.depth_format.unwrap_or(Format::R32Float),
        }
    }

    /// Returns the format of the output, which is for fragment shaders.
    pub(crate) fn output_format(&self) -> Format {
        self.output_format.unwrap_or(Format::Rgba32Float)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conventions_that_say_too_little_are_refused() {
        for (text, says) in [
            ("depth = 'ndc'\nnear = 2\nfar = 1", "far = 1 is not beyond"),
            ("near = 1", "near is for depth"),
            ("far = 0", "far = 0"),
            ("color_scale = -1", "color_scale = -1"),
            ("velocity_scale = 0", "velocity_scale = 0"),
            ("velocity_bias = inf", "velocity_bias = inf"),
        ] {
            let convention: Convention = toml::from_str(text).unwrap();
            let refusal = convention.check().unwrap_err();
            assert!(refusal.contains(says), "{refusal}");
        }
        assert_eq!(Convention::default().check(), Ok(()));
    }
}
