"""The objects that a render evaluates otherwise than the viewport."""

import pytest

from camera_ray_caster.blender.read.render_differences import evaluated_otherwise


def subdivided(item, **values):
    modifier = item.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = modifier.render_levels = 2
    for name, value in values.items():
        setattr(modifier, name, value)


CHANGES = {
    "nothing": (lambda item: None, False),
    "the same levels": (subdivided, False),
    "other levels": (lambda item: subdivided(item, levels=1), True),
    "off in the viewport": (lambda item: subdivided(item, show_viewport=False), True),
    "off in a render": (lambda item: subdivided(item, show_render=False), True),
    "disabled": (lambda item: setattr(item, "hide_viewport", True), True),
    "hidden": (lambda item: item.hide_set(True), True),
    "hidden in both": (lambda item: (item.hide_set(True), setattr(item, "hide_render", True)), False),
}


@pytest.mark.parametrize(("change", "differs"), CHANGES.values(), ids=CHANGES)
def test_objects_that_a_render_evaluates_otherwise_are_named(blender, camera_scene, change, differs):
    camera_scene.camera.hide_viewport = True  # a camera is not seen
    blender.ops.mesh.primitive_cube_add()
    change(blender.context.object)
    names = evaluated_otherwise(blender.context.evaluated_depsgraph_get())
    assert names == (("Cube",) if differs else ())


def test_numbers_of_curves_metaballs_and_simplify_count(blender, camera_scene):
    blender.ops.curve.primitive_bezier_circle_add()
    curve = blender.context.object.data
    blender.ops.object.metaball_add()
    ball = blender.context.object.data
    ball.resolution = ball.render_resolution

    def differing():
        return evaluated_otherwise(blender.context.evaluated_depsgraph_get())

    assert differing() == ()
    curve.render_resolution_u, ball.resolution = 50, 1.0
    assert differing() == ("BézierCircle", "Mball")
    curve.render_resolution_u, ball.resolution = curve.resolution_u, ball.render_resolution
    blender.ops.mesh.primitive_cube_add()
    subdivided(blender.context.object)
    camera_scene.render.use_simplify = True
    camera_scene.render.simplify_subdivision, camera_scene.render.simplify_subdivision_render = 1, 6
    assert differing() == ("Cube",)
