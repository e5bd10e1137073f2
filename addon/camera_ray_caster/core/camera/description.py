"""What a camera says of itself: its size, matrices, settings, its line of text, and which other camera equals it."""

from dataclasses import fields
from typing import TYPE_CHECKING, Any

import numpy as np

from ..arguments import shown
from ..cameras import find_model
from ..cameras.model import Model
from ..cameras.parts.calibration import SIZE
from ..cameras.parts.parameters import parameters_of, values_of
from ..conventions import FROM_BLENDER
from ..maths.rotations import transform
from ..maths.vector import inverse
from ..other_names import ATTRIBUTES, instead
from ..records import BlenderCamera, Pose, Raster
from .equality import same


class Description:
    """The part of ``Camera`` that describes it."""

    name: str
    model: Model
    pose: Pose
    raster: Raster
    record: BlenderCamera

    @property
    def width(self) -> int:
        """Columns of the full frame, in pixels."""
        return self.raster.width

    @property
    def height(self) -> int:
        """Rows of the full frame, in pixels."""
        return self.raster.height

    @property
    def settings(self) -> dict[str, Any]:
        """The values of the model's SETTINGS, by name, as plain numbers, words and lists."""
        return values_of(find_model(self.record).SETTINGS, self.record)

    @property
    def parameters(self) -> dict[str, float]:
        """The real numbers among the settings, by name, in the order of the model's SETTINGS: by these
        ``project(points, jacobian="settings")`` differentiates. A vector's or polynomial's numbers have their places
        beside the name, as in "ray_1[0]". Words, files, objects and whole numbers are none of them.
        """
        return parameters_of(find_model(self.record).SETTINGS, self.record)

    @property
    def K(self) -> np.ndarray | None:
        """The camera matrix, (3, 3) float64, in OpenCV's convention: y down, the origin in the center of the top left
        pixel. With lens distortion K applies to the distorted coordinates. None for models without a camera matrix.
        """
        return self.model.K

    @property
    def world_from_camera(self) -> np.ndarray:
        """(4, 4) float64: from the camera's frame, x right, y up, z back, to the world. The inverse of
        ``opencv_from_world`` leads from OpenCV's frame.
        """
        return transform(self.pose.basis, self.pose.eye)

    @property
    def opencv_from_world(self) -> np.ndarray:
        """(4, 4) float64: from the world to OpenCV's camera frame, x right, y down, z ahead.

        It is rigid up to the rounding of the matrix that Blender stores (float32, 1e-7), unless the camera is sheared.
        The error of each entry is at most gamma(8) of the sum of the magnitudes times the basis's condition number.
        """
        axes = FROM_BLENDER[:3, :3] @ inverse(self.pose.basis)
        return transform(axes, -axes @ self.pose.eye)

    @property
    def world_to_opencv(self) -> np.ndarray:
        """The same as ``opencv_from_world``, under its name of earlier versions."""
        return self.opencv_from_world

    def __eq__(self, other: object) -> bool:
        return same(vars_of(self), vars_of(other)) if type(other) is type(self) else NotImplemented

    def __hash__(self) -> int:
        return hash((self.name, type(self.model), self.raster, *self.pose.eye.tolist()))

    def __repr__(self) -> str:
        kind = find_model(self.record)
        changed = [
            f"{setting.name}={shown(value)}"
            for setting in kind.SETTINGS
            if not same(value := setting.reported(self.record), values_of([setting], _defaults(setting))[setting.name])
            and not (setting in SIZE and value in (self.width, self.height))
        ]
        eye = ", ".join(f"{coordinate:.6g}" for coordinate in self.pose.eye)
        words = (repr(self.name), kind.key, f"{self.width} x {self.height}", *changed, f"at ({eye})")
        return f"<Camera {', '.join(words)}>"

    if not TYPE_CHECKING:

        def __getattr__(self, name: str):
            use = instead(name, ATTRIBUTES, dir(type(self)))
            raise AttributeError(f"a camera has no {name}{use}", name=name, obj=self)


def vars_of(camera: Any) -> dict[str, Any]:
    """Return the fields of a camera by name, without what was computed from them."""
    return {field.name: getattr(camera, field.name) for field in fields(camera)}


def _defaults(setting: Any) -> BlenderCamera:
    """Return a record in which a setting has its default."""
    return BlenderCamera(name="", type="", matrix_world=np.eye(4), settings={setting.name: setting.default})
