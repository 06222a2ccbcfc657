// Makes Babylon.js draw an exported scene in headless Chromium, and writes the pictures:
// `node engines/babylon/capture.mjs out/gltf/railing --out out/capture/railing --size 160x90`.
// The command line and the server are those of three.js; the server shows the page of this folder.

import "../threejs/capture.mjs";
