"""Exact derivatives: of rays with respect to the pixel, and of pixels with respect to the points that they see.

For every model they follow from its own formula, which is recorded and differentiated (``core.maths.recording``).
With o and d the origin and the direction of a ray in the camera's frame, o' and d' their derivatives by a coordinate of
the pixel, and B the camera's axes:
    The unit direction B d / |B d| has the derivative (cof(B) (d x d')) x B d / |B d|^3, with cof(B) the cofactors of B:
    the part of d' along d drops out without cancellation, for any length of d.
    A pixel covers the solid angle |det B  d . (d_x x d_y)| / |B d|^3, and at t along the ray the area
    |det B  d . (v_x x v_y)| / |B d| perpendicular to the ray, v = o' + t d'.
    A point p = o + t d moves its pixel by (v_y x d) . dp / D in x and (d x v_x) . dp / D in y, D = d . (v_x x v_y):
    Cramer's rule for the implicit function.
    A setting by which the ray changes, o_s and d_s, moves the pixel as a point would that moves by -(o_s + t d_s). Here
    the settings' derivatives begin in the model's ``from_blender`` (``maths.recording.varied``).
Rounding: the error of a direction's derivative is at most 16 EPS of its length; that of an origin's, 16 EPS of the
length of both derivatives; that of a pixel's with respect to points, 16 EPS of its length times the distances of the
point and of the ray's origin from the world's origin over t. A move of the pixel by ``Model.pixel_rounding`` adds its
own effect, which is the largest part where rays turn ever faster, as at the rim of a mirror ball. Where a formula has a
kink, as between two stretches of a strip camera's path, the derivatives are one-sided.
Reference: H. Igehy, Tracing Ray Differentials, SIGGRAPH 1999.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from ..cameras.model import Model
from ..maths.recording import differentiate
from ..maths.speed import lazy
from ..maths.vector import (
    ALL,
    along,
    cofactors,
    components,
    cross,
    cut,
    difference,
    dot,
    inverse,
    is_grid,
    matvec,
    norm,
)
from ..records import Pose, RaysJacobian
from .pixel_coordinates import in_blocks

BLOCK_PIXELS = 1 << 14
"""Number of pixels differentiated at once: half as many or four times as many take 1.0 to 1.6 times the time."""


class RayDerivatives:
    """The chief rays at pixel coordinates and their derivatives; vectors are three components that broadcast."""

    def __init__(self, model: Model, pose: Pose, x, y, parameters: int = 0):
        """Differentiate at x and y, arrays that broadcast, and by the parameters of a model of varied numbers."""
        numbers = differentiate(model.recorded, (x, y), parameters)
        self.pose = pose
        self.origin, self.direction = (tuple(number.value for number in three) for three in (numbers[:3], numbers[3:]))
        self.origin_by, self.direction_by = (
            [
                tuple(0.0 if number.partials[k] is None else number.partials[k] for number in three)
                for k in range(2 + parameters)
            ]
            for three in (numbers[:3], numbers[3:])
        )

    @lazy
    def length(self) -> Any:
        """The length of the direction in the world."""
        return norm(matvec(self.pose.basis, self.direction))

    @lazy
    def _cube(self) -> Any:
        return self.length * self.length * self.length  # a power takes ten times as long

    @property
    def origins(self) -> list[Any]:
        """The derivatives of the world's origins, by x and by y."""
        return [matvec(self.pose.basis, derivative) for derivative in self.origin_by]

    @property
    def directions(self) -> list[Any]:
        """The derivatives of the world's unit directions, by x and by y."""
        crossed = (cross(self.direction, derivative) for derivative in self.direction_by)
        turned = (matvec(cofactors(self.pose.basis), product) for product in crossed)
        ahead = matvec(self.pose.basis, self.direction)
        return [tuple(component / self._cube for component in cross(product, ahead)) for product in turned]

    @property
    def solid_angle(self) -> Any:
        """The solid angle of a pixel, steradians, to first order."""
        return self._volume(self.direction_by) / self._cube

    def area_at(self, distance: Any) -> Any:
        """Return the area perpendicular to the ray that a pixel covers at a distance in the world, to first order."""
        return self._volume(self._at(distance / self.length)) / self.length

    def by_point(self, point: Any) -> tuple[Any, Any]:
        """Return the derivatives of the pixel's x and y with respect to the seen points, all in the camera's frame."""
        by_x, by_y = self._at(self._place(point))[:2]
        to_x, to_y = cross(by_y, self.direction), cross(self.direction, by_x)
        volume = dot(by_x, to_x)
        return tuple(component / volume for component in to_x), tuple(component / volume for component in to_y)

    def by_parameters(self, point: Any) -> list[list[Any]]:
        """Return the derivatives of the pixel's x and y by the parameters, two lists, where it sees the points."""
        moves = self._at(self._place(point))[2:]
        return [[-dot(gradient, move) for move in moves] for gradient in self.by_point(point)]

    def _place(self, point: Any) -> Any:
        """Return the t at which rays are nearest to the points."""
        return dot(difference(point, self.origin), self.direction) / dot(self.direction, self.direction)

    def _at(self, t: Any) -> list[Any]:
        """Return the derivatives of the points of the rays at t: by x, by y and by each parameter."""
        return [along(o, d, t) for o, d in zip(self.origin_by, self.direction_by, strict=True)]

    def _volume(self, sides: list[Any]) -> Any:
        """Return the volume in the world of the parallelepiped of the direction and two sides in the camera's frame."""
        basis = self.pose.basis
        return np.abs(dot(basis[0], cofactors(basis)[0]) * dot(self.direction, cross(*sides)))


