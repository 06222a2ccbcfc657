"use strict";
// Numbers as colours.
{
  const maps = JSON.parse(document.getElementById("colors").textContent);
  const table = (text) => Uint8Array.from(text.match(/../g), (pair) => parseInt(pair, 16));
  const [magma, cividis, orange] = [maps.magma, maps.cividis, maps.purple_orange].map(table);
  // Beside, ahead and behind: the colours of the key.
  const sides = maps.sides.map(table);
  // What is seen of no surface lies at least so far away, in metres.
  const FAR = 1e9;

  const luminance = (r, g, b) => 0.2126 * r + 0.7152 * g + 0.0722 * b;

  const encoded = (value) => {
    const within = Math.min(1, Math.max(0, value));
    return 255 * (within <= 0.0031308 ? 12.92 * within : 1.055 * within ** (1 / 2.4) - 0.055);
  };

  // A colour of Oklab, in bytes.
  const oklab = (lightness, a, b) => {
    const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
    const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
    const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
    return [
      4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
      -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
      -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
    ].map(encoded);
  };

  // Right is orange and left is blue, up is light and down is dark, and grey stands still: hues and lightnesses that every
  // kind of colour vision tells apart. The root lets slow motion be seen.
  const motion = (x, y, fastest) => {
    const speed = Math.hypot(x, y);
    const strength = speed > 0 ? Math.sqrt(Math.min(1, speed / fastest)) / speed : 0;
    const [right, down] = [x * strength, y * strength];
    return oklab(0.62 - 0.34 * down, 0.07 * right, 0.13 * right);
  };

  const looked = (colors, part) => {
    const at = 3 * Math.round(255 * Math.min(1, Math.max(0, part)));
    return colors.subarray(at, at + 3);
  };

  const largest = (values, start) => values.reduce((most, value) => (value > most ? value : most), start);

  const speedOf = ([x, y]) => largest(x.map((value, at) => Math.hypot(value, y[at])), 1e-6);

  // The nearest and the farthest surface.
  const reachOf = (depth) => {
    const seen = depth.filter((value) => value < FAR);
    return [seen.reduce((least, value) => Math.min(least, value), FAR), largest(seen, 0)];
  };

  // Per painter a function from a pixel's index to its colour.
  const painters = {
    radiance: ([r, g, b], { stops }) => {
      const scale = 2 ** stops;
      return (at) => [encoded(scale * r[at]), encoded(scale * g[at]), encoded(scale * b[at])];
    },
    signed: ([r, g, b, tr, tg, tb], { stops }) => {
      const scale = 2 ** stops;
      return (at) => {
        const difference = scale * luminance(r[at] - tr[at], g[at] - tg[at], b[at] - tb[at]);
        // The root lets small differences be seen.
        return looked(orange, 0.5 + 0.5 * Math.sign(difference) * Math.sqrt(Math.abs(difference)));
      };
    },
    share: ([values], { most = 1 }) => (at) => looked(magma, values[at] / most),
    sides: (planes) => (at) => {
      const color = [0, 0, 0];
      planes.forEach((plane, side) => {
        const part = Math.sqrt(Math.min(1, plane[at]));
        for (let c = 0; c < 3; c++) color[c] = Math.min(255, color[c] + part * sides[side][c]);
      });
      return color;
    },
    motion: ([x, y], { fastest }) => (at) => motion(x[at], y[at], fastest),
    distance: ([depth]) => {
      const [near, far] = reachOf(depth).map(Math.log);
      const part = (value) => 1 - (Math.log(value) - near) / (far - near || 1);
      return (at) => (depth[at] >= FAR ? [255, 255, 255] : looked(cividis, part(depth[at])));
    },
  };

  // Draws the part of a picture that begins at (left, top), as large as the canvas.
  const paint = (canvas, color, pictureWidth, left = 0, top = 0) => {
    const context = canvas.getContext("2d");
    const image = context.createImageData(canvas.width, canvas.height);
    for (let y = 0, at = 0; y < canvas.height; y++) {
      for (let x = 0; x < canvas.width; x++, at += 4) {
        image.data.set(color((top + y) * pictureWidth + left + x), at);
        image.data[at + 3] = 255;
      }
    }
    context.putImageData(image, 0, 0);
  };

  Object.assign(window.shuttertruth, { painters, paint, motion, speedOf, reachOf, FAR });
}
