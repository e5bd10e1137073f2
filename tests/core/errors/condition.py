"""How far the exact distance of a hit moves when the numbers it follows from move by parts of themselves: 60 digits.

Times the unit roundoff it is what no arithmetic of that precision can promise to stay below; a bound is tight where it
is a small multiple of that. The numbers are the pixel's place in the frame (in parts of the frame), the ray that the
model makes of it, and the shape's center and axes.
"""

from mpmath import mp, mpf

from ..truth import truth

STEP = mpf(2) ** -60
"""Pixels between the rays whose difference shows how fast the picture's rays turn."""

SKEW = 40
"""Axes that are more skew than this are inverted with twice the digits, and so count no more."""

TIGHT = 50
"""What a bound may be at most, over the unit roundoff times the condition: measured are 40 at most over all models, 34
over all extreme cases. Some 10 to 20 roundings, each taken at its worst and none against another, add up to that."""


def condition(raw, shapes, x, y):
    """In the unit of the distance, for relative changes of 1. The ray has to hit; None at a rim, where a neighbor of
    the pixel has no ray on either side.
    """
    ray = truth.ray(raw, x, y)
    moved = moves(raw, x, y, ray)
    if moved is None:
        return None
    hit = truth.nearest(shapes, ray, raw.clip_start, raw.clip_end)
    k, sphere = hit.shape, shapes.kind[hit.shape] == truth.SPHERE
    axes, center = truth.exact(shapes.axes[k]), truth.exact(shapes.center[k])
    to_shape, away = truth.inverse(axes), truth.norm(truth.minus(center, ray.origin))
    rows = to_shape if sphere else to_shape[2:]
    q, d = truth.times(to_shape, truth.minus(hit.position, center)), truth.times(to_shape, ray.direction)
    slope = abs(truth.dot(q, d) if sphere else d[2])
    size = mp.sqrt(sum(truth.dot(row, row) for row in rows))
    skew = abs(truth.dot(to_shape[0], truth.cross(to_shape[1], to_shape[2])))
    for axis in truth.columns(axes):
        skew *= truth.norm(axis)
    eye = [row[3] for row in truth.exact(raw.matrix_world)[:3]]
    reach = (hit.distance + away) * min(skew, SKEW) + truth.norm(truth.minus(ray.origin, eye)) + moved[0]
    reach += hit.t * moved[1]
    return float(ray.length * size * reach / slope + hit.distance)


def moves(raw, x, y, ray):
    """How far the ray's origin and direction move per unit of the pixel's place, the sides of the frame being 1."""
    frame = truth.frame_of(raw)
    total = [mpf(0), mpf(0)]
    for dx, dy, side in ((STEP, 0, frame.width), (0, STEP, frame.height)):
        other = truth.ray(raw, mpf(x) + dx, mpf(y) + dy) or truth.ray(raw, mpf(x) - dx, mpf(y) - dy)
        if other is None:
            return None
        for k, (there, here) in enumerate(((other.origin, ray.origin), (other.direction, ray.direction))):
            total[k] += truth.norm(truth.minus(there, here)) / STEP * side
    return total
