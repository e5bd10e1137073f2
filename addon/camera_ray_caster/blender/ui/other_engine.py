"""Render engines that do not support a camera's model: messages in the panels and the status bar, with alternatives."""

from functools import partial

import bpy
from bpy.app.handlers import persistent

from ..properties.declared import BLENDERS_OWN, ENGINE, GROUP
from ..properties.setting_labels import label_of
from ..read.camera_fields import shader_mark
from ..read.view import views_3d
from ..view3d.shown import ENGINES
from .cycles_operators import UseInCycles
from .model_settings import blender_type
from .needs import OfScene
from .notes import Note
from .through_model import RenderThroughModel

CYCLES = "CYCLES"
SHOWN = 10.0
"""Seconds that the status bar shows the line after a render has ended."""


class UseThisEngine(OfScene, bpy.types.Operator):
    """Set the scene's render engine to Camera Ray Caster, which supports every camera model"""

    bl_label = "Use Camera Ray Caster"

    def execute(self, context):
        context.scene.render.engine = ENGINE


def ignored(scene, camera) -> str:
    """Return a sentence on what the scene's engine renders in place of a camera object's model or pixel times; "" if it
    supports them.
    """
    engine = scene.render.engine
    if engine.startswith(ENGINE) or camera is None or camera.type != "CAMERA":
        return ""
    settings, kind = getattr(camera.data, GROUP), camera.data.type
    if not (settings.model and settings.time_mode):  # no item of this version: it cannot be cast, and a note says why
        return ""
    is_ours = settings.model != BLENDERS_OWN
    has_times = settings.time_mode not in (("NONE", "ROLLING_SHUTTER") if engine == CYCLES else ("NONE",))
    if engine == CYCLES and shader_mark(camera.data) is not None:
        return ""
    if not (is_ours or has_times or (kind not in ("PERSP", "ORTHO") and engine != CYCLES)):
        return ""
    model = settings.model if is_ours else blender_type(camera.data)
    if has_times and not is_ours:
        return f"{engine_label(engine)} renders all pixels at one time"
    others = {"PERSP": "a perspective view", "ORTHO": "an orthographic view"}
    instead = others.get(kind, "a perspective view" if engine != CYCLES else "Blender's own model")
    return f"{engine_label(engine)} renders {instead}, not {label_of(model)}"


def engine_label(engine: str) -> str:
    """Return the name of a render engine in Blender's menu, from its identifier."""
    known = getattr(bpy.types, engine, None)
    plain = engine.removeprefix("BLENDER_").removesuffix("_NEXT")
    return getattr(known, "bl_label", None) or (plain if plain == "EEVEE" else plain.replace("_", " ").title())


def engine_note(scene, camera) -> Note | None:
    """Return a note on what the scene's engine does not support, with buttons for the alternatives, or None."""
    sentence = ignored(scene, camera)
    return Note(sentence, partial(_draw_buttons, scene.render.engine in ENGINES)) if sentence else None


def _draw_buttons(can_warp: bool, row) -> None:
    row.operator(UseThisEngine.bl_idname, text="Ray Caster")
    if can_warp:
        row.operator(RenderThroughModel.bl_idname, text="", icon="RENDER_STILL")
    row.operator(UseInCycles.bl_idname).set_engine = True


@persistent
def begin(scene, _=None):
    """Show the sentence in the status bar when a render begins; in a terminal, print it."""
    line = ignored(scene, scene.camera)
    if line and bpy.app.background:
        print(f"Warning: {line}. Set the render engine to Camera Ray Caster, or use the camera in Cycles", flush=True)
    elif line:
        show_later(f"{line}. The sidebar, tab Ray Caster, has alternatives", 0.0)


@persistent
def end(scene, _=None):
    """Clear the status bar some time after a render has ended."""
    if not bpy.app.background and ignored(scene, scene.camera):
        show_later(None, SHOWN)


def show_later(text: str | None, seconds: float) -> None:
    """Show a text in the status bar from a timer: Blender calls the handlers of a render in the render's thread."""
    bpy.app.timers.register(partial(show, text), first_interval=seconds)


def show(text: str | None) -> None:
    """Show a text in the status bar of every window, or Blender's own."""
    for window in bpy.context.window_manager.windows:
        window.workspace.status_text_set(text)


def show_in_sidebars(text: str | None) -> None:
    """Show a text in the status bar, and draw the sidebars of the 3D Views again."""
    show(text)
    for _, area in views_3d():
        for region in area.regions:
            if region.type == "UI":
                region.tag_redraw()


CLASSES = (UseThisEngine,)


def register(undo) -> None:
    undo.add_handlers(begin, "render_init")
    undo.add_handlers(end, "render_complete", "render_cancel")
