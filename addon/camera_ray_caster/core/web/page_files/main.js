// The page: what is shown, and what it does when something is turned, dragged or typed.
const $ = (id) => document.getElementById(id);
const SOFTWARE_BUDGET = 33, LEAST_SHARE = 0.2, COARSE = 12; // samples of a lens
const LENS_BUDGET = 1500; // milliseconds of its whole picture
let lensQuality = null; // samples and share of its whole picture, where they do not depend on the machine
let model, state, camera, seen = null, own = null, share = 1, fine = 0, whole = 1, waiting = 0, settling = 0;
const picture = new Picture($("picture")), space = new Space($("space")), glass = new Glass($("glass"), $("glass-text"), $("glass-sines"));

function make(tag, text, settings = {}) {
  const element = document.createElement(tag);
  if (text !== undefined) element.textContent = text;
  for (const [name, value] of Object.entries(settings)) element.setAttribute(name, value);
  return element;
}

function say(text) {
  $("message").textContent = text;
  $("message").hidden = !text;
}

const DEGREES = 180 / Math.PI;
function slider(parent, name, knob, get, set) {
  const angle = knob.unit === "angle", factor = angle ? DEGREES : 1, unit = angle ? "°" : knob.unit ? ` (${knob.unit === "length" ? "m" : knob.unit})` : "";
  const label = make("label", `${knob.label}${angle ? " (°)" : unit}`, { for: `${name}-range`, title: knob.text });
  const range = make("input", undefined, { id: `${name}-range`, type: "range", min: knob.low, max: knob.high, step: knob.whole ? 1 : "any", title: knob.text });
  const number = make("input", undefined, { type: "text", inputmode: "decimal", "aria-label": `${knob.label}, as a number${angle ? ", degrees" : ""}` });
  range.addEventListener("input", () => { set(Number(range.value)); changed(); });
  number.addEventListener("change", () => {
    const value = Number(number.value.replace(/^\s*(-?\d+),(\d+)\s*$/, "$1.$2")) / factor; // a decimal comma, too
    if (number.value.trim() === "" || !Number.isFinite(value) || value < knob.low - 1e-9 || value > knob.high + 1e-9) say(`${knob.label} must be from ${shown(knob.low * factor)} to ${shown(knob.high * factor)}`);
    else { set(value); changed(); }
    refresh();
  });
  const refresh = () => { range.value = get(); range.setAttribute("aria-valuetext", `${shown(get() * factor, 5)}${angle ? " degrees" : ` ${knob.unit}`}`); number.value = shown(get() * factor, 6); };
  parent.append(label, range, number);
  refresh();
  return refresh;
}

function choice(parent, name, label, options, get, set) {
  const select = make("select", undefined, { id: `${name}-choice`, class: "wide" });
  for (const { value, label: text } of options) select.append(make("option", text, { value: String(value) }));
  select.addEventListener("change", () => { set(options[select.selectedIndex].value); changed(); });
  parent.append(make("label", label, { for: `${name}-choice` }), select);
  const refresh = () => { select.selectedIndex = options.findIndex((option) => option.value === get()); };
  refresh();
  return refresh;
}

