// Each tile's own position, in texture coordinates.
@group(0) @binding(0) var buffer_a_out: texture_storage_2d<rgba16float, write>;
@group(0) @binding(1) var buffer_b_out: texture_storage_2d<rgba16float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(buffer_a_out);
    if any(id.xy >= size) {
        return;
    }
    let place = (vec2<f32>(id.xy) + 0.5) / vec2<f32>(size);
    textureStore(buffer_a_out, id.xy, vec4<f32>(place, 0.0, 0.0));
    textureStore(buffer_b_out, id.xy, vec4<f32>(place, 0.0, 0.0));
}
