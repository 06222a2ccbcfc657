// Pictures that Babylon.js draws: colour, velocity, depth and object ids of the instant, its blur of them, and sub-frames.
// Lines of its source are those of the npm packages @babylonjs/core and @babylonjs/loaders 9.28.0.

import * as BABYLON from "@babylonjs/core/index.js";
import { loadScene } from "./scene.js";

// A pixel's colour is the mean over its square, of this many places in each direction.
const COLOR_SAMPLES = 4;
const WARM_UP_FRAMES = 3;
const FLOAT = BABYLON.Constants.TEXTURETYPE_FLOAT;
const { SCREENSPACE_DEPTH_TEXTURE_TYPE, VELOCITY_TEXTURE_TYPE, OBJECT_ID_TEXTURE_TYPE } = BABYLON.GeometryBufferRenderer;

// Draws the scene at /scene/ and hands every picture to `receiver`, rows from the top.
export async function captureScene(settings, receiver) {
  const { width, height } = settings;
  const canvas = Object.assign(document.createElement("canvas"), { width, height });
  if (document.createElement("canvas").getContext("webgl2") === null) throw new Error("no WebGL 2 in this browser");
  const engine = new BABYLON.Engine(canvas, false);
  // The blur is longer the longer the last frame took, and is a frame's motion at 60 per second: motionScale in
  // PostProcesses/thinMotionBlurPostProcess.js:86, getAnimationRatio in scene.pure.js:4304.
  engine.getDeltaTime = () => 1000 / 60;
  const played = await loadScene(engine);
  const { manifest, scene, camera } = played;
  const adapter = engine.getGlInfo().renderer;
  await receiver.about({ engine: `Babylon.js ${BABYLON.Engine.Version} (${adapter})`, near: camera.minZ, far: camera.maxZ }, manifest);

  const fine = new BABYLON.RenderTargetTexture("fine", { width: width * COLOR_SAMPLES, height: height * COLOR_SAMPLES }, scene, {
    type: FLOAT,
    generateMipMaps: false,
    samplingMode: BABYLON.Texture.NEAREST_SAMPLINGMODE,
  });
  fine.renderList = null;
  fine.activeCamera = camera;
  scene.customRenderTargets.push(fine);
  const gbuffer = drawGbuffer(played);
  const draw = async (time) => {
    played.setTime(time);
    await scene.whenReadyAsync(true);
    scene.render();
  };
  const readColor = async () => averageSquares(await fine.readPixels(), width, height);
  const readGbuffer = (type) => gbuffer.getGBuffer().textures[gbuffer.getTextureIndex(type)].readPixels();
  const readIds = async () => {
    const ids = await readGbuffer(OBJECT_ID_TEXTURE_TYPE);
    return Float32Array.from({ length: width * height }, (_, at) => ids[at * 4] * 65536 + ids[at * 4 + 1] * 256 + ids[at * 4 + 2]);
  };
  const send = (name, channels, pixels) => receiver.picture(name, channels, fromTop(pixels, width, height));

  // Babylon.js leaves out what is not compiled when it is drawn first, though the scene is ready.
  const warmUp = async () => {
    for (let at = 0; at < WARM_UP_FRAMES; at++) await draw(manifest.instant);
  };
  await warmUp();

  // A centred shutter, since the taps of the blur are on both sides of a pixel.
  const open = manifest.instant - (settings.exposure / 2) * manifest.seconds_per_frame;
  for (let at = 0; at < settings.subframes; at++) {
    const part = ((at + 0.5) / settings.subframes) * settings.exposure;
    await draw(open + part * manifest.seconds_per_frame);
    const ids = await readIds();
    const pixels = await readColor();
    ids.forEach((id, pixel) => (pixels[pixel * 4 + 3] = id));
    await send(`subframes/${String(at).padStart(4, "0")}`, ["R", "G", "B", "object"], pixels);
  }

  const drawInstant = async () => {
    if (settings.before !== "none") await draw(manifest.instant - settings.before * manifest.seconds_per_frame);
    await draw(manifest.instant);
  };
  await drawInstant();
  const ids = await readIds();
  const encoded = await readGbuffer(VELOCITY_TEXTURE_TYPE);
  const depth = await readGbuffer(SCREENSPACE_DEPTH_TEXTURE_TYPE);
  const color = await readColor();
  await send("velocity", ["velocity.X", "velocity.Y"], decodeVelocity(encoded));
  // Babylon.js clears depth to 0, which is the near plane.
  await send("depth", ["Z"], ids.map((id, at) => (id === 0 ? 1 : depth[at * 4])));
  await send("object", ["object"], ids);
  await send("color", ["R", "G", "B"], color.filter((_, at) => at % 4 < 3));

  scene.customRenderTargets.length = 0;
  scene.disableGeometryBufferRenderer();
  const { blur, blurred } = blurPicture(played, color, width, height);
  await warmUp();
  // motionStrength is a factor on the motion of the last frame, and the taps span that length around the pixel:
  // Shaders/motionBlur.fragment.js:15-17.
  for (const [name, strength] of [["blurred", settings.exposure], ["blurred_default", 1]]) {
    blur.motionStrength = strength;
    await drawInstant();
    await send(name, ["R", "G", "B"], (await blurred()).filter((_, at) => at % 4 < 3));
  }
}

