"""What models declare of themselves: names, groups, menu numbers, settings, formulas."""

import pytest

from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cameras.model import GROUPS


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
