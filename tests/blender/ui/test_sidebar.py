"""The buttons of the sidebar, without a window; tests/gui presses them with one."""

import numpy as np
import pytest

from camera_ray_caster.blender.output import image_datablocks, reports
from camera_ray_caster.blender.properties import pass_properties
from camera_ray_caster.blender.read.scene_reader import read_camera, read_scene, read_shapes
from camera_ray_caster.blender.ui import cast_operator
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.casting.passes import PASSES

from .conftest import HEIGHT, WIDTH


def pixels_of(image):
    pixels = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(image.size[1], image.size[0], 4)


@pytest.mark.parametrize("key", PASSES)
def test_cast_stores_every_pass_as_it_is(blender, scene, key):
    pass_properties.tick(scene, blender.context.view_layer, [key])
    assert blender.ops.camera_ray_caster.cast() == {"FINISHED"}
    pixels = pixels_of(blender.data.images[image_datablocks.image_name(key)])
    read = read_scene(scene, passes=[key])
    expected = cast(read.camera, read.shapes, passes=[key])[key].reshape(HEIGHT, WIDTH, -1).astype(np.float32)
    if key == "depth":
        expected[np.isinf(expected)] = pass_properties.FAR
    channels = expected.shape[2]
    assert np.array_equal(pixels[..., :channels], expected, equal_nan=True)
    if channels == 1:
        assert np.array_equal(pixels[..., 2], pixels[..., 0])
    assert channels == 4 or (pixels[..., 3] == 1).all()


@pytest.mark.parametrize("kind", ["PERSP", "PANO", "OMNIDIRECTIONAL_STEREO", "SPHERICAL", "MULTIVIEW"])
def test_cast_casts_every_view_of_a_stereo_scene(blender, scene, kind):
    data, render = scene.camera.data, scene.render
    render.use_multiview = True
    data.type = "PERSP" if kind in ("PERSP", "MULTIVIEW") else "PANO"
    data.stereo.interocular_distance, data.stereo.use_spherical_stereo = 0.5, kind == "SPHERICAL"
    if kind == "OMNIDIRECTIONAL_STEREO":
        data.camera_ray_caster.model = kind
    if kind == "MULTIVIEW":
        render.views_format = kind
        scene.camera.name = "Camera_L"
        other = blender.data.objects.new("Camera_R", blender.data.cameras.new("Camera"))
        other.location = (0.5, 0.2, 7)
        scene.collection.objects.link(other)
        before = scene.camera
    pass_properties.tick(scene, blender.context.view_layer, ["depth", "position"])
    assert blender.ops.camera_ray_caster.cast() == {"FINISHED"}
    for view in ("left", "right"):
        shown = pixels_of(blender.data.images[image_datablocks.image_name("position", view)])[..., :3]
        expected = cast(read_camera(scene, view=view), read_shapes(scene), passes=["position"])["position"]
        assert np.array_equal(shown, expected)
        assert expected.any()
    left, right = (pixels_of(blender.data.images[f"Ray Caster depth {view}"]) for view in ("left", "right"))
    assert not np.array_equal(left, right)
    assert "Ray Caster depth" not in blender.data.images
    assert reports.latest().pixels == 2 * WIDTH * HEIGHT
    assert kind != "MULTIVIEW" or scene.camera == before


def test_the_progress_of_two_views_is_one(blender, scene):
    scene.render.use_multiview = True
    (_, read), seen = cast_operator.Cast.read(None, blender.context), []
    cast_operator.cast_views(read, lambda fraction: seen.append(fraction) or True)
    assert list(read) == ["left", "right"]
    assert seen == sorted(seen)
    assert any(fraction <= 0.5 for fraction in seen)
    assert max(seen) <= 1 < 2 * max(seen)


def test_cast_again_writes_into_the_same_images(blender, scene):
    pass_properties.tick(scene, blender.context.view_layer, ["combined", "depth"])
    blender.ops.camera_ray_caster.cast()
    before = {image.name: image for image in blender.data.images}
    scene.render.resolution_x, scene.render.resolution_y = 5, 40
    blender.ops.camera_ray_caster.cast()
    assert {image.name: image for image in blender.data.images} == before
    depth = blender.data.images["Ray Caster depth"]
    assert tuple(depth.size) == (5, 40)
    assert depth.colorspace_settings.name == "Non-Color"
    assert pixels_of(depth)[20, 2, 0] == pytest.approx(5, abs=0.05)


