// The motion blur of Unity's Universal Render Pipeline: an even gather along each pixel's own motion.

struct Parameters {
    pairs: i32,
    strength: f32,
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
    let trail = textureLoad(velocity, pixel, 0).xy * (frame.exposure * parameters.strength);
    let noise = interleaved_gradient_noise(centre(pixel));
    // A running mean keeps a constant colour exactly as it is.
    var mean = vec4<f32>(0.0);
    for (var i = 0; i < 2 * parameters.pairs; i++) {
        // From behind to ahead; noise shifts all taps back by up to a step.
        let along = (f32(i + 1 - parameters.pairs) - noise) / f32(2 * parameters.pairs);
        let tap = textureLoad(color, pixel_at(centre(pixel) + along * trail), 0);
        mean += (tap - mean) / f32(i + 1);
    }
    textureStore(output, pixel, mean);
}
