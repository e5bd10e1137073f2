"""The eyes of a stereo camera: the record of an eye, from the camera's record and the name of a view.

Let s be +1 for the left eye and -1 for the right eye, iod the interocular distance, cv the convergence distance
(Blender units), and k the eye's part of the offset, given by the pivot (CENTER: 1/2 for both; LEFT and RIGHT: 0 for
that eye, 1 for the other). The camera's axes are normalized one by one.
    PARALLEL  the eye moves by -s k iod along the camera's X.
    OFFAXIS   the same, and the shift grows by s k (iod / sensor width) (lens / cv), whatever the sensor fit.
    TOE       alpha = atan(iod / (2 cv)). CENTER: the eye moves as above and turns by alpha about its Y, inwards. LEFT
              and RIGHT: the other eye stands at (-s iod cos alpha, 0, -iod sin alpha) and turns by 2 alpha.
Orthographic cameras take the off-axis shift with their lens, which they do not use otherwise; panoramas take no shift.
Of the models that Blender does not have, the camera obscura and OpenCV's pinhole move their own picture so that points
at the convergence distance have no parallax; all others take no shift, whatever the type of the Blender camera is.
Spherical stereo does not move the camera: its eyes turn with every ray (see ``spherical_stereo``).
A model with eyes of its own (omnidirectional stereo) is not moved either; the view selects its eye.
Source: Blender manual, Stereoscopy; measured against RenderEngine.camera_model_matrix and camera_shift_x.
"""

from dataclasses import replace
from math import atan, cos, sin

import numpy as np

from ..arguments import shown
from ..cameras import find_model
from ..records import BlenderCamera, InputError
from .spherical_stereo import CONVERGENCE, EYE, INTEROCULAR

SIDES = {"left": 1.0, "right": -1.0}
"""The views of Blender's Stereo 3D, each with the sign of its convergence."""


def eye_record(raw: BlenderCamera, view: str) -> BlenderCamera:
    """Return the record of an eye. For the empty view and for the views of Multi-View it is the record itself.

    In Multi-View each view has a camera object of its own, and the record is already that of this object. Raises
    InputError for another view, for spherical stereo of a model that is not Blender's own, and for an eye of a model
    that shows both eyes in one picture.
    """
    settings = raw.settings
    if not view or settings["views_format"] == "MULTIVIEW":
        return raw
    if view not in SIDES:
        raise InputError(f"view {shown(view)} is not an eye of Stereo 3D: choose one of {', '.join(SIDES)}")
    eye = find_model(raw).eye(raw, view)
    if eye is not None:
        return eye
    if settings["use_spherical_stereo"] and raw.type in ("PERSP", "PANO"):
        if raw.model:
            spherical = f"camera {raw.name!r} has Spherical Stereo, which only Blender's own cameras have"
            raise InputError(f"{spherical}: disable it, or use the model Blender's Own or Omnidirectional Stereo")
        return replace(raw, settings={**settings, EYE: -SIDES[view]})
    side, mode, pivot = SIDES[view], settings["convergence_mode"], settings["pivot"]
    distance, convergence = INTEROCULAR.read(raw), CONVERGENCE.read(raw)
    share = {"CENTER": 0.5, view.upper(): 0.0}.get(pivot, 1.0)
    if mode == "TOE":
        angle = atan(distance / (2 * convergence))
        if pivot == "CENTER":
            return _moved(raw, -side * distance / 2, 0.0, -side * angle)
        distance *= share
        return _moved(raw, -side * distance * cos(angle), -distance * sin(angle), -side * share * 2 * angle)
    if mode == "OFFAXIS":
        raw = find_model(raw).off_axis(raw, side * share * distance / convergence)
    return _moved(raw, -side * share * distance, 0.0, 0.0)


def blender_shift(raw: BlenderCamera, view: str) -> float:
    """Return shift_x of an eye as Blender itself sets it for a camera of type Custom, whose model it does not know."""
    return eye_record(replace(raw, type="ORTHO", model=""), view).shift_x


def camera_name(name: str, suffix: str, suffixes: list[str]) -> str:
    """Return the name of the camera that replaces another in a view of Multi-View, by the suffixes of the views.

    The longest suffix at the end of the name is replaced; a name without a suffix is returned unchanged.
    """
    ends = [end for end in suffixes if name.endswith(end)]
    return name.removesuffix(max(ends, key=len)) + suffix if ends else name


def _moved(raw: BlenderCamera, x: float, z: float, turn: float) -> BlenderCamera:
    """Return the camera moved along its own normalized axes, and turned about its Y."""
    world_from_camera = np.array(raw.matrix_world, np.float64)
    axes = world_from_camera[:3, :3]
    with np.errstate(all="ignore"):  # ``camera_from`` refuses what is not finite
        axes /= np.linalg.norm(axes, axis=0)
        world_from_camera[:3, 3] += axes @ (x, 0.0, z)
        world_from_camera[:3, :3] = axes @ [[cos(turn), 0.0, sin(turn)], [0.0, 1.0, 0.0], [-sin(turn), 0.0, cos(turn)]]
    return replace(raw, matrix_world=world_from_camera)
