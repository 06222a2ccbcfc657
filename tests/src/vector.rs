//! Vectors of two numbers.

/// Horizontal and vertical component.
pub type Vec2 = [f64; 2];

/// Returns the scalar product.
pub fn dot(a: Vec2, b: Vec2) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Returns the area between two vectors, with its sign.
pub fn cross(a: Vec2, b: Vec2) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Returns the difference.
pub fn minus(a: Vec2, b: Vec2) -> Vec2 {
    [a[0] - b[0], a[1] - b[1]]
}

/// Returns the length.
pub fn length(a: Vec2) -> f64 {
    dot(a, a).sqrt()
}

/// Multiplies both components.
pub fn scaled(a: Vec2, factor: f64) -> Vec2 {
    a.map(|component| component * factor)
}

/// Scales a vector to length 1; `otherwise` is the direction of a zero vector.
pub fn direction(a: Vec2, otherwise: Vec2) -> Vec2 {
    match length(a) {
        0.0 => otherwise,
        length => a.map(|component| component / length),
    }
}
