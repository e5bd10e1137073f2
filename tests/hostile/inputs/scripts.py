"""Python in the file, by every way in which Blender runs it, switched on by keys and drivers, too: none may run."""

from .parts import Hostile

COUNT = 40

SETTINGS = "view_layers[0].freestyle_settings"
SWITCHES = {f"{SETTINGS}.mode": "1", f"{SETTINGS}.modules[0].use": "1", "view_layers[0].use_freestyle": "1"}
"""What Freestyle runs a style module by, and the value that switches it on."""


def make(chance, number, folder):
    """Put one to three scripts into the scene; each leaves the file "ran" where it runs."""
    import bpy

    scene = bpy.context.scene
    code, kinds = f"open({str(folder / 'ran')!r}, 'w')", []
    for kind in chance.sample((driver, variable, text, style), chance.choice((1, 2, 3))):
        kind(scene, code, chance)
        kinds.append(kind.__name__)
    return Hostile(", ".join(kinds), scripts=folder / "ran")


def driver(scene, code, chance):
    item = chance.choice((scene.camera, scene.objects[0], scene.camera.data))
    path = "lens" if item == scene.camera.data else chance.choice(("hide_render", "pass_index"))
    item.driver_add(path).driver.expression = f"len(str({code}))"


def variable(scene, code, chance):
    driver = scene.camera.driver_add("location", 1).driver
    driver.use_self = chance.random() < 0.5
    driver.variables.new().name = "var"
    driver.expression = chance.choice((f"{code} and var", f"(lambda: {code})() and 0", f"[{code} for _ in '1']"))


def text(scene, code, chance):
    import bpy

    block = bpy.data.texts.new("startup.py")
    block.from_string(code)
    block.use_module = True


def style(scene, code, chance):
    import bpy

    block = bpy.data.texts.new("style.py")
    block.from_string(code)
    layer = scene.view_layers[0]
    settings, scene.render.use_freestyle = layer.freestyle_settings, True
    settings.mode = "SCRIPT"
    for _ in range(chance.choice((1, 2))):
        settings.modules.new().script = block
    for path, value in SWITCHES.items():
        how = chance.choice(("on", "driver", "key"))
        if how == "driver":
            scene.driver_add(path).driver.expression = chance.choice((value, f"{value} + 0 * frame"))
        elif how == "key":
            scene.keyframe_insert(path, frame=1)
        if how != "on":  # off in the file, until it is evaluated
            settings.mode = "EDITOR" if path.endswith("mode") else settings.mode
            settings.modules[0].use = settings.modules[0].use and not path.endswith("].use")
            layer.use_freestyle = layer.use_freestyle and path != "view_layers[0].use_freestyle"
