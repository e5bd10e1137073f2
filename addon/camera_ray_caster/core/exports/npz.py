"""numpy's NPZ: the rays of every pixel of the render window, of any camera.

origins and directions (rows, columns, 3) float64 in the world, directions of unit length and NaN where there is no ray;
valid (rows, columns) bool; time (rows, columns), the frame of each pixel, where pixels have their own. Row 0 is the
bottom row.
"""

from __future__ import annotations

from io import BytesIO

import numpy as np

from .format import Format


class Npz(Format):
    """A file a camera and frame."""

    key = "npz"
    label = "Ray Maps (NPZ)"
    description = "<camera>_<frame>.npz: the origin and the direction of every pixel's ray, of any camera"

    def refusal(self, shot):
        """See Format."""
        return None

    def unsaid(self, shot):
        """See Format: only the chief rays of a lens."""
        return super().unsaid(shot)[: shot.camera.aperture is not None]

    def files(self, shots):
        """See Format."""
        for shot in shots:
            rays = shot.camera.rays()
            own = {} if rays.time is None else {"time": rays.time}
            content = BytesIO()
            np.savez(content, origins=rays.origins, directions=rays.directions, valid=rays.valid, **own)
            yield f"{shot.stem}.npz", content.getvalue()
