"""What models declare of themselves: names, groups, menu numbers, settings, formulas."""

from dataclasses import dataclass, replace
from functools import partial

import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cameras.model import GROUPS
from camera_ray_caster.core.cameras.perspective import Perspective


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.key)
def test_a_model_says_what_it_is(model):
    assert model.label
    assert model.description
    assert model.group in GROUPS
    assert (model.number is None) == (model.group == "Blender's Own")
    assert all(step.words and step.symbols for step in model.FORMULA)
    assert len({setting.name for setting in model.SETTINGS}) == len(model.SETTINGS)


def test_menu_numbers_are_those_of_files_that_were_saved():
    """A new model gets a number of its own: what stands here never changes."""
    numbers = {model.key: model.number for model in MODELS if model.number is not None}
    saved = (
        "CAMERA_OBSCURA", "FISHEYE_ORTHOGRAPHIC", "FISHEYE_STEREOGRAPHIC", "OPENCV_PINHOLE", "OPENCV_FISHEYE",
        "OMNIMAX", "DOME_MASTER", "CYLINDRICAL", "STEREOGRAPHIC_PANORAMA", "GENERAL_LINEAR", "CROSS_SLIT",
        "PUSHBROOM", "PENCIL", "TWISTED_ORTHOGRAPHIC", "STRIP", "OMNIDIRECTIONAL_STEREO", "UCM", "EUCM",
        "DOUBLE_SPHERE", "FISHEYE624", "THIN_PRISM_FISHEYE", "FOV", "DIVISION", "FTHETA", "OCAM", "RAY_TABLE",
        "SCANNER",
    )  # fmt: skip
    assert numbers | {key: number for number, key in enumerate(saved, 1)} == numbers
    taken = set(numbers.values())
    free = min(set(range(1, len(numbers) + 2)) - taken)  # 0 is Blender's own type
    for key, number in numbers.items():
        owners = " and ".join(sorted(other for other in numbers if numbers[other] == number))
        assert owners == key, f"{owners} have the number {number}: the lowest free one is {free}"
        assert 0 < number <= len(numbers), f"{key} has the number {number}: the lowest free one is {free}"


def test_a_setting_that_models_share_is_declared_once():
    declared = {}
    for model in MODELS:
        for setting in model.SETTINGS:
            assert declared.setdefault(setting.name, setting) is setting, f"{model.key}: {setting.name}"


def test_the_old_names_of_a_model_work_with_a_warning():
    """`frame` is `size`; a device's `size` is `device_size`."""
    with pytest.warns(DeprecationWarning, match="device_size"):

        @dataclass(frozen=True)
        class Device(Perspective):
            @property
            def size(self):
                return 8, 4

    model = Device(*(getattr(crc.camera("PERSP", (6, 5)).model, name) for name in ("size", "window")))
    assert (model.size, model.device_size) == ((6, 5), (8, 4))
    with pytest.warns(DeprecationWarning, match="Model.size"):
        assert model.frame == (6, 5)
    for make in (partial(Perspective, window=model.window), partial(replace, model)):
        with pytest.raises(TypeError, match="give size="):
            make(frame=(6, 5))

    class Own(Perspective):
        def __init__(self, frame):
            super().__init__(frame, model.window)

    assert Own(frame=(6, 5)).size == (6, 5)
