// Motion vectors at half the resolution, which Flax renders (`MotionVectorsResolution: Half`). The engine's point is the corner that four
// pixels share; this is one of the four.
@group(0) @binding(0) var velocity: texture_2d<f32>;

@fragment
fn main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let last = vec2<i32>(textureDimensions(velocity)) - 1;
    let pixel = min(2 * vec2<i32>(position.xy) + 1, last);
    return vec4<f32>(textureLoad(velocity, pixel, 0).xy, 0.0, 1.0);
}
