# The blur that our page of Godot begins with: one pass, which reads colour and velocity.
extends "compute.gd"

# Beside this project.
const SHADER := "../../examples/first_blur/godot/blur.glsl"
# Writes the result over the colour.
const COPY := """
#version 450
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D result;
layout(rgba16f, set = 0, binding = 1) uniform writeonly image2D color;
void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(at, imageSize(color)))) imageStore(color, at, texelFetch(result, at, 0));
}
"""

# How long the trails are, in frames.
var intensity := 1.0
var samples := 8
var _blur := compile(FileAccess.get_file_as_string(ProjectSettings.globalize_path("res://") + SHADER))
var _copy := compile(COPY)


func _render_callback(_type: int, data: RenderData) -> void:
	var drawn: RenderSceneBuffersRD = data.get_render_scene_buffers()
	var size := drawn.get_internal_size()
	var usage := RenderingDevice.TEXTURE_USAGE_SAMPLING_BIT | RenderingDevice.TEXTURE_USAGE_STORAGE_BIT
	var format := RenderingDevice.DATA_FORMAT_R16G16B16A16_SFLOAT
	var result := drawn.create_texture("blur", "result", format, usage, RenderingDevice.TEXTURE_SAMPLES_1, size, 1, 1, true, false)
	var color := drawn.get_color_layer(0)
	var constants := PackedFloat32Array([intensity]).to_byte_array() + PackedInt32Array([samples, 0, 0]).to_byte_array()
	dispatch(_blur, size, [texture(0, color, linear), texture(1, drawn.get_velocity_layer(0)), image(2, result)], constants)
	dispatch(_copy, size, [texture(0, result), image(1, color)])
