"""The gallery that comes with the extension: an example scene for each camera model, and its picture."""

from __future__ import annotations

from pathlib import Path

import bpy.utils.previews

PACKAGE = Path(__file__).resolve().parents[1]
FOLDERS = (PACKAGE / "gallery", PACKAGE.parents[1] / "blend_scenes")
"""Where the scenes are, with their pictures in ``pictures``: in the extension, and in the project itself."""

NAMES = {
    "BLENDER": "pinhole", "PERSP": "pinhole", "ORTHO": "orthographic", "EQUIANGULAR_CUBEMAP_FACE": "cubemap_face",
    "FISHEYE_LENS_POLYNOMIAL": "fisheye_polynomial", "STEREOGRAPHIC_PANORAMA": "little_planet",
}  # fmt: skip
"""The scene of a camera model by its key; of all others the scene is called as the model."""

_previews: list[bpy.utils.previews.ImagePreviewCollection] = []


def folder() -> Path | None:
    """Return the folder of the example scenes; None in an extension that was built without them."""
    return next((folder for folder in FOLDERS if folder.is_dir()), None)


def scene_name(key: str) -> str:
    """Return the name of the example scene of a camera model."""
    return NAMES.get(key, key.lower())


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
