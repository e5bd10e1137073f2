"""A camera's rays compared with Blender's own answers on where its pixels look: errors and their bounds.

Blender's functions are independent references. They compute in float32, so each bound is (number of rounded operations
in the function's own code) x 2^-24 x (magnitude they act on). M is the largest offset of the frame's edges from the
optical axis, in pixels (half the frame, and more with shift). The numbers of rounded operations are:

view_frame             aspect 3, half side 1, shift 1, sum or depth 1: 6 M.
calc_matrix_camera     pixel size 5 (sensor, near plane, lens, aspect); left and right edge each 4 (shift 1, its unit 2,
                       sum 1), times pixel size 2; their sum, their difference, both divisions and the aspect once
                       more 7: 18 M. An error common to all is counted once: it stretches the frame.
world_to_camera_view   the local point: axes normalized 5, cofactors 2, determinant 8, division and products 2, sum
                       1, the point given as float32 1, and axes tilted by their rounding 2: 21 (|eye| + |point|) /
                       det^2, at the point's depth. Here |.| is the sum of magnitudes, and det is the volume of the
                       unit axes (1 unless sheared). Its frame: 6 as above and 2 for scaling to the depth: 8 M; 1 for
                       the result.

A reference is not compared if its own arithmetic has overflowed or has lost digits below float32's smallest normal
number.
Reference for the operations: Blender's camera.cc, mathutils and bpy_extras; see Higham (conventions.gamma) for sums.
"""

from dataclasses import dataclass
from typing import Protocol, Self

import numpy as np

from ..conventions import EPS32, gamma
from ..maths.vector import inverse
from ..records import Finding
from .sample import CameraRays, Sample, angles_between, finding, length_of, not_compared

NOT_CARRIED = "Blender's own float32 arithmetic cannot represent these numbers"

LEAST_NORMAL = float(np.finfo(np.float32).tiny)
"""Smallest normal float32; smaller numbers have fewer digits."""
FRAME, MATRIX, VIEW = "view_frame", "calc_matrix_camera", "world_to_camera_view"


class Witness(Protocol):
    """Blender's answers for one camera; see ``blender.verification.blender_witness``."""

    size: tuple[int, int]
    matrix_world: np.ndarray
    frame: np.ndarray
    matrix: np.ndarray

    def view_coordinates(self, points: np.ndarray) -> np.ndarray:
        """Return the view coordinates of world points, (n, 3) each; NaN where Blender's arithmetic fails."""


def findings_of(camera: CameraRays, sample: Sample, witness: Witness, margin) -> list[Finding]:
    """Return one finding on the rays for each of Blender's functions.

    margin: bounds of our own rounding in a round trip, in pixels and radians.
    """
    with np.errstate(all="ignore"):  # a wrong ray may miss the frame's plane, or a bound exceed float64
        local = _Local.of(witness)
        if not local.is_carried:
            return [not_compared(name, NOT_CARRIED) for name in (FRAME, MATRIX, VIEW)]
        of_sample = _matrix(sample, local, margin), _view_coordinates(sample, local, margin)
        return [_view_frame(camera, local, margin), *of_sample]


@dataclass(frozen=True)
class _Local:
    """A reference with the values derived from it: the camera's axes and the pixel size on the frame."""

    witness: Witness
    size: np.ndarray
    eye: np.ndarray
    axes: np.ndarray
    """(3, 3): columns of the world matrix, each of unit length."""
    parallel: bool
    """Whether the reference's rays are parallel: its projection matrix divides by a constant."""
    depth: float
    """Depth of the frame; 1 for parallel rays, whose frame has the same size at every depth."""
    pitch: np.ndarray
    """Size of a pixel on the frame, (2,)."""
    reach: np.ndarray
    """Largest offset of the frame's edges from the axis, (2,)."""

    @classmethod
    def of(cls, witness) -> Self:
        linear = witness.matrix_world[:3, :3]
        linear = linear / np.abs(linear).max(axis=0)
        size = np.array(witness.size, np.float64)
        parallel = bool(witness.matrix[3, 3] != 0)
        return cls(
            witness,
            size,
            witness.matrix_world[:3, 3],
            linear / np.linalg.norm(linear, axis=0),
            parallel,
            1.0 if parallel else -witness.frame[0, 2],
            (witness.frame[0] - witness.frame[2])[:2] / size,
            np.abs(witness.frame[:, :2]).max(axis=0),
        )

    @property
    def is_carried(self) -> bool:
        """Whether frame and matrices are finite, and the frame is large enough for float32's full precision."""
        answers = self.witness.frame, self.witness.matrix, self.witness.matrix_world
        return all(np.isfinite(answer).all() for answer in answers) and bool((self.reach >= LEAST_NORMAL).all())

    @property
    def condition(self) -> float:
        return float(np.linalg.cond(self.axes))

    def rays(self, origins, directions):
        """Return world rays in the camera's frame."""
        from_world = inverse(self.axes).T
        return (origins - self.eye) @ from_world, directions @ from_world

    def angles(self, directions, camera_directions):
        """Return the angles between world directions and the reference's directions.

        The reference's directions are in the camera's frame and have any length.
        """
        expected = camera_directions @ self.axes.T
        return angles_between(directions, expected / length_of(expected)[:, None])

    def direction_bound(self, camera_directions, rounding):
        """Return the turns (radians) of directions if their x and y at the frame are off by ``rounding`` (2,)."""
        if self.parallel:
            return 0.0
        x, y, z = (camera_directions / -camera_directions[:, 2:]).T
        turn = np.hypot(*rounding) + np.abs(x) * rounding[1] + np.abs(y) * rounding[0]
        return self.condition * turn / self.depth / (x * x + y * y + z * z)


