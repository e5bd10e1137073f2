// The picture: one program of the graphics card for each formula.
const VERTEX = "#version 300 es\nin vec2 corner; void main() { gl_Position = vec4(corner, 0.0, 1.0); }";
const CASTER = `
uniform vec2 resolution, frame;
uniform vec3 eye, axis_u, axis_v, axis_w;
uniform float time, spread;
uniform int times, plain;
uniform vec4 spheres[SPHERES + 1];
uniform vec3 colors[SHAPES + 1], centers[FLATS + 1], sides_u[FLATS + 1], sides_v[FLATS + 1];
uniform vec2 turn;
#if NODES > 0
uniform highp sampler2D facets;
vec4 texel(int k) { return texelFetch(facets, ivec2(k % 1024, k / 1024), 0); }
#endif
vec4 seen(vec2 a, vec3 o, vec3 d) {
  o = eye + o.x * axis_u + o.y * axis_v - o.z * axis_w;
  d = normalize(d.x * axis_u + d.y * axis_v - d.z * axis_w);
  float t = time + spread * (times == 1 ? a.y : times == 2 ? a.x : times == 3 ? length(vec2(a.x * frame.x / frame.y, a.y)) - 0.5 : 0.0);
  float c = cosine(6.28318531 * t), s = sine(6.28318531 * t);
  float best = 1e30;
  int index = -1;
  vec3 normal = vec3(0.0), point = vec3(0.0);
  for (int i = 0; i < SPHERES; i++) {
    vec2 xz = spheres[i].xz - turn;
    vec3 center = vec3(turn.x + c * xz.x + s * xz.y, spheres[i].y, turn.y - s * xz.x + c * xz.y), to = o - center;
    float b = dot(to, d), r = spheres[i].w;
    vec3 off = to - b * d;
    float halfSquared = r * r - dot(off, off);
    if (halfSquared < 0.0) continue;
    float root = sqrt(halfSquared), at = -b - root > NEAR ? -b - root : -b + root;
    if (at > NEAR && at < best) { best = at; index = i; point = o + at * d; normal = (point - center) / r; }
  }
  for (int i = 0; i < FLATS; i++) {
    vec3 n = cross(sides_u[i], sides_v[i]);
    float slope = dot(n, d), at = dot(n, centers[i] - o) / slope;
    vec3 q = o + at * d - centers[i];
    if (slope == 0.0 || !(at > NEAR && at < best)) continue;
    if (abs(dot(q, sides_u[i])) > dot(sides_u[i], sides_u[i]) || abs(dot(q, sides_v[i])) > dot(sides_v[i], sides_v[i])) continue;
    best = at; index = SPHERES + i; point = o + at * d; normal = normalize(n) * (slope > 0.0 ? -1.0 : 1.0);
  }
#if NODES > 0
  vec3 facet_color = vec3(0.0), way = mix(d, vec3(1e-12), lessThan(abs(d), vec3(1e-12)));
  for (int n = 0; n < NODES;) {
    vec4 low = texel(2 * n), high = texel(2 * n + 1);
    vec3 a = (low.xyz - o) / way, b = (high.xyz - o) / way, first = min(a, b), last = max(a, b);
    if (max(max(first.x, first.y), max(first.z, 0.0)) > 1.0001 * min(min(last.x, last.y), min(last.z, best))) { n = int(low.w); continue; }
    n++;
    if (high.w < 0.0) continue;
    int start = int(high.w) / 8, count = int(high.w) % 8;
    for (int k = start; k < start + count; k++) {
      vec4 corner = texel(2 * NODES + 3 * k), e = texel(2 * NODES + 3 * k + 1), f = texel(2 * NODES + 3 * k + 2);
      vec3 p = cross(d, f.xyz), to = o - corner.xyz, q = cross(to, e.xyz);
      float det = dot(e.xyz, p), u = dot(to, p) / det, v = dot(d, q) / det, at = dot(f.xyz, q) / det;
      if (det == 0.0 || u < 0.0 || v < 0.0 || u + v > 1.0 || !(at > NEAR && at < best)) continue;
      int bits = int(e.w);
      best = at; index = SHAPES; normal = normalize(cross(e.xyz, f.xyz));
      if (dot(normal, d) > 0.0) normal = -normal;
      facet_color = pow(vec3(bits & 255, bits >> 8 & 255, bits >> 16) / 255.0, vec3(2.2));
    }
  }
#endif
  if (plain > 0) {
    float far = clamp(best / 64.0, 0.0, 0.999999);
    return vec4(float(index < 0 ? 254 : index) / 255.0, floor(far * 256.0) / 255.0, floor(fract(far * 256.0) * 256.0) / 255.0, floor(fract(far * 65536.0) * 256.0) / 255.0);
  }
  vec3 base = index < 0 ? vec3(0.05, 0.07, 0.1) :
#if NODES > 0
    index == SHAPES ? facet_color :
#endif
    colors[index];
  if (index >= SPHERES && index < SHAPES && GRID > 0) {
    vec3 g = abs(fract(point + 0.5) - 0.5), soft = vec3(0.012 + 0.0025 * best);
    vec3 lines = (1.0 - smoothstep(0.5 * soft, soft, g)) * (1.0 - abs(normal));
    base = mix(base, base * 0.45, max(lines.x, max(lines.y, lines.z)));
  }
  float light = 0.45 + 0.4 * max(dot(normal, normalize(vec3(0.4, 0.8, 0.55))), 0.0) + 0.25 * max(dot(normal, -d), 0.0);
  return vec4(base * light, 1.0);
}`;
const DISPLAYED = "vec4 displayed(vec3 light) { return vec4(pow(light, vec3(1.0 / 2.2)), 1.0); }";
const PLACE = "vec2 p = gl_FragCoord.xy * frame / resolution, a = p / frame - 0.5;";
const OF_FORMULA = `
void main() {
  ${PLACE}
  vec3 o, d;
  if (!ray(p.x, p.y, o, d) || !(dot(d, d) > 0.0)) {
    float line = mod(gl_FragCoord.x + gl_FragCoord.y, 12.0) < 1.5 ? 0.3 : 0.2;
    color = plain > 0 ? vec4(1.0) : vec4(vec3(line), 1.0);
    return;
  }
  vec4 light = seen(a, o, d);
  color = plain > 0 ? light : displayed(light.rgb);
}`;

