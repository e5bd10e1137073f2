"""The perspective pictures, faces of a cube around the eye, that together hold what a central camera sees.

One face is enough for a camera that sees up to 50 degrees from the middle of its picture to the left, right, top and
bottom. Any other has the faces of a cube around its axes into which it looks, each cut to the window that is seen.
A texel of a face is as small as its pixels need: a pixel covers an ellipse on the face, given by the derivatives of the
ray, whose axes are s1 >= s2. A texel is at most as wide as the smallest s2 of the face's pixels, but where pixels are
very flat, as at the poles of a panorama, as half of s1: finer texels would hold no more of the picture's detail.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import atan, degrees, tan

import numpy as np

from ..camera.camera import Camera
from ..records import InputError
from .lens_points import LensPoint

WIDEST = tan(np.radians(50.0))
"""Half the width of the widest face, on the plane one unit ahead."""
SIDE_PARTS = 64
"""Parts along each side of the frame at whose ends rays are looked at."""
FINEST = 0.02
"""Share of a face's pixels that may be finer than its texels: single rays at a kink make no face larger."""
FLATTEST = 0.5
"""Least s2 / s1 that texels follow."""
TEXEL_MARGIN = 2.0
"""Texels of a face beyond what is seen, for its filter."""
LEAST_SIDE = 8
"""Least side of a face in texels."""
Part = tuple[float, float, float, float]

AHEAD = np.eye(3)
SIDES = tuple(
    np.array(rows, np.float64) for rows in (
        ((1, 0, 0), (0, 1, 0), (0, 0, 1)), ((0, 0, 1), (0, 1, 0), (-1, 0, 0)), ((0, 0, -1), (0, 1, 0), (1, 0, 0)),
        ((1, 0, 0), (0, 0, 1), (0, -1, 0)), ((1, 0, 0), (0, 0, -1), (0, 1, 0)), ((-1, 0, 0), (0, 1, 0), (0, 0, -1)),
    )
)  # fmt: skip
"""Axes of the faces ahead, right, left, up, down and behind."""


@dataclass(frozen=True, eq=False)
class Face:
    """A perspective picture from the eye."""

    axes: np.ndarray
    """(3, 3): its directions right, up and back, as rows, in the frame of the faces."""
    window: tuple[float, float, float, float]
    """Left, right, bottom and top on its plane one unit ahead."""
    size: tuple[int, int]
    """Width and height in texels."""

    @property
    def reach(self) -> float:
        """The greatest distance from the eye of the window's points, whose depth is 1."""
        left, right, bottom, top = self.window
        return float(np.sqrt(1 + max(left * left, right * right) + max(bottom * bottom, top * top)))

    @property
    def angles(self) -> tuple[float, float]:
        """Width and height of the window, in degrees."""
        left, right, bottom, top = map(atan, self.window)
        return degrees(right - left), degrees(top - bottom)

    def places(self, directions: np.ndarray) -> np.ndarray:
        """Return where directions (..., 3) in the frame of the faces meet the picture, (..., 2) in texels from its
        bottom left corner; of no meaning for directions that lead behind it.
        """
        x, y, back = np.moveaxis(directions @ self.axes.T, -1, 0)
        left, right, bottom, top = self.window
        with np.errstate(all="ignore"):
            u, v = x / -back, y / -back
        width, height = self.size
        return np.stack(((u - left) / (right - left) * width, (v - bottom) / (top - bottom) * height), axis=-1)


def turn_of(camera: Camera) -> np.ndarray:
    """Return the frame of a camera's faces, (3, 3), whose columns are its x, y and z in the world: the camera's axes
    made perpendicular, also those of a sheared or mirrored camera.
    """
    back = camera.pose.basis[:, 2] / np.linalg.norm(camera.pose.basis[:, 2])
    up = camera.pose.basis[:, 1] - back * (back @ camera.pose.basis[:, 1])
    up /= np.linalg.norm(up)
    return np.stack((np.cross(up, back), up, back), axis=1)


def refusal(camera: Camera) -> str:
    """Return why a camera's picture is not a warp of perspective pictures; "" if it is."""
    if not camera.model.central:
        return f"{camera.model.label} has no single viewpoint"
    return "" if camera.model.differentiable else f"the pixels of {camera.model.label} are single beams"


