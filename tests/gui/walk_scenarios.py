"""The walks of docs/tutorials/walks.md in a window, one scenario a function: see scenarios.py."""

import bpy
import numpy as np
from all_scenarios import into
from lesson_scenarios import place_of
from parts import BUTTON, addon
from stranger_scenarios import choose_model, default_scene
from user import pixels_of
from window_scenarios import middle

MOVIE = 2
"""Frames of the movie: enough to be one."""


def slit_scan_movie(user, scenes):
    """An artist: from the default cube to a movie in which each row of a frame has its own time."""
    yield from default_scene(user)
    scene, view = bpy.context.scene, user.region("WINDOW")
    cube, group = bpy.data.objects["Cube"], scene.camera.data.camera_ray_caster
    yield from user.point(*middle(view))
    yield from user.key("i")
    scene.frame_set(25)
    user.send("key", "r", "z", "3", "6", "0", "Return")
    yield from user.wait(0.5)
    yield from user.key("i")
    yield from user.until(lambda: cube.animation_data and cube.animation_data.action, "the cube turns")
    assert tuple(cube.animation_data.action.frame_range) == (1, 25)
    scene.frame_set(1)
    yield from user.key("F3")
    user.send("type", "slit scan, rows")
    yield from user.wait(1)
    user.screenshot("walk_search")
    yield from user.key("Return")
    yield from user.until(lambda: group.time_mode == "ROWS", "each row has its own time")
    yield from user.wait(0.7)
    user.screenshot("walk_engine")
    yield from user.press(f"{BUTTON}use_this_engine(")
    yield from user.until(lambda: scene.render.engine == "CAMERA_RAY_CASTER", "the engine is set")
    yield from user.wait(0.7)
    user.screenshot("walk_follow")
    yield from user.press(f"{BUTTON}follow_timeline(")
    yield from user.until(lambda: scene.camera.data.animation_data, "the times go with the timeline")
    scene.frame_set(3)
    assert (group.time_start, group.time_end) == (3, 27)
    scene.frame_set(1)
    scene.frame_end, scene.render.resolution_percentage = MOVIE, 10
    scene.render.filepath, form = str(user.folder / "movie_"), scene.render.image_settings
    if hasattr(form, "media_type"):
        form.media_type = "VIDEO"
    form.file_format = "FFMPEG"
    yield from user.point(*middle(view))
    user.send("key", "ctrl+96")  # F12
    yield from user.until(lambda: list(user.folder.glob("movie_*")), "the movie is begun")
    yield from user.until(lambda: not bpy.app.is_job_running("RENDER"), "the movie is made")
    yield from user.wait(1)
    user.screenshot("walk_movie")
    (path,) = user.folder.glob("movie_*")
    clip = bpy.data.movieclips.load(str(path))
    assert clip.frame_duration == MOVIE
    report = addon("output.reports").latest(scene)
    assert report is not None
    yield from user.point(*middle(user.area("IMAGE_EDITOR")))
    yield from user.key("Escape")
    yield from user.until(lambda: any(area.type == "VIEW_3D" for area in user.window.screen.areas), "the view is back")


