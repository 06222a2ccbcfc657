// Motion as Babylon.js's prepass writes it (ShadersInclude/pbrBlockPrePass.fx): the cube root of the motion in texture coordinates, and
// in alpha whether anything is drawn.
@group(0) @binding(0) var velocity: texture_2d<f32>;
@group(0) @binding(1) var depth: texture_2d<f32>;

@fragment
fn main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(position.xy);
    let motion = textureLoad(velocity, pixel, 0).xy / vec2<f32>(textureDimensions(velocity));
    let root = pow(abs(motion), vec2<f32>(1.0 / 3.0)) * sign(motion) * 0.5 + 0.5;
    let drawn = select(0.0, 1.0, textureLoad(depth, pixel, 0).x < 1e10);
    return vec4<f32>(root, 0.0, drawn);
}
