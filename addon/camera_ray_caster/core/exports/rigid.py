"""The rotation nearest to a camera's axes, for formats that store one.

Blender's matrices are float32: their normalized axes are a rotation to about 1e-7 only. Which pixel sees a point is
then another one by as much, times the focal length in pixels, and that is measured.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..camera.camera import Camera
from ..maths.rotations import polar
from ..records import Pose

SHEARED = 1e-5
"""Of the cosine between two axes: rounding to float32 leaves a hundredth of it."""

PLACES = 9
"""Rows and columns of pixels at which is measured what the rotation moves."""


def refusal(camera: Camera) -> str | None:
    """Return why no rotation is near a camera's axes; None where one is. See ``Format.refusal``."""
    gram = camera.pose.basis.T @ camera.pose.basis
    if np.linalg.det(camera.pose.basis) < 0:
        return "whose axes are mirrored, by a negative scale"
    if np.abs(gram - np.eye(3)).max() > SHEARED:
        return "whose axes are sheared, by a scale of its parents"
    return None


def with_rotation(camera: Camera) -> tuple[Camera, float]:
    """Return the camera whose axes are the nearest rotation, and by how many pixels that moves points at most."""
    near = replace(camera, pose=Pose(camera.pose.eye, polar(camera.pose.basis[None])[0][0]))
    width, height = camera.raster.size
    rays = camera.rays_at(*np.meshgrid(np.linspace(0.5, width - 0.5, PLACES), np.linspace(0.5, height - 0.5, PLACES)))
    points = (rays.origins + rays.directions)[rays.valid]
    moved = near.project(points) - camera.project(points)
    return near, float(np.nanmax(np.hypot(*moved.T), initial=0.0))
