"""COLMAP's models as text and as binary: cameras.txt, images.txt, cameras.bin, images.bin.

A camera has an id, a model, width, height and parameters; an image the pose from the world to its camera, and the
camera's id. The center of the first pixel is (0.5, 0.5). COLMAP's equirectangular panorama is the whole sphere. In its
files a name ends at the first space.
References: COLMAP documentation, Output Format; Camera Models; its source, reconstruction_io.
"""

import re
import struct
from collections.abc import Iterator, Sequence
from math import pi
from pathlib import Path

from ..conventions import EPS32
from ..maths.rotations import quaternion
from .parts.document import Document
from .parts.lens import ANGLES, ARIA_TERMS, Lens, matrix, matrix_of, numbers_of, one_of_several, word_of
from .parts.placed import Placed, inverted, of_quaternion
from .parts.program import CameraRecord, FileWriter, ProgramFiles

LINE = re.compile(r"\d+\s+[A-Z][A-Z_0-9]+(\s+[-+.\d]\S*){2}(\s|$)")
FISHEYE_TERMS, PINHOLE_TERMS = ("k1", "k2", "k3", "k4"), ("k1", "k2", "p1", "p2")
F, FXY = ("f", "cx", "cy"), ("fx", "fy", "cx", "cy")
SPHERE = "EQUIRECTANGULAR"
"""The whole sphere, whose parameters are width and height again; our model has the same name."""
CAMERA_MODELS = {
    "SIMPLE_PINHOLE": ("OPENCV_PINHOLE", F),
    "PINHOLE": ("OPENCV_PINHOLE", FXY),
    "SIMPLE_RADIAL": ("OPENCV_PINHOLE", (*F, "k1")),
    "RADIAL": ("OPENCV_PINHOLE", (*F, "k1", "k2")),
    "OPENCV": ("OPENCV_PINHOLE", (*FXY, *PINHOLE_TERMS)),
    "OPENCV_FISHEYE": ("OPENCV_FISHEYE", (*FXY, *FISHEYE_TERMS)),
    "FULL_OPENCV": ("OPENCV_PINHOLE", (*FXY, *PINHOLE_TERMS, "k3", "k4", "k5", "k6")),
    "FOV": ("FOV", (*FXY, "fov_omega")),
    "SIMPLE_RADIAL_FISHEYE": ("OPENCV_FISHEYE", (*F, "k1")),
    "RADIAL_FISHEYE": ("OPENCV_FISHEYE", (*F, "k1", "k2")),
    "THIN_PRISM_FISHEYE": ("THIN_PRISM_FISHEYE", (*FXY, *PINHOLE_TERMS, "k3", "k4", "s1", "s3")),
    "RAD_TAN_THIN_PRISM_FISHEYE": ("FISHEYE624", (*FXY, *ARIA_TERMS)),
    "SIMPLE_DIVISION": ("DIVISION", (*F, "division_lambda")),
    "DIVISION": ("DIVISION", (*FXY, "division_lambda")),
    "SIMPLE_FISHEYE": ("OPENCV_FISHEYE", F),
    "FISHEYE": ("OPENCV_FISHEYE", FXY),
    "EUCM": ("EUCM", (*FXY, "unified_alpha", "unified_beta")),
    SPHERE: (SPHERE, ("width", "height")),
}
"""Our model, and its settings in the order of COLMAP's parameters, f for both focal lengths; in the order of the
numbers by which binary files name the models.
"""
MODELS = {
    kind: (key, tuple(name for name in names if name not in FXY))
    for kind, (key, names) in CAMERA_MODELS.items()
    if names[0] == "fx" and kind != "FISHEYE"  # OPENCV_FISHEYE says the same, and every COLMAP reads it
} | {SPHERE: (SPHERE, ANGLES)}
"""The models that are written."""

COUNT, CAMERA, IMAGE = struct.Struct("<Q"), struct.Struct("<iiQQ"), struct.Struct("<I7dI")
POINT = 24
"""Bytes of a point in an image: x, y and the point's id."""

