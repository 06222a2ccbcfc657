// A comment with 1.0 + 2.0.
const SHARPNESS = 20.0;
@group(0) @binding(1) var<uniform> parameters: Parameters;

@compute @workgroup_size(8, 8)
fn blur(@builtin(global_invocation_id) id: vec3<u32>) -> f32 {
    let half = -0.5 * max(length(vec2<f32>(id.yx)), 0.0);
    for (var i = 0; i < 4u; i++) {
        if !inside(half) || saturate(half) == 1e-5 {
            return half;
        }
        total +=
            half.x; /* 3.0 */
    }
    textureStore(output, id.xy, mean(half - total));
}
