//! Operands of an expression.

use wgpu::naga::{Expression, Handle, ImageQuery, SampleLevel};

/// Lists the expressions that one is made of.
pub(super) fn list_operands(expression: &Expression) -> Vec<Handle<Expression>> {
    let several = |first: &[Handle<Expression>], more: &[Option<Handle<Expression>>]| {
        let more = more.iter().flatten();
        first.iter().chain(more).copied().collect()
    };
    match *expression {
        Expression::Compose { ref components, .. } => components.clone(),
        Expression::Access { base, index } => vec![base, index],
        Expression::AccessIndex { base, .. } => vec![base],
        Expression::Splat { value, .. } => vec![value],
        Expression::Swizzle { vector, .. } => vec![vector],
        Expression::Load { pointer } => vec![pointer],
        Expression::ImageSample {
            coordinate,
            array_index,
            offset,
            level,
            depth_ref,
            ..
        } => {
            let [level, other] = match level {
                SampleLevel::Exact(level) | SampleLevel::Bias(level) => [Some(level), None],
                SampleLevel::Gradient { x, y } => [Some(x), Some(y)],
                SampleLevel::Auto | SampleLevel::Zero => [None, None],
            };
            several(
                &[coordinate],
                &[array_index, offset, level, other, depth_ref],
            )
        }
        Expression::ImageLoad {
            coordinate,
            array_index,
            sample,
            level,
            ..
        } => several(&[coordinate], &[array_index, sample, level]),
        Expression::ImageQuery {
            query: ImageQuery::Size { level },
            ..
        } => several(&[], &[level]),
        Expression::Unary { expr, .. }
        | Expression::Derivative { expr, .. }
        | Expression::As { expr, .. } => vec![expr],
        Expression::Binary { left, right, .. } => vec![left, right],
        Expression::Select {
            condition,
            accept,
            reject,
        } => vec![condition, accept, reject],
        Expression::Relational { argument, .. } => vec![argument],
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
