"""The panel of the camera's model and its times: the settings that are read, in order, and no others."""

import pytest

from camera_ray_caster.blender.cycles import to_cycles
from camera_ray_caster.blender.ui import drawing
from camera_ray_caster.blender.ui.model_panels import LensPanel, ModelPanel, PortPanel, SensorPanel, TimePanel
from camera_ray_caster.core.records import InputError

MATRIX = ("calibration_width", "calibration_height", "fx", "fy", "cx", "cy", "skew")
FILE = ("calibration_file", "calibration_unit")
CALIBRATION = (*FILE, *MATRIX)
POINT = (*FILE, "calibration_width", "calibration_height", "cx", "cy")
SHOWN = {
    "BLENDER": (),
    "CAMERA_OBSCURA": ("obscura_depth", "obscura_width", "obscura_hole"),
    "FISHEYE_ORTHOGRAPHIC": ("fov",),
    "FISHEYE_STEREOGRAPHIC": ("fov",),
    "OPENCV_PINHOLE": (
        *CALIBRATION, "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4", "tau_x", "tau_y",
    ),
    "OPENCV_FISHEYE": (*CALIBRATION, "k1", "k2", "k3", "k4"),
    "UCM": (*CALIBRATION, "unified_xi", "k1", "k2", "p1", "p2"),
    "EUCM": (*CALIBRATION, "unified_alpha", "unified_beta"),
    "DOUBLE_SPHERE": (*CALIBRATION, "unified_xi", "unified_alpha"),
    "FISHEYE624": (*CALIBRATION, "k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2", "s1", "s2", "s3", "s4"),
    "THIN_PRISM_FISHEYE": (*CALIBRATION, "k1", "k2", "p1", "p2", "k3", "k4", "s1", "s3"),
    "FOV": (*CALIBRATION, "fov_omega"),
    "DIVISION": (*CALIBRATION, "division_lambda"),
    "RADIAL_POLYNOMIAL": (*CALIBRATION, "radial_polynomial"),
    "FTHETA": (
        *POINT, "ftheta_reference", "ftheta_angle_to_radius", "ftheta_c", "ftheta_d", "ftheta_e", "ftheta_max_angle",
    ),
    "OCAM": (*POINT, "ocam_polynomial", "ocam_c", "ocam_d", "ocam_e"),
    "RAY_TABLE": (FILE[0], "ray_axes", "ray_interpolation", "ray_block_columns", "ray_block_rows", "ray_slide"),
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
}  # fmt: skip
"""What the panel shows below the model of a perspective camera, of which Blender itself shows the focal length."""

EFFORT = ("time_tolerance", "time_evaluations")
TIMES = {
    "NONE": (),
    "ROWS": ("time_start", "time_end", *EFFORT),
    "COLUMNS": ("time_start", "time_end", *EFFORT),
    "IMAGE": ("time_image", "time_start", "time_end", *EFFORT),
    "ROLLING_SHUTTER": ("readout", "motion_blur_position", "motion_blur_shutter", "rolling_shutter_duration", *EFFORT),
    "SWEEP": ("fps", "fps_base", *EFFORT),
}

WIDTH = 292
"""Of the default sidebar in pixels at interface scale 1."""


class Layout:
    """Takes down what is drawn, which has to exist with a label that is not cut, and what of it is active."""

    use_property_split = True

    def __init__(self, names=None, grayed=None, operators=None, labels=None):
        self.names, self.grayed, self.active = [] if names is None else names, [] if grayed is None else grayed, True
        self.operators = [] if operators is None else operators
        self.labels = [] if labels is None else labels

    def split(self, factor, align):
        return self.column(align)

    def label(self, text, icon="NONE"):
        self.labels.append(text)

    def prop(self, owner, name, index=0, text=None):
        kind = owner.bl_rna.properties[name]
        room = drawing.label_room(WIDTH, kind.type == "BOOLEAN")
        assert not self.use_property_split or drawing.text_width(text or kind.name) <= room
        if index == 0:
            (self.names if self.active else self.grayed).append(name)

    def template_ID(self, owner, name, open):
        assert owner.bl_rna.properties[name].fixed_type.identifier == "Image"
        self.prop(owner, name)

    def column(self, align=False):
        inside = Layout(self.names, self.grayed, self.operators, self.labels)
        inside.active, inside.use_property_split = self.active, self.use_property_split
        return inside

    row = column

    def context_pointer_set(self, name, data):
        """For the popover."""

    def menu(self, name, text, icon="NONE"):
        """Menus are drawn in a window."""

    def template_icon_view(self, owner, name, **options):
        """So is the gallery."""
        assert name in owner.bl_rna.properties

    def operator(self, name, text=None, icon="NONE"):
        self.operators.append(name.partition(".")[2])
        return self


@pytest.fixture
def data(blender):
    return blender.data.cameras.new("Camera")