let refreshers = [];
function build() {
  refreshers = [];
  $("label").textContent = own ? "My camera" : model.label;
  $("description").textContent = own ? "The lines that you wrote" : model.description;
  $("model").value = own ? "OWN" : model.key;
  $("frame").style.aspectRatio = `${model.size[0]} / ${model.size[1]}`;
  $("frame").style.width = `min(100%, ${62 * model.size[0] / model.size[1]}vh)`;
  for (const id of ["pixel", "knobs", "view"]) $(id).replaceChildren();
  ["x", "y"].forEach((name, k) => refreshers.push(slider($("pixel"), name, { label: `Pixel ${name}`, text: k ? "From the bottom edge" : "From the left edge", low: 0, high: model.size[k], unit: "" }, () => state[name], (value) => { state[name] = value; })));
  if (!own) {
    for (const [name, options] of Object.entries(model.options)) refreshers.push(choice($("knobs"), name, model.labels[name], options, () => state.values[name], (value) => { state.values[name] = value; }));
    for (const knob of model.knobs) refreshers.push(slider($("knobs"), knob.name, knob, () => state.values[knob.name], (value) => { state.values[knob.name] = value; }));
    if (model.fixed.length) $("knobs").append(make("p", `Fixed at this camera's values: ${model.fixed.join(", ")}.`, { class: "note" }));
  } else $("knobs").append(make("p", "It has no settings: change its lines below.", { class: "note" }));
  for (const name of ["turn", "tilt", "walk"]) refreshers.push(slider($("view"), name, VIEW[name], () => state[name], (value) => { state[name] = value; }));
  if (SCENE.still) {
    for (const [what, names] of [["With fewer triangles", SCENE.coarser], ["Left out", SCENE.left_out]]) if (names.length) $("view").append(make("p", `${what} in this page: ${names.join(", ")}.`, { class: "note" }));
    return;
  }
  refreshers.push(slider($("view"), "time", VIEW.time, () => state.time, (value) => { state.time = value; }));
  refreshers.push(choice($("view"), "times", "Time of each pixel", TIMES.map((value) => ({ value, label: { none: "All at once", rows: "Row by row (slit scan)", columns: "Column by column (slit scan)", circles: "From the middle out (time displacement)" }[value] })), () => state.times, (value) => { state.times = value; }));
  refreshers.push(slider($("view"), "spread", VIEW.spread, () => state.spread, (value) => { state.spread = value; }));
}

function row(name, ...parts) {
  const value = make("dd");
  parts.forEach((part, k) => value.append(make("span", part), k < parts.length - 1 ? " " : ""));
  $("numbers").append(make("dt", name), value);
}

function numbers() {
  const { x, y } = state, [width, height] = model.size, ray = camera.ray(x, y);
  $("numbers").replaceChildren();
  row("pixel", `x = ${shown(x)}, y = ${shown(y)}`);
  row("in [-1, 1]²", shown([2 * x / width - 1, 2 * y / height - 1].map((coordinate) => Math.round(coordinate * 1e6) / 1e6)));
  if (Number.isNaN(ray[3])) {
    seen = null;
    $("tag").textContent = "no ray";
    row("ray", "none: the camera has no ray for this pixel");
    return;
  }
  const time = timeOf(state, model.size, x, y), at = worldRay(pose(state), ray), hit = cast(at.origin, at.direction, time);
  seen = { ray: at, hit, time };
  row("origin o", shown(ray.slice(0, 3)));
  const length = Math.abs(norm(ray.slice(3)) - 1) < 1e-9 ? ["of unit length"] : ray[5] === -1 ? ["at unit depth"] : [];
  row("direction r", shown(ray.slice(3)), ...length);
  row("from the axis", `${shown(Math.atan2(Math.hypot(ray[3], ray[4]), -ray[5]) * DEGREES)}°`);
  row("meets", hit.index < 0 ? "nothing" : `${hit.name}, at distance t = ${shown(hit.t)}, at ${shown(hit.point)} in the ${SCENE.still ? "scene (x right, y up)" : "room"}`);
  const back = pixelOf(camera, along(ray.slice(0, 3), Math.min(hit.t, 20 * SCENE.scale) / norm(ray.slice(3)), ray.slice(3)));
  row("back to the pixel", back ? `(${shown(back[0])}, ${shown(back[1])}), ${shown(Math.hypot(back[0] - x, back[1] - y), 2)} px off (found from the rays by Gauss–Newton)` : "not found from the rays by Gauss–Newton");
  if (state.times !== "none") row("time of the pixel", `${shown(time)} s`);
  $("tag").replaceChildren(make("b", `r = ${shown(ray.slice(3), 3)}`), make("span", hit.index < 0 ? "meets nothing" : `meets ${hit.name}`));
}

