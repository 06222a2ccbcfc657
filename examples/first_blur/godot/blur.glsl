#[compute]
#version 450

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D color_sampler;
layout(set = 0, binding = 1) uniform sampler2D velocity_sampler;
layout(rgba16f, set = 0, binding = 2) uniform writeonly image2D output_image;

layout(push_constant, std430) uniform Params {
    float intensity;
    int samples;
    int padding_0;
    int padding_1;
} params;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = textureSize(color_sampler, 0);
    if (any(greaterThanEqual(pixel, size))) {
        return;
    }
    vec2 uv = (vec2(pixel) + 0.5) / vec2(size);
    // Godot's velocity points to the previous position.
    vec2 trail = -textureLod(velocity_sampler, uv, 0.0).xy * params.intensity;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < params.samples; i++) {
        float along = (float(i) + 0.5) / float(params.samples);
        sum += textureLod(color_sampler, uv + along * trail, 0.0);
    }
    imageStore(output_image, pixel, sum / float(params.samples));
}
