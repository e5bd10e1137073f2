"""The eyes of stereo scenes: ours are those that Blender hands a render engine, and that Cycles renders."""

import itertools

import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes
from camera_ray_caster.blender.verification.check import verify_camera
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.conventions import EPS32
from camera_ray_caster.core.records import InputError

from ...exr import read_exr
from ..cycles.cycles import cycles_surface

VIEWS = ("left", "right")
KINDS = {
    "perspective": {"type": "PERSP", "lens": 35.0, "shift_x": 0.1},
    "vertical fit": {"type": "PERSP", "lens": 35.0, "sensor_fit": "VERTICAL", "sensor_height": 20.0},
    "orthographic": {"type": "ORTHO", "ortho_scale": 5.0},
    "panorama": {"type": "PANO", "panorama_type": "EQUIRECTANGULAR", "shift_x": 0.1},
}
MODES = list(itertools.product(("OFFAXIS", "PARALLEL", "TOE"), ("CENTER", "LEFT", "RIGHT")))


@pytest.fixture
def scene(blender):
    """A stereo scene: a turned and scaled camera above a floor that fills its view."""
    bpy = blender
    bpy.ops.mesh.primitive_plane_add(size=200)
    bpy.ops.object.camera_add(location=(0.5, -1, 6), rotation=(0.4, 0.1, 0.3), scale=(2, 1, 0.5))
    scene = bpy.context.scene
    scene.camera = bpy.context.object
    scene.render.resolution_x, scene.render.resolution_y = 24, 16
    scene.render.use_multiview = True
    return scene


def set_up(scene, kind, mode, pivot):
    data = scene.camera.data
    for name, value in KINDS[kind].items():
        owner = data if hasattr(data, name) else data.cycles
        setattr(owner, name, value)
    data.stereo.convergence_mode, data.stereo.pivot = mode, pivot
    data.stereo.interocular_distance, data.stereo.convergence_distance = 0.6, 3.5


@pytest.fixture
def ask_blender(blender, scene):
    """A function that renders with an engine which only notes the matrix and shift of each view."""
    bpy = blender
    seen = {}

    class Asking(bpy.types.RenderEngine):
        bl_idname = "ASKING"
        bl_label = "Asking"

        def render(self, depsgraph):
            for view in self.get_result().views:
                self.active_view_set(view.name)
                camera = self.camera_override
                matrix = np.array(self.camera_model_matrix(camera), np.float64)
                seen[view.name] = camera.name, matrix, self.camera_shift_x(camera)

    bpy.utils.register_class(Asking)

    def ask():
        engine, scene.render.engine = scene.render.engine, "ASKING"
        bpy.ops.render.render()
        scene.render.engine = engine
        return dict(seen)

    yield ask
    bpy.utils.unregister_class(Asking)


@pytest.mark.parametrize(("mode", "pivot"), MODES)
@pytest.mark.parametrize("kind", KINDS)
def test_an_eye_stands_and_looks_as_blender_says(scene, ask_blender, kind, mode, pivot):
    set_up(scene, kind, mode, pivot)
    answers = ask_blender()
    straight = read_camera(scene)
    for view in VIEWS:
        _, matrix, shift = answers[view]
        eye = read_camera(scene, view=view)
        # some 16 roundings of Blender's float32, of numbers up to the eye's 6
        assert eye.pose.eye == pytest.approx(matrix[:3, 3], abs=16 * 6 * EPS32)
        assert eye.pose.basis == pytest.approx(matrix[:3, :3], abs=16 * EPS32)
        if kind != "panorama":
            moved = (straight.model.window.center_x - eye.model.window.center_x) / 24
            vertical = 16 / 24 if kind == "vertical fit" else 1.0
            assert moved == pytest.approx((shift - scene.camera.data.shift_x) * vertical, abs=16 * EPS32)


@pytest.mark.parametrize(("mode", "pivot"), [("OFFAXIS", "CENTER"), ("TOE", "LEFT"), ("PARALLEL", "RIGHT")])
@pytest.mark.parametrize("kind", KINDS)
def test_both_eyes_are_rendered(blender, scene, tmp_path, kind, mode, pivot):
    set_up(scene, kind, mode, pivot)
    render_position(blender, scene, tmp_path)
    for view in VIEWS:
        expected = cast(read_camera(scene, view=view), read_shapes(scene), passes=["position"])["position"]
        assert expected.any(axis=2).mean() > 0.4
        assert_same_position(tmp_path, view, expected)


