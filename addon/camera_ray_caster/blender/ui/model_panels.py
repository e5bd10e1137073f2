"""The box in the camera's tab where a model is chosen, with the settings of the chosen one only."""

import bpy

CALIBRATION = ("calibration_file", "calibration_width", "calibration_height", "fx", "fy", "cx", "cy")
SETTINGS = {
    "BLENDER": (),
    "CAMERA_OBSCURA": ("obscura_depth", "obscura_width", "obscura_hole"),
    "FISHEYE_ORTHOGRAPHIC": ("fov",),
    "FISHEYE_STEREOGRAPHIC": ("fov",),
    "OPENCV_PINHOLE": (*CALIBRATION, "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4"),
    "OPENCV_FISHEYE": (*CALIBRATION, "k1", "k2", "k3", "k4"),
    "OMNIMAX": ("tilt",),
    "DOME_MASTER": ("fov", "tilt"),
    "CYLINDRICAL": ("pan_min", "pan_max", "latitude_bottom", "latitude_top"),
    "STEREOGRAPHIC_PANORAMA": ("fov", "elevation"),
    "GENERAL_LINEAR": ("ray_1", "ray_2", "ray_3"),
    "CROSS_SLIT": ("slit_1", "slit_2"),
    "PUSHBROOM": ("slit_1", "ortho_scale"),
    "PENCIL": ("slit_1", "pencil_slide"),
    "TWISTED_ORTHOGRAPHIC": ("slit_1", "twist", "ortho_scale"),
    "STRIP": ("path", "follow_path"),
    "OMNIDIRECTIONAL_STEREO": ("eye", "interocular_distance"),
}
"""The settings of each model in the order of the panel: our own, and Blender's that it shows for its own types only."""


ENDS, EFFORT = ("time_start", "time_end"), ("time_tolerance", "time_evaluations")
SHUTTER = ("motion_blur_position", "motion_blur_shutter", "rolling_shutter_duration")
TIME = {
    "NONE": (),
    "ROWS": (*ENDS, *EFFORT),
    "COLUMNS": (*ENDS, *EFFORT),
    "IMAGE": ("time_image", *ENDS, *EFFORT),
    "ROLLING_SHUTTER": (*SHUTTER, *EFFORT),
}
"""The same of each way to give the pixels their times; the shutter is the render's and Cycles' own."""


class ModelPanel(bpy.types.Panel):
    """Camera properties: the model and its settings."""

    bl_idname = "CAMERA_RAY_CASTER_PT_model"
    bl_label = "Ray Caster Model"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "data"

    @classmethod
    def poll(cls, context):
        """Show it for cameras."""
        return context.camera is not None

    def draw(self, context):
        """The list; below it what the chosen model needs. A calibration file stands for the numbers under it."""
        layout = self.layout
        layout.use_property_split = True
        camera = context.camera
        own = camera.camera_ray_caster
        layout.prop(own, "model")
        column = layout.column(align=True)
        for name in SETTINGS[own.model]:
            column.prop(next(owner for owner in (own, camera, camera.stereo) if hasattr(owner, name)), name)
            if name == "calibration_file":
                column = layout.column(align=True)
                column.active = not own.calibration_file


class TimePanel(bpy.types.Panel):
    """Camera properties: the time of each pixel."""

    bl_idname = "CAMERA_RAY_CASTER_PT_time"
    bl_label = "Time"
    bl_parent_id = ModelPanel.bl_idname
    bl_space_type = ModelPanel.bl_space_type
    bl_region_type = ModelPanel.bl_region_type
    bl_context = ModelPanel.bl_context
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        """The list; below it what the chosen way needs. Without Cycles its shutter has no duration."""
        layout = self.layout
        layout.use_property_split = True
        own, scene = context.camera.camera_ray_caster, context.scene
        layout.prop(own, "time_mode")
        owners = own, scene.render, getattr(scene, "cycles", None)
        for name in TIME[own.time_mode]:
            owner = next((owner for owner in owners if hasattr(owner, name)), None)
            if name == "time_image":
                layout.template_ID(own, name, open="image.open")
            elif owner is not None:
                layout.prop(owner, name)


CLASSES = (ModelPanel, TimePanel)


def register() -> None:
    """See ``registration``."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    """See ``registration``."""
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
