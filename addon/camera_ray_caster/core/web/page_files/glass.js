// A real lens in its section: the pixel's rays are traced through each surface; the stop and the film can be dragged.
const STEPS_TO_AIM = 40, FAN = [-0.95, -0.7, -0.45, -0.2, 0.2, 0.45, 0.7, 0.95], NEAR = 14, WIDE = 1.3; // WIDE: radius of the disc in the exit pupil over that of the stop's image

// z, curvature, conic, asphere, rim and the indices before and behind are named as in the add-on; s is the height.
function sagOf(surface, squared) {
  const root = Math.sqrt(1 - (1 + surface.conic) * surface.curvature ** 2 * squared);
  let z = surface.curvature * squared / (1 + root), slope = surface.curvature / (2 * root);
  for (const [power, value] of surface.asphere) { z += value * squared ** (power / 2); slope += value * power / 2 * squared ** (power / 2 - 1); }
  return [z, slope];
}

// A ray [z, s, dz, ds] at a surface, refracted; side is 1 towards the film, -1 towards the scene. With the angles' sines.
function refract(surface, [z, s, dz, ds], side) {
  let along = (surface.z - z) / dz, height = 0;
  s += along * ds;
  const c = surface.curvature, f = c * s * s, g = dz - c * s * ds;
  along = f / (g + side * Math.sqrt(g * g - c * f * (1 + surface.conic * dz * dz)));
  s += along * ds;
  height = along * dz;
  for (let step = 0; step < 5 && surface.asphere.length; step++) {
    const [sag, slope] = sagOf(surface, s * s);
    along = (sag - height) / (dz - 2 * slope * s * ds);
    s += along * ds;
    height += along * dz;
  }
  const slope = sagOf(surface, s * s)[1], size = side / Math.hypot(1, 2 * slope * s), nz = size, ns = -2 * slope * s * size;
  const [from, to] = side > 0 ? [surface.before, surface.behind] : [surface.behind, surface.before], ratio = from / to;
  const cosine = dz * nz + ds * ns, push = Math.sqrt(1 - ratio * ratio * (1 - cosine * cosine)) - ratio * cosine;
  const ray = [surface.z + height, s, ratio * dz + push * nz, ratio * ds + push * ns];
  return { ray, sines: [ray[2] * ns - ray[3] * nz, dz * ns - ds * nz].map(Math.abs) };
}

class Glass {
  constructor(canvas, text, list) {
    Object.assign(this, { canvas, text, list, lens: null, held: "", moved: false });
    dragging(canvas, (event) => this.hold(event), (event) => this.move(event));
    arrows(canvas, (across, up) => this.set(this.film + across * 0.05, this.radius * (1 + 0.02 * up)));
  }

  // The lens of a model; its own stop and film when it is chosen.
  use(model) {
    if (this.lens === model.glass) return;
    this.lens = model.glass;
    if (this.lens) this.set(this.lens.film, this.lens.radius);
    this.moved = false;
  }

  set(film, radius) {
    this.moved = true;
    const { surfaces, stop } = this.lens, rear = surfaces[surfaces.length - 1].z, length = this.lens.film - rear;
    this.film = Math.min(Math.max(film, rear + 0.6 * length), rear + 1.6 * length);
    this.radius = Math.min(Math.max(radius, 0.02 * surfaces[stop].rim), surfaces[stop].rim);
  }

