"""What a user does with a camera that somebody has added, and with its file after it was taken away. Run by a Blender.

Arguments: the folder of the package, the .blend, the JSON file that receives what was seen, "with" or "without".
"""

import json
import sys
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
from install_and_render import traces


def with_it(crc, path, folder):
    """Choose the model, read, project, cast and render with it, and save the file."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    before = traces()
    crc.register()
    bpy.ops.mesh.primitive_uv_sphere_add(radius=1.0, location=(3.0, 1.0, 0.5))
    bpy.ops.mesh.primitive_plane_add(size=20.0, location=(0.0, 0.0, -2.0))
    bpy.ops.object.camera_add(location=(0.0, -1.0, 0.0), rotation=(1.4, 0.1, 0.3))
    scene = bpy.context.scene
    scene.camera = bpy.context.object
    scene.render.engine = "CAMERA_RAY_CASTER"
    scene.render.resolution_x, scene.render.resolution_y = 48, 32
    settings = scene.camera.data.camera_ray_caster
    item = settings.bl_rna.properties["model"].enum_items["MERCATOR"]
    setting = settings.bl_rna.properties["mercator_top"]
    seen = {
        "item": [item.name, item.description, item.value],
        "setting": [setting.name, setting.subtype, setting.default, setting.hard_min, setting.hard_max],
    }
    settings.model, settings.mercator_top = "MERCATOR", 1.25
    camera, shapes = crc.read_camera(scene), crc.read_shapes(scene)
    x, y = np.random.default_rng(1).uniform((1, 1), (47, 31), (200, 2)).T
    rays = camera.rays_at(x, y)
    back = camera.project(rays.origins + 7.0 * rays.directions)
    corner = camera.rays_at(24.0, 32.0).directions @ camera.pose.basis
    image = crc.cast(camera, shapes, passes=("combined",))["combined"]
    picture = rendered(scene, folder / "picture.exr")
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    crc.unregister()
    crc.unregister()
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    return {
        **seen,
        "settings": dict(camera.settings),
        "off": float(np.abs(back - np.stack((x, y), axis=1)).max()),
        "latitude": float(np.arctan2(corner[1], -corner[2])),
        "hit": float((image[..., :3].sum(axis=-1) > 0).mean()),
        "same": bool(np.array_equal(picture, image)),
        "nothing left": traces() == before,
    }


def without_it(crc, path, folder):
    """Open the file: read, render and show its camera, with the add-on registered and without."""
    crc.register()
    bpy.ops.wm.open_mainfile(filepath=str(path))
    from camera_ray_caster.blender.ui.facts_panels import facts_of

    refusals = [refusal(lambda: crc.read_camera(bpy.context.scene))]
    refusals.append(refusal(lambda: rendered(bpy.context.scene, folder / "none.exr")))
    refusals.append(facts_of(bpy.context, bpy.context.scene.camera)[1])
    shapes = len(crc.read_shapes(bpy.context.scene))
    bpy.context.scene.camera.data.camera_ray_caster.model = "OMNIMAX"
    again = crc.read_camera(bpy.context.scene).model.key
    crc.unregister()
    bpy.ops.wm.open_mainfile(filepath=str(path))
    refusals.append(refusal(lambda: crc.read_camera(bpy.context.scene)))
    return {"said": refusals, "shapes": shapes, "chosen again": again}


def refusal(act):
    """The message of the error that is raised; "" where none is."""
    try:
        act()
    except (ValueError, RuntimeError) as error:
        return str(error).strip()
    return ""


def rendered(scene, path):
    """The picture of F12, (rows, columns, 4) float32."""
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth, settings.color_mode = "OPEN_EXR", "32", "RGBA"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(str(path))
    pixels = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(image.size[1], image.size[0], 4)


if __name__ == "__main__":
    addon, path, seen, mode = sys.argv[sys.argv.index("--") + 1 :]
    sys.path.insert(0, addon)
    import camera_ray_caster

    use = {"with": with_it, "without": without_it}[mode]
    report = use(camera_ray_caster, Path(path), Path(seen).parent)
    Path(seen).write_text(json.dumps(report))
    sys.exit(0)  # Blender's program would end with 1 after a render that was refused, as one here is
