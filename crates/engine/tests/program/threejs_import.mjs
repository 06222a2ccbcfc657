// Prints where three.js places the vertices of a glTF file: `node threejs_import.mjs MODEL SECONDS..`
// prints for each time a JSON list of [x, y, z] in metres.

import fs from "node:fs";
import path from "node:path";

import { AnimationMixer, Vector3 } from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";

// Browsers have it; the loader counts bytes with it.
globalThis.ProgressEvent ??= class extends Event {};

const [model, ...times] = process.argv.slice(2);
const gltf = JSON.parse(fs.readFileSync(model));
// Node fetches no files, and has no pictures.
for (const buffer of gltf.buffers) {
  if (buffer.uri.startsWith("data:")) continue;
  const bytes = fs.readFileSync(path.join(path.dirname(model), buffer.uri));
  buffer.uri = `data:application/octet-stream;base64,${bytes.toString("base64")}`;
}
for (const list of ["images", "textures", "materials"]) delete gltf[list];
for (const primitive of gltf.meshes.flatMap((mesh) => mesh.primitives)) delete primitive.material;

const { scene, animations } = await new GLTFLoader().parseAsync(JSON.stringify(gltf), "");
const mixer = new AnimationMixer(scene);
for (const animation of animations) mixer.clipAction(animation).play();

function findPlaces(seconds) {
  mixer.setTime(seconds);
  scene.updateMatrixWorld(true);
  const places = [];
  scene.traverse((thing) => {
    if (!thing.isMesh) return;
    for (let vertex = 0; vertex < thing.geometry.attributes.position.count; vertex++) {
      places.push(thing.localToWorld(thing.getVertexPosition(vertex, new Vector3())).toArray());
    }
  });
  return places;
}

console.log(JSON.stringify(times.map((time) => findPlaces(Number(time)))));
