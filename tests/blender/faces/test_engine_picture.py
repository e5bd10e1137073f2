"""EEVEE's and Workbench's pictures through camera models, beside the cast of the same scene.

They need a GPU or Mesa's software OpenGL; where Blender has neither, its message is the reason for which a test is
skipped.
"""

import os
import subprocess

import numpy as np
import pytest
from numpy.lib.stride_tricks import sliding_window_view

from camera_ray_caster import InputError, cast, cast_rays, read_camera, read_shapes
from camera_ray_caster.blender.faces.driver import check_driver
from camera_ray_caster.blender.faces.engine_picture import EEVEE, WORKBENCH, engine_name, picture_of
from camera_ray_caster.blender.output.reports import latest
from camera_ray_caster.blender.ui.cast_panels import summary

from ..processes import ROOT, script_command

COLORS = [(1.0, 0.0, 0.0, 1.0), (0.0, 1.0, 0.0, 1.0), (0.0, 0.0, 1.0, 1.0), (1.0, 1.0, 0.0, 1.0), (0.0, 1.0, 1.0, 1.0)]
PLACES = [(0, 0, -3), (3, 0.5, -1), (-3, -0.5, 0.5), (0.5, 3, 0.5), (0, -3, -1.5)]
"""Cubes before the camera, to its right and left, above and below it."""
PARTS = 7
"""Rays across a pixel that look for edges."""
NO_RAY = -2
RAYS = 200
"""Rays of a pixel that tell its blurred color."""


@pytest.fixture
def cubes(blender, camera_scene):
    """Cubes of one color each around the camera, which Workbench draws as they are."""
    for location, color in zip(PLACES, COLORS, strict=True):
        blender.ops.mesh.primitive_cube_add(size=1.6, location=location, rotation=(0.3, 0.4, 0.5))
        blender.context.object.color = color
    scene, shading = camera_scene, camera_scene.display.shading
    shading.light, shading.color_type = "FLAT", "OBJECT"
    shading.show_cavity = shading.show_object_outline = shading.show_shadows = False
    scene.display.render_aa, scene.render.film_transparent = "OFF", True
    scene.camera.location = scene.camera.rotation_euler = 0, 0, 0
    scene.render.resolution_x, scene.render.resolution_y = 64, 48
    return scene


@pytest.fixture(autouse=True)
def driver():
    """Something that draws."""
    try:
        check_driver("Blender")
    except InputError as error:
        pytest.skip(str(error))


def picture(scene, engine=WORKBENCH, **options):
    """The picture of the only view layer and view."""
    return next(iter(picture_of(scene, engine, **options).pixels.values()))


def is_far_from_edges(camera, shapes):
    """Where a pixel and those around it show the same object all over, by PARTS x PARTS rays in each.

    Centers alone miss edges: at the rim of an orthographic fisheye the cube below covers 39 % and 27 % of two pixels,
    but neither center, and the filter, which reaches 2/3 of a pixel, gives 0.017 of it to the pixel beside them.
    """
    (rows, columns), raster = camera.raster.shape, camera.raster
    inside = (np.arange(PARTS) + 0.5) / PARTS - 0.5
    x, y = (np.add.outer(np.ravel(at), inside).ravel() for at in (raster.columns(), raster.rows()))
    rays = camera.rays_at(x, y[:, None])
    index = cast_rays(rays.origins, rays.directions, shapes, passes=("shape_index",))["shape_index"]
    parts = np.where(rays.valid, index, NO_RAY).reshape(rows, PARTS, columns, PARTS)
    around = [np.pad(of(parts, axis=(1, 3)), 1, constant_values=NO_RAY) for of in (np.min, np.max)]
    least, most = (sliding_window_view(image, (3, 3)) for image in around)
    lowest = least.min(axis=(2, 3))
    return (lowest == most.max(axis=(2, 3))) & (lowest > NO_RAY)


def check_colors(scene, pixels):
    """A pixel one pixel or more from an edge has the color of the object that is cast, and its alpha."""
    camera, shapes = read_camera(scene), read_shapes(scene)
    images = cast(camera, shapes, passes=("shape_index", "valid"))
    index, valid = images["shape_index"], images["valid"]
    assert pixels.shape == (*index.shape, 4)
    assert (pixels[~valid] == 0).all()
    names = [shapes.names[shapes.name_index[k]] for k in range(len(shapes.center))]
    colors = np.array([scene.objects[name].color for name in names] + [(0.0, 0.0, 0.0, 0.0)])
    flat = is_far_from_edges(camera, shapes)
    assert flat.mean() > 0.2
    assert pixels[flat] == pytest.approx(colors[index[flat]], abs=2e-3)


