struct Parameters { taps: i32 }
@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var velocity: texture_2d<f32>;
@group(0) @binding(4) var output: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn blur(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) { return; }
    let trail = frame.exposure * textureLoad(velocity, pixel, 0).xy;
    var sum = vec4<f32>(0.0);
    for (var tap = 0; tap < parameters.taps; tap++) {
        let along = (f32(tap) + 0.5) / f32(parameters.taps);
        sum += bilinear(color, centre(pixel) + along * trail);
    }
    textureStore(output, pixel, sum / f32(parameters.taps));
}
