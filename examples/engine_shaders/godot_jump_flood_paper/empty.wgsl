// Textures of the first frame, still empty.
@group(0) @binding(0) var buffer_a_out: texture_storage_2d<rgba16float, write>;
@group(0) @binding(1) var buffer_b_out: texture_storage_2d<rgba16float, write>;
@group(0) @binding(2) var past_color_out: texture_storage_2d<rgba16float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= textureDimensions(buffer_a_out)) {
        return;
    }
    textureStore(buffer_a_out, id.xy, vec4<f32>(0.0));
    textureStore(buffer_b_out, id.xy, vec4<f32>(0.0));
    textureStore(past_color_out, id.xy, vec4<f32>(0.0));
}
