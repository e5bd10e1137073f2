"""Meshes of other libraries, with the colors of their vertices or faces; trimesh itself where it is installed."""

from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

import camera_ray_caster as crc

VERTICES = np.array([(-1, -1, -3), (1, -1, -3), (1, 1, -3), (-1, 1, -3)], float)
FACES = np.array([(0, 1, 2), (0, 2, 3)])
FACE_COLORS = np.array([(255, 0, 0, 255), (0, 188, 0, 255)], np.uint8)
CAMERA = crc.camera("PERSP", (40, 40), lens=60.0)


def mesh_like(**visual):
    return SimpleNamespace(vertices=VERTICES, faces=FACES, visual=SimpleNamespace(**visual))


def albedo(mesh, **keywords):
    return crc.cast(CAMERA, crc.mesh(mesh, **keywords), passes=("albedo",))["albedo"]


def test_faces_and_vertices_keep_their_colors():
    color = albedo(mesh_like(kind="face", face_colors=FACE_COLORS))
    assert color[5, 30] == pytest.approx((1, 0, 0))
    assert color[30, 5] == pytest.approx((0, 0.5029, 0), abs=1e-4)  # 188 of 255 in sRGB
    ramp = np.array([(0, 0, 0), (1, 1, 1), (1, 1, 1), (0, 0, 0)], float)
    row = albedo(mesh_like(vertex_colors=ramp))[20, :, 0]
    across = crc.cast(CAMERA, crc.mesh(VERTICES, FACES), passes=("position",))["position"][20, :, 0]
    np.testing.assert_allclose(row[4:36], ((across + 1) / 2)[4:36], atol=1e-6)
    assert albedo(mesh_like(kind="face", face_colors=FACE_COLORS), color=(0, 0, 1))[5, 30] == pytest.approx((0, 0, 1))
    assert albedo(mesh_like(kind=None, vertex_colors=ramp))[20, 20] == pytest.approx((0.8, 0.8, 0.8))


def test_what_is_transparent_is_no_hit():
    glass = FACE_COLORS.copy()
    glass[0, 3] = 0
    hit = crc.cast(CAMERA, crc.mesh(mesh_like(kind="face", face_colors=glass)), passes=("shape_index",))["shape_index"]
    assert (hit[5, 30], hit[30, 5]) == (-1, 0)


TEXELS = np.array([[(255, 0, 0, 255), (0, 255, 0, 255)], [(0, 0, 255, 0), (255, 255, 255, 255)]], np.uint8)
"""The image's upper row comes first."""
UV = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float)
QUARTERS = {(30, 10): (1, 0, 0), (30, 30): (0, 1, 0), (10, 10): (0, 0, 1), (10, 30): (1, 1, 1)}
"""The colors of pixels in the middle of a texel, row and column from the bottom left."""


@pytest.mark.parametrize(
    ("material", "factor"),
    [
        ({"image": TEXELS, "main_color": (9, 9, 9, 255)}, (1, 1, 1)),
        ({"baseColorTexture": TEXELS, "baseColorFactor": (51, 255, 255, 255), "alphaMode": "OPAQUE"}, (0.2, 1, 1)),
    ],
)
def test_a_texture_shows_as_trimesh_means_it(material, factor):
    camera = crc.camera("PERSP", (40, 40), lens=54.0)  # a texel's middle is at a quarter of the frame
    textured = mesh_like(kind="texture", uv=UV, material=SimpleNamespace(**material))
    images = crc.cast(camera, crc.mesh(textured), passes=("albedo", "uv", "valid", "shape_index"))
    opaque = "alphaMode" in material
    for (row, column), color in QUARTERS.items():
        assert images["shape_index"][row, column] == (0 if opaque or color != (0, 0, 1) else -1)
        if images["shape_index"][row, column] == 0:
            nearest = np.rint(images["albedo"][row, column] / factor)
            assert tuple(nearest) == color
    assert images["uv"][30, 10][0] < 0.5 < images["uv"][30, 10][1]


