#version 450
// Colours averaged along the motion, as a pass over the picture.
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 result;
layout(set = 0, binding = 0) uniform sampler2D scene_color;
layout(set = 0, binding = 1) uniform sampler2D motion_vectors;

layout(set = 0, binding = 2, std140) uniform Blur {
    float exposure;
    int samples;
} blur;

void main() {
    vec2 trail = textureLod(motion_vectors, uv, 0.0).xy * blur.exposure;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < blur.samples; i++) {
        float along = (float(i) + 0.5) / float(blur.samples);
        sum += textureLod(scene_color, uv + along * trail, 0.0);
    }
    result = sum / float(blur.samples);
}
