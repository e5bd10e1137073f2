// The second view: the room, the camera with its axes and its image, and the ray, seen from outside.
const VIEWS = { outside: { turn: 0.75, tilt: 0.42, far: 9.5 * SCENE.scale }, above: { turn: 0, tilt: 1.5607, far: 10 * SCENE.scale }, side: { turn: Math.PI / 2, tilt: 0.02, far: 10 * SCENE.scale } };
const LINES = 9, POINTS = 25, IMAGE = 1.4 * SCENE.scale, WALL = [32, 18];
// Where a label may stand about its point, in lines of text: the first place that is free.
const PLACES = [[0, 0], [0, -1.3], [0, 1.3], [1.6, 0], [-1.6, 0], [1.6, -1.3], [-1.6, -1.3], [1.6, 1.3], [-1.6, 1.3], [0, -2.6], [0, 2.6]];

class Space {
  constructor(canvas) {
    this.canvas = canvas;
    this.view = { ...VIEWS.outside };
  }

  draw(camera, state, seen) {
    this.drawAll(camera, state, seen);
    this.wanted.forEach((label) => this.write(label));
  }

  drawAll(camera, state, seen) {
    const canvas = this.canvas, ratio = window.devicePixelRatio || 1, box = canvas.getBoundingClientRect();
    canvas.width = Math.max(2, Math.round(box.width * ratio));
    canvas.height = Math.max(2, Math.round(box.height * ratio));
    const g = this.g = canvas.getContext("2d"), style = getComputedStyle(document.documentElement);
    const ink = (name) => style.getPropertyValue(name).trim();
    this.unit = ratio;
    this.labels = [];
    this.wanted = [];
    this.strokes = [];
    g.fillStyle = ink("--space");
    g.fillRect(0, 0, canvas.width, canvas.height);
    const at = pose(state), isBox = camera.key.endsWith("CAMERA_OBSCURA");
    const home = SCENE.camera, scale = SCENE.scale;
    this.look = this.looking(along(along(home.eye, -state.walk + (this.view.ahead ?? 2.6) * scale, home.w), -0.4 * SCENE.height, [0, 1, 0]));
    for (let k = -6; SCENE.still && k <= 6; k++) {
      const x = home.eye[0], z = home.eye[2], s = 2 * scale;
      this.line([[x + k * s, SCENE.floor, z - 6 * s], [x + k * s, SCENE.floor, z + 6 * s]], ink("--faint"), 1);
      this.line([[x - 6 * s, SCENE.floor, z + k * s], [x + 6 * s, SCENE.floor, z + k * s]], ink("--faint"), 1);
    }
    if (SCENE.triangles) this.facets();
    for (let k = -6; !SCENE.still && k <= 6; k++) {
      this.line([[k, SCENE.floor, SCENE.back], [k, SCENE.floor, 4]], ink("--faint"), 1);
      if (SCENE.back + k + 6 <= 4) this.line([[-6, SCENE.floor, SCENE.back + k + 6], [6, SCENE.floor, SCENE.back + k + 6]], ink("--faint"), 1);
    }
    SPHERES.map((sphere) => ({ sphere, center: turned(sphere.center, seen ? seen.time : state.time) }))
      .sort((a, b) => this.depth(b.center) - this.depth(a.center)).forEach(({ sphere, center }) => this.ball(center, sphere));
    const image = (x, y) => {
      const ray = camera.ray(x * camera.size[0], y * camera.size[1]);
      if (!ray || Number.isNaN(ray[3])) return null;
      const length = camera.planar ? 1 : norm(ray.slice(3));
      return along(at.eye, 1, toWorld(at, [0, 1, 2].map((k) => ray[k] + (isBox ? -IMAGE : IMAGE) * ray[k + 3] / length)));
    };
    if (isBox) this.box(camera, state, at, image, ink);
    for (let k = 0; k < LINES; k++) {
      const edge = k === 0 || k === LINES - 1, share = k / (LINES - 1), steps = Array.from({ length: POINTS }, (_, n) => n / (POINTS - 1));
      for (const points of [steps.map((n) => image(share, n)), steps.map((n) => image(n, share))])
        this.line(points, edge ? ink("--image") : ink("--image-faint"), edge ? 1.6 : 0.8);
    }
    if (camera.central) for (const [x, y] of [[0, 0], [1, 0], [0, 1], [1, 1]]) this.line([at.eye, image(x, y)], ink("--image-faint"), 0.8);
    [["u", at.u, "--u"], ["v", at.v, "--v"], ["w", at.w, "--w"]].forEach(([name, axis, color]) => {
      const end = along(at.eye, 0.7 * scale, axis);
      this.line([at.eye, end], ink(color), 2.4);
      this.label(along(at.eye, 0.8 * scale, axis), name, ink(color));
    });
    this.dot(at.eye, 4, ink("--ink"));
    this.label(along(at.eye, -0.16 * scale, at.v), isBox ? "hole" : "eye", ink("--ink"));
    if (!seen) return;
    const { ray, hit } = seen, end = along(ray.origin, hit.index < 0 ? 20 * scale : hit.t, ray.direction);
    this.line([ray.origin, end], ink("--ray"), 2.6);
    if (norm(minus(ray.origin, at.eye)) > 1e-6 * scale) { this.line([at.eye, ray.origin], ink("--ray"), 1, [3, 4]); this.dot(ray.origin, 4, ink("--ray")); this.label(along(ray.origin, 0.12 * scale, at.v), "o", ink("--ray")); }
    const place = image(state.x / camera.size[0], state.y / camera.size[1]);
    if (place) this.dot(place, 4, ink("--image"));
    if (place && isBox) this.line([place, at.eye], ink("--ray"), 2.6);
    if (hit.index >= 0) {
      this.line([hit.point, along(hit.point, 0.5 * scale, hit.normal)], ink("--v"), 2);
      this.dot(hit.point, 5, ink("--ray"));
      this.label(along(hit.point, 0.25 * scale, [0, 1, 0]), `t = ${shown(hit.t, 4)}`, ink("--ray"));
    }
    if (camera.key === "PERSP") this.distance(at, image, ink);
  }

