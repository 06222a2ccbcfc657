// Velocity and depth in one texture, like the add-on's first stage if only objects move.
@group(0) @binding(0) var velocity: texture_2d<f32>;
@group(0) @binding(1) var depth: texture_2d<f32>;
@group(0) @binding(2) var custom_velocity_out: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= textureDimensions(velocity)) {
        return;
    }
    let change = textureLoad(velocity, id.xy, 0).xy;
    let z = textureLoad(depth, id.xy, 0).x;
    textureStore(custom_velocity_out, id.xy, vec4<f32>(change, 0.0, z));
}
