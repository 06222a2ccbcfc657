struct Parameters {
    samples: i32,
    gain: f32,
}
@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var output: texture_storage_2d<rgba32float, write>;
// declarations
@compute @workgroup_size(8, 8)
fn work(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) { return; }
    let here = textureLoad(color, pixel, 0);
    var value = vec4<f32>(0.0);
    for (var i = 0; i < parameters.samples; i++) {
        value += here;
    }
    // statements
    textureStore(output, pixel, parameters.gain * value / f32(parameters.samples));
}