  // The path from the film's point at height s to a height in the stop: points, sines, whether a rim is in the way, and
  // the height in the exit pupil.
  path(s, wanted) {
    const { surfaces, stop, exit } = this.lens;
    const from = (aim) => { const z = exit - this.film, side = z < 0 ? 1 : -1, size = Math.hypot(z, aim - s); return [this.film, s, side * z / size, side * (aim - s) / size]; };
    const atStop = (aim) => { let ray = from(aim); for (let k = surfaces.length - 1; k >= stop; k--) ray = refract(surfaces[k], ray, -1).ray; return ray[1] - wanted; };
    let before = 0, aim = 0.01 * this.radius, off = atStop(before);
    for (let step = 0; step < STEPS_TO_AIM && Math.abs(aim - before) > 1e-13; step++) {
      const now = atStop(aim), next = aim - now * (aim - before) / (now - off);
      if (!Number.isFinite(next)) break;
      [before, off, aim] = [aim, now, next];
    }
    let ray = from(aim), stopped = false;
    const points = [[this.film, s]], sines = [];
    for (let k = surfaces.length - 1; k >= 0 && !stopped; k--) {
      const refracted = refract(surfaces[k], ray, -1);
      ray = refracted.ray;
      if (!ray.every(Number.isFinite)) return { points, sines, aim, stopped: true };
      points.push(ray.slice(0, 2));
      if (surfaces[k].before !== surfaces[k].behind) sines.unshift([k, ...refracted.sines]);
      stopped = Math.abs(ray[1]) > (k === stop ? this.radius : surfaces[k].rim ?? Infinity) * (1 + 1e-9);
    }
    return { points, sines, stopped, aim, direction: ray.slice(2) };
  }

  // What the pixel's rays are: s is negative, since the picture is upside down on the film.
  traced(x, y) {
    const { pitch, center } = this.lens, s = -Math.hypot((x - center[0]) * pitch[0], (y - center[1]) * pitch[1]);
    return { s, chief: this.path(s, 0), fan: FAN.map((share) => this.path(s, share * this.radius)) };
  }

  // The program of the picture with the whole stop, and what it reads; the disc holds all rays that pass.
  get program() {
    const { surfaces } = this.lens, bends = surfaces.reduce((count, surface) => count + surface.asphere.length, 0);
    return OF_GLASS.replace(/\b(SURFACES|BENDS)\b/g, (name) => ({ SURFACES: surfaces.length, BENDS: bends }[name]));
  }

  get uniforms() {
    const { surfaces, stop, exit, pupil, unit, pitch, center } = this.lens, bends = surfaces.map((surface) => surface.asphere);
    const start = bends.map((_, k) => bends.slice(0, k).flat().length), rim = (surface, k) => k === stop ? this.radius : surface.rim ?? 1e6;
    const wide = WIDE * Math.abs(this.path(0, this.radius).aim), reach = Math.hypot(center[0] * pitch[0], center[1] * pitch[1]) * 1.5;
    const crossings = []; // of chief rays in the exit pupil, over the radius on the film
    for (let k = 1; k <= 17; k++) {
      const r = reach * (k - 1 || 0.01) / 16, { aim } = this.path(r, 0);
      crossings.push(Number.isFinite(aim) ? aim / r : crossings[k - 2] ?? 0);
    }
    return {
      shapes: ["4fv", surfaces.flatMap((surface, k) => [surface.z, surface.curvature, surface.conic, rim(surface, k)])],
      media: ["4fv", surfaces.flatMap((surface, k) => [surface.before, surface.behind, start[k], surface.asphere.length])],
      bends: ["2fv", [...bends.flat(2), 0, 0]], pitch: ["2fv", pitch], center: ["2fv", center],
      lens: ["4f", this.film, exit, pupil, WIDE ** 2], disc: ["1f", wide], unit: ["1f", unit], reach: ["1f", reach], crossings: ["1fv", crossings],
    };
  }

  get fNumber() { return this.lens.focal / (2 * this.radius * Math.abs(this.lens.magnification)); }

  // Distance from the front surface of what the film has in focus, paraxial, in mm; infinite or negative if nothing.
  get focus() {
    const { matrix: [[a, b], [c, d]], surfaces } = this.lens, rear = surfaces[surfaces.length - 1], away = this.film - rear.z;
    return -(rear.behind * b + away * d) / (rear.behind * a + away * c);
  }

  at(z, s) { return [this.canvas.width / 2 + (z - this.middle) * this.scale, this.canvas.height / 2 - s * this.scale]; }

