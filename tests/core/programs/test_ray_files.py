"""Files of ray tables of other programs: generic cameras of Schöps, and meshes of rays."""

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.conventions import EPS

from ..cameras.table_examples import pinhole, without_eye

NAMES = ("grid", "direction_grid", "point_grid")


def spline(values, g_x, g_y):
    """The uniform cubic B-spline at (g_x, g_y) by de Boor's recursion, for control points (rows, columns, 3)."""

    def basis(i, g, degree=3):
        if degree == 0:
            return 1.0 if i <= g < i + 1 else 0.0
        return ((g - i) * basis(i, g, degree - 1) + (i + degree + 1 - g) * basis(i + 1, g, degree - 1)) / degree

    rows, columns, _ = values.shape  # control point k has its basis function from k - 2 to k + 2
    return sum(basis(j - 2, g_y) * basis(i - 2, g_x) * values[j, i] for j in range(rows) for i in range(columns))


def generic(central=True, wide=9, high=7, **changes):
    """A calibration of a picture of 640 x 480, calibrated from (20, 30) to (599, 449), and its grids."""
    x, y = np.meshgrid(np.linspace(-0.9, 0.9, wide), np.linspace(-0.7, 0.7, high))
    directions = np.stack((x + 0.02 * x * y, y + 0.03 * x * x, np.ones_like(x)), axis=-1)
    directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
    points = np.stack((0.01 * x, 0.02 * y * y, 0.0 * x), axis=-1)
    entries = {"type": "CentralGenericModel" if central else "NoncentralGenericModel", "width": 640, "height": 480,
               "calibration_min_x": 20, "calibration_min_y": 30, "calibration_max_x": 599, "calibration_max_y": 449,
               "grid_width": wide, "grid_height": high}  # fmt: skip
    grids = {"grid": directions} if central else {"point_grid": points, "direction_grid": directions}
    entries |= {name: f"[{', '.join(map(repr, grid.ravel().tolist()))}]" for name, grid in grids.items()} | changes
    text = "".join(f"{name}: {value}\n" for name, value in entries.items() if value is not None)
    return text, directions, points


@pytest.mark.parametrize("central", [True, False])
def test_a_generic_camera_is_its_spline(central, tmp_path):
    text, directions, points = generic(central)
    path = tmp_path / "intrinsics0.yaml"
    path.write_text(text)
    cam = crc.load_calibration(path)
    assert (cam.model.key, cam.raster.size, cam.model.central) == ("RAY_TABLE", (640, 480), central)
    assert cam.model.facts()["interpolation_error"] == 0
    for x, y in ((20.0, 30.0), (320.3, 240.9), (599.9, 449.5), (77.0, 400.0)):  # from the top left corner
        g_x, g_y = 1 + 6 * (x - 20) / 580, 1 + 4 * (y - 30) / 420
        ahead = spline(directions, g_x, g_y) * (1, -1, -1)
        rays = cam.rays_at(x, 480 - y)
        np.testing.assert_allclose(rays.directions, ahead / np.linalg.norm(ahead), rtol=0, atol=32 * EPS)
        if not central:
            np.testing.assert_allclose(rays.origins, spline(points, g_x, g_y) * (1, -1, -1), rtol=0, atol=32 * EPS)
    outside = cam.rays_at([19.0, 601.0, 300.0, 300.0], [240.0, 240.0, 29.0, 451.0])
    assert not outside.valid.any()


@pytest.mark.parametrize(
    ("changes", "word"),
    [
        ({"grid": "[0.0, 0.0, 1.0]"}, "grid is .*189 finite numbers"),
        ({"grid": None}, "no grid"),
        ({"grid_width": 3}, "grid_width is 3.*from 4"),
        ({"grid_height": 6.5}, "grid_height is 6.5.*whole"),
        ({"calibration_max_x": 10}, "calibration_max_x is 10"),
        ({"width": None}, "no width"),
    ],
)
def test_generic_cameras_that_lack_something_are_refused(changes, word, tmp_path):
    path = tmp_path / "intrinsics0.yaml"
    path.write_text(generic(**changes)[0])
    with pytest.raises(crc.InputError, match=word):
        crc.load_calibration(path)


