"""ROS's CameraInfo as YAML, as camera_calibration_parsers writes it or as a topic is echoed: the lens alone.

The entries are those of OpenCV's samples. Written, the rectified picture has the same K: P is K, and R is the identity.
The center of the first pixel is (0, 0).
Reference: ROS documentation, sensor_msgs/CameraInfo; camera_calibration_parsers.
"""

import json
from collections.abc import Iterator, Sequence

from .parts.document import Document
from .parts.lens import Lens, matrix_of, word_of
from .parts.plain import TERMS, has_plain, plain_lenses
from .parts.program import CameraRecord, FileWriter, ProgramFiles, by_lens

MODELS = {
    "plumb_bob": ("OPENCV_PINHOLE", TERMS["OPENCV_PINHOLE"][:5]),
    "rational_polynomial": ("OPENCV_PINHOLE", TERMS["OPENCV_PINHOLE"][:8]),
    "equidistant": ("OPENCV_FISHEYE", TERMS["OPENCV_FISHEYE"]),
}
OWN = ("camera_matrix", "projection_matrix"), ("camera_matrix", "rectification_matrix"), ("K", "D"), ("k", "d")


def looks(document: Document) -> bool:
    entries = document.entries
    return entries.has("distortion_model") and any(entries.has(*names) for names in OWN) and has_plain(document)


def write(records: Sequence[CameraRecord]) -> Iterator[tuple[str, str]]:
    """See FileWriter. One file per camera, or one file per frame if the camera's lens changes."""
    for stem, text, records_of_lens in by_lens(records, _text):
        yield f"{stem}.yaml", text.replace(NAME, json.dumps(records_of_lens[0].name, ensure_ascii=False))


NAME = "%NAME%"
"""Stands for the name of the camera."""


def _text(lens: Lens) -> str:
    kind = str(word_of(MODELS, lens))
    fx, fy, cx, cy = matrix_of(lens.settings)
    width, height = lens.size
    matrices = {
        "camera_matrix": (3, 3, [fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0]),
        "distortion_coefficients": (1, len(MODELS[kind][1]), lens.values(MODELS[kind][1])),
        "rectification_matrix": (3, 3, [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]),
        "projection_matrix": (3, 4, [fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0]),
    }
    text = f"image_width: {width}\nimage_height: {height}\ncamera_name: {NAME}\n"
    for name, (rows, columns, values) in matrices.items():
        data = ", ".join(map(repr, values))
        text += f"distortion_model: {kind}\n" if name == "distortion_coefficients" else ""
        text += f"{name}:\n  rows: {rows}\n  cols: {columns}\n  data: [{data}]\n"
    return text


PROGRAM = ProgramFiles(
    "ROS", "CameraInfo as .yaml, also as echoed", looks,
    marks="camera_matrix distortion_model rectification_matrix projection_matrix",
    reads="plumb_bob, rational_polynomial, equidistant; a region of interest", lost="poses; binning is not read",
    read=plain_lenses,
    export=FileWriter(
        "ros", "ROS CameraInfo", "<camera>.yaml: plumb_bob, rational_polynomial and equidistant lenses, without poses",
        write, MODELS, rigid=False, ending=".yaml",
    ),
)  # fmt: skip
