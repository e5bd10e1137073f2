"""What a file may not do to the files that a render writes."""

import pytest

from camera_ray_caster.core.records import InputError


@pytest.mark.parametrize("suffix", ["/../../../x", "/x", "\\x"])
def test_a_view_whose_suffix_leads_to_another_folder_is_refused(blender, tmp_path, suffix):
    from camera_ray_caster.blender.terminal.frame_files import render

    scene = blender.context.scene
    blender.ops.object.camera_add()
    scene.camera = blender.context.object
    scene.render.engine = "CAMERA_RAY_CASTER"
    scene.render.use_multiview = True
    scene.render.views["left"].file_suffix = suffix
    with pytest.raises(InputError, match=r"file suffix .* of view 'left' leads to another folder"):
        render(scene, tmp_path / "deep" / "out", "picture")
    assert list(tmp_path.iterdir()) == []
