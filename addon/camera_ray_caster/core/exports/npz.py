"""numpy's NPZ: the ray of every pixel of the render window, for any camera.

origins and directions are (rows, columns, 3) float64 in the world; directions have unit length, and are NaN where there
is no ray. valid is (rows, columns) bool, pose the (4, 4) matrix from the camera's frame to the world, area the left,
bottom, right and top end of the window in fractions of the frame: with these the file is a calibration file of the Ray
Table, a camera that has these rays and may be moved. time, the frame of each pixel (rows, columns), is stored if pixels
have their own times. Row 0 is the bottom row.
"""

from io import BytesIO

import numpy as np

from . import rigid
from .format import Format


class Npz(Format):
    """One file per camera and frame."""

    key = "npz"
    label = "Ray Maps (NPZ)"
    description = "<camera>_<frame>.npz: the origin and the direction of every pixel's ray, of any camera"

    def refusal(self, shot):
        return None

    formula = False

    def omissions(self, shot):
        """See Format. The render border is in the files, so that only depth of field is missing."""
        return super().omissions(shot)[: shot.camera.aperture is not None]

    def files(self, shots):
        for shot in shots:
            rays = shot.camera.rays()
            times = {} if rays.time is None else {"time": rays.time}
            pose, content = np.eye(4), BytesIO()
            pose[:3, 3] = shot.camera.pose.eye
            if rigid.refusal(shot.camera) is None:  # readers refuse mirrored and sheared axes; rays are in the world
                pose[:3, :3] = shot.camera.pose.basis
            raster = shot.camera.raster
            area = np.array((raster.x0, raster.y0, raster.x1, raster.y1)) / (raster.size * 2)
            rays_by_name = {"origins": rays.origins, "directions": rays.directions, "valid": rays.valid}
            np.savez(content, **rays_by_name, pose=pose, area=area, **times)
            yield f"{shot.stem}.npz", content.getvalue()
