"""Cameras to export: turned, off center, shifted, at three frames, with matrices as Blender has them."""

import numpy as np

from camera_ray_caster.core.exports import export_files
from camera_ray_caster.core.exports.format import Shot
from camera_ray_caster.core.exports.rigid import with_rotation

from ..cameras.model_examples import camera

FRAME = {"resolution_x": 640, "resolution_y": 480}
MATRIX = FRAME | {
    "calibration_width": 640, "calibration_height": 480, "fx": 301.25, "fy": 299.5, "cx": 322.125, "cy": 238.75,
}  # fmt: skip
RADTAN = {"k1": -0.03, "k2": 0.004, "p1": 1e-3, "p2": -2e-3}
RATIONAL = RADTAN | {"k3": -1e-3, "k4": 2e-4, "k5": 1e-4, "k6": -1e-5}
PRISM = {"s1": 3e-3, "s2": -1e-3, "s3": -2e-3, "s4": 5e-4}
RADIAL = {"k1": -0.03, "k2": 0.004, "k3": -1e-3, "k4": 2e-4}

CAMERAS = {
    "perspective": ("PERSP", FRAME),
    "shifted": ("PERSP", FRAME | {"shift_x": 0.3, "shift_y": -0.2, "lens": 21.0}),
    "portrait": ("PERSP", FRAME | {"resolution_x": 300, "sensor_fit": "VERTICAL", "pixel_aspect_x": 2.0}),
    "pinhole": ("OPENCV_PINHOLE", MATRIX),
    "radtan": ("OPENCV_PINHOLE", MATRIX | RADTAN),
    "five": ("OPENCV_PINHOLE", MATRIX | RADTAN | {"k3": -1e-3}),
    "rational": ("OPENCV_PINHOLE", MATRIX | RATIONAL),
    "prism": ("OPENCV_PINHOLE", MATRIX | RATIONAL | PRISM),
    "tilted": ("OPENCV_PINHOLE", MATRIX | RATIONAL | PRISM | {"tau_x": 0.05, "tau_y": -0.03}),
    "skewed": ("OPENCV_PINHOLE", MATRIX | {"skew": 3.0}),
    "scaled": ("OPENCV_PINHOLE", MATRIX | RADTAN | {"resolution_x": 320, "resolution_y": 360}),
    "fisheye": ("OPENCV_FISHEYE", MATRIX | RADIAL),
    "blenders_fisheye": ("FISHEYE_EQUIDISTANT", FRAME | {"shift_x": 0.1, "fisheye_fov": 3.5}),
    "stereographic": ("FISHEYE_STEREOGRAPHIC", FRAME | {"shift_y": 0.1}),
    "unified": ("UCM", MATRIX | {"unified_xi": 0.8}),
    "omnidir": ("UCM", MATRIX | RADTAN | {"unified_xi": 1.2, "skew": 1.5}),
    "eucm": ("EUCM", MATRIX | {"unified_alpha": 0.6, "unified_beta": 1.1}),
    "fisheye624": ("FISHEYE624", MATRIX | RADIAL | {"k5": 1e-4, "k6": -1e-5, "p1": 1e-3, "p2": -2e-3} | PRISM),
    "thin_prism": ("THIN_PRISM_FISHEYE", MATRIX | RADTAN | {"k3": -1e-3, "k4": 2e-4, "s1": 3e-3, "s3": -2e-3}),
    "fov": ("FOV", MATRIX | {"fov_omega": 0.9}),
    "division": ("DIVISION", MATRIX | {"division_lambda": -0.2}),
    "panorama": ("EQUIRECTANGULAR", {"resolution_x": 640, "resolution_y": 320}),
    "part": ("EQUIRECTANGULAR", FRAME | {"longitude_min": -1.0, "latitude_max": 0.5, "shift_x": 0.1}),
}  # fmt: skip
"""By name: a model and its settings."""

FRAMES = 1, 12, 10000


def shots(name, frames=FRAMES):
    """A camera of CAMERAS at frames, at each of which it stands and is turned otherwise."""
    key, settings = CAMERAS[name]
    return [Shot(name, frame, camera(key, settings | {"matrix_world": pose(frame)})) for frame in frames]


def pose(frame):
    """A pose for a frame: a rotation and a place, rounded to float32 as Blender's are."""
    random = np.random.default_rng(int(4 * frame))
    rotation = np.linalg.qr(random.normal(size=(3, 3)))[0]
    matrix = np.eye(4)
    matrix[:3, :3] = rotation * np.linalg.det(rotation)
    matrix[:3, 3] = random.uniform(-10, 10, 3)
    return matrix.astype(np.float32).astype(np.float64)


def exported(key, name, folder, frames=FRAMES):
    """Export a camera into a folder, and return what was said."""
    files, remarks = export_files(key, shots(name, frames))
    for file, content in files:
        (folder / file).write_bytes(content if isinstance(content, bytes) else content.encode())
    return remarks


def nearest(name, frames=FRAMES):
    """The camera of each frame with the rotation nearest to its matrix, as formats with poses have it."""
    return [with_rotation(shot.camera)[0] for shot in shots(name, frames)]


def views(name, count=200, frames=FRAMES):
    """For each of ``nearest``: points that it sees, (count, 3), and where, from the top left corner of its frame."""
    seen = []
    for near in nearest(name, frames):
        width, height = near.raster.size
        random = np.random.default_rng(7)
        rays = near.rays_at(random.uniform(0, width, 2 * count), random.uniform(0, height, 2 * count))
        points = (rays.origins + rays.directions * random.uniform(0.5, 20, (2 * count, 1)))[rays.valid][:count]
        assert len(points) == count
        seen.append((points, near.project(points) * (1, -1) + (0, height)))
    return seen