function steps() {
  const list = $("steps");
  list.replaceChildren();
  if (own) {
    const known = { x: state.x, y: state.y, W: model.size[0], H: model.size[1], pi: Math.PI };
    for (const { name, tree, text } of own.made) {
      const value = evaluate(tree, known), item = make("li");
      const set = make("div", undefined, { class: "symbols", title: `${name} = ${text}` });
      set.append(mathEquation(name, tree, `${name} = ${text}`));
      item.append(set, result(name, putIn(text, known), value));
      known[name] = value;
      list.append(item);
    }
    return;
  }
  const { known, own: special, solved } = knownOf(model, state.values, camera, state.x, state.y), results = workedOut(model.steps, known, special);
  model.steps.forEach((step, k) => {
    const item = make("li", step.words), names = solved.filter((name) => named(step.symbols).includes(name));
    const set = make("div", undefined, { class: "symbols", title: step.symbols });
    set.append(...mathOf(step.symbols));
    item.append(set);
    if (names.length) item.append(make("code", `with ${names.map((name) => `${name} = ${shown(known[name])}`).join(", ")}`, { class: "symbols" }));
    item.append(...results[k].map((assigned) => result(assigned.name, assigned.numbers, assigned.value)));
    list.append(item);
  });
}

function result(name, numbers, value) {
  const line = make("code", undefined, { class: "numbers" }), end = shown(value);
  line.append([end, `(${end})`].includes(numbers) ? `${name} = ` : `${name} = ${numbers} = `, make("b", end));
  return line;
}

function cross_() {
  $("cross").style.left = `${100 * state.x / model.size[0]}%`;
  $("cross").style.top = `${100 * (1 - state.y / model.size[1])}%`;
  const tag = $("tag"), { width, height } = $("frame").getBoundingClientRect(), x = state.x / model.size[0] * width, y = (1 - state.y / model.size[1]) * height;
  tag.style.left = `${Math.max(4, Math.min(x - tag.offsetWidth / 2, width - tag.offsetWidth - 4))}px`;
  tag.style.top = `${y > tag.offsetHeight + 40 ? y - tag.offsetHeight - 36 : y + 36}px`; // beside the finger, not below it
}

// The picture is drawn at a share of its size that holds 30 frames a second while something moves, then once in full.
function paint(full) {
  if (!picture.gl) return;
  const began = performance.now();
  const wide = $("picture").getBoundingClientRect().width * (window.devicePixelRatio || 1) / model.size[0];
  const lens = !own && model.glass && glass.moved ? glass : null;
  if (lens && !fine) share = LEAST_SHARE; // the first one
  const drawn = full ? (lens ? whole : 1) : share;
  picture.draw(camera, state, drawn * wide, false, lens, full ? fine : COARSE);
  if (lens) picture.gl.readPixels(0, 0, 1, 1, picture.gl.RGBA, picture.gl.UNSIGNED_BYTE, new Uint8Array(4)); // which waits; finish may not
  else picture.gl.finish();
  const took = performance.now() - began, often = LENS_BUDGET * drawn ** 2 / took;
  if (!lens) fine = 0;
  else if (!full) [fine, whole] = lensQuality ?? [Math.min(Math.max(Math.round(COARSE * often), COARSE), 4 * COARSE), Math.min(1, Math.sqrt(often))];
  if (!full) share = Math.min(1, Math.max(LEAST_SHARE, share * Math.sqrt(Math.min(Math.max(SOFTWARE_BUDGET / Math.max(took, 1), 0.25), 1.5))));
  clearTimeout(settling);
  settling = full ? 0 : setTimeout(() => paint(true), 180);
}

function show() {
  waiting = 0;
  try {
    camera = own ? own.camera : cameraOf(model, state.values);
    numbers();
    steps();
    cross_();
    refreshers.forEach((refresh) => refresh());
    space.draw(camera, state, seen);
    $("glass-card").hidden = Boolean(own) || !model.glass;
    if (!$("glass-card").hidden) { glass.use(model); glass.draw(state.x, state.y); }
    paint(false);
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    say(error.message);
  }
}

function changed() {
  say(""); // not by show, which may come after the message on a later change
  if (!waiting) waiting = requestAnimationFrame(show);
  clearTimeout(changed.link);
  changed.link = setTimeout(() => { history.replaceState(null, "", `#${linkOf(state, model)}`); }, 250);
}

function choose(next) {
  model = MODELS.find((entry) => entry.key === next.model);
  glass.lens = null; // with its own stop and film again
  own = next.own === undefined ? null : readText(next.own);
  if (own) $("own").value = next.own;
  state = next;
  build();
  changed();
}

