"""The benchmark by camera model: ray generation against a plain fill, and 1,000 spheres against the pinhole.

The fill writes existing arrays of the same size: the directions, and the origins if there is more than one. ``np.full``
allocates these arrays first, as ``rays`` does. The cameras are those of the contract test, at the requested size, and
eyes of spherical stereo for each lens: without a pole merge, with one at Blender's own angles (60 and 75 degrees), and
with one that starts lower (23 and 69 degrees).
"""

from __future__ import annotations

import sys
from pathlib import Path
from time import perf_counter

import numpy as np

from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cast import cast

from . import contenders as c

SPHERES = 1_000

FRAME = {"calibration_width": 96, "calibration_height": 54}
LENSES = {
    "OPENCV_PINHOLE": {"k1": -0.28, "k2": 0.07, "p1": 1e-3, "p2": -5e-4, "k3": 0.01, **FRAME},
    "OPENCV_FISHEYE": {"k1": 0.05, "k2": 0.01, "k3": -0.003, "k4": -1e-4, **FRAME},
    "UCM": {"unified_xi": 0.9, "k1": -0.05, "k2": 0.01, "p1": 1e-3, "p2": -5e-4, **FRAME},
    "EUCM": {"unified_alpha": 0.6, "unified_beta": 1.1, **FRAME},
    "DOUBLE_SPHERE": {"unified_xi": -0.2, "unified_alpha": 0.57, **FRAME},
    "FISHEYE624": {
        "k1": 0.4, "k2": -0.5, "k3": 0.25, "k4": 1.2, "k5": -1.7, "k6": 0.6, "p1": 4e-4, "p2": -2e-4,
        "s1": -6e-4, "s2": -2e-4, "s3": 9e-4, "s4": 1e-5, **FRAME,
    },
    "THIN_PRISM_FISHEYE": {"k1": -0.03, "k2": 0.01, "p1": 1e-3, "p2": -5e-4, "s1": 2e-3, "s3": -1e-3, **FRAME},
    "FOV": {"fov_omega": 0.9, **FRAME},
    "RADIAL_POLYNOMIAL": {"radial_polynomial": "0 1 -0.04 -0.03 0.004", **FRAME},
    "DIVISION": {"division_lambda": -0.3, **FRAME},
    "FTHETA": {"ftheta_angle_to_radius": "0 58 0.5 -1.5 0.3", "ftheta_c": 1.001, "ftheta_d": 1e-3, **FRAME},
    "OCAM": {"ocam_polynomial": "-40 0 0.008 1e-5 2e-7", "ocam_c": 0.999, "ocam_d": 1e-3, **FRAME},
}  # fmt: skip
"""Settings of calibrated lenses, by model: realistic distortions."""

STEREO_LENSES = (
    "PERSP", "EQUIRECTANGULAR", "EQUIANGULAR_CUBEMAP_FACE", "CENTRAL_CYLINDRICAL", "MIRRORBALL", "FISHEYE_EQUIDISTANT",
    "FISHEYE_EQUISOLID", "FISHEYE_LENS_POLYNOMIAL",
)  # fmt: skip
"""All models that support spherical stereo."""


def run(width: int, height: int, rounds: int, threads: int) -> list[dict]:
    """Print and return the times of every model, timed alternately with the fill and the pinhole."""
    pinhole, shapes = c.scene(SPHERES, width, height)
    print(f"\n{width} x {height}, {threads} threads, {rounds} rounds; {SPHERES} spheres")
    print(f"  {'':48}{'rays ms':>9}{'x fill':>8}{'x full':>8}{'cast ms':>10}{'x pinhole':>11}")
    rows = []
    there = np.empty((2, height, width, 3))
    for name, case in _cameras({"resolution_x": width, "resolution_y": height}):
        entries = {
            "fill": lambda case=case: there[: 1 if case.model.central else 2].fill(1.0),
            "full": lambda case=case: [np.full(array.shape, 1.0) for array in there[: 1 if case.model.central else 2]],
            "rays": case.rays,
            "pinhole": lambda: cast(pinhole, shapes, passes=c.PASSES, threads=threads),
            "cast": lambda case=case: cast(case, shapes, passes=c.PASSES, threads=threads),
        }
        times = {entry: [] for entry in entries}
        for turn in range(rounds + 1):
            for entry, made in entries.items():
                began = perf_counter()
                result = made()
                if turn:
                    times[entry].append(1e3 * (perf_counter() - began))
                del result  # freeing memory is not timed
        median = {entry: float(np.median(seconds)) for entry, seconds in times.items()}
        rows.append({"model": name, **median})
        print(f"  {name:48}{median['rays']:9.1f}{median['rays'] / median['fill']:8.1f}"
              f"{median['rays'] / median['full']:8.1f}"
              f"{median['cast']:10.1f}{median['cast'] / median['pinhole']:11.2f}", flush=True)  # fmt: skip
    return rows


def _cameras(frame: dict):
    """Yield the name and the camera of each model, and of each eye of spherical stereo."""
    sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
    from tests.core.camera.test_spherical_stereo import FADING, MERGED, eye
    from tests.core.cameras.model_examples import camera

    for model in MODELS:
        yield model.key, camera(model.key, {**frame, **LENSES.get(model.key, {})})
    for key in STEREO_LENSES:
        yield f"eye, {key}", eye(key, **frame)
        yield f"eye, {key}, merged at 60°", eye(key, **frame, **MERGED, **FADING)
        yield f"eye, {key}, merged at 23°", eye(key, **frame, **MERGED)
