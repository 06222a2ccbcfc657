// An exported scene in Babylon.js, with its sky and its times.

import * as BABYLON from "@babylonjs/core/index.js";
import { ReadExrDataAsync } from "@babylonjs/core/Materials/Textures/Loaders/exrTextureLoader.js";
import "@babylonjs/loaders/glTF/2.0/index.js";

// The loader counts animations in frames of this length: targetFps, glTF/glTFFileLoader.pure.js:161.
const FRAMES_PER_SECOND = 60;

// Loads the scene, its sky and its manifest, and stops its animation.
export async function loadScene(engine) {
  const manifest = await (await fetch("/scene/manifest.json")).json();
  const scene = new BABYLON.Scene(engine);
  scene.useRightHandedSystem = true;
  // Materials leave their colours linear for a post-process, which does not exist here.
  scene.imageProcessingConfiguration.applyByPostProcess = true;
  // Instances share one id, that of their first mesh.
  await BABYLON.ImportMeshAsync("/scene/scene.gltf", scene, { pluginOptions: { gltf: { createInstances: false } } });
  const camera = (scene.activeCamera = scene.cameras[0]);
  // The exported camera has no far plane, and the depth of an infinite one has no finite value to write.
  camera.maxZ = 1e5;
  await drawSky(scene, `/scene/${manifest.sky}`);
  const numbers = new Map(manifest.objects.map((name, number) => [name, number]));
  const idOf = (node) => (node === null ? 0 : (numbers.get(node.name) ?? idOf(node.parent)));
  for (const group of scene.animationGroups) group.start(false).pause();
  const setTime = (time) => {
    for (const group of scene.animationGroups) group.goToFrame(time * FRAMES_PER_SECOND);
  };
  return { manifest, scene, camera, idOf, setTime };
}

// Draws the sky's radiance on a sphere around the camera. Its middle is towards -Z.
async function drawSky(scene, file) {
  const { width, height, data } = await ReadExrDataAsync(await (await fetch(file)).arrayBuffer());
  const { BILINEAR_SAMPLINGMODE } = BABYLON.Texture;
  const radiance = BABYLON.RawTexture.CreateRGBATexture(data, width, height, scene, false, false, BILINEAR_SAMPLINGMODE, BABYLON.Constants.TEXTURETYPE_FLOAT);
  radiance.wrapU = radiance.wrapV = BABYLON.Texture.WRAP_ADDRESSMODE;
  radiance.gammaSpace = false;
  // Coordinates of the sphere begin at +X, run to the left as seen from within, and down.
  radiance.uScale = radiance.vScale = -1;
  radiance.uOffset = 0.75;
  const material = new BABYLON.PBRMaterial("sky", scene);
  material.unlit = true;
  material.albedoTexture = radiance;
  material.backFaceCulling = false;
  const sky = BABYLON.CreateSphere("sky", { diameter: 4e4, segments: 64 }, scene);
  sky.material = material;
  sky.infiniteDistance = true;
}
