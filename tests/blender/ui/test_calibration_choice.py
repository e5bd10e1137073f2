"""Messages in panels, and the choice of one of several cameras in a calibration file."""

from types import SimpleNamespace

from camera_ray_caster.blender.properties.calibration_choice import cameras_in
from camera_ray_caster.blender.properties.setting_labels import in_labels
from camera_ray_caster.blender.ui.operators import draw_cameras


def test_messages_in_panels_have_the_labels_of_settings(blender):
    assert in_labels("slit_1 of camera 'A_b' is no line of the lens") == "Slit of camera 'A_b' is no line of the lens"
    assert (
        in_labels("set Camera in File (--calibration-camera, in Python camera=) to a (b)")
        == "Set Camera in File to a (b)"
    )


def test_a_window_offers_the_cameras_of_a_file(blender, camera_scene, tmp_path):
    path, data = tmp_path / "cameras.txt", camera_scene.camera.data
    path.write_text("1 PINHOLE 96 54 70 70 48 27\n7 SIMPLE_PINHOLE 96 54 80 48 27\n")
    names = cameras_in(data, str(path))
    assert names == ["1", "7"]
    entries = []

    class Drawn:
        operator_context = ""

        def operator(self, name, text):
            entries.append(SimpleNamespace(text=text))
            return entries[-1]

    menu = SimpleNamespace(layout=Drawn())
    draw_cameras(str(path), names, True, menu, None)
    assert menu.layout.operator_context == "EXEC_DEFAULT", "or the file would be asked for again"
    assert [(entry.text, entry.filepath, entry.camera) for entry in entries] == [
        (name, str(path), name) for name in names
    ]
    for entry in entries:
        assert blender.ops.camera_ray_caster.load_calibration(filepath=entry.filepath, camera=entry.camera) == {
            "FINISHED"
        }
        assert data.camera_ray_caster.calibration_camera == entry.camera
