@group(0) @binding(1) var color: texture_2d<f32>;
@group(0) @binding(2) var output: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn copy(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if inside(pixel) {
        textureStore(output, pixel, textureLoad(color, pixel, 0));
    }
}
