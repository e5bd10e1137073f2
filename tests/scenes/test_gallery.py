"""The gallery: a scene and a picture for all that a camera can do, and what hand geometry says of some of them."""

import re
from math import pi
from pathlib import Path

import numpy as np
import pytest

from camera_ray_caster.core import cameras
from camera_ray_caster.core.camera.pixel_time import SETTINGS
from camera_ray_caster.core.exports.camera_json import camera_from_json
from camera_ray_caster.core.report.report import as_json

from .opening import FOLDER, README, look, opened, rendered

PAGE = Path(cameras.__file__).with_name("README.md")
"""The table of the models that ship."""
NAMES = re.findall(r'^\| <img src="pictures/(\w+)\.png" .*> \| `\1\.blend`: \S', README, re.MULTILINE)
STUDIO = {"toys", "real_lens", "toys_cross_slit", "twisted_monkey"}
UNDER_THE_SKY = {
    "street", "street_pushbroom", "sculpture_garden", "rotunda_fisheye", "rotunda_panorama", "propeller",
    "unrolled_monkey", "street_scanner",
}  # fmt: skip
WITH_A_WINDOW = {"living_room", "living_room_equirectangular", "living_room_omnimax"}
MESHES = STUDIO | UNDER_THE_SKY | WITH_A_WINDOW
"""Shaded by their materials; all others have the grid."""
OPEN = {"little_planet", "cylindrical", "omnimax", "dome_master"} | UNDER_THE_SKY | WITH_A_WINDOW
"""Where rays may miss everything."""
RUG = (0.0, 0.09, (0xE9, 0xDC, 0xC3)), (0.15, 0.19, (0xD9, 0x8F, 0x6C)), (0.73, 0.76, (0x5F, 0x8F, 0xA8))
"""Rings that an image shows around (-0.3, 0): two radii, and their sRGB."""
TIMES = {
    "slit_scan_rows", "slit_scan_columns", "time_displacement", "rolling_shutter", "propeller", "twisted_monkey",
    "street_scanner",
}  # fmt: skip
DISC = pi / 4
"""Of its square."""
SHARES = {
    "mirrorball": DISC, "fisheye_equidistant": DISC, "fisheye_orthographic": DISC, "fisheye_stereographic": DISC,
    "dome_master": DISC, "rotunda_fisheye": DISC, "ray_table": DISC,
    "omnimax": None, "living_room_omnimax": None, "fisheye_equisolid": None, "fisheye_polynomial": None,
    "opencv_fisheye": None, "ucm": None, "eucm": None, "double_sphere": None, "thin_prism_fisheye": None,
}  # fmt: skip
"""The part of the picture that has rays, where that is not all of it; None for a disc that the frame cuts."""
TALLEST_ROWS = 30
"""Of the small renders."""


