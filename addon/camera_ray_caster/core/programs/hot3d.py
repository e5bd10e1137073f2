"""The cameras of HOT3D's clips, as JSON: by stream, each a calibration with projection_params; and those of the whole
data set, camera_models.json: a list of cameras with projectionParams.

One focal length is that of both axes. The coefficients are those of Project Aria; the center of the first pixel is
(0, 0). T_world_from_camera leads from the camera to the world, T_device_from_camera to the headset, where the file does
not tell the world.
Reference: HOT3D documentation, and the hand tracking toolkit that reads its clips.
"""

from collections.abc import Mapping

from ..units import METERS
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import ARIA_TERMS, Lens, matrix
from .parts.placed import Placed, of_quaternion
from .parts.program import PictureFolders, ProgramFiles

MODELS = {"FISHEYE624": ("FISHEYE624", ARIA_TERMS), "PINHOLE": ("OPENCV_PINHOLE", ())}
"""Our model for the last part of a projection_model_type, and the settings that follow the center."""

LISTED = {
    "projection_model_type": "projectionModelType", "projection_params": "projectionParams",
    "image_width": "imageWidth", "image_height": "imageHeight", "T_device_from_camera": "T_Device_Camera",
}  # fmt: skip
"""Names of entries in camera_models.json of the whole data set, a list of cameras, for those of the clips."""

KIND, WORLD, DEVICE = "projection_model_type", "T_world_from_camera", "T_device_from_camera"


def looks(document: Document) -> bool:
    """See ProgramFiles: a calibration, or streams that have one each."""
    entries = document.entries
    streams = list(entries.named().values())
    in_streams = len(streams) == len(entries) and all(stream.part("calibration").has(KIND) for stream in streams)
    listed = bool(streams) and all(stream.has(*list(LISTED.values())[:2]) for stream in streams)
    return listed or in_streams or entries.has(KIND, "projection_params")


def read(document: Document) -> list[Lens] | None:
    """See ProgramFiles. Those of streams are further inside."""
    if document.entries.has(KIND):
        return [_lens(document, document.entries, {})]
    streams = document.entries.named()
    if any(stream.has(LISTED[KIND]) for stream in streams.values()):
        return [_lens(document, stream.labeled(stream.text("label", name)), LISTED) for name, stream in streams.items()]
    return None


def _lens(document: Document, entries: Fields, names: Mapping[str, str]) -> Lens:
    params = names.get("projection_params", "projection_params")
    kind = entries.text(names.get(KIND, KIND)).rpartition(".")[2]
    model, terms = MODELS[document.one_of(kind, KIND, MODELS)]
    focal = 1 if entries.count_of(params) == len(terms) + 3 else 2
    numbers = entries.numbers(params, focal + 2 + len(terms))
    settings = matrix(numbers[0], numbers[focal - 1], *numbers[focal : focal + 2])
    coefficients = dict(zip(terms, numbers[focal + 2 :], strict=True))
    size = entries.sides(*(names.get(side, side) for side in ("image_width", "image_height")))
    return Lens(entries.text("label"), model, size | settings | coefficients)


def poses(document: Document) -> list[Placed]:
    streams = document.entries.named()
    in_world = all(stream.has(WORLD) for stream in streams.values())
    placed = []
    for name, stream in streams.items():
        listed = stream.has(LISTED[KIND])
        calibration = stream if listed else stream.part("calibration")
        pose = stream.part(WORLD) if in_world else calibration.part(LISTED[DEVICE] if listed else DEVICE)
        label = calibration.text("label") or f"{name}.calibration"
        pose = pose.labeled(label)
        turn, translation = pose.numbers("quaternion_wxyz", 4), pose.numbers("translation_xyz", 3)
        placed.append(Placed(label, "", None, of_quaternion(document, turn, translation, label)))
    return placed


PROGRAM = ProgramFiles(
    "HOT3D", "cameras of its clips as .json; camera_models.json", looks,
    marks="calibration projection_model_type projection_params T_device_from_camera", reads="FISHEYE624, PINHOLE",
    read=read, poses=poses, unit=METERS, pictures=PictureFolders("*.cameras.json", numbered=True),
)  # fmt: skip
