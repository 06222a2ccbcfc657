// The page: captures a scene, shows the pictures, and sends them to the server if the address asks for it.

import { captureScene } from "./draw.js";

const address = new URLSearchParams(location.search);
const settings = Object.fromEntries([...address].map(([name, value]) => [name, isNaN(value) ? value : Number(value)]));
const { width, height } = settings;

addEventListener("error", (event) => failed(event.error ?? event.message));
addEventListener("unhandledrejection", (event) => failed(event.reason));

const heading = document.querySelector("h1");
const status = document.querySelector("p");

const mean = new Float32Array(width * height * 3);
await captureScene(settings, {
  async about(words, manifest) {
    heading.textContent = `${manifest.scene} in ${words.engine}`;
    await post("about", JSON.stringify(words));
  },
  async picture(name, channels, pixels) {
    status.textContent = name;
    if (name.startsWith("subframes/")) mean.forEach((_, at) => (mean[at] += colorAt(pixels, at) / settings.subframes));
    else show(name, channels.length, pixels);
    await post(`${name}?channels=${channels}`, pixels);
  },
});
show(`mean of ${settings.subframes} sub-frames`, 3, mean);
status.textContent = `${width}x${height}, exposure ${settings.exposure} frames`;
await post("done", "");

// Finds a sub-frame's colour; an id follows each.
function colorAt(pixels, at) {
  return pixels[Math.floor(at / 3) * 4 + (at % 3)];
}

async function post(name, body) {
  if (!settings.send) return;
  const answer = await fetch(`/${name}`, { method: "POST", body });
  if (!answer.ok) throw new Error(await answer.text());
}

function failed(error) {
  status.textContent = String(error?.stack ?? error);
  post("failed", status.textContent);
}

// Shows a picture for viewers: colours by the curve of sRGB, velocity around grey, depth and ids from black to white.
function show(name, channels, pixels) {
  const canvas = Object.assign(document.createElement("canvas"), { width, height });
  const image = new ImageData(width, height);
  const most = pixels.reduce((most, value) => Math.max(most, Math.abs(value)), 1e-9);
  const least = pixels.reduce((least, value) => Math.min(least, value));
  const encode = (value) => 255 * (value < 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055);
  const grey = { 1: (value) => (255 * (value - least)) / (most - least), 2: (value) => 127.5 * (1 + value / most), 3: encode }[channels];
  for (let pixel = 0; pixel < width * height; pixel++) {
    for (let at = 0; at < 3; at++) {
      const value = pixels[pixel * channels + (channels === 1 ? 0 : at)];
      image.data[pixel * 4 + at] = at < channels || channels === 1 ? grey(value) : 127.5;
    }
    image.data[pixel * 4 + 3] = 255;
  }
  canvas.getContext("2d").putImageData(image, 0, 0);
  const figure = document.createElement("figure");
  const caption = Object.assign(document.createElement("figcaption"), { textContent: name });
  figure.append(canvas, caption);
  document.querySelector("main").append(figure);
}
