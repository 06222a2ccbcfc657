// The motion blur of the Bevy engine: one gather along each pixel's own motion.

struct Parameters {
    samples: i32,
    metric: u32,
    fetch: u32,
}

@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var velocity: texture_2d<f32>;
@group(0) @binding(4) var depth: texture_2d<f32>;
@group(0) @binding(5) var output: texture_storage_2d<rgba32float, write>;

const METRIC_UV = 0u;
const FETCH_FILTERED = 0u;

// Depth from which a surface counts as sky, in metres.
const SKY = 1e10;
// Squared motion, in pixels per frame, under which a pixel is left as it is; it does not depend on the exposure.
const STILL = 1.0;

// From pixels to the space in which taps are judged.
fn metric() -> vec2<f32> {
    return select(vec2<f32>(1.0), 1.0 / vec2<f32>(frame.size), parameters.metric == METRIC_UV);
}

// Between texels, or, where the engine has several samples per pixel, the nearest one.
fn fetched(image: texture_2d<f32>, position: vec2<f32>) -> vec4<f32> {
    if parameters.fetch == FETCH_FILTERED {
        return bilinear(image, position);
    }
    return textureLoad(image, pixel_at(position), 0);
}

// Whether the surface at a tap came as far as the pixel: its motion along the way there, half of it because the
// shutter is centred. The engine compares the motion of a whole frame, whatever the exposure.
fn reaches(offset: vec2<f32>, motion: vec2<f32>) -> bool {
    let way = offset * metric();
    let along = 0.5 * abs(dot(way, motion * metric()));
    return along >= dot(way, way);
}

// Whether a tap may count. What lies behind is always seen; the sky has no motion of its own to judge.
fn counts(pixel: vec2<i32>, offset: vec2<f32>) -> bool {
    let position = centre(pixel) + offset;
    let tap_depth = textureLoad(depth, pixel_at(position), 0).x;
    let behind = tap_depth > textureLoad(depth, pixel, 0).x;
    return behind || tap_depth >= SKY || reaches(offset, fetched(velocity, position).xy);
}

@compute @workgroup_size(8, 8)
fn gather(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let here = textureLoad(color, pixel, 0);
    let motion = textureLoad(velocity, pixel, 0).xy;
    if dot(motion, motion) < STILL {
        textureStore(output, pixel, here);
        return;
    }
    // The engine walks a cycle of 64 frames.
    let walk = 5.588238 * f32(frame.frame_index % 64u);
    let noise = interleaved_gradient_noise(vec2<f32>(pixel) + walk);
    // A running mean keeps a constant colour exactly as it is.
    var mean = vec4<f32>(0.0);
    var taps = 0;
    for (var i = -parameters.samples; i < parameters.samples; i++) {
        let along = 0.5 * (f32(i) + noise) / f32(parameters.samples);
        let offset = along * frame.exposure * motion;
        if on_screen(centre(pixel) + offset) && counts(pixel, offset) {
            taps++;
            mean += (fetched(color, centre(pixel) + offset) - mean) / f32(taps);
        }
    }
    textureStore(output, pixel, select(here, mean, taps > 0));
}
