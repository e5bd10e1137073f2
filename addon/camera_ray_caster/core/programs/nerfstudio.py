"""transforms.json of nerfstudio and instant-ngp: one lens for all frames, or one per frame, and the poses of frames.

The center of the first pixel is (0.5, 0.5). k3 and k4 are the coefficients of r^6 and r^8; OpenCV's pinhole has no r^8.
Entries of the whole file count before those of a frame; if it has one coefficient, those of frames do not count at all.
Without w and h the pictures are as large as the frame, as in the files of NeRF, which have camera_angle_x alone.
EQUIRECTANGULAR is the whole sphere; an ORTHOPHOTO's rays are parallel. Poses are from Blender's camera frame to the
world. Written, all frames are of one camera model, and distortion is stored per frame, because readers do not agree on
the order of p1 and p2 in the head of the file. A frame of a rolling shutter has the pose at the first row that is read,
transform_matrix_rs at the last one, which are gsplat's viewmats and viewmats_rs (from the world, with y down), their
times in seconds from the frame's, and the order by gsplat's name.
Reference: nerfstudio documentation, Data conventions; its reader, nerfstudio_dataparser.py.
"""

from collections.abc import Iterable, Iterator, Sequence
from math import pi, tan
from typing import Any

from ..records import InputError
from ..text_forms.json_text import as_text
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import ARIA_TERMS, Lens, matrix, matrix_of, word_of
from .parts.placed import FROM_BLENDER, Placed, Rolling, pose_in
from .parts.program import SEPARATELY, CameraRecord, FileWriter, ProgramFiles, written

MODELS = {
    "OPENCV": ("OPENCV_PINHOLE", ("k1", "k2", "k3", "p1", "p2")),
    "OPENCV_FISHEYE": ("OPENCV_FISHEYE", ("k1", "k2", "k3", "k4")),
}
MODELS |= {"PINHOLE": MODELS["OPENCV"], "SIMPLE_PINHOLE": MODELS["OPENCV"], "PERSPECTIVE": MODELS["OPENCV"]}
MODELS |= {"FISHEYE": MODELS["OPENCV_FISHEYE"]}
"""Our model, and its coefficients. Those of a pinhole count, too: nerfstudio distorts by them whatever the model is
called.
"""
WRITTEN = written(MODELS, "OPENCV", "OPENCV_FISHEYE")
COEFFICIENTS, LIST = ("k1", "k2", "k3", "k4", "p1", "p2"), "distortion_params"
"""All coefficients, in the order of the list that may stand in their place."""
FISHEYE624, SPHERE, PARALLEL = "FISHEYE624", "EQUIRECTANGULAR", "ORTHOPHOTO"
SIZES, FOCAL, CENTER = ("w", "h"), ("fl_x", "fl_y", "camera_angle_x", "camera_angle_y"), ("cx", "cy")
OF_LENS = (*SIZES, *FOCAL, *CENTER, *COEFFICIENTS, LIST, "camera_model", "is_fisheye")
"""All entries of which a lens is made."""
LAST_ROW, READOUT, ROW_TIMES = "transform_matrix_rs", "rolling_shutter", "rolling_shutter_offsets"
READOUTS = "TOP_TO_BOTTOM", "BOTTOM_TO_TOP", "LEFT_TO_RIGHT", "RIGHT_TO_LEFT"
SHUTTER = -0.25 / 24, 0.25 / 24


def looks(document: Document) -> bool:
    entries = document.entries
    return entries.has("frames") and entries.parts("frames") is not None


def read(document: Document) -> list[Lens]:
    entries, frames = document.entries, document.entries.parts("frames")
    if any(name.startswith("ftheta_p") for name in entries):
        raise document.refusal("it has an f-theta lens of instant-ngp, which is not read: give a file of NVIDIA's")
    for name in ("latlong", "equirectangular", "orthographic"):
        if entries.text(name) not in ("", "False", "0.0"):
            raise document.refusal(f"its entry {name} of instant-ngp is not read: choose that model for the camera")
    shared = any(map(entries.has, ("fl_x", "camera_angle_x"))) or entries.text("camera_model") == SPHERE
    lenses = {lens.name: lens for lens in _of_frames(document, frames)}
    if not frames and not shared:
        raise document.refusal("it has no fl_x, and no frames")
    if len(lenses) < 2 and shared:
        return [_lens(document, frames[0] if frames else Fields(document, {}), "camera")]
    return list(lenses.values())


