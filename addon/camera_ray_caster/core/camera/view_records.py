"""Camera records for a window: of a free view, from its matrices, and of a camera's frame at its size on screen."""

from dataclasses import replace

import numpy as np

from ..records import BlenderCamera

SENSOR = 36.0
"""Width of the sensor in mm; any width would do, since the lens is derived from it."""


def view_record(view_matrix, window_matrix, width: int, height: int) -> BlenderCamera:
    """Return the record of a perspective or orthographic view of width x height pixels.

    view_matrix (4, 4): view from world; window_matrix (4, 4): clip from view, as in OpenGL, with any offset. An
    orthographic view whose near plane lies behind its origin is moved back, so that its rays begin at that plane.
    """
    world_from_view = np.linalg.inv(np.asarray(view_matrix, np.float64))
    p = np.asarray(window_matrix, np.float64)
    parallel = p[3, 3] != 0
    if parallel:
        near, far = sorted(((p[2, 3] + 1) / p[2, 2], (p[2, 3] - 1) / p[2, 2]))
        middle = -p[:2, 3]
        back = min(near, 0.0)
        world_from_view[:3, 3] -= back * world_from_view[:3, 2]
        near, far = near - back, far - back
    else:
        near, far = p[2, 3] / (p[2, 2] - 1), p[2, 3] / (p[2, 2] + 1)
        middle = p[:2, 2]
    # the middle of the frame lies at middle / diagonal of the matrix, and its width is 2 / diagonal
    return BlenderCamera(
        name="view",
        type="ORTHO" if parallel else "PERSP",
        matrix_world=world_from_view,
        lens=SENSOR * p[0, 0] / 2,
        ortho_scale=2 / p[0, 0],
        sensor_fit="HORIZONTAL",
        sensor_width=SENSOR,
        shift_x=middle[0] / 2,
        shift_y=middle[1] / p[1, 1] * p[0, 0] / 2,
        clip_start=near,
        clip_end=far,
        resolution_x=width,
        resolution_y=height,
        pixel_aspect_x=1.0,
        pixel_aspect_y=p[0, 0] * width / (p[1, 1] * height),
    )


def frame_record(raw: BlenderCamera, width: int, height: int, seen: tuple[float, float, float, float]) -> BlenderCamera:
    """Return a camera whose whole frame has width x height pixels, and of which only a part is rendered.

    ``seen`` is that part: left, bottom, right, top in fractions of the frame. The camera's own border cuts it further.
    """
    sides = [raw.resolution_x * raw.pixel_aspect_x, raw.resolution_y * raw.pixel_aspect_y]
    parts = [(0.0, 0.0, 1.0, 1.0), seen]
    if raw.use_border:
        parts.append((raw.border_min_x, raw.border_min_y, raw.border_max_x, raw.border_max_y))
    left, bottom, right, top = zip(*parts, strict=True)
    return replace(
        raw,
        resolution_x=width,
        resolution_y=height,
        resolution_percentage=100,
        pixel_aspect_x=1.0,
        pixel_aspect_y=sides[1] / sides[0] * width / height,
        use_border=True,
        border_min_x=max(left),
        border_min_y=max(bottom),
        border_max_x=min(right),
        border_max_y=min(top),
    )
