// Serves a scene to a browser until Ctrl-C: `npm run view -- out/gltf/railing`, then open the address.

import { query, readOptions } from "./options.mjs";
import { startServer } from "./server.mjs";

const { folders, settings } = readOptions("view");
const { address } = await startServer(folders, () => {});
console.log(`${address}${query(settings)}`);