@pytest.mark.parametrize(
    ("material", "color"),
    [
        ({"main_color": (255, 0, 188, 255)}, (1, 0, 0.5029)),
        ({"main_color": (255, 0, 188)}, (1, 0, 0.5029)),
        ({"baseColorFactor": (51, 0, 255, 255)}, (0.2, 0, 1)),
        ({"baseColorFactor": (0.2, 0.0, 1.0)}, (0.2, 0, 1)),
    ],
)
def test_a_material_without_an_image_is_its_color(material, color):
    plain = mesh_like(kind="texture", uv=None, material=SimpleNamespace(**material))
    assert albedo(plain)[20, 20] == pytest.approx(color, abs=1e-4)


def test_a_mesh_of_open3d_has_triangles_and_colors_of_its_own():
    """Its vectors are no arrays, and empty ones are what it does not have."""
    mesh = SimpleNamespace(vertices=[*VERTICES], triangles=[*FACES], vertex_colors=[])
    assert albedo(mesh)[20, 20] == pytest.approx((0.8, 0.8, 0.8))
    mesh.vertex_colors = [(1.0, 0.0, 0.0)] * 4
    assert albedo(mesh)[20, 20] == pytest.approx((1, 0, 0))


def test_what_is_no_mesh_is_refused_in_one_line():
    with pytest.raises(crc.InputError, match="has no vertices and faces"):
        crc.mesh(VERTICES)
    with pytest.raises(crc.InputError, match=r"colors of the mesh are of shape \(1, 4\)"):
        crc.mesh(mesh_like(kind="face", face_colors=FACE_COLORS[:1]))
    with pytest.raises(crc.InputError, match="vertices"):
        crc.mesh(SimpleNamespace(vertices=[(0, 0, 0), (1, 0)], faces=FACES))


FROM_0 = "must be whole numbers from 0 to 255, or numbers from 0 to 1"


@pytest.mark.parametrize(
    ("visual", "says"),
    [
        ({"vertex_colors": np.full((4, 3), 255.0)}, FROM_0),
        ({"vertex_colors": np.full((4, 3), 65535, np.uint16)}, FROM_0),
        ({"vertex_colors": np.full((4, 4), np.nan)}, FROM_0),
        ({"vertex_colors": 7}, r"of shape \(\)"),
        ({"vertex_colors": "red"}, "colors"),
        ({"vertex_colors": [(0, 0, 0), (1, 1)]}, "colors"),
        ({"material": SimpleNamespace(main_color="red")}, "the material's color"),
        ({"material": SimpleNamespace(baseColorFactor=(2.0, 0, 0))}, FROM_0),
        ({"uv": UV, "material": SimpleNamespace(image=TEXELS[:0])}, "the texture of the mesh"),
        ({"uv": UV, "material": SimpleNamespace(image=TEXELS, alphaCutoff="half")}, "alphaCutoff"),
    ],
)
def test_colors_that_are_none_are_refused_in_one_line(visual, says):
    with pytest.raises(crc.InputError, match=says):
        crc.mesh(mesh_like(**visual))


def test_a_mesh_of_trimesh():
    trimesh = pytest.importorskip("trimesh")
    mesh = trimesh.Trimesh(VERTICES, FACES, process=False, face_colors=FACE_COLORS)
    np.testing.assert_array_equal(albedo(mesh), albedo(mesh_like(kind="face", face_colors=FACE_COLORS)))
    visual = trimesh.visual.TextureVisuals(UV, image=Image.fromarray(TEXELS[..., :3]))
    textured = trimesh.Trimesh(VERTICES, FACES, process=False, visual=visual)
    same = mesh_like(kind="texture", uv=UV, material=SimpleNamespace(image=visual.material.image))
    np.testing.assert_array_equal(albedo(textured), albedo(same))
    with pytest.raises(crc.InputError, match=r"scene.to_mesh\(\)"):
        crc.mesh(trimesh.Scene([mesh]))


def test_colors_may_be_rounded():
    white = albedo(mesh_like(vertex_colors=np.full((4, 3), np.nextafter(np.float32(1), np.float32(2)))))
    assert white[20, 20] == pytest.approx((1, 1, 1))