CAMERAS = """# Camera list with one line of data per camera:
#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]
"""
IMAGES = """# Image list with two lines of data per image:
#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME
#   POINTS2D[] as (X, Y, POINT3D_ID)
"""
POINTS = """# 3D point list with one line of data per point:
#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)
"""


def looks(document: Document) -> bool:
    return _cameras(document) is not None or _images(document) is not None


def read(document: Document) -> list[Lens]:
    cameras = _cameras(document)
    if cameras is None:
        raise document.refusal("it should have COLMAP's poses: the lenses are in the file cameras beside it")
    return [one_of_several(words[0], _lens, document, words) for words in cameras]


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles. The order is that of the ids."""
    images = _images(document)
    if images is None:
        raise document.refusal("it has no poses: COLMAP's are in the file images beside it")
    placed = []
    for number, numbers, camera, name in sorted(images):
        document.check()
        numbers = document.numbers(numbers, f"pose of image {number}", 7)
        pose = of_quaternion(document, numbers[:4], numbers[4:], f"image {number}")
        placed.append(Placed(str(camera), name, None, inverted(pose)))
    return placed


def pair(path: Path) -> tuple[Path, Path] | None:
    """See ProgramFiles. A folder stands for the model in it, or in its sparse/0."""
    if path.is_dir():
        folders = path, path / "sparse" / "0", path / "sparse"
        files = [folder / name for folder in folders for name in ("images.bin", "images.txt")]
        there = [file for file in files if file.is_file()]
        return pair(there[0]) if there else None
    if path.stem not in ("images", "cameras") or path.suffix not in (".bin", ".txt"):
        return None
    return path.with_stem("cameras"), path.with_stem("images")


def _cameras(document: Document) -> list[list[str]] | None:
    """Return the words of each camera; None of a file that has none."""
    if document.is_binary:
        return _cameras_in(document.data)
    lines = document.lines()
    return [line.split() for line in lines] if lines and LINE.match(" ".join(lines[0].split()[:5])) else None


def _cameras_in(data: bytes) -> list[list[str]] | None:
    try:
        (count,), at = COUNT.unpack_from(data), COUNT.size
        if count * CAMERA.size > len(data):
            return None
        kinds, cameras = dict(enumerate(CAMERA_MODELS)), []
        for _ in range(count):
            name, number, width, height = CAMERA.unpack_from(data, at)
            kind = kinds[number]
            numbers = struct.unpack_from(f"<{len(CAMERA_MODELS[kind][1])}d", data, at + CAMERA.size)
            at += CAMERA.size + 8 * len(numbers)
            cameras.append([str(name), kind, str(width), str(height), *map(repr, numbers)])
        return cameras if at == len(data) else None
    except (struct.error, KeyError):
        return None


def _images(document: Document) -> list[tuple] | None:
    """Return the id, the seven numbers, the camera and the name of each image; None of a file that has none."""
    if document.is_binary:
        return _images_in(document.data)
    lines = [line for line in document.text.splitlines() if not line.startswith("#")]
    while lines and not lines[-1].strip():
        lines.pop()
    heads = [line.split(maxsplit=9) for line in lines[::2]]
    if not heads or any(len(words) != 10 or not (words[0] + words[8]).isdecimal() for words in heads):
        return None
    if len(numbers_of(lines[0].split())) > 10:  # the rows of a matrix, of another program
        return None
    return [(int(words[0]), words[1:8], int(words[8]), words[9].strip()) for words in heads]


def _images_in(data: bytes) -> list[tuple] | None:
    try:
        (count,), at, images = COUNT.unpack_from(data), COUNT.size, []
        if count * IMAGE.size > len(data):
            return None
        for _ in range(count):
            number, *numbers, camera = IMAGE.unpack_from(data, at)
            at += IMAGE.size
            end = data.index(b"\0", at)
            name, at = data[at:end].decode(), end + 1
            (points,) = COUNT.unpack_from(data, at)
            at += COUNT.size + POINT * points
            images.append((number, numbers, camera, name))
        return images if at == len(data) else None
    except (struct.error, ValueError, OverflowError):
        return None


def _lens(document: Document, words: list[str]) -> Lens:
    name, kind, *numbers = words if len(words) > 3 else [*words, "", "", ""]
    if kind not in CAMERA_MODELS:
        raise document.refusal(f"camera {name} is of the model {kind!r}: it must be one of {', '.join(CAMERA_MODELS)}")
    model, names = CAMERA_MODELS[kind]
    width, height, *values = document.numbers(numbers, f"camera {name}", len(names) + 2)
    size, settings = document.size(width, height), dict(zip(names, values, strict=True))
    if kind == SPHERE:
        return Lens(name, SPHERE, size)
    focal = settings.pop("f", None)
    fx, fy = (focal, focal) if focal is not None else (settings.pop("fx"), settings.pop("fy"))
    return Lens(name, model, size | matrix(fx, fy, settings.pop("cx"), settings.pop("cy"), 0.5) | settings)


def refusal(record: CameraRecord) -> str | None:
    if " " in record.image:
        return "whose name has a space, which ends a name in COLMAP: rename it"
    if record.lens.model == SPHERE:
        angles = record.lens.values(ANGLES)
        whole = (-pi, pi, -pi / 2, pi / 2)  # Blender's angles are float32: pi is off by 3e-8 of itself
        if max(abs(angle - end) for angle, end in zip(angles, whole, strict=True)) > 2 * pi * EPS32:
            return "which is not the whole sphere"
    return None


def write(records: Sequence[CameraRecord]) -> Iterator[tuple[str, str]]:
    """See FileWriter. One line in cameras.txt for each lens of each camera, one image for each frame."""
    cameras, images = texts(records)
    yield "cameras.txt", cameras
    yield "images.txt", IMAGES + "".join(f"{head} {image}\n\n" for head, image in images)
    yield "points3D.txt", POINTS


def texts(records: Sequence[CameraRecord]) -> tuple[str, list[tuple[str, str]]]:
    """Return cameras.txt, and for each image its line in images.txt up to the name, and the name."""
    ids: dict[tuple[str, str], int] = {}
    images = []
    for number, record in enumerate(records, 1):
        camera = ids.setdefault((record.name, _line(record.lens)), len(ids) + 1)
        pose = record.world_to_camera
        numbers = " ".join(map(repr, (*quaternion(pose[:3, :3]).tolist(), *pose[:3, 3].tolist())))
        images.append((f"{number} {numbers} {camera}", record.image))
    return CAMERAS + "".join(f"{number} {line}\n" for (_, line), number in ids.items()), images


def _line(lens: Lens) -> str:
    """Return a camera's line in cameras.txt, without its number."""
    kind = str(word_of(MODELS, lens))
    width, height = lens.size
    if kind == SPHERE:
        return f"{kind} {width} {height} {width} {height}"
    values = matrix_of(lens.settings, 0.5) + lens.values(MODELS[kind][1])
    return f"{kind} {width} {height} {' '.join(map(repr, values))}"


PROGRAM = ProgramFiles(
    "COLMAP", "cameras.txt, cameras.bin; images.txt, images.bin", looks,
    marks="CAMERA_ID MODEL WIDTH HEIGHT PARAMS PINHOLE SIMPLE_RADIAL",
    reads="all models", lost="skew, tilt, the terms s2 and s4 of a thin prism", models=MODELS, read=read,
    poses=poses, pair=pair,
    export=FileWriter(
        "colmap", "COLMAP", "cameras.txt, images.txt and points3D.txt: calibrated lenses and poses",
        write, MODELS, refusal, ending="cameras.txt",
    ),
)  # fmt: skip
