// Runs Khronos's glTF validator on exported scenes: `npm install gltf-validator`, then
// `node examples/export/validate.mjs out/gltf/*`. Exits with 1 if there is an error or a warning.

import fs from "node:fs";
import path from "node:path";
import { createRequire } from "node:module";

// The package is in npm's working folder, not next to this file.
const validator = createRequire(path.resolve("x.js"))("gltf-validator");

let found = 0;
const folders = process.argv.slice(2);
for (const folder of folders) {
  const read = (name) => new Uint8Array(fs.readFileSync(path.join(folder, name)));
  const report = await validator.validateBytes(read("scene.gltf"), {
    uri: "scene.gltf",
    externalResourceFunction: async (uri) => read(decodeURIComponent(uri)),
  });
  const { numErrors, numWarnings, messages } = report.issues;
  found += numErrors + numWarnings;
  for (const message of messages.filter((message) => message.severity < 2)) {
    console.log(`${folder}: ${message.code} at ${message.pointer}: ${message.message}`);
  }
}
console.log(`${folders.length} scenes, ${found} errors and warnings`);
process.exit(found > 0 ? 1 : 0);
