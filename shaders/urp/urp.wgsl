// The motion blur of Unity's Universal Render Pipeline: an even gather along each pixel's own motion.

struct Parameters {
    pairs: i32,
    strength: f32,
    motion: u32,
    longest_camera_motion: f32,
}

@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var velocity: texture_2d<f32>;
@group(0) @binding(4) var depth: texture_2d<f32>;
@group(0) @binding(5) var output: texture_storage_2d<rgba32float, write>;

const MOTION_OF_ALL = 0u;

fn motion_at(pixel: vec2<i32>) -> vec2<f32> {
    if parameters.motion == MOTION_OF_ALL {
        return textureLoad(velocity, pixel, 0).xy;
    }
    let motion = centre(pixel) - before_camera(centre(pixel), textureLoad(depth, pixel, 0).x);
    // In device coordinates, 2 from border to border.
    let way = length(2.0 * motion / vec2<f32>(frame.size));
    return motion * min(1.0, parameters.longest_camera_motion / max(way, 1e-9));
}

@compute @workgroup_size(8, 8)
fn gather(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let trail = motion_at(pixel) * (frame.exposure * parameters.strength);
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
