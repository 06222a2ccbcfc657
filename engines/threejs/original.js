// The glTF file that a scene was imported from, drawn in the place of its import.

import * as THREE from "three/webgpu";

// Objects that the import added to the file's.
const ADDED = ["floor", "wall"];

// Exchanges the meshes of a scene for those of the original; the scene's camera, lights, floor and wall stay.
export function putOriginalInPlace(scene, original, manifest) {
  const isUnlit = manifest.scene.endsWith("@unlit");
  scene.traverse((object) => {
    const { object: number } = object.userData;
    if (object.isMesh && number > 0 && !ADDED.includes(manifest.objects[number])) object.layers.disableAll();
  });
  const others = [];
  original.scene.traverse((object) => {
    if (object.isLight || object.isCamera) others.push(object);
    if (object.isMesh && isUnlit) object.material = unlit(object.material);
    // Bones move a mesh out of the bounds of its rest pose.
    object.frustumCulled = false;
  });
  for (const other of others) other.removeFromParent();
  numberObjects(original, manifest);
  scene.add(original.scene);
}

// Gives every mesh the number that the scene has for its node's name. The import writes `_` for other signs than letters, and
// invents a name where there is none.
function numberObjects({ scene, parser }, manifest) {
  const plain = (name) => (name ?? "").replace(/\W/g, "_");
  const numbers = new Map(manifest.objects.map((name, number) => [plain(name), number]));
  for (const name of ["background", ...ADDED]) numbers.delete(name);
  const unnamed = [];
  const number = (object, name) => {
    object.userData.object = numbers.get(name);
    numbers.delete(name);
  };
  scene.traverse((object) => {
    const node = parser.associations.get(object)?.nodes;
    if (node === undefined || parser.json.nodes[node].mesh === undefined) return;
    const name = plain(parser.json.nodes[node].name);
    if (numbers.has(name)) number(object, name);
    else unnamed.push(object);
  });
  if (unnamed.length !== numbers.size || unnamed.length > 1) {
    const nodes = unnamed.map((object) => object.name || "a node without a name");
    throw new Error(`[${[...numbers.keys()]}] of the scene are not in the original, and [${nodes}] of the original not in the scene`);
  }
  if (unnamed.length === 1) number(unnamed[0], [...numbers.keys()][0]);
  // The primitives of a mesh are its node's children.
  scene.traverse((object) => (object.userData.object ??= object.isMesh ? object.parent.userData.object : undefined));
}

function unlit(material) {
  const { color, map, side, alphaTest, transparent, opacity, vertexColors } = material;
  return new THREE.MeshBasicMaterial({ color, map, side, alphaTest, transparent, opacity, vertexColors });
}
