// Colours: OKLab (Ottosson 2020), in which equal steps look equal; scales of the field; colours of segments
// and methods.

function srgbOfOklab(lightness, a, b) {
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s
  ].map((x) => {
    const light = Math.min(1, Math.max(0, x));
    return light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055;
  });
}

/** Lightness, chroma, hue in degrees. */
function lch(lightness, chroma, hue) {
  return [lightness, chroma * Math.cos(hue * Math.PI / 180), chroma * Math.sin(hue * Math.PI / 180)];
}

/** 256 colours straight through the given points of OKLab, as bytes of red, green, blue, and 255. */
function ramp(stops) {
  const bytes = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) {
    const x = i / 255 * (stops.length - 1);
    const leg = Math.min(Math.floor(x), stops.length - 2);
    const lab = [0, 1, 2].map((c) => stops[leg][c] + (x - leg) * (stops[leg + 1][c] - stops[leg][c]));
    srgbOfOklab(...lab).forEach((channel, c) => {
      bytes[4 * i + c] = Math.round(255 * channel);
    });
    bytes[4 * i + 3] = 255;
  }
  return bytes;
}

// Lightness alone shows the distance from the middle, blue or orange the side: distinguishable by the
// colour-blind too.
const divergingRamp = ramp([
  lch(0.46, 0.115, 250), lch(0.70, 0.085, 245), lch(0.95, 0.004, 90), lch(0.74, 0.105, 62),
  lch(0.50, 0.115, 48)
]);
const sequentialRamp =
    ramp([lch(0.30, 0.09, 268), lch(0.52, 0.06, 250), lch(0.72, 0.07, 120), lch(0.93, 0.13, 100)]);

/** Whether both signs matter in values from `low` to `high`. */
function bothSigns([low, high]) {
  return low < 0 && high > 0 && Math.min(-low, high) > 0.02 * Math.max(-low, high);
}

/** The scale of values from `low` to `high`: diverging from 0, or from end to end. */
function scaleFor([low, high], isSigned) {
  const most = Math.max(Math.abs(low), Math.abs(high));
  return isSigned ? {low: -most, high: most, bytes: divergingRamp, isSigned} :
                    {low, high, bytes: sequentialRamp, isSigned};
}

function cssRamp(bytes) {
  const stops = [];
  for (let i = 0; i < 256; i += 17)
    stops.push(`rgb(${bytes[4 * i]} ${bytes[4 * i + 1]} ${bytes[4 * i + 2]})`);
  return `linear-gradient(90deg, ${stops.join(', ')})`;
}

/**
 * Colours of segments: light, so that points and arcs stand out, and apart from one another in hue and
 * lightness.
 */
const segmentLabs = [];
for (let i = 0; i < 14; ++i)
  segmentLabs.push(lch([0.86, 0.74, 0.93][i % 3], [0.09, 0.1, 0.06][i % 3], 20 + i * 360 / 14 * 5));
const segmentColors = segmentLabs.map((lab) => srgbOfOklab(...lab).map((x) => Math.round(255 * x)));
const segmentDistances =
    segmentLabs.map((a) => segmentLabs.map((b) => Math.hypot(...a.map((x, c) => x - b[c]))));

// Okabe and Ito's colours, for either ground.
const methodColors = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#b8860b', '#56b4e9', '#7a5cc8', '#7f7f7f'];
const dashes = ['', '7 3', '2 3', '9 3 2 3'];
function methodColor(i) { return methodColors[i % methodColors.length]; }
function methodDash(i) { return dashes[Math.floor(i / methodColors.length) % dashes.length]; }

/**
 * A colour number for each label: one after the other takes the colour that is furthest from its
 * neighbours'. `labels` is by triangle, labels number 0 … count - 1.
 */
function colorSegments(corners, vertices, labels, count) {
  const neighbors = Array.from({length: count}, () => new Set());
  const last = new Int32Array(vertices).fill(-1);  // the label last seen at a vertex
  for (let h = 0; h < corners.length; ++h) {
    const label = labels[(h / 3) | 0], v = corners[h], before = last[v];
    if (before >= 0 && before !== label) {
      neighbors[before].add(label);
      neighbors[label].add(before);
    }
    last[v] = label;
  }
  const colors = new Int32Array(count).fill(-1);
  const total = segmentColors.length;
  for (let label = 0; label < count; ++label) {
    const taken = new Set();
    for (const other of neighbors[label])
      if (colors[other] >= 0) taken.add(colors[other]);
    let best = -1, furthest = -1;
    for (let k = 0; k < total; ++k) {
      const candidate = (label * 5 + k) % total;  // not always the same one among equals
      let distance = 0.25;                        // further apart is no better
      for (const color of taken) distance = Math.min(distance, segmentDistances[candidate][color]);
      if (distance > furthest) {
        furthest = distance;
        best = candidate;
      }
    }
    colors[label] = best;
  }
  return colors;
}

/** For pairs of labels, one number each: those that occur, in the order in which they are met. */
function numberPairs(first, second) {
  const numbers = new Map();
  const labels = new Uint32Array(first.length);
  for (let t = 0; t < first.length; ++t) {
    const key = first[t] * 4294967296 +
        second[t];  // unique below 2^53: labels are below 2^21 there; else colours may repeat
    let number = numbers.get(key);
    if (number === undefined) numbers.set(key, number = numbers.size);
    labels[t] = number;
  }
  return {labels, count: numbers.size};
}
