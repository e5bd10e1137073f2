"""The two programs of a live view: the directions of a camera's rays, and the warp of faces along them."""

from collections.abc import Sequence
from functools import cache

import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from ...core.faces.faces import Face
from ...core.shaders.ray_map import DirectionText

MOST_FACES = 6
KEPT = "struct Kept {{ vec4 k[{count}]; }};"
VERTEX = "void main() { place = 0.5 * pos + 0.5; gl_Position = vec4(pos, 0.0, 1.0); }"
MAP = """
void main()
{{
    vec2 pixel = (place * frame.size.zw - frame.at.xy) * frame.size.xy / (frame.at.zw - frame.at.xy);
    vec3 d = vec3(0.0);
    bool is_seen = direction(pixel.x, pixel.y, d);
    color = is_seen ? vec4(d, 1.0) : vec4(0.0);
}}
"""
FRAME = "struct Frame { vec4 at; vec4 size; };"
FACES = """
struct Faces { vec4 row[18]; vec4 window[6]; vec4 ground; vec4 outside; vec4 inside; vec4 texels[6]; };
"""
WARP = """
vec4 texel(int face, vec2 at)
{
    vec4 window = faces.window[face];
    vec2 uv = clamp((at - window.xy) / (window.zw - window.xy), 0.0, 1.0);
    if (face == 0) return texture(face_0, uv);
    if (face == 1) return texture(face_1, uv);
    if (face == 2) return texture(face_2, uv);
    if (face == 3) return texture(face_3, uv);
    if (face == 4) return texture(face_4, uv);
    return texture(face_5, uv);
}
vec3 turned(int face, vec3 d)
{
    return vec3(dot(faces.row[3 * face].xyz, d), dot(faces.row[3 * face + 1].xyz, d),
                dot(faces.row[3 * face + 2].xyz, d));
}
void main()
{
    vec2 pixel = place * vec2(textureSize(directions, 0));
    vec4 seen = texelFetch(directions, ivec2(pixel), 0);
    vec3 d = seen.xyz, by_x = dFdx(d), by_y = dFdy(d);
    bool is_inside = all(greaterThanEqual(pixel, faces.inside.xy)) && all(lessThan(pixel, faces.inside.zw));
    if (!is_inside && faces.outside.w > 0.5) discard;
    vec3 shown = is_inside ? faces.ground.rgb : faces.outside.rgb;
    int count = int(faces.ground.w), face = 0;
    float ahead = -1e30;
    for (int i = 0; i < count; i++) {
        float depth = -dot(faces.row[3 * i + 2].xyz, d);
        if (depth > ahead) { ahead = depth; face = i; }
    }
    if (is_inside && seen.w > 0.5 && count > 0 && ahead > 0.0) {
        vec3 p = turned(face, d), x = turned(face, by_x), y = turned(face, by_y);
        vec2 at = p.xy / -p.z, most = 2.0 * faces.texels[face].xy;
        vec2 side = clamp((x.xy + at * x.z) / -p.z, -most, most) / 4.0;
        vec2 up = clamp((y.xy + at * y.z) / -p.z, -most, most) / 4.0;
        vec4 sum = texel(face, at + side + up) + texel(face, at + side - up);
        sum += texel(face, at - side + up) + texel(face, at - side - up);
        shown = mix(shown, sum.rgb / max(sum.a, 1e-6), sum.a / 4.0);
    }
    vec3 dark = shown / 12.92, light = pow((shown + 0.055) / 1.055, vec3(2.4));
    color = vec4(srgbTarget ? mix(dark, light, step(0.04045, shown)) : shown, 1.0);
}
"""
"""Four samples a pixel, at the middles of its quarters. ``srgbTarget`` is set by Blender: whether the framebuffer
encodes colors as sRGB by itself.
"""
CORNERS = ((-1, -1), (1, -1), (1, 1), (-1, -1), (1, 1), (-1, 1))


