// Colours averaged along the motion. `#import bevy_core_pipeline::fullscreen_vertex_shader` is expanded here.
struct FullscreenVertexOutput {
    @builtin(position) position: vec4<f32>,
    @location(0) uv: vec2<f32>,
}

@vertex
fn fullscreen_vertex_shader(@builtin(vertex_index) index: u32) -> FullscreenVertexOutput {
    let uv = vec2<f32>(f32(index >> 1u), f32(index & 1u)) * 2.0;
    return FullscreenVertexOutput(vec4<f32>(uv * vec2<f32>(2.0, -2.0) + vec2<f32>(-1.0, 1.0), 0.0, 1.0), uv);
}

@group(0) @binding(0) var screen_texture: texture_2d<f32>;
@group(0) @binding(1) var motion_vectors: texture_2d<f32>;
@group(0) @binding(2) var texture_sampler: sampler;

struct MotionBlur {
    shutter_angle: f32,
    samples: u32,
}
@group(0) @binding(3) var<uniform> settings: MotionBlur;

@fragment
fn fragment(in: FullscreenVertexOutput) -> @location(0) vec4<f32> {
    let trail = textureLoad(motion_vectors, vec2<i32>(in.position.xy), 0).xy * settings.shutter_angle;
    var sum = vec4<f32>(0.0);
    for (var i = 0u; i < settings.samples; i++) {
        let along = (f32(i) + 0.5) / f32(settings.samples);
        sum += textureSampleLevel(screen_texture, texture_sampler, in.uv + along * trail, 0.0);
    }
    return sum / f32(settings.samples);
}
