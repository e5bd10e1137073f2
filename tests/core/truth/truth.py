"""The exact picture: rays and hits with 60 digits, from the numbers as they are stored.

Written from the formulas of the Blender manual and of the lecture, one pixel at a time, in the plainest way there is:
with 60 digits no order of operations matters. A vector is a list of three mpf. Nothing here is shared with the core but
the rays of models without a formula of their own in MODELS: those are the core's, evaluated with 60 digits; see
recorded.
"""

from dataclasses import dataclass
from functools import lru_cache

from mpmath import asin, cos, mp, mpf, sin, sqrt

from .recorded import lens_of

mp.dps = 60
SPHERE, PLANE, INFINITE_PLANE = 0, 1, 2


def exact(values):
    """A vector or a matrix of numbers as mpf, digit by digit what they are in binary."""
    return [exact(v) if hasattr(v, "__len__") else mpf(float(v)) for v in values]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def norm(a):
    return sqrt(dot(a, a))


def times(rows, v):
    return [dot(row, v) for row in rows]


def columns(rows):
    return [list(column) for column in zip(*rows, strict=True)]


def minus(a, b):
    return [x - y for x, y in zip(a, b, strict=True)]


def along(o, d, t):
    return [x + t * y for x, y in zip(o, d, strict=True)]


def inverse(rows):
    a, b, c = columns(rows)
    volume = dot(a, cross(b, c))
    return [[x / volume for x in row] for row in (cross(b, c), cross(c, a), cross(a, b))]


def to_shape(shapes, k):
    """The matrix from world directions to shape k's frame."""
    return _inverse_of(tuple(map(tuple, shapes.axes[k].tolist())))


@lru_cache(1024)  # every pixel of a test asks for the same few
def _inverse_of(axes):
    return inverse(exact(axes))


@dataclass(frozen=True)
class Frame:
    """A picture's size in pixels and the sensor, mm, that is fitted to it."""

    width: int
    height: int
    aspect: mpf
    """Height of a pixel over its width."""
    fitted: mpf
    """The fitted side in pixel widths."""
    sensor: mpf


