// The state: the model, its settings, the pixel, the time and the camera's place; kept in the link after "#".
const VERSION = 1, LONGEST_LINK = 40000;
const VIEW = {
  turn: { label: "Turn", text: "Turn of the camera about the vertical", low: -Math.PI, high: Math.PI, value: 0, unit: "angle" },
  tilt: { label: "Tilt", text: "Tilt of the camera up or down", low: -1.5, high: 1.5, value: 0, unit: "angle" },
  walk: { label: "Walk", text: "Distance of the camera from the middle of the room", low: -3, high: 3.8, value: 3, unit: "length" },
  time: { label: "Time", text: "Time of the scene: the balls turn once from 0 to 1 s", low: 0, high: 1, value: 0, unit: "s" },
  spread: { label: "Time over the picture", text: "Difference of the times of the picture's ends", low: -1, high: 1, value: 0.5, unit: "s" },
};

if (SCENE.still) Object.assign(VIEW.walk, { text: "Distance of the camera behind its place", low: -4 * SCENE.scale, high: 4 * SCENE.scale, value: 0 });

function freshState(model) {
  const values = Object.fromEntries([...model.knobs.map((knob) => [knob.name, knob.value]), ...Object.entries(model.choices)]);
  const view = Object.fromEntries(Object.entries(VIEW).map(([name, knob]) => [name, knob.value]));
  return { model: model.key, values, x: 0.7 * model.size[0], y: 0.55 * model.size[1], times: "none", ...view };
}

function linkOf(state, model) {
  const words = new URLSearchParams({ v: VERSION, model: model.key });
  const fresh = freshState(model);
  for (const [name, value] of Object.entries(state.values)) if (value !== fresh.values[name]) words.set(name, String(value));
  for (const name of ["x", "y", "times", ...Object.keys(VIEW)]) if (state[name] !== fresh[name]) words.set(name, typeof state[name] === "number" ? String(Number(state[name].toPrecision(8))) : state[name]);
  if (state.own !== undefined) words.set("own", state.own);
  return words.toString();
}

// The state of a link; a Refusal says in a line what is wrong with it.
function stateOf(link, models) {
  if (link.length > LONGEST_LINK) throw new Refusal(`the link is too long (${link.length} letters): it is no link of this page`);
  const words = new URLSearchParams(link), brief = (text) => JSON.stringify(text.slice(0, 24));
  if (words.get("v") !== String(VERSION)) throw new Refusal(`the link is of version ${brief(words.get("v") ?? "")}, this page reads version ${VERSION}`);
  const key = words.get("model") ?? "", model = models.find((entry) => entry.key === key);
  if (!model) throw new Refusal(`the link names a camera that this page does not have: ${brief(key)}`);
  const state = freshState(model), knobs = Object.fromEntries(model.knobs.map((knob) => [knob.name, knob]));
  const number = (name, text, low, high) => {
    const value = text.trim() === "" ? NaN : Number(text);
    if (!Number.isFinite(value)) throw new Refusal(`the link's ${name} is ${brief(text)}: it must be a number`);
    if (value < low - 1e-9 || value > high + 1e-9) throw new Refusal(`the link's ${name} is ${brief(text)}: it must be from ${shown(low)} to ${shown(high)}`);
    return value;
  };
  for (const [name, text] of words) {
    if (name === "v" || name === "model") continue;
    if (name === "own") { state.own = text; continue; }
    if (Object.hasOwn(knobs, name)) state.values[name] = number(name, text, knobs[name].low, knobs[name].high);
    else if (Object.hasOwn(model.options, name)) {
      const option = model.options[name].find((choice) => String(choice.value) === text);
      if (!option) throw new Refusal(`the link's ${name} is ${brief(text)}: it must be one of ${model.options[name].map((choice) => choice.value).join(", ")}`);
      state.values[name] = option.value;
    } else if (name === "x" || name === "y") state[name] = number(name, text, 0, model.size[name === "x" ? 0 : 1]);
    else if (Object.hasOwn(VIEW, name)) state[name] = number(name, text, VIEW[name].low, VIEW[name].high);
    else if (name === "times" && TIMES.includes(text)) state.times = text;
    else throw new Refusal(`the link has ${brief(name)}, which this camera does not have`);
  }
  return state;
}

