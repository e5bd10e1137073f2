"""Numbers of the camera, the scene and the render that Blender keeps and nobody means."""

from .parts import FLOATS, WHOLES, Hostile, put

COUNT = 300

FIELDS = {
    "camera": ("location", "rotation_euler", "scale", "delta_location", "delta_scale", "matrix_world"),
    "lens": ("lens", "sensor_width", "shift_x", "shift_y", "clip_start", "clip_end", "ortho_scale"),
    "focus": ("focus_distance", "aperture_fstop", "aperture_ratio", "aperture_rotation", "aperture_blades"),
    "stereo": ("interocular_distance", "convergence_distance"),
    "render": (
        "resolution_x", "resolution_y", "resolution_percentage", "pixel_aspect_x", "pixel_aspect_y", "border_min_x",
        "border_max_x", "border_min_y", "border_max_y", "motion_blur_shutter", "frame_map_old", "frame_map_new", "fps",
    ),
    "scene": ("frame_current", "frame_start", "frame_end", "frame_step"),
    "units": ("scale_length",),
    "caster": ("samples",),
    "light": ("energy", "exposure", "temperature"),
    "look": ("exposure", "gamma"),
    "world": ("color",),
}  # fmt: skip
MATRICES = ("location", "rotation_euler", "scale", "delta_location", "delta_scale", "matrix_world", "color")


def make(chance, number, folder):
    """Set one to three of the numbers."""
    import bpy

    scene = bpy.context.scene
    camera = scene.camera
    scene.world = bpy.data.worlds.new("World")
    owners = {
        "camera": camera,
        "lens": camera.data,
        "focus": camera.data.dof,
        "stereo": camera.data.stereo,
        "render": scene.render,
        "scene": scene,
        "units": scene.unit_settings,
        "caster": scene.camera_ray_caster,
        "light": next(item.data for item in scene.objects if item.type == "LIGHT"),
        "look": scene.view_settings,
        "world": scene.world,
    }
    scene.render.use_border = chance.random() < 0.5
    scene.render.use_crop_to_border = chance.random() < 0.5
    camera.data.dof.use_dof = chance.random() < 0.5
    if chance.random() < 0.2:
        scene.render.use_multiview = True
        scene.render.views_format = chance.choice(("STEREO_3D", "MULTIVIEW"))
        camera.data.stereo.convergence_mode = chance.choice(("OFFAXIS", "PARALLEL", "TOE"))
    camera.data.type = chance.choice(("PERSP", "PERSP", "ORTHO"))
    changes = []
    for _ in range(chance.choice((1, 1, 2, 3))):
        where = chance.choice(list(FIELDS))
        name = chance.choice(FIELDS[where])
        if name not in owners[where].bl_rna.properties:
            continue
        if name in MATRICES:
            changes.append(_put_one(owners[where], name, chance))
            continue
        kind = owners[where].bl_rna.properties[name].type
        value = chance.choice(WHOLES if kind == "INT" else FLOATS)
        if name in ("resolution_x", "resolution_y", "samples") and value == 65536:  # legal, and takes its time
            value = 64
        if name in ("resolution_x", "resolution_y"):
            value = min(value, 2048)
        if name.startswith("frame_"):  # Blender itself ends at frame 2147483647, before the file is saved
            value = max(-1048575, min(1048575, value))
        changes.append(put(owners[where], name, value))
    return Hostile(", ".join(changes))


def _put_one(owner, name, chance):
    """Set one number of several."""
    value = chance.choice(FLOATS)
    if name == "matrix_world":
        matrix = owner.matrix_world.copy()
        matrix[chance.randrange(4)][chance.randrange(4)] = value
        owner.matrix_world = matrix
        return f"matrix_world {value}"
    numbers = getattr(owner, name)
    where = chance.randrange(len(numbers))
    numbers[where] = value
    return f"{name}[{where}] = {value}"
