"""Blender's own panels with the engine."""


def test_blenders_panels_know_the_engine(blender):
    for name in ("RENDER_PT_format", "RENDER_PT_output", "VIEWLAYER_PT_layer", "DATA_PT_lens", "OBJECT_PT_visibility"):
        assert "CAMERA_RAY_CASTER" in getattr(blender.types, name).COMPAT_ENGINES
    assert "CAMERA_RAY_CASTER" not in blender.types.RENDER_PT_eevee_performance.COMPAT_ENGINES
