# An exported scene, its sky and its camera. Its time is set by hand.
extends SubViewport

const Readout := preload("readout.gd")

# Godot samples a file's animation at a fixed rate: 32 times a frame, since exported keys lie on that raster.
const SAMPLES_PER_FRAME := 32
# Godot compiles what it draws first while it draws.
const WARM_UP_FRAMES := 4
# The exported camera has no far plane, and Godot's does.
const NEAR := 0.05
const FAR := 1e5

var manifest: Dictionary
var _camera: Camera3D
var _animation: AnimationPlayer
var _readout := Readout.new()


func _init(folder: String) -> void:
	manifest = JSON.parse_string(FileAccess.get_file_as_string(folder.path_join("manifest.json")))
	own_world_3d = true
	render_target_update_mode = SubViewport.UPDATE_ALWAYS
	var document := GLTFDocument.new()
	var file := GLTFState.new()
	var failure := document.append_from_file(folder.path_join("scene.gltf"), file)
	assert(failure == OK, "%s: %s" % [folder, error_string(failure)])
	var scene := document.generate_scene(file, SAMPLES_PER_FRAME / manifest.seconds_per_frame)
	add_child(scene)
	_animation = scene.find_children("*", "AnimationPlayer")[0]
	_camera = scene.find_children("*", "Camera3D")[0]
	_camera.near = NEAR
	_camera.far = FAR
	_camera.environment = _environment(folder.path_join(manifest.sky))
	_camera.compositor = Compositor.new()


func _ready() -> void:
	_camera.current = true


# Shows the sky behind the scene, and lights nothing with it.
func _environment(sky: String) -> Environment:
	var panorama := PanoramaSkyMaterial.new()
	panorama.panorama = ImageTexture.create_from_image(Image.load_from_file(sky))
	var environment := Environment.new()
	environment.background_mode = Environment.BG_SKY
	environment.sky = Sky.new()
	environment.sky.sky_material = panorama
	environment.ambient_light_source = Environment.AMBIENT_SOURCE_DISABLED
	environment.reflected_light_source = Environment.REFLECTION_SOURCE_DISABLED
	return environment


# Sets the size of what is read, whose pixels are means of squares of drawn ones, and the effects that run before it is read.
func prepare(read_size: Vector2i, square := 1, effects := []) -> void:
	size = read_size * square
	_readout.set_size(read_size, square)
	_camera.compositor.compositor_effects = Array(effects + [_readout], TYPE_OBJECT, "CompositorEffect", null)
	for frame in WARM_UP_FRAMES:
		await draw(manifest.previous)


# Draws the frame before, which vectors lead to, and the instant.
func draw_instant() -> Dictionary[String, Image]:
	await draw(manifest.previous)
	return await draw(manifest.instant)


func draw(time: float) -> Dictionary[String, Image]:
	_animation.play("scene")
	_animation.seek(time, true)
	_animation.pause()
	await RenderingServer.frame_post_draw
	return _readout.read()


# Gives everything the colour of its number.
func paint_ids() -> void:
	var names: Array = manifest.objects.map(func(object: String) -> String: return object.validate_node_name())
	for mesh: MeshInstance3D in find_children("*", "MeshInstance3D", true, false):
		var node: Node = mesh
		while String(node.name) not in names:
			node = node.get_parent()
		var material := ShaderMaterial.new()
		material.shader = Shader.new()
		material.shader.code = """
			shader_type spatial;
			render_mode unshaded, cull_disabled, fog_disabled;
			void fragment() { ALBEDO = vec3(%d.0); }
		""" % names.find(node.name)
		mesh.material_override = material
	_camera.environment.background_mode = Environment.BG_COLOR
	_camera.environment.background_color = Color.BLACK
