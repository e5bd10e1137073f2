"""What the library does where there is only numpy: two cameras, a mesh and spheres, a cast and back, and an export."""

import sys
from pathlib import Path

import numpy as np

import camera_ray_caster as crc

# A calibrated fisheye above the scene, and a pushbroom scanner that flies over it: a slit is a point and a direction.
pose = crc.look_at(eye=(3.0, -4.0, 2.5), target=(0.0, 0.0, 0.5))
fisheye = crc.camera(
    "OPENCV_FISHEYE", (320, 240), pose, name="fisheye", fx=105.2, fy=105.1, cx=160.3, cy=118.9, k1=0.02, k2=-0.004
)
scanner = crc.camera(
    "PUSHBROOM", (320, 240), crc.look_at((0.0, 0.0, 8.0), (0.0, 0.0, 0.0), up=(0.0, 1.0, 0.0)),
    name="scanner", slit_1=[(0.0, 0.0, 8.0), (0.0, 1.0, 0.0)], lens=40.0, ortho_scale=8.0,
)  # fmt: skip

# A wavy sheet of quads, two balls and the ground.
row, column = np.mgrid[:21, :21]
vertices = np.stack((column / 10 - 1, row / 10 - 1, 0.2 * np.sin(column / 3) + 1), axis=-1).reshape(-1, 3)
corner = (21 * row + column)[:-1, :-1].reshape(-1, 1)
sheet = crc.mesh(vertices, corner + np.array((0, 1, 22, 21)), object_index=1, color=(0.1, 0.4, 0.8), name="sheet")
balls = crc.spheres([(1.5, 0.0, 0.5), (-1.5, 0.0, 0.7)], [0.5, 0.7], object_index=2, name=("small", "large"))
ground = crc.planes((0.0, 0.0, 0.0), infinite=True, name="ground")
shapes = crc.join(sheet, balls, ground)

for camera in (fisheye, scanner):
    images = crc.cast(camera, shapes, passes=("distance", "position", "normal", "shape_index", "position_bound"))
    rays, hit = camera.rays(), images["shape_index"] >= 0
    points = rays.origins[hit] + images["distance"][hit][:, None].astype(np.float64) * rays.directions[hit]
    rows, columns = np.nonzero(hit)
    off = camera.project(points) - np.stack((columns, rows), axis=1) - 0.5  # back to the pixels they came from
    seen = crc.visible(camera, shapes, [(1.5, 0.0, 1.0), (0.0, 0.0, -1.0)])
    print(f"{camera.name}: {hit.mean():.0%} hits, back within {np.abs(off).max():.0e} pixels, {seen}")

print(crc.explain(fisheye, shapes, (160, 120)))
print([path.name for path in crc.export([fisheye, scanner], Path(sys.argv[1]), "json").paths])