  draw(x, y) {
    const { surfaces, stop, wide } = this.lens, canvas = this.canvas, ratio = window.devicePixelRatio || 1, box = canvas.getBoundingClientRect();
    canvas.width = Math.max(2, Math.round(box.width * ratio));
    canvas.height = Math.max(2, Math.round(box.height * ratio));
    const g = canvas.getContext("2d"), style = getComputedStyle(document.documentElement), ink = (name) => style.getPropertyValue(name).trim();
    const { s, chief, fan } = this.traced(x, y), last = Math.max(this.film, this.lens.film), length = last - surfaces[0].z, front = surfaces[0].z - 0.35 * length;
    this.middle = (front + last) / 2;
    this.scale = 0.92 * Math.min(canvas.width / (last - front), canvas.height / 2 / Math.max(wide, Math.abs(s)));
    g.fillStyle = ink("--space");
    g.fillRect(0, 0, canvas.width, canvas.height);
    const line = (points, color, width) => { g.strokeStyle = color; g.lineWidth = width * ratio; g.beginPath(); points.forEach(([z, t], k) => g[k ? "lineTo" : "moveTo"](...this.at(z, t))); g.stroke(); };
    line([[front, 0], [last, 0]], ink("--faint"), 1);
    let edge = null;
    for (const surface of surfaces.filter((other) => other.before !== other.behind)) {
      const rim = surface.rim ?? Math.min(wide, surface.curvature ? 0.9 / Math.abs(surface.curvature) : wide), arc = [];
      for (let k = -16; k <= 16; k++) arc.push([surface.z + sagOf(surface, (rim * k / 16) ** 2)[0], rim * k / 16]);
      line(arc, ink("--image"), 1.6);
      if (edge) for (const k of [0, 32]) line([edge[k], arc[k]], ink("--image"), 1.6);
      edge = surface.behind === 1 ? null : arc;
    }
    for (const side of [-1, 1]) line([[surfaces[stop].z, side * this.radius], [surfaces[stop].z, side * Math.max(wide, 1.2 * this.radius)]], ink("--ink"), 4);
    line([[this.film, -wide], [this.film, wide]], ink("--ink"), 4);
    for (const path of [...fan, chief]) {
      const end = path.points[path.points.length - 1], points = [...path.points];
      if (!path.stopped && path.direction[0] < 0) points.push([front, end[1] + (front - end[0]) / path.direction[0] * path.direction[1]]);
      line(points, ink(path.stopped ? "--bad" : "--ray"), path === chief ? 2.4 : 0.9);
    }
    this.tell(chief);
  }

  tell(chief) {
    const away = this.focus, focus = away > 0 && away < 1e7 ? `paraxial focus ${shown(away / 1000, 4)} m before the front surface` : away > 0 || Math.abs(away) >= 1e7 ? "paraxial focus at the horizon" : "no paraxial focus before the lens";
    this.text.textContent = `f/${shown(this.fNumber, 3)}, film ${shown(this.film - this.lens.surfaces[this.lens.surfaces.length - 1].z, 5)} mm behind the glass: ${focus}.${chief.stopped ? " A rim stops the chief ray." : ""}`;
    this.list.replaceChildren(...chief.sines.map(([k, before, behind]) => {
      const surface = this.lens.surfaces[k], sine = (index, value) => `${shown(index)} sin ${shown(Math.asin(Math.min(value, 1)) * DEGREES, 5)}°`;
      return make("li", `Surface ${k + 1}: ${sine(surface.before, before)} = ${sine(surface.behind, behind)}`);
    }));
  }

  place(event) {
    const box = this.canvas.getBoundingClientRect(), ratio = this.canvas.width / box.width;
    const x = (event.clientX - box.left) * ratio, y = (event.clientY - box.top) * ratio;
    return [(x - this.canvas.width / 2) / this.scale + this.middle, (this.canvas.height / 2 - y) / this.scale];
  }

  // The stop if the pointer is near it, else the film.
  hold(event) {
    const [z] = this.place(event), near = NEAR * (window.devicePixelRatio || 1) / this.scale;
    this.held = Math.abs(z - this.lens.surfaces[this.lens.stop].z) <= near ? "stop" : "film";
    if (this.held === "film") this.off = this.film - z;
  }

  move(event) {
    const [z, s] = this.place(event);
    if (this.held === "stop") this.set(this.film, Math.abs(s));
    else this.set(z + this.off, this.radius);
    changed();
  }
}