def of_rays(model: Model, pose: Pose, x, y, shape: tuple[int, ...]) -> RaysJacobian:
    """Return the derivatives of rays at coordinates that broadcast to a shape; see ``Camera.rays_jacobian_at``."""
    directions = np.empty((*shape, 3, 2))
    origins = np.broadcast_to(0.0, directions.shape) if model.central else np.empty(directions.shape)
    if not (is_grid(x, y) and len(shape) == 2):
        x, y = (np.broadcast_to(coordinate, shape).reshape(-1, 1) for coordinate in (x, y))
    picture = np.broadcast_shapes(x.shape, y.shape)
    lost = ~(np.isfinite(x) & np.isfinite(y))

    def put(rows: slice) -> None:
        window = rows, ALL
        with np.errstate(all="ignore"):  # NaN means no ray
            rays = RayDerivatives(model, pose, cut(x, window), cut(y, window))
            none = lost[rows] | np.isnan(rays.length)
            for result, vectors in ((directions, rays.directions), (origins, rays.origins)):
                if result is origins and model.central:
                    continue
                block = result.reshape(*picture, 3, 2)[rows]
                for k, vector in enumerate(vectors):
                    for axis, component in enumerate(vector):
                        block[..., axis, k] = component
                block[none] = np.nan

    in_blocks(put, picture, BLOCK_PIXELS)
    return RaysJacobian(origins, directions)


def of_projection(model: Model, pose: Pose, points: np.ndarray, pixels: np.ndarray) -> np.ndarray:
    """Return the derivatives (n, 2, 3) of the pixels (n, 2) that see world points (n, 3), with respect to the points.

    NaN if the pixel is NaN or has no ray; not finite if all pixels of a line see the point.
    """
    camera_from_world = inverse(pose.basis)

    def by_point(rays: RayDerivatives, local) -> Any:
        return [matvec(camera_from_world.T, gradient) for gradient in rays.by_point(local)]

    return _of_pixels(by_point, model, 0, pose, points, pixels, 3)


def of_settings(varied: Model, count: int, pose: Pose, points: np.ndarray, pixels: np.ndarray) -> np.ndarray:
    """Return the derivatives (n, 2, count) of the pixels (n, 2) that see world points (n, 3), by the ``count``
    parameters of a model of varied numbers.

    NaN if the pixel is NaN or has no ray; not finite if all pixels of a line see the point.
    """
    return _of_pixels(RayDerivatives.by_parameters, varied, count, pose, points, pixels, count)


def _of_pixels(derivatives: Callable, model: Model, parameters: int, pose: Pose, points, pixels, width: int):
    """Return (n, 2, width) derivatives of pixels, which a function gives of the rays and the points in the camera's
    frame, two rows of them; NaN for pixels that are NaN.
    """
    result = np.empty((len(points), 2, width))
    camera_from_world = inverse(pose.basis)

    def put(block: slice) -> None:
        with np.errstate(all="ignore"):  # NaN means no pixel
            local = components((points[block] - pose.eye) @ camera_from_world.T)
            rays = RayDerivatives(model, pose, pixels[block, 0], pixels[block, 1], parameters)
            for row, columns in enumerate(derivatives(rays, local)):
                for column, values in enumerate(columns):
                    result[block, row, column] = values
        result[block][np.isnan(pixels[block]).any(axis=1)] = np.nan

    in_blocks(put, (len(points), 1), BLOCK_PIXELS // 4 if parameters else BLOCK_PIXELS)
    return result
