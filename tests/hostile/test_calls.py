"""Whatever is given to the public functions: what they are for, or InputError or TypeError in one line."""

from collections import Counter
from decimal import Decimal
from fractions import Fraction
from functools import partial
from itertools import repeat

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.casting.passes import PASSES
from camera_ray_caster.core.records import Cancelled

CALLS, FEW, SEED = 1000, 120, 15

LONGEST = 500
"""Characters of a message: the names of all passes are in some."""


class Wild:
    """What fails whenever it is looked at."""

    def __repr__(self):
        raise RuntimeError("no\nrepr")

    __str__ = __repr__

    def __array__(self, *_, **__):
        raise KeyError("no\narray")

    def __index__(self):
        raise ValueError("no\nindex")

    def __eq__(self, _):
        raise ArithmeticError("no\nanswer")

    __hash__ = object.__hash__


def anything(bpy):
    """Values of every kind; none is a whole number that would be samples without end."""
    removed_camera = bpy.data.objects.new("Gone", bpy.data.cameras.new("Gone"))
    bpy.data.objects.remove(removed_camera)
    removed_scene = bpy.data.scenes.new("Gone")
    bpy.data.scenes.remove(removed_scene)
    elsewhere = bpy.data.objects.new("Elsewhere", bpy.data.cameras.new("Elsewhere"))
    return [
        None, True, False, 0, 1, 2, -1, -(2**70), 2**70, 0.0, 1.5, -0.5, 1e9, 1e308, float("nan"), float("inf"), 1j,
        Decimal("NaN"), Decimal("1.5"), Decimal("sNaN"), Fraction(1, 3), np.float32(2), np.int8(3), np.bool_(True),
        np.float64("nan"), np.datetime64("NaT", "s"), np.array(3), np.array([]), np.eye(7) / 3,
        np.array([["a\n"] * 40] * 40), np.zeros((2, 3)), np.ones((4, 3), complex), np.array([1, None, "x"], object),
        "", "left", "right", "depth", "combined", "MATERIAL", "GRID", "FAST", "float64", "f4", "V3", "x\ny", "\ud800",
        "\0", "x" * 10_000, b"depth", bytearray(9), [], (), {}, set(), {"depth"}, {"depth": 1}, ["depth", "valid"],
        ["depth", 3], [[1, 2], [3]], [[[[]]]], [None], range(3), range(10**4), iter(["valid"]), repeat("depth"),
        repeat(None), zip(),
        (name for name in ("depth", "uv")), object(), Wild(), [Wild()], Wild, int, str, float, np.float16, object, type,
        print, len, lambda *_: True, Exception("a\nb"), Ellipsis, NotImplemented, slice(3), memoryview(b"abc"),
        bpy, bpy.types.Scene, bpy.context, bpy.context.scene, bpy.context.scene.camera, bpy.context.scene.camera.data,
        bpy.data.objects["Ball"], bpy.data.objects["Ball"].data, bpy.data.worlds, removed_camera, removed_scene,
        elsewhere,
        bpy.context.evaluated_depsgraph_get(), bpy.context.evaluated_depsgraph_get().scene_eval,
        bpy.context.scene.camera.evaluated_get(bpy.context.evaluated_depsgraph_get()),
    ]  # fmt: skip


def scene_of(bpy):
    """A scene of 8 x 6 pixels with a camera before a ball."""
    bpy.ops.mesh.primitive_uv_sphere_add(location=(0, 0, -5))
    bpy.context.object.name = "Ball"
    bpy.ops.object.camera_add()
    scene = bpy.context.scene
    scene.camera = bpy.context.object
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 8, 6, 100
    return scene


def calls(bpy, count):
    """Yield functions of the package, each with arguments of which one at least is anything."""
    scene, random = scene_of(bpy), np.random.default_rng(SEED)
    camera, shapes = crc.read_camera(scene), crc.read_shapes(scene)
    read = {"scene": scene, "camera_object": None, "frame": None, "view": ""}
    made = {"camera": camera, "shapes": shapes}
    cast = {
        "passes": ("depth",), "dtype": np.float32, "shading": "MATERIAL",
        "samples": 2, "threads": 2, "cull": True, "progress": None,
    }  # fmt: skip
    functions = [
        *((function, read) for function in (crc.read_camera, crc.read_shapes, crc.read_scene)),
        (crc.cast, made),
        *((partial(crc.cast, **made), cast) for _ in range(4)),
        *((function, {"x": [0.5, 1.5], "y": 2.5}) for function in (camera.rays_at, camera.rays_jacobian_at)),
        (camera.project, {"points": [[0.0, 0.0, -5.0]], "jacobian": True}),
    ]
    for _ in range(count):
        function, good = functions[random.integers(len(functions))]
        wrong = random.random(len(good)) < random.choice([0.0, 0.3])
        wrong[random.integers(len(good))] = True
        values = anything(bpy)  # anew, since generators end
        yield (
            function,
            {
                name: values[random.integers(len(values))] if bad else value
                for (name, value), bad in zip(good.items(), wrong, strict=True)
            },
        )


def name_of(function):
    return getattr(function, "func", function).__name__


def check(bpy, count):
    """Call, and see that each call gave what it is for or refused in one line; and that some did either."""
    counts = Counter()
    for number, (function, arguments) in enumerate(calls(bpy, count)):
        what = f"call {number} of {name_of(function)}"
        try:
            function(**arguments)
        except Cancelled:  # progress has returned what is not true
            counts["done"] += 1
        except (crc.InputError, TypeError) as error:
            counts["refused"] += 1
            message = str(error)
            assert message, what
            assert "\n" not in message, what
            assert len(message) <= LONGEST, what
        except Exception as error:
            raise AssertionError(what) from error
        else:
            counts["done"] += 1
    assert min(counts["refused"], counts["done"]) > count / 50


def test_a_few_calls_end_well_or_in_one_line(blender):
    check(blender, FEW)


@pytest.mark.hostile
def test_all_calls_end_well_or_in_one_line(blender):
    check(blender, CALLS)


def test_every_pass_is_named_where_one_is_not_known(blender):
    scene = scene_of(blender)
    with pytest.raises(crc.InputError) as refused:
        crc.cast(crc.read_camera(scene), crc.read_shapes(scene), passes="depht")
    assert "'depht'" in str(refused.value)
    assert all(name in str(refused.value) for name in PASSES)