  // Of the camera obscura: the box between the hole and the wall behind it, and on the wall what its pixels see.
  box(camera, state, at, image, ink) {
    const [columns, rows] = WALL, [width, height] = camera.size, g = this.g;
    for (let i = 0; i < columns; i++) for (let j = 0; j < rows; j++) {
      const x = (i + 0.5) / columns, y = (j + 0.5) / rows, ray = camera.ray(x * width, y * height);
      const seen = worldRay(at, ray), hit = cast(seen.origin, seen.direction, timeOf(state, camera.size, x * width, y * height));
      const corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(([a, b]) => image(a / columns, b / rows)).map((corner) => corner && this.place(corner));
      if (hit.index < 0 || corners.includes(null)) continue;
      const light = 0.6 + 0.4 * Math.abs(dot(hit.normal, seen.direction));
      g.fillStyle = `rgb(${(hit.color ?? [...SPHERES, ...RECTANGLES][hit.index].color).map((channel) => Math.round(255 * (channel * light) ** (1 / 2.2)))})`;
      g.beginPath();
      corners.forEach((corner) => g.lineTo(corner[0], corner[1]));
      g.closePath();
      g.fill();
      g.strokeStyle = g.fillStyle; // closes the seams
      g.lineWidth = this.unit;
      g.stroke();
    }
    const wall = [[0, 0], [1, 0], [1, 1], [0, 1]].map(([a, b]) => image(a, b)), front = wall.map((corner) => corner && along(corner, IMAGE, at.w));
    this.line([...front, front[0]], ink("--muted"), 1.4);
    wall.forEach((corner, k) => this.line([corner, front[k]], ink("--muted"), 1.4));
    if (wall[0] && wall[1]) this.label(along(scaled(along(wall[0], 1, wall[1]), 0.5), -0.15 * SCENE.scale, at.v), "wall", ink("--image"));
  }

  // Of the pinhole: the distance d of an image over [-1, 1]², and half the angle of view.
  distance(at, image, ink) {
    const left = image(0, 0.5), right = image(1, 0.5);
    if (!left || !right) return;
    const middle = scaled(along(left, 1, right), 0.5), ahead = minus(middle, at.eye);
    this.line([at.eye, middle], ink("--muted"), 1.4, [5, 4]);
    this.label(along(along(at.eye, 0.78, ahead), 0.12 * SCENE.scale, minus(left, middle).map((x) => x / norm(minus(left, middle)))), "d", ink("--ink"));
    const to = minus(right, at.eye), arc = [];
    for (let k = 0; k <= 12; k++) { const p = [0, 1, 2].map((i) => ahead[i] + k / 12 * (to[i] - ahead[i])); arc.push(along(at.eye, 0.9 * SCENE.scale / norm(p), p)); }
    this.line(arc, ink("--ink"), 1.4);
    this.label(along(at.eye, 1.22, arc[6].map((x, i) => (x - at.eye[i]) / 0.9)), "fov/2", ink("--ink"));
  }

  // The triangles, as glass: what stands behind them is seen. They are drawn anew only when the view has changed.
  facets() {
    const { canvas, look } = this, key = JSON.stringify([look, canvas.width, canvas.height]);
    if (this.cached?.key !== key) {
      const made = document.createElement("canvas"), g = made.getContext("2d");
      made.width = canvas.width;
      made.height = canvas.height;
      g.globalAlpha = 0.3;
      for (let k = 0; k < SCENE.triangles; k++) {
        const { corner, first, second, color } = facet(k), corners = [corner, along(corner, 1, first), along(corner, 1, second)].map((point) => this.place(point));
        if (corners.includes(null)) continue;
        g.fillStyle = `rgb(${color.map((channel) => Math.round(255 * channel ** (1 / 2.2)))})`;
        g.beginPath();
        corners.forEach((point) => g.lineTo(point[0], point[1]));
        g.fill();
      }
      this.cached = { key, made };
    }
    this.g.drawImage(this.cached.made, 0, 0);
  }

