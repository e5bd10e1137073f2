// The scene: spheres and rectangles, cast by the same equations as in the shader. All spheres turn about the vertical
// axis through TURN as time goes on.
const SPHERES = SCENE.spheres, RECTANGLES = SCENE.rectangles, TURN = SCENE.turn;

function turned(point, time) {
  const c = Math.cos(2 * Math.PI * time), s = Math.sin(2 * Math.PI * time), x = point[0] - TURN[0], z = point[2] - TURN[1];
  return [TURN[0] + c * x + s * z, point[1], TURN[1] - s * x + c * z];
}

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const along = (o, t, d) => [o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]];
const size = (a) => Math.hypot(a[0], a[1], a[2]);
const scaled = (a, k) => [a[0] * k, a[1] * k, a[2] * k];

function cast(origin, direction, time) {
  const d = scaled(direction, 1 / size(direction));
  let best = { t: Infinity, index: -1 };
  SPHERES.forEach((sphere, index) => {
    const center = turned(sphere.center, time), to = minus(origin, center), b = dot(to, d), off = minus(to, scaled(d, b));
    const rest = sphere.radius ** 2 - dot(off, off);
    if (rest < 0) return;
    const root = Math.sqrt(rest), t = [-b - root, -b + root].find((one) => one > SCENE.near);
    if (t < best.t) { const point = along(origin, t, d); best = { t, index, point, normal: scaled(minus(point, center), 1 / sphere.radius), name: sphere.name }; }
  });
  RECTANGLES.forEach((flat, k) => {
    const n = cross(flat.u, flat.v), slope = dot(n, d);
    if (slope === 0) return;
    const t = dot(n, minus(flat.center, origin)) / slope, point = along(origin, t, d), q = minus(point, flat.center);
    if (!(t > SCENE.near && t < best.t) || Math.abs(dot(q, flat.u)) > dot(flat.u, flat.u) || Math.abs(dot(q, flat.v)) > dot(flat.v, flat.v)) return;
    best = { t, index: SPHERES.length + k, point, normal: scaled(n, (slope > 0 ? -1 : 1) / size(n)), name: flat.name };
  });
  return best;
}

// The camera in the room: its eye, and its axes u right, v up, w ahead.
function pose(state) {
  const c = Math.cos(state.turn), s = Math.sin(state.turn), C = Math.cos(state.tilt), S = Math.sin(state.tilt);
  const w = [-s * C, S, -c * C], u = [c, 0, -s];
  return { eye: [0, SCENE.height, state.walk], u, v: cross(u, w), w };
}

function toWorld(at, vector) {
  return [0, 1, 2].map((k) => vector[0] * at.u[k] + vector[1] * at.v[k] - vector[2] * at.w[k]);
}

function worldRay(at, ray) {
  const o = toWorld(at, ray.slice(0, 3)), d = toWorld(at, ray.slice(3));
  return { origin: along(at.eye, 1, o), direction: scaled(d, 1 / size(d)) };
}

const TIMES = ["none", "rows", "columns", "circles"];
function timeOf(state, frame, x, y) {
  const a = x / frame[0] - 0.5, b = y / frame[1] - 0.5;
  return state.time + state.spread * [0, b, a, Math.hypot(a * frame[0] / frame[1], b) - 0.5][TIMES.indexOf(state.times)];
}
