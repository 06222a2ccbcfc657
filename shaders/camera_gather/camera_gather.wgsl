struct Parameters {
    samples: i32,
    intensity: f32,
    sky: u32,
}

@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var depth: texture_2d<f32>;
@group(0) @binding(4) var output: texture_storage_2d<rgba32float, write>;

// In pixels: what rounding leaves of the motion of a camera that stands still.
const STILL = 1e-3;
const SKY_SHARP = 1u;

// Depth from which nothing is drawn, in metres.
const SKY = 1e10;

@compute @workgroup_size(8, 8)
fn gather(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let metres = textureLoad(depth, pixel, 0).x;
    let motion = centre(pixel) - before_camera(centre(pixel), metres);
    let sharp = parameters.sky == SKY_SHARP && metres >= SKY;
    // A running mean keeps a constant colour exactly as it is.
    var mean = textureLoad(color, pixel, 0);
    if length(motion) > STILL && !sharp {
        let trail = motion * frame.exposure * parameters.intensity;
        for (var i = 1; i < parameters.samples; i++) {
            let along = f32(i) / f32(parameters.samples);
            let tap = bilinear(color, centre(pixel) + along * trail);
            mean += (tap - mean) / f32(i + 1);
        }
    }
    textureStore(output, pixel, mean);
}
