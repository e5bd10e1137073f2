"""The Open Lesson operator: a page for the browser about the scene's camera and the latest pixel."""

from pathlib import Path

import bpy

from ...core.exports.file_writer import write
from ...core.maths.recording import NotRecordable
from ...core.names import file_name
from ...core.records import InputError
from ...core.web.page import lesson_page
from ..read.scene_cache import cached_scene
from ..view3d.clicked import clicked
from .needs import OfScene


class OpenLesson(OfScene, bpy.types.Operator):
    """Open an interactive page in the browser with this scene, its camera's formula and the ray of the clicked pixel,
    or of the pixel in the middle. The page is written next to the .blend file, or into the home folder, and works
    offline"""

    bl_label = "Open Lesson"
    bl_options = {"REGISTER"}

    def execute(self, context):
        scene = cached_scene(context)
        camera = scene.camera
        if camera is None:
            raise InputError("the camera cannot be cast: see the reason in the sidebar")
        middle = camera.raster.width // 2, camera.raster.height // 2
        path = write_lesson(camera, clicked.pixels[-1] if clicked.pixels else middle, scene.shapes)
        bpy.ops.wm.url_open(url=path.as_uri())
        self.report({"INFO"}, f"Wrote {path}")


def write_lesson(camera, pixel, shapes) -> Path:
    """Write the page about a camera, a pixel and the scene; return its path.

    Raises InputError for a folder that cannot be written, and for a registered model whose formula cannot be recorded.
    """
    blend = Path(bpy.data.filepath)
    folder = blend.parent if bpy.data.filepath else Path.home()
    name = file_name(f"{blend.stem or 'untitled'}_{camera.name}_lesson.html")
    try:
        text = lesson_page(camera, pixel, shapes)
    except NotRecordable as error:
        raise InputError(f"{camera.model.label} has no lesson in a browser: {error}") from error
    (path,) = write([(name, text)], folder)
    return path


CLASSES = (OpenLesson,)