@pytest.mark.parametrize("mode", ["OFFAXIS", "TOE"])
def test_a_model_with_eyes_of_its_own_is_rendered_with_each(blender, scene, tmp_path, mode):
    """What either eye shows is what a scene without stereo shows of the model's eye of that name."""
    set_up(scene, "panorama", mode, "CENTER")
    settings = scene.camera.data.camera_ray_caster
    settings.model = "OMNIDIRECTIONAL_STEREO"
    render_position(blender, scene, tmp_path)
    scene.render.use_multiview = False
    for view in VIEWS:
        settings.eye = view.upper()
        assert_same_position(
            tmp_path, view, cast(read_camera(scene), read_shapes(scene), passes=["position"])["position"]
        )
    settings.eye, scene.render.use_multiview = "TOP_BOTTOM", True
    with pytest.raises(RuntimeError, match="both eyes in one picture"):
        blender.ops.render.render()


def render_position(blender, scene, folder):
    """Render the position pass of both eyes into folder/picture_L.exr and _R."""
    from camera_ray_caster.blender.properties import pass_properties

    scene.render.engine = "CAMERA_RAY_CASTER"
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "MULTI_LAYER_IMAGE"
    settings.file_format, settings.color_depth, settings.views_format = "OPEN_EXR_MULTILAYER", "32", "INDIVIDUAL"
    if hasattr(settings, "use_exr_interleave"):
        settings.use_exr_interleave = True
    pass_properties.tick(scene, blender.context.view_layer, ["combined", "position"])
    scene.render.filepath = str(folder / "picture.exr")
    blender.ops.render.render(write_still=True)


def assert_same_position(folder, view, expected):
    channels = read_exr(folder / f"picture_{view[0].upper()}.exr")
    layers = [next(c for name, c in channels.items() if f"Position.{axis}" in name) for axis in "XYZ"]
    hit = expected.any(axis=2)
    difference = np.abs(np.stack(layers, axis=-1) - expected)
    far = np.linalg.norm(expected - (0.5, -1, 6), axis=2, keepdims=True)
    slope = far / 6  # of the floor, from 6 above
    assert hit.any()
    assert (difference <= 64 * EPS32 * far * slope)[hit].all()


@pytest.mark.parametrize("model", ["OPENCV_PINHOLE", "CAMERA_OBSCURA", "FISHEYE_STEREOGRAPHIC"])
def test_eyes_of_other_models_are_rendered_as_they_are_read(blender, scene, tmp_path, model):
    set_up(scene, "perspective", "OFFAXIS", "LEFT")
    settings = scene.camera.data.camera_ray_caster
    settings.model, settings.fx, settings.fy, settings.cx, settings.cy = model, 40.0, 40.0, 20.0, 12.0
    settings.calibration_width = settings.calibration_height = 0
    render_position(blender, scene, tmp_path)
    for view in VIEWS:
        seen = cast(read_camera(scene, view=view), read_shapes(scene), passes=["position"])["position"]
        assert_same_position(tmp_path, view, seen)


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize(
    ("kind", "mode", "pivot"),
    [
        ("perspective", "OFFAXIS", "CENTER"),
        ("perspective", "TOE", "LEFT"),
        ("vertical fit", "OFFAXIS", "RIGHT"),
        ("orthographic", "OFFAXIS", "CENTER"),
        ("panorama", "OFFAXIS", "CENTER"),
    ],
)
def test_cycles_sees_the_same_with_each_eye(scene, kind, mode, pivot, view):
    set_up(scene, kind, mode, pivot)
    camera = read_camera(scene, view=view)
    expected = cast(camera, read_shapes(scene), passes=["position"], dtype=np.float64)["position"]
    for render_view in scene.render.views:
        render_view.use, render_view.file_suffix = render_view.name == view, ""
    surface = cycles_surface(scene, "Position", 256.0)
    far = np.linalg.norm(expected - camera.pose.eye, axis=2)
    both = expected.any(axis=2) & ~np.isnan(surface).any(axis=2) & (far < 30)
    assert both.mean() > 0.25
    error = np.linalg.norm(surface - expected, axis=2)
    # directions to 32 EPS32, seen on the floor at its slope; what the witness stores is good to its reach's EPS32
    bound = (32 * far * far / 6 + 256 + 32 * 6) * EPS32 * np.sqrt(3)
    assert (error <= bound)[both].all()


