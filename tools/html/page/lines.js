// Arcs: ribbons of constant width on the screen, one instance a piece.

/** The pieces of polylines, six coordinates each, and the persistence up to which each is shown. */
function arcPieces(mesh, method, kind) {
  const paths = method.arcs[kind], {points} = method;
  const {positions, corners} = mesh;
  const ends = [], shown = [];
  const at = (v) => [positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]];
  const middle = (a, b) => [0, 1, 2].map((c) => (positions[3 * a + c] + positions[3 * b + c]) / 2);
  const center = (t) => [0, 1, 2].map(
      (c) => (positions[3 * corners[3 * t] + c] + positions[3 * corners[3 * t + 1] + c] +
              positions[3 * corners[3 * t + 2] + c]) /
          3);
  const numberOf = new Map();  // of the critical point at a vertex
  points.vertex.forEach((v, i) => numberOf.set(v, i));
  const side = (t, i) => middle(corners[3 * t + i], corners[3 * t + (i + 1) % 3]);
  const shared = (t, u) => {
    for (let i = 0; i < 3; ++i) {
      const a = corners[3 * t + i], b = corners[3 * t + (i + 1) % 3];
      for (let k = 0; k < 3; ++k)
        if (corners[3 * u + k] === b && corners[3 * u + (k + 1) % 3] === a) return middle(a, b);
    }
    throw new Error('the page\'s data are damaged: triangles of an arc are not neighbours');
  };
  let first = 0;
  for (let p = 0; p < paths.saddle.length; ++p) {
    const reach = Math.min(paths.reach[p], 3e38);  // as shaders compare it
    const cells = paths.cells.subarray(first, first + paths.length[p]), end = paths.end[p];
    first += paths.length[p];
    let before = null;
    const go = (to, until = reach) => {
      if (before !== null) {
        ends.push(...before, ...to);
        shown.push(until);
      }
      before = to;
    };
    if (kind === 'descending') {
      for (const v of cells) go(at(v));
      continue;
    }
    go(at(points.vertex[paths.saddle[p]]));
    if (end >= 7) {
      go(side(cells[0], end - 7));
      continue;
    }
    cells.forEach((t, i) => {
      if (i > 0) go(shared(cells[i - 1], t));
      go(center(t));
    });
    const lastCell = cells[cells.length - 1];
    if (end >= 4)
      go(side(lastCell, end - 4));
    else if (end >= 1) {
      const top = corners[3 * lastCell + end - 1];  // a maximum that is hidden is passed by
      go(at(top), Math.min(reach, points.shown[numberOf.get(top)]));
    }
  }
  // by falling persistence, so that a threshold ends them
  const order = Array.from({length: shown.length}, (_, k) => k).sort((a, b) => shown[b] - shown[a] || a - b);
  const sorted = new Float32Array(ends.length);
  order.forEach((k, n) => {
    for (let c = 0; c < 6; ++c) sorted[6 * n + c] = ends[6 * k + c];
  });
  return {ends: sorted, shown: Float32Array.from(order, (k) => shown[k])};
}

const lineVertexShader = `
attribute vec3 start;
attribute vec3 finish;
uniform vec2 viewport;
uniform float width;
varying float vSide;
void main() {
  vec4 a = projectionMatrix * (modelViewMatrix * vec4(start, 1.0));
  vec4 b = projectionMatrix * (modelViewMatrix * vec4(finish, 1.0));
  vec2 along = (b.xy / b.w - a.xy / a.w) * viewport;
  float size = length(along);
  vec2 direction = size > 0.0 ? along / size : vec2(1.0, 0.0);
  vec4 here = position.x < 0.5 ? a : b;
  vec2 shift = vec2(-direction.y, direction.x) * position.y + direction * (position.x - 0.5) * 0.8;
  here.xy += shift * width / viewport * here.w;
  here.z -= 0.0006 * here.w;  // towards the viewer: the surface goes through the same points
  vSide = position.y;
  gl_Position = here;
}`;

const lineFragmentShader = `
uniform vec3 color;
varying float vSide;
void main() { gl_FragColor = vec4(color, 1.0 - smoothstep(0.7, 1.0, abs(vSide))); }`;

class Arcs {
  constructor(pieces, color) {
    const geometry = new THREE.InstancedBufferGeometry();
    geometry.setAttribute(
        'position', new THREE.BufferAttribute(new Float32Array([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0]), 3));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    const both = new THREE.InstancedInterleavedBuffer(pieces.ends, 6, 1);
    geometry.setAttribute('start', new THREE.InterleavedBufferAttribute(both, 3, 0));
    geometry.setAttribute('finish', new THREE.InterleavedBufferAttribute(both, 3, 3));
    this.geometry = geometry;
    this.shown = pieces.shown;
    this.material = new THREE.ShaderMaterial({
      uniforms: {
        viewport: {value: new THREE.Vector2(1, 1)},
        width: {value: 2},
        color: {value: new THREE.Vector3(...color)}
      },
      vertexShader: lineVertexShader,
      fragmentShader: lineFragmentShader,
      transparent: true,
      side: THREE.DoubleSide,
    });
    this.object = new THREE.Mesh(geometry, this.material);
    this.object.frustumCulled = false;
    this.object.renderOrder = 1;
    this.setThreshold(0);
  }

  setThreshold(threshold) {
    this.geometry.maxInstancedCount = shownCount(this.shown, threshold);
    this.isEmpty = this.geometry.maxInstancedCount === 0;
  }
}