def faces_of(
    camera: Camera, pixel: float = 1.0, largest: int = 4096, region: Part | None = None, lens: LensPoint | None = None
) -> tuple[Face, ...]:
    """Return the faces that hold a camera's picture; none if no pixel has a ray.

    pixel: side of a pixel of the picture that is made of them, in pixels of the camera. largest: side of a face at
    most. region: left, bottom, right and top of the pixels that are needed; default the full frame. lens: the point of
    the aperture from which the faces are seen; default its center. The frame of the faces is that of ``turn_of``.
    Raises InputError for a camera that has a ``refusal``.
    """
    if reason := refusal(camera):
        raise InputError(f"{reason}: its picture is not a warp of perspective pictures")
    left, bottom, right, top = region or (0.0, 0.0, *camera.raster.size)
    directions, by_x, by_y = _seen(
        camera, np.linspace(left, right, SIDE_PARTS + 1), np.linspace(bottom, top, SIDE_PARTS + 1)
    )
    if not len(directions):
        return ()
    if lens is not None:
        directions = lens.directions(directions)
    steps = (right - left) / SIDE_PARTS, (top - bottom) / SIDE_PARTS
    reach = np.hypot(*(np.linalg.norm(by, axis=-1) * step for by, step in zip((by_x, by_y), steps, strict=True)))
    only = _face(AHEAD, directions, by_x, by_y, reach, pixel, largest, WIDEST)
    if only is not None and _holds_all(directions, reach):
        return (only,)
    every = (_face(axes, directions, by_x, by_y, reach, pixel, largest, 1.0) for axes in SIDES)
    return tuple(face for face in every if face is not None)


def chosen(faces: Sequence[Face], directions: np.ndarray) -> np.ndarray:
    """Return the place in ``faces`` of the face that each direction (..., 3) meets nearest to its middle."""
    return np.argmin([directions @ face.axes[2] for face in faces], axis=0)


def _seen(camera: Camera, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return unit directions of a camera's rays at a grid of columns and rows and their derivatives by x and y, (n, 3)
    each, in the frame of the faces; only those that are finite.
    """
    still, (x, y) = replace(camera, pixel_time=None), np.meshgrid(x, y)
    with np.errstate(all="ignore"):
        directions, by = still.rays_at(x, y).directions, still.rays_jacobian_at(x, y).directions
    turn = turn_of(camera)
    three = [vectors.reshape(-1, 3) @ turn for vectors in (directions, by[..., 0], by[..., 1])]
    good = np.isfinite(three).all(axis=(0, 2))
    directions, by_x, by_y = (vectors[good] for vectors in three)
    return directions, by_x, by_y


def _holds_all(directions: np.ndarray, reach: np.ndarray) -> bool:
    """Return whether one face ahead holds what is around these directions."""
    return bool((np.abs(directions[:, :2]).max(axis=1) + reach <= (-directions[:, 2] - reach) * WIDEST).all())


def _face(axes, directions, by_x, by_y, reach, pixel: float, largest: int, widest: float) -> Face | None:
    """Return the face of these axes, up to ``widest`` from its middle; None if nothing is seen in it.

    reach: angle around each direction, up to the next ones, that may be seen, too.
    """
    local = directions @ axes.T
    ahead = -local[:, 2]
    inside = np.abs(local[:, :2]).max(axis=1) - reach <= (ahead + reach) * widest
    inside &= ahead > 0
    if not inside.any():
        return None
    local, ahead, reach = local[inside], ahead[inside], reach[inside]
    slopes = local[:, :2] / ahead[:, None]
    around = (reach / ahead * np.sqrt(1 + (slopes * slopes).sum(axis=1)))[:, None]
    ends = (slopes - around).min(axis=0), (slopes + around).max(axis=0)
    low, high = (np.clip(end, -widest, widest) for end in ends)
    if not (low < high).all():
        return None
    moves = [(derivatives[inside] @ axes.T) for derivatives in (by_x, by_y)]
    (a, c), (b, d) = (((move[:, :2] + slopes * move[:, 2:]) / ahead[:, None]).T for move in moves)
    texel = pixel * _needed(a, b, c, d)
    low, high = np.maximum(low - TEXEL_MARGIN * texel, -WIDEST), np.minimum(high + TEXEL_MARGIN * texel, WIDEST)
    size = [int(side) for side in np.clip(np.ceil((high - low) / texel), LEAST_SIDE, largest)]
    return Face(axes, (float(low[0]), float(high[0]), float(low[1]), float(high[1])), (size[0], size[1]))


def _needed(a, b, c, d) -> float:
    """Return the side of a texel for pixels with the derivatives [[a, b], [c, d]] on the plane of a face."""
    size, area = np.hypot(np.hypot(a, b), np.hypot(c, d)), np.abs(a * d - b * c)
    with np.errstate(all="ignore"):
        # the squares of s1 and s2 have the sum size^2 and the product area^2
        first = np.sqrt((size * size + np.sqrt(np.maximum(size**4 - 4 * area * area, 0))) / 2)
        each = np.maximum(area / first, FLATTEST * first)
    return float(np.quantile(each[np.isfinite(each) & (each > 0)], FINEST, method="lower"))
