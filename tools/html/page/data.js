// What the page holds: JSON, and one block of deflated arrays in base64.

function element(id) { return document.getElementById(id); }

function bytesOfBase64(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** The bytes that the element holds; it is emptied. */
async function inflate(id) {
  if (typeof DecompressionStream === 'undefined')
    throw new Error(
        'this browser cannot unpack the page\'s data: it lacks DecompressionStream, ' +
        'which browsers have since 2023');
  const holder = element(id);
  const packed = new Blob([bytesOfBase64(holder.textContent)]);
  holder.remove();
  return new Response(packed.stream().pipeThrough(new DecompressionStream('deflate'))).arrayBuffer();
}

/** Differences to the one before, 2d or -2d - 1, seven bits a byte. */
function readDeltas(bytes, count) {
  const values = new Uint32Array(count);
  let at = 0, value = 0;
  for (let i = 0; i < count; ++i) {
    let byte = bytes[at++];
    let code = byte & 127;
    for (let scale = 128; byte > 127; scale *= 128) {
      byte = bytes[at++];
      code += (byte & 127) * scale;
    }
    value += code % 2 === 0 ? code / 2 : -(code + 1) / 2;
    values[i] = value;
  }
  if (at !== bytes.length) throw new Error('the page\'s data are damaged');
  return values;
}

/** The array that a reference {type, offset, bytes, count} names. */
function readArray(buffers, reference) {
  const {type, offset, bytes, count} = reference;
  if (type === 'delta') return readDeltas(new Uint8Array(buffers, offset, bytes), count);
  const part = buffers.slice(offset, offset + bytes);
  return type === 'u8' ? new Uint8Array(part) :
      type === 'u16'   ? new Uint16Array(part) :
                         new Float64Array(part);
}

/** Replaces every reference in a piece of metadata by its array. */
function resolve(buffers, node) {
  if (node === null || typeof node !== 'object' || Array.isArray(node)) return node;
  if (typeof node.type === 'string' && typeof node.offset === 'number') return readArray(buffers, node);
  return Object.fromEntries(Object.entries(node).map(([key, value]) => [key, resolve(buffers, value)]));
}

function readMesh(buffers, meta) {
  const mesh = resolve(buffers, meta);
  const n = mesh.vertices;
  const whole = mesh.positions;  // coordinate by coordinate
  // Drawn around the origin and at size 1, so that single precision suffices wherever the surface is; `scale`
  // and `center` lead back.
  const lowest = [0, 1, 2].map((c) => minimumOf(whole, c * n, n));
  const highest = [0, 1, 2].map((c) => maximumOf(whole, c * n, n));
  const size = Math.max(1e-300, Math.hypot(...[0, 1, 2].map((c) => highest[c] - lowest[c])));
  mesh.half = [0, 1, 2].map((c) => (highest[c] - lowest[c]) / size / 2);
  mesh.positions = new Float32Array(3 * n);
  for (let c = 0; c < 3; ++c) {
    const middle = (lowest[c] + highest[c]) / 2;
    for (let v = 0; v < n; ++v) mesh.positions[3 * v + c] = (whole[c * n + v] - middle) / size;
  }
  mesh.place = (v) => [0, 1, 2].map((c) => mesh.origin[c] + mesh.step * whole[c * n + v]);
  mesh.inputVertex = (v) => mesh.input_vertices === null ? v : mesh.input_vertices[v];
  return mesh;
}

function minimumOf(values, first, count) {
  let least = Infinity;
  for (let i = first; i < first + count; ++i) least = Math.min(least, values[i]);
  return least;
}
function maximumOf(values, first, count) {
  let most = -Infinity;
  for (let i = first; i < first + count; ++i) most = Math.max(most, values[i]);
  return most;
}

/** The values between which all but a share at either end lie. */
function middleRange({low, high, data}, share) {
  const histogram = new Uint32Array(65536);
  for (const step of data) ++histogram[step];
  const below = (wanted) => {
    let count = 0, step = 0;
    while (step < 65535 && (count += histogram[step]) <= wanted) ++step;
    return low + (high - low) * step / 65535;
  };
  return [below(share * data.length), below((1 - share) * data.length)];
}

/** For each point its place in the order in which points were chosen, from 1; 0 if it was not. */
function chosenOrder(points, mesh, chosen) {
  const order = new Uint32Array(points.count), places = new Map();
  chosen.points.forEach(({vertex, type}, k) => places.set(`${type} ${vertex}`, k + 1));
  for (let i = 0; i < points.count; ++i)
    order[i] = places.get(`${typeNames[points.type[i]]} ${mesh.inputVertex(points.vertex[i])}`) ?? 0;
  return order;
}

/**
 * A method's arrays, and what follows from them: persistence of points and pairs, points by vertex and by
 * counterpart, and those that were chosen, if any were.
 */
function readMethod(buffers, meta, report, mesh) {
  const method = resolve(buffers, meta);
  method.report = report;
  method.values.range = middleRange(method.values, 0.03);
  const {points, pairs} = method;
  points.count = points.vertex.length;
  points.persistence = new Float64Array(points.count).fill(-1);
  points.partners = new Map();
  pairs.count = pairs.extremum.length;
  pairs.birth = new Float64Array(pairs.count);
  pairs.death = new Float64Array(pairs.count);
  pairs.persistence = new Float64Array(pairs.count);
  const addPartner = (of, partner) => {
    if (!points.partners.has(of)) points.partners.set(of, []);
    points.partners.get(of).push(partner);
  };
  const open = new Int32Array(points.count);  // the multiplicity that no pair takes
  for (let i = 0; i < points.count; ++i) open[i] = points.multiplicity[i];
  for (let k = 0; k < pairs.count; ++k) {
    const extremum = pairs.extremum[k], saddle = pairs.saddle[k];
    const ofCap = extremum >= points.count;
    const values = [points.value[saddle], ofCap ? Infinity : points.value[extremum]];
    pairs.birth[k] = Math.min(...values);
    pairs.death[k] = Math.max(...values);
    pairs.persistence[k] = pairs.death[k] - pairs.birth[k];
    for (const i of ofCap ? [saddle] : [saddle, extremum]) {
      points.persistence[i] = Math.max(points.persistence[i], pairs.persistence[k]);
      --open[i];
    }
    addPartner(saddle, extremum);
    if (!ofCap) addPartner(extremum, saddle);
  }
  for (let i = 0; i < points.count; ++i)
    if (open[i] > 0) points.persistence[i] = Infinity;
  points.shown = Float32Array.from(points.persistence, (p) => Math.min(p, 3e38));  // as shaders compare it
  points.byVertex = new Map();
  points.byMatch = new Map();
  for (let i = 0; i < points.count; ++i) {
    points.byVertex.set(points.vertex[i], i);
    if (points.match[i] > 0) points.byMatch.set(points.match[i] - 1, i);
  }
  points.ranking = Array.from({length: points.count}, (_, i) => i)
                       .sort((a, b) => points.shown[b] - points.shown[a] || a - b);
  points.rankedShown = Float32Array.from(points.ranking, (i) => points.shown[i]);
  points.chosen = report.chosen ? chosenOrder(points, mesh, report.chosen) : null;
  return method;
}

async function readPage() {
  const page = JSON.parse(element('page').textContent);
  if (page.schema !== 'morsel.page/1') throw new Error('the page\'s data are of an unknown kind');
  const buffers = await inflate('buffers');
  if (buffers.byteLength !== page.buffers_bytes) throw new Error('the page\'s data are not whole');
  page.mesh = readMesh(buffers, page.mesh);
  page.methods = page.methods.map((meta, i) => readMethod(buffers, meta, page.report.methods[i], page.mesh));
  return page;
}

const typeNames = ['regular', 'minimum', 'saddle', 'maximum'];

/** Six significant digits at most, as short as may be. */
function formatNumber(x) {
  if (x === null || x === undefined) return '—';
  if (!Number.isFinite(x)) return x > 0 ? '∞' : '−∞';
  const text = String(Number(x.toPrecision(6)));
  return text.replace('-', '−');
}
function formatCount(n) { return n.toLocaleString('en-GB'); }

/** A DOM element with attributes and children; texts are texts, never markup. */
function make(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...children);
  return node;
}
