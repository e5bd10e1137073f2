"""``cast_rays`` and ``occluded``: rays that are given as arrays, cast at shapes."""

import math
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

from .. import arguments, memory
from ..casting.images import Images
from ..casting.pass_needs import WITHOUT_PIXEL, image_bytes
from ..casting.passes import PASSES
from ..conventions import gamma
from ..maths.speed import in_shares, processors, sharing
from ..maths.vector import norm
from ..motion.evaluations import Motion
from ..records import InputError, Shapes
from .body_search import MOST_RAYS
from .moving import hit_groups, may_share, write_nearest
from .ray_bodies import Span

KNOWN = tuple(name for name in PASSES if name not in WITHOUT_PIXEL)
"""The passes of rays, in the order of PASSES."""

LENGTH_RANGE = 1e-100, 1e100
"""Range of coordinates and of the lengths of directions: their squares and products neither overflow nor underflow."""

FRAMES = 1e-6
"""Frames by which times may lie beyond those at which shapes were read: rounding."""

SHARED_RAYS = 1 << 15
"""Unit of ``sharing``. By the clock two threads take 0.6 to 0.9 of the time of 131,000 rays at 8 or 1,000 spheres or
150,000 triangles. Of 64,000 rays they take 0.6 to 0.75 at triangles, but 1.2 at spheres, and of 32,000 0.85 to 1.9.
"""

PARTS = "cast the rays in parts"


class RayPattern(NamedTuple):
    """Rays as ``cast_rays`` takes them."""

    origins: Any
    directions: Any
    times: Any = None
    rings: Any = None
    near: float = 0.0
    far: float = math.inf


class RayImages(dict[str, np.ndarray]):
    """The passes by name, each an array of the rays' shape[, channels]."""

    shapes: Shapes
    rays: RayPattern | None = None
    """The rays, of whose nearest hits ``scan`` and ``save_points`` make a cloud; None with ``all_hits``."""

    __repr__, __missing__ = Images.__repr__, Images.__missing__


@arguments.keywords
def cast_rays(
    origins,
    directions,
    shapes: Shapes,
    *,
    passes: str | Iterable[str] = ("distance", "normal"),
    times=None,
    near: float = 0.0,
    far: float = math.inf,
    all_hits: bool = False,
    dtype=np.float64,
    rings=None,
    threads: int | None = None,
) -> RayImages:
    """Return the passes of the nearest hits of rays as a mapping of name to array.

    origins, directions: (..., 3) in the world, of shapes that broadcast. Directions may have any length: ``depth`` is
    t, counted in lengths of the direction, and ``distance`` is the distance in world units. A ray with NaN in its
    origin or direction is no ray: ``valid`` is False there. Hits count from ``near`` to ``far``, which are values of t.

    passes: the names of those passes of ``cast`` that a ray has: all but the solid angle, the footprint and flow. Each
    array has the shape of the rays, and then its channels. Values where nothing is hit are those of ``cast``.
    Real numbers are stored as ``dtype``.

    times: the frame of each ray, which broadcasts with the rays; None for the frame at which the shapes were read. The
    shapes have to be read with their motion, or stand still.

    rings: a number for each ray, kept for the cloud that ``scan`` and ``save_points`` make of the result.

    threads: maximum number of threads, by default one per processor; few rays are cast by one.

    With ``all_hits`` the arrays are flat, a row for each hit, by ray and distance, and there are two more: ``ray``, the
    index of the ray of each row, counted row by row, and ``count``, the number of hits of each ray, of the rays' shape.
    A ray hits an ellipsoid twice. A ray through an edge hits both of its triangles.

    Values of a ray do not depend on the others: the same rays give the same bits in any order, any partition and by any
    number of threads. Float64 values differ from those of a cast through a camera that has these rays by at most the
    sum of both error bounds (the passes ``distance_bound``, ``position_bound`` and ``normal_bound``). Indices are equal
    wherever a hit is farther than its bound from an edge and from other surfaces.

    Raises InputError for arrays that are not (..., 3) or do not broadcast, directions of length 0, numbers that are
    infinite or beyond LENGTH_RANGE, times beyond the frames at which shapes were read, unknown passes, a range that is
    not one, and passes that need more memory than is available.
    """
    origin, direction, shape = _rays(origins, directions)
    passes = _passes(passes)
    near, far = _range(near, far)
    dtype = arguments.real_type(dtype, "dtype")
    all_hits = arguments.flag(all_hits, "all_hits")
    _require(shapes, shape, passes, dtype)
    count = origin.shape[1]
    each = times_of(shapes, times, shape)
    threads = _threads(threads, shapes, each, passes, count)
    if all_hits:
        return _all(shapes, each, origin, direction, shape, passes, (near, far), dtype, threads)
    images = RayImages({name: PASSES[name].empty((1, count), dtype) for name in passes})
    images.shapes, images.rays = shapes, RayPattern(origins, directions, times, rings, near, far)

    def write(rays: slice) -> None:
        outs = {name: image[:, rays] for name, image in images.items()}
        write_nearest(shapes, *_share(rays, each, origin, direction), (near, far), outs)

    in_shares(write, count, threads, MOST_RAYS)
    for name, image in images.items():
        images[name] = image.reshape((*shape, *image.shape[2:]))
    return images


