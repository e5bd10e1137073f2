"""Lens distortion of the movie clips that a camera was tracked from, which the camera itself may not have.

In focal lengths from the principal point, y up, Polynomial and Brown distort by r (1 + k1 r^2 + ...), Division by
r / (1 + k1 r^2 + k2 r^4): all are OpenCV's lens, with k4 of Brown a Radial Polynomial. Nuke undistorts by
r / (1 + k1 r^2 + k2 r^4), with r in halves of the longer side: that is OCam's, whose direction has the divisor.
References: Blender manual, Movie Clip Editor, Lens; libmv, distortion models.
"""

from ...core.programs.parts.lens import Lens, matrix
from ...core.records import InputError

COEFFICIENTS = {
    "POLYNOMIAL": ("k1", "k2", "k3"), "DIVISION": ("division_k1", "division_k2"), "NUKE": ("nuke_k1", "nuke_k2"),
    "BROWN": ("brown_k1", "brown_k2", "brown_k3", "brown_k4", "brown_p1", "brown_p2"),
}  # fmt: skip
"""Blender's names of the coefficients of each distortion model of a clip."""
CALIBRATED = "Calibrated"
"""Group of the camera models that have a distortion of their own."""


def notes(scene, camera_object, group: str) -> tuple[tuple[str, str], ...]:
    """Return the clips with distortion of a scene and a camera, each with a note; none for a model of a ``group`` that
    has distortion itself.
    """
    distorted = {clip.name: distortion for clip in clips_of(scene, camera_object) if (distortion := _distortion(clip))}
    return tuple(
        (name, f"this movie clip is tracked with lens distortion ({distortion}), and camera {camera_object.name!r} "
               "casts without: rays do not fit the clip's pictures. Use Lens of Movie Clip, or undistort the clip")
        for name, distortion in distorted.items() if group != CALIBRATED
    )  # fmt: skip


def clips_of(scene, camera_object) -> list:
    """Return the clips of the scene, of the camera's background images and of its solvers, each once."""
    shown = [background for background in camera_object.data.background_images if background.source == "MOVIE_CLIP"]
    solvers = [constraint for constraint in camera_object.constraints if constraint.type == "CAMERA_SOLVER"]
    return list(dict.fromkeys(filter(None, (scene.active_clip, *(user.clip for user in (*shown, *solvers))))))


def lens_of(clip) -> Lens:
    """Return the lens of a clip's tracking camera. Raises InputError for one that no model has."""
    camera = clip.tracking.camera
    width, height = clip.size
    focal, aspect = camera.focal_length_pixels, camera.pixel_aspect
    if not (width and height):
        raise InputError(f"movie clip {clip.name!r} has no pictures: choose its file again")
    x, y = camera.principal_point_pixels
    settings = {"calibration_width": float(width), "calibration_height": float(height)}
    settings |= matrix(focal, focal * aspect, x, height - y, 0.5)
    terms = _terms(camera)
    k1, k2, k3, k4, p1, p2 = (terms.get(name, 0.0) for name in ("k1", "k2", "k3", "k4", "p1", "p2"))
    if camera.distortion_model == "DIVISION":
        return Lens(clip.name, "OPENCV_PINHOLE", settings | {"k4": k1, "k5": k2})
    if camera.distortion_model == "NUKE":
        if aspect != 1:
            raise InputError(f"movie clip {clip.name!r} has a Pixel Aspect with Nuke's distortion, which is not read")
        unit = max(width, height) / 2
        polynomial = " ".join(map(repr, (-focal, 0.0, -focal * k1 / unit**2, 0.0, -focal * k2 / unit**4)))
        center = {name: value for name, value in settings.items() if name not in ("fx", "fy")}
        return Lens(clip.name, "OCAM", center | {"ocam_polynomial": polynomial})
    if not k4:
        settings |= {"k1": k1, "k2": k2, "k3": k3, "p1": -p2, "p2": p1}  # p1 and p2 have other names in OpenCV, y down
        return Lens(clip.name, "OPENCV_PINHOLE", settings)
    if p1 or p2:
        raise InputError(f"movie clip {clip.name!r} has k4 and tangential distortion, which no model has: refine fewer")
    polynomial = f"0 1 0 {k1!r} 0 {k2!r} 0 {k3!r} 0 {k4!r}"
    return Lens(clip.name, "RADIAL_POLYNOMIAL", settings | {"radial_polynomial": polynomial})


def _terms(camera) -> dict[str, float]:
    """Return the coefficients of a clip's camera that are not 0, without the names of their models: k1, p2."""
    values = {name: float(getattr(camera, name)) for name in COEFFICIENTS.get(camera.distortion_model, ())}
    return {name.rpartition("_")[2]: value for name, value in values.items() if value}


def _distortion(clip) -> str:
    """Return the distortion of a clip in words; "" if it has none."""
    camera, terms = clip.tracking.camera, _terms(clip.tracking.camera)
    words = [camera.distortion_model.title(), *(f"{name} = {value:.6g}" for name, value in terms.items())]
    return ", ".join(words) if terms else ""
