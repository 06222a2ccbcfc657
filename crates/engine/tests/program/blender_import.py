"""Compares an imported scene with what Blender makes of the same glTF file.

usage: python3 blender_import.py MODEL SCENE SECONDS RATE     (with bpy)
       blender -b --python blender_import.py -- MODEL SCENE SECONDS RATE

Prints the farthest that a vertex of the scene is from Blender's nearest one, and the other way round, at whole frames from -1 to
1, in metres or in parts of its distance from the origin if that is larger, and the difference of the cameras.
SECONDS is the animation's time at the frame.
"""

import os
import sys
import tomllib

import bpy
import numpy
from mathutils import Matrix, Quaternion, Vector
from mathutils.kdtree import KDTree


# The importer of Blender 3.4 uses a name that numpy 1.24 removed.
numpy.bool = bool


def read_obj(path):
    with open(path) as file:
        words = (line.split() for line in file if line.startswith("v "))
        return [Vector([float(number) for number in parts[1:4]]) for parts in words]


def pose(table):
    scale = table.get("scale", [1, 1, 1])
    x, y, z, w = table.get("rotation", [0, 0, 0, 1])
    matrix = Matrix.LocRotScale(
        Vector(table.get("translation", [0, 0, 0])), Quaternion((w, x, y, z)), Vector(scale))
    return matrix


def at(keys, time):
    """Returns the key at a time; whole frames have one."""
    return next((key for key in keys if abs(key["time"] - time) < 1e-6), None)


def scene_points(folder, document, time):
    """Returns the vertices of the imported objects in the world at a time."""
    points = []
    is_framed = find_camera() is None
    for name, table in document["object"].items():
        if is_framed and name in ("floor", "wall") or name.startswith("point_light_"):
            continue
        if "shapes" in table:
            points += read_obj(os.path.join(folder, at(table["shapes"], time)["mesh"]))
        else:
            matrix = pose(at(table["keys"], time) if "keys" in table else table)
            points += [matrix @ point for point in read_obj(os.path.join(folder, table["mesh"]))]
    return points


def to_gltf(point):
    """Turns Blender's +Z up into +Y up."""
    return Vector((point.x, point.z, -point.y))


def blender_points():
    graph = bpy.context.evaluated_depsgraph_get()
    points = []
    for thing in bpy.context.scene.objects:
        # Blender adds balls that show bones.
        if thing.type == "MESH" and thing.visible_get() and not thing.name.startswith("Icosphere"):
            shown = thing.evaluated_get(graph)
            mesh = shown.to_mesh()
            used = {corner for face in mesh.polygons for corner in face.vertices}
            points += [to_gltf(shown.matrix_world @ mesh.vertices[corner].co) for corner in used]
            shown.to_mesh_clear()
    return points


def farthest(points, others):
    tree = KDTree(len(others))
    for index, point in enumerate(others):
        tree.insert(point, index)
    tree.balance()
    return max(tree.find(point)[2] / max(1.0, point.length) for point in points)


def find_camera():
    """Returns the file's camera; without one, the import frames the model and adds a floor and a wall."""
    cameras = (thing for thing in bpy.context.scene.objects if thing.type == "CAMERA")
    return next(cameras, None)


def camera_difference(document, time):
    """Returns how far position and axes of the cameras are apart; none if the scene's is framed."""
    camera = find_camera()
    if camera is None:
        return None
    keys = document["camera"].get("keys")
    table = at(keys, time) if keys else document["camera"]
    x, y, z, w = table["rotation"]
    ours = Quaternion((w, x, y, z)).to_matrix()
    theirs = camera.matrix_world
    off = (to_gltf(theirs.translation) - Vector(table["position"])).length
    for axis in range(3):
        direction = theirs.to_3x3().col[axis].normalized()
        off = max(off, (to_gltf(direction) - ours.col[axis]).length)
    return off


def main():
    words = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else sys.argv[1:]
    model, folder, seconds, rate = words[0], words[1], float(words[2]), float(words[3])
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=model)
    with open(os.path.join(folder, "scene.toml"), "rb") as file:
        document = tomllib.load(file)
    scene = bpy.context.scene
    fps = scene.render.fps / scene.render.fps_base
    worst = 0.0
    for time in (-1, 0, 1):
        frame = (seconds + time / rate) * fps
        whole = int(frame // 1)
        scene.frame_set(whole, subframe=frame - whole)
        ours, theirs = scene_points(folder, document, time), blender_points()
        there, back = farthest(ours, theirs), farthest(theirs, ours)
        worst = max(worst, there, back)
        camera = camera_difference(document, time)
        print(f"frame {time}: vertices {there:.2e} and {back:.2e}; camera "
              + ("none" if camera is None else f"{camera:.2e}"))
        worst = max(worst, camera or 0.0)
    print(f"worst: {worst:.2e}")
    sys.stdout.flush()
    # The module of Blender crashes at the end of Python.
    os._exit(0)


main()
