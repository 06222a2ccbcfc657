"use strict";
// A tried filter as a folder that `shuttertruth run --filter` takes: filter.toml with one more preset, and the shader, in a zip file.
{
  const pictures = window.shuttertruth;
  const encoder = new TextEncoder();

  const crc = (bytes) => {
    let sum = ~0;
    for (const byte of bytes) {
      sum ^= byte;
      for (let bit = 0; bit < 8; bit++) sum = sum & 1 ? (sum >>> 1) ^ 0xedb88320 : sum >>> 1;
    }
    return ~sum >>> 0;
  };

  // Numbers as little-endian bytes, each given with its size: [4, 1] is 01 00 00 00.
  const bytesOf = (numbers) => {
    const bytes = ([size, number]) => Array.from({ length: size }, (_, at) => number >>> (8 * at));
    return Uint8Array.from(numbers.flatMap(bytes));
  };

  // Writes files, by path, as they are. Dates are 1 January 1980, the first day that zip knows.
  const zip = (files) => {
    const [parts, index] = [[], []];
    let offset = 0;
    for (const [path, text] of files) {
      const [name, data] = [encoder.encode(path), encoder.encode(text)];
      // Version 2.0, names in UTF-8, stored.
      const sizes = [[4, crc(data)], [4, data.length], [4, data.length], [2, name.length], [2, 0]];
      const facts = [[2, 20], [2, 0x800], [2, 0], [2, 0], [2, 0x21], ...sizes];
      const local = [bytesOf([[4, 0x04034b50], ...facts]), name, data];
      parts.push(...local);
      index.push(bytesOf([[4, 0x02014b50], [2, 20], ...facts, [2, 0], [2, 0], [2, 0], [4, 0], [4, offset]]), name);
      offset += local.reduce((all, part) => all + part.length, 0);
    }
    const length = index.reduce((all, part) => all + part.length, 0);
    const end = bytesOf([[4, 0x06054b50], [2, 0], [2, 0], [2, files.length], [2, files.length], [4, length], [4, offset], [2, 0]]);
    return new Blob([...parts, ...index, end], { type: "application/zip" });
  };

  // Chooses a name that no preset of the filter has.
  const nameOf = ({ presets }) => {
    const taken = presets.map(({ name }) => name);
    let number = 1;
    const name = () => (number > 1 ? `tried_${number}` : "tried");
    while (taken.includes(name())) number += 1;
    return name();
  };

  // Writes the values as a preset of filter.toml.
  const presetOf = (filter, values, scene) => {
    const write = ({ kind }, value) => (kind === "real" && Number.isInteger(value) ? value.toFixed(1) : JSON.stringify(value));
    const changed = filter.parameters.filter((parameter) => values[parameter.name] !== parameter.default);
    const pairs = changed.map((parameter) => `${parameter.name} = ${write(parameter, values[parameter.name])}`);
    const lines = ["[[preset]]", `name = "${nameOf(filter)}"`, `doc = "Tried in a report, on ${scene}."`];
    if (filter.reference_width) lines.push(`reference_width = ${filter.reference_width}`);
    if (pairs.length > 0) lines.push(`values = { ${pairs.join(", ")} }`);
    return `${lines.join("\n")}\n`;
  };

  const saveAs = (download, blob) => {
    const link = document.createElement("a");
    Object.assign(link, { href: URL.createObjectURL(blob), download });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  };

  // Saves the folder with the texts of the modules. Returns what to run.
  const save = (filter, values, texts, scene) => {
    const toml = `${filter.toml.trimEnd()}\n\n${presetOf(filter, values, scene)}`;
    const shaders = filter.modules.map(({ file }, at) => [file, texts[at]]).filter(([file]) => file);
    const files = [["filter.toml", toml], ...shaders].map(([file, text]) => [`${filter.name}/${file}`, `${text.trimEnd()}\n`]);
    saveAs(`${filter.name}.zip`, zip(files));
    return `shuttertruth run --filter ./${filter.name}:${nameOf(filter)}`;
  };

  pictures.folder = { presetOf, save, saveAs };
}
