"use strict";
// The numbers behind the pictures: planes of floats, unpacked when a picture first needs them. And the files beside a large page.
{
  const store = document.getElementById("numbers");
  const { folder } = store.dataset;
  const waiting = new Map();
  // Of the scene that is open; those of others are dropped.
  let open = { scene: null };

  // Called by the files beside the page, each of which holds one scene.
  const arrived = (name, content) => waiting.get(name)(content);

  // Loads a file beside the page: `scene_3`, with numbers, `tables_3`, or `live_scene_3`.
  const load = (name) =>
    new Promise((resolve, reject) => {
      waiting.set(name, resolve);
      const script = document.createElement("script");
      script.src = `${encodeURIComponent(folder)}/${name}.js`;
      script.onerror = () => reject(new Error(`${folder}/${name}.js is missing: it belongs beside this page`));
      document.head.append(script);
    });

  const textsOf = (scene) => {
    const own = store.querySelector(`[data-scene="${scene}"]`);
    return own ? Promise.resolve(JSON.parse(own.textContent)) : load(`scene_${scene}`);
  };

  const openScene = (scene) => {
    if (open.scene !== scene) open = { scene, texts: textsOf(scene), bits: new Map(), planes: new Map() };
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
  let floats = null;

  // Lower bytes, then higher bytes of the difference of each number to that of another plane, or else to the one before.
  const unpack = (bytes, reference) => {
    const bits = new Uint16Array(bytes.length / 2);
    for (let at = 0; at < bits.length; at++) {
      const other = reference ? reference[at] : at > 0 ? bits[at - 1] : 0;
      bits[at] = other + bytes[at] + (bytes[at + bits.length] << 8);
    }
    return bits;
  };

  const bitsOf = (own, number) => {
    const load = async () => {
      const [reference, text] = (await own.texts)[number].split(" ");
      return unpack(await inflate(text), reference && (await bitsOf(own, Number(reference))));
    };
    if (!own.bits.has(number)) own.bits.set(number, load());
    return own.bits.get(number);
  };

  const plane = (own, number) => {
    const load = async () => {
      const bits = await bitsOf(own, number);
      floats ??= Float32Array.from({ length: 65536 }, (_, one) => floatOf(one));
      return Float32Array.from(bits, (one) => floats[one]);
    };
    if (!own.planes.has(number)) own.planes.set(number, load());
    return own.planes.get(number);
  };

  // The numbers of some planes of the open scene.
  const planes = (numbers) => Promise.all(numbers.map((number) => plane(open, number)));

  // Puts a plane that this page computed itself into the open scene. Its number is below 0.
  const put = (number, values) => open.planes.set(number, Promise.resolve(values));

  window.shuttertruth = { arrived, load, inflate, openScene, planes, put };
}
