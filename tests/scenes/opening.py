"""How the tests open the scenes of blend_scenes, and look at them."""

from pathlib import Path

import numpy as np

from camera_ray_caster.core.cast import cast

FOLDER = Path(__file__).resolve().parents[2] / "blend_scenes"
README = (FOLDER / "README.md").read_text(encoding="utf-8")
PASSES = ("combined", "depth", "position", "normal", "object_index", "shape_index", "ray_origin", "ray_direction")


def opened(bpy, name):
    """Open a scene of the folder and return it."""
    bpy.ops.wm.open_mainfile(filepath=str(FOLDER / f"{name}.blend"))
    return bpy.context.scene


def look(scene, frame=None):
    """Return what the caster reads, and its passes in double precision."""
    from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes

    camera, shapes = read_camera(scene, frame=frame), read_shapes(scene, frame=frame)
    return camera, shapes, cast(camera, shapes, passes=PASSES, dtype=np.float64)


def rendered(bpy, path):
    """Render the open scene as F12 does and return its picture, (height, width, 4) float32 from the bottom row."""
    scene = bpy.context.scene
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(str(path))
    pixels = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(image.size[1], image.size[0], image.channels)