def csv_of(names="x,y,dx,dy,dz", drop=(), shift=0.0, directions=None, origins=None):
    """A mesh of 13 x 9 rays from edge to edge of the picture, in a shuffled order."""
    table = pinhole(13, 9) if directions is None else directions
    lines = []
    for j in range(9):
        for i in range(13):
            uv = i / 12 + shift * (i == 5), (1 - j / 8 if "v" in names else j / 8)
            lines.append([*uv, *table[j, i], *([] if origins is None else origins[j, i])])
    lines = [lines[k] for k in np.random.default_rng(2).permutation(len(lines)) if k not in drop]
    return "\n".join([names, *(", ".join(f"{number:.17g}" for number in line) for line in lines)]) + "\n"


@pytest.mark.parametrize("names", ["x,y,dx,dy,dz", "# u v dx dy dz"])
def test_a_mesh_of_rays_has_its_rays_at_its_places(names, tmp_path):
    path = tmp_path / "mesh.csv"
    path.write_text(csv_of(names))
    cam = crc.load_calibration(path, size=(120, 80))
    rays = cam.rays_at(np.arange(13) * 10.0, np.arange(9)[:, None] * 10.0)
    unit = pinhole(13, 9) / np.linalg.norm(pinhole(13, 9), axis=-1, keepdims=True)
    np.testing.assert_allclose(rays.directions, unit, rtol=0, atol=32 * EPS)


def test_a_mesh_may_have_origins_and_be_an_obj(tmp_path):
    origins, directions = without_eye(13, 9)
    (tmp_path / "mesh.csv").write_text(csv_of("x,y,dx,dy,dz,ox,oy,oz", directions=directions, origins=origins))
    lines = []
    for j in range(9):
        for i in range(13):
            for kind, numbers in (("v", origins[j, i]), ("vt", (i / 12, j / 8)), ("vn", directions[j, i])):
                lines.append(" ".join((kind, *(f"{number:.17g}" for number in numbers))))
    for j in range(8):
        for i in range(12):
            corners = [j * 13 + i + k + 1 for k in (0, 1, 14, 13)]
            lines.append("f " + " ".join(f"{k}/{k}/{k}" for k in corners))
    (tmp_path / "mesh.obj").write_text("\n".join(["# a mesh of rays", *lines]) + "\n")
    table_camera, other = (crc.load_calibration(tmp_path / name, size=(96, 64)) for name in ("mesh.csv", "mesh.obj"))
    np.testing.assert_array_equal(table_camera.rays().directions, other.rays().directions)
    np.testing.assert_array_equal(table_camera.rays().origins, other.rays().origins)
    rays = table_camera.rays_at(np.arange(13) * 8.0, np.arange(9)[:, None] * 8.0)
    np.testing.assert_allclose(rays.origins, origins, rtol=0, atol=16 * EPS)


def test_a_mesh_does_not_tell_the_size_of_its_pictures(tmp_path):
    (tmp_path / "mesh.csv").write_text(csv_of())
    with pytest.raises(crc.InputError, match="does not tell the size of its pictures: give size="):
        crc.load_calibration(tmp_path / "mesh.csv")


BAD = {
    "unequal": (csv_of(drop=(30,)), "rows are of unequal length: 0 rays at column 4, row 2 of 13 x 9"),
    "twice": (csv_of() + "0, 0, 0, 0, -1\n", "2 rays at column 0, row 0"),
    "uneven": (csv_of(shift=0.03), "not even in x"),
    "words": (csv_of() + "a, b, c, d, e\n", "line 119 must be 5 numbers"),
    "short": (csv_of() + "0.1, 0.2\n", "line 119 must be 5 numbers"),
    "pixels": ("x y dx dy dz\n0 0 0 0 -1\n100 100 0 0.1 -1\n", "from 0 to 1 over the picture"),
    "one row": ("x y dx dy dz\n0 0 0 0 -1\n1 0 0 0.1 -1\n", "one y only"),
    "nothing": ("x y dx dy dz\n", "one or more"),
    "corners": ("v 0 0 0\nvt 0 0\nvn 0 0 -1\nf 1/1 1/1 1/1\n", "v/vt/vn"),
    "far corners": ("v 0 0 0\nvt 0 0\nvn 0 0 -1\nf 1/1/1 2/2/2 3/3/3\n", "v/vt/vn"),
}


@pytest.mark.parametrize("name", BAD)
def test_meshes_that_are_no_table_are_refused_in_one_line(name, tmp_path):
    content, word = BAD[name]
    path = tmp_path / "mesh.txt"
    path.write_text(content)
    with pytest.raises(crc.InputError, match=word) as caught:
        crc.load_calibration(path, size=(96, 64))
    assert "\n" not in str(caught.value)
