// Makes three.js draw an exported scene in headless Chromium, and writes the pictures:
// `npm run capture -- out/gltf/railing --out out/capture/railing`.

import { spawn } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";

import { encodeExr } from "./exr.mjs";
import { fail, query, readOptions } from "./options.mjs";
import { startServer } from "./server.mjs";

const CHROMIUMS = ["chromium", "chromium-browser", "google-chrome", "chrome"];
// WebGL backends, the first available is used: the graphics card, Mesa's software renderer, then Chromium's own.
const BACKENDS = ["gl-egl", "swiftshader"];
// Far longer than software rendering needs for the largest capture size in use.
const PATIENCE_SECONDS = 540;

const HELP = `
  --out DIR        folder for the capture [default: out/capture/SCENE]
  --backend NAME   what draws for WebGL, as Chromium's --use-angle has it [default: gl-egl, else swiftshader]`;
const more = { out: { type: "string" }, backend: { type: "string" } };
const { scene, folders, manifest, settings, values } = readOptions("capture", more, HELP);
const out = values.out ?? path.join("out/capture", manifest.scene);
fs.rmSync(path.join(out, "subframes"), { recursive: true, force: true });
fs.mkdirSync(path.join(out, "subframes"), { recursive: true });
fs.copyFileSync(path.join(scene, "manifest.json"), path.join(out, "manifest.json"));

let engine;
const backends = values.backend ? [values.backend] : BACKENDS;
let failure = await capture(backends[0]);
if (failure?.includes("no WebGL 2") && backends.length > 1) failure = await capture(backends[1]);
if (failure) fail(`${scene}: ${failure}`);
console.log(`written: ${out}: color, velocity, depth, object, blurred, ${settings.subframes} sub-frames; drawn by ${engine}`);

// Opens the page in Chromium and receives its pictures. Returns the failure, or null.
async function capture(backend) {
  let finish;
  const finished = new Promise((resolve) => (finish = resolve));
  const { server, address } = await startServer(folders, (name, url, body) => {
    if (name === "done") finish(null);
    else if (name === "failed") finish(body.toString());
    else if (name === "about") writeTables(JSON.parse(body.toString()));
    else writePicture(name, url.searchParams.get("channels").split(","), body);
  });
  const profile = fs.mkdtempSync(path.join(os.tmpdir(), "shuttertruth-chromium-"));
  const browser = startChromium(`${address}${query({ ...settings, send: 1 })}`, backend, profile);
  browser.on("error", (error) => finish(`Chromium does not start: ${error.message}`));
  browser.on("exit", (code) => finish(`Chromium ended early, with code ${code}`));
  const limit = setTimeout(() => finish(`nothing came from the page within ${PATIENCE_SECONDS} s`), PATIENCE_SECONDS * 1000);
  const failure = await finished;
  clearTimeout(limit);
  await stop(browser);
  fs.rmSync(profile, { recursive: true, force: true, maxRetries: 20, retryDelay: 100 });
  server.close();
  server.closeAllConnections();
  return failure;
}

function writePicture(name, channels, body) {
  if (!/^(subframes\/)?[a-z0-9_]+$/.test(name)) throw new Error(`${name}: no name of a picture`);
  const { width, height } = settings;
  const pixels = new Float32Array(body.buffer.slice(body.byteOffset, body.byteOffset + body.length));
  const planes = {};
  channels.forEach((channel, at) => {
    planes[channel] = Float32Array.from({ length: width * height }, (_, pixel) => pixels[pixel * channels.length + at]);
  });
  fs.writeFileSync(path.join(out, `${name}.exr`), encodeExr(width, height, planes));
}

function writeTables(about) {
  engine = about.engine;
  const { near, far } = about;
  const lines = [
    `engine = ${JSON.stringify(engine)}`,
    `scene = ${JSON.stringify(manifest.scene)}`,
    `exposure = ${settings.exposure}`,
    'alignment = "centred"',
    "instant = 0",
  ];
  fs.writeFileSync(path.join(out, "capture.toml"), `${lines.join("\n")}\n`);
  // Velocity: a point's normalised device coordinates now, minus those a frame ago.
  const convention = ['velocity = "ndc"', 'velocity_y = "up"', 'depth = "forward"', `near = ${near}`, `far = ${far}`];
  fs.writeFileSync(path.join(out, "engine.toml"), `[convention]\n${convention.join("\n")}\n`);
}

function startChromium(page, backend, profile) {
  const flags = [
    "--headless",
    "--no-sandbox",
    "--no-first-run",
    "--disable-dev-shm-usage",
    "--ignore-gpu-blocklist",
    `--use-angle=${backend}`,
    "--enable-unsafe-swiftshader",
    "--remote-debugging-port=0",
    `--user-data-dir=${profile}`,
  ];
  // A process group of its own, so that all its processes can be ended together.
  return spawn(findChromium(), [...flags, page], { stdio: "ignore", detached: true });
}

async function stop(browser) {
  if (browser.pid === undefined || browser.exitCode !== null) return;
  const ended = new Promise((resolve) => browser.on("exit", resolve));
  process.kill(-browser.pid, "SIGKILL");
  await ended;
}

function findChromium() {
  if (process.env.CHROMIUM) return process.env.CHROMIUM;
  const folders = (process.env.PATH ?? "").split(path.delimiter);
  const files = CHROMIUMS.flatMap((name) => folders.map((folder) => path.join(folder, name)));
  const found = files.find((file) => fs.existsSync(file));
  return found ?? fail(`no Chromium on the PATH (${CHROMIUMS.join(", ")}): apt-get install chromium, or name one in CHROMIUM`);
}
