//! Inputs of a filter, and their conversion to its convention.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use crate::filter::Layer;
use crate::{Convention, DepthKind, Filter, Input};

/// Lists the textures that the frame fills; those of the frame before show the first frame of a
/// sequence itself. Each has one expression per component of the frame's input, of `frame.value`
/// and of [`list_values`]; none if the filter gets the frame's own numbers.
pub(super) fn list_inputs(filter: &Filter) -> Vec<Value> {
    let current = Layer::OF_EVERY_FRAME
        .into_iter()
        .chain(filter.further_inputs());
    let current = current.map(|layer| (layer.name(), layer));
    let before = (filter.history.iter()).map(|history| (history.texture(), history.layer()));
    let convention = &filter.convention;
    let scaled = |factor: &str| json!(["*", "frame.value", factor]);
    current.chain(before)
        .map(|(name, layer)| {
            let convert = match layer {
                _ if *convention == Convention::default() => Value::Null,
                Layer::Color => json!([scaled("frame.color"), scaled("frame.color"), scaled("frame.color")]),
                Layer::Depth => convert_depth(convention),
                Layer::VelocityZ | Layer::Exclusion => Value::Null,
                Layer::Velocity | Layer::VelocityNext => {
                    let bias = convention.velocity_bias.unwrap_or(0.0);
                    let axes = ["frame.velocity[0]", "frame.velocity[1]"];
                    json!(axes.map(|factor| match bias {
                        0.0 => scaled(factor),
                        bias => json!(["+", scaled(factor), bias]),
                    }))
                }
            };
            json!({ "name": name, "from": layer.name(), "format": convention.format_of(layer), "convert": convert })
        })
        .collect()
}

/// Lists the factors of the conversions.
pub(super) fn list_values(filter: &Filter, input: &Input) -> BTreeMap<String, f64> {
    let convention = filter.convention.at_rate(input.frames_per_second);
    let size = [input.velocity.width, input.velocity.height];
    let [x, y] = convention.velocity_factors(size, input.exposure);
    let color = convention.color_scale.unwrap_or(1.0);
    let named = [
        ("frame.velocity[0]", x),
        ("frame.velocity[1]", y),
        ("frame.color", color),
    ];
    named.map(|(name, value)| (name.to_owned(), value)).into()
}

/// As [`Convention::convert_depth`].
fn convert_depth(convention: &Convention) -> Value {
    let near = convention.near.unwrap_or(1.0);
    let depth = "frame.value";
    let reversed = match convention.far {
        None => json!(["/", near, depth]),
        Some(far) => json!([
            "/",
            ["*", near, ["-", far, depth]],
            ["*", depth, far - near]
        ]),
    };
    let reversed = json!(["min", ["max", reversed, 0], 1]);
    match convention.depth {
        DepthKind::Linear => {
            (convention.far).map_or(Value::Null, |far| json!([["min", depth, far]]))
        }
        DepthKind::Reversed => json!([reversed]),
        DepthKind::Forward => json!([["-", 1, reversed]]),
        DepthKind::Ndc => json!([["-", 1, ["*", 2, reversed]]]),
    }
}
