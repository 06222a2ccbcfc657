"use strict";
// FLIP and PSNR of a picture against the truth, as the program computes them: LDR-FLIP (Andersson et al., HPG 2020) with the constants of
// NVIDIA's tool.
{
  const PIXELS_PER_DEGREE = 0.7 * (3840 / 0.7) * (Math.PI / 180);
  // Converts linear Rec.709 to XYZ, with white at 1.
  const TO_XYZ = [
    [10135552 / 24577794, 8788810 / 24577794, 4435075 / 24577794],
    [2613072 / 12288897, 8788810 / 12288897, 887015 / 12288897],
    [1425312 / 73733382, 8788810 / 73733382, 70074185 / 73733382],
  ];
  const FROM_XYZ = [
    [3.2410033, -1.5373989, -0.49861586],
    [-0.96922433, 1.8759301, 0.041554224],
    [0.055639423, -0.2040112, 1.0571489],
  ];
  const WHITE = [0.95042855, 1, 1.0889003];
  const PER_WHITE = [1.0521569, 1, 0.9183577];
  // Distances up to this part of the largest are spread over 95 % of the range.
  const [NEAR, NEAR_RANGE] = [0.4, 0.95];
  // PSNR of no error at all, in dB.
  const PSNR_LIMIT = 120;

  const sum = (numbers) => numbers.reduce((all, one) => all + one, 0);
  const clamp = (value) => Math.min(1, Math.max(0, value));
  const multiply = (row, x, y, z) => row[0] * x + row[1] * y + row[2] * z;
  const taps = (radius, weigh) => Array.from({ length: 2 * radius + 1 }, (_, at) => weigh(at - radius));

  // Contrast sensitivity to lightness, to red and green, and twice to blue and yellow, whose two parts add up.
  const contrast = (() => {
    const terms = [[1, 0.0047], [1, 0.0053], [34.1, 0.04], [13.5, 0.025]];
    const radius = Math.ceil(3 * Math.sqrt(0.04 / (2 * Math.PI ** 2)) * PIXELS_PER_DEGREE);
    const weights = terms.map(([height, width], filter) => {
      const peak = height * Math.sqrt(Math.PI / width);
      // A sum of two Gaussians is not separable; each Gaussian is, by the root of its peak.
      const scale = filter < 2 ? peak : Math.sqrt(peak);
      return taps(radius, (at) => scale * Math.exp((-(Math.PI ** 2) * (at / PIXELS_PER_DEGREE) ** 2) / width));
    });
    const sums = weights.map(sum);
    const both = Math.hypot(sums[2], sums[3]);
    return weights.map((own, filter) => Float64Array.from(own, (one) => one / (filter < 2 ? sums[filter] : both)));
  })();

  // A Gaussian, and its first and second derivative, which find edges and points. Positive and negative weights add up to 1 each.
  const feature = (() => {
    const sigma = 0.5 * 0.082 * PIXELS_PER_DEGREE;
    const bell = (x) => Math.exp(-(x * x) / (2 * sigma * sigma));
    const formulas = [bell, (x) => -x * bell(x), (x) => ((x * x) / (sigma * sigma) - 1) * bell(x)];
    return formulas.map((formula) => {
      const weights = taps(Math.ceil(3 * sigma), formula);
      const positive = sum(weights.filter((one) => one > 0));
      const negative = -sum(weights.filter((one) => one <= 0));
      return Float64Array.from(weights, (one) => one / (one > 0 ? positive : negative));
    });
  })();

  // Pixels before and after one that filters reach.
  const REACH = contrast[0].length >> 1;
  // Weights that are added up at once; their number is filled up with zeros.
  const AT_ONCE = 4;
  const TAPS = 2 * REACH + 1 + AT_ONCE;
  // Weights, which line or plane they read, and how far from the first one in reach they begin.
  const plan = (own, from) => {
    const filled = new Float64Array(Math.ceil(own.length / AT_ONCE) * AT_ONCE);
    filled.set(own);
    return [filled, from, REACH - (own.length >> 1)];
  };
  // Filters along rows, of the lines below; then along columns, of the planes that these make.
  const ALONG = [...contrast.map((own, at) => plan(own, Math.min(at, 2))), ...feature.map((own) => plan(own, 3))];
  const DOWN = [...contrast.map(plan), plan(feature[0], 5), plan(feature[1], 4), plan(feature[0], 6), plan(feature[2], 4)];

  // Filters a picture along its rows: its lightness, red to green, blue to yellow, and its lightness from 0 to 1. Displays show the
  // picture in sRGB, which cuts it to 0 to 1.
  const filterRows = ([red, green, blue], width, height, scale) => {
    const filtered = ALONG.map(() => new Float64Array(width * height));
    const starts = Int32Array.from({ length: TAPS }, (_, tap) => tap);
    const lines = [0, 1, 2, 3].map(() => new Float64Array(width + TAPS));
    for (let y = 0; y < height; y++) {
      for (let x = 0; x < width; x++) {
        const at = y * width + x;
        const r = clamp(red[at] * scale);
        const g = clamp(green[at] * scale);
        const b = clamp(blue[at] * scale);
        const cx = multiply(TO_XYZ[0], r, g, b) * PER_WHITE[0];
        const cy = multiply(TO_XYZ[1], r, g, b);
        const cz = multiply(TO_XYZ[2], r, g, b) * PER_WHITE[2];
        const lightness = 116 * cy - 16;
        lines[0][REACH + x] = lightness;
        lines[1][REACH + x] = 500 * (cx - cy);
        lines[2][REACH + x] = 200 * (cy - cz);
        lines[3][REACH + x] = (lightness + 16) / 116;
      }
      // The outermost pixel is repeated beyond the border.
      for (const line of lines) line.fill(line[REACH], 0, REACH).fill(line[REACH + width - 1], REACH + width);
      ALONG.forEach((own, filter) => correlate(own, lines[own[1]], starts, filtered[filter], y * width, width));
    }
    return filtered;
  };

  // Adds up, for each number of a row, the weights times what begins at the starts. Engines are fast at several at a time.
  const correlate = ([weights, , inset], values, starts, sums, first, width) => {
    sums.fill(0, first, first + width);
    for (let tap = 0; tap < weights.length; tap += AT_ONCE) {
      const at = inset + tap;
      const [a, ia, b, ib] = [weights[tap], starts[at], weights[tap + 1], starts[at + 1]];
      const [c, ic, d, id] = [weights[tap + 2], starts[at + 2], weights[tap + 3], starts[at + 3]];
      for (let x = 0; x < width; x++) {
        sums[first + x] += a * values[ia + x] + b * values[ib + x] + c * values[ic + x] + d * values[id + x];
      }
    }
  };

  // CIELab's curve, a cube root and a line near 0.
  const bend = (value) => (value > (6 / 29) ** 3 ? Math.cbrt(value) : value / (3 * (6 / 29) ** 2) + 4 / 29);

  // Writes a colour given in XYZ as parts of white as CIELab with Hunt's adjustment: dark colours are less colourful.
  const writeLab = (lab, at, x, y, z) => {
    const middle = bend(y);
    const lightness = 116 * middle - 16;
    lab[0][at] = lightness;
    lab[1][at] = 0.01 * lightness * 500 * (bend(x) - middle);
    lab[2][at] = 0.01 * lightness * 200 * (middle - bend(z));
  };

  const distance = (l, a, b) => Math.abs(l) + Math.sqrt(a * a + b * b);

  // The largest distance of two display colours, green to blue.
  const LARGEST = (() => {
    const lab = [[], [], []];
    const write = (color, at) => writeLab(lab, at, ...TO_XYZ.map((row, axis) => multiply(row, ...color) * PER_WHITE[axis]));
    [[0, 1, 0], [0, 0, 1]].forEach(write);
    return distance(...lab.map(([green, blue]) => green - blue)) ** 0.7;
  })();

  // A picture as the eye sees it: three planes of CIELab, and the strengths of edges and points. `stops` is the display's exposure.
  const see = (planes, width, height, stops) => {
    const filtered = filterRows(planes, width, height, 2 ** stops);
    const seen = [0, 1, 2, 3, 4].map(() => new Float32Array(width * height));
    const rows = DOWN.map(() => new Float64Array(width));
    const starts = new Int32Array(TAPS);
    for (let y = 0; y < height; y++) {
      for (let tap = 0; tap < starts.length; tap++) starts[tap] = width * Math.min(height - 1, Math.max(0, y + tap - REACH));
      DOWN.forEach((own, filter) => correlate(own, filtered[own[1]], starts, rows[filter], 0, width));
      for (let x = 0; x < width; x++) {
        const at = y * width + x;
        const cy = (rows[0][x] + 16) / 116;
        const cx = (cy + rows[1][x] / 500) * WHITE[0];
        const cz = (cy - (rows[2][x] + rows[3][x]) / 200) * WHITE[2];
        const r = clamp(multiply(FROM_XYZ[0], cx, cy, cz));
        const g = clamp(multiply(FROM_XYZ[1], cx, cy, cz));
        const b = clamp(multiply(FROM_XYZ[2], cx, cy, cz));
        const [tx, ty, tz] = TO_XYZ;
        writeLab(seen, at, multiply(tx, r, g, b) * PER_WHITE[0], multiply(ty, r, g, b), multiply(tz, r, g, b) * PER_WHITE[2]);
        seen[3][at] = Math.sqrt(rows[4][x] ** 2 + rows[5][x] ** 2);
        seen[4][at] = Math.sqrt(rows[6][x] ** 2 + rows[7][x] ** 2);
      }
    }
    return seen;
  };

  // Maps FLIP, from 0 to 1, of two pictures as the eye sees them.
  const mapFlip = ([l, a, b, edges, points], [ol, oa, ob, otherEdges, otherPoints]) => {
    const near = NEAR * LARGEST;
    return l.map((_, at) => {
      const color = distance(l[at] - ol[at], a[at] - oa[at], b[at] - ob[at]) ** 0.7;
      const spread = color < near ? (color * NEAR_RANGE) / near : NEAR_RANGE + ((color - near) / (LARGEST - near)) * (1 - NEAR_RANGE);
      const strength = Math.max(Math.abs(edges[at] - otherEdges[at]), Math.abs(points[at] - otherPoints[at])) / Math.SQRT2;
      return spread ** (1 - Math.sqrt(strength));
    });
  };

  // Mean of a map over the pixels of a region, which are above 0 there.
  const meanOver = (region, map) => {
    let [all, count] = [0, 0];
    for (let at = 0; at < region.length; at++) {
      if (region[at] > 0) [all, count] = [all + map[at], count + 1];
    }
    return all / count;
  };

  // Largest change of a colour, relative to it, that counts as none: the rounding of 16-bit floats.
  const ROUNDING = 1e-3;

  // PSNR over a region, in dB, at most `limit`, which is what the truth's noise allows. `noise` is the root of what that adds to the
  // squared error of a pixel; where it is negative, it adds nothing to a pixel that the filter leaves as it is in the frame.
  const psnr = (output, frame, truth, region, stops, noise, limit) => {
    const isLeft = (at) => output.every((plane, c) => Math.abs(plane[at] - frame[c][at]) <= ROUNDING * Math.abs(frame[c][at]));
    const squared = region.map((_, at) => {
      const all = output.reduce((sum, plane, c) => sum + (plane[at] - truth[c][at]) ** 2, 0) / 3;
      return noise[at] < 0 && isLeft(at) ? all : all - noise[at] ** 2;
    });
    const error = meanOver(region, squared) * 4 ** stops;
    return Math.min(limit, -10 * Math.log10(Math.max(error, 10 ** (-PSNR_LIMIT / 10))));
  };

  window.shuttertruth.scores = { see, mapFlip, meanOver, psnr };
}