def test_cast_and_verify_keep_what_the_panel_shows(blender, scene):
    assert (reports.latest(), reports.verified()) == (None, None)
    blender.ops.camera_ray_caster.verify()
    assert reports.latest() is None
    assert reports.verified().passed
    assert len(reports.verified().findings) == 4
    blender.ops.camera_ray_caster.cast()
    assert reports.latest().pixels == WIDTH * HEIGHT
    assert [name for name, _ in reports.latest().left_out] == ["Suzanne"]
    blender.ops.wm.read_factory_settings(use_empty=True)
    assert (reports.latest(), reports.verified()) == (None, None)


def test_select_what_was_left_out_for_one_reason(blender, scene):
    for _ in range(3):
        blender.ops.mesh.primitive_monkey_add()
        blender.context.object.camera_ray_caster.primitive = "IGNORE"
    blender.ops.camera_ray_caster.cast()
    ((reason, names),) = reports.by_reason(reports.latest()).items()
    assert blender.ops.camera_ray_caster.select(reason=reason) == {"FINISHED"}
    assert {item.name for item in blender.context.selected_objects} == set(names)
    assert len(names) == 4
    assert blender.context.view_layer.objects.active.name == names[0]
    with pytest.raises(RuntimeError, match="None of these objects is in this view layer"):
        blender.ops.camera_ray_caster.select(reason="another")


def test_what_is_only_simplified_is_not_left_out_and_its_users_are_selected(blender, scene):
    pass_properties.tick(scene, blender.context.view_layer, ["combined"])
    blender.data.objects["Suzanne"].camera_ray_caster.primitive = "AUTOMATIC"
    paint, world = blender.data.materials.new("Suzanne"), blender.data.worlds.new("Sky")  # the name of an object, too
    blender.ops.mesh.primitive_cube_add(location=(0.1, 0, -5))
    user = blender.context.object
    user.data.materials.append(paint)
    for owner, output in ((paint, "BSDF"), (world, "Background")):
        owner.use_nodes = True
        light_path = owner.node_tree.nodes.new("ShaderNodeLightPath")
        color = next(n for n in owner.node_tree.nodes if output in n.name).inputs[0]
        owner.node_tree.links.new(light_path.outputs["Ray Length"], color)
    scene.world = world
    blender.ops.camera_ray_caster.cast()
    left_out = reports.latest().left_out
    assert [name for name, _ in left_out] == ["Suzanne", "Sky"]
    assert reports.left_out_count(left_out) == "Colors simplified"
    by_reason = reports.by_reason(reports.latest())
    users = [reports.users_of(blender.context.view_layer, reason, names) for reason, names in by_reason.items()]
    assert users == [[user], []]
    assert blender.ops.camera_ray_caster.select(reason=next(iter(by_reason))) == {"FINISHED"}
    assert blender.context.selected_objects == [user]
    both = (*left_out, ("Hair", "a reason"))
    assert reports.left_out_count(both) == "1 object left out, colors simplified"


def test_left_out_is_one_line_that_counts():
    assert reports.left_out_count(()) == ""
    assert reports.left_out_line(()) == ""
    assert reports.left_out_line((("Hair", "a reason"), ("Hair", "another"))) == "1 object left out: Hair"
    many = [(f"Object number {i}", "a reason") for i in range(300)]
    line = reports.left_out_line(many)
    assert line.startswith("300 objects left out: Object number 0, ")
    assert line.endswith(" ...")
    assert len(line) < 100


def test_without_a_camera_the_buttons_are_gray(blender):
    assert not blender.ops.camera_ray_caster.cast.poll()
    assert not blender.ops.camera_ray_caster.verify.poll()
    with pytest.raises(RuntimeError, match="no active camera"):
        blender.ops.camera_ray_caster.cast()


def test_what_is_no_camera_and_what_no_model_can_do_is_refused_in_one_line(blender, scene):
    data = scene.camera.data
    data.type = "PANO"
    owner = data if hasattr(data, "panorama_type") else data.cycles
    owner.panorama_type = "CUSTOM" if "CUSTOM" in owner.bl_rna.properties["panorama_type"].enum_items else "MIRRORBALL"
    if owner.panorama_type == "CUSTOM":
        for operator in (blender.ops.camera_ray_caster.cast, blender.ops.camera_ray_caster.verify):
            with pytest.raises(RuntimeError, match="of type CUSTOM"):
                operator()
    scene.camera = blender.data.objects["Suzanne"]
    with pytest.raises(RuntimeError, match="'Suzanne' is of type mesh, not a camera"):
        blender.ops.camera_ray_caster.cast()
    assert len(blender.data.images) == 0


