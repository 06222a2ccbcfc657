// Pictures that three.js draws: colour, velocity, depth and object ids of the instant, its blur of them, and sub-frames.

import * as THREE from "three/webgpu";
import { Fn, float, mrt, output, pass, texture, userData, uv, vec2, vec4, velocity } from "three/tsl";
import { EXRLoader } from "three/addons/loaders/EXRLoader.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { motionBlur } from "three/addons/tsl/display/MotionBlur.js";
import { MESHES } from "./meshes.js";
import { putOriginalInPlace } from "./original.js";

// A pixel's colour is the mean over its square, of this many places in each direction.
const COLOR_SAMPLES = 4;

// Draws the scene at /scene/ and hands every picture to `receiver`, rows from the top.
export async function captureScene(settings, receiver) {
  const { width, height } = settings;
  if (document.createElement("canvas").getContext("webgl2") === null) throw new Error("no WebGL 2 in this browser");
  const renderer = new THREE.WebGPURenderer({ forceWebGL: true, outputBufferType: THREE.FloatType });
  renderer.setPixelRatio(1);
  renderer.setSize(width, height);
  await renderer.init();
  const played = await loadScene(settings, width / height);
  const { manifest, camera } = played;
  const engine = `three.js 0.${THREE.REVISION}.0 (${nameAdapter(renderer)})`;
  await receiver.about({ engine, near: camera.near, far: camera.far }, manifest);

  const { color, depth, blurs, gbuffer } = planDrawing(settings, played);
  const nextFrame = () =>
    new Promise((resolve) => {
      renderer.setAnimationLoop(() => {
        renderer.setAnimationLoop(null);
        resolve();
      });
    });
  // Draws the scene at an animation time into a frame of its own, since three.js remembers the previous frame's matrices.
  const draw = async (time, quads) => {
    await nextFrame();
    played.setTime(time);
    for (const { quad, target } of quads) {
      renderer.setRenderTarget(target);
      quad.render(renderer);
    }
    renderer.setRenderTarget(null);
  };
  const read = async (target, channels, attachment = 0) => {
    const pixels = await renderer.readRenderTargetPixelsAsync(target, 0, 0, width, height, attachment);
    return arrange(pixels, width, height, channels);
  };
  const sendColor = async (name, target) => receiver.picture(name, ["R", "G", "B"], await read(target, 3));
  // three.js's mesh of the sky has no id of its own, and leaves depth as cleared.
  const readIds = async (distance) => {
    const ids = await read(gbuffer.renderTarget, 1, attachmentOf(gbuffer, "object"));
    return ids.map((id, at) => (distance[at] === 1 ? 0 : id));
  };

  const instant = [color, depth, ...blurs];
  if (settings.before !== "none") await draw(manifest.instant - settings.before * manifest.seconds_per_frame, instant);
  await draw(manifest.instant, instant);
  const distance = await read(depth.target, 1);
  const motion = await read(gbuffer.renderTarget, 2, attachmentOf(gbuffer, "velocity"));
  await receiver.picture("velocity", ["velocity.X", "velocity.Y"], motion);
  await receiver.picture("depth", ["Z"], distance);
  await receiver.picture("object", ["object"], await readIds(distance));
  for (const { name, target } of [color, ...blurs]) await sendColor(name, target);

  // A centred shutter, since the taps of three.js are on both sides of a pixel.
  const open = manifest.instant - (settings.exposure / 2) * manifest.seconds_per_frame;
  for (let at = 0; at < settings.subframes; at++) {
    const part = ((at + 0.5) / settings.subframes) * settings.exposure;
    await draw(open + part * manifest.seconds_per_frame, [color, depth]);
    const ids = await readIds(await read(depth.target, 1));
    const pixels = await read(color.target, 4);
    ids.forEach((id, pixel) => (pixels[pixel * 4 + 3] = id));
    await receiver.picture(`subframes/${String(at).padStart(4, "0")}`, ["R", "G", "B", "object"], pixels);
  }
}

