"""OpenCV's calibrations, as its samples write them in YAML, XML and JSON, and files with the same names.

A pinhole is written with as few of OpenCV's 14 coefficients as it needs. fisheye_model is 1 for cv2.fisheye and 0 for a
pinhole; a file with xi is for cv2.omnidir. extrinsic_parameters has one row per frame: the rotation vector and the
translation from the world to the camera; R and T of a pair lead from the first camera to the second. The center of the
first pixel is (0, 0).
References: OpenCV documentation, Camera Calibration and 3D Reconstruction; Fisheye camera model; Omnidirectional Camera
Calibration.
"""

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from ..maths.rotations import half_turn_vector
from .parts.document import Document
from .parts.lens import Lens, matrix_of, one_of_several, word_of
from .parts.placed import Placed, inverted, of_rotation
from .parts.plain import TERMS, has_plain, plain_lens, plain_lenses
from .parts.program import CameraRecord, FileWriter, ProgramFiles, by_lens
from .parts.spelled import SIDES, Spelled

PINHOLE = TERMS["OPENCV_PINHOLE"]
MODELS = {f"pinhole {count}": ("OPENCV_PINHOLE", PINHOLE[:count]) for count in (5, 8, 12, 14)} | {
    "fisheye": ("OPENCV_FISHEYE", TERMS["OPENCV_FISHEYE"]),
    "omnidir": ("UCM", (*TERMS["UCM"], "unified_xi", "skew")),
}
ROTATION = "r", "rotation", "rotationmatrix", "rmat", "rotmatrix"
TRANSLATION = "t", "translation", "translationvector", "tvec", "transvec"
"""What leads from the first camera of a pair to the second."""
EXTRINSICS = "extrinsic_parameters"
FILES = "intrinsics", "extrinsics"
"""Names of the files with the lenses of a pair, M1, D1, M2 and D2, and with R and T."""
PLAIN = "fisheye_model: 0\n"
EXTRA = {"fisheye": "fisheye_model: 1\n", "omnidir": "xi: {unified_xi!r}\n"}


def looks(document: Document) -> bool:
    return has_plain(document) or bool(_pair(document)) or _is_apart(document)


def read(document: Document) -> list[Lens] | None:
    if _is_apart(document):
        raise document.refusal(f"it has the places of two cameras: their lenses are in the file {FILES[0]}")
    pair = _pair(document)
    if not pair:
        return plain_lenses(document)
    return [one_of_several(name, plain_lens, camera)._replace(name=name) for name, camera in pair.items()]


def pair(path: Path) -> tuple[Path, Path] | None:
    """See ProgramFiles: the two files of OpenCV's sample of stereo calibration."""
    if path.stem not in FILES or path.suffix not in (".yml", ".yaml", ".xml"):
        return None
    files = path.with_stem(FILES[0]), path.with_stem(FILES[1])
    return files if all(map(Path.is_file, files)) else None


def _is_pair(document: Document) -> bool:
    entries = Spelled(document.entries)
    return entries.has(ROTATION) and entries.has(TRANSLATION)


def _is_apart(document: Document) -> bool:
    """Whether a document has the places of a pair's cameras without the lenses, as OpenCV's sample writes them."""
    return document.entries.has("R", "T", "R1", "R2") and not has_plain(document)


def _pair(document: Document) -> dict[str, Document]:
    """Return the cameras of a pair that has a mapping for each; {} of any other file."""
    if not _is_pair(document):
        return {}
    inside = {name: document.part(entries.values) for name, entries in document.entries.named().items()}
    cameras = {name: camera for name, camera in inside.items() if has_plain(camera)}
    return cameras if len(cameras) == 2 else {}


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles: of a pair's cameras in the frame of the first one, or of a camera beside the patterns of its
    pictures; none of other files.
    """
    entries, is_pair = Spelled(document.entries), _is_pair(document)
    if not is_pair and not document.entries.has(EXTRINSICS):
        return []
    cameras = list(SIDES[0]) if _is_apart(document) else [lens.name for lens in read(document) or []]
    if len(cameras) == 2 and is_pair:
        turn, translation = entries.numbers(ROTATION), entries.numbers(TRANSLATION)
        if len(turn) not in (3, 9) or len(translation) != 3:
            raise document.refusal(f"R and T have {len(turn)} and {len(translation)} numbers: they must have 9 and 3")
        other = inverted(of_rotation(document, turn, translation, "R"))
        return [Placed(cameras[0], "", None, np.eye(4)), Placed(cameras[1], "", None, other)]
    if len(cameras) != 1 or not document.entries.has(EXTRINSICS):
        return []
    numbers = document.entries.matrix(EXTRINSICS)
    rows = [numbers[i : i + 6] for i in range(0, len(numbers), 6)]
    frames = document.entries.numbers("frames", len(rows), default=[*range(1, len(rows) + 1)])
    if len(numbers) % 6:
        raise document.refusal(f"{EXTRINSICS} has {len(numbers)} numbers: a picture has 6")
    return [Placed("", "", frame, inverted(of_rotation(document, row[:3], row[3:], EXTRINSICS)))
            for frame, row in zip(frames, rows, strict=True)]  # fmt: skip


def write(records: Sequence[CameraRecord]) -> Iterator[tuple[str, str]]:
    """See FileWriter. One file per camera, or one file per frame if the camera's lens changes."""
    for stem, lens, records_of_lens in by_lens(records, _text):
        yield f"{stem}.yml", f"%YAML:1.0\n---\n{lens}{_poses(records_of_lens)}"


def _text(lens: Lens) -> str:
    kind = str(word_of(MODELS, lens))
    fx, fy, cx, cy = matrix_of(lens.settings)
    K = [[fx, lens.settings.get("skew", 0.0), cx], [0.0, fy, cy], [0.0, 0.0, 1.0]]
    width, height = lens.size
    terms = [name for name in MODELS[kind][1] if name not in ("unified_xi", "skew")]
    return (
        f"image_width: {width}\nimage_height: {height}\n{_matrix('camera_matrix', K)}"
        f"{_matrix('distortion_coefficients', [lens.values(terms)])}"
        f"{EXTRA.get(kind, PLAIN).format(**lens.settings)}"
    )


def _poses(records: Sequence[CameraRecord]) -> str:
    poses = [record.world_to_camera for record in records]
    rows = [[*half_turn_vector(pose[:3, :3]).tolist(), *pose[:3, 3].tolist()] for pose in poses]
    frames = ", ".join(f"{record.frame:.10g}" for record in records)
    return f"frames: [ {frames} ]\n{_matrix('extrinsic_parameters', rows)}"


def _matrix(name: str, rows) -> str:
    array = np.array(rows, np.float64)
    data = ", ".join(map(repr, array.ravel().tolist()))
    return f"{name}: !!opencv-matrix\n   rows: {len(array)}\n   cols: {array.shape[1]}\n   dt: d\n   data: [ {data} ]\n"


PROGRAM = ProgramFiles(
    "OpenCV", ".yml, .xml, .json of FileStorage, also .gz", looks, general=True,
    marks="camera_matrix distortion_coefficients image_width image_height opencv_storage",
    reads="pinhole with 4, 5, 8, 12 or 14 coefficients, fisheye, omnidir; stereo pairs",
    lost="of four coefficients without a model's name: which model they are of", read=read, poses=poses,
    pair=pair,
    export=FileWriter(
        "opencv", "OpenCV", "<camera>.yml for FileStorage: pinhole, fisheye and omnidir, and poses", write, MODELS,
        ending=".yml",
    ),
)  # fmt: skip
