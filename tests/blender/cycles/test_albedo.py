"""The colors of materials against those of Cycles, at normal incidence: a grid of squares, one material each."""

import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes
from camera_ray_caster.core.cast import cast

from .material_examples import LIT, PARTLY, RED, colored, painted, shader
from .test_alpha import cycles, plane, scene  # noqa: F401

COLUMNS, CELL = 8, 6
"""Squares in a row, and pixels along each."""

CLOSE = 0.02


def grid(scene, materials):  # noqa: F811
    """Squares of unit size side by side, one material each, and a camera above them that has CELL pixels for each."""
    rows = -(-len(materials) // COLUMNS)
    for k, make in enumerate(materials):
        item = plane(f"Square {k}", 0, 1, k + 1)
        item.location = k % COLUMNS, k // COLUMNS, 0
        make(item)
    camera = scene.camera.data
    camera.type, camera.ortho_scale = "ORTHO", max(COLUMNS, rows)
    scene.camera.location = (COLUMNS - 1) / 2, (rows - 1) / 2, 5
    scene.render.resolution_x, scene.render.resolution_y = COLUMNS * CELL, rows * CELL
    shapes = read_shapes(scene)
    images = cast(read_camera(scene), shapes, passes=("albedo", "object_index"))
    return images, shapes, list(cycles(scene, "Diffuse Color", "Glossy Color", "Transmission Color", "Emission"))


def test_colors_are_those_of_cycles(scene):  # noqa: F811
    """Of emission before its strength."""
    images, shapes, (diffuse, glossy, transmission, emission) = grid(scene, LIT.values())
    index, strengths = images["object_index"], {"emission": 5.0}
    wrong = {}
    for k, name in enumerate(LIT, 1):
        here = index == k
        assert here.sum() == CELL * CELL, name
        total = (diffuse + glossy + transmission + emission / strengths.get(name, 1.0))[here]
        off = np.abs(images["albedo"][here] - np.clip(total, 0, None)).max(axis=1)
        if np.median(off) > CLOSE or (np.mean(off > CLOSE) > 0.1):
            wrong[name] = images["albedo"][here].mean(0).round(3), total.mean(0).round(3)
    assert not wrong
    assert {reason for _, reason in shapes.unread} == {
        "its image 'missing' is missing: it is shown in magenta",
        "the image of an Image Texture is missing: it is shown in magenta",
    }


def test_metal_and_glass_leave_diffuse_what_they_do_in_cycles(scene):  # noqa: F811
    images, _, (diffuse, *_) = grid(scene, PARTLY.values())
    for k, (metallic, transmission) in enumerate(PARTLY, 1):
        here = images["object_index"] == k
        diffuse_albedo = images["albedo"][here] * (1 - metallic) * (1 - transmission)
        np.testing.assert_allclose(diffuse_albedo, diffuse[here], atol=CLOSE)


KINDS = "POINT", "TEXTURE", "VECTOR", "NORMAL"
"""Of a Mapping node."""


def turned(mapped):
    return {"scale": (0.8, 1.7, 0.6), "turn": (0.2, 0.3, 0.5), "mapped": mapped}


def repeated(item):
    """Generated coordinates are those before the modifiers."""
    modifier = item.modifiers.new("Array", "ARRAY")
    modifier.count, modifier.relative_offset_displace = 2, (0.4, 0.0, 0.1)


def tapered(item):
    """Also where a modifier moves the vertices."""
    modifier = item.modifiers.new("Deform", "SIMPLE_DEFORM")
    modifier.deform_method, modifier.deform_axis, modifier.factor = "TAPER", "X", 0.5


@pytest.mark.parametrize(
    ("options", "change"),
    [
        ({"scale": (1.7, 1.7, 1.0)}, None),
        *(pytest.param(turned(kind), None, marks=pytest.mark.full) for kind in KINDS),
        ({"coordinates": "Generated", "scale": (1.3, 1.0, 1.0)}, tapered),
        pytest.param({"coordinates": "Generated"}, repeated, marks=pytest.mark.full),
        pytest.param({"coordinates": "Object"}, repeated, marks=pytest.mark.full),
    ],
)
def test_an_image_is_interpolated_as_in_cycles(scene, options, change):  # noqa: F811
    """A picture of it, at every pixel; also at its edges, where it repeats."""
    make = colored(painted(**options))
    item = plane("Square", 0, 2, 1)
    make(item)
    if change:
        change(item)
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", 2.0
    albedo = cast(read_camera(scene), read_shapes(scene), passes="albedo")["albedo"]
    (diffuse,) = cycles(scene, "Diffuse Color")
    np.testing.assert_allclose(albedo, diffuse, atol=CLOSE)


def test_glow_is_added_to_light(scene):  # noqa: F811
    """Emission with its strength in ``combined``, as in Cycles."""
    shader("Emission", Color=RED, Strength=3.0)(plane("Square", 0, 9, 1))
    image = cast(read_camera(scene), read_shapes(scene), passes="combined")["combined"]
    (combined,) = cycles(scene, "Combined")
    np.testing.assert_allclose(image[..., :3], combined[..., :3], atol=1e-5)


@pytest.mark.parametrize("kind", ["Object", "Normal", "Reflection"])
def test_what_is_beyond_is_named_with_material_and_node(scene, kind):  # noqa: F811
    item = plane("Square", 0, 2, 1)
    colored(painted(coordinates=kind))(item)
    item.data.materials[0].name = "Shiny"
    left_out = read_shapes(scene).unread
    assert bool(left_out) == (kind != "Object")
    for name, reason in left_out:
        assert name == "Shiny"
        assert f"(Texture Coordinate): output {kind}" in reason