// The picture of a real lens with its whole stop: from the film's point through every surface, to the scene.
const OF_GLASS = `
uniform vec4 shapes[SURFACES], media[SURFACES];
uniform vec2 bends[BENDS + 1], pitch, center;
uniform vec4 lens;
uniform float disc, unit, reach, crossings[17];
uniform int samples;
vec2 sag(vec4 s, vec4 m, float q) {
  float root = sqrt(1.0 - (1.0 + s.z) * s.y * s.y * q);
  vec2 sum = vec2(s.y * q / (1.0 + root), s.y / (2.0 * root));
  for (int i = int(m.z); i < int(m.z + m.w); i++) {
    float lower = bends[i].y * pow(q + 1e-20, 0.5 * bends[i].x - 1.0);
    sum += vec2(lower * q, 0.5 * bends[i].x * lower);
  }
  return sum;
}
bool passes(inout vec3 o, inout vec3 d) {
  for (int k = SURFACES - 1; k >= 0; k--) {
    vec4 s = shapes[k], m = media[k];
    o += (s.x - o.z) / d.z * d;
    float f = s.y * dot(o.xy, o.xy), g = d.z - s.y * dot(o.xy, d.xy), root = g * g - s.y * f * (1.0 + s.z * d.z * d.z);
    if (!(root >= 0.0)) return false;
    o += f / (g - sqrt(root)) * d;
    for (int i = 0; i < (m.w > 0.0 ? 5 : 0); i++) {
      vec2 at = sag(s, m, dot(o.xy, o.xy));
      o += (at.x - o.z + s.x) / (d.z - 2.0 * at.y * dot(o.xy, d.xy)) * d;
    }
    if (!(dot(o.xy, o.xy) <= s.w * s.w)) return false;
    vec3 n = -normalize(vec3(-2.0 * sag(s, m, dot(o.xy, o.xy)).y * o.xy, 1.0));
    float ratio = m.y / m.x, cosine = dot(d, n), cosineSquared = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    if (!(cosineSquared >= 0.0)) return false;
    d = ratio * d + (sqrt(cosineSquared) - ratio * cosine) * n;
  }
  return true;
}
void main() {
  ${PLACE}
  vec3 film = vec3((center - p) * pitch, lens.x), total = vec3(0.0);
  float place = min(length(film.xy) / reach * 16.0, 15.999);
  vec2 middle = film.xy * mix(crossings[int(place)], crossings[int(place) + 1], fract(place));
  float turned = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  for (int i = 0; i < samples; i++) {
    float r = disc * sqrt((float(i) + 0.5) / float(samples)), angle = 2.39996323 * float(i) + 6.28318531 * turned;
    vec3 d = normalize(vec3(middle + r * vec2(cosine(angle), sine(angle)), lens.y) - film), o = film;
    if (d.z > 0.0) d = -d;
    float slant = d.z * d.z;
    if (passes(o, d)) total += slant * slant * seen(a, unit * (o - vec3(0.0, 0.0, lens.z)), d).rgb;
  }
  color = displayed(total * lens.w / float(samples));
}`;