def test_without_a_shape_the_images_show_the_background(blender, scene, capfd):
    for name in ("Sphere", "Suzanne"):
        blender.data.objects.remove(blender.data.objects[name])
    scene.world = blender.data.worlds.new("World")
    blender.ops.camera_ray_caster.cast()
    pixels = pixels_of(blender.data.images["Ray Caster combined"])
    assert (pixels == pixels[0, 0]).all()
    assert "the images show the background" in "".join(capfd.readouterr())


def test_one_pixel(blender, scene):
    scene.render.resolution_x = scene.render.resolution_y = 4
    scene.render.resolution_percentage = 25
    pass_properties.tick(scene, blender.context.view_layer, ["depth"])
    blender.ops.camera_ray_caster.cast()
    image = blender.data.images["Ray Caster depth"]
    assert tuple(image.size) == (1, 1)
    assert image.pixels[0] == pytest.approx(5, abs=1e-6)


def test_a_strip_of_16384_by_16_pixels(blender, scene):
    scene.render.resolution_x, scene.render.resolution_y = 16384, 16
    pass_properties.tick(scene, blender.context.view_layer, ["depth"])
    blender.ops.camera_ray_caster.cast()
    image = blender.data.images["Ray Caster depth"]
    assert tuple(image.size) == (16384, 16)
    assert pixels_of(image)[8, 8192, 0] == pytest.approx(5, abs=1e-6)


def test_a_corner_of_16384_pixels(blender, scene):
    """All of them would fill the memory of a small machine; their rays are the same."""
    render = scene.render
    render.resolution_x = render.resolution_y = 16384
    render.use_border = True
    render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = 0.495, 0.505, 0.495, 0.505
    pass_properties.tick(scene, blender.context.view_layer, ["depth"])
    blender.ops.camera_ray_caster.cast()
    image = blender.data.images["Ray Caster depth"]
    assert image.size[0] in (163, 164)
    assert pixels_of(image)[..., 0].min() == pytest.approx(5, abs=1e-6)


def test_inside_a_sphere(blender, scene):
    scene.camera.location = (0, 0, 0.5)
    pass_properties.tick(scene, blender.context.view_layer, ["distance"])
    blender.ops.camera_ray_caster.cast()
    distance = pixels_of(blender.data.images["Ray Caster distance"])[..., 0]
    assert (distance > 0.5).all()  # its rays go down, past the middle
    assert (distance <= 1.5).all()


def test_a_file_goes_without_the_add_on_and_comes_back_with_it(blender, scene, tmp_path):
    """Blender keeps the settings of an add-on that is not there."""
    import camera_ray_caster

    scene.camera_ray_caster.shading = "GRID"
    scene.camera_ray_caster_overlay.show = True
    scene.render.engine = "CAMERA_RAY_CASTER"
    blender.data.objects["Suzanne"].camera_ray_caster.primitive = "SPHERE"
    blender.ops.camera_ray_caster.cast()
    path = str(tmp_path / "with.blend")
    blender.ops.wm.save_as_mainfile(filepath=path)
    camera_ray_caster.unregister()
    try:
        blender.ops.wm.open_mainfile(filepath=path)
        assert not hasattr(blender.context.scene, "camera_ray_caster")
        assert blender.context.scene.render.engine != "CAMERA_RAY_CASTER"
        blender.ops.wm.save_as_mainfile(filepath=path)
    finally:
        camera_ray_caster.register()
    blender.ops.wm.open_mainfile(filepath=path)
    scene = blender.context.scene
    assert scene.camera_ray_caster.shading == "GRID"
    assert scene.camera_ray_caster_overlay.show
    assert blender.data.objects["Suzanne"].camera_ray_caster.primitive == "SPHERE"
    assert blender.ops.camera_ray_caster.cast() == {"FINISHED"}
    assert reports.latest().shapes == 2


def test_nothing_runs_after_a_cast(blender, scene):
    blender.ops.camera_ray_caster.cast()
    assert cast_operator.fraction() is None