// Makes Babylon.js draw velocity, depth and object ids as floats. The blur's own velocity has bytes: TextureFormats of
// Rendering/prePassRenderer.pure.js:780.
function drawGbuffer({ scene, idOf }) {
  const gbuffer = scene.enableGeometryBufferRenderer();
  gbuffer.enableNormal = false;
  gbuffer.enableVelocity = true;
  gbuffer.enableScreenspaceDepth = true;
  gbuffer.enableObjectId = true;
  gbuffer.objectIdProvider = idOf;
  return gbuffer;
}

// Makes Babylon.js blur a picture instead of what it draws; returns the blur, and a function that reads its result.
function blurPicture({ scene, camera }, pixels, width, height) {
  const engine = scene.getEngine();
  const texture = BABYLON.RawTexture.CreateRGBATexture(pixels, width, height, scene, false, false, BABYLON.Texture.NEAREST_SAMPLINGMODE, FLOAT);
  const pass = (name) => new BABYLON.PassPostProcess(name, 1, camera, BABYLON.Texture.NEAREST_SAMPLINGMODE, engine, false, FLOAT);
  pass("picture").onApply = (effect) => effect.setTexture("textureSampler", texture);
  // Without arguments it would clip colours at 1 and store them in bytes.
  const blur = new BABYLON.MotionBlurPostProcess("blur", scene, 1, camera, undefined, engine, false, FLOAT);
  const end = pass("end");
  scene.onBeforeRenderObservable.add(() => readVelocityExactly(scene.prePassRenderer));
  return { blur, blurred: () => new BABYLON.BaseTexture(engine, end.inputTexture.texture).readPixels() };
}

// Mesa's llvmpipe mixes neighbours in anisotropic textures, even at level 0; graphics cards do not.
function readVelocityExactly(prepass) {
  const velocity = prepass.getRenderTarget().textures[prepass.getIndex(BABYLON.Constants.PREPASS_VELOCITY_TEXTURE_TYPE)];
  if (velocity) velocity.anisotropicFilteringLevel = 1;
}

// Inverts the encoding of Shaders/geometry.fragment.js:158, and doubles parts of the picture to normalised device coordinates.
// Alpha is 0 where nothing was drawn.
function decodeVelocity(encoded) {
  const decode = (value, alpha) => 2 * (2 * value - 1) ** 3 * alpha;
  return Float32Array.from({ length: encoded.length / 2 }, (_, at) => decode(encoded[(at >> 1) * 4 + (at & 1)], encoded[(at >> 1) * 4 + 3]));
}

// Averages squares of a picture finer than its pixels, of four channels.
function averageSquares(fine, width, height) {
  const mean = new Float32Array(width * height * 4);
  fine.forEach((value, at) => {
    const pixel = at >> 2;
    const x = Math.floor((pixel % (width * COLOR_SAMPLES)) / COLOR_SAMPLES);
    const y = Math.floor(pixel / (width * COLOR_SAMPLES ** 2));
    mean[(y * width + x) * 4 + (at & 3)] += value / COLOR_SAMPLES ** 2;
  });
  return mean;
}

// Reverses the rows, which WebGL reads from the bottom.
function fromTop(pixels, width, height) {
  const row = pixels.length / height;
  const turned = new Float32Array(pixels.length);
  for (let y = 0; y < height; y++) turned.set(pixels.subarray(y * row, (y + 1) * row), (height - 1 - y) * row);
  return turned;
}
