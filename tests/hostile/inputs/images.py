"""Images as the time of pixels, and clocks."""

from .parts import FLOATS, Hostile

COUNT = 80

HALF_A_PNG = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\xff\xff\0\0\xff\xff\x08\x02\0\0\0" + bytes(range(200))


def make(chance, number, folder):
    """Let the time come from an image that is none, or from ends that are none."""
    import bpy

    scene = bpy.context.scene
    group = scene.camera.data.camera_ray_caster
    group.time_mode = ("IMAGE", "IMAGE", "ROWS", "COLUMNS", "ROLLING_SHUTTER")[number % 5]
    changes = [group.time_mode]
    if chance.random() < 0.5:
        for name in ("time_start", "time_end", "time_tolerance"):
            if chance.random() < 0.5:
                setattr(group, name, value := chance.choice((*FLOATS, 1048574.0, -1048574.0, 3.5)))
                changes.append(f"{name} {value}")
    group.time_evaluations = chance.choice((2, 3, 16))
    scene.render.motion_blur_shutter = shutter = chance.choice((*FLOATS, 0.5, 1e6, 3e6))
    scene.frame_set(frame := chance.choice((1, 0, -5, 1048574, -1048574)))
    changes.append(f"shutter {shutter}, frame {frame}")
    if group.time_mode == "IMAGE":
        group.time_image = _image(chance, folder, changes)
    if chance.random() < 0.5:
        for frame, x in ((1, 0.0), (10, chance.choice(FLOATS))):
            scene.camera.location.x = x
            scene.camera.keyframe_insert("location", frame=frame)
        changes.append(f"moves to {x}")
    return Hostile(", ".join(changes))


def _image(chance, folder, changes):
    import bpy

    how = chance.choice(("floats", "floats", "none", "missing", "bytes", "movie", "small", "text", "half", "generated"))
    changes.append(f"image: {how}")
    if how == "none":
        return None
    if how == "missing":
        image = bpy.data.images.new("Missing", 1, 1)
        image.source, image.filepath = "FILE", "//missing.png"
        return image
    if how in ("movie", "text", "half"):
        path = folder / f"time.{'mp4' if how == 'movie' else 'png'}"
        path.write_bytes(HALF_A_PNG if how == "half" else b"no picture")
        image = bpy.data.images.new("File", 1, 1)
        image.source, image.filepath = "MOVIE" if how == "movie" else "FILE", str(path)
        return image
    if how == "generated":
        image = bpy.data.images.new("Generated", 4, 4)
        image.generated_type = chance.choice(("BLANK", "UV_GRID", "COLOR_GRID"))
        return image
    width, height = (1, 1) if how == "small" else (chance.randint(1, 20), chance.randint(1, 20))
    image = bpy.data.images.new("Time", width, height, float_buffer=how == "floats")
    value = chance.choice(FLOATS)
    image.pixels[:] = [value if chance.random() < 0.2 else chance.random() for _ in range(4 * width * height)]
    image.pack()
    changes.append(f"values {value}")
    return image