@arguments.keywords
def occluded(origins, targets, shapes: Shapes, *, times=None, threads: int | None = None) -> np.ndarray:
    """Return whether something lies between origins and targets, (..., 3) each, in the world: bool of the shape to
    which they broadcast.

    The segment is open at both ends, to the error bounds of the hits: a surface on which an end lies, to the rounding
    of its coordinates, does not hide it. A point that is NaN is not hidden, and two equal points hide nothing.
    ``times``, ``threads`` and the errors raised are those of ``cast_rays``.
    """
    start, end, shape = _points(origins, "origins", targets, "targets")
    _require(shapes, shape, ("valid",), np.dtype(np.float64))
    hidden = np.zeros(start.shape[1], bool)
    towards = end - start
    towards[:, ~(np.abs(towards).max(axis=0) > 0)] = np.nan
    each = times_of(shapes, times, shape)

    def hide(rays: slice) -> None:
        origin, ahead, frames = _share(rays, each, start, towards)
        with np.errstate(all="ignore"):
            rounding = gamma(4) * np.maximum(norm(origin), norm(end[:, rays])) / norm(ahead)
            for group in hit_groups(shapes, origin, ahead, frames, (0.0, 1.0)):
                hits = group.hits
                error = group.bodies.t_errors(origin[:, hits.ray], ahead[:, hits.ray], hits) + rounding[hits.ray]
                hidden[rays][hits.ray[(hits.t > error) & (hits.t < 1 - error)]] = True

    in_shares(hide, len(hidden), _threads(threads, shapes, each, (), len(hidden)), MOST_RAYS)
    return hidden.reshape(shape)


def _threads(threads, shapes: Shapes, each: np.ndarray | None, passes: tuple[str, ...], count: int) -> int:
    """Return how many threads share some rays."""
    limit = processors() if threads is None else arguments.count(threads, "threads")
    return sharing(limit, count / SHARED_RAYS) if may_share(shapes, each, passes) else 1


