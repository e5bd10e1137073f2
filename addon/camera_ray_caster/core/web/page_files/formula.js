// Formulas: numbers, names, + - * / powers, products without a sign, vectors, and the functions below. A formula is
// parsed to a tree, which is evaluated, written as GLSL or written as Python; no text is ever run as JavaScript.
const FUNCTIONS = {
  sin: [1, Math.sin, "sine", "np.sin"], cos: [1, Math.cos, "cosine", "np.cos"], tan: [1, Math.tan, "tangent", "np.tan"],
  asin: [1, Math.asin, "arcSine", "np.arcsin"], acos: [1, Math.acos, "arcCosine", "np.arccos"],
  atan: [1, Math.atan, "arcTangent", "np.arctan"], atan2: [2, Math.atan2, "arcTangent2", "np.arctan2"],
  sqrt: [1, Math.sqrt, "sqrt", "np.sqrt"], abs: [1, Math.abs, "abs", "np.abs"], exp: [1, Math.exp, "exp", "np.exp"],
  log: [1, Math.log, "log", "np.log"], min: [2, Math.min, "min", "np.minimum"], max: [2, Math.max, "max", "np.maximum"],
  floor: [1, Math.floor, "floor", "np.floor"],
};
const DOMAINS = { sqrt: "(A) >= 0.0", asin: "abs(A) <= 1.0", acos: "abs(A) <= 1.0", log: "(A) > 0.0" };
const TOKEN = /\s*(?:(\d+\.?\d*(?:e[+-]?\d+)?)|([A-Za-z_][A-Za-z_0-9]*'?)|([⁰¹²³⁴⁵⁶⁷⁸⁹]+)|(°)|(\.(?=\s)|\*\*|[-+*/(),×]))/y;
const DEEPEST = 40, LONGEST = 400;

class Refusal extends Error {}

function tokens(text) {
  if (text.length > LONGEST) throw new Refusal(`a formula has at most ${LONGEST} letters`);
  const list = [], last = text.trimEnd().length, comma = /\d+,\d+/.exec(text);
  if (comma) throw new Refusal(`write ${comma[0].replace(",", ".")} in place of ${comma[0]}; between two numbers, put a space after the comma`);
  TOKEN.lastIndex = 0;
  while (TOKEN.lastIndex < last) {
    const at = TOKEN.lastIndex, token = TOKEN.exec(text);
    if (!token) {
      const letter = text.slice(at).trim()[0];
      throw new Refusal(`"${letter}" is no part of a formula${letter === "^" ? ": write a power as a**3" : ""}`);
    }
    const [, number, name, power, degrees, sign] = token, end = TOKEN.lastIndex;
    if (number) list.push({ kind: "number", value: Number(number), end });
    else if (name) list.push({ kind: "name", value: name, end });
    else if (power) list.push({ kind: "power", value: Number([...power].map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(c)).join("")), end });
    else if (degrees) list.push({ kind: "degrees", end });
    else list.push({ kind: sign, end });
  }
  return list;
}

// expression: term (+|- term)*; term: factor (*|/|×|.|nothing factor)*; factor: - factor | atom power*;
// atom: number | name | function(...) | (expression, ...)
function parse(text) {
  const list = tokens(text);
  let at = 0, depth = 0;
  const kind = () => (at < list.length ? list[at].kind : "end");
  const expect = (expected) => {
    if (kind() !== expected) throw new Refusal(kind() === "end" ? `"${expected}" is missing at the end` : `"${expected}" is missing before "${list[at].value ?? kind()}"`);
    at++;
  };
  function expression() {
    if (++depth > DEEPEST) throw new Refusal("too many parentheses");
    let left = term();
    while (kind() === "+" || kind() === "-") left = { op: list[at++].kind, of: [left, term()] };
    depth--;
    return left;
  }
  function term() {
    let left = factor();
    for (;;) {
      if (["*", "/", "×", "."].includes(kind())) left = { op: list[at++].kind, of: [left, factor()] };
      else if (["number", "name", "("].includes(kind())) left = { op: "*", of: [left, factor()] };
      else return left;
    }
  }
  function factor() {
    if (++depth > DEEPEST) throw new Refusal("too many signs or parentheses");
    let made;
    if (kind() === "-" || kind() === "+") made = list[at++].kind === "-" ? { op: "negative", of: [factor()] } : factor();
    else made = powers(atom());
    depth--;
    return made;
  }
  function powers(base) {
    for (;;) {
      if (kind() === "power") base = { op: "power", of: [base, { op: "number", value: list[at++].value }] };
      else if (kind() === "**") { at++; base = { op: "power", of: [base, factor()] }; }
      else if (kind() === "degrees") { at++; base = { op: "*", of: [base, { op: "number", value: Math.PI / 180 }], degrees: true }; }
      else return base;
    }
  }
  function several() {
    expect("(");
    const parts = [expression()];
    while (kind() === ",") { at++; parts.push(expression()); }
    expect(")");
    return parts;
  }
  function atom() {
    const token = list[at];
    if (kind() === "number") { at++; return { op: "number", value: token.value }; }
    if (kind() === "name") {
      at++;
      if (!Object.hasOwn(FUNCTIONS, token.value)) return { op: "name", name: token.value, called: kind() === "(" && list[at].end === token.end + 1 };
      if (kind() !== "(") throw new Refusal(`${token.value} needs parentheses`);
      const of = several();
      if (of.length !== FUNCTIONS[token.value][0]) throw new Refusal(`${token.value} takes ${FUNCTIONS[token.value][0]} number(s), not ${of.length}`);
      return { op: "call", name: token.value, of };
    }
    if (kind() === "(") { const of = several(); return of.length === 1 ? of[0] : { op: "vector", of }; }
    throw new Refusal(kind() === "end" ? "the formula ends too early" : `a number or a name is missing before "${kind()}"`);
  }
  const made = expression();
  if (at < list.length) throw new Refusal(`"${list[at].value ?? kind()}" is too much`);
  return made;
}

const isVector = Array.isArray;
const each = (a, b, f) => isVector(a) ? a.map((x, k) => f(x, isVector(b) ? b[k] : b)) : isVector(b) ? b.map((x) => f(a, x)) : f(a, b);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const OPERATIONS = {
  "+": (a, b) => each(a, b, (x, y) => x + y), "-": (a, b) => each(a, b, (x, y) => x - y),
  "*": (a, b) => each(a, b, (x, y) => x * y), "/": (a, b) => each(a, b, (x, y) => x / y),
  "×": cross, ".": dot, negative: (a) => each(a, 0, (x) => -x), power: (a, b) => each(a, b, (x, y) => x ** y),
};

// The value of a tree, a number or three; undefined if a name is not known.
function evaluate(tree, known) {
  if (tree.op === "number") return tree.value;
  if (tree.op === "name") return Object.hasOwn(known, tree.name) ? known[tree.name] : undefined;
  const operands = tree.of.map((part) => evaluate(part, known));
  if (operands.includes(undefined)) return undefined;
  if (tree.op === "vector") return operands.some(isVector) ? undefined : operands;
  if (tree.op === "call") return operands.some(isVector) ? undefined : FUNCTIONS[tree.name][1](...operands);
  if ((tree.op === "×" || tree.op === ".") && !operands.every((operand) => isVector(operand) && operand.length === 3)) return undefined;
  return OPERATIONS[tree.op](...operands);
}

// "a = 1, b = (2, 3)" as pairs of a name and an expression.
const ASSIGNED = /^([A-Za-z_][A-Za-z_0-9]*'?) = (.*)$/;
const assignments = (symbols) => splitAssignments(symbols).map((part) => ASSIGNED.exec(part)).filter(Boolean).map((match) => [match[1], match[2]]);

function splitAssignments(symbols) {
  let depth = 0;
  const parts = [""];
  for (const letter of symbols) {
    depth += (letter === "(") - (letter === ")");
    if ((letter === "," || letter === ";") && depth === 0) parts.push("");
    else parts[parts.length - 1] += letter;
  }
  return parts.map((part) => part.trim());
}

// A number below this is the rounding of 0: lengths, angles and pixels are of the order of 1.
const ROUNDING = 1e-12;

function shown(value, digits = 6) {
  if (isVector(value)) {
    const least = 5e-7 * Math.min(Math.max(...value.map(Math.abs)), 1);
    return `(${value.map((part) => shown(Math.abs(part) < least ? 0 : part, digits)).join(", ")})`;
  }
  if (typeof value !== "number" || Number.isNaN(value)) return "none";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "-∞";
  if (Math.abs(value) < ROUNDING) return "0";
  return String(Number(value.toPrecision(digits)));
}

const named = (text) => text.match(/[A-Za-z_][A-Za-z_0-9]*'?/g) || [];

// An expression with numbers in place of the names that are known.
function putIn(expression, known) {
  return expression.replace(/[A-Za-z_][A-Za-z_0-9]*'?/g, (name) => {
    if (!Object.hasOwn(known, name) || isVector(known[name])) return name;
    const text = shown(known[name]);
    return text.startsWith("-") ? `(${text})` : text;
  }).replace(/([\w)⁰¹²³⁴⁵⁶⁷⁸⁹°'])\s+(?=[\w(])/g, "$1 · ").replace(/\(\((-[^()]*)\)\)/g, "($1)");
}

// For each step of a formula, its assignments with numbers: [{ name, text, result, value }].
function workedOut(steps, known, own) {
  const parts = steps.flatMap((step, k) => assignments(step.symbols).map(([name, text]) => ({ k, name, text })));
  const assigned = new Set(parts.map((part) => part.name));
  known = Object.fromEntries(Object.entries(known).filter(([name]) => !assigned.has(name)));
  for (let before = -1, count = 0; before < count;) {
    before = count;
    count = 0;
    for (const part of parts) {
      if (part.value === undefined) {
        const here = { ...known, ...own[part.k] };
        let value;
        try { value = evaluate(parse(part.text), here); } catch (error) { if (!(error instanceof Refusal)) throw error; }
        if (value !== undefined) {
          part.value = value;
          part.numbers = putIn(part.text, here);
          known[part.name] = value;
          if (isVector(value)) value.forEach((number, k) => { known[`${part.name}_${"xyz"[k]}`] = number; });
        }
      }
      count += part.value !== undefined;
    }
  }
  return steps.map((_, k) => parts.filter((part) => part.k === k && part.value !== undefined));
}
