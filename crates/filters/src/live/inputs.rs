//! Inputs of a filter, and their conversion to its convention.

use serde::Serialize;

use crate::filter::INPUTS;
use crate::{
    Convention, DepthKind, Expression, Filter, Format, VelocitySign, VelocityTime, VelocityUnit,
    VerticalDirection,
};

/// A texture that the frame fills.
#[derive(Clone, Debug, Serialize)]
pub(super) struct LiveInput {
    /// Name of the texture.
    name: &'static str,
    /// Input of the frame that fills it.
    from: &'static str,
    format: Format,
    /// For each component of the frame's input the number that the filter gets, of `value` and of numbers of the frame; none if it gets the
    /// frame's own.
    convert: Option<Vec<Expression>>,
}

/// Lists the textures that the frame fills; those of the frame before show the first frame of a sequence itself.
pub(super) fn list_inputs(filter: &Filter) -> Vec<LiveInput> {
    let own = INPUTS.into_iter().chain(filter.further_inputs());
    let own = own.map(|name| (name, name));
    let before = (filter.history.iter()).map(|history| (history.texture(), history.input()));
    let convention = &filter.convention;
    own.chain(before)
        .map(|(name, from)| LiveInput {
            name,
            from,
            format: convention.format_of(name),
            convert: match from {
                "color" => convention.color_conversion(),
                "depth" => convention.depth_conversion(),
                "velocity_z" => None,
                _ => convention.velocity_conversion(),
            },
        })
        .collect()
}

impl LiveInput {
    /// Lists the expressions of its conversion.
    pub fn list_expressions(&self) -> impl Iterator<Item = &Expression> {
        self.convert.iter().flatten()
    }
}

/// Name of the number that is converted. No parameter's name contains a full stop.
const VALUE: &str = "frame.value";

fn name(name: &str) -> Expression {
    Expression::Name(name.to_owned())
}

fn apply(function: &'static str, arguments: [Expression; 2]) -> Expression {
    Expression::Apply(function, arguments.into())
}

impl Convention {
    /// As [`Convention::convert_color`].
    fn color_conversion(&self) -> Option<Vec<Expression>> {
        let scale = Expression::Number(self.color_scale?);
        Some(vec![apply("*", [name(VALUE), scale]); 3])
    }

    /// As [`Convention::convert_velocity`].
    fn velocity_conversion(&self) -> Option<Vec<Expression>> {
        let is_own = |own: &Self| {
            let full = Self::default();
            (
                own.velocity,
                own.velocity_y,
                own.velocity_sign,
                own.velocity_per,
                own.velocity_scale,
            ) == (
                full.velocity,
                full.velocity_y,
                full.velocity_sign,
                full.velocity_per,
                None,
            )
        };
        if is_own(self) {
            return None;
        }
        let sign = match self.velocity_sign {
            VelocitySign::CurrentMinusPrevious => 1.0,
            VelocitySign::PreviousMinusCurrent => -1.0,
        };
        let up = match self.velocity_y {
            VerticalDirection::Down => 1.0,
            VerticalDirection::Up => -1.0,
        };
        let steps = match self.velocity {
            VelocityUnit::Ndc => 2.0,
            _ => 1.0,
        };
        let component = |side: &str, sign: f64| {
            let factor = sign * steps * self.velocity_scale.unwrap_or(1.0);
            let scaled = apply("*", [name(VALUE), Expression::Number(factor)]);
            let timed = match self.velocity_per {
                VelocityTime::Frame => scaled,
                VelocityTime::Shutter => apply("*", [scaled, name("frame.exposure")]),
                VelocityTime::Second => apply("*", [scaled, name("frame.frames_per_second")]),
            };
            match self.velocity {
                VelocityUnit::Pixels => timed,
                _ => apply("/", [timed, name(side)]),
            }
        };
        Some(vec![
            component("frame.size[0]", sign),
            component("frame.size[1]", sign * up),
        ])
    }

    /// As [`Convention::convert_depth`].
    fn depth_conversion(&self) -> Option<Vec<Expression>> {
        let near = self.near.unwrap_or(1.0);
        let number = Expression::Number;
        let reversed = match self.far {
            None => apply("/", [number(near), name(VALUE)]),
            Some(far) => {
                let rest = apply("*", [number(near), apply("-", [number(far), name(VALUE)])]);
                apply("/", [rest, apply("*", [name(VALUE), number(far - near)])])
            }
        };
        let reversed = apply("min", [apply("max", [reversed, number(0.0)]), number(1.0)]);
        let twice = apply("*", [number(2.0), reversed.clone()]);
        Some(vec![match self.depth {
            DepthKind::Linear => return None,
            DepthKind::Reversed => reversed,
            DepthKind::Forward => apply("-", [number(1.0), reversed]),
            DepthKind::Ndc => apply("-", [number(1.0), twice]),
        }])
    }
}
