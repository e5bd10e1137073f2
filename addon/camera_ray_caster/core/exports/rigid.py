"""The rotation nearest to a camera's axes, for formats that store a rotation.

Blender's matrices are float32: their normalized axes are a rotation only to about 1e-7. The rotation therefore moves
points in the picture by about 1e-7 times the focal length in pixels; the module measures by how much.
"""

from dataclasses import replace

import numpy as np

from ..camera.camera import Camera
from ..cameras.parts.pose import SHEARED
from ..maths.rotations import polar
from ..records import Pose

PLACES = 9
"""Number of rows and of columns of pixels at which the effect of the rotation is measured."""


def refusal(camera: Camera) -> str | None:
    """Return the reason why no rotation is near a camera's axes; None if one is. See ``Format.refusal``."""
    gram = camera.pose.basis.T @ camera.pose.basis
    if np.linalg.det(camera.pose.basis) < 0:
        return "whose axes are mirrored, by a negative scale"
    if np.abs(gram - np.eye(3)).max() > SHEARED:
        return "whose axes are sheared, by a scale of its parents"
    return None


def near(camera: Camera) -> Camera:
    """Return the camera whose axes are the nearest rotation."""
    return replace(camera, pose=Pose(camera.pose.eye, polar(camera.pose.basis[None])[0][0]))


def with_rotation(camera: Camera) -> tuple[Camera, float]:
    """Return ``near`` of a camera, and the largest movement of a point by it in pixels."""
    rotated = near(camera)
    width, height = camera.raster.size
    rays = camera.rays_at(*np.meshgrid(np.linspace(0.5, width - 0.5, PLACES), np.linspace(0.5, height - 0.5, PLACES)))
    points = (rays.origins + rays.directions)[rays.valid]
    moved = rotated.project(points) - camera.project(points)
    return rotated, float(np.nanmax(np.hypot(*moved.T), initial=0.0))