def _share(
    rays: slice, times: np.ndarray | None, origin: np.ndarray, direction: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
    """Return the origins, directions and times of some rays."""
    return origin[:, rays], direction[:, rays], None if times is None else times[rays]


def _rays(origins, directions) -> tuple[np.ndarray, np.ndarray, tuple[int, ...]]:
    """Return origins and directions, (3, n) each with NaN where there is no ray, and the shape of the rays."""
    origin, direction, shape = _points(origins, "origins", directions, "directions")
    length = np.abs(direction).max(axis=0, initial=0.0)
    if (length < LENGTH_RANGE[0]).any():
        first = int(np.argmax(length < LENGTH_RANGE[0]))
        short = "0" if length[first] == 0 else f"shorter than {LENGTH_RANGE[0]:g}"
        raise InputError(f"directions are {short} for ray {first}: give each a length, or NaN for no ray")
    lost = np.isnan(origin).any(axis=0) | np.isnan(direction).any(axis=0)
    direction[:, lost] = np.nan
    origin[:, lost] = 0.0
    return origin, direction, shape


def _points(first, first_name: str, second, second_name: str) -> tuple[np.ndarray, np.ndarray, tuple[int, ...]]:
    """Return two arrays of points as (3, n) each, and the shape to which they broadcast."""
    ends = []
    for argument, name in ((first, first_name), (second, second_name)):
        values = arguments.numbers(argument, name)
        if values.shape[-1:] != (3,):
            raise InputError(f"{name} have shape {values.shape}: give arrays of shape (..., 3)")
        ends.append(values)
    try:
        shape = np.broadcast_shapes(*(values.shape for values in ends))
    except ValueError as error:
        raise InputError(
            f"{first_name} of shape {ends[0].shape} and {second_name} of shape {ends[1].shape} do not broadcast"
        ) from error
    memory.require(112 * math.prod(shape[:-1]), f"{math.prod(shape[:-1]):,} rays", PARTS)
    for values, name in zip(ends, (first_name, second_name), strict=True):
        if np.isinf(values).any():
            raise InputError(f"{name} hold infinite numbers: give finite ones, or NaN for no ray")
        if (np.abs(values) > LENGTH_RANGE[1]).any():
            raise InputError(f"{name} hold numbers beyond {LENGTH_RANGE[1]:g}: scale the scene, or the directions")
    left, right = (np.array(np.broadcast_to(values, shape).reshape(-1, 3).T, order="C") for values in ends)
    return left, right, shape[:-1]


def _passes(passes) -> tuple[str, ...]:
    names = arguments.words(passes, "passes", PASSES)
    if absent := [name for name in names if name in WITHOUT_PIXEL]:
        words = "needs a pixel" if len(absent) == 1 else "need a pixel"
        raise InputError(f"{', '.join(absent)} {words}, which a ray has not: the passes of rays are {', '.join(KNOWN)}")
    return names


def _range(near, far) -> tuple[float, float]:
    near, far = arguments.number(near, "near", math.inf), arguments.number(far, "far", math.inf)
    if not 0 <= near <= far:
        raise InputError(f"the range from near = {near:g} to far = {far:g} is invalid: give 0 <= near <= far")
    return near, far


def _require(shapes: Shapes, shape: tuple[int, ...], passes: tuple[str, ...], dtype) -> None:
    if not isinstance(shapes, Shapes):
        raise TypeError(f"rays are cast at shapes as they are read or made, not at {type(shapes).__name__}")
    count = math.prod(shape)
    memory.require(128 * count + image_bytes((1, count), passes, dtype), f"the passes of {count:,} rays", PARTS)


def times_of(shapes: Shapes, times, shape: tuple[int, ...]) -> np.ndarray | None:
    """Return the time of each ray, (n,); None if the shapes have one time."""
    if times is None:
        return None
    frames = arguments.numbers(times, "times")
    try:
        each = np.broadcast_to(frames, shape).reshape(-1)
    except ValueError as error:
        raise InputError(f"times of shape {frames.shape} do not broadcast to rays of shape {shape}") from error
    if not np.isfinite(each).all():
        raise InputError("times hold NaN or infinite numbers: give each ray the frame at which it is cast")
    motion = shapes.motion
    if isinstance(motion, Motion) and each.size:
        first, last = motion.intervals[0].frames[0], motion.intervals[-1].frames[-1]
        if each.min() < first - FRAMES or each.max() > last + FRAMES:
            raise InputError(
                f"times from {each.min():g} to {each.max():g} lie beyond the frames {first:g} to {last:g} at which the "
                "shapes were read: read them over all of these frames"
            )
    return None if shapes.motion is None else each


def _all(shapes, each, origin, direction, shape, passes, span: Span, dtype, threads: int) -> RayImages:
    """Return the passes of all hits, with their rays and the counts of these."""
    parts: list[tuple[RayImages, tuple[np.ndarray, ...]]] = []

    def add(rays: slice) -> None:
        start, ahead, times = _share(rays, each, origin, direction)
        for group in hit_groups(shapes, start, ahead, times, span, passes):
            hits = group.hits
            images = RayImages({name: PASSES[name].empty((1, len(hits.t)), dtype) for name in passes})
            of_hits = start[:, hits.ray], ahead[:, hits.ray]
            group.bodies.write(*of_hits, hits.t, hits.body, images, np.arange(len(hits.t)))
            if "shape_index" in images:
                images["shape_index"][0] = group.row
            parts.append((images, (group.number, group.row, hits.t, rays.start + hits.ray)))

    in_shares(add, origin.shape[1], threads, MOST_RAYS)
    groups, order = zip(*parts, strict=True)
    keys = [np.concatenate(key) for key in zip(*order, strict=True)]
    rank = np.lexsort(keys)
    result = RayImages({name: np.concatenate([images[name][0] for images in groups])[rank] for name in passes})
    ray = keys[-1]
    result["ray"], result["count"] = ray[rank], np.bincount(ray, minlength=origin.shape[1]).reshape(shape)
    result.shapes = shapes
    return result
