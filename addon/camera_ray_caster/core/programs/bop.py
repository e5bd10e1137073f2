"""BOP's camera.json and scene_camera.json: K, and the pose of each image by the image's number, which is its frame.

The translation is in millimeters; depth_scale converts depths from Blender units to millimeters. The center of the
first pixel is (0, 0). Each of several cameras has its own file, as in data sets with several sensors.
Reference: BOP toolkit documentation, BOP dataset format.
"""

from collections.abc import Iterator, Sequence

from ..text_forms.json_text import as_text
from ..units import MILLIMETERS, factor
from .parts.document import Document
from .parts.lens import Lens, matrix_of
from .parts.placed import Placed, inverted, of_rotation
from .parts.plain import has_plain, plain_lenses
from .parts.program import CameraRecord, FileWriter, ProgramFiles

MODELS = {"pinhole": ("OPENCV_PINHOLE", ())}


def looks(document: Document) -> bool:
    entries = document.entries
    if entries.has("depth_scale"):
        return has_plain(document)
    images = entries.named()
    has_cameras = any(image.has("cam_K") or image.has("cam_R_w2c") for image in images.values())
    return has_cameras and all(map(str.isdecimal, entries))


def read(document: Document) -> list[Lens] | None:
    """See ProgramFiles. Those of images are further inside."""
    return plain_lenses(document) if document.entries.has("depth_scale") else None


def poses(document: Document) -> list[Placed]:
    placed = []
    for number, image in document.entries.named().items():
        document.check()
        turn, translation = image.numbers("cam_R_w2c", 9), image.numbers("cam_t_w2c", 3)
        pose = of_rotation(document, turn, translation, f"the pose of {number}")
        placed.append(Placed(number, "", float(number), inverted(pose)))
    return placed


def refusal(record: CameraRecord) -> str | None:
    return None if record.frame == int(record.frame) else "whose frame is not a whole number"


def write(records: Sequence[CameraRecord]) -> Iterator[tuple[str, str]]:
    """See FileWriter. One file per camera."""
    names = list(dict.fromkeys(record.name for record in records))
    for name in names:
        images = {str(int(record.frame)): image_of(record) for record in records if record.name == name}
        yield f"scene_camera{'' if len(names) == 1 else f'_{name}'}.json", as_text(images)


def image_of(record: CameraRecord) -> dict:
    """Return the entry of a camera at a frame."""
    fx, fy, cx, cy = matrix_of(record.lens.settings)
    pose = record.world_to_camera
    return {
        "cam_K": [fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0],
        "cam_R_w2c": pose[:3, :3].ravel().tolist(),
        "cam_t_w2c": pose[:3, 3].tolist(),
        "depth_scale": factor(MILLIMETERS, record.meters),
    } | record.remark


PROGRAM = ProgramFiles(
    "BOP", "camera.json, scene_camera.json", looks, marks="cam_K depth_scale cam_R_w2c cam_t_w2c", reads="pinhole",
    lost="the size of the pictures, distortion, skew", read=read, poses=poses, unit=MILLIMETERS,
    export=FileWriter(
        "bop", "BOP",
        "scene_camera.json: pinholes and poses in millimeters; of several cameras scene_camera_<camera>.json",
        write, MODELS, refusal, ending="scene_camera.json",
    ),
)  # fmt: skip
