// The scene: spheres and rectangles, cast by the same equations as in the shader. All spheres turn about the vertical
// axis through TURN as time goes on.
const SPHERES = SCENE.spheres, RECTANGLES = SCENE.rectangles, TURN = SCENE.turn;

// The triangles: texels of four numbers, first two for each box of their tree, then three for each triangle.
const FACETS = new Float32Array(Uint8Array.from(atob(SCENE.facets), (letter) => letter.charCodeAt(0)).buffer);

function turned(point, time) {
  if (SCENE.still) return point;
  const c = Math.cos(2 * Math.PI * time), s = Math.sin(2 * Math.PI * time), x = point[0] - TURN[0], z = point[2] - TURN[1];
  return [TURN[0] + c * x + s * z, point[1], TURN[1] - s * x + c * z];
}

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const along = (o, t, d) => [o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]];
const norm = (a) => Math.hypot(a[0], a[1], a[2]);
const scaled = (a, k) => [a[0] * k, a[1] * k, a[2] * k];

function cast(origin, direction, time) {
  const d = scaled(direction, 1 / norm(direction));
  let best = { t: Infinity, index: -1 };
  SPHERES.forEach((sphere, index) => {
    const center = turned(sphere.center, time), to = minus(origin, center), b = dot(to, d), off = minus(to, scaled(d, b));
    const halfSquared = sphere.radius ** 2 - dot(off, off);
    if (halfSquared < 0) return;
    const root = Math.sqrt(halfSquared), t = [-b - root, -b + root].find((distance) => distance > SCENE.near);
    if (t < best.t) { const point = along(origin, t, d); best = { t, index, point, normal: scaled(minus(point, center), 1 / sphere.radius), name: sphere.name }; }
  });
  RECTANGLES.forEach((flat, k) => {
    const n = cross(flat.u, flat.v), slope = dot(n, d);
    if (slope === 0) return;
    const t = dot(n, minus(flat.center, origin)) / slope, point = along(origin, t, d), q = minus(point, flat.center);
    if (!(t > SCENE.near && t < best.t) || Math.abs(dot(q, flat.u)) > dot(flat.u, flat.u) || Math.abs(dot(q, flat.v)) > dot(flat.v, flat.v)) return;
    best = { t, index: SPHERES.length + k, point, normal: scaled(n, (slope > 0 ? -1 : 1) / norm(n)), name: flat.name };
  });
  for (let n = 0; n < SCENE.nodes;) {
    const at = 8 * n, leaf = FACETS[at + 7];
    let near = 0, far = best.t;
    for (let k = 0; k < 3; k++) {
      const a = (FACETS[at + k] - origin[k]) / d[k], b = (FACETS[at + 4 + k] - origin[k]) / d[k];
      if (Number.isNaN(a) || Number.isNaN(b)) continue; // parallel to a side, and on it
      near = Math.max(near, Math.min(a, b));
      far = Math.min(far, Math.max(a, b));
    }
    if (near > far * (1 + 1e-6)) { n = FACETS[at + 3]; continue; }
    for (let k = 0; leaf >= 0 && k < leaf % 8; k++) {
      const { corner, first, second, name, color } = facet(Math.floor(leaf / 8) + k), p = cross(d, second), det = dot(first, p), to = minus(origin, corner);
      const u = dot(to, p) / det, q = cross(to, first), v = dot(d, q) / det, t = dot(second, q) / det;
      if (det === 0 || u < 0 || v < 0 || u + v > 1 || !(t > SCENE.near && t < best.t)) continue;
      const normal = cross(first, second);
      best = { t, index: SPHERES.length + RECTANGLES.length, point: along(origin, t, d), normal: scaled(normal, (dot(normal, d) > 0 ? -1 : 1) / norm(normal)), name, color };
    }
    n++;
  }
  return best;
}

function facet(k) {
  const at = 8 * SCENE.nodes + 12 * k, [corner, first, second] = [0, 4, 8].map((off) => [...FACETS.subarray(at + off, at + off + 3)]), bits = FACETS[at + 7];
  return { corner, first, second, name: SCENE.names[FACETS[at + 3]], color: [0, 8, 16].map((shift) => ((bits >> shift & 255) / 255) ** 2.2) };
}

// The camera in the scene: its eye, and its axes u right, v up, w ahead.
function pose(state) {
  const c = Math.cos(state.turn), s = Math.sin(state.turn), C = Math.cos(state.tilt), S = Math.sin(state.tilt), home = SCENE.camera;
  const mixed = (a, b, e) => [0, 1, 2].map((k) => a * home.u[k] + b * home.v[k] + e * home.w[k]);
  const w = mixed(-s * C, S, c * C), u = mixed(c, 0, s);
  return { eye: along(home.eye, -state.walk, home.w), u, v: cross(u, w), w };
}

function toWorld(at, vector) {
  return [0, 1, 2].map((k) => vector[0] * at.u[k] + vector[1] * at.v[k] - vector[2] * at.w[k]);
}

function worldRay(at, ray) {
  const o = toWorld(at, ray.slice(0, 3)), d = toWorld(at, ray.slice(3));
  return { origin: along(at.eye, 1, o), direction: scaled(d, 1 / norm(d)) };
}

const TIMES = ["none", "rows", "columns", "circles"];
function timeOf(state, size, x, y) {
  const a = x / size[0] - 0.5, b = y / size[1] - 0.5;
  return state.time + state.spread * [0, b, a, Math.hypot(a * size[0] / size[1], b) - 0.5][TIMES.indexOf(state.times)];
}