function openLink(hash) {
  try {
    choose(hash.length > 1 ? stateOf(hash.slice(1), MODELS) : structuredClone(START));
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    choose(structuredClone(START));
    cancelAnimationFrame(waiting);
    clearTimeout(changed.link);
    show();
    say(error.message);
  }
}

function pointAt(event) {
  const box = $("picture").getBoundingClientRect();
  state.x = Math.min(Math.max((event.clientX - box.left) / box.width, 0), 1) * model.size[0];
  state.y = Math.min(Math.max(1 - (event.clientY - box.top) / box.height, 0), 1) * model.size[1];
  changed();
}

function dragging(canvas, begin, move) {
  canvas.addEventListener("pointerdown", (event) => { canvas.setPointerCapture(event.pointerId); canvas.parentElement.dataset.down = "1"; begin(event); });
  canvas.addEventListener("pointermove", (event) => { if (canvas.parentElement.dataset.down) move(event); });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => { delete canvas.parentElement.dataset.down; });
}

function arrows(canvas, apply) {
  canvas.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!step) return;
    event.preventDefault();
    apply(step[0] * (event.shiftKey ? 10 : 1), step[1] * (event.shiftKey ? 10 : 1));
    changed();
  });
}

function turnView(a, b) {
  space.view.turn -= a;
  space.view.tilt = Math.min(Math.max(space.view.tilt + b, -0.2), 1.5607);
  document.querySelectorAll("[data-view]").forEach((button) => button.setAttribute("aria-pressed", "false"));
}

function setTheme(name) {
  document.documentElement.dataset.theme = name;
  if (camera) space.draw(camera, state, seen);
}

function readText(text) {
  const made = readOwn(text), lines = text.split("\n").map((line) => line.trim()).filter(Boolean);
  made.forEach((assignment, k) => { assignment.text = lines[k].slice(lines[k].indexOf("=") + 1).trim(); });
  return { made, camera: ownCamera(made, model.size) };
}

function withOwn(then) {
  return () => {
    try { $("own-error").textContent = ""; then(readText($("own").value)); } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      $("own-error").textContent = error.message;
    }
  };
}

function drawMap(written) {
  const columns = 48, rows = 27, errors = errorMap(written.camera, columns, rows), g = $("map").getContext("2d");
  errors.forEach((error, n) => {
    const share = Math.min(Math.max((Math.log10(Math.max(error, 1e-12)) + 12) / 12, 0), 1);
    g.fillStyle = Number.isNaN(error) ? "#777" : error > 1e-3 ? "#c2410c" : `hsl(${210 - 160 * share} 70% ${34 + 30 * share}%)`;
    g.fillRect(n % columns * 10, (rows - 1 - Math.floor(n / columns)) * 10, 10, 10);
  });
  const rays = errors.filter((error) => !Number.isNaN(error)), lost = rays.filter((error) => error > 1e-3).length, largest = Math.max(...rays.filter((error) => error <= 1e-3), 0);
  $("map-text").textContent = `Pixel to ray to pixel: ${rays.length - lost} of ${rays.length} rays come back, at most ${shown(largest, 2)} pixels off; ${lost} do not (orange); ${errors.length - rays.length} pixels have no ray (gray).`;
  $("map-figure").hidden = false;
}

