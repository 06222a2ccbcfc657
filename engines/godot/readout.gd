# Reads colour, velocity and depth.
extends "compute.gd"

var _shader := compile(FileAccess.get_file_as_string("res://readout.glsl"))
var _pixels: RID
var _size: Vector2i
var _square: int


func _notification(what: int) -> void:
	if what == NOTIFICATION_PREDELETE and _pixels.is_valid():
		device.free_rid(_pixels)


# Sets the size of what is read, whose pixels are means of squares of drawn ones.
func set_size(size: Vector2i, square: int) -> void:
	if _pixels.is_valid():
		device.free_rid(_pixels)
	_size = size
	_square = square
	_pixels = device.storage_buffer_create(7 * size.x * size.y * 4)


func _render_callback(_type: int, data: RenderData) -> void:
	var drawn: RenderSceneBuffersRD = data.get_render_scene_buffers()
	var uniforms: Array[RDUniform] = [
		texture(0, drawn.get_color_layer(0)),
		texture(1, drawn.get_velocity_layer(0)),
		texture(2, drawn.get_depth_layer(0)),
		buffer(3, _pixels),
	]
	dispatch(_shader, _size, uniforms, PackedInt32Array([_size.x, _size.y, _square, 0]).to_byte_array())


# Returns pictures of 32-bit floats: `color` in RGBA, `velocity` in RG and `depth` in R.
func read() -> Dictionary[String, Image]:
	var bytes := device.buffer_get_data(_pixels)
	var plane := bytes.size() / 7
	return {
		color = _picture(Image.FORMAT_RGBAF, bytes.slice(0, 4 * plane)),
		velocity = _picture(Image.FORMAT_RGF, bytes.slice(4 * plane, 6 * plane)),
		depth = _picture(Image.FORMAT_RF, bytes.slice(6 * plane)),
	}


func _picture(format: Image.Format, bytes: PackedByteArray) -> Image:
	return Image.create_from_data(_size.x, _size.y, false, format, bytes)
