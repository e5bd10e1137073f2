"""The extension's gallery: example scenes of camera models, pixel times and places, with a picture of each scene."""

from pathlib import Path

import bpy.utils.previews

from ..core.cameras import MODELS
from ..core.cameras.model import GROUPS

PACKAGE = Path(__file__).resolve().parents[1]
FOLDERS = (PACKAGE / "gallery", PACKAGE.parents[1] / "blend_scenes")
"""Folders of the scenes in the extension and in the source tree. The pictures are in the subfolder ``pictures``."""

NAMES = {
    "PERSP": "pinhole", "ORTHO": "isometric", "EQUIANGULAR_CUBEMAP_FACE": "cubemap_face",
    "FISHEYE_LENS_POLYNOMIAL": "fisheye_polynomial", "STEREOGRAPHIC_PANORAMA": "little_planet",
    "SCANNER": "street_scanner",
}  # fmt: skip
"""Scene names by model key. Any other model's scene is named after its key, in lower case."""

LECTURE = {
    "Camera Obscura": "camera_obscura", "Pinhole": "pinhole", "Thin Lens": "thin_lens", "Orthographic": "isometric",
    "Fisheye": "fisheye_equidistant", "Omnimax": "omnimax", "Slit Scan": "slit_scan_rows",
}  # fmt: skip
"""Scenes of an introduction to cameras, by label, in the order of the introduction."""
TIMES = (
    "slit_scan_rows", "slit_scan_columns", "time_displacement", "rolling_shutter", "twisted_monkey", "propeller",
    "street_scanner",
)  # fmt: skip
"""Scenes in which each pixel has its own time."""
PLACES = (
    "spheres_and_planes", "fish_tank", "toys", "toys_cross_slit", "living_room", "living_room_equirectangular",
    "living_room_omnimax", "rotunda_fisheye", "rotunda_panorama", "street", "street_pushbroom", "sculpture_garden",
    "unrolled_monkey", "fish_tank",
)  # fmt: skip
"""Scenes with all kinds of shapes, mostly meshes."""

_previews: list[bpy.utils.previews.ImagePreviewCollection] = []


def folder() -> Path | None:
    """Return the folder of the example scenes, or None if the extension was built without them."""
    return next((folder for folder in FOLDERS if folder.is_dir()), None)


def scene_name(key: str) -> str:
    """Return the name of the example scene of a camera model."""
    return NAMES.get(key, key.lower())


def groups() -> dict[str, dict[str, str]]:
    """Return the scene names that the menus offer, by group and label."""
    return {
        "Introduction": LECTURE,
        "Time": {_label(name): name for name in TIMES},
        **{group: {model.label: scene_name(model.key) for model in MODELS if model.group == group} for group in GROUPS},
        "Places": {_label(name): name for name in PLACES},
    }


def label(name: str) -> str:
    """Return the label of a scene in the menus: that of its camera model, if there is one."""
    return {scene_name(model.key): model.label for model in MODELS}.get(name, _label(name))


def _label(name: str) -> str:
    return name.replace("_", " ").title().replace(" And ", " and ")


def scenes() -> list[Path]:
    """Return the files of the example scenes, sorted by name."""
    scene_folder = folder()
    return sorted(scene_folder.glob("*.blend")) if scene_folder else []


def icon(name: str) -> int:
    """Return the icon of a scene's picture, or 0 without a picture. The picture is loaded on the first call."""
    if not _previews:
        _previews.append(bpy.utils.previews.new())
    known, scene_folder = _previews[0], folder()
    if name not in known:
        picture = scene_folder / "pictures" / f"{name}.png" if scene_folder else None
        if picture is None or not picture.is_file():
            return 0
        known.load(name, str(picture), "IMAGE")
    return known[name].icon_id


def register(undo) -> None:
    undo.callback(_forget)


def _forget() -> None:
    while _previews:
        bpy.utils.previews.remove(_previews.pop())
