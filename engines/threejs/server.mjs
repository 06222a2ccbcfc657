// A web server for the page, its engine, one exported scene and its original, on this machine only.

import fs from "node:fs";
import http from "node:http";
import path from "node:path";
import { fileURLToPath } from "node:url";

const HERE = path.dirname(fileURLToPath(import.meta.url));
// The page is that of the program which was started; other engines' pages import modules from /threejs/.
const PAGE = path.dirname(process.argv[1]);
const TYPES = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".json": "application/json",
  ".gltf": "model/gltf+json",
  ".glb": "model/gltf-binary",
  ".jpg": "image/jpeg",
  ".jpeg": "image/jpeg",
  ".png": "image/png",
};

// Starts a server and returns it with its address. `receive(name, url, body)` handles what the page posts.
// `files` has the folders of the scene and of the original.
export async function startServer(files, receive) {
  const folders = { "/scene/": files.scene, "/original/": files.original, "/threejs/": HERE, "/": PAGE };
  const server = http.createServer(async (request, response) => {
    const url = new URL(request.url, "http://localhost");
    try {
      if (request.method === "POST") {
        const parts = [];
        for await (const part of request) parts.push(part);
        receive(url.pathname.slice(1), url, Buffer.concat(parts));
        response.end();
      } else {
        sendFile(response, findFile(folders, decodeURIComponent(url.pathname)));
      }
    } catch (error) {
      response.writeHead(500).end(String(error.message));
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return { server, address: `http://127.0.0.1:${server.address().port}/` };
}

function findFile(folders, name) {
  const prefix = Object.keys(folders).find((prefix) => name.startsWith(prefix));
  const folder = path.resolve(folders[prefix]);
  const file = path.join(folder, name === "/" ? "index.html" : name.slice(prefix.length));
  return file.startsWith(folder + path.sep) ? file : null;
}

function sendFile(response, file) {
  if (file === null || !fs.existsSync(file)) {
    response.writeHead(404).end();
    return;
  }
  const type = TYPES[path.extname(file)] ?? "application/octet-stream";
  response.writeHead(200, { "content-type": type, "cache-control": "no-store" });
  fs.createReadStream(file).pipe(response);
}
