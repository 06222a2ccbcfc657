// The prepass writes the distance along the view axis, and 0 where nothing is drawn.
@group(0) @binding(0) var depth: texture_2d<f32>;

// In metres, as in filter.toml.
const NEAR = 0.1;
const FAR = 100000.0;

@fragment
fn main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let stored = textureLoad(depth, vec2<i32>(position.xy), 0).x;
    let metres = NEAR / (1.0 - stored * (1.0 - NEAR / FAR));
    return vec4<f32>(select(metres, 0.0, stored >= 1.0), 0.0, 0.0, 1.0);
}
