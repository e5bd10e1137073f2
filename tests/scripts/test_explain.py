"""What explain.py prints."""

import json

import numpy as np
import pytest

from camera_ray_caster.core.lesson.formula import shown


def picture(command, path, folder, *passes):
    """The passes that cast.py makes of a file."""
    done = command("cast", path, "--output", folder, "--format", "npz", "--passes", ",".join(passes))
    assert done.returncode == 0, done.stderr
    (made,) = folder.glob("*.npz")
    return np.load(made)


def test_explain_prints_the_steps_of_the_pixel_that_cast_and_project_know(command, scene):
    done = command("explain", scene, "--pixel", "12,9", "--frame", "1.25")
    for title in (
        "Pixel",
        "View coordinates [-1, 1]²",
        "Model",
        "Ray in the world",
        "Shapes on the line of the ray",
        "Seen",
        "Color",
    ):
        assert f"{title}\n  " in done.stdout
    assert "its center: x = 12.5, y = 9.5" in done.stdout
    facts = json.loads(command("verify", scene, "--frame", "1.25", "--json").stdout)["camera"]
    assert f"eye = ({', '.join(f'{value + 0.0:.6g}' for value in facts['eye'])})" in done.stdout


@pytest.mark.parametrize("samples", [1, 5])
def test_explain_sees_what_a_render_sees_and_not_the_viewport(command, scene, tmp_path, blender, samples):
    """A ball that only a render shows stands before a wall that a render subdivides."""
    blender.ops.wm.open_mainfile(filepath=str(scene))
    ball = blender.data.objects["Sphere"]
    ball.hide_viewport = True
    blender.ops.mesh.primitive_plane_add(size=20, location=(0, 0, -3))
    wall = blender.context.object
    wall.name = "Wall"
    subdivision = wall.modifiers.new("Subdivision", "SUBSURF")
    subdivision.subdivision_type, subdivision.levels, subdivision.render_levels = "SIMPLE", 0, 3
    settings = blender.context.scene.camera_ray_caster
    settings.shading, settings.samples, settings.exact_shapes = "GRID", samples, False
    blender.ops.wm.save_as_mainfile(filepath=str(scene))
    passes = picture(command, scene, tmp_path / "out", "combined", "shape_index", "face_index")
    seen = set()
    for x, y in ((16, 12), (2, 3), (29, 20), (11, 12)):
        said = command("explain", scene, "--pixel", f"{x},{y}").stdout
        name = "Sphere" if np.hypot(x - 15.5, y - 11.5) < 9 else "Wall"  # by hand: its radius is 44.4 / sqrt(24) pixels
        assert f"Seen\n  '{name}', shape_index {passes['shape_index'][y, x]}\n" in said
        face = said.split("; seen: the nearest")[0].rsplit("face ", 1)[1].split(",")[0]
        assert int(face) == passes["face_index"][y, x]
        assert said.rstrip().endswith(shown(passes["combined"][y, x]))
        seen.add(name)
    assert passes["face_index"].max() > 31
    assert seen == {"Sphere", "Wall"}


def test_explain_takes_a_pixel_at_the_moment_of_the_picture(command, scene, tmp_path, blender):
    blender.ops.wm.open_mainfile(filepath=str(scene))
    camera = blender.context.scene.camera.data.camera_ray_caster
    camera.time_mode, camera.time_start, camera.time_end = "ROWS", 1.0, 2.0
    blender.ops.wm.save_as_mainfile(filepath=str(scene))
    color = picture(command, scene, tmp_path / "out", "combined")["combined"]
    for x, y in ((16, 12), (14, 10), (13, 14)):
        said = command("explain", scene, "--pixel", f"{x},{y}").stdout
        assert said.startswith(f"At frame {1 + (y + 0.5) / 24:g}, the time of this pixel")
        assert said.rstrip().endswith(shown(color[y, x]))


def test_explain_shows_the_first_view_layer_that_is_rendered(command, scene, blender):
    blender.ops.wm.open_mainfile(filepath=str(scene))
    layers, ball = blender.context.scene.view_layers, blender.data.objects["Sphere"]
    apart = blender.data.collections.new("Apart")
    blender.context.scene.collection.children.link(apart)
    ball.users_collection[0].objects.unlink(ball)
    apart.objects.link(ball)
    layers[0].use = False
    layers.new("Without").layer_collection.children["Apart"].exclude = True
    blender.ops.wm.save_as_mainfile(filepath=str(scene))
    said = command("explain", scene, "--pixel", "16,12").stdout
    assert said.startswith("Pixel\n")
    assert "Seen\n  nothing\n" in said
    blender.context.scene.view_layers[0].use = True
    blender.ops.wm.save_as_mainfile(filepath=str(scene))
    said = command("explain", scene, "--pixel", "16,12").stdout
    assert said.startswith("View layer 'ViewLayer'\n")
    assert "Seen\n  'Sphere'" in said


def test_explain_says_that_a_stereo_scene_has_other_pictures(command, scene, blender):
    blender.ops.wm.open_mainfile(filepath=str(scene))
    assert command("explain", scene, "--pixel", "16,12").stderr == ""
    blender.context.scene.render.use_multiview = True
    blender.ops.wm.save_as_mainfile(filepath=str(scene))
    done = command("explain", scene, "--pixel", "16,12")
    assert done.stderr.startswith("explain.py: warning: the scene has several views")
    assert "Seen\n  'Sphere'" in done.stdout


def test_a_point_of_the_view_and_json_tell_the_same_as_the_pixel(command, scene):
    said = command("explain", scene, "--pixel", "16,12").stdout
    assert command("explain", scene, "--point", "0.01,0.01").stdout == said
    told = json.loads(command("explain", scene, "--point=0.01,0.01", "--json").stdout)
    assert told["pixel"] == [16, 12]
    assert told["view"] == pytest.approx([2 * 16.5 / 32 - 1, 2 * 12.5 / 24 - 1])
    assert told["name"] == "Sphere"
    hit = np.array(told["origin"]) + told["distance"] * np.array(told["direction"])
    assert hit == pytest.approx(told["point"])
    assert [title for title, _ in told["steps"]] == [line for line in said.splitlines() if line and line[0] != " "]
    assert json.loads(command("explain", scene, "--pixel", "0,0", "--json").stdout)["point"] is None


@pytest.mark.parametrize(("point", "words"), [("2,0", "outside the frame"), ("a,b", "not a point")])
def test_a_point_outside_or_none_is_refused_in_one_line(command, scene, point, words):
    done = command("explain", scene, "--point", point)
    assert done.returncode == 2
    assert words in done.stderr
    assert "Traceback" not in done.stderr