def small(scene, samples=2):
    """Make a scene's render small and quick."""
    scene.render.resolution_percentage = -(-100 * TALLEST_ROWS // scene.render.resolution_y)
    scene.camera_ray_caster.samples = samples
    scene.camera.data.camera_ray_caster.time_tolerance = 1  # pixels
    return scene


def masks(bpy, name, *things):
    """Return where balls are seen, (rows, columns) bool each, by their names or pass indices."""
    scene = opened(bpy, name)
    index = look(scene)[2]["object_index"]
    return [index == (scene.objects[thing].pass_index if isinstance(thing, str) else thing) for thing in things]


def test_a_rug_has_the_colors_of_its_image(blender):
    from camera_ray_caster.blender.engine.job import Job

    scene = opened(blender, "living_room")
    scene.camera_ray_caster.samples = 1
    images, report = Job.read(blender.context.evaluated_depsgraph_get(), scene.camera, ("albedo", "position")).cast()
    assert not {note.name for note in report.notes} & set(blender.data.materials.keys())
    x, y, height = np.moveaxis(images["position"].astype(float), -1, 0)
    away = np.hypot(x + 0.3, y)
    for inner, outer, color in RUG:
        ring = (away >= inner) & (away < outer) & (height > 0.005) & (height < 0.0165)
        assert np.count_nonzero(ring) > 20
        srgb = np.array(color) / 255
        expected = ((srgb + 0.055) / 1.055) ** 2.4  # IEC 61966-2-1
        np.testing.assert_allclose(images["albedo"][ring][:, :3], np.broadcast_to(expected, (ring.sum(), 3)), atol=1e-4)


def test_pictures_are_there_and_small():
    assert len(NAMES) == len(set(NAMES)) > 25
    for name in NAMES:
        most = 200_000 if name in WITH_A_WINDOW else 120_000  # textures take more
        assert (FOLDER / "pictures" / f"{name}.png").stat().st_size <= most, name


def test_six_models_are_shown_by_cycles_too():
    row = r'^\| <img src="pictures/(\w+)\.png" .*> \| <img src="pictures/\1_by_cycles\.png" .*> \|$'
    names = re.findall(row, README, re.MULTILINE)
    assert len(names) >= 6
    assert set(names) <= set(NAMES)
    for name in names:
        assert (FOLDER / "pictures" / f"{name}_by_cycles.png").stat().st_size <= 320_000, name


def test_every_model_on_the_page_and_every_time_has_a_scene_of_its_own(blender):
    from camera_ray_caster.blender.read.scene_reader import read_camera

    models, times, lenses = set(), set(), 0
    for path in FOLDER.glob("*.blend"):
        scene = opened(blender, path.stem)
        camera = read_camera(small(scene)) if path.stem not in TIMES else None
        models |= {camera.model.key if camera else scene.camera.data.camera_ray_caster.model}
        times.add(scene.camera.data.camera_ray_caster.time_mode)
        lenses += scene.camera.data.dof.use_dof
    shown = set(re.findall(r"^`([A-Z_\d]+)` in ", PAGE.read_text(encoding="utf-8"), re.MULTILINE))
    assert len(shown) > 30
    missing = ", ".join(shown - models)
    assert not missing, f"{missing}: no scene shows it; scripts/make/scenes has the functions, make_scenes.py makes it"
    assert times == set(SETTINGS)
    assert lenses > 0


@pytest.mark.parametrize("name", NAMES)
def test_scene_renders_and_verifies(blender, name, tmp_path):
    from camera_ray_caster.blender.engine.job import Job

    scene = opened(blender, name)
    with (FOLDER / "pictures" / f"{name}.png").open("rb") as file:
        size = np.frombuffer(file.read(24)[16:], ">u4").tolist()
    assert size == [scene.render.resolution_x, scene.render.resolution_y]
    shading = "MATERIAL" if name in MESHES else "GRID"
    assert (scene.render.engine, scene.camera_ray_caster.shading) == ("CAMERA_RAY_CASTER", shading)
    small(scene)
    passes = ("combined", "object_index", "valid", "ray_direction")
    images, report = Job.read(blender.context.evaluated_depsgraph_get(), scene.camera, passes).cast()
    assert report.passed
    assert report.left_out == ()
    assert bool(report.motion) == (name in TIMES)
    np.testing.assert_array_equal(rendered(blender, tmp_path / "picture.exr"), images["combined"])
    valid, index = images["valid"], images["object_index"]
    assert (report.record is None) == (name == "time_displacement")  # whose time is an image
    if report.record is not None:
        rays = camera_from_json(as_json(report)).rays()
        assert np.array_equal(rays.valid, valid)
        assert np.abs(rays.directions - images["ray_direction"])[valid].max() < 1e-7  # as float32
    share = SHARES.get(name, 1)
    if share is None:
        assert 0.5 < valid.mean() < 1
    else:  # a circle through n x n pixels crosses some 4 n of them, and of these half belong to it: 1 / n on average
        near = pytest.approx(share, abs=0 if share == 1 else 1 / TALLEST_ROWS)
        assert valid.mean() == near, f"if some pixels of {name} have no ray, add it to SHARES"
    if name not in OPEN:
        assert (index[valid] > 0).all(), f"the room is closed; if rays of {name} leave it, add it to OPEN"
    assert len(np.unique(index)) >= (3 if name == "twisted_monkey" else 4)
    assert np.isfinite(images["combined"]).all()


@pytest.mark.parametrize("name", NAMES)
def test_scene_stores_no_path_of_a_machine(blender, name):
    scene = opened(blender, name)
    assert scene.render.filepath.startswith("//")
    assert not blender.data.libraries
    assert all(image.packed_file and not image.filepath for image in blender.data.images)


def test_camera_obscura_is_the_pinhole_turned_by_half_a_turn(blender):
    places = []
    for name in ("pinhole", "camera_obscura"):
        scene = opened(blender, name)
        ball = np.array(scene.objects["Teal"].location)
        places.append(look(scene)[0].project(ball) / (scene.render.resolution_x, scene.render.resolution_y))
    # both see 36 / 22 wide at depth 1, the wall rounded to 3.27 / 2: 0.1 % of at most half the frame
    np.testing.assert_allclose(places[0] + places[1], 1, atol=6e-4)


@pytest.mark.parametrize("ball", ["Red", "Teal", "Yellow", "Moon"])
def test_stereographic_fisheye_keeps_circles(blender, ball):
    (mask,) = masks(blender, "fisheye_stereographic", ball)
    places = np.argwhere(mask)
    # pixels at the edge count whole: 1 of a radius of 10 or more, in either axis of the moments
    small_axis, large_axis = np.sqrt(np.linalg.eigvalsh(np.cov(places.T)))
    assert len(places) > 300
    assert large_axis / small_axis == pytest.approx(1, abs=0.03)


@pytest.mark.parametrize(("ball", "radius"), [("Red", 1.3), ("Moon", 0.7), ("Lamp", 0.5)])
def test_pushbroom_shows_widths_as_they_are(blender, ball, radius):
    (mask,) = masks(blender, "pushbroom", ball)
    assert abs(mask.any(axis=0).sum() - 2 * radius * 480 / 11.6) <= 1  # whole pixels


def test_strip_unrolls_the_figure_from_all_sides(blender):
    body, head = masks(blender, "strip", "Body", "Head")
    assert body.any(axis=0).all()
    assert head.any(axis=0).all()


@pytest.mark.full
def test_slit_scan_stretches_what_flies_with_it(blender):
    """A ball that moves u pixels a frame is met by columns that come at 20 a frame: 1 / (1 - u / 20) times as wide."""
    widths = [mask.any(axis=0).sum() for mask in masks_at_their_times(blender, 30, 31, 32, 33)]
    pixels_per_unit = 480 * 22 / 36 / 5.6
    for width, speed in zip(widths, (0.22, 0.11, 0.0, -0.3), strict=True):
        # the outline is that of a ball seen a little from the side: 3 % and a pixel
        assert width == pytest.approx(widths[2] / (1 - speed * pixels_per_unit / 20), rel=0.03, abs=2)


def masks_at_their_times(bpy, *indices):
    """Return where pass indices are seen in the slit scan of the columns."""
    from camera_ray_caster.blender.engine.job import Job

    scene = opened(bpy, "slit_scan_columns")
    scene.camera_ray_caster.samples = 1
    images, _ = Job.read(bpy.context.evaluated_depsgraph_get(), scene.camera, ("object_index",)).cast()
    return [images["object_index"] == index for index in indices]
