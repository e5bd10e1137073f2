// A camera of one's own: six lines of assignments, the last of which give the ray's direction d and, if it has one, its
// origin o. From the parsed lines come the numbers, the shader and the file for Python.
const OWN_LINES = 12, GIVEN = ["x", "y", "W", "H", "pi"];
const OWN_TEXT = "a = (2 x - W) / H\nb = (2 y - H) / H\nr = max(sqrt(a² + b²), 0.000001)\ntheta = r pi / 2\no = (0, 0, 0)\nd = (a sin(theta) / r, b sin(theta) / r, -cos(theta))";
const TAKEN = new Set(["and", "as", "assert", "async", "await", "break", "class", "continue", "def", "del", "elif", "else", "except", "finally", "for", "from", "global", "if", "import", "in", "is", "lambda", "nonlocal", "not", "or", "pass", "raise", "return", "try", "while", "with", "yield"]);

function readOwn(text) {
  if (text.length > 4000) throw new Refusal("the text is too long for six lines of a formula");
  const lines = text.split("\n").map((line) => line.trim()).filter(Boolean);
  if (!lines.length || lines.length > OWN_LINES) throw new Refusal(`give one to ${OWN_LINES} lines`);
  const kinds = { x: 1, y: 1, W: 1, H: 1, pi: 1 }, made = [];
  lines.forEach((line, k) => {
    const match = /^([A-Za-z][A-Za-z0-9_]{0,19})\s*=\s*(.+)$/.exec(line);
    try {
      if (!match) throw new Refusal("write: name = formula");
      const [, name, formula] = match;
      if (GIVEN.includes(name) || Object.hasOwn(FUNCTIONS, name) || TAKEN.has(name)) throw new Refusal(`${name} is taken: choose another name`);
      const tree = parse(formula);
      const count = kindOf(tree, kinds);
      kinds[name] = count;
      made.push({ name, tree, count });
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      throw new Refusal(`line ${k + 1}: ${error.message}`);
    }
  });
  if (kinds.d !== 3) throw new Refusal("the last line must be the direction, of three numbers: d = (…, …, …)");
  if ("o" in kinds && kinds.o !== 3) throw new Refusal("the origin must have three numbers: o = (…, …, …)");
  return made;
}

// 1 for a number, 3 for a vector.
function kindOf(tree, kinds) {
  if (tree.op === "number") return 1;
  if (tree.op === "name") {
    const known = tree.called ? ["the functions", FUNCTIONS] : ["there", kinds];
    if (!Object.hasOwn(kinds, tree.name)) throw new Refusal(`${tree.name.slice(0, 20)} is not known: ${known[0]} are ${Object.keys(known[1]).join(", ")}`);
    return kinds[tree.name];
  }
  const operands = tree.of.map((part) => kindOf(part, kinds));
  if (tree.op === "vector") {
    if (operands.length !== 3 || operands.includes(3)) throw new Refusal("a vector has three numbers");
    return 3;
  }
  if (tree.op === "call" || tree.op === "power") { if (operands.includes(3)) throw new Refusal(`${tree.name ?? "a power"} takes numbers, not a vector`); return 1; }
  if (tree.op === "×" || tree.op === ".") { if (operands.includes(1)) throw new Refusal(`"${tree.op}" is between two vectors`); return tree.op === "." ? 1 : 3; }
  return Math.max(...operands);
}

function glslOf(made) {
  const lines = [];
  let count = 0;
  const put = (kind, text) => { const name = `t${count++}`; lines.push(`  ${kind === 3 ? "vec3" : "float"} ${name} = ${text};`); return [kind, name]; };
  const number = (value) => { const text = Math.min(Math.max(value, -3e38), 3e38).toPrecision(9); return /[.e]/.test(text) ? text : `${text}.0`; };
  const names = { x: [1, "x"], y: [1, "y"], W: [1, "frame_size.x"], H: [1, "frame_size.y"], pi: [1, "3.14159265"] };
  const write = (tree) => {
    if (tree.op === "number") return [1, number(tree.value)];
    if (tree.op === "name") return names[tree.name];
    const operands = tree.of.map(write), [first, second] = operands.map((operand) => operand[1]), kind = Math.max(...operands.map((operand) => operand[0]));
    if (tree.op === "call") {
      if (DOMAINS[tree.name]) lines.push(`  ok = ok && ${DOMAINS[tree.name].replace("A", first)};`);
      return put(1, `${FUNCTIONS[tree.name][2]}(${operands.map((operand) => operand[1]).join(", ")})`);
    }
    if (tree.op === "vector") return put(3, `vec3(${operands.map((operand) => operand[1]).join(", ")})`);
    if (tree.op === "power") { const n = tree.of[1].op === "number" ? tree.of[1].value : NaN; return put(1, n === 2 ? `${first} * ${first}` : `power(${first}, ${second})`); }
    if (tree.op === "negative") return put(kind, `-${first}`);
    if (tree.op === "×") return put(3, `cross(${first}, ${second})`);
    if (tree.op === ".") return put(1, `dot(${first}, ${second})`);
    if (tree.op === "/") lines.push(`  ok = ok && ${operands[1][0] === 3 ? `all(notEqual(${second}, vec3(0.0)))` : `${second} != 0.0`};`);
    const wide = (operand) => (kind === 3 && operand[0] === 1 ? `vec3(${operand[1]})` : operand[1]);
    return put(kind, `${wide(operands[0])} ${tree.op} ${wide(operands[1])}`);
  };
  for (const { name, tree, count: kind } of made) names[name] = put(kind, write(tree)[1]);
  const origin = names.o ? names.o[1] : "vec3(0.0)";
  return `bool ray(float x, float y, out vec3 o, out vec3 d) {\n  vec2 frame_size = vec2(k[0], k[1]);\n  bool ok = true;\n${lines.join("\n")}\n  o = ${origin};\n  d = ${names.d[1]};\n  return ok && dot(d, d) > 0.0;\n}`;
}

