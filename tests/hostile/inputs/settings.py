"""Every declared setting of every model and of every mode of pixel times, with every value that nobody means."""

from math import inf, nan

from camera_ray_caster.core.camera import pixel_time
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cameras.parts.settings import FROM_A_FILE, OWN

from .parts import WHOLES, Hostile, new_object, put, store

VALUES = {
    "FLOAT": (nan, inf, -inf, 3.4e38, -1e30, 1e20, 1e-7, 1e-30, 1e-45, 0.0, -1.0, "a word"),
    "INT": (*WHOLES, 0.5, "a word"),
    "BOOLEAN": (2, -1, 1.0),
    "ENUM": (99, -1, 2**31 - 1, 0.5, "NONE"),
    "VECTOR": (
        (nan,) * 4,
        (inf,) * 4,
        (1e38,) * 4,
        (0.0,) * 4,
        (1.0,) * 3,
        (1.0,) * 5,
        1.0,
        "a word",
    ),
    "TEXT": ("", "a word", "nan", "0 1e999", "1 2", "0 -1", "0 1e-300 1e300", "0" + " 1" * 999, "\udcff", 1.0),
    "FILE": ("", "/", "\n", "//" + "a" * 1000, "\udcff", "/dev/zero", 1.0),
    "OBJECT": ("camera", "ball", "empty", "a word", 5),
    "IMAGE": ("camera", 5),
}


def values(setting):
    """The values for a setting: Blender's own words are the only ones that Blender takes for its enums."""
    if setting.owner == OWN or setting.kind != "ENUM":
        return VALUES[setting.kind]
    return [item.key for item in setting.items]


SHARED = 2
"""Values that every model but the first is given of a setting that several models declare."""

DECLARED = [
    *((model, pixel_time.NONE, setting) for model in MODELS for setting in model.SETTINGS
      if setting.owner != FROM_A_FILE),
    *((MODELS[0], mode, setting) for mode, settings in pixel_time.SETTINGS.items() for setting in settings),
    (MODELS[0], pixel_time.NONE, pixel_time.MODE),
]  # fmt: skip
"""Every setting of every model and mode."""


def cases():
    """Yield the inputs: a setting has all its values in the first model or mode that declares it. The others have some
    of them, by turns, so that a model with many such settings has each value of a kind.
    """
    known, turn = set(), 0
    for model, mode, setting in DECLARED:
        every = [
            value
            for value in values(setting)
            if setting.owner == OWN or not isinstance(value, str) or setting.kind == "ENUM"
        ]
        if id(setting) in known:
            every = [every[(turn + k) % len(every)] for k in range(min(SHARED, len(every)))]
            turn += SHARED
        known.add(id(setting))
        yield from ((model, mode, setting, value) for value in every)


CASES = list(cases())
COUNT = len(CASES)


def make(chance, number, folder):
    """Set the model, the mode and the one setting."""
    import bpy

    model, mode, setting, value = CASES[number]
    scene = bpy.context.scene
    data = scene.camera.data
    group = data.camera_ray_caster
    what = f"{model.key}, {mode}, {setting.name} = {value!r}"
    if model.number is None:
        data.type = model.key if model.key in ("PERSP", "ORTHO") else "PANO"
        if data.type == "PANO":
            data.panorama_type = model.key
    else:
        group.model = model.key
    group.time_mode = mode
    group.time_end = 3.0  # three frames of motion, not 24
    for name in ("slit_1", "slit_2", "path"):
        setattr(group, name, _line(name))
    image = group.time_image = bpy.data.images.new("Time", 4, 4, float_buffer=True)
    image.pixels[:] = [chance.random() for _ in range(64)]
    image.pack()
    if setting.owner == OWN:
        value = {"camera": scene.camera, "ball": scene.objects[0], "empty": _line("other")}.get(value, value)
        store(data, setting.name, value)
    else:
        owner = {"camera": data, "stereo": data.stereo, "render": scene.render}.get(setting.owner)
        what += "; " + (put(owner, setting.name, value) if owner else "not Blender's without Cycles")
    return Hostile(what, camera_alone=True)


def _line(name):
    """Return an empty, or for a path a curve, at a place of its own."""
    import bpy

    if name != "path":
        item = new_object(name, None)
        item.location, item.rotation_euler.z = (0, 0, -len(name) / 2), 1.0 if name == "slit_2" else 0.0
        return item
    curve = bpy.data.curves.new(name, "CURVE")
    curve.dimensions = "3D"
    spline = curve.splines.new("POLY")
    spline.points.add(2)
    for point, location in zip(spline.points, ((-1, 0, 0, 1), (0, 0, 1, 1), (1, 0, 0, 1)), strict=True):
        point.co = location
    return new_object(name, curve)