def drawn(bpy, panel, data, engine="CYCLES", width=WIDTH):
    layout = Layout()
    region = type("Region", (), {"width": width})
    context = {"camera": data, "object": None, "scene": bpy.context.scene, "engine": engine, "region": region}
    context["view_layer"] = bpy.context.view_layer
    context["evaluated_depsgraph_get"] = staticmethod(bpy.context.evaluated_depsgraph_get)
    context = type("Context", (), {**context, "preferences": bpy.context.preferences})
    panel.draw(type("Panel", (), {"layout": layout}), context)
    drawn.operators, drawn.labels = layout.operators, layout.labels
    return tuple(layout.names), tuple(layout.grayed)


def test_the_settings_of_the_chosen_model_are_shown_in_order(blender, data):
    settings = data.camera_ray_caster
    assert set(SHOWN) <= {item.identifier for item in settings.bl_rna.properties["model"].enum_items}
    for settings.model, names in SHOWN.items():
        assert drawn(blender, ModelPanel, data) == (names, ())


def test_glass_is_offered_to_models_with_an_eye_and_its_settings_appear_when_it_is_chosen(blender, data):
    group, context = data.camera_ray_caster, type("Context", (), {"camera": data})
    assert drawn(blender, PortPanel, data) == (("port",), ())
    group.port = "DOME"
    names, _ = drawn(blender, PortPanel, data)
    assert " ".join(names) == "port port_radius port_decenter port_thickness port_glass port_medium port_inside"
    group.model = "PUSHBROOM"
    assert not PortPanel.poll(context)
    data.type, group.model = "PERSP", "BLENDER"
    assert PortPanel.poll(context)


def test_in_a_narrow_editor_the_same_is_shown_with_labels_that_are_not_cut_off(blender, data):
    data.camera_ray_caster.model = "OPENCV_FISHEYE"
    wide = drawn(blender, ModelPanel, data)
    label = "Calibration"
    assert label not in drawn.labels
    assert drawn(blender, ModelPanel, data, width=220) == wide
    assert label in drawn.labels


def test_what_blender_shows_for_another_type_of_camera_is_shown(blender, data):
    settings = data.camera_ray_caster
    data.type, settings.model = "ORTHO", "PUSHBROOM"
    assert drawn(blender, ModelPanel, data)[0] == ("slit_1", "lens")
    data.type = "PANO"
    assert drawn(blender, ModelPanel, data)[0] == ("slit_1", "ortho_scale", "lens")


def test_with_our_engine_the_lens_panel_has_what_blenders_shows_for_cycles_only(blender, data):
    def lens():
        return drawn(blender, LensPanel, data, "CAMERA_RAY_CASTER")

    frame = ("shift_x", "shift_y", "clip_start", "clip_end")
    assert lens() == (("type", "lens", "lens_unit", *frame), ())
    data.lens_unit = "FOV"
    assert lens()[0][1] == "angle"
    data.type = "ORTHO"
    assert lens() == (("type", "ortho_scale", *frame), ())
    data.type, data.panorama_type = "PANO", "EQUIRECTANGULAR"
    corners = ("longitude_min", "longitude_max", "latitude_min", "latitude_max")
    assert lens() == (("type", "panorama_type", *corners, *frame), ())
    data.panorama_type = "FISHEYE_EQUISOLID"
    assert lens()[0][2:4] == ("fisheye_lens", "fisheye_fov")


def test_what_the_model_does_not_read_of_the_lens_is_gray(blender, data):
    group, ours = data.camera_ray_caster, "CAMERA_RAY_CASTER"
    group.model = "OMNIMAX"
    assert drawn(blender, LensPanel, data, ours) == (
        ("shift_x", "shift_y", "clip_start", "clip_end"),
        ("type", "lens", "lens_unit"),
    )
    group.model = "GENERAL_LINEAR"
    assert drawn(blender, LensPanel, data, ours)[1][-2:] == ("shift_x", "shift_y")
    group.model = "PUSHBROOM"
    assert drawn(blender, LensPanel, data, ours)[1] == ("type",)
    assert drawn(blender, ModelPanel, data, ours)[0] == ("slit_1",)


def test_a_sensor_that_the_model_does_not_read_is_gray(blender, data):
    def sensor():
        return drawn(blender, SensorPanel, data, "CAMERA_RAY_CASTER")

    assert sensor() == (("sensor_fit", "sensor_width"), ())
    data.sensor_fit = "VERTICAL"
    assert sensor() == (("sensor_fit", "sensor_height"), ())
    data.camera_ray_caster.model = "OMNIMAX"
    assert sensor() == ((), ("sensor_fit", "sensor_height"))