@pytest.mark.parametrize("model", ["DOME_MASTER", "CYLINDRICAL", "FISHEYE_STEREOGRAPHIC", "FISHEYE_ORTHOGRAPHIC"])
def test_each_pixel_has_the_color_of_the_object_that_is_cast(cubes, model):
    cubes.camera.data.camera_ray_caster.model = model
    check_colors(cubes, picture(cubes))


def test_a_panorama_a_border_and_a_frame_of_other_pixels(cubes):
    render = cubes.render
    cubes.camera.data.type, cubes.camera.data.panorama_type = "PANO", "EQUIRECTANGULAR"
    render.use_border, render.border_min_x, render.border_max_x, render.border_max_y = True, 0.25, 0.8, 0.9
    render.pixel_aspect_x = 1.5
    before = {name: getattr(render, name) for name in ("resolution_x", "filepath", "engine", "pixel_aspect_x")}
    cameras = len(cubes.objects)
    check_colors(cubes, picture(cubes))
    assert {name: getattr(render, name) for name in before} == before
    assert len(cubes.objects) == cameras
    assert cubes.camera.name == "Camera"
    assert render.use_border


def test_eyes_of_a_stereo_camera_and_view_layers(cubes):
    cubes.camera.data.camera_ray_caster.model = "DOME_MASTER"
    cubes.render.use_multiview, cubes.camera.data.stereo.interocular_distance = True, 0.5
    cubes.view_layers.new("Second")
    images = picture_of(cubes, WORKBENCH).pixels
    assert sorted(images) == [(layer, view) for layer in ("Second", "ViewLayer") for view in ("left", "right")]
    camera, shapes = read_camera(cubes, view="right"), read_shapes(cubes)
    index = cast(camera, shapes, passes=("shape_index",))["shape_index"]
    flat = is_far_from_edges(camera, shapes) & (index >= 0)
    wanted = np.array(COLORS)[index[flat]]
    assert images["ViewLayer", "right"][flat] == pytest.approx(wanted, abs=2e-3)
    assert np.abs(images["ViewLayer", "left"] - images["ViewLayer", "right"]).max() > 0.5


@pytest.mark.parametrize(("model", "time", "why"), [
    ("GENERAL_LINEAR", "NONE", "no single viewpoint"), ("DOME_MASTER", "ROWS", "its own time"),
])  # fmt: skip
def test_what_cannot_be_rendered_is_refused_in_a_line(cubes, model, time, why):
    settings = cubes.camera.data.camera_ray_caster
    settings.model, settings.time_mode, settings.time_end = model, time, 5
    with pytest.raises(InputError, match=why):
        picture_of(cubes, WORKBENCH)


def test_the_button_renders_the_passes_beside_the_picture(blender, cubes, tmp_path):
    cubes.camera.data.camera_ray_caster.model = "DOME_MASTER"
    cubes.render.engine, cubes.view_layers[0].use_pass_z = "BLENDER_WORKBENCH", True
    expected = picture(cubes)
    assert blender.ops.camera_ray_caster.render_through_model() == {"FINISHED"}
    assert cubes.render.engine == "BLENDER_WORKBENCH"
    assert summary(latest(cubes)).endswith(" rays, 5 shapes")
    assert latest(cubes).seconds["faces"] > 0
    cubes.render.image_settings.file_format = "OPEN_EXR"
    path = tmp_path / "picture.exr"
    blender.data.images["Render Result"].save_render(str(path), scene=cubes)
    image = blender.data.images.load(str(path))
    pixels = np.array(image.pixels[:], np.float32).reshape(*expected.shape)
    assert pixels == pytest.approx(expected, abs=1e-3)  # half floats
    cubes.view_layers[0].use_pass_z = False
    blender.ops.camera_ray_caster.render_through_model()
    assert summary(latest(cubes)).endswith(": Workbench picture, 5 shapes"), "without rays"
    assert latest(cubes).rays_per_second is None


@pytest.mark.full
@pytest.mark.cases(1)
def test_eevee_has_the_edges_of_the_cast_too(cubes):
    cubes.camera.data.camera_ray_caster.model, cubes.world = "DOME_MASTER", None
    pixels = picture(cubes, EEVEE, samples=4)
    camera, shapes = read_camera(cubes), read_shapes(cubes)
    index = cast(camera, shapes, passes=("shape_index",))["shape_index"]
    flat = is_far_from_edges(camera, shapes)
    assert (pixels[..., 3] > 0.5)[flat].tolist() == (index >= 0)[flat].tolist()


