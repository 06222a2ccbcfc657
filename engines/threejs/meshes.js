// Ways to draw the same objects, each with its own vectors.

import * as THREE from "three/webgpu";

// Functions that prepare a scene for each way, and return a callback for each step of the animation.
export const MESHES = { plain: () => () => {}, unculled: drawUnculled, instanced: drawInstanced, skinned: drawSkinned };

// Draws every mesh, visible or not.
function drawUnculled(scene) {
  scene.traverse((object) => (object.frustumCulled = false));
  return () => {};
}

// Replaces every mesh with an InstancedMesh of one instance, which follows it.
function drawInstanced(scene) {
  const pairs = replaceMeshes(scene, (mesh) => {
    const instances = new THREE.InstancedMesh(mesh.geometry, mesh.material, 1);
    instances.instanceMatrix.setUsage(THREE.DynamicDrawUsage);
    return instances;
  });
  return () => {
    for (const { mesh, drawn } of pairs) {
      drawn.setMatrixAt(0, mesh.matrixWorld);
      drawn.instanceMatrix.needsUpdate = true;
    }
  };
}

// Replaces every mesh with a SkinnedMesh of one bone, which follows it.
function drawSkinned(scene) {
  const pairs = replaceMeshes(scene, (mesh) => {
    const { count } = mesh.geometry.attributes.position;
    mesh.geometry.setAttribute("skinIndex", new THREE.Uint16BufferAttribute(new Uint16Array(count * 4), 4));
    const weights = Float32Array.from({ length: count * 4 }, (_, at) => (at % 4 === 0 ? 1 : 0));
    mesh.geometry.setAttribute("skinWeight", new THREE.BufferAttribute(weights, 4));
    const skin = new THREE.SkinnedMesh(mesh.geometry, mesh.material);
    const bone = new THREE.Bone();
    bone.matrixAutoUpdate = false;
    skin.add(bone);
    skin.bind(new THREE.Skeleton([bone], [new THREE.Matrix4()]), new THREE.Matrix4());
    return skin;
  });
  return () => {
    for (const { mesh, drawn } of pairs) {
      drawn.children[0].matrix.copy(mesh.matrixWorld);
      drawn.updateMatrixWorld(true);
    }
  };
}

function replaceMeshes(scene, make) {
  const meshes = [];
  scene.traverse((object) => object.isMesh && meshes.push(object));
  return meshes.map((mesh) => {
    const drawn = make(mesh);
    drawn.userData.object = mesh.userData.object;
    drawn.frustumCulled = false;
    drawn.morphTargetInfluences = mesh.morphTargetInfluences;
    scene.add(drawn);
    mesh.layers.disableAll();
    return { mesh, drawn };
  });
}
