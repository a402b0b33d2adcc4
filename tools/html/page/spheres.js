// Critical points: spheres drawn as squares that face the viewer, whose shader finds the sphere.

const sphereVertexShader = `
attribute vec3 center;
attribute float kind;
attribute float shown;
attribute float number;
uniform float radius;
uniform float threshold;
uniform vec3 kinds;  // 1 if minima, saddles, maxima are shown
uniform float selected;
varying vec2 vAt;
varying vec3 vCenter;
varying float vKind;
varying float vRadius;
varying float vSelected;
void main() {
  float visible = kind < 1.5 ? kinds.x : kind < 2.5 ? kinds.y : kinds.z;
  vSelected = number == selected ? 1.0 : 0.0;
  if (vSelected < 0.5 && (visible < 0.5 || (shown <= threshold && threshold > 0.0))) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  vRadius = radius * (vSelected > 0.5 ? 1.35 : 1.0);
  vCenter = (modelViewMatrix * vec4(center, 1.0)).xyz;
  vAt = position.xy * (vSelected > 0.5 ? 1.45 : 1.06);
  vKind = kind;
  gl_Position = projectionMatrix * vec4(vCenter + vec3(vAt * vRadius, 0.0), 1.0);
}`;

const sphereFragmentShader = `
uniform vec3 colors[3];
uniform vec3 haloColor;
uniform mat4 projection;
varying vec2 vAt;
varying vec3 vCenter;
varying float vKind;
varying float vRadius;
varying float vSelected;
float depthAt(float z) { return 0.5 + 0.5 * (projection[2][2] * z + projection[3][2]) / -z; }
void main() {
  float r = length(vAt), soft = fwidth(r);
  if (r > 1.0 + soft) {  // the ring round the selected point
    float ring = smoothstep(1.12, 1.12 + soft, r) * (1.0 - smoothstep(1.40 - soft, 1.40, r));
    if (vSelected < 0.5 || ring < 0.01) discard;
    gl_FragDepthEXT = depthAt(vCenter.z + vRadius);
    gl_FragColor = vec4(haloColor, ring);
    return;
  }
  vec3 n = vec3(vAt, sqrt(max(0.0, 1.0 - r * r)));
  vec3 base = vKind < 1.5 ? colors[0] : vKind < 2.5 ? colors[1] : colors[2];
  float key = max(dot(n, normalize(vec3(-0.35, 0.55, 0.85))), 0.0);
  vec3 color = base * (0.50 + 0.55 * key) + 0.35 * pow(key, 24.0);
  color *= mix(0.55, 1.0, smoothstep(0.0, 0.42, n.z));  // a dark rim parts points from the surface and from each other
  gl_FragDepthEXT = depthAt(vCenter.z + vRadius * n.z);
  gl_FragColor = vec4(color, 1.0 - smoothstep(1.0 - soft, 1.0 + soft, r));
}`;

class Spheres {
  constructor(mesh, points) {
    const geometry = new THREE.InstancedBufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]), 3));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    this.centers = new Float32Array(3 * points.count);
    for (let i = 0; i < points.count; ++i)
      for (let c = 0; c < 3; ++c) this.centers[3 * i + c] = mesh.positions[3 * points.place[i] + c];
    const each = (array, size) => new THREE.InstancedBufferAttribute(array, size);
    geometry.setAttribute('center', each(this.centers, 3));
    geometry.setAttribute('kind', each(Float32Array.from(points.type), 1));
    geometry.setAttribute('shown', each(points.shown, 1));
    geometry.setAttribute('number', each(Float32Array.from({length: points.count}, (_, i) => i), 1));
    geometry.maxInstancedCount = points.count;
    this.projection = new THREE.Matrix4();
    this.material = new THREE.ShaderMaterial({
      uniforms: {
        radius: {value: 0.01}, threshold: {value: 0}, kinds: {value: new THREE.Vector3(1, 1, 1)}, selected: {value: -1},
        colors: {value: [new THREE.Vector3(0.13, 0.38, 0.85), new THREE.Vector3(0.18, 0.70, 0.36), new THREE.Vector3(0.85, 0.14, 0.20)]},
        haloColor: {value: new THREE.Vector3(0, 0, 0)}, projection: {value: this.projection},
      },
      vertexShader: sphereVertexShader, fragmentShader: sphereFragmentShader, transparent: true, side: THREE.DoubleSide,
    });
    this.object = new THREE.Mesh(geometry, this.material);
    this.object.frustumCulled = false;
    this.object.renderOrder = 2;
  }
}