def test_without_a_driver_it_says_so_in_a_line():
    """In a process of its own, whose EGL has no drivers: Blender would end the process."""
    words = script_command("cast.py", ROOT / "blend_scenes" / "toys.blend")
    no_drivers = {"__EGL_VENDOR_LIBRARY_FILENAMES": os.devnull, "LIBGL_DRIVERS_PATH": os.devnull}
    process = subprocess.run(
        [*words, "--engine", WORKBENCH], env=os.environ | no_drivers, capture_output=True, text=True, timeout=300
    )
    assert process.returncode == 2
    assert process.stderr.splitlines()[-1].startswith("cast.py: WORKBENCH renders on a GPU, and this machine")


@pytest.mark.full
@pytest.mark.parametrize("model", [pytest.param("BLENDER", marks=pytest.mark.full), "DOME_MASTER"])
def test_depth_of_field_is_that_of_rays_through_the_aperture(cubes, model):
    group, dof = cubes.camera.data.camera_ray_caster, cubes.camera.data.dof
    group.model, cubes.camera.data.lens, cubes.camera_ray_caster.samples = model, 30, 48
    dof.focus_distance, dof.aperture_fstop, dof.use_dof = 6, 0.02, True
    blurred, camera, shapes = picture(cubes), read_camera(cubes), read_shapes(cubes)
    names = [shapes.names[shapes.name_index[k]] for k in range(len(shapes.center))]
    colors = np.array([cubes.objects[name].color for name in names] + [(0.0, 0.0, 0.0, 0.0)])
    raster, rays = camera.raster, []
    for sample in range(0, 4 * RAYS, 4):  # other rays than those of a cast; the camera's frame is the world
        origin, direction = camera.sample_rays(raster.columns(), raster.rows(), sample)
        both = (np.stack(np.broadcast_arrays(*vectors), axis=-1) for vectors in (origin, direction))
        rays.append([np.broadcast_to(vectors, (*raster.shape, 3)) for vectors in both])
    index = cast_rays(*np.moveaxis(rays, 1, 0), shapes, passes=("shape_index",))["shape_index"]
    valid = np.isfinite(rays).all(axis=(0, 1, -1))
    wanted = colors[index].mean(axis=0)
    dof.use_dof = False
    blurred, sharp = (np.abs(shown - wanted)[valid].mean() for shown in (blurred, picture(cubes)))
    assert blurred < 0.3 * sharp  # 0.24, and with 160 points 0.16, of a dome; 0.05 of a perspective camera with these


def test_depth_of_field_that_is_left_out_says_why(cubes):
    cubes.camera.data.dof.use_dof = True
    assert "raise Samples" in picture_of(cubes, WORKBENCH).warnings[0]
    settings = cubes.camera.data.camera_ray_caster
    settings.model, cubes.camera.data.dof.aperture_blades, cubes.camera_ray_caster.samples = "DOME_MASTER", 5, 8
    assert "no disc" in picture_of(cubes, WORKBENCH).warnings[0]


@pytest.mark.full
def test_motion_blur_of_a_moving_camera_is_blenders(blender, cubes, tmp_path):
    render, camera = cubes.render, cubes.camera
    render.use_motion_blur, render.motion_blur_shutter = True, 1.0
    for frame, x in enumerate((-0.5, 0.0, 0.5)):
        camera.location.x = x
        camera.keyframe_insert("location", frame=frame)
    cubes.frame_set(1)
    cubes.eevee.motion_blur_steps = 8  # with 1 EEVEE blurs the finished picture of each face
    through = picture(cubes, EEVEE, samples=16)[..., 3]
    render.engine, cubes.eevee.taa_render_samples = engine_name(EEVEE), 16
    render.resolution_percentage, render.image_settings.file_format = 100, "OPEN_EXR"
    alphas = []
    for render.use_motion_blur in (True, False):
        render.filepath = str(tmp_path / f"{render.use_motion_blur}.exr")
        blender.ops.render.render(write_still=True)
        image = blender.data.images.load(render.filepath)
        alphas.append(np.reshape(image.pixels, (48, 64, 4))[..., 3])
    blurred, sharp = (np.abs(through - alpha).mean() for alpha in alphas)
    assert blurred < 0.2 * sharp  # 0.08; with 1 step 0.34