def poses(document: Document) -> list[Placed]:
    frames = document.entries.parts("frames")
    placed = []
    for number, (frame, lens) in enumerate(zip(frames, _of_frames(document, frames), strict=True)):
        document.check()
        name = frame.text("file_path", str(number))
        named = frame.labeled(name)
        pose = pose_in(named, "transform_matrix") @ FROM_BLENDER
        placed.append(Placed(lens.name, name, None, pose, rolling=_rolling(named) if frame.has(LAST_ROW) else None))
    return placed


def _rolling(frame: Fields) -> Rolling:
    """Return the rolling shutter of a frame; without times of its rows it is open for half a frame in 24 a second."""
    first, last = frame.numbers(ROW_TIMES, 2, SHUTTER)
    if first >= last:
        raise frame.refusal(ROW_TIMES, "the seconds from the frame's time to the first row and, later, the last one")
    readout = frame.word(READOUT, [f"ROLLING_{readout_name}" for readout_name in READOUTS], f"ROLLING_{READOUTS[0]}")
    return Rolling(readout.removeprefix("ROLLING_"), (first, last), pose_in(frame, LAST_ROW) @ FROM_BLENDER)


def _of_frames(document: Document, frames: list[Fields]) -> list[Lens]:
    """Return the lens of each frame; equal lenses are one, by the name of its first frame. Raises InputError."""
    by_entries: dict[str, Lens] = {}
    by_lens: dict[str, Lens] = {}
    lenses = []
    for number, frame in enumerate(frames):  # a file may have 100,000 frames
        key = frame.key(OF_LENS)
        if key not in by_entries:
            document.check()
            lens = _lens(document, frame, frame.text("file_path", str(number)))
            by_entries[key] = by_lens.setdefault(str(lens[1:]), lens)
        lenses.append(by_entries[key])
    return lenses


def _lens(document: Document, frame: Fields, name: str) -> Lens:
    whole, entries = document.entries, frame.merged(document.entries)
    fisheye = entries.text("is_fisheye") not in ("", "False", "0.0")
    kind = entries.word("camera_model", (*MODELS, FISHEYE624, SPHERE, PARALLEL),
                        "OPENCV_FISHEYE" if fisheye else "OPENCV")  # fmt: skip
    sides = [entries.number(side) if entries.has(side) else None for side in SIZES]
    size = document.size(*sides)
    if kind == SPHERE:
        return Lens(name, SPHERE, size)
    frame_size = document.picture_size or (1, 1)
    width, height = (side or frame_side for side, frame_side in zip(sides, frame_size, strict=True))
    focal = _focal(entries, "x", width)
    has_y = entries.has("fl_y") or entries.has("camera_angle_y")
    focal_y = _focal(entries, "y", height) if has_y else focal
    cx, cy = (entries.number(name, side / 2) for name, side in (("cx", width), ("cy", height)))
    if kind == PARALLEL:
        return Lens(name, "ORTHO", size | _orthographic(entries, (focal, focal_y), (cx, cy), (width, height)))
    size |= matrix(focal, focal_y, cx, cy, 0.5)
    if kind == FISHEYE624:
        numbers = (whole if whole.has(LIST) else frame).numbers(LIST, len(ARIA_TERMS))
        return Lens(name, FISHEYE624, size | dict(zip(ARIA_TERMS, numbers, strict=True)))
    model, terms = MODELS[kind]
    coefficients = _coefficients(frame if not any(map(whole.has, (LIST, *COEFFICIENTS))) else whole)
    for term in COEFFICIENTS:
        if term not in terms and coefficients.pop(term):
            raise document.refusal(f"{term} is not 0, but OpenCV's {model[7:].lower()} has no such coefficient")
    return Lens(name, model, size | coefficients)