class Picture {
  constructor(canvas) {
    this.canvas = canvas;
    this.gl = canvas.getContext("webgl2", { antialias: false, preserveDrawingBuffer: true });
    this.programs = new Map();
    if (!this.gl) return;
    const gl = this.gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 3, -1, -1, 3]), gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
    if (!SCENE.nodes) return;
    const rows = Math.ceil(FACETS.length / 4096), texels = new Float32Array(4096 * rows);
    texels.set(FACETS);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, 1024, rows, 0, gl.RGBA, gl.FLOAT, texels);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  }

  // The program of a formula, or of a lens; a Refusal with the compiler's words if there is none.
  program(source, count, end = OF_FORMULA) {
    if (this.programs.has(source + end)) return this.programs.get(source + end);
    const gl = this.gl, made = gl.createProgram();
    const sizes = { SPHERES: SPHERES.length, FLATS: RECTANGLES.length, SHAPES: SPHERES.length + RECTANGLES.length, NEAR: SCENE.near.toExponential(6), NODES: SCENE.nodes, GRID: SCENE.still ? 0 : 1 };
    const caster = CASTER.replace(/\b(SPHERES|FLATS|SHAPES|NEAR|NODES|GRID)\b/g, (name) => sizes[name]);
    const text = `#version 300 es\nprecision highp float;\nprecision highp int;\nuniform float k[${Math.max(count, 1)}];\n${HELPERS}${source}out vec4 color;\n${DISPLAYED}${caster}${end}`;
    for (const [kind, code] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, text]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, code);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Refusal(`the graphics card refuses the formula: ${(gl.getShaderInfoLog(shader) || "").split("\n")[0]}`);
      gl.attachShader(made, shader);
    }
    gl.bindAttribLocation(made, 0, "corner");
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Refusal("the graphics card refuses the formula");
    this.programs.set(source + end, made);
    return made;
  }

  // glass: a Glass with the whole stop of which the picture is taken, in so many samples; without it by the formula.
  draw(camera, state, share, plain = false, glass = null, samples = 0) {
    const gl = this.gl;
    if (!gl || gl.isContextLost()) return;
    const made = glass ? this.program("", 0, glass.program) : this.program(camera.glsl, camera.numbers.length), [width, height] = camera.size;
    this.canvas.width = Math.max(16, Math.round(share * width));
    this.canvas.height = Math.max(9, Math.round(share * height));
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.useProgram(made);
    const place = (name) => gl.getUniformLocation(made, name), at = pose(state);
    gl.uniform2f(place("resolution"), this.canvas.width, this.canvas.height);
    gl.uniform2f(place("frame"), width, height);
    gl.uniform3fv(place("eye"), at.eye);
    gl.uniform3fv(place("axis_u"), at.u);
    gl.uniform3fv(place("axis_v"), at.v);
    gl.uniform3fv(place("axis_w"), at.w);
    gl.uniform1f(place("time"), state.time);
    gl.uniform1f(place("spread"), state.spread);
    gl.uniform1i(place("times"), TIMES.indexOf(state.times));
    gl.uniform1i(place("plain"), plain ? 1 : 0);
    gl.uniform2fv(place("turn"), TURN);
    gl.uniform4fv(place("spheres"), [...SPHERES.flatMap((sphere) => [...sphere.center, sphere.radius]), 0, 0, 0, 0]);
    gl.uniform3fv(place("colors"), [...[...SPHERES, ...RECTANGLES].flatMap((shape) => shape.color), 0, 0, 0]);
    gl.uniform3fv(place("centers"), [...RECTANGLES.flatMap((flat) => flat.center), 0, 0, 0]);
    gl.uniform3fv(place("sides_u"), [...RECTANGLES.flatMap((flat) => flat.u), 0, 0, 0]);
    gl.uniform3fv(place("sides_v"), [...RECTANGLES.flatMap((flat) => flat.v), 0, 0, 0]);
    const within = (value) => Number.isNaN(value) ? 0 : Math.min(Math.max(Number(value), -3e38), 3e38);
    if (glass) {
      for (const [name, [kind, ...values]] of Object.entries(glass.uniforms)) gl[`uniform${kind}`](place(name), ...values);
      gl.uniform1i(place("samples"), samples);
    } else if (camera.numbers.length) gl.uniform1fv(place("k"), camera.numbers.map(within));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  // Reads the picture of indices and distances: [index, t] for each pixel, rows from the bottom.
  indices(camera, state) {
    this.draw(camera, state, 1, true);
    const gl = this.gl, { width, height } = this.canvas, bytes = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    return Array.from({ length: width * height }, (_, k) => [bytes[4 * k], (bytes[4 * k + 1] / 256 + bytes[4 * k + 2] / 65536 + bytes[4 * k + 3] / 16777216) * 64]);
  }
}