def frame_of(raw):
    width, height = (side * raw.resolution_percentage // 100 for side in (raw.resolution_x, raw.resolution_y))
    aspect = mpf(raw.pixel_aspect_y) / mpf(raw.pixel_aspect_x)
    fit = raw.sensor_fit
    if fit == "AUTO":
        fit = "HORIZONTAL" if width >= aspect * height else "VERTICAL"
    sensor = raw.sensor_height if raw.sensor_fit == "VERTICAL" else raw.sensor_width
    return Frame(width, height, aspect, width if fit == "HORIZONTAL" else aspect * height, mpf(sensor))


def planar(raw, x, y, length):
    """The pixel on the plane on which the fitted side has this length."""
    frame = frame_of(raw)
    unit = length / frame.fitted
    return (
        (x - mpf(frame.width) / 2 + mpf(raw.shift_x) * frame.fitted) * unit,
        ((y - mpf(frame.height) / 2) * frame.aspect + mpf(raw.shift_y) * frame.fitted) * unit,
    )


def shares(raw, x, y):
    """The pixel as fractions of the whole frame, shifted as panoramas are."""
    frame = frame_of(raw)
    return x / frame.width + mpf(raw.shift_x), y / frame.height + mpf(raw.shift_y)


def disc_place(raw, x, y):
    u, v = shares(raw, x, y)
    return 2 * u - 1, 2 * v - 1


def round_place(raw, x, y):
    """The pixel on the unit disc that touches the nearer sides of the frame."""
    frame = frame_of(raw)
    across, up = frame.width, frame.height * frame.aspect
    u, v = shares(raw, x, y)
    return (2 * u - 1) * across / min(across, up), (2 * v - 1) * up / min(across, up)


EYE = [mpf(0)] * 3
AHEAD = [mpf(0), mpf(0), mpf(-1)]


def fisheye(point, theta):
    a, b = point
    r = sqrt(a * a + b * b)
    return EYE, AHEAD if r == 0 else [a / r * sin(theta), b / r * sin(theta), -cos(theta)]


def perspective(raw, x, y):
    return EYE, [*planar(raw, x, y, frame_of(raw).sensor / mpf(raw.lens)), mpf(-1)]


def orthographic(raw, x, y):
    return [*planar(raw, x, y, mpf(raw.ortho_scale)), mpf(0)], AHEAD


def radius(point):
    return sqrt(point[0] ** 2 + point[1] ** 2)


def mirror_ball(raw, x, y):
    point = disc_place(raw, x, y)
    return None if radius(point) > 1 else fisheye(point, 2 * asin(radius(point)))


MODELS = {
    "PERSP": perspective, "ORTHO": orthographic, "MIRRORBALL": mirror_ball,
}  # fmt: skip
PLANAR = {"PERSP", "ORTHO"}
"""Models whose t is the depth."""


def formulas():
    """The formulas that are written anew here, by the keys of their models, and the models whose t is the depth."""
    from . import lenses, multiperspective  # which are written in the words of this module

    return MODELS | lenses.MODELS | multiperspective.MODELS, PLANAR | lenses.PLANAR


@dataclass(frozen=True)
class Ray:
    """A world ray; t counts depth for planar cameras, distance for the others."""

    origin: list
    direction: list

    @property
    def length(self):
        return norm(self.direction)


def ray(raw, x, y):
    """The exact ray through pixel coordinates, None where there is none: by the model's formula that is written anew,
    where there is one, else by its recorded one.
    """
    key = raw.model or (raw.settings["panorama_type"] if raw.type == "PANO" else raw.type)
    from .ports import behind  # which is written in the words of this module

    models, depths = formulas()
    if key in models:
        in_camera = behind(raw, models[key](raw, mpf(x), mpf(y)))
        return in_world(raw, in_camera, key in depths and "port" not in raw.settings)
    return recorded_ray(raw, x, y)


def recorded_ray(raw, x, y):
    """The ray that the core's own formula gives of any model, evaluated with 60 digits."""
    lens, is_planar = lens_of(raw)
    return in_world(raw, lens(x, y), is_planar)


def in_world(raw, camera_ray, is_planar):
    """The world ray of origin and direction in the camera's frame, None for None; t counts depth where it is planar."""
    if camera_ray is None:
        return None
    rows = exact(raw.matrix_world)[:3]
    axes = [[x / norm(axis) for x in axis] for axis in columns([row[:3] for row in rows])[:3]]
    origin, direction = (times(columns(axes), vector) for vector in camera_ray)
    if not is_planar:
        length = norm(direction)
        direction = [x / length for x in direction]
    return Ray(along(origin, [row[3] for row in rows], 1), direction)


@dataclass(frozen=True)
class Hit:
    shape: int
    t: mpf
    distance: mpf
    position: list
    normal: list
    """Turned towards the ray's origin."""


def crossings(shapes, k, ray):
    """All t at which the line of a ray crosses shape k, ascending, and a sphere's discriminant (None for planes).

    The discriminant is |D|^2 - |N x D|^2 in the shape's frame.
    """
    kind, inner = shapes.kind[k], to_shape(shapes, k)
    d, n = times(inner, ray.direction), times(inner, minus(exact(shapes.center[k]), ray.origin))
    if kind != SPHERE:
        if d[2] == 0:
            return [], None
        t = n[2] / d[2]
        q = minus([t * x for x in d], n)
        return [t] if kind == INFINITE_PLANE or max(abs(q[0]), abs(q[1])) <= 1 else [], None
    a, b = dot(d, d), dot(n, d)
    discriminant = b * b - a * (dot(n, n) - 1)
    if discriminant < 0:
        return [], discriminant
    return [(b - sqrt(discriminant)) / a, (b + sqrt(discriminant)) / a], discriminant


def nearest(shapes, ray, start, end):
    """The nearest hit within the clip range, None where there is none."""
    hits = [
        (t, k)
        for k in range(len(shapes.kind))
        for t in crossings(shapes, k, ray)[0]
        if start <= t <= end
    ]
    if not hits:
        return None
    t, k = min(hits)
    point = along(ray.origin, ray.direction, t)
    inner = to_shape(shapes, k)
    q = times(inner, minus(point, exact(shapes.center[k])))
    normal = times(columns(inner), q if shapes.kind[k] == SPHERE else [mpf(0), mpf(0), mpf(1)])
    size = -norm(normal) if dot(normal, ray.direction) > 0 else norm(normal)
    return Hit(k, t, t * ray.length, point, [x / size for x in normal])
