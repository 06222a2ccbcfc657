// The command line that `capture` and `view` share.

import fs from "node:fs";
import path from "node:path";
import { parseArgs } from "node:util";

const HELP = `SCENE  folder of an exported scene: shuttertruth engine export NAME --gltf out/gltf
  --size WxH       picture size in pixels [default: 320x180]
  --subframes N    pictures over the open shutter [default: 32]
  --exposure E     exposure in frames [default: the scene's]
  --samples N      taps of three.js's blur [default: 16, as three.js has it]
  --meshes KIND    how objects are drawn: plain, unculled (outside the picture too), instanced (an InstancedMesh each) or
                   skinned (a bone each) [default: plain]
  --near METRES    near plane of the camera [default: the exported camera's, 0.01]
  --original FILE  the glTF file that the scene was imported from: its meshes are drawn in the place of the imported ones
  --at SECONDS     time of the frame in that file [default: 0]
  --fps RATE       frames per second of that file [default: 24]
  --before FRAMES  when the frame before the instant's is drawn; 0 stands still, none draws none [default: 1]`;

// npm runs scripts in the package's folder, and names the caller's folder in a variable.
process.chdir(process.env.INIT_CWD ?? ".");

const ORIGINAL = { original: { type: "string" }, at: { type: "string" }, fps: { type: "string" } };

// Parses the words of a command; `more` are its own options, for parseArgs.
export function readOptions(command, more = {}, help = "") {
  const text = { type: "string" };
  const known = { size: text, subframes: text, exposure: text, samples: text, meshes: text, near: text, before: text, ...ORIGINAL };
  const usage = `npm run ${command} -- SCENE [options]\n\n${HELP}${help}`;
  let parsed;
  try {
    parsed = parseArgs({ options: { ...known, ...more }, allowPositionals: true });
  } catch (error) {
    fail(`${error.message}\n\n${usage}`);
  }
  const { values, positionals } = parsed;
  if (positionals.length !== 1) fail(usage);
  const scene = positionals[0];
  for (const file of ["manifest.json", "scene.gltf", "sky.exr"]) {
    if (!fs.existsSync(path.join(scene, file))) fail(`${scene}: lacks ${file}; write one with: shuttertruth engine export NAME --gltf DIR`);
  }
  const manifest = JSON.parse(fs.readFileSync(path.join(scene, "manifest.json"), "utf8"));
  const size = /^([1-9]\d{0,3})x([1-9]\d{0,3})$/.exec(values.size ?? "320x180");
  if (!size) fail(`--size ${values.size}: a width and a height such as 320x180, each at most 9999`);
  const meshes = values.meshes ?? "plain";
  const kinds = ["plain", "unculled", "instanced", "skinned"];
  if (!kinds.includes(meshes)) fail(`--meshes ${meshes}: one of ${kinds.join(", ")}`);
  if (values.original && !fs.existsSync(values.original)) fail(`--original ${values.original}: no such file`);
  const settings = {
    width: Number(size[1]),
    height: Number(size[2]),
    subframes: number(values, "subframes", 32, 1, 4096),
    // The animation is as long as the scene's own shutter needs, with at least two frames on both sides.
    exposure: number(values, "exposure", manifest.exposure, 0, Math.max(2, manifest.exposure)),
    samples: number(values, "samples", 16, 2, 256),
    meshes,
    near: number(values, "near", "exported", 1e-4, 1e4),
    before: values.before === "none" ? "none" : number(values, "before", 1, 0, 2),
    original: path.basename(values.original ?? ""),
    at: number(values, "at", 0, 0, 1e6),
    fps: number(values, "fps", 24, 1e-3, 1e6),
  };
  const folders = { scene, original: values.original ? path.dirname(values.original) : scene };
  return { scene, folders, manifest, settings, values };
}

// Formats settings as the query of the page's address.
export const query = (settings) => `?${new URLSearchParams(Object.entries(settings))}`;

function number(values, name, otherwise, least, most) {
  if (values[name] === undefined) return otherwise;
  const value = Number(values[name]);
  if (!(value >= least && value <= most)) fail(`--${name} ${values[name]}: from ${least} to ${most}`);
  return value;
}

export function fail(message) {
  console.error(message);
  process.exit(2);
}
