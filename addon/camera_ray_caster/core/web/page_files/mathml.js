// Formulas set as mathematics: MathML of the trees that parse() gives.
const GREEK = { alpha: "α", beta: "β", gamma: "γ", delta: "δ", theta: "θ", lambda: "λ", phi: "φ", psi: "ψ", pi: "π", rho: "ρ", xi: "ξ", omega: "ω", sigma: "σ", mu: "μ", eta: "η", tau: "τ" };
const BINDS = { "+": 1, "-": 1, negative: 1, "*": 2, "×": 2, ".": 2, "/": 4, power: 3 };
const SIGNS = { "×": "×", ".": "⋅", "-": "−", "+": "+" };

function mathElement(tag, ...parts) {
  const made = document.createElementNS("http://www.w3.org/1998/Math/MathML", tag);
  made.append(...parts);
  return made;
}

function mathName(name) {
  const [first, ...subscripts] = name.replace(/'/g, "").replace(/^([A-Za-z]+)(\d+)$/, "$1_$2").split("_"), mark = name.endsWith("'") ? "′" : "";
  const base = mathElement("mi", (GREEK[first] ?? first) + (subscripts.length ? "" : mark));
  return subscripts.length ? mathElement("msub", base, mathElement("mi", subscripts.map((subscript) => GREEK[subscript] ?? subscript).join(" ") + mark)) : base;
}

function mathSign(sign) {
  const made = mathElement(sign === "*" ? "mspace" : "mo", SIGNS[sign] ?? "");
  if (sign === "*") made.setAttribute("width", "0.25em");
  return made;
}

const fenced = (open, inside, close) => mathElement("mrow", mathElement("mo", open), ...inside, mathElement("mo", close));
const listed = (parts) => parts.flatMap((part, k) => (k ? [mathElement("mo", ","), mathTree(part)] : [mathTree(part)]));

function mathTree(tree, least = 0) {
  if (tree.op === "number") return mathElement("mn", String(tree.value));
  if (tree.op === "name") return mathName(tree.name);
  if (tree.degrees) return mathElement("mrow", mathTree(tree.of[0], 4), mathElement("mi", "°"));
  if (tree.op === "vector") return fenced("(", listed(tree.of), ")");
  if (tree.op === "call") {
    if (tree.name === "sqrt") return mathElement("msqrt", mathTree(tree.of[0]));
    if (tree.name === "abs") return fenced("|", listed(tree.of), "|");
    return mathElement("mrow", mathElement("mi", tree.name), fenced("(", listed(tree.of), ")"));
  }
  const binds = BINDS[tree.op], [first, second] = tree.of;
  let made;
  if (tree.op === "/") made = mathElement("mfrac", mathTree(first), mathTree(second));
  else if (tree.op === "power") made = mathElement("msup", mathTree(first, first.op === "/" || first.op === "call" ? 5 : 4), mathTree(second));
  else if (tree.op === "negative") made = mathElement("mrow", mathElement("mo", "−"), mathTree(first, 2));
  else made = mathElement("mrow", mathTree(first, binds), mathSign(tree.op), mathTree(second, tree.op === "+" ? 1 : binds + (tree.op === "-" ? 1 : 0)));
  return binds < least ? fenced("(", [made], ")") : made;
}

function mathEquation(name, tree, text) {
  const made = mathElement("math", mathElement("mrow", mathName(name), mathElement("mo", "="), mathTree(tree)));
  made.setAttribute("alttext", text);
  made.setAttribute("displaystyle", "true");
  return made;
}

// The parts of a step: a <math> for each assignment, and a <code> for what is words or cannot be parsed.
function mathOf(symbols) {
  return splitAssignments(symbols).map((part) => {
    const [, name, formula] = ASSIGNED.exec(part) ?? [];
    try {
      if (name) return mathEquation(name, parse(formula), part);
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
    }
    const made = document.createElement("code");
    made.textContent = part;
    return made;
  });
}
