"""Lens distortion of the movie clips that a camera was tracked from, which the camera itself may not have."""

from collections.abc import Iterator

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
    found = {clip.name: distortion for clip in _clips(scene, camera_object) if (distortion := _distortion(clip))}
    return tuple(
        (name, f"this movie clip is tracked with lens distortion ({distortion}), and camera {camera_object.name!r} "
               "casts without: rays do not fit the clip's pictures. Choose a calibrated model, or undistort the clip")
        for name, distortion in found.items() if group != CALIBRATED
    )  # fmt: skip


def _clips(scene, camera_object) -> Iterator:
    """Yield the clips of the scene, of the camera's background images and of its solvers."""
    shown = [one for one in camera_object.data.background_images if one.source == "MOVIE_CLIP"]
    solvers = [one for one in camera_object.constraints if one.type == "CAMERA_SOLVER"]
    yield from (clip for clip in (scene.active_clip, *(one.clip for one in (*shown, *solvers))) if clip is not None)


def _distortion(clip) -> str:
    """Return the distortion of a clip in words; "" if it has none."""
    lens = clip.tracking.camera
    names = COEFFICIENTS.get(lens.distortion_model, ())
    values = {name.rpartition("_")[2]: getattr(lens, name) for name in names if getattr(lens, name)}
    words = [lens.distortion_model.title(), *(f"{name} = {value:.6g}" for name, value in values.items())]
    return ", ".join(words) if values else ""
