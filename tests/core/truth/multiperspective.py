"""The exact rays of cameras without one eye, with 60 digits: see truth, whose frame and vectors they use.

Slits and path are taken to the camera's frame exactly, from the numbers as they are stored.
"""

from itertools import pairwise

from mpmath import cos, mpf, pi, sin

from .truth import along, columns, cross, dot, exact, frame_of, inverse, minus, norm, planar, times

Z = [mpf(0), mpf(0), mpf(1)]


def scaled(v, s):
    return [s * x for x in v]


def unit(v):
    return scaled(v, 1 / norm(v))


def points(raw, name):
    """The points of a setting, in the camera's frame."""
    own_points, matrix = raw.settings[name][:2]
    rows, pose = exact(matrix)[:3], exact(raw.matrix_world)[:3]
    eye = [row[3] for row in pose]
    axes = columns([unit(axis) for axis in columns([row[:3] for row in pose])])
    in_world = [along(times([row[:3] for row in rows], p), [row[3] for row in rows], 1) for p in exact(own_points)]
    return [times(inverse(axes), minus(p, eye)) for p in in_world]


def pixel(raw, x, y):
    """The pixel's direction as a pinhole's."""
    return [*planar(raw, x, y, frame_of(raw).sensor / mpf(raw.lens)), mpf(-1)]


def slit(raw, name):
    """A point, the unit direction, and the unit vectors along the slit's picture and across it."""
    first, *_, last = points(raw, name)
    direction = unit(minus(last, first))
    along_it = unit([direction[0], direction[1], mpf(0)])
    return first, direction, along_it, cross(Z, along_it)


def general_linear(raw, x, y):
    frame = frame_of(raw)
    first, two, three = (exact(raw.settings[f"ray_{k}"]) for k in (1, 2, 3))
    s, t, u, v = along(along(first, minus(two, first), x / frame.width), minus(three, first), y / frame.height)
    return [s, t, mpf(0)], [u - s, v - t, mpf(-1)]


def cross_slit(raw, x, y):
    """Through the pixel and where the plane of it and the first slit meets the second."""
    point_in_plane = pixel(raw, x, y)
    first, direction, _, _ = slit(raw, "slit_1")
    second, other, _, _ = slit(raw, "slit_2")
    normal = cross(direction, minus(point_in_plane, first))
    meeting = along(second, other, dot(normal, minus(point_in_plane, second)) / dot(normal, other))
    through = minus(meeting, point_in_plane)
    through = scaled(through, -1 / through[2])
    return along(point_in_plane, through, -1), through


def pushbroom(raw, x, y):
    """In the plane across the slit that the orthographic camera has for the pixel, at the perspective one's slope."""
    point, direction, along_it, across = slit(raw, "slit_1")
    start = [*planar(raw, x, y, mpf(raw.ortho_scale)), mpf(0)]
    way = (dot(along_it, start) - dot(along_it, point)) / dot(along_it, direction)
    return along(point, direction, way), minus(scaled(across, dot(across, pixel(raw, x, y))), Z)


def pencil(raw, x, y):
    point, direction, _, across = slit(raw, "slit_1")
    ray = pixel(raw, x, y)
    slope = dot(across, ray) / dot(cross(across, direction), ray)
    return along(point, direction, mpf(raw.settings["pencil_slide"]) * slope), ray


def twisted_orthographic(raw, x, y):
    point, _, along_it, across = slit(raw, "slit_1")
    start = [*planar(raw, x, y, mpf(raw.ortho_scale)), mpf(0)]
    slope = mpf(raw.settings["twist"]) * dot(along_it, minus(start, point))
    return start, minus(scaled(across, slope), Z)


def strip(raw, x, y):
    """Walk the path; without follow_path every column looks ahead, with it as its two ends on average."""
    path = points(raw, "path")
    steps = [minus(b, a) for a, b in pairwise(path)]
    left = x / frame_of(raw).width * sum(norm(step) for step in steps)
    k = 0
    while k < len(steps) - 1 and left > norm(steps[k]):
        left -= norm(steps[k])
        k += 1
    along_step = left / norm(steps[k])
    right = [mpf(1), mpf(0), mpf(0)]
    if raw.settings["follow_path"]:
        heads = [unit(step) for step in steps]
        heads = [along(a, b, 1) for a, b in zip([heads[0], *heads], [*heads, heads[-1]], strict=True)]
        heads = [unit([head[0], mpf(0), head[2]]) for head in heads]
        right = unit(along(heads[k], minus(heads[k + 1], heads[k]), along_step))
    ahead = [right[2], mpf(0), -right[0]]
    return along(path[k], steps[k], along_step), along(ahead, [mpf(0), mpf(1), mpf(0)], pixel(raw, x, y)[1])


def omnidirectional_stereo(raw, x, y):
    frame = frame_of(raw)
    lon, lat = 2 * pi * (x / frame.width - mpf(1) / 2), pi * (y / frame.height - mpf(1) / 2)
    side = {"LEFT": -1, "RIGHT": 1}[raw.settings["eye"]] * mpf(raw.settings["interocular_distance"]) / 2
    direction = [cos(lat) * sin(lon), sin(lat), -cos(lat) * cos(lon)]
    return [side * cos(lon), mpf(0), side * sin(lon)], direction


MODELS = {
    "GENERAL_LINEAR": general_linear, "CROSS_SLIT": cross_slit, "PUSHBROOM": pushbroom, "PENCIL": pencil,
    "TWISTED_ORTHOGRAPHIC": twisted_orthographic, "STRIP": strip, "OMNIDIRECTIONAL_STEREO": omnidirectional_stereo,
}  # fmt: skip
