// OpenEXR files of 32-bit floats, uncompressed.

const MAGIC = 20000630;
const FLOAT = 2;

// Encodes planes of one size, by channel name: `{ R: Float32Array, ... }`, rows from the top.
export function encodeExr(width, height, planes) {
  // The format requires channels sorted by name.
  const names = Object.keys(planes).sort();
  const header = encodeHeader(width, height, names);
  const rowBytes = names.length * width * 4;
  const firstRow = header.length + height * 8;
  const file = Buffer.alloc(firstRow + height * (8 + rowBytes));
  header.copy(file);
  for (let y = 0; y < height; y++) {
    let at = firstRow + y * (8 + rowBytes);
    file.writeBigUInt64LE(BigInt(at), header.length + y * 8);
    file.writeInt32LE(y, at);
    file.writeInt32LE(rowBytes, at + 4);
    at += 8;
    for (const name of names) {
      const row = planes[name].subarray(y * width, (y + 1) * width);
      Buffer.from(row.buffer, row.byteOffset, row.byteLength).copy(file, at);
      at += width * 4;
    }
  }
  return file;
}

function encodeHeader(width, height, names) {
  const window = ints(0, 0, width - 1, height - 1);
  const channel = (name) => Buffer.concat([text(name), ints(FLOAT, 0, 1, 1)]);
  return Buffer.concat([
    ints(MAGIC, 2),
    attribute("channels", "chlist", Buffer.concat([...names.map(channel), Buffer.from([0])])),
    attribute("compression", "compression", Buffer.from([0])),
    attribute("dataWindow", "box2i", window),
    attribute("displayWindow", "box2i", window),
    attribute("lineOrder", "lineOrder", Buffer.from([0])),
    attribute("pixelAspectRatio", "float", floats(1)),
    attribute("screenWindowCenter", "v2f", floats(0, 0)),
    attribute("screenWindowWidth", "float", floats(1)),
    Buffer.from([0]),
  ]);
}

const attribute = (name, type, value) => Buffer.concat([text(name), text(type), ints(value.length), value]);
const text = (words) => Buffer.from(`${words}\0`, "latin1");
const ints = (...values) => Buffer.from(Int32Array.from(values).buffer);
const floats = (...values) => Buffer.from(Float32Array.from(values).buffer);
