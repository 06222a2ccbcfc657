#[compute]
#version 450
// The longest motion within a tile.

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D velocity_sampler;
layout(rg16f, set = 0, binding = 1) uniform writeonly image2D tile_max;

layout(push_constant, std430) uniform Params {
    int tile_size;
    int padding_0;
    int padding_1;
    int padding_2;
} params;

void main() {
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(tile, imageSize(tile_max)))) {
        return;
    }
    vec2 size = vec2(textureSize(velocity_sampler, 0));
    vec2 longest = vec2(0.0);
    for (int y = 0; y < params.tile_size; y++) {
        for (int x = 0; x < params.tile_size; x++) {
            vec2 uv = (vec2(tile * params.tile_size + ivec2(x, y)) + 0.5) / size;
            vec2 velocity = textureLod(velocity_sampler, uv, 0.0).xy;
            if (length(velocity * size) > length(longest * size)) {
                longest = velocity;
            }
        }
    }
    imageStore(tile_max, tile, vec4(longest, 0.0, 0.0));
}
