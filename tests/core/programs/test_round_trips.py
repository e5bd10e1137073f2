"""Random rigs through every program that both writes and reads: lenses and poses come back to 1e-12."""

from dataclasses import replace
from itertools import chain
from math import pi

import numpy as np
import pytest

from camera_ray_caster.core import cameras
from camera_ray_caster.core.names import frame_digits
from camera_ray_caster.core.programs import PROGRAMS
from camera_ray_caster.core.programs.parts.document import Document
from camera_ray_caster.core.programs.parts.lens import ANGLES, FRAME_SIZE, Lens, word_of
from camera_ray_caster.core.programs.parts.program import CameraRecord
from camera_ray_caster.core.programs.reading.camera_poses import placed_in
from camera_ray_caster.core.programs.reading.lenses import lenses_of
from camera_ray_caster.core.records import InputError
from camera_ray_caster.core.units import factor

from ...tiers import examples

BOTH = [program for program in PROGRAMS if program.export and program.export.files and (program.read or program.poses)]
CASES = [(program, word) for program in BOTH for word in program.export.models or [""]]
MODELS = {model.key: model for model in cameras.MODELS}
FRAMES = 1, 2, 5
SEEDS = 8
NEAR = 1e-12
STEREOGRAPHIC = "LENSMODEL_STEREOGRAPHIC"
"""A model without a number of its own: xi is 1."""


def lens_of(random, name, model, terms):
    """A lens with all the numbers that a model of a program has; a panorama is the whole sphere."""
    size = dict(zip(FRAME_SIZE, (640.0, 480.0), strict=True))
    if set(terms) == set(ANGLES):
        return Lens(name, model, size | dict(zip(ANGLES, (-pi, pi, -pi / 2, pi / 2), strict=True)))
    numbers = random.uniform((300, 300, 310, 230), (400, 400, 330, 250)).tolist()
    matrix = dict(zip(("fx", "fy", "cx", "cy"), numbers, strict=True))
    return Lens(name, model, size | matrix | {term: random.uniform(0.001, 0.02) for term in terms})


def records_of(program, word, random):
    """A rig of two cameras that moves."""
    mounts, moves = [pose(random) for _ in "ab"], [pose(random) for _ in FRAMES]
    lenses = [Lens("", "", {})] * 2
    if word:
        lenses = [lens_of(random, f"{name}_", *program.export.models[word]) for name in "ab"]
        if word == STEREOGRAPHIC:
            lenses = [lens._replace(settings=lens.settings | {"unified_xi": 1.0}) for lens in lenses]
    return [
        CameraRecord(name, f"{name}_{frame_digits(frame)}", lens, move @ mount, frame, frame / 24)
        for frame, move in zip(FRAMES, moves, strict=True)
        for name, lens, mount in zip("ab", lenses, mounts, strict=True)
    ]


def pose(random):
    """A rotation and a place."""
    rotation = np.linalg.qr(random.normal(size=(3, 3)))[0]
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = rotation * np.linalg.det(rotation), random.uniform(-10, 10, 3)
    return matrix


def is_same(lens, other):
    """Whether two lenses have the same model and the same numbers, also those that are not told. A size that a file
    does not tell is that of the frame.
    """
    if lens.model != other.model:
        return False
    defaults = {setting.name: setting.default for setting in MODELS[lens.model].SETTINGS}
    sizes = {} if all(other.size) else dict.fromkeys(FRAME_SIZE, 0.0)
    names = sorted({*lens.settings, *other.settings})
    both = [[{**defaults, **item.settings, **sizes}.get(name, 0.0) for name in names] for item in (lens, other)]
    return np.allclose(*both, rtol=NEAR, atol=NEAR)


@pytest.mark.one_for_each("program")
@pytest.mark.parametrize(("program", "word"), CASES, ids=[f"{program.export.key}-{word}" for program, word in CASES])
def test_a_random_rig_comes_back(program, word, tmp_path):
    for seed in range(examples(SEEDS)):
        records = records_of(program, word, np.random.default_rng(seed))
        refused = {program.export.refusal(record) for record in records} - {None}
        assert not refused
        folder = tmp_path / str(seed)
        folder.mkdir()
        for name, content in program.export.files([in_unit(record, program.unit) for record in records]):
            (folder / name).write_text(content)
        paths = [str(path) for path in sorted(folder.iterdir())]
        if program.read and word:
            lenses = list(chain.from_iterable(read(lenses_of, path, "OPENCV_PINHOLE", (640, 480)) for path in paths))
            for record in records:
                assert word_of(program.export.models, record.lens) is not None
                assert any(is_same(record.lens, lens) for lens in lenses), (record.lens, lenses)
        if program.poses:
            documents = [Document(path, (640, 480)) for path in paths]
            placed = [entry.pose for document in documents for entry in read(placed_in, document, 1.0)]
            wanted = [record.pose for record in records]
            assert came_back(placed, wanted) or (len(placed) == 2 and came_back(placed, mounted(wanted)))


def read(reader, *arguments):
    """What a reader returns; nothing of a file that has the other part, lenses or poses."""
    try:
        return reader(*arguments)
    except InputError:
        return []


def in_unit(record, unit):
    """A camera whose place is in a program's unit."""
    scaled = record.pose.copy()
    scaled[:3, 3] *= factor(unit, 1.0)
    return replace(record, pose=scaled)


def mounted(wanted):
    """The poses of the cameras beside the first one, of a program whose rigs stand still."""
    return [np.linalg.inv(wanted[0]) @ pose for pose in wanted[:2]]


def came_back(placed, wanted):
    """Whether each pose is there."""
    return all(any(np.abs(pose - other).max() < 20 * NEAR for other in placed) for pose in wanted)
