"use strict";
// The numbers behind the pictures: planes of floats, unpacked when a picture first needs them.
{
  const store = document.getElementById("shelves");
  const { precision, folder } = store.dataset;
  const width = precision === "float" ? 4 : 2;
  const { width: columns, height: rows } = document.getElementById("viewer").dataset;
  const count = columns * rows;
  const waiting = new Map();
  // Of the scene that is open; those of others are dropped.
  let shelf = { scene: null, packed: null, planes: new Map() };

  // Called by the files beside the page, each of which holds one scene.
  const arrived = (scene, packed) => waiting.get(scene)(packed);

  const fetched = (scene) =>
    new Promise((resolve, reject) => {
      waiting.set(scene, resolve);
      const script = document.createElement("script");
      script.src = `${encodeURIComponent(folder)}/scene_${scene}.js`;
      script.onerror = () => reject(new Error(`${folder}/scene_${scene}.js is missing: it belongs beside this page`));
      document.head.append(script);
    });

  const packedOf = (scene) => {
    if (folder) return fetched(scene);
    return Promise.resolve(JSON.parse(store.querySelector(`[data-scene="${scene}"]`).textContent));
  };

  const open = (scene) => {
    if (shelf.scene !== scene) shelf = { scene, packed: packedOf(scene), planes: new Map() };
  };

  const inflated = async (text) => {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  };

  // The bits of every number of a plane: those that it shares with its base, and of the others what neighbour and component do
  // not tell.
  const bitsOf = async (own, number) => {
    const packed = await own.packed;
    const bytes = await inflated(packed.planes[number]);
    const against = async (other) => (other === null ? null : (await kept(own, other)).bits);
    const base = await against(packed.bases[number]);
    const component = await against(packed.components[number]);
    const start = Math.ceil(count / 8);
    const residues = (bytes.length - start) / width;
    const mask = width === 4 ? 0xffffffff : 0xffff;
    const bits = new Uint32Array(count);
    for (let at = 0, next = start; at < count; at++) {
      if ((bytes[at >> 3] >> (at & 7)) & 1) {
        bits[at] = base[at];
        continue;
      }
      let folded = 0;
      for (let byte = 0; byte < width; byte++) folded |= bytes[next + byte * residues] << (8 * byte);
      next += 1;
      let value = (folded >>> 1) ^ -(folded & 1);
      if (at > 0) value += bits[at - 1];
      if (component) value += component[at] - (at > 0 ? component[at - 1] : 0);
      bits[at] = value & mask;
    }
    return bits;
  };

  const fromHalf = (kept) => {
    // Of what is kept for the screen the lowest four bits were dropped.
    const bits = precision === "screen" ? kept << 4 : kept;
    const sign = bits & 0x8000 ? -1 : 1;
    const exponent = (bits >> 10) & 31;
    const fraction = (bits & 1023) / 1024;
    if (exponent === 0) return sign * 2 ** -14 * fraction;
    if (exponent === 31) return fraction ? NaN : sign * Infinity;
    return sign * 2 ** (exponent - 15) * (1 + fraction);
  };

  const kept = (own, number) => {
    if (!own.planes.has(number)) {
      const made = bitsOf(own, number).then((bits) => ({
        bits,
        values: width === 4 ? new Float32Array(bits.buffer) : Float32Array.from(bits, fromHalf),
      }));
      own.planes.set(number, made);
    }
    return own.planes.get(number);
  };

  // The numbers of some planes of the open scene.
  const planes = async (numbers) => {
    const all = await Promise.all(numbers.map((number) => kept(shelf, number)));
    return all.map((plane) => plane.values);
  };

  window.shuttertruth = { arrived, open, planes, precision };
}
