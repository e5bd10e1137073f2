"""The gallery that comes with the extension: example scenes of camera models, times and places, and their pictures."""

from __future__ import annotations

from pathlib import Path

import bpy.utils.previews

from ..core.cameras import MODELS
from ..core.cameras.model import GROUPS

PACKAGE = Path(__file__).resolve().parents[1]
FOLDERS = (PACKAGE / "gallery", PACKAGE.parents[1] / "blend_scenes")
"""Where the scenes are, with their pictures in ``pictures``: in the extension, and in the project itself."""

NAMES = {
    "BLENDER": "pinhole", "PERSP": "pinhole", "ORTHO": "orthographic", "EQUIANGULAR_CUBEMAP_FACE": "cubemap_face",
    "FISHEYE_LENS_POLYNOMIAL": "fisheye_polynomial", "STEREOGRAPHIC_PANORAMA": "little_planet",
}  # fmt: skip
"""The scene of a camera model by its key; of all others the scene is called as the model."""

LECTURE = {
    "Camera Obscura": "camera_obscura", "Pinhole": "pinhole", "Thin Lens": "thin_lens", "Orthographic": "orthographic",
    "Fisheye": "fisheye_equidistant", "Omnimax": "omnimax", "Slit Scan": "slit_scan_rows",
}  # fmt: skip
"""The scenes of an introduction to cameras, in its order, by what it calls them."""
TIMES = "slit_scan_rows", "slit_scan_columns", "time_displacement", "rolling_shutter", "twisted_monkey", "propeller"
"""Scenes whose pixels have each their own time."""
PLACES = (
    "spheres_and_planes", "toys", "toys_cross_slit", "living_room", "living_room_equirectangular",
    "living_room_omnimax", "rotunda_fisheye", "rotunda_panorama", "street", "street_pushbroom", "sculpture_garden",
    "unrolled_monkey",
)  # fmt: skip
"""Scenes of every kind of shape, most of meshes."""

_previews: list[bpy.utils.previews.ImagePreviewCollection] = []


def folder() -> Path | None:
    """Return the folder of the example scenes; None in an extension that was built without them."""
    return next((folder for folder in FOLDERS if folder.is_dir()), None)


def scene_name(key: str) -> str:
    """Return the name of the example scene of a camera model."""
    return NAMES.get(key, key.lower())


def groups() -> dict[str, dict[str, str]]:
    """Return the names of the scenes that menus offer, by label, in groups."""
    return {
        "Introduction": LECTURE,
        "Time": {_label(name): name for name in TIMES},
        **{group: {it.label: scene_name(it.key) for it in MODELS if it.group == group} for group in GROUPS},
        "Places": {_label(name): name for name in PLACES},
    }


def _label(name: str) -> str:
    return name.replace("_", " ").title().replace(" And ", " and ")


def scenes() -> list[Path]:
    """Return the files of the example scenes, in the order of their names."""
    found = folder()
    return sorted(found.glob("*.blend")) if found else []


def icon(name: str) -> int:
    """Return the icon that shows a scene's picture, 0 without one. It is read when it is first asked for."""
    if not _previews:
        _previews.append(bpy.utils.previews.new())
    known, found = _previews[0], folder()
    if name not in known:
        picture = found / "pictures" / f"{name}.png" if found else None
        if picture is None or not picture.is_file():
            return 0
        known.load(name, str(picture), "IMAGE")
    return known[name].icon_id


def register(undo) -> None:
    """See ``registration``."""
    undo.callback(_forget)


def _forget() -> None:
    while _previews:
        bpy.utils.previews.remove(_previews.pop())