def test_multi_view_takes_the_camera_that_the_suffix_names(blender, scene, ask_blender):
    left = scene.camera
    left.name = "Rig_L"
    right = left.copy()
    right.data = left.data.copy()
    right.name, right.data.lens, right.location.x = "Rig_R", 20.0, 3.0
    scene.collection.objects.link(right)
    scene.render.views_format = "MULTIVIEW"
    answers = ask_blender()
    for view, item in (("left", left), ("right", right)):
        eye = read_camera(scene, view=view)
        assert (eye.name, item.name) == (item.name, answers[view][0])
        assert eye.pose.eye == pytest.approx(answers[view][1][:3, 3], abs=8 * EPS32)
        assert verify_camera(scene, view=view)[0].witness == "view_frame"
        assert all(finding.passed for finding in verify_camera(scene, view=view))
    assert scene.camera == left
    right.name = "Other"
    assert read_camera(scene, view="right").name == "Rig_L"


def test_an_eye_is_verified_by_its_round_trip(scene):
    for view in VIEWS:
        (finding,) = verify_camera(scene, view=view)
        assert finding.witness == "round trip"
        assert finding.passed


def test_what_is_no_eye_is_refused(scene):
    with pytest.raises(InputError, match="'middle' is not an eye"):
        read_camera(scene, view="middle")
    scene.render.views_format = "MULTIVIEW"
    with pytest.raises(InputError, match="no view 'middle': its views are left, right"):
        read_camera(scene, view="middle")


@pytest.mark.parametrize("kind", ["perspective", "panorama"])
def test_both_eyes_of_spherical_stereo_are_rendered(blender, scene, tmp_path, kind):
    set_up(scene, kind, "TOE", "LEFT")
    scene.camera.data.stereo.use_spherical_stereo = True
    render_position(blender, scene, tmp_path)
    eyes = [read_camera(scene, view=view) for view in VIEWS]
    left, right = (cast(eye, read_shapes(scene), passes=["position"])["position"] for eye in eyes)
    assert_same_position(tmp_path, "left", left)
    assert_same_position(tmp_path, "right", right)
    assert all((eye.pose.eye == (0.5, -1, 6)).all() for eye in eyes)
    assert np.abs(left - right).max() > 0.1
    assert all(finding.passed for view in VIEWS for finding in verify_camera(scene, view=view))


@pytest.mark.parametrize(
    ("path", "before", "after"), [("stereo.use_pole_merge", True, False), ("type", "PERSP", "PANO")]
)
def test_an_eye_whose_pole_merge_or_type_changes_during_a_slit_scan(scene, path, before, after):
    data = scene.camera.data
    data.stereo.use_spherical_stereo = True
    owner, name = (data.stereo, "use_pole_merge") if "." in path else (data, path)
    for frame, value in ((1, before), (13, after)):
        setattr(owner, name, value)
        data.keyframe_insert(path, frame=frame)
    settings = data.camera_ray_caster
    settings.time_mode, settings.time_start, settings.time_end = "ROWS", 1.0, 25.0
    rays = read_camera(scene, view="left").rays()
    settings.time_mode = "NONE"
    for row in (1, 6, 9, 14):
        still = read_camera(scene, frame=float(rays.time[row, 0]), view="left").rays()
        np.testing.assert_allclose(rays.origins[row], still.origins[row], rtol=0, atol=1e-12)
        np.testing.assert_allclose(rays.directions[row], still.directions[row], rtol=0, atol=1e-12)


def test_spherical_stereo_of_a_model_that_blender_does_not_have_is_refused_by_name(blender, scene):
    scene.camera.data.stereo.use_spherical_stereo = True
    scene.camera.data.camera_ray_caster.model = "OMNIMAX"
    with pytest.raises(InputError, match="Spherical Stereo"):
        read_camera(scene, view="left")
    scene.render.engine = "CAMERA_RAY_CASTER"
    with pytest.raises(RuntimeError, match="Spherical Stereo"):
        blender.ops.render.render()
