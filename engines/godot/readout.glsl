#version 450

// Copies what the camera drew into a buffer, colours as the mean of squares.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D color;
layout(set = 0, binding = 1) uniform sampler2D velocity;
layout(set = 0, binding = 2) uniform sampler2D depth;
layout(set = 0, binding = 3, std430) restrict writeonly buffer Pixels {
    float pixels[]; // R G B A of all pixels, then X Y of their velocity, then their depth
};

layout(push_constant, std430) uniform Parameters {
    ivec2 size; // of the result
    int square; // side, in pixels of what was drawn
    int unused;
};

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, size))) {
        return;
    }
    vec4 sum = vec4(0.0);
    for (int y = 0; y < square; y++) {
        for (int x = 0; x < square; x++) {
            sum += texelFetch(color, at * square + ivec2(x, y), 0);
        }
    }
    int index = at.y * size.x + at.x;
    int count = size.x * size.y;
    vec4 mean = sum / float(square * square);
    vec2 motion = texelFetch(velocity, at * square, 0).xy;
    for (int channel = 0; channel < 4; channel++) {
        pixels[4 * index + channel] = mean[channel];
    }
    for (int channel = 0; channel < 2; channel++) {
        pixels[4 * count + 2 * index + channel] = motion[channel];
    }
    pixels[6 * count + index] = texelFetch(depth, at * square, 0).x;
}
