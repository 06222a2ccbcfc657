#[compute]
#version 450
// The longest motion within a tile and the eight around it.

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D color_sampler;
layout(rg16f, set = 0, binding = 1) uniform readonly image2D tile_max;
layout(rg16f, set = 0, binding = 2) uniform writeonly image2D neighbor_max;

void main() {
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    ivec2 tiles = imageSize(tile_max);
    if (any(greaterThanEqual(tile, tiles))) {
        return;
    }
    vec2 size = vec2(textureSize(color_sampler, 0));
    vec2 longest = vec2(0.0);
    for (int y = -1; y <= 1; y++) {
        for (int x = -1; x <= 1; x++) {
            ivec2 near = clamp(tile + ivec2(x, y), ivec2(0), tiles - 1);
            vec2 velocity = imageLoad(tile_max, near).xy;
            if (length(velocity * size) > length(longest * size)) {
                longest = velocity;
            }
        }
    }
    imageStore(neighbor_max, tile, vec4(longest, 0.0, 0.0));
}