def _view_frame(camera: CameraRays, local: _Local, margin) -> Finding:
    """Compare the rays through the corners, edge midpoints and center of the full frame with view_frame's corners."""
    u, v = (a.ravel() for a in np.meshgrid((0.0, 0.5, 1.0), (0.0, 0.5, 1.0)))
    rays = camera.rays_at(*(np.stack((u, v)) * local.size[:, None]))
    weights = np.stack((u * v, u * (1 - v), (1 - u) * (1 - v), (1 - u) * v), axis=1)
    expected = weights @ local.witness.frame
    origin, direction = local.rays(rays.origins, rays.directions)
    met = origin + direction * ((expected[:, 2:] - origin[:, 2:]) / direction[:, 2:])
    errors = (met - expected)[:, :2] / local.pitch
    rounding = gamma(6, EPS32) * local.reach
    aim = np.broadcast_to((0.0, 0.0, -1.0), expected.shape) if local.parallel else expected
    turned = local.direction_bound(aim, rounding)
    angles = local.angles(rays.directions, aim)
    return finding(FRAME, errors, angles, np.hypot(*(rounding / local.pitch)), turned, margin)


def _matrix(sample: Sample, local: _Local, margin) -> Finding:
    """Compare the rays with the projection matrix: the pixels of their points, and the matrix's own rays of pixels."""
    matrix = local.witness.matrix
    origin, direction = local.rays(sample.origins, sample.directions)
    clip = (origin + direction * sample.distance) @ matrix[:, :3].T + matrix[:, 3]
    errors = (clip[:, :2] / clip[:, 3:] + 1) * local.size / 2 - sample.pixels
    view = 2 * sample.pixels / local.size - 1
    planes = matrix[:2, :3] - view[:, :, None] * matrix[3, :3]  # the planes of the pixel's column and row
    expected = np.cross(planes[:, 1], planes[:, 0])
    rounding = gamma(18, EPS32) * local.reach
    turned = local.direction_bound(expected, rounding)
    angles = local.angles(sample.directions, expected)
    return finding(MATRIX, errors, angles, np.hypot(*(rounding / local.pitch)), turned, margin)


def _view_coordinates(sample: Sample, local: _Local, margin) -> Finding:
    """Compare points along the rays, and for parallel rays also their origins, with world_to_camera_view."""
    pixels, path, lost, lost_pixels = _view(local, sample.points)
    errors = pixels - sample.pixels
    if local.parallel:
        pixels, start, lost_at_start, _ = _view(local, sample.origins)
        errors = np.concatenate((errors, pixels - sample.pixels))
        path, lost = path - start, lost + lost_at_start
    answered = np.isfinite(errors).reshape(-1, *sample.pixels.shape).all(axis=(0, 2))
    turned = local.condition * length_of(lost) / length_of(path)
    if (np.isfinite(sample.points).all(axis=1) & ~(answered & np.isfinite(turned))).any():
        return not_compared(VIEW, NOT_CARRIED)
    return finding(VIEW, errors, local.angles(sample.directions, path), length_of(lost_pixels), turned, margin)


def _view(local: _Local, points):
    """Return where world_to_camera_view sees world points (n, 3), and how much float32 can lose.

    The four arrays are the pixels (n, 2), the points in the camera's frame that the answer implies (n, 3), and the
    possible loss of each component of these points (n, 3) and of the pixels (n, 2).
    """
    view = local.witness.view_coordinates(points.astype(np.float32))
    exact = (points - local.eye) @ inverse(local.axes).T
    if local.parallel:
        seen_scale, scale, slope = np.ones((len(points), 1)), np.ones((len(points), 1)), 0.0
    else:
        seen_scale, scale = view[:, 2:] / local.depth, -exact[:, 2:] / local.depth
        slope = np.abs(exact[:, :2] / exact[:, 2:])
    plane = local.witness.frame[2, :2] + view[:, :2] * local.pitch * local.size
    magnitude = np.abs(local.eye).sum() + np.abs(points).sum(axis=1, keepdims=True)
    moved = gamma(21, EPS32) * magnitude / np.linalg.det(local.axes) ** 2
    frame = gamma(8, EPS32) * local.reach + EPS32 * local.pitch * local.size
    lost = moved * (1 + slope) + frame * np.abs(scale)
    return (
        view[:, :2] * local.size,
        np.concatenate((plane * seen_scale, -view[:, 2:]), axis=1),
        np.concatenate((lost, moved + EPS32 * np.abs(exact[:, 2:])), axis=1),
        lost / np.abs(scale) / local.pitch,
    )