function ownCamera(made, size) {
  const numbers = size.map(Number);
  const known = (x, y) => {
    const names = { x, y, W: size[0], H: size[1], pi: Math.PI };
    for (const { name, tree } of made) names[name] = evaluate(tree, names);
    return names;
  };
  return {
    key: "OWN", size, central: !made.some((line) => line.name === "o" && line.tree.of?.some((part) => part.value !== 0)), planar: false, numbers, glsl: glslOf(made),
    ray: (x, y) => { const { o = [0, 0, 0], d } = known(x, y); return norm(d) > 0 && d.every(Number.isFinite) ? [...o, ...scaled(d, 1 / norm(d))] : [0, 0, 0, NaN, NaN, NaN]; },
    values: () => ({}),
  };
}

function pythonOf(made) {
  const write = (tree) => {
    if (tree.op === "number") return Number.isInteger(tree.value) ? `${tree.value}.0` : String(tree.value);
    if (tree.op === "name") return { x: "x", y: "y", W: "width", H: "height", pi: "np.pi" }[tree.name] ?? `own_${tree.name}`;
    const operands = tree.of.map(write);
    if (tree.op === "call") return `${FUNCTIONS[tree.name][3]}(${operands.join(", ")})`;
    if (tree.op === "vector") return `vector(${operands.join(", ")})`;
    if (tree.op === "negative") return `(-${operands[0]})`;
    if (tree.op === "×") return `cross(${operands.join(", ")})`;
    if (tree.op === ".") return `dot(${operands.join(", ")})`;
    return `(${operands[0]} ${tree.op === "power" ? "**" : tree.op} ${operands[1]})`;
  };
  const lines = made.map(({ name, tree }) => `        own_${name} = ${write(tree)}`);
  const origin = made.some((line) => line.name === "o") ? "own_o" : "vector(0.0, 0.0, 0.0)";
  return `"""A camera of one's own: import this file, then crc.camera("MY_CAMERA", (640, 360))."""

from dataclasses import dataclass

import camera_ray_caster as crc
import numpy as np


class vector(tuple):
    """Three numbers, each with the operations of one; numpy's arrays leave these to it."""

    __array_ufunc__ = None

    def __new__(cls, *parts):
        return super().__new__(cls, parts)

    def _with(self, other, apply):
        others = other if isinstance(other, vector) else (other,) * 3
        return vector(*(apply(a, b) for a, b in zip(self, others)))

    __add__ = __radd__ = lambda self, other: self._with(other, lambda a, b: a + b)
    __mul__ = __rmul__ = lambda self, other: self._with(other, lambda a, b: a * b)
    __sub__ = lambda self, other: self._with(other, lambda a, b: a - b)
    __rsub__ = lambda self, other: self._with(other, lambda a, b: b - a)
    __truediv__ = lambda self, other: self._with(other, lambda a, b: a / b)
    __rtruediv__ = lambda self, other: self._with(other, lambda a, b: b / a)
    __neg__ = lambda self: vector(*(-a for a in self))


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return vector(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@dataclass(frozen=True)
class MyCamera(crc.Model):
    """The formula of the page, line by line."""

    key, label, group = "MY_CAMERA", "My Camera", "Multiperspective"
    description = "A camera written on the page of the lesson"
    central = ${made.some((line) => line.name === "o") ? "False" : "True"}
    FORMULA = (crc.Step("Lines of the page", ${JSON.stringify(made.map((line) => line.name).join(", "))}),)

    def rays(self, x, y):
        width, height = self.size
${lines.join("\n")}
        length = np.sqrt(dot(own_d, own_d))
        return tuple(${origin}), tuple(own_d / np.where(length > 0.0, length, np.nan))


crc.register_model(MyCamera)
`;
}

// For each cell of a grid, how far the inverse of a ray's point lies from its pixel, in pixels; NaN without a ray.
function errorMap(camera, columns, rows) {
  return Array.from({ length: columns * rows }, (_, n) => {
    const x = (n % columns + 0.5) / columns * camera.size[0], y = (Math.floor(n / columns) + 0.5) / rows * camera.size[1], ray = camera.ray(x, y);
    if (Number.isNaN(ray[3])) return NaN;
    const back = pixelOf(camera, along(ray.slice(0, 3), 4, ray.slice(3)));
    return back ? Math.hypot(back[0] - x, back[1] - y) : Infinity;
  });
}