def test_beside_blender_s_own_panel_ours_says_what_the_model_does_not_use(blender, data):
    def labels_in(engine="CYCLES"):
        drawn(blender, ModelPanel, data, engine)
        return " ".join(drawn.labels)

    assert labels_in() == ""
    data.camera_ray_caster.model = "OMNIMAX"
    assert labels_in() == "The model does not use Blender's Type, Focal Length, Sensor Fit, Sensor Width, Sensor Height"
    assert labels_in("CAMERA_RAY_CASTER") == ""
    data.camera_ray_caster.model = "PUSHBROOM"
    assert labels_in().endswith("The model does not use Blender's Type")


def test_a_missing_slit_or_path_is_added_where_the_camera_sees_something(blender, camera_scene):
    from camera_ray_caster.blender.read import read_camera

    data = camera_scene.camera.data
    for model, settings in (
        ("CROSS_SLIT", ["slit_1", "slit_2"]), ("PUSHBROOM", ["slit_1"]), ("PENCIL", ["slit_1"]),
        ("TWISTED_ORTHOGRAPHIC", ["slit_1"]), ("STRIP", ["path"]),
    ):  # fmt: skip
        data.camera_ray_caster.model = model
        for setting in settings:
            setattr(data.camera_ray_caster, setting, None)
        assert len(settings) == [drawn(blender, ModelPanel, data), drawn.operators][1].count("add_line")
        with pytest.raises(InputError, match="is not set"):
            read_camera(camera_scene)
        for setting in settings:
            assert blender.ops.camera_ray_caster.add_line(setting=setting) == {"FINISHED"}
            assert getattr(data.camera_ray_caster, setting).parent == camera_scene.camera
        assert "add_line" not in [drawn(blender, ModelPanel, data), drawn.operators][1]
        assert read_camera(camera_scene).rays().valid.all()


def test_a_calibration_file_hides_the_numbers_that_it_replaces(blender, data):
    settings = data.camera_ray_caster
    settings.model, settings.calibration_file = "OPENCV_FISHEYE", "//lens.yml"
    assert drawn(blender, ModelPanel, data) == (("calibration_file", "calibration_camera"), ())


def test_lengths_in_millimeters_are_blender_s_own_and_the_panel_says_so(blender, data):
    def labels_in():
        return [drawn(blender, ModelPanel, data, "CAMERA_RAY_CASTER"), " ".join(drawn.labels)][1]

    settings = data.camera_ray_caster
    data.type, settings.model = "PANO", "DIVISION"
    assert labels_in() == "In pixels of a picture of 1920 × 1080, scaled to the frame"
    settings.calibration_unit = "MILLIMETERS"
    assert labels_in() == "In millimeters on Blender's sensor; Shift sets the center"
    assert drawn(blender, ModelPanel, data)[0] == (*FILE, "lens", "division_lambda")
    settings.calibration_file = "//lens.yml"
    assert labels_in() == "In pixels of the file's picture, scaled to the frame"
    assert drawn(blender, ModelPanel, data) == (("calibration_file", "calibration_camera"), ())


def test_a_camera_of_cycles_shows_the_settings_of_its_own_type_and_the_way_back(osl, blender, camera_scene):
    data = camera_scene.camera.data
    assert drawn(blender, ModelPanel, data)[0] == ()
    assert drawn.operators == ["key_model", "load_calibration", "use_in_cycles", "add_projector"]
    to_cycles(camera_scene)
    camera_scene.render.engine = "CYCLES"
    assert drawn(blender, ModelPanel, data)[0] == ("lens",)
    assert drawn.operators == ["key_model", "load_calibration", "back_to_blender", "use_in_cycles"]
    data.camera_ray_caster.model = "PUSHBROOM"
    assert drawn(blender, ModelPanel, data)[0] == ("slit_1", "ortho_scale", "lens")


def test_the_buttons_go_there_and_back(osl, blender, camera_scene):
    data, ops = camera_scene.camera.data, blender.ops.camera_ray_caster
    assert not ops.back_to_blender.poll()
    ops.use_in_cycles()
    assert data.type == "CUSTOM"
    ops.back_to_blender()
    assert data.type == "PERSP"
    data.camera_ray_caster.time_mode = "COLUMNS"
    with pytest.raises(RuntimeError, match="Cycles exposes rows from the top down"):
        ops.use_in_cycles()


def test_the_settings_of_the_chosen_time_are_shown_in_order(blender, data):
    settings = data.camera_ray_caster
    assert set(TIMES) == {item.identifier for item in settings.bl_rna.properties["time_mode"].enum_items}
    for settings.time_mode, names in TIMES.items():
        assert drawn(blender, TimePanel, data) == (("time_mode", *names), ())


def test_without_cycles_its_setting_is_not_shown(blender, data, monkeypatch):
    from camera_ray_caster.blender.properties import owners

    data.camera_ray_caster.time_mode = "ROLLING_SHUTTER"
    monkeypatch.setitem(owners.OWNERS, owners.CYCLES, lambda camera, scene: None)
    assert "rolling_shutter_duration" not in drawn(blender, TimePanel, data)[0]
