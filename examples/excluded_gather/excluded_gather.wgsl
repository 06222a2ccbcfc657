struct Parameters {
    samples: i32,
    mask: u32,
}

@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var velocity: texture_2d<f32>;
@group(0) @binding(4) var exclusion: texture_2d<f32>;
@group(0) @binding(5) var output: texture_storage_2d<rgba32float, write>;

const MASK_USED = 1u;

fn is_excluded(pixel: vec2<i32>) -> bool {
    return parameters.mask == MASK_USED && textureLoad(exclusion, pixel, 0).x > 0.5;
}

@compute @workgroup_size(8, 8)
fn gather(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let here = textureLoad(color, pixel, 0);
    if is_excluded(pixel) {
        textureStore(output, pixel, here);
        return;
    }
    let trail = textureLoad(velocity, pixel, 0).xy * frame.exposure;
    var mean = here;
    var count = 0.0;
    for (var i = 0; i < parameters.samples; i++) {
        let along = (f32(i) + 0.5) / f32(parameters.samples) - 0.5;
        let tap = pixel_at(centre(pixel) + along * trail);
        if !is_excluded(tap) {
            count += 1.0;
            mean += (textureLoad(color, tap, 0) - mean) / count;
        }
    }
    textureStore(output, pixel, mean);
}