def drag_x_before_a_class(user, scenes):
    """A teacher: an example, a pixel that is clicked and dragged to the right, and the numbers that follow."""
    yield from default_scene(user)
    bpy.ops.wm.open_mainfile(filepath=str(scenes / "spheres_and_planes.blend"), load_ui=False)
    user.area().spaces.active.shading.type = "SOLID"
    yield from user.wait(0.7)
    lesson, context = addon("view3d.pixel_lessons"), bpy.context
    yield from user.press(f"{BUTTON}see_through(")
    yield from user.wait(1.5)
    yield from user.press(f"{BUTTON}step_through(")
    raster = addon("read.scene_cache").cached_scene(context).camera.raster
    start, end = (place_of(user, raster.width * fraction, raster.height / 2) for fraction in (0.35, 0.6))
    yield from user.point(*start)
    user.send("mousedown", 1)
    yield from user.wait(0.3)
    (first,) = lesson.clicked.pixels
    before = lesson.lessons(context)[first].steps
    for step in range(1, 11):
        x = round(start[0] + (end[0] - start[0]) * step / 10)
        user.send("mousemove", x, user.window.height - 1 - round(start[1]))
        yield from user.wait(0.1)
    user.send("mouseup", 1)
    yield from user.wait(0.7)
    user.screenshot("walk_dragged")
    (last,) = lesson.clicked.pixels
    assert last[0] > first[0] + raster.width / 5
    assert lesson.lessons(context)[last].steps != before
    yield from user.key("Escape")
    chosen = context.window_manager.camera_ray_caster_place
    chosen.x = -0.5
    yield from user.wait(0.7)
    user.screenshot("walk_slider")
    assert lesson.clicked.pixels[0][0] == round(raster.width / 4)
    yield from user.press(f"{BUTTON}copy_steps(")
    assert f"({lesson.clicked.pixels[0][0]}, " in context.window_manager.clipboard
    bpy.ops.camera_ray_caster.clear_steps()


def dome_movie(user, scenes):
    """An artist: from the default cube, with a texture, to a dome-master movie that EEVEE renders."""
    yield from default_scene(user)
    scene, cube, view = bpy.context.scene, bpy.data.objects["Cube"], user.region("WINDOW")
    image, nodes = bpy.data.images.new("Grid", 256, 256), cube.active_material.node_tree
    image.generated_type = "COLOR_GRID"
    texture = nodes.nodes.new("ShaderNodeTexImage")
    texture.image = image
    nodes.links.new(texture.outputs[0], nodes.nodes["Principled BSDF"].inputs["Base Color"])
    for frame, turn in ((1, 0.0), (MOVIE, 3.0)):
        cube.rotation_euler.z = turn
        cube.keyframe_insert("rotation_euler", frame=frame)
    scene.frame_set(1)
    yield from choose_model(user, scene.camera.data.camera_ray_caster, "DOME_MASTER", "Dome Master")
    user.screenshot("walk_dome_note")
    scene.render.resolution_x = scene.render.resolution_y = 96
    scene.camera.data.camera_ray_caster.tilt, scene.eevee.taa_render_samples = 1.2, 1
    user.area().spaces.active.shading.color_type = "TEXTURE"
    yield from user.press(f"{BUTTON}see_through(")
    yield from user.wait(1)
    user.screenshot("walk_dome_live")
    yield from user.point(*middle(view))
    yield from user.key("F3")
    user.send("type", "render through model")
    yield from user.wait(1)
    user.screenshot("walk_dome_search")
    yield from user.key("Return")
    yield from user.see_render("walk_dome_frame")
    scene.frame_end, run, folder = MOVIE, addon("ui.in_process"), user.folder / "dome"
    folder.mkdir(exist_ok=True)
    yield from user.point(*middle(view))
    yield from user.key("F3")
    user.send("type", "cast all")
    yield from user.wait(1)
    yield from user.key("Return")
    yield from into(user, folder, engine="EEVEE")
    made = f"Wrote {MOVIE} pictures into"
    yield from user.until(lambda: run.latest().startswith(made), "the frames are made", 600)
    frames = sorted(folder.glob("*.png"))
    assert len(frames) == MOVIE
    colors = pixels_of(bpy.data.images.load(str(frames[0])))
    assert colors[..., 0].std() > 0.05  # a picture, and the color grid's three colors
    assert np.abs(colors[..., 0] - colors[..., 2]).max() > 0.1
    assert scene.render.engine == "BLENDER_EEVEE"
    yield from user.press(f"{BUTTON}see_through(")


WALK_SCENARIOS = (slit_scan_movie, drag_x_before_a_class, dome_movie)
