"""Random acts in a window, by seed: renders overlap, files are opened midway, cameras vanish that are seen through.

No act may end in a traceback, and Blender may not end. Each act is one that a user can do; what Blender refuses at that
moment is no failure.
"""

import random

import bpy
from lesson_scenarios import place_of
from parts import addon, load

FILES = "toys", "living_room_omnimax", "spheres_and_planes", "empty", "propeller"
MODELS = "OMNIMAX", "CROSS_SLIT", "OPENCV_PINHOLE", "STRIP", "BLENDER", "GENERAL_LINEAR", "TWISTED_ORTHOGRAPHIC"
ENGINES = "CAMERA_RAY_CASTER", "CAMERA_RAY_CASTER", "BLENDER_WORKBENCH"
OURS = (
    "see_through", "cast", "verify", "step_through", "clear_steps", "set_frame", "add_line", "pixel_of_point",
    "empty_at_hit", "copy_steps", "stop_all", "use_this_engine", "copy_facts", "select_seen", "show_result",
)  # fmt: skip
ACTS = 250


def context(user):
    """The override of a 3D View, or of the window alone if there is none."""
    area = next((item for item in user.window.screen.areas if item.type == "VIEW_3D"), None)
    if area is None:
        return {"window": user.window}
    return {"window": user.window, "area": area, "region": next(r for r in area.regions if r.type == "WINDOW")}


def run(user, operator, *words, **values):
    """Call an operator as from its button, unless Blender refuses it now."""
    with bpy.context.temp_override(**context(user)):
        if operator.poll():
            operator(*(words or ("INVOKE_DEFAULT",)), **values)


class Acts:
    """What is done; each method is an act, and takes the next numbers of the seed."""

    def __init__(self, user, scenes, seed):
        self.user, self.scenes, self.dice = user, scenes, random.Random(seed)

    def key(self):
        """Press a key over a view or an editor."""
        area = self.dice.choice(list(self.user.window.screen.areas))
        yield from self.user.point(area.x + area.width // 3, area.y + area.height // 2)
        yield from self.user.key(self.dice.choice(["F12", "Escape", "Escape", "ctrl+z", "ctrl+shift+z", "Return", "n"]))

    def click(self):
        """Click in the picture of the camera, or beside it."""
        scene = addon("read.scene_cache").cached_scene(bpy.context)
        if "area" in context(self.user) and scene.camera is not None and not bpy.context.screen.show_fullscreen:
            try:
                pixel = place_of(self.user, *(self.dice.randrange(-20, side + 20) for side in scene.camera.raster.size))
            except TypeError:  # no view through the camera
                return
            yield from self.user.click(*pixel)

    def ours(self):
        """Press one of our buttons."""
        run(self.user, getattr(bpy.ops.camera_ray_caster, self.dice.choice(OURS)))
        yield

    def cast_all(self):
        """Cast all cameras at the current frame."""
        folder = str(self.user.folder / "acts")
        run(self.user, bpy.ops.camera_ray_caster.cast_all, "EXEC_DEFAULT", directory=folder, frames="CURRENT")
        yield

    def model(self):
        """Choose a model for the scene's camera."""
        camera = bpy.context.scene.camera
        if camera is not None and camera.type == "CAMERA":
            camera.data.camera_ray_caster.model = self.dice.choice(MODELS)
        yield

    def engine(self):
        """Choose an engine."""
        bpy.context.scene.render.engine = self.dice.choice(ENGINES)
        yield

    def size(self):
        """Change the resolution, perhaps during a render."""
        render = bpy.context.scene.render
        render.resolution_x, render.resolution_y = self.dice.choice([(192, 108), (640, 360), (100, 300), (4, 4)])
        render.resolution_percentage = self.dice.choice([100, 50])
        yield

    def camera(self):
        """Make another object the camera, or none; a light is one, too."""
        bpy.context.scene.camera = self.dice.choice([None, *bpy.context.scene.objects])
        yield

    def remove(self):
        """Delete an object."""
        if bpy.context.scene.objects:
            bpy.data.objects.remove(self.dice.choice(list(bpy.context.scene.objects)))
        yield

    def add(self):
        """Add a camera, and use it."""
        run(self.user, bpy.ops.object.camera_add, "EXEC_DEFAULT", location=(0, -5, 2), rotation=(1.4, 0, 0))
        yield

    def frame(self):
        """Go to another frame."""
        run(self.user, bpy.ops.screen.frame_offset, "EXEC_DEFAULT", delta=self.dice.randint(-3, 3))
        yield

    def view(self):
        """Change the view, its shading or its overlays."""
        if "area" in context(self.user):
            space = context(self.user)["area"].spaces.active
            space.shading.type = self.dice.choice(["SOLID", "RENDERED", "WIREFRAME"])
            space.region_3d.view_perspective = self.dice.choice(["CAMERA", "PERSP", "ORTHO"])
            bpy.context.scene.camera_ray_caster_overlay.show = self.dice.random() < 0.5
        yield

    def open(self):
        """Open a file, perhaps during a render."""
        bpy.ops.wm.open_mainfile(filepath=str(self.scenes / f"{self.dice.choice(FILES)}.blend"), load_ui=False)
        bpy.context.scene.render.resolution_percentage = 25
        yield

    def save(self):
        """Save a copy."""
        bpy.ops.wm.save_as_mainfile(filepath=str(self.user.folder / "acts.blend"), copy=True)
        yield

    def again(self):
        """Disable the add-on and enable it again."""
        module = addon("registration").__name__.partition(".blender.")[0]
        bpy.ops.preferences.addon_disable(module=module)
        yield
        bpy.ops.preferences.addon_enable(module=module)


WEIGHTS = {
    "key": 6, "click": 5, "ours": 9, "cast_all": 1, "model": 3, "engine": 3, "size": 3, "camera": 2, "remove": 1,
    "add": 2, "frame": 2, "view": 4, "open": 1, "save": 1, "again": 0.2,
}  # fmt: skip


def acts(seed):
    """Return the scenario of a seed."""

    def scenario(user, scenes):
        yield from load(user, scenes, "toys")
        doing = Acts(user, scenes, seed)
        for number in range(ACTS):
            (name,) = doing.dice.choices(list(WEIGHTS), list(WEIGHTS.values()))
            print(f"act {number} of seed {seed}: {name}", flush=True)
            try:
                yield from getattr(doing, name)()
            except RuntimeError as refused:  # an operator's report of an error
                print(f"  refused: {refused}".splitlines()[0], flush=True)
            yield from user.wait(doing.dice.choice([0.05, 0.05, 0.3]))

    return scenario
