"""Names of everything that has one: in messages, in the report, in files."""

from .parts import Hostile

COUNT = 100

NAMES = (
    "a\nb", "\n", "\r\n\t", "x" * 63, "x" * 300, "ä" * 31, "€" * 21, "𝔘" * 15, "/../../../x", "../x", "..", "/", "\\",
    "C:\\x", "a\\..\\b", "'", '"', "'\"'", "{}", "{0}", "%s%n", "\u202eabc", "\u200f", "\u200b", "\x1b[31mred\x1b[0m",
    "\x07\x08", "\x01", "\x7f", "\u2028\u2029", "\u0085", "\ufeff", "e\u0301" * 12, "null", "None", "nan", " ",
    "  x  ", "-", "--output", "$(id)", "`id`", ";ls", "*", "?", "#", "####", "<b>", "&amp;", "\ufffd", "\ufdd0",
    ".hidden", "con",
)  # fmt: skip
PLACES = ("camera", "object", "scene", "layer", "view", "material", "world", "mesh", "suffix", "time image", "slit")


def make(chance, number, folder):
    """Give one to three things a name; every other input is refused, so that the name stands in a message."""
    import bpy

    scene = bpy.context.scene
    camera, ball = scene.camera, scene.objects[0]
    changes = []
    for _ in range(chance.choice((1, 2, 3))):
        name, kind = chance.choice(NAMES), chance.choice(PLACES)
        changes.append(f"{kind} {name!r}")
        if kind in ("view", "suffix"):
            scene.render.use_multiview = True
            scene.render.views_format = chance.choice(("STEREO_3D", "MULTIVIEW"))
            view = chance.choice(scene.render.views)
            setattr(view, "name" if kind == "view" else chance.choice(("file_suffix", "camera_suffix")), name)
        elif kind == "material":
            ball.data.materials.append(bpy.data.materials.new(name))
        elif kind == "world":
            scene.world = bpy.data.worlds.new(name)
        elif kind == "time image":
            camera.data.camera_ray_caster.time_mode = "IMAGE"
            camera.data.camera_ray_caster.time_image = bpy.data.images.new(name, 2, 2)
        elif kind == "slit":
            camera.data.camera_ray_caster.model = "CROSS_SLIT"
            camera.data.camera_ray_caster.slit_1 = ball
            ball.name = name
        else:
            things = {
                "camera": camera,
                "object": ball,
                "scene": scene,
                "layer": scene.view_layers[0],
                "mesh": ball.data,
            }
            things[kind].name = name
    words = ()
    if number % 2:
        fault = chance.choice(("camera option", "flat", "clip", "no layer", "mesh camera", "suzanne"))
        changes.append(fault)
        if fault == "camera option":
            words = (f"--camera={chance.choice(NAMES)}",)
        elif fault == "flat":
            camera.scale = (1, 0, 1)
        elif fault == "clip":
            camera.data.clip_end = camera.data.clip_start
        elif fault == "no layer":
            scene.view_layers[0].use = False
        elif fault == "mesh camera":
            scene.camera = ball
        else:
            ball.data.vertices[0].co.x += 0.25
    if chance.random() < 0.3:
        file = folder / (
            chance.choice([name for name in NAMES if "/" not in name and name not in ("..", ".")])[:50] + ".blend"
        )
        changes.append(f"file {file.name!r}")
        try:
            bpy.ops.wm.save_as_mainfile(filepath=str(file), copy=True)
        except RuntimeError:
            return Hostile(", ".join(changes), words)
        return Hostile(", ".join(changes), words, file)
    return Hostile(", ".join(changes), words)
