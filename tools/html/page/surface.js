// The surface: shared by all methods but for its colours.

/** Unit normals of the vertices, weighted by area. */
function vertexNormals(positions, corners) {
  const normals = new Float32Array(positions.length);
  for (let h = 0; h < corners.length; h += 3) {
    const a = 3 * corners[h], b = 3 * corners[h + 1], c = 3 * corners[h + 2];
    const ux = positions[b] - positions[a], uy = positions[b + 1] - positions[a + 1],
          uz = positions[b + 2] - positions[a + 2];
    const vx = positions[c] - positions[a], vy = positions[c + 1] - positions[a + 1],
          vz = positions[c + 2] - positions[a + 2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    for (const v of [a, b, c]) {
      normals[v] += x;
      normals[v + 1] += y;
      normals[v + 2] += z;
    }
  }
  for (let v = 0; v < normals.length; v += 3) {
    const length = Math.hypot(normals[v], normals[v + 1], normals[v + 2]) || 1;
    normals[v] /= length;
    normals[v + 1] /= length;
    normals[v + 2] /= length;
  }
  return normals;
}

function surfaceArea(positions, corners) {
  let twice = 0;
  for (let h = 0; h < corners.length; h += 3) {
    const [a, b, c] = [3 * corners[h], 3 * corners[h + 1], 3 * corners[h + 2]];
    const u = [0, 1, 2].map((k) => positions[b + k] - positions[a + k]),
          v = [0, 1, 2].map((k) => positions[c + k] - positions[a + k]);
    twice += Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
  }
  return twice / 2;
}

const surfaceVertexShader = `
attribute float fieldValue;
attribute vec3 segmentColor;
varying vec3 vNormal;
varying vec3 vPosition;
varying float vValue;
varying vec3 vColor;
void main() {
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  vPosition = seen.xyz;
  vNormal = normalMatrix * normal;
  vValue = fieldValue;
  vColor = segmentColor;
  gl_Position = projectionMatrix * seen;
}`;

const surfaceFragmentShader = `
uniform sampler2D ramp;
uniform vec2 scale;  // value of the ramp = scale.x + scale.y * fieldValue
uniform int coloring;  // 0 by field, 1 by segment, 2 plain
varying vec3 vNormal;
varying vec3 vPosition;
varying float vValue;
varying vec3 vColor;
void main() {
  float place = clamp(scale.x + scale.y * vValue, 0.0, 1.0);
  vec3 base = coloring == 0 ? texture2D(ramp, vec2((place * 255.0 + 0.5) / 256.0, 0.5)).rgb
            : coloring == 1 ? vColor : vec3(0.80, 0.81, 0.83);
  vec3 n = normalize(gl_FrontFacing ? vNormal : -vNormal);
  vec3 eye = normalize(-vPosition);
  vec3 light = normalize(vec3(-0.35, 0.55, 0.85));
  float key = max(dot(n, light), 0.0), fill = max(dot(n, normalize(vec3(0.7, -0.2, 0.6))), 0.0);
  float shine = pow(max(dot(n, normalize(light + eye)), 0.0), 40.0);
  vec3 color = base * (0.36 + 0.58 * key + 0.16 * fill) + 0.10 * shine;
  if (!gl_FrontFacing) color *= 0.62;
  gl_FragColor = vec4(color, 1.0);
}`;

/**
 * What the views share: positions, normals, triangles, once by vertices and, when segments are wanted, once
 * by corners.
 */
class SurfaceParts {
  constructor(mesh) {
    this.mesh = mesh;
    this.normals = vertexNormals(mesh.positions, mesh.corners);
    this.area = surfaceArea(mesh.positions, mesh.corners);
    this.position = new THREE.BufferAttribute(mesh.positions, 3);
    this.normal = new THREE.BufferAttribute(this.normals, 3);
    this.index = new THREE.BufferAttribute(mesh.corners, 1);
    this.cornerPosition = null;
  }

  byVertex(values) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', this.position);
    geometry.setAttribute('normal', this.normal);
    geometry.setAttribute('fieldValue', new THREE.BufferAttribute(values, 1, true));
    geometry.setIndex(this.index);
    return geometry;
  }

  /** Each triangle of one colour. */
  byTriangle(labels, colors) {
    const {corners, positions} = this.mesh;
    if (this.cornerPosition === null) {
      const spread = (source) => {
        const result = new Float32Array(3 * corners.length);
        for (let h = 0; h < corners.length; ++h)
          for (let c = 0; c < 3; ++c) result[3 * h + c] = source[3 * corners[h] + c];
        return new THREE.BufferAttribute(result, 3);
      };
      this.cornerPosition = spread(positions);
      this.cornerNormal = spread(this.normals);
    }
    const bytes = new Uint8Array(3 * corners.length);
    for (let h = 0; h < corners.length; ++h) {
      const color = segmentColors[colors[labels[(h / 3) | 0]]];
      for (let c = 0; c < 3; ++c) bytes[3 * h + c] = color[c];
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', this.cornerPosition);
    geometry.setAttribute('normal', this.cornerNormal);
    geometry.setAttribute('segmentColor', new THREE.BufferAttribute(bytes, 3, true));
    return geometry;
  }

  segments(method, kind) {
    const {ascending, descending} = method.segments;
    const last = (labels) => ({labels, count: maximumOf(labels, 0, labels.length) + 1});
    const {labels, count} = kind === 'cells' ? numberPairs(ascending, descending) :
                                               last(kind === 'ascending' ? ascending : descending);
    return this.byTriangle(labels, colorSegments(this.mesh.corners, this.mesh.vertices, labels, count));
  }
}

function rampTexture(bytes) {
  const texture = new THREE.DataTexture(bytes, 256, 1, THREE.RGBAFormat);
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/** The surface as one method colours it. */
class Surface {
  constructor(parts, method) {
    this.parts = parts;
    this.method = method;
    this.textures = new Map();
    this.material = new THREE.ShaderMaterial({
      uniforms: {ramp: {value: null}, scale: {value: new THREE.Vector2()}, coloring: {value: 0}},
      vertexShader: surfaceVertexShader,
      fragmentShader: surfaceFragmentShader,
      side: THREE.DoubleSide,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
    this.geometries = new Map([['field', parts.byVertex(method.values.data)]]);
    this.object = new THREE.Mesh(this.geometries.get('field'), this.material);
    this.object.frustumCulled = false;
  }

  color(kind, scale) {
    const isSegment = kind !== 'field' && kind !== 'plain';
    const key = isSegment ? kind : 'field';
    if (!this.geometries.has(key)) {  // one kind of segments at a time is kept: they are as large as the mesh
      for (const [other, geometry] of this.geometries)
        if (other !== 'field') {
          geometry.dispose();
          this.geometries.delete(other);
        }
      this.geometries.set(key, this.parts.segments(this.method, kind));
    }
    this.object.geometry = this.geometries.get(key);
    const uniforms = this.material.uniforms;
    uniforms.coloring.value = isSegment ? 1 : kind === 'plain' ? 2 : 0;
    const {low, high} = this.method.values, width = scale.high - scale.low;
    uniforms.scale.value.set(
        width > 0 ? (low - scale.low) / width : 0.5, width > 0 ? (high - low) / width : 0);
    if (!this.textures.has(scale.bytes)) this.textures.set(scale.bytes, rampTexture(scale.bytes));
    uniforms.ramp.value = this.textures.get(scale.bytes);
  }
}
