"""NeRF's transforms_train.json, _val.json and _test.json: pinholes by their angle of view, and poses.

camera_angle_x is the whole lens: square pixels, the center in the middle, no distortion. Of ten pictures in order the
eighth is of val and the tenth of test. Poses are from Blender's camera frame to the world.
Reference: B. Mildenhall et al., NeRF (2020), and its data sets.
"""

from collections.abc import Iterator, Sequence
from math import atan, isclose

from ..records import InputError
from ..text_forms.json_text import as_text
from .parts.lens import matrix_of
from .parts.program import SEPARATELY, CameraRecord, FileWriter, ProgramFiles

MODELS = {"camera_angle_x": ("OPENCV_PINHOLE", ())}
PARTS = "train", "val", "test"
NEAR = 1e-6
"""Largest relative difference of focal lengths and of the center from the middle: Blender's shift is float32."""


def refusal(record: CameraRecord) -> str | None:
    fx, fy, cx, cy = matrix_of(record.lens.settings, 0.5)
    width, height = record.lens.size
    middle = max(abs(cx - width / 2), abs(cy - height / 2)) <= NEAR * max(width, height)
    return None if middle and isclose(fx, fy, rel_tol=NEAR) else "which camera_angle_x alone does not say"


def write(records: Sequence[CameraRecord]) -> Iterator[tuple[str, str]]:
    """See FileWriter. Three files with all cameras and frames. Raises InputError for lenses that differ."""
    angles = {2 * atan(record.lens.size[0] / 2 / record.lens.settings["fx"]): record.stem for record in records}
    narrowest, widest = min(angles), max(angles)
    if widest - narrowest > NEAR:
        differ = f"{angles[narrowest]!r} and {angles[widest]!r} differ"
        raise InputError(f"NeRF has one camera_angle_x, but {differ}: {SEPARATELY}, or as transforms.json")
    of = {7: "val", 9: "test"}
    for split in PARTS:
        frames = [_frame(record) for number, record in enumerate(records) if of.get(number % 10, "train") == split]
        yield f"transforms_{split}.json", as_text({"camera_angle_x": next(iter(angles)), "frames": frames})


def _frame(record: CameraRecord) -> dict:
    return {"file_path": f"./{record.stem}", "transform_matrix": record.blenders.tolist()} | record.remark


PROGRAM = ProgramFiles(
    "NeRF", "transforms_train.json, _val and _test", lost="all lenses but centered pinholes",
    export=FileWriter(
        "nerf", "NeRF", "transforms_train.json, _val and _test: pinholes by camera_angle_x, and poses",
        write, MODELS, refusal,
    ),
)  # fmt: skip
