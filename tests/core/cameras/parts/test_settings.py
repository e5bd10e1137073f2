"""Settings as cameras read them: what a record may hold, and what the message says where it does not."""

import math

import numpy as np
import pytest

from camera_ray_caster.core.cameras.parts.parameters import values_of
from camera_ray_caster.core.cameras.parts.settings import (
    ABOVE_ZERO,
    Choice,
    Flag,
    Item,
    Number,
    Numbers,
    span,
)
from camera_ray_caster.core.records import BlenderCamera, InputError

ANGLE = Number("tilt", "Tilt", "Of the head", 0.0, 0.0, math.pi / 2, "angle")
SIZE = Number("size", "Size", "Of the hat", 1.0, ABOVE_ZERO)
SIDE = Choice("side", "Side", "Of the street", "LEFT", (Item("LEFT", "Left", "", 0), Item("RIGHT", "Right", "", 1)))
PAIR = Numbers("pair", "Pair", "Of shoes", (1.0, 2.0), ("Left", "Right"))
WORN = Flag("worn", "Worn", "Out", False)


def raw(**settings):
    return BlenderCamera("Eye", "PERSP", np.eye(4), settings=settings)


@pytest.mark.parametrize(
    ("setting", "value", "message"),
    [
        (ANGLE, 2.0, "tilt of camera 'Eye' is 114.592 degrees (2 radians): it must be from 0 degrees to 90 degrees"),
        (ANGLE, math.nan, "tilt of camera 'Eye' is nan degrees (nan radians): it must be"),
        (ANGLE, "up", "tilt of camera 'Eye' is 'up': it must be"),
        (SIZE, 0.0, "size of camera 'Eye' is 0: it must be above 0"),
        (SIZE, math.inf, "size of camera 'Eye' is inf: it must be above 0"),
        (SIDE, "UP", "side of camera 'Eye' is 'UP': it must be one of LEFT, RIGHT"),
        (PAIR, (1.0,), "pair of camera 'Eye' is (1.0,): it must be 2 finite numbers"),
        (PAIR, (1.0, math.inf), "2 finite numbers"),
    ],
)
def test_what_has_no_meaning_is_refused_in_one_line(setting, value, message):
    with pytest.raises(InputError) as caught:
        setting.read(raw(**{setting.name: value}))
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_setting_that_a_record_lacks_is_named():
    with pytest.raises(InputError, match="camera 'Eye' has no setting tilt"):
        ANGLE.read(raw())


def test_a_limit_that_float32_has_rounded_up_is_still_the_limit():
    assert ANGLE.read(raw(tilt=float(np.float32(math.pi / 2)))) > math.pi / 2
    with pytest.raises(InputError):
        ANGLE.read(raw(tilt=1.5709))


def test_a_model_may_narrow_a_range():
    assert SIZE.read(raw(size=5.0)) == 5.0
    with pytest.raises(InputError, match="above 0, up to 2"):
        SIZE.read(raw(size=5.0), high=2.0)
    with pytest.raises(InputError, match=r"is 1e\+300: it must be above 0, up to 1e\+152$"):
        SIZE.read(raw(size=np.float64(1e300)))


def test_swapped_ends_are_a_span_and_equal_ones_are_none():
    low, high = (Number(name, name, "", 0.0) for name in ("low", "high"))
    assert span(raw(low=2.0, high=-1.0), low, high) == (2.0, -1.0)
    with pytest.raises(InputError, match="low and high of camera 'Eye' are both 2: set them apart"):
        span(raw(low=2.0, high=2.0), low, high)


def test_values_are_plain():
    values = values_of((SIDE, PAIR, WORN), raw(side="LEFT", pair=np.array([1.0, 2.0]), worn=True))
    assert values == {"side": "LEFT", "pair": [1.0, 2.0], "worn": True}
