// The screen based motion blur of Babylon.js: a gather along the camera's motion, rebuilt from depth.

struct Parameters {
    samples: i32,
    strength: f32,
    fetch: u32,
}

@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var depth: texture_2d<f32>;
@group(0) @binding(4) var output: texture_storage_2d<rgba32float, write>;

const FETCH_NEAREST = 0u;

// Depth from which nothing is drawn, in metres.
const SKY = 1e10;

fn fetched(position: vec2<f32>) -> vec4<f32> {
    if parameters.fetch == FETCH_NEAREST {
        return textureLoad(color, pixel_at(position), 0);
    }
    return bilinear(color, position);
}

@compute @workgroup_size(8, 8)
fn gather(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    // The pixel itself stands for the first tap. A running mean keeps a constant colour exactly as it is.
    var mean = textureLoad(color, pixel, 0);
    let metres = textureLoad(depth, pixel, 0).x;
    if metres < SKY {
        // Towards the place that the frame before showed it at.
        let back = (before_camera(centre(pixel), metres) - centre(pixel)) * (frame.exposure * parameters.strength);
        let count = i32(clamp(length(back), 1.0, f32(parameters.samples)));
        for (var i = 1; i < count; i++) {
            let along = f32(i) / f32(count - 1) - 0.5;
            mean += (fetched(centre(pixel) + along * back) - mean) / f32(i + 1);
        }
    }
    textureStore(output, pixel, mean);
}
