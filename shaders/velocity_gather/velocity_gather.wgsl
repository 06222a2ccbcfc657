struct Parameters {
    samples: i32,
    intensity: f32,
}

@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var velocity: texture_2d<f32>;
@group(0) @binding(4) var output: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn gather(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    // A surface seen here at the instant was behind this place before: what passed over this pixel while the shutter
    // was open now lies ahead of it.
    let trail = textureLoad(velocity, pixel, 0).xy * frame.exposure * parameters.intensity;
    // A running mean keeps a constant colour exactly as it is.
    var mean = textureLoad(color, pixel, 0);
    for (var i = 1; i < parameters.samples; i++) {
        let along = f32(i) / f32(parameters.samples);
        let tap = bilinear(color, centre(pixel) + along * trail);
        mean += (tap - mean) / f32(i + 1);
    }
    textureStore(output, pixel, mean);
}