// The passes over the scene, and the quads that make pictures from them.
function planDrawing({ width, height, exposure, samples }, { scene, camera }) {
  const options = { type: THREE.FloatType, samples: 0 };
  const gbuffer = pass(scene, camera, options);
  gbuffer.setMRT(mrt({ output, velocity, object: vec4(userData("object", "float"), 0, 0, 1) }));
  const motion = gbuffer.getTextureNode("velocity");
  gbuffer.getTextureNode("object");
  const fine = pass(scene, camera, options).setResolutionScale(COLOR_SAMPLES);

  const picture = (name, node) => {
    const material = new THREE.NodeMaterial();
    material.fragmentNode = node;
    const target = new THREE.RenderTarget(width, height, { type: THREE.FloatType, depthBuffer: false });
    return { name, target, quad: new THREE.QuadMesh(material) };
  };
  const color = picture("color", averageSquares(fine.getTextureNode(), width, height));
  const depth = picture("depth", vec4(gbuffer.getTextureNode("depth").r, 0, 0, 1));
  // The blur adds `velocity` to texture coordinates. These span 1 over the picture and velocity spans 2, so this is the length
  // of the exposure.
  const amount = exposure / 2;
  const input = texture(color.target.texture);
  const blur = (name, scale) => picture(name, motionBlur(input, motion.mul(scale), samples));
  const blurs = [
    blur("blurred", vec2(amount, amount)),
    // As the example of three.js has it: velocity as it is.
    blur("blurred_default", vec2(1, 1)),
    // The result if the blur mistook velocity up for coordinates down.
    blur("blurred_y_turned", vec2(amount, -amount)),
  ];
  return { gbuffer, color, depth, blurs };
}

// Averages squares of a picture finer than its pixels.
function averageSquares(source, width, height) {
  return Fn(() => {
    const sum = vec4(0).toVar();
    for (let y = 0; y < COLOR_SAMPLES; y++) {
      for (let x = 0; x < COLOR_SAMPLES; x++) {
        const offset = (at, size) => ((at + 0.5) / COLOR_SAMPLES - 0.5) / size;
        sum.addAssign(source.sample(uv().add(vec2(offset(x, width), offset(y, height)))));
      }
    }
    return sum.div(float(COLOR_SAMPLES ** 2));
  })();
}

const attachmentOf = (pass, name) => pass.renderTarget.textures.findIndex((texture) => texture.name === name);

function nameAdapter(renderer) {
  const gl = renderer.getContext();
  const names = gl.getExtension("WEBGL_debug_renderer_info");
  return gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
}

// Converts pixels with four channels, rows from the bottom, to fewer channels, rows from the top.
function arrange(read, width, height, channels) {
  const pixels = new Float32Array(width * height * channels);
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      const from = ((height - 1 - y) * width + x) * 4;
      for (let at = 0; at < channels; at++) pixels[(y * width + x) * channels + at] = read[from + at];
    }
  }
  return pixels;
}

// Loads the scene, its sky and its manifest, and stops its animation.
async function loadScene({ meshes, near, original, at, fps }, aspect) {
  const manifest = await (await fetch("/scene/manifest.json")).json();
  const gltf = await new GLTFLoader().loadAsync("/scene/scene.gltf");
  const { cameras, animations, parser } = gltf;
  const scene = new THREE.Scene().add(gltf.scene);
  nameObjects(scene, parser, manifest.objects.length);
  const sky = await new EXRLoader().setDataType(THREE.FloatType).loadAsync(`/scene/${manifest.sky}`);
  sky.mapping = THREE.EquirectangularReflectionMapping;
  scene.background = scene.environment = sky;
  // The middle of the sky is towards -Z; three.js expects it towards +X.
  scene.backgroundRotation.y = scene.environmentRotation.y = Math.PI / 2;
  const camera = cameras[0];
  camera.aspect = aspect;
  if (near !== "exported") camera.near = near;
  camera.updateProjectionMatrix();
  const players = [{ mixer: play(gltf.scene, animations), secondsAt: (time) => time }];
  if (original) {
    const file = await new GLTFLoader().loadAsync(`/original/${original}`);
    putOriginalInPlace(scene, file, manifest);
    const secondsAt = (time) => at + (time - manifest.instant) / manifest.seconds_per_frame / fps;
    players.push({ mixer: play(file.scene, file.animations.slice(0, 1)), secondsAt });
  }
  const follow = MESHES[meshes](scene);
  const setTime = (time) => {
    for (const { mixer, secondsAt } of players) mixer.setTime(secondsAt(time));
    scene.updateMatrixWorld(true);
    follow();
  };
  return { manifest, scene, camera, setTime };
}

// Plays clips of a file that stop at their ends.
function play(root, clips) {
  const mixer = new THREE.AnimationMixer(root);
  for (const clip of clips) {
    const action = mixer.clipAction(clip).setLoop(THREE.LoopOnce);
    action.clampWhenFinished = true;
    action.play();
  }
  return mixer;
}

// Gives every mesh its object's id, which is its node's number.
function nameObjects(scene, parser, objects) {
  scene.traverse((object) => {
    const own = parser.associations.get(object)?.nodes;
    const id = own ?? object.parent?.userData.object;
    object.userData.object = id > 0 && id < objects ? id : 0;
  });
}