def _info():
    """Return the description of a program that draws a rectangle."""
    info, between = gpu.types.GPUShaderCreateInfo(), gpu.types.GPUStageInterfaceInfo("live_view")
    between.smooth("VEC2", "place")
    info.vertex_in(0, "VEC2", "pos")
    info.vertex_out(between)
    info.fragment_out(0, "VEC4", "color")
    info.vertex_source(VERTEX)
    return info


@cache
def _map_program(text: str, count: int):
    info = _info()
    info.typedef_source(FRAME + KEPT.format(count=count))
    info.uniform_buf(0, "Frame", "frame")
    info.uniform_buf(1, "Kept", "kept")
    info.fragment_source(text + MAP.format())
    return _made(info)


@cache
def _warp_program():
    info = _info()
    info.typedef_source(FACES)
    info.uniform_buf(0, "Faces", "faces")
    info.push_constant("BOOL", "srgbTarget")
    for k in range(MOST_FACES):
        info.sampler(k, "FLOAT_2D", f"face_{k}")
    info.sampler(MOST_FACES, "FLOAT_2D", "directions")
    info.fragment_source(WARP)
    return _made(info)


def _made(info):
    shader = gpu.shader.create_from_info(info)
    return shader, batch_for_shader(shader, "TRIS", {"pos": CORNERS})


def forget() -> None:
    """Forget the programs."""
    _map_program.cache_clear()
    _warp_program.cache_clear()


def _buffer(values: np.ndarray):
    return gpu.types.GPUUniformBuf(gpu.types.Buffer("FLOAT", values.size, np.ascontiguousarray(values).ravel()))


def draw_map(target, made: DirectionText, frame, size: tuple[int, int]) -> None:
    """Draw the directions of rays into an offscreen buffer: x, y, z, and 1 where there is a ray.

    frame: left, bottom, right, top of the camera's full frame in the buffer's pixels. size: of the frame in the
    camera's.
    """
    values = np.array([frame, (*size, target.width, target.height)], np.float32)
    shader, batch = _map_program(made.text, len(made.values))
    with target.bind():
        gpu.state.blend_set("NONE")
        gpu.state.depth_test_set("NONE")
        shader.bind()
        blocks = {"frame": _buffer(values), "kept": _buffer(made.values)}  # alive until it is drawn
        for name, block in blocks.items():
            shader.uniform_block(name, block)
        batch.draw(shader)


def map_texture(directions: np.ndarray):
    """Return the texture of directions, (rows, columns, 4) float32, as ``draw_map`` draws them."""
    rows, columns = directions.shape[:2]
    data = gpu.types.Buffer("FLOAT", directions.size, directions.ravel())
    return gpu.types.GPUTexture((columns, rows), format="RGBA32F", data=data)


def draw_warp(
    directions, textures: Sequence, faces: Sequence[Face], basis: np.ndarray, colors, inside, is_only_inside: bool
) -> None:
    """Draw the picture that faces give along directions into the current framebuffer.

    directions: a texture of ``draw_map``. textures: of the faces. basis: (3, 3), from the camera's frame to that of the
    faces. colors: of pixels in the frame without a ray, and of those outside of it, as sRGB. inside: left, bottom,
    right, top of what is shown, in pixels. is_only_inside: whether nothing is drawn around that.
    """
    values = np.zeros((33, 4), np.float32)
    for k, face in enumerate(faces):
        left, right, bottom, top = face.window
        values[3 * k : 3 * k + 3, :3] = face.axes @ basis
        values[18 + k] = left, bottom, right, top
        values[27 + k, :2] = (right - left) / face.size[0], (top - bottom) / face.size[1]
    values[24], values[25], values[26] = (*colors[0], len(faces)), (*colors[1], float(is_only_inside)), inside
    shader, batch = _warp_program()
    gpu.state.blend_set("NONE")
    gpu.state.depth_test_set("NONE")
    shader.bind()
    block = _buffer(values)  # alive until it is drawn
    shader.uniform_block("faces", block)
    for k in range(MOST_FACES):
        shader.uniform_sampler(f"face_{k}", textures[k] if k < len(textures) else directions)
    shader.uniform_sampler("directions", directions)
    batch.draw(shader)
