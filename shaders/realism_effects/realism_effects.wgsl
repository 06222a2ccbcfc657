// MotionBlurEffect of realism-effects (0beqz): an even gather along each pixel's own motion, shifted by noise.

struct Parameters {
    samples: i32,
    strength: f32,
    jitter: f32,
}

@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var velocity: texture_2d<f32>;
@group(0) @binding(4) var depth: texture_2d<f32>;
@group(0) @binding(5) var output: texture_storage_2d<rgba32float, write>;

// Depth from which nothing is drawn, in metres: the velocity there is 0.
const SKY = 1e10;
// Squared motion, in parts of width and height, up to which a pixel is left as it is.
const STILL = 1e-9;

// In [0, 1), for each axis. With its axes exchanged, the noise of the one says nothing of the other's.
fn noise(pixel: vec2<i32>) -> vec2<f32> {
    let position = vec2<f32>(pixel) + 5.588238 * f32(frame.frame_index % 64u);
    return vec2<f32>(
        interleaved_gradient_noise(position),
        interleaved_gradient_noise(position.yx + vec2<f32>(37.0, 17.0)),
    );
}

@compute @workgroup_size(8, 8)
fn gather(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let here = textureLoad(color, pixel, 0);
    let size = vec2<f32>(frame.size);
    let motion = textureLoad(velocity, pixel, 0).xy / size;
    if dot(motion, motion) <= STILL || textureLoad(depth, pixel, 0).x >= SKY {
        textureStore(output, pixel, here);
        return;
    }
    let trail = motion * (frame.exposure * parameters.strength);
    let shift = parameters.jitter * trail * noise(pixel);
    let middle = centre(pixel) / size;
    // Only these ends are held on the picture; beyond the others, fetches repeat its border.
    let first = max(vec2<f32>(0.0), middle + shift - 0.5 * trail);
    let last = min(vec2<f32>(1.0), middle + shift + 0.5 * trail);
    // A running mean keeps a constant colour exactly as it is.
    var mean = here;
    for (var i = 0; i <= parameters.samples; i++) {
        let at = mix(first, last, f32(i) / f32(parameters.samples));
        mean += (bilinear(color, at * size) - mean) / f32(i + 2);
    }
    textureStore(output, pixel, mean);
}
