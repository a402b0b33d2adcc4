// Which critical point is under a place on the screen.

/**
 * Whether a triangle lies between two places: the first one met counts, and none within `slack` of the
 * second.
 */
function isHidden(mesh, from, to, slack) {
  const d = [0, 1, 2].map((c) => to[c] - from[c]);
  const length = Math.hypot(...d);
  const last = (length - slack) / length;
  const {positions: p, corners} = mesh;
  for (let h = 0; h < corners.length; h += 3) {  // Möller, Trumbore 1997
    const a = 3 * corners[h], b = 3 * corners[h + 1], c = 3 * corners[h + 2];
    const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
    const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
    const qx = d[1] * vz - d[2] * vy, qy = d[2] * vx - d[0] * vz, qz = d[0] * vy - d[1] * vx;
    const det = ux * qx + uy * qy + uz * qz;
    if (det === 0) continue;
    const sx = from[0] - p[a], sy = from[1] - p[a + 1], sz = from[2] - p[a + 2];
    const s = (sx * qx + sy * qy + sz * qz) / det;
    if (s < 0 || s > 1) continue;
    const rx = sy * uz - sz * uy, ry = sz * ux - sx * uz, rz = sx * uy - sy * ux;
    const t = (d[0] * rx + d[1] * ry + d[2] * rz) / det;
    if (t < 0 || s + t > 1) continue;
    const at = (vx * rx + vy * ry + vz * rz) / det;
    if (at > 0 && at < last) return true;
  }
  return false;
}

/** The places of points on a view of `width` × `height`, and how large a radius looks there. */
function projectPoint(camera, centers, i, width, height) {
  const place = new THREE.Vector3(centers[3 * i], centers[3 * i + 1], centers[3 * i + 2]);
  const depth = -place.clone().applyMatrix4(camera.matrixWorldInverse).z;
  place.project(camera);
  return {
    x: (place.x + 1) / 2 * width,
    y: (1 - place.y) / 2 * height,
    depth,
    scale: height / (2 * depth * Math.tan(camera.fov * Math.PI / 360))
  };
}

/**
 * The number of the nearest point to (x, y) that is shown, within reach and not hidden by the surface; -1 if
 * there is none.
 */
function pickPoint(mesh, camera, spheres, isShown, radius, x, y, width, height) {
  const near = [];
  const count = spheres.centers.length / 3;
  for (let i = 0; i < count; ++i) {
    if (!isShown(i)) continue;
    const at = projectPoint(camera, spheres.centers, i, width, height);
    if (at.depth < camera.near) continue;
    const away = Math.hypot(at.x - x, at.y - y), size = radius * at.scale;
    if (away <= Math.max(size, 3) + 6) near.push({i, away, inside: away <= size, depth: at.depth});
  }
  // a click on spheres is for the one in front, a click beside them for the nearest
  near.sort((a, b) => b.inside - a.inside || (a.inside ? a.depth - b.depth : a.away - b.away));
  const eye = camera.position.toArray();
  for (const {i} of near.slice(0, 12))
    if (!isHidden(mesh, eye, [0, 1, 2].map((c) => spheres.centers[3 * i + c]), radius)) return i;
  return -1;
}
