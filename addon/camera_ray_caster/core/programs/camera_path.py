"""camera_path.json of ns-render and its viewer: a camera for each picture of a video.

camera_to_world is of a camera like Blender's, by rows; fov is the vertical field of view in degrees, and the center the
middle of the picture. A fisheye is equidistant with the same focal length.
Reference: the viewer's source, cameras/camera_paths.py: get_path_from_json.
"""

from math import radians, tan

from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, matrix
from .parts.placed import FROM_BLENDER, Placed, pose_in
from .parts.program import ProgramFiles, of_pictures

MODELS = {"perspective": "OPENCV_PINHOLE", "fisheye": "OPENCV_FISHEYE", "equirectangular": "EQUIRECTANGULAR"}


def looks(document: Document) -> bool:
    return document.entries.has("camera_path", "render_height", "render_width")


def _pictures(document: Document) -> list[Fields]:
    pictures = enumerate(document.entries.parts("camera_path"), 1)
    return [picture.labeled(f"picture {number}") for number, picture in pictures]


def _lens(document: Document, picture: Fields) -> Lens:
    document.check()
    model = MODELS[document.entries.word("camera_type", MODELS, "perspective")]
    size = document.entries.sides("render_width", "render_height")
    if model == "EQUIRECTANGULAR":
        return Lens(picture.label, model, size)
    angle, (width, height) = picture.number("fov"), size.values()
    if not 0 < angle < 180:
        raise document.refusal(f"{picture.said('fov')} is {angle:g}: it must be above 0 and below 180")
    focal = height / (2 * tan(radians(angle) / 2))
    return Lens(picture.label, model, size | matrix(focal, focal, width / 2, height / 2, 0.5))


def _placed(document: Document, picture: Fields) -> Placed:
    frame = float(picture.label.rpartition(" ")[2])
    return Placed("", "", frame, pose_in(picture, "camera_to_world") @ FROM_BLENDER)


PROGRAM = ProgramFiles(
    "ns-render camera paths", "camera_path.json of ns-render and its viewer", looks,
    marks="keyframes camera_type render_height render_width camera_path fps",
    reads="perspective, fisheye, equirectangular", lost="other camera types are refused",
    **of_pictures(_pictures, _lens, _placed),
)  # fmt: skip
