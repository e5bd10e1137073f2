"""mrcal's .cameramodel: a Python dictionary with the lens model, its intrinsics, the imager's size and the pose.

The center of the first pixel is (0, 0). mrcal's stereographic lens is the unified camera with xi = 1 and twice the
focal length; its LONLAT is the equirectangular panorama. An entry that stands twice is refused. Older files have the
model as distortion_model, DISTORTION_OPENCV8, and words as byte strings. extrinsics, rt_cam_ref in newer ones, are the
rotation vector and the translation from the world to the camera, x right and y down. A CAHVOR or CAHVORE camera is
turned to the axis of its distortion: see ``parts.cahvor_lens``.
Reference: mrcal documentation, Lens models; The .cameramodel file format.
"""

import ast
import re
from collections.abc import Iterator, Sequence
from math import cos, pi, sin
from typing import Any
from warnings import catch_warnings

import numpy as np

from ..cameras.parts.settings import LIMIT_ROUNDING
from ..maths.rotations import half_turn_vector
from ..records import InputError
from .parts.cahvor_lens import lens_of
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import ANGLES, Lens, matrix, matrix_of, word_of
from .parts.placed import Placed, inverted, of_rotation
from .parts.program import CameraRecord, FileWriter, ProgramFiles

TERMS = ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4")
STEREOGRAPHIC, LONLAT = "LENSMODEL_STEREOGRAPHIC", "LENSMODEL_LONLAT"
MODELS = {
    "LENSMODEL_PINHOLE": ("OPENCV_PINHOLE", ()),
    **{f"LENSMODEL_OPENCV{count}": ("OPENCV_PINHOLE", TERMS[:count]) for count in (4, 5, 8, 12)},
    STEREOGRAPHIC: ("UCM", ("unified_xi",)),
    LONLAT: ("EQUIRECTANGULAR", ANGLES),
}

CAHVOR = re.compile(r"LENSMODEL_CAHVOR(?:E_linearity=([-+.\deE]+))?")
MARK = re.compile("LENSMODEL_|DISTORTION_[A-Z]")
"""What every file has; DISTORTION_ before mrcal 1.0."""
PHOTON_VISION = "cameraIntrinsics"
"""What the calibrations of PhotonVision have, beside the name of mrcal's model."""
NAMES = "lensmodel", "lens_model", "distortion_model"

LONGEST = 1 << 20
"""Characters of a file: Python's reader takes a second for them."""


def looks(document: Document) -> bool:
    return MARK.search(document.text) is not None and PHOTON_VISION not in document.text


def read(document: Document) -> list[Lens]:
    entries = _entries(document)
    if (cahvor := _cahvor(document, entries)) is not None:
        return [cahvor[0]]
    kind = entries.word("lensmodel", MODELS)
    model, terms = MODELS[kind]
    width, height = entries.numbers("imagersize", 2)
    size = document.size(width, height)
    if kind in (STEREOGRAPHIC, LONLAT):
        fx, fy, cx, cy = entries.numbers("intrinsics", 4)
        if kind == LONLAT:
            return [Lens("", model, size | _edges(document, fx, fy, cx, cy, width, height))]
        return [Lens("", model, size | matrix(2 * fx, 2 * fy, cx, cy) | {"unified_xi": 1.0})]
    first, coefficients = (numbers := entries.numbers("intrinsics", len(terms) + 4))[:4], numbers[4:]
    return [Lens("", model, size | matrix(*first) | dict(zip(terms, coefficients, strict=True)))]


def poses(document: Document) -> list[Placed]:
    entries = _entries(document)
    entry = entries.first("rt_cam_ref", "extrinsics")
    if not entries.has(entry):
        return []
    numbers = entries.numbers(entry, 6)
    pose = inverted(of_rotation(document, numbers[:3], numbers[3:], entry))
    if (cahvor := _cahvor(document, entries)) is not None:
        pose[:3, :3] @= cahvor[1]
    return [Placed("", "", None, pose)]


def _cahvor(document: Document, entries: Fields) -> tuple[Lens, np.ndarray] | None:
    """Return a CAHVOR or CAHVORE lens and its axes in the camera's frame; None of any other."""
    kind = CAHVOR.fullmatch(entries.text("lensmodel"))
    if kind is None:
        return None
    fx, fy, cx, cy, alpha, beta, *distortion = entries.numbers("intrinsics", 9 if kind[1] is None else 12)
    axis = (sin(alpha) * cos(beta), sin(beta), cos(alpha) * cos(beta))
    linearity = 1.0 if kind[1] is None else document.numbers([kind[1]], "linearity", 1)[0]
    rows = [(fx, 0.0, cx), (0.0, fy, cy), (0.0, 0.0, 1.0)]
    size = document.size(*entries.numbers("imagersize", 2))
    return lens_of(document, size, rows, axis, distortion[:3], distortion[3:] or [0.0] * 3, linearity)


