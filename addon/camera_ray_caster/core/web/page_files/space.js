// The second view: the room, the camera with its axes and its image, and the ray, seen from outside.
const VIEWS = { outside: { turn: 0.75, tilt: 0.42, far: 9.5 }, above: { turn: 0, tilt: 1.5607, far: 10 }, side: { turn: Math.PI / 2, tilt: 0.02, far: 10 } };
const LINES = 9, POINTS = 25, IMAGE = 1.4;

class Space {
  constructor(canvas) {
    this.canvas = canvas;
    this.view = { ...VIEWS.outside };
  }

  draw(camera, state, seen) {
    const canvas = this.canvas, ratio = window.devicePixelRatio || 1, box = canvas.getBoundingClientRect();
    canvas.width = Math.max(2, Math.round(box.width * ratio));
    canvas.height = Math.max(2, Math.round(box.height * ratio));
    const g = this.g = canvas.getContext("2d"), style = getComputedStyle(document.documentElement);
    const ink = (name) => style.getPropertyValue(name).trim();
    this.unit = ratio;
    this.labels = [];
    g.fillStyle = ink("--space");
    g.fillRect(0, 0, canvas.width, canvas.height);
    const at = pose(state);
    this.look = this.looking([0, SCENE.height * 0.6, state.walk - (this.view.ahead ?? 2.6)]);
    for (let k = -6; k <= 6; k++) {
      this.line([[k, SCENE.floor, SCENE.back], [k, SCENE.floor, 4]], ink("--faint"), 1);
      if (SCENE.back + k + 6 <= 4) this.line([[-6, SCENE.floor, SCENE.back + k + 6], [6, SCENE.floor, SCENE.back + k + 6]], ink("--faint"), 1);
    }
    SPHERES.map((sphere) => ({ sphere, center: turned(sphere.center, seen ? seen.time : state.time) }))
      .sort((a, b) => this.depth(b.center) - this.depth(a.center)).forEach(({ sphere, center }) => this.ball(center, sphere));
    const image = (x, y) => {
      const ray = camera.ray(x * camera.frame[0], y * camera.frame[1]);
      if (!ray || Number.isNaN(ray[3])) return null;
      const length = camera.planar ? 1 : size(ray.slice(3));
      return along(at.eye, 1, toWorld(at, [0, 1, 2].map((k) => ray[k] + IMAGE * ray[k + 3] / length)));
    };
    for (let k = 0; k < LINES; k++) {
      const edge = k === 0 || k === LINES - 1, share = k / (LINES - 1), steps = Array.from({ length: POINTS }, (_, n) => n / (POINTS - 1));
      for (const points of [steps.map((n) => image(share, n)), steps.map((n) => image(n, share))])
        this.line(points, edge ? ink("--image") : ink("--image-faint"), edge ? 1.6 : 0.8);
    }
    if (camera.central) for (const [x, y] of [[0, 0], [1, 0], [0, 1], [1, 1]]) this.line([at.eye, image(x, y)], ink("--image-faint"), 0.8);
    [["u", at.u, "--u"], ["v", at.v, "--v"], ["w", at.w, "--w"]].forEach(([name, axis, color]) => {
      const end = along(at.eye, 0.7, axis);
      this.line([at.eye, end], ink(color), 2.4);
      this.label(along(at.eye, 0.8, axis), name, ink(color));
    });
    this.dot(at.eye, 4, ink("--ink"));
    this.label(along(at.eye, -0.16, at.v), "eye", ink("--ink"));
    if (!seen) return;
    const { ray, hit } = seen, end = along(ray.origin, hit.index < 0 ? 20 : hit.t, ray.direction);
    this.line([ray.origin, end], ink("--ray"), 2.6);
    if (size(minus(ray.origin, at.eye)) > 1e-6) { this.line([at.eye, ray.origin], ink("--ray"), 1, [3, 4]); this.dot(ray.origin, 4, ink("--ray")); this.label(along(ray.origin, 0.12, at.v), "o", ink("--ray")); }
    const place = image(state.x / camera.frame[0], state.y / camera.frame[1]);
    if (place) this.dot(place, 4, ink("--image"));
    if (hit.index >= 0) {
      this.line([hit.point, along(hit.point, 0.5, hit.normal)], ink("--v"), 2);
      this.dot(hit.point, 5, ink("--ray"));
      this.label(along(hit.point, 0.25, [0, 1, 0]), `t = ${shown(hit.t, 4)}`, ink("--ray"));
    }
    if (camera.key === "PERSP") this.distance(at, image, ink);
  }

