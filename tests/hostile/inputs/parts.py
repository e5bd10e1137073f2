"""What the inputs share: the scene that they spoil, and values that nobody means."""

import math
from dataclasses import dataclass
from pathlib import Path

GROUP = "camera_ray_caster"

FLOATS = (math.nan, math.inf, -math.inf, 3.4e38, -1e30, 1e20, 1e7, 1.0, 1e-7, 1e-30, 1e-45, 0.0, -0.0, -1.0)
WHOLES = (2**31 - 1, -(2**31), 65536, 1, 0, -1)


@dataclass(frozen=True)
class Hostile:
    """An input: in words what it is, and what the command is given."""

    what: str
    words: tuple[str, ...] = ()
    file: Path | None = None
    """The .blend; None: the scene that is open is saved."""
    script: str = ""
    """One of scripts/, in place of cast and verify."""
    command: str = ""
    """One of the terminal's, which is given the file and is to refuse the words, in place of cast and verify."""
    scripts: Path | None = None
    """The file that scripts in the .blend make if they run."""
    camera_alone: bool = False
    """Whether it differs from the others of its kind in the camera only."""


def small_scene():
    """Open the scene: a ball, a wall and a sun before a camera of 12 x 8 pixels, every pass ticked."""
    import bpy

    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    bpy.ops.mesh.primitive_uv_sphere_add(segments=8, ring_count=6, location=(0, 0, -5))
    bpy.ops.mesh.primitive_plane_add(size=20, location=(0, 0, -9))
    bpy.ops.object.light_add(type="SUN")
    bpy.ops.object.camera_add()
    scene = bpy.context.scene
    scene.camera = bpy.context.object
    scene.render.resolution_x, scene.render.resolution_y = 12, 8
    layer = scene.view_layers[0]
    layer.use_pass_z = layer.use_pass_normal = layer.use_pass_position = layer.use_pass_object_index = True
    group = getattr(scene, GROUP)
    for setting in group.bl_rna.properties:
        if setting.identifier.startswith("use_pass_"):
            setattr(group, setting.identifier, True)
    return scene


def new_object(name, data):
    """Return a new object of the scene."""
    import bpy

    item = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(item)
    return item


def store(owner, name, value):
    """Store a setting of the add-on as a file may have it, whatever its range and type."""
    import bpy

    properties = owner.bl_system_properties_get(do_create=True) if bpy.app.version >= (5, 0, 0) else owner
    if GROUP not in properties:
        properties[GROUP] = {}
    properties[GROUP].pop(name, None)
    properties[GROUP][name] = value


def put(owner, name, value):
    """Set a property of Blender's, which may bring the value into its range."""
    kind = owner.bl_rna.properties[name].type
    if kind == "INT":
        value = max(-(2**31), min(2**31 - 1, int(value))) if math.isfinite(value) else 2**31 - 1
    setattr(owner, name, value)
    return f"{type(owner).__name__}.{name} = {value}"
