//! Operands of an expression.

use wgpu::naga::{Expression, Handle, ImageQuery, SampleLevel};

/// Lists the expressions that one is made of, except layers and samples of textures, which no
/// filter has.
pub(super) fn list_operands(expression: &Expression) -> Vec<Handle<Expression>> {
    let several = |first: &[Handle<Expression>], more: &[Option<Handle<Expression>>]| {
        let more = more.iter().flatten();
        first.iter().chain(more).copied().collect()
    };
    match *expression {
        Expression::Compose { ref components, .. } => components.clone(),
        Expression::Access { base, index } => vec![base, index],
        Expression::AccessIndex { base: one, .. }
        | Expression::Splat { value: one, .. }
        | Expression::Swizzle { vector: one, .. }
        | Expression::Load { pointer: one }
        | Expression::Unary { expr: one, .. }
        | Expression::Derivative { expr: one, .. }
        | Expression::As { expr: one, .. }
        | Expression::Relational { argument: one, .. } => vec![one],
        Expression::ImageSample {
            coordinate,
            offset,
            level,
            ..
        } => {
            let [level, other] = match level {
                SampleLevel::Exact(level) | SampleLevel::Bias(level) => [Some(level), None],
                SampleLevel::Gradient { x, y } => [Some(x), Some(y)],
                SampleLevel::Auto | SampleLevel::Zero => [None, None],
            };
            several(&[coordinate], &[offset, level, other])
        }
        Expression::ImageLoad {
            coordinate, level, ..
        } => several(&[coordinate], &[level]),
        Expression::ImageQuery {
            query: ImageQuery::Size { level },
            ..
        } => several(&[], &[level]),
        Expression::Binary { left, right, .. } => vec![left, right],
        Expression::Select {
            condition,
            accept,
            reject,
        } => vec![condition, accept, reject],
        Expression::Math {
            arg,
            arg1,
            arg2,
            arg3,
            ..
        } => several(&[arg], &[arg1, arg2, arg3]),
        _ => Vec::new(),
    }
}
