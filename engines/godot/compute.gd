# A compositor effect that runs compute shaders on what the camera drew, before Godot's tone mapping.
extends CompositorEffect

const GROUP := 8.0

var device := RenderingServer.get_rendering_device()
var nearest := _create_sampler(RenderingDevice.SAMPLER_FILTER_NEAREST)
var linear := _create_sampler(RenderingDevice.SAMPLER_FILTER_LINEAR)
var _pipelines: Dictionary[RID, RID]


func _init() -> void:
	effect_callback_type = EFFECT_CALLBACK_TYPE_POST_TRANSPARENT
	needs_motion_vectors = true
	access_resolved_color = true
	access_resolved_depth = true


func _notification(what: int) -> void:
	if what == NOTIFICATION_PREDELETE:
		# A shader's pipeline goes with it.
		for id: RID in _pipelines.keys() + [nearest, linear]:
			device.free_rid(id)


func compile(code: String) -> RID:
	var source := RDShaderSource.new()
	source.source_compute = code.trim_prefix("#[compute]")
	var program := device.shader_compile_spirv_from_source(source)
	assert(program.compile_error_compute.is_empty(), program.compile_error_compute)
	var shader := device.shader_create_from_spirv(program)
	_pipelines[shader] = device.compute_pipeline_create(shader)
	return shader


# Runs a shader once per pixel, in groups of 8 by 8.
func dispatch(shader: RID, size: Vector2i, uniforms: Array[RDUniform], constants := PackedByteArray()) -> void:
	var list := device.compute_list_begin()
	device.compute_list_bind_compute_pipeline(list, _pipelines[shader])
	device.compute_list_bind_uniform_set(list, UniformSetCacheRD.get_cache(shader, 0, uniforms), 0)
	if not constants.is_empty():
		device.compute_list_set_push_constant(list, constants, constants.size())
	device.compute_list_dispatch(list, ceili(size.x / GROUP), ceili(size.y / GROUP), 1)
	device.compute_list_end()


func texture(binding: int, id: RID, sampler := nearest) -> RDUniform:
	return _uniform(RenderingDevice.UNIFORM_TYPE_SAMPLER_WITH_TEXTURE, binding, [sampler, id])


func image(binding: int, id: RID) -> RDUniform:
	return _uniform(RenderingDevice.UNIFORM_TYPE_IMAGE, binding, [id])


func buffer(binding: int, id: RID) -> RDUniform:
	return _uniform(RenderingDevice.UNIFORM_TYPE_STORAGE_BUFFER, binding, [id])


func _uniform(type: RenderingDevice.UniformType, binding: int, ids: Array) -> RDUniform:
	var uniform := RDUniform.new()
	uniform.uniform_type = type
	uniform.binding = binding
	for id: RID in ids:
		uniform.add_id(id)
	return uniform


func _create_sampler(filter: RenderingDevice.SamplerFilter) -> RID:
	var state := RDSamplerState.new()
	state.mag_filter = filter
	state.min_filter = filter
	return device.sampler_create(state)