// A camera with the numbers of a state: its rays, and what the shader needs. A Refusal if its settings give none.
function cameraOf(model, values) {
  const variant = model.variants.find((candidate) => Object.entries(candidate.choices).every(([name, value]) => values[name] === value) && PREPARE[candidate.prepare](values) !== null);
  if (!variant) throw new Refusal("no camera has these settings: they lie outside of what the model allows");
  const numbers = PREPARE[variant.prepare](values);
  return {
    key: model.key, size: model.size, central: model.central, planar: model.planar, numbers, glsl: GLSL[variant.glsl],
    ray: (x, y) => RAYS[variant.rays](numbers, x, y),
    values: (x, y) => {
      const list = VALUES[variant.values](numbers, x, y), byName = {};
      let at = 0;
      for (const [name, count] of variant.names) { byName[name] = count === 1 ? list[at] : list.slice(at, at + count); at += count; }
      return byName;
    },
  };
}

// The values of the names in a formula's steps, as the lesson of the add-on knows them.
function knownOf(model, values, camera, x, y) {
  const known = { u: [1, 0, 0], v: [0, 1, 0], w: [0, 0, -1], e: [0, 0, 0], eye: [0, 0, 0] };
  const numbers = Object.entries({ ...model.constants, ...values }).filter(([, value]) => typeof value === "number");
  for (const [name, value] of [...numbers].reverse()) {
    const parts = name.split("_");
    for (let start = 1; start < parts.length; start++) known[parts.slice(start).join("_")] = value;
  }
  const atPixel = camera.values(x, y), view = { x: atPixel.view_x, y: atPixel.view_y };
  delete atPixel.view_x;
  delete atPixel.view_y;
  const finite = Object.entries(atPixel).filter(([, value]) => [value].flat().every(Number.isFinite));
  Object.assign(known, Object.fromEntries(numbers), { pi: Math.PI, W: model.size[0], H: model.size[1], x, y, p: 1 }, Object.fromEntries(finite));
  const solved = finite.filter(([name, value]) => Array.isArray(value) || name === "theta").map(([name]) => name);
  return { known, solved, own: model.steps.map((step) => step.words.includes("[-1, 1]²") && view.x !== undefined ? view : {}) };
}

// The pixel whose ray comes nearest to a point in the camera's frame, by Gauss and Newton from the best of a grid.
function pixelOf(camera, point) {
  const [width, height] = camera.size;
  const off = (x, y) => {
    const ray = camera.ray(x, y), d = ray.slice(3), q = minus(point, ray.slice(0, 3)), length = norm(d);
    if (Number.isNaN(length) || dot(q, d) <= 0) return null;
    return scaled(cross(q, d), 1 / (length * norm(q)));
  };
  let best = { angle: Infinity };
  for (let i = 0; i < 16; i++) for (let j = 0; j < 12; j++) {
    const x = (i + 0.5) / 16 * width, y = (j + 0.5) / 12 * height, offset = off(x, y);
    if (offset && norm(offset) < best.angle) best = { angle: norm(offset), x, y, offset };
  }
  for (let step = 0; step < 40 && best.angle < Infinity; step++) {
    const h = 1e-4, a = off(best.x + h, best.y), b = off(best.x - h, best.y), c = off(best.x, best.y + h), e = off(best.x, best.y - h);
    if (!a || !b || !c || !e) break;
    const p = scaled(minus(a, b), 0.5 / h), q = scaled(minus(c, e), 0.5 / h), pp = dot(p, p), pq = dot(p, q), qq = dot(q, q), det = pp * qq - pq * pq;
    if (!(det > 0)) break;
    const f = dot(p, best.offset), g = dot(q, best.offset), dx = -(qq * f - pq * g) / det, dy = -(pp * g - pq * f) / det;
    let better = false;
    for (let share = 1; share > 1e-4 && !better; share /= 2) {
      const x = Math.min(Math.max(best.x + share * dx, -1), width + 1), y = Math.min(Math.max(best.y + share * dy, -1), height + 1), offset = off(x, y);
      if (offset && norm(offset) < best.angle) { best = { angle: norm(offset), x, y, offset }; better = true; }
    }
    if (!better) break;
  }
  return best.angle < 1e-6 ? [best.x, best.y] : null;
}
