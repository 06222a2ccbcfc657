"""Pictures of the pages: read from OpenEXR, shown side by side in a PNG."""

import struct
import zlib

import numpy as np
import OpenEXR

SCALE = 2


def read_channels(path):
    """Reads the channels of a file, by name."""
    with OpenEXR.File(str(path), separate_channels=True) as file:
        return {name: np.array(channel.pixels) for name, channel in file.parts[0].channels.items()}


def read_colors(path):
    """Reads scene-linear colours: one, that of Blender's layer Combined, or both halves of a truth."""
    channels = read_channels(path)
    halves = [half for half in ("A.", "B.") if half + "R" in channels]
    layers = halves or [name[:-1] for name in channels if name == "R" or name.endswith("Combined.R")]
    return [np.stack([channels[layer + part] for part in "RGB"], axis=-1).astype(float) for layer in layers]


def read_color(path):
    """Reads a scene-linear colour; the mean of both halves of a truth."""
    return np.mean(read_colors(path), axis=0)


def encode_srgb(linear):
    """Encodes scene-linear colour as 8-bit numbers by the curve of sRGB; it clips above 1."""
    linear = np.clip(linear, 0, 1)
    return np.round(255 * np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055))


def sheet(colors):
    """Puts pictures side by side, each pixel as a square: bytes of shape (rows, columns, 3)."""
    encoded = encode_srgb(np.concatenate(colors, axis=1)).astype(np.uint8)
    return encoded.repeat(SCALE, axis=0).repeat(SCALE, axis=1)


def write_png(path, pixels):
    height, width, _ = pixels.shape
    rows = np.concatenate([np.zeros((height, 1), np.uint8), pixels.reshape(height, -1)], axis=1)
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    parts = [chunk(b"IHDR", header), chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)), chunk(b"IEND", b"")]
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(parts))


def read_png(path):
    """Reads what `write_png` wrote."""
    data = path.read_bytes()
    width, height = struct.unpack(">II", data[16:24])
    (length,) = struct.unpack(">I", data[33:37])
    rows = np.frombuffer(zlib.decompress(data[41 : 41 + length]), np.uint8).reshape(height, -1)
    return rows[:, 1:].reshape(height, width, 3)