  // Of the pinhole: the distance d of an image over [-1, 1]², and half the angle of view.
  distance(at, image, ink) {
    const left = image(0, 0.5), right = image(1, 0.5);
    if (!left || !right) return;
    const middle = scaled(along(left, 1, right), 0.5), ahead = minus(middle, at.eye);
    this.line([at.eye, middle], ink("--muted"), 1.4, [5, 4]);
    this.label(along(along(at.eye, 0.78, ahead), 0.12, minus(left, middle).map((x) => x / size(minus(left, middle)))), "d", ink("--ink"));
    const to = minus(right, at.eye), arc = [];
    for (let k = 0; k <= 12; k++) { const p = [0, 1, 2].map((i) => ahead[i] + k / 12 * (to[i] - ahead[i])); arc.push(along(at.eye, 0.9 / size(p), p)); }
    this.line(arc, ink("--ink"), 1.4);
    this.label(along(at.eye, 1.22, arc[6].map((x, i) => (x - at.eye[i]) / 0.9)), "fov/2", ink("--ink"));
  }

  looking(target) {
    const { turn, tilt, far } = this.view, c = Math.cos(turn), s = Math.sin(turn), C = Math.cos(tilt), S = Math.sin(tilt);
    const back = [s * C, S, c * C], right = [c, 0, -s];
    return { eye: along(target, far, back), back, right, up: cross(back, right) };
  }

  depth(point) { return -dot(minus(point, this.look.eye), this.look.back); }

  place(point) {
    const q = minus(point, this.look.eye), z = -dot(q, this.look.back), scale = 1.35 * Math.min(this.canvas.width / 1.5, this.canvas.height);
    return z < 0.05 ? null : [this.canvas.width / 2 + scale * dot(q, this.look.right) / z, this.canvas.height / 2 - scale * dot(q, this.look.up) / z, scale / z];
  }

  line(points, color, width, dash = []) {
    const g = this.g;
    g.strokeStyle = color;
    g.lineWidth = width * this.unit;
    g.setLineDash(dash.map((one) => one * this.unit));
    g.beginPath();
    let down = false;
    for (let n = 0; n < points.length; n++) {
      const to = points[n] && this.place(points[n]);
      if (!to) { down = false; continue; }
      if (down) g.lineTo(to[0], to[1]); else g.moveTo(to[0], to[1]);
      down = true;
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
    const [r, gr, b] = sphere.color.map((one) => Math.round(255 * one ** (1 / 2.2))), radius = sphere.radius * to[2];
    const shade = g.createRadialGradient(to[0] - radius / 3, to[1] - radius / 3, radius / 8, to[0], to[1], radius);
    shade.addColorStop(0, `rgb(${Math.min(255, r + 50)},${Math.min(255, gr + 50)},${Math.min(255, b + 50)})`);
    shade.addColorStop(1, `rgb(${Math.round(r * 0.62)},${Math.round(gr * 0.62)},${Math.round(b * 0.62)})`);
    g.fillStyle = shade;
    g.beginPath();
    g.arc(to[0], to[1], radius, 0, 2 * Math.PI);
    g.fill();
  }

  // A label that would lie on one before it is left out.
  label(point, text, color) {
    const to = this.place(point), g = this.g;
    if (!to) return;
    g.font = `600 ${13 * this.unit}px system-ui, sans-serif`;
    g.textAlign = "center";
    g.textBaseline = "middle";
    g.lineWidth = 3 * this.unit;
    g.strokeStyle = getComputedStyle(document.documentElement).getPropertyValue("--space").trim();
    const half = g.measureText(text).width / 2 + g.lineWidth, high = 13 * this.unit;
    const [x, y] = [Math.min(Math.max(to[0], half), g.canvas.width - half), Math.min(Math.max(to[1], high), g.canvas.height - high)];
    if (this.labels.some((one) => Math.abs(one.x - x) < one.half + half && Math.abs(one.y - y) < high)) return;
    this.labels.push({ x, y, half });
    g.strokeText(text, x, y);
    g.fillStyle = color;
    g.fillText(text, x, y);
  }
}