def _entries(document: Document) -> Fields:
    """Return the entries of a file, with the lens model of today's name. Raises InputError."""
    if len(document.text) > LONGEST:
        raise document.refusal(f"it names a lens model of mrcal, but is longer than {LONGEST:,} characters")
    try:
        with catch_warnings(action="ignore", category=SyntaxWarning):  # of a text that is not such a file
            values = _once(ast.parse(document.text.strip(), mode="eval").body, document)
    except InputError:
        raise
    except (ValueError, TypeError, SyntaxError, RecursionError, MemoryError) as error:
        raise document.refusal("it names a lens model of mrcal, but is not a cameramodel file of mrcal") from error
    values = values if isinstance(values, dict) else {}
    kind = next((values[name] for name in NAMES if name in values), None)
    kind = kind.decode("ascii", "replace") if isinstance(kind, bytes) else kind
    if isinstance(kind, str):
        kind = kind.replace("DISTORTION_", "LENSMODEL_")
        kind = "LENSMODEL_PINHOLE" if kind == "LENSMODEL_NONE" else kind
    return Fields(document, values | {"lensmodel": kind})


def _once(tree: ast.expr, document: Document) -> Any:
    """Return the value of a literal. Raises InputError for a dictionary with a name twice."""
    if isinstance(tree, ast.Dict):
        names = [ast.literal_eval(name) for name in tree.keys if name is not None]
        twice = [name for name in names if names.count(name) > 1]
        if twice:
            raise document.refusal(f"it has {twice[0]!r} twice: leave one out")
    return ast.literal_eval(tree)


def _edges(document: Document, fx, fy, cx, cy, width, height) -> dict[str, Any]:
    """Return the panorama of fx and fy, pixels per radian, and cx and cy, in the viewing direction."""
    if min(fx, fy) <= 0:
        raise document.refusal("its pixels per radian must be above 0")
    low, high = (cy - height + 0.5) / fy, (cy + 0.5) / fy
    if max(-low, high) > pi / 2 + LIMIT_ROUNDING:
        raise document.refusal("its picture reaches beyond a pole, which no panorama of Blender does")
    edges = (-0.5 - cx) / fx, (width - 0.5 - cx) / fx, max(low, -pi / 2), min(high, pi / 2)
    return dict(zip(ANGLES, edges, strict=True))


def refusal(record: CameraRecord) -> str | None:
    stereographic = word_of(MODELS, record.lens) == STEREOGRAPHIC
    return "whose unified_xi is not 1" if stereographic and record.lens.settings["unified_xi"] != 1 else None


def write(records: Sequence[CameraRecord]) -> Iterator[tuple[str, str]]:
    """See FileWriter. One file per camera and frame."""
    for record in records:
        pose = record.world_to_camera
        numbers = {
            "intrinsics": _intrinsics(record.lens),
            "extrinsics": [*half_turn_vector(pose[:3, :3]).tolist(), *pose[:3, 3].tolist()],
            "imagersize": list(record.lens.size),
        }
        lines = "".join(f"    '{name}': [ {', '.join(map(repr, values))} ],\n" for name, values in numbers.items())
        kind = word_of(MODELS, record.lens)
        yield f"{record.stem}.cameramodel", f"{{\n    'lensmodel': '{kind}',\n{lines}}}\n"


def _intrinsics(lens: Lens) -> list[float]:
    kind = str(word_of(MODELS, lens))
    if kind == LONLAT:
        left, right, low, high = lens.values(ANGLES)
        width, height = lens.size
        fx, fy = width / (right - left), height / (high - low)
        return [fx, fy, -left * fx - 0.5, high * fy - 0.5]
    fx, fy, cx, cy = matrix_of(lens.settings)
    if kind == STEREOGRAPHIC:
        return [fx / 2, fy / 2, cx, cy]
    return [fx, fy, cx, cy, *lens.values(MODELS[kind][1])]


PROGRAM = ProgramFiles(
    "mrcal", ".cameramodel", looks, marks="lensmodel intrinsics extrinsics imagersize",
    reads="PINHOLE, OPENCV4 to OPENCV12, STEREOGRAPHIC, LONLAT, CAHVOR, CAHVORE",
    lost="splined models are refused",
    models=MODELS, read=read, poses=poses,
    export=FileWriter(
        "mrcal", "mrcal",
        "<camera>_<frame>.cameramodel: OpenCV's lenses, panoramas and stereographic fisheyes, and poses",
        write, MODELS, refusal, ending=".cameramodel",
    ),
)  # fmt: skip