function save(text) {
  const link = make("a", "", { download: "my_camera.py", href: URL.createObjectURL(new Blob([text], { type: "text/x-python" })) });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

for (const group of [...new Set(MODELS.map((entry) => entry.group))]) {
  const part = make("optgroup", undefined, { label: group });
  MODELS.filter((entry) => entry.group === group).forEach((entry) => part.append(make("option", entry.label, { value: entry.key })));
  $("model").append(part);
}
$("model").append(make("option", "My camera (written below)", { value: "OWN" }));
$("model").addEventListener("change", () => {
  if ($("model").value === "OWN") { $("own-use").click(); return; }
  const { x, y, time, times, spread, turn, tilt, walk } = state, next = freshState(MODELS.find((entry) => entry.key === $("model").value));
  const moved = [x, y].map((coordinate, k) => coordinate / model.size[k] * MODELS.find((m) => m.key === next.model).size[k]);
  choose({ ...next, x: moved[0], y: moved[1], time, times, spread, turn, tilt, walk });
});
for (const figure of SCENE.still ? [] : FIGURES) {
  const button = make("button", figure.label, { type: "button", title: figure.text });
  button.addEventListener("click", () => {
    const fresh = freshState(MODELS.find((entry) => entry.key === figure.model));
    choose({ ...fresh, ...figure.state, values: { ...fresh.values, ...figure.values } });
    space.view = { ...VIEWS[figure.view], ...figure.look };
    document.querySelectorAll("[data-view]").forEach((other) => other.setAttribute("aria-pressed", String(other.dataset.view === figure.view)));
    $("caption").textContent = figure.text;
  });
  $("figures").append(button);
}
document.querySelectorAll("[data-view]").forEach((button) => button.addEventListener("click", () => {
  space.view = { ...VIEWS[button.dataset.view] };
  document.querySelectorAll("[data-view]").forEach((other) => other.setAttribute("aria-pressed", String(other === button)));
  changed();
}));
dragging($("picture"), pointAt, pointAt);
dragging($("space"), () => {}, (event) => { turnView(event.movementX / 160, event.movementY / 160); changed(); });
arrows($("picture"), (a, b) => { state.x = Math.min(Math.max(state.x + a, 0), model.size[0]); state.y = Math.min(Math.max(state.y + b, 0), model.size[1]); });
arrows($("space"), (a, b) => turnView(-a / 20, b / 20));
$("share").addEventListener("click", async () => {
  history.replaceState(null, "", `#${linkOf(state, model)}`);
  try { await navigator.clipboard.writeText(location.href); $("share").textContent = "Copied"; } catch { $("share").textContent = "In the address bar"; }
  setTimeout(() => { $("share").textContent = "Copy link"; }, 1500);
});
$("reset").addEventListener("click", () => { $("caption").textContent = ""; choose(freshState(model)); });
$("theme").addEventListener("click", () => setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark"));
$("own").value = OWN_TEXT;
$("functions").textContent = Object.keys(FUNCTIONS).join(", ");
$("own-use").addEventListener("click", withOwn((written) => {
  if (picture.gl) picture.program(written.camera.glsl, written.camera.numbers.length);
  own = written;
  state.own = $("own").value;
  build();
  changed();
}));
$("own-map").addEventListener("click", withOwn(drawMap));
$("own-python").addEventListener("click", withOwn((written) => save(pythonOf(written.made))));
if (SCENE.still) { $("space-label").textContent = "The ray in the scene"; $("view-title").textContent = "The camera in the scene"; }
$("blank").hidden = Boolean(picture.gl);
// The address may have been written anew, by changed(), since the event: what was asked for is in the event.
window.addEventListener("hashchange", (event) => openLink(new URL(event.newURL).hash));
new ResizeObserver(() => { if (camera) space.draw(camera, state, seen); }).observe($("space"));
setTheme(matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
openLink(location.hash);

// For scripts and tests: the models, and the picture of shape indices and distances of a model.
window.lesson = {
  models: MODELS.map((entry) => entry.key),
  isDrawn: () => !waiting && !settling,
  fixLensQuality: (samples, share) => { lensQuality = [samples, share]; },
  state: () => JSON.parse(JSON.stringify(state)),
  labels: () => space.labels,
  glass: () => ({ ...glass.traced(state.x, state.y), fNumber: glass.fNumber, focus: glass.focus, film: glass.film, radius: glass.radius }),
  ray: () => camera.ray(state.x, state.y),
  cast: (x, y) => { const at = worldRay(pose(state), camera.ray(x, y)); return cast(at.origin, at.direction, state.time); },
  place: (point) => space.place(point),
  indices: (key) => { const next = freshState(MODELS.find((entry) => entry.key === key)); return picture.indices(cameraOf(MODELS.find((entry) => entry.key === key), next.values), next); },
  speed: (key, width) => { const chosen = MODELS.find((entry) => entry.key === key), next = freshState(chosen), made = cameraOf(chosen, next.values); picture.indices(made, next); const began = performance.now(); for (let n = 0; n < 5; n++) picture.draw(made, next, width / chosen.size[0]); const pixel = new Uint8Array(4); picture.gl.readPixels(0, 0, 1, 1, picture.gl.RGBA, picture.gl.UNSIGNED_BYTE, pixel); return (performance.now() - began) / 5; },
};
