"""Objects and cameras of linked libraries with the names of local ones, and of each other."""

from .parts import Hostile

COUNT = 20

FILES = "zoo.blend", "a b.blend", "ä'\".blend", "zoo.blend.blend", "[zoo].blend"


def make(chance, number, folder):
    """Link a camera and a ball with the local ones' names from one or two files; one of them may be in use."""
    import bpy

    scene = bpy.context.scene
    camera, ball = scene.camera, scene.objects[0]
    changes, linked = [], []
    for file in chance.sample(FILES, chance.choice((1, 2))):
        path, camera.location.z, ball.location.x = folder / file, 1.0, chance.choice((-2.0, 2.0))
        bpy.data.libraries.write(str(path), {camera, ball})
        camera.location.z = ball.location.x = 0.0
        with bpy.data.libraries.load(str(path), link=True) as (_, linked_data):
            linked_data.objects = [camera.name, ball.name]
        for item in linked_data.objects:
            scene.collection.objects.link(item)
        linked.append(linked_data.objects)
        changes.append(f"library {file!r}")
    other, other_ball = chance.choice(linked)
    use = chance.choice(("camera", "slit", "pass index", "camera option", "nothing"))
    if use == "camera":
        scene.camera = other
    elif use == "slit":
        settings = camera.data.camera_ray_caster
        settings.model, settings.slit_1, settings.slit_2 = "CROSS_SLIT", ball, other_ball
    elif use == "pass index":
        ball.pass_index = 7
    words = (f"--camera={camera.name}",) if use == "camera option" else ()
    return Hostile(", ".join((*changes, use)), words)
