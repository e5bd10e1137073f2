"""camera_path.json of ns-render and its viewer: a camera for each picture of a video.

camera_to_world is of a camera like Blender's, by rows; fov is the vertical field of view in degrees, and the center the
middle of the picture. A fisheye is equidistant with the same focal length.
Reference: the viewer's source, cameras/camera_paths.py: get_path_from_json.
"""

from math import radians, tan

from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, different, matrix, once_each
from .parts.placed import FROM_BLENDER, Placed, pose_in
from .parts.program import ProgramFiles

MODELS = {"perspective": "OPENCV_PINHOLE", "fisheye": "OPENCV_FISHEYE", "equirectangular": "EQUIRECTANGULAR"}


def looks(document: Document) -> bool:
    return document.entries.has("camera_path", "render_height", "render_width")


def _lenses(document: Document) -> list[Lens]:
    """Return the lens of each picture."""
    entries = document.entries
    model = MODELS[entries.word("camera_type", MODELS, "perspective")]
    size = entries.sides("render_width", "render_height")
    return once_each(_lens(picture, model, size) for picture in _pictures(document))


def _pictures(document: Document) -> list[Fields]:
    pictures = enumerate(document.entries.parts("camera_path"), 1)
    return [picture.labeled(f"picture {number}") for number, picture in pictures]


def _lens(picture: Fields, model: str, size: dict) -> Lens:
    picture.document.check()
    if model == "EQUIRECTANGULAR":
        return Lens(picture.label, model, size)
    angle, (width, height) = picture.number("fov"), size.values()
    if not 0 < angle < 180:
        raise picture.document.refusal(f"{picture.said('fov')} is {angle:g}: it must be above 0 and below 180")
    focal = height / (2 * tan(radians(angle) / 2))
    return Lens(picture.label, model, size | matrix(focal, focal, width / 2, height / 2, 0.5))


def read(document: Document) -> list[Lens]:
    return different(_lenses(document))


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles: one for each frame."""
    return [
        Placed(lens.name, "", float(frame), pose_in(picture, "camera_to_world") @ FROM_BLENDER)
        for frame, (picture, lens) in enumerate(zip(_pictures(document), _lenses(document), strict=True), 1)
    ]


PROGRAM = ProgramFiles(
    "ns-render camera paths", "camera_path.json of ns-render and its viewer", looks,
    marks="keyframes camera_type render_height render_width camera_path fps",
    reads="perspective, fisheye, equirectangular",
    lost="other camera types are refused", read=read, poses=poses,
)  # fmt: skip
