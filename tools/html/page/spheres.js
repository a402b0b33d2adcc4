// Critical points: spheres drawn as single points, whose shader finds the sphere.

const sphereVertexShader = `
attribute vec4 look;  // type, 1 for the selected point, 1 for a chosen one, unused
uniform float radius;
uniform float pixels;  // the view's height
uniform vec3 kinds;  // 1 if minima, saddles, maxima are shown
uniform float onlyChosen;  // 1 if others than chosen points are hidden
varying float vExtent;
varying float vCenter;
varying float vKind;
varying float vRadius;
varying float vSelected;
void main() {
  float visible = look.x < 0.5 ? 0.0 : look.y > 0.5 ? 1.0 : look.z < onlyChosen ? 0.0
                : look.x < 1.5 ? kinds.x : look.x < 2.5 ? kinds.y : kinds.z;
  vKind = look.x;
  vSelected = look.y;
  vRadius = radius * (vSelected > 0.5 ? 1.35 : 1.0);
  vec4 center = modelViewMatrix * vec4(position, 1.0);
  vCenter = center.z;
  vExtent = vSelected > 0.5 ? 1.8 : 1.1;
  gl_Position = visible > 0.5 ? projectionMatrix * center : vec4(2.0, 2.0, 2.0, 1.0);
  gl_PointSize = max(vExtent * vRadius * projectionMatrix[1][1] / -center.z * pixels, 1.0);
}`;

const sphereFragmentShader = `
uniform vec3 colors[3];
uniform mat4 projection;
varying float vExtent;
varying float vCenter;
varying float vKind;
varying float vRadius;
varying float vSelected;
float depthAt(float z) { return 0.5 + 0.5 * (projection[2][2] * z + projection[3][2]) / -z; }
void main() {
  vec2 at = (2.0 * gl_PointCoord - 1.0) * vec2(1.0, -1.0) * vExtent;
  float r = length(at), soft = fwidth(at.x);
  if (r > 1.0 + soft) {  // the ring round the selected point: black in white, seen on any ground
    float ring = smoothstep(1.15, 1.15 + soft, r) * (1.0 - smoothstep(1.75 - soft, 1.75, r));
    if (vSelected < 0.5 || ring < 0.01) discard;
    gl_FragDepthEXT = depthAt(vCenter + vRadius);
    gl_FragColor = vec4(vec3(smoothstep(1.48 - soft, 1.48 + soft, r)), ring);
    return;
  }
  vec3 n = vec3(at, sqrt(max(0.0, 1.0 - r * r)));
  vec3 base = vKind < 1.5 ? colors[0] : vKind < 2.5 ? colors[1] : colors[2];
  float key = max(dot(n, normalize(vec3(-0.35, 0.55, 0.85))), 0.0);
  vec3 color = base * (0.50 + 0.55 * key) + 0.35 * pow(key, 24.0);
  // A dark rim separates points from surface and each other.
  color *= mix(0.55, 1.0, smoothstep(0.0, 0.42, n.z));
  gl_FragDepthEXT = depthAt(vCenter + vRadius * n.z);
  gl_FragColor = vec4(color, 1.0 - smoothstep(1.0 - soft, 1.0 + soft, r));
}`;

/**
 * A method's points. First drawn is the selected one, if any; then all by falling persistence, so that a
 * threshold ends them.
 */
class Spheres {
  constructor(mesh, points) {
    this.points = points;
    this.centers = new Float32Array(3 * points.count);
    for (let i = 0; i < points.count; ++i)
      for (let c = 0; c < 3; ++c) this.centers[3 * i + c] = mesh.positions[3 * points.place[i] + c];
    const position = new Float32Array(3 * (points.count + 1)), look = new Uint8Array(4 * (points.count + 1));
    points.ranking.forEach((i, rank) => {
      position.set(this.centers.subarray(3 * i, 3 * i + 3), 3 * (rank + 1));
      look[4 * (rank + 1)] = points.type[i];
      look[4 * (rank + 1) + 2] = points.chosen !== null && points.chosen[i] > 0 ? 1 : 0;
    });
    this.geometry = new THREE.BufferGeometry();
    this.position = new THREE.BufferAttribute(position, 3);
    this.look = new THREE.BufferAttribute(look, 4);
    this.geometry.setAttribute('position', this.position);
    this.geometry.setAttribute('look', this.look);
    this.projection = new THREE.Matrix4();
    this.material = new THREE.ShaderMaterial({
      uniforms: {
        radius: {value: 0.01},
        pixels: {value: 1},
        kinds: {value: new THREE.Vector3(1, 1, 1)},
        onlyChosen: {value: 0},
        projection: {value: this.projection},
        colors: {
          value: [
            new THREE.Vector3(0.13, 0.38, 0.85), new THREE.Vector3(0.18, 0.70, 0.36),
            new THREE.Vector3(0.85, 0.14, 0.20)
          ]
        },
      },
      vertexShader: sphereVertexShader,
      fragmentShader: sphereFragmentShader,
      transparent: true,
    });
    this.object = new THREE.Points(this.geometry, this.material);
    this.object.frustumCulled = false;
    this.object.renderOrder = 2;
    this.selected = -1;
  }

  select(i) {
    if (i === this.selected) return;
    this.selected = i;
    this.look.array.set(i < 0 ? [0, 0, 0, 0] : [this.points.type[i], 1, 0, 0], 0);
    if (i >= 0) this.position.array.set(this.centers.subarray(3 * i, 3 * i + 3), 0);
    this.look.needsUpdate = this.position.needsUpdate = true;
  }

  setThreshold(threshold) {
    this.geometry.setDrawRange(0, 1 + shownCount(this.points.rankedShown, threshold));
  }
}

/** How many of the falling persistences are shown: all at threshold 0, else those above. */
function shownCount(falling, threshold) {
  if (threshold === 0) return falling.length;
  let low = 0, high = falling.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (falling[middle] > threshold)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}
