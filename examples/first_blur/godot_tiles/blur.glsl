#[compute]
#version 450

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D color_sampler;
layout(set = 0, binding = 1) uniform sampler2D velocity_sampler;
layout(rg16f, set = 0, binding = 2) uniform readonly image2D neighbor_max;
layout(rgba16f, set = 0, binding = 3) uniform writeonly image2D output_image;

layout(push_constant, std430) uniform Params {
    float intensity;
    int samples;
    int tile_size;
    int padding_0;
} params;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    vec2 size = vec2(textureSize(color_sampler, 0));
    if (any(greaterThanEqual(pixel, ivec2(size)))) {
        return;
    }
    vec2 uv = (vec2(pixel) + 0.5) / size;
    vec4 own = textureLod(color_sampler, uv, 0.0);
    float own_motion = length(textureLod(velocity_sampler, uv, 0.0).xy * params.intensity * size);
    // Godot's velocity points to the previous position.
    vec2 trail = -imageLoad(neighbor_max, pixel / params.tile_size).xy * params.intensity;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < params.samples; i++) {
        float along = (float(i) + 0.5) / float(params.samples);
        vec2 there = uv + along * trail;
        float motion = length(textureLod(velocity_sampler, there, 0.0).xy * params.intensity * size);
        // The surface there passed over this pixel, or this pixel's came from behind it, if its motion covers the distance.
        bool passed = max(motion, own_motion) >= along * length(trail * size);
        sum += passed ? textureLod(color_sampler, there, 0.0) : own;
    }
    imageStore(output_image, pixel, sum / float(params.samples));
}