def _focal(entries: Fields, axis: str, side: float) -> float:
    """Return the focal length along x or y, in pixels."""
    name = f"camera_angle_{axis}"
    if entries.has(f"fl_{axis}") or not entries.has(name):
        return entries.number(f"fl_{axis}")
    angle = entries.number(name)
    if not 0 < angle < pi:
        raise entries.document.refusal(f"{name} is {angle:g}: it must be above 0 and below pi")
    return side / (2 * tan(angle / 2))


def _orthographic(entries: Fields, focal, center, size) -> dict[str, Any]:
    """Return the settings of parallel rays, fl_x and fl_y of which pass through a unit of length."""
    if focal[0] != focal[1] or focal[0] <= 0:
        problem = f"fl_x and fl_y of an {PARALLEL} are {focal[0]:g} and {focal[1]:g}"
        raise entries.document.refusal(f"{problem}: they must be equal")
    longer = max(size)
    return {
        "ortho_scale": longer / focal[0], "sensor_fit": "AUTO",
        "shift_x": (size[0] / 2 - center[0]) / longer, "shift_y": (center[1] - size[1] / 2) / longer,
    }  # fmt: skip


def _coefficients(owner: Fields) -> dict[str, float]:
    """Return all coefficients."""
    if owner.has(LIST):
        return dict(zip(COEFFICIENTS, owner.numbers(LIST, len(COEFFICIENTS)), strict=True))
    return {term: owner.number(term, 0.0) for term in COEFFICIENTS}


def write(records: Sequence[CameraRecord]) -> Iterator[tuple[str, str]]:
    """See FileWriter. One file with all cameras and frames. Raises InputError for several camera models."""
    yield "transforms.json", as_text(transforms(records))


def transforms(records: Sequence[CameraRecord]) -> dict[str, Any]:
    """Return the entries of transforms.json. Raises InputError for several camera models."""
    return {"camera_model": camera_model(records), "frames": [frame_of(record) for record in records]}


def camera_model(records: Iterable[CameraRecord]) -> str:
    """Return the camera model of all records. Raises InputError for several."""
    kinds: dict[str, str] = {}
    for record in records:
        kinds.setdefault(str(word_of(WRITTEN, record.lens)), record.name)
    if len(kinds) > 1:
        several = " and ".join(f"{name!r} is {kind}" for kind, name in kinds.items())
        raise InputError(f"transforms.json has one camera_model, but camera {several}: {SEPARATELY}")
    return next(iter(kinds))


def frame_of(record: CameraRecord) -> dict[str, Any]:
    """Return the entry of a picture in transforms.json."""
    terms = MODELS[str(word_of(WRITTEN, record.lens))][1]
    values = matrix_of(record.lens.settings, 0.5) + record.lens.values(terms)
    width, height = record.lens.size
    size = {"file_path": record.image, "w": width, "h": height}
    lens = dict(zip(("fl_x", "fl_y", "cx", "cy", *terms), values, strict=True))
    pose = {"transform_matrix": record.blenders.tolist()}
    if record.rolling is not None:
        pose |= {
            LAST_ROW: (record.rolling.pose @ FROM_BLENDER).tolist(),
            READOUT: f"ROLLING_{record.rolling.readout}",
            ROW_TIMES: list(record.rolling.offsets),
        }
    return size | lens | pose | record.remark


PROGRAM = ProgramFiles(
    "nerfstudio", "transforms.json, of NeRF and instant-ngp, too", looks,
    marks="frames transform_matrix camera_angle_x fl_x file_path camera_model",
    reads="OPENCV, PINHOLE, OPENCV_FISHEYE, FISHEYE624, EQUIRECTANGULAR, ORTHOPHOTO",
    lost="several camera models in one file; k4 to k6 of a pinhole", read=read, poses=poses,
    export=FileWriter(
        "nerfstudio", "nerfstudio", "transforms.json: pinholes and fisheyes, and poses", write, WRITTEN, rolling=True,
        ending="transforms.json",
    ),
)  # fmt: skip
