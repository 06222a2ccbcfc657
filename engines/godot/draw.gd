# Draws an exported scene in Godot, and writes a capture: colour, velocity, depth and object ids of the instant, a motion blur of it, and
# sub-frames.
#
#     godot --path engines/godot -s draw.gd --quit-after 1000 -- SCENE_FOLDER CAPTURE_FOLDER WIDTH HEIGHT [EFFECT.gd ..]
#
# Folders are absolute. `--quit-after` ends Godot, which would go on after an error in a script.
# Godot has no motion blur of its own. Without EFFECT, blur.gd blurs; otherwise each is the script of a compositor effect of an add-on
# below addons, in the order in which they run.
extends SceneTree

const Blur := preload("blur.gd")
const Stage := preload("stage.gd")

# A sub-frame's pixel is the mean of a square of this many pixels.
const FINE := 4
# The trails of blur.gd begin at the pixel.
const ALIGNMENT := "trailing"


func _initialize() -> void:
	var words := OS.get_cmdline_user_args()
	if words.size() < 4:
		printerr("usage: godot --path engines/godot -s draw.gd -- SCENE_FOLDER CAPTURE_FOLDER WIDTH HEIGHT [EFFECT.gd ..]")
		quit(2)
		return
	if RenderingServer.get_rendering_device() == null:
		printerr("Godot draws without Vulkan here, and compositor effects need it; start Godot with --verbose to see why")
		quit(1)
		return
	if not FileAccess.file_exists(words[0].path_join("manifest.json")):
		printerr("%s: there is no manifest.json; name a folder that shuttertruth engine export --gltf wrote" % words[0])
		quit(1)
		return
	var out := words[1]
	var size := Vector2i(int(words[2]), int(words[3]))
	var stage := Stage.new(words[0])
	root.add_child(stage)
	DirAccess.make_dir_recursive_absolute(out.path_join("subframes"))

	await stage.prepare(size)
	var instant := await stage.draw_instant()
	for name: String in instant:
		save(instant[name], out, name)

	var effects := [Blur.new()] if words.size() == 4 else Array(words.slice(4)).map(load_effect)
	for effect: CompositorEffect in effects:
		effect.set("intensity", stage.manifest.exposure)
		# An add-on may smear over 1/30 s at most by default. We time no frames: a frame is a frame.
		effect.set("framerate_independent", false)
	await stage.prepare(size, 1, effects)
	var blurred := await stage.draw_instant()
	save(blurred.color, out, "blurred")

	await stage.prepare(size, FINE)
	var times: Array = stage.manifest.subframes[ALIGNMENT]
	for number in times.size():
		var picture := await stage.draw(times[number])
		save(picture.color, out, "subframes/%04d" % number)

	stage.paint_ids()
	await stage.prepare(size)
	var ids := await stage.draw_instant()
	ids.color.convert(Image.FORMAT_RF)
	save(ids.color, out, "object")
	describe(stage, out)
	quit()


func load_effect(path: String) -> CompositorEffect:
	var script: GDScript = load(path)
	assert(script.can_instantiate(), "%s: Godot says above why it does not load it" % path)
	return script.new()


func save(picture: Image, out: String, name: String) -> void:
	var path := out.path_join(name + ".exr")
	var failure := picture.save_exr(path)
	assert(failure == OK, "%s: %s" % [path, error_string(failure)])


# Says what the pictures show, and what Godot's vectors and depth mean.
func describe(stage: Stage, out: String) -> void:
	var version := Engine.get_version_info()
	var adapter := RenderingServer.get_video_adapter_name()
	write(out.path_join("capture.toml"), [
		"engine = \"Godot %d.%d.%d (%s)\"" % [version.major, version.minor, version.patch, adapter],
		"scene = \"%s\"" % stage.manifest.scene,
		"exposure = %s" % stage.manifest.exposure,
		"alignment = \"%s\"" % ALIGNMENT,
	])
	write(out.path_join("engine.toml"), [
		"[convention]",
		"velocity = \"uv\"",
		"velocity_sign = \"previous_minus_current\"",
		"depth = \"reversed\"",
		"near = %s" % Stage.NEAR,
		"far = %s" % Stage.FAR,
	])


func write(path: String, lines: Array) -> void:
	FileAccess.open(path, FileAccess.WRITE).store_string("\n".join(lines) + "\n")
