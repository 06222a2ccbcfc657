"use strict";
// The numbers behind the pictures: planes of floats, unpacked when a picture first needs them.
{
  const store = document.getElementById("numbers");
  const { folder } = store.dataset;
  const waiting = new Map();
  // Of the scene that is open; those of others are dropped.
  let open = { scene: null, texts: null, planes: new Map() };

  // Called by the files beside the page, each of which holds one scene.
  const arrived = (scene, texts) => waiting.get(scene)(texts);

  const load = (scene) =>
    new Promise((resolve, reject) => {
      waiting.set(scene, resolve);
      const script = document.createElement("script");
      script.src = `${encodeURIComponent(folder)}/scene_${scene}.js`;
      script.onerror = () => reject(new Error(`${folder}/scene_${scene}.js is missing: it belongs beside this page`));
      document.head.append(script);
    });

  const textsOf = (scene) => {
    if (folder) return load(scene);
    return Promise.resolve(JSON.parse(store.querySelector(`[data-scene="${scene}"]`).textContent));
  };

  const openScene = (scene) => {
    if (open.scene !== scene) open = { scene, texts: textsOf(scene), planes: new Map() };
  };

  const inflate = async (text) => {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  };

  const floatOf = (bits) => {
    const sign = bits & 0x8000 ? -1 : 1;
    const exponent = (bits >> 10) & 31;
    const fraction = (bits & 1023) / 1024;
    if (exponent === 0) return sign * 2 ** -14 * fraction;
    if (exponent === 31) return fraction ? NaN : sign * Infinity;
    return sign * 2 ** (exponent - 15) * (1 + fraction);
  };

  // Lower bytes, then higher bytes of the difference of each number to the one before.
  const unpack = (bytes) => {
    const values = new Float32Array(bytes.length / 2);
    let bits = 0;
    for (let at = 0; at < values.length; at++) {
      bits = (bits + bytes[at] + (bytes[at + values.length] << 8)) & 0xffff;
      values[at] = floatOf(bits);
    }
    return values;
  };

  const plane = (own, number) => {
    if (!own.planes.has(number)) own.planes.set(number, own.texts.then((texts) => inflate(texts[number])).then(unpack));
    return own.planes.get(number);
  };

  // The numbers of some planes of the open scene.
  const planes = (numbers) => Promise.all(numbers.map((number) => plane(open, number)));

  window.shuttertruth = { arrived, openScene, planes };
}
