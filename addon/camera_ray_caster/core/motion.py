"""Motion between the times at which a scene was evaluated, and at which times it has to be.

Positions go straight, rotations turn at constant speed about one axis, stretch and shear change linearly (polar
decomposition: Shoemake and Duff, Matrix Animation and Polar Decomposition, 1992). Where that is not the motion of the
scene, the difference is measured in pixels and the interval is cut.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from .camera import Camera
from .records import Pose, Shapes

PROBES = (0.381966, 0.618034)
"""Where an interval is probed: the golden section, so that no motion of a simple period hides from all probes."""

WIDEST_TURN = np.pi / 3
"""Rotation between two evaluations, radians: beyond it the interval is cut, since the turn might be another way."""

SHORTEST = 2.0**-10
"""Frames within which the moment is found at which shapes come or go."""


@dataclass(frozen=True)
class Motion:
    """A camera and shapes at some frames, and how well what lies between them is known."""

    frames: tuple[float, ...]
    cameras: tuple[Camera, ...]
    shapes: tuple[Shapes, ...]
    tolerance: float
    """Pixels that were asked for."""
    estimated: float
    """Pixels: the largest difference to be expected in the intervals that were accepted."""
    unresolved: tuple[tuple[float, float], ...]
    """Intervals in which the tolerance is not kept."""

    def camera_at(self, frame: float) -> Camera:
        """Return the camera at a frame, without its clock."""
        k, share = self._interval(frame)
        pair = self.cameras[k : k + 2]
        return replace(pair[0], clock=None, motion=None, pose=_pose_between(pair[0].pose, pair[-1].pose, share))

    def shapes_at(self, frame: float) -> Shapes:
        """Return the shapes at a frame. Where shapes come or go, those of the evaluation before it stand still."""
        k, share = self._interval(frame)
        pair = self.shapes[k : k + 2]
        return _shapes_between(pair[0], pair[-1], share)

    def _interval(self, frame: float) -> tuple[int, float]:
        if len(self.frames) == 1:
            return 0, 0.0
        k = min(max(bisect_right(self.frames, frame) - 1, 0), len(self.frames) - 2)
        return k, (frame - self.frames[k]) / (self.frames[k + 1] - self.frames[k])


def resolve(
    evaluate: Callable[[float], tuple[Camera, Shapes]],
    first: float,
    last: float,
    tolerance: float,
    most: int,
) -> Motion:
    """Evaluate a scene at as few frames as keep what lies between within ``tolerance`` pixels.

    ``evaluate(frame)`` returns camera and shapes; it is called at most ``most`` times. Whole frames are evaluated first
    (keys and cuts lie there) as far as the budget allows; then every interval is probed at two places, and cut where
    the interpolation is off or something turns too far. What the budget leaves is reported as unresolved.
    """
    known: dict[float, tuple[Camera, Shapes]] = {}

    def at(frame: float) -> tuple[Camera, Shapes]:
        if frame not in known:
            known[frame] = evaluate(frame)
        return known[frame]

    whole = np.arange(np.floor(first) + 1, np.ceil(last)).tolist()
    ends = [first, *(whole if len(whole) <= most // 4 else []), last] if last > first else [first]
    waiting = list(pairwise(ends))
    for frame in ends:
        at(frame)
    unresolved, estimated = [], 0.0
    while waiting:
        waiting.sort(key=lambda interval: interval[0] - interval[1])
        a, b = waiting.pop(0)
        probes = [a + (b - a) * place for place in PROBES]
        if len(known) + sum(frame not in known for frame in probes) > most or not a < probes[0] < probes[1] < b:
            unresolved.append((a, b))
            continue
        if not _matched(at(a)[1], at(b)[1]):
            if b - a > SHORTEST:
                waiting += [(a, probes[0]), (probes[0], probes[1]), (probes[1], b)]
            continue
        errors = [_error_between(at(a), at(b), at(frame), (frame - a) / (b - a)) for frame in probes]
        # both probes stay as evaluations: evenly curved motion is then off by a sixth of what it was at them
        left = max(errors) * (0.25 if min(errors) > max(errors) / 2 else 1.0)
        if left > tolerance or _turn_between(at(a), at(b)) > WIDEST_TURN:
            waiting += [(a, probes[0]), (probes[0], probes[1]), (probes[1], b)]
        else:
            estimated = max(estimated, left)
    frames = tuple(sorted(known))
    return Motion(
        frames,
        tuple(known[frame][0] for frame in frames),
        tuple(known[frame][1] for frame in frames),
        tolerance,
        estimated,
        tuple(sorted(unresolved)),
    )


def measure(motion: Motion, evaluate: Callable[[float], tuple[Camera, Shapes]], frames) -> float:
    """Return the largest difference, in pixels, between the interpolation and the scene itself at some frames."""
    return max(
        (_difference(motion.camera_at(f), motion.shapes_at(f), *evaluate(f)) for f in frames),
        default=0.0,
    )


def _error_between(before, after, truth, share: float) -> float:
    """Return how far, in pixels, the interpolation of two evaluations is from a third one."""
    pose = _pose_between(before[0].pose, after[0].pose, share)
    return _difference(replace(before[0], pose=pose), _shapes_between(before[1], after[1], share), *truth)


def _difference(camera: Camera, shapes: Shapes, true_camera: Camera, true_shapes: Shapes) -> float:
    """Return the largest distance in pixels between the images of the shapes' centres and ends of axes.

    Shapes that are not seen by the true camera do not count; where their number differs it is infinite.
    """
    if len(shapes) != len(true_shapes):
        return np.inf
    if len(shapes):
        points, true_points = _landmarks(shapes), _landmarks(true_shapes)
    else:
        points = true_points = _distant_points(true_camera)
    with np.errstate(all="ignore"):
        there = replace(true_camera, clock=None, motion=None).project(true_points)
        here = replace(camera, clock=None, motion=None).project(points)
    raster = true_camera.raster
    size = np.array([raster.width, raster.height])
    counts = (there >= -size).all(axis=-1) & (there <= 2 * size).all(axis=-1)
    apart = np.sqrt(((here - there) ** 2).sum(axis=-1))[counts]
    return float(np.where(np.isnan(apart), np.inf, apart).max(initial=0.0))


def _landmarks(shapes: Shapes) -> np.ndarray:
    """Return the centre and both ends of each axis, (n, 7, 3)."""
    ends = np.swapaxes(shapes.axes, 1, 2)
    return shapes.centre[:, None, :] + np.concatenate((np.zeros_like(ends[:, :1]), ends, -ends), axis=1)


def _distant_points(camera: Camera) -> np.ndarray:
    """Return points before a camera without shapes: so its own motion still counts."""
    return camera.pose.eye + camera.pose.basis @ np.array([0.1, 0.2, -10.0])[None]


def _turn_between(before, after) -> float:
    """Return the largest rotation between two evaluations, radians; 0 for shapes that cannot be matched."""
    turns = [_angle(before[0].pose.basis[None], after[0].pose.basis[None])]
    if _matched(before[1], after[1]):
        turns.append(_angle(before[1].axes, after[1].axes))
    return max(float(turn.max(initial=0.0)) for turn in turns)


def _angle(before, after) -> np.ndarray:
    return _sine_and_angle(_polar(after)[0] @ np.swapaxes(_polar(before)[0], 1, 2))[2]


def _pose_between(before: Pose, after: Pose, share: float) -> Pose:
    basis = _between(before.basis[None], after.basis[None], share)[0]
    return Pose(before.eye + share * (after.eye - before.eye), basis / np.linalg.norm(basis, axis=0))


def _shapes_between(before: Shapes, after: Shapes, share: float) -> Shapes:
    if not _matched(before, after):
        return before
    centre = before.centre + share * (after.centre - before.centre)
    return replace(before, centre=centre, axes=_between(before.axes, after.axes, share))


def _matched(before: Shapes, after: Shapes) -> bool:
    """Whether two evaluations hold the same shapes, row by row."""
    return (
        before.names == after.names
        and np.array_equal(before.kind, after.kind)
        and np.array_equal(before.name_index, after.name_index)
    )


def _between(before, after, share: float) -> np.ndarray:
    """Return matrices between two (n, 3, 3): rotated at constant speed, stretched linearly; equal ones stay exact."""
    same = (before == after).all(axis=(1, 2))
    rotation_0, stretch_0 = _polar(before)
    rotation_1, stretch_1 = _polar(after)
    turn = _rotation_vector(rotation_1 @ np.swapaxes(rotation_0, 1, 2))
    moved = _rotation(share * turn) @ rotation_0 @ (stretch_0 + share * (stretch_1 - stretch_0))
    return np.where(same[:, None, None], before, moved)


def _polar(matrices) -> tuple[np.ndarray, np.ndarray]:
    """Return proper rotations and symmetric stretches (negative for mirrored matrices) whose products these are."""
    left, values, right = np.linalg.svd(matrices)
    sign = np.where(np.linalg.det(left) * np.linalg.det(right) < 0, -1.0, 1.0)[:, None, None]
    return left @ right * sign, np.swapaxes(right, 1, 2) @ (values[:, :, None] * right) * sign


def _rotation_vector(rotation) -> np.ndarray:
    """Return axis times angle, (n, 3), of rotations below a half turn."""
    skew, sine, angle = _sine_and_angle(rotation)
    return skew * np.where(sine > 0, angle / np.where(sine > 0, sine, 1.0), 1.0)[:, None]


def _sine_and_angle(rotation):
    """Return axis times sine (n, 3), sine and angle (n,) of rotations; the angle is 0 .. pi."""
    skew = np.stack(
        [rotation[:, j, i] - rotation[:, i, j] for i, j in ((1, 2), (2, 0), (0, 1))], axis=-1
    ) / 2  # fmt: skip
    sine = np.linalg.norm(skew, axis=1)
    return skew, sine, np.arctan2(sine, (np.trace(rotation, axis1=1, axis2=2) - 1) / 2)


def _rotation(vector) -> np.ndarray:
    """Return the rotations (n, 3, 3) of rotation vectors (Rodrigues)."""
    angle = np.linalg.norm(vector, axis=1)[:, None, None]
    x, y, z = vector.T
    zero = np.zeros_like(x)
    cross = np.stack((zero, -z, y, z, zero, -x, -y, x, zero), axis=-1).reshape(-1, 3, 3)
    half = angle / 2
    return np.eye(3) + np.sinc(angle / np.pi) * cross + np.sinc(half / np.pi) ** 2 / 2 * (cross @ cross)
