"""Camera Ray Caster: exact camera models, from pinhole to rolling-shutter fisheye, each with its inverse, in numpy.

Without Blender::

    import numpy as np
    import camera_ray_caster as crc

    camera = crc.camera("OPENCV_FISHEYE", (640, 480), fx=210.0, fy=210.0, cx=319.5, cy=239.5)
    shapes = crc.join(crc.spheres([[0.0, 0.0, -4.0]], 1.0), crc.planes([0.0, -1.0, 0.0], [[1, 0], [0, 0], [0, 1]]))
    images = crc.cast(camera, shapes, passes=("depth", "normal"))   # by name: arrays, row 0 at the bottom
    rays = camera.rays()                                            # origins, directions, valid
    pixels = camera.project([[0.2, 0.1, -3.0]])                     # world points to pixels; NaN where not seen

In Blender, or with pip's ``bpy``::

    images = crc.cast(crc.read_scene(bpy.context.scene), passes=("depth", "normal"))

Cameras
    camera, load_calibration, load_rig, fit, models, register_model, camera_from_json, camera_to_json, look_at,
    pose_from_opencv
Shapes
    spheres, planes, mesh, join; Scene(camera, shapes) has both
What is seen
    cast, visible, explain; of rays given as arrays: cast_rays, occluded; as points: scan
    top_down(images) has row 0 at the top
Files
    export, save_points
In Blender only
    read_camera, read_shapes, read_scene, verify, register, unregister

Every one has its own ``help``. Bad input raises ``InputError``, in one line that says what is wrong and what to do; a
stopped cast raises ``Cancelled``. Frames, pixels and units: ``help("camera_ray_caster.core.conventions")``.
Each name is imported at its first use: the package itself imports neither numpy nor Blender.
"""

from __future__ import annotations

import sys
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .blender.read import read_camera, read_scene, read_shapes
    from .blender.verification.check import verify_camera as verify
    from .core.any_rays.door import cast_rays, occluded
    from .core.camera.camera import Camera
    from .core.camera.fit import Fit
    from .core.cameras.model import Model, Step
    from .core.cameras.parts.settings import Choice, Flag, Item, Number
    from .core.cast import cast
    from .core.casting.images import Images
    from .core.casting.top_down import top_down
    from .core.casting.visibility import Visibility, visible
    from .core.clouds.cloud import PointCloud, scan
    from .core.exports.camera_json import camera_from_json, camera_to_json
    from .core.library.cameras import camera, load_calibration
    from .core.library.clouds import save_points
    from .core.library.explaining import explain
    from .core.library.files import export
    from .core.library.fitting import fit
    from .core.library.join import join
    from .core.library.models import models
    from .core.library.poses import look_at, pose_from_opencv
    from .core.library.rigs import load_rig
    from .core.library.shapes import mesh, planes, spheres
    from .core.records import Cancelled, InputError, Rays
    from .core.scene import Scene
    from .core.shape_records import Shapes
    from .core.version import VERSION

    __version__ = VERSION

_MODULES = {
    ".blender.read": "read_camera read_scene read_shapes",
    ".blender.verification.check:verify_camera": "verify",
    ".core.any_rays.door": "cast_rays occluded",
    ".core.camera.camera": "Camera",
    ".core.camera.fit": "Fit",
    ".core.cameras.model": "Model Step",
    ".core.cameras.parts.settings": "Choice Flag Item Number",
    ".core.cast": "cast",
    ".core.casting.images": "Images",
    ".core.casting.top_down": "top_down",
    ".core.casting.visibility": "Visibility visible",
    ".core.clouds.cloud": "PointCloud scan",
    ".core.exports.camera_json": "camera_from_json camera_to_json",
    ".core.library.cameras": "camera load_calibration",
    ".core.library.clouds": "save_points",
    ".core.library.explaining": "explain",
    ".core.library.files": "export",
    ".core.library.fitting": "fit",
    ".core.library.join": "join",
    ".core.library.models": "models",
    ".core.library.poses": "look_at pose_from_opencv",
    ".core.library.rigs": "load_rig",
    ".core.library.shapes": "mesh planes spheres",
    ".core.records": "Cancelled InputError Rays",
    ".core.scene": "Scene",
    ".core.shape_records": "Shapes",
    ".core.version:VERSION": "__version__",
}
"""Public names by module; after a colon the name there, if it is another."""
_MODULE_OF = {name: module for module, names in _MODULES.items() for name in names.split()}

__all__ = [
    "Camera", "Cancelled", "Choice", "Fit", "Flag", "Images", "InputError", "Item", "Model", "Number", "PointCloud",
    "Rays", "Scene", "Shapes", "Step", "Visibility", "camera", "camera_from_json", "camera_to_json", "cast",
    "cast_rays", "explain", "export", "fit", "join", "load_calibration", "load_rig", "look_at", "mesh",
    "models", "occluded", "planes", "pose_from_opencv", "read_camera", "read_scene", "read_shapes", "register",
    "register_model", "save_points", "scan", "spheres", "top_down", "unregister", "verify", "visible",
]  # fmt: skip


if not TYPE_CHECKING:  # a type checker sees the imports above, and nothing else

    def __getattr__(name: str):
        if name not in _MODULE_OF:
            from .core.other_names import FUNCTIONS, instead

            raise AttributeError(f"module {__name__!r} has no attribute {name!r}{instead(name, FUNCTIONS, __all__)}")
        module, _, other = _MODULE_OF[name].partition(":")
        try:
            value = getattr(import_module(module, __name__), other or name)
        except ModuleNotFoundError as error:
            if error.name != "bpy":
                raise
            raise AttributeError(f"{name} of module {__name__!r} needs Blender, or pip's bpy") from error
        globals()[name] = value
        return value


def __dir__() -> list[str]:
    return sorted({name for name in globals() if name.startswith("__")} | {*__all__})  # no imports in tab completion


def register_model(model: type[Model]) -> None:
    """Add a camera model of your own: it is made by ``camera``, cast, projected and exported like the others, and is in
    Blender's menu.

    model: a frozen dataclass that inherits ``Model``, with ``key``, ``label``, ``description``, ``group``, ``FORMULA``
        and ``rays``; ``number`` is what a .blend stores for it: take one from 1000 on. It replaces a model of the same
        key that was added before.

    Raises InputError, in one line, if something is missing, or belongs to a model of the package.
    """
    from .core.library.models import add_model

    add_model(model)
    registration = sys.modules.get(f"{__name__}.blender.registration")
    if registration is not None:
        registration.renew()


def register() -> None:
    """Add the engine, operators, panels and properties to Blender; do nothing if they are registered already. Raises
    ModuleNotFoundError, in one line, without Blender.
    """
    try:
        from .blender import registration
    except ModuleNotFoundError as error:
        if error.name != "bpy":
            raise
        raise ModuleNotFoundError("register needs Blender: call it there, or pip install bpy", name="bpy") from None

    registration.register()


def unregister() -> None:
    """Remove everything that ``register`` added, if it was called."""
    registration = sys.modules.get(f"{__name__}.blender.registration")
    if registration is not None:
        registration.unregister()