  looking(target) {
    const { tilt, far } = this.view, ahead = SCENE.camera.w, turn = this.view.turn + Math.atan2(-ahead[0], -ahead[2]), c = Math.cos(turn), s = Math.sin(turn), C = Math.cos(tilt), S = Math.sin(tilt);
    const back = [s * C, S, c * C], right = [c, 0, -s];
    return { eye: along(target, far, back), back, right, up: cross(back, right) };
  }

  depth(point) { return -dot(minus(point, this.look.eye), this.look.back); }

  place(point) {
    const q = minus(point, this.look.eye), z = -dot(q, this.look.back), scale = 1.35 * Math.min(this.canvas.width / 1.5, this.canvas.height);
    return z < 0.05 * SCENE.scale ? null : [this.canvas.width / 2 + scale * dot(q, this.look.right) / z, this.canvas.height / 2 - scale * dot(q, this.look.up) / z, scale / z];
  }

  line(points, color, width, dash = []) {
    const g = this.g;
    g.strokeStyle = color;
    g.lineWidth = width * this.unit;
    g.setLineDash(dash.map((length) => length * this.unit));
    g.beginPath();
    let last = null;
    for (let n = 0; n < points.length; n++) {
      const to = points[n] && this.place(points[n]);
      if (to && last) g.lineTo(to[0], to[1]); else if (to) g.moveTo(to[0], to[1]);
      if (to && last && width > 1.2) this.strokes.push([last, to]);
      last = to;
    }
    g.stroke();
    g.setLineDash([]);
  }

  dot(point, radius, color) {
    const to = this.place(point), g = this.g;
    if (!to) return;
    g.fillStyle = color;
    g.beginPath();
    g.arc(to[0], to[1], radius * this.unit, 0, 2 * Math.PI);
    g.fill();
  }

  ball(center, sphere) {
    const to = this.place(center), g = this.g;
    if (!to) return;
    const [r, gr, b] = sphere.color.map((channel) => Math.round(255 * channel ** (1 / 2.2))), radius = sphere.radius * to[2];
    const shade = g.createRadialGradient(to[0] - radius / 3, to[1] - radius / 3, radius / 8, to[0], to[1], radius);
    shade.addColorStop(0, `rgb(${Math.min(255, r + 50)},${Math.min(255, gr + 50)},${Math.min(255, b + 50)})`);
    shade.addColorStop(1, `rgb(${Math.round(r * 0.62)},${Math.round(gr * 0.62)},${Math.round(b * 0.62)})`);
    g.fillStyle = shade;
    g.beginPath();
    g.arc(to[0], to[1], radius, 0, 2 * Math.PI);
    g.fill();
  }

  label(point, text, color) { this.wanted.push({ point, text, color }); }

  // A label stands near its point, where none before it stands and where it covers the fewest lines; without such a
  // place it is left out.
  write({ point, text, color }) {
    const to = this.place(point), g = this.g;
    if (!to) return;
    g.font = `600 ${13 * this.unit}px system-ui, sans-serif`;
    g.textAlign = "center";
    g.textBaseline = "middle";
    g.lineWidth = 3 * this.unit;
    g.strokeStyle = getComputedStyle(document.documentElement).getPropertyValue("--space").trim();
    const half = g.measureText(text).width / 2 + g.lineWidth, high = 13 * this.unit;
    const covered = (x, y) => this.strokes.filter(([a, b]) => {
      for (let k = 0, steps = Math.ceil(Math.hypot(b[0] - a[0], b[1] - a[1]) / (high / 3)); k <= steps; k++) {
        const share = k / Math.max(steps, 1);
        if (Math.abs(a[0] + share * (b[0] - a[0]) - x) < half && Math.abs(a[1] + share * (b[1] - a[1]) - y) < 0.6 * high) return true;
      }
      return false;
    }).length;
    const free = PLACES.map(([a, b]) => [Math.min(Math.max(to[0] + a * half, half), g.canvas.width - half), Math.min(Math.max(to[1] + b * high, high), g.canvas.height - high)])
      .filter((label) => this.labels.every((other) => Math.abs(other.x - label[0]) >= other.half + half || Math.abs(other.y - label[1]) >= 1.2 * high));
    if (!free.length) return;
    const counts = free.map(([x, y]) => covered(x, y)), [x, y] = free[counts.indexOf(Math.min(...counts))];
    this.labels.push({ text, x, y, half });
    g.strokeText(text, x, y);
    g.fillStyle = color;
    g.fillText(text, x, y);
  }
}
